#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <utility>

#include "myoid/body/forces/actuator_sharing.h"
#include "myoid/body/forces/static_optimization.h"

#include "table_rows.h"

namespace myoid::opensim_table {

/// Every frame of a static optimization as it was solved here.
struct SharedFrames {
  std::map<Eigen::Index, std::pair<body::ActuatorProblem, body::ActuatorSolution>> frames;
  std::mutex mutex;
  body::InspectFrame keep() {
    return [this](Eigen::Index i, const body::ActuatorProblem& p, const body::ActuatorSolution& s) {
      const std::lock_guard lock(mutex);
      frames.insert_or_assign(i, std::pair(p, s));
    };
  }
};

/// Cost and constraint residual of every frame, ours against those of OpenSim's controls in the
/// same problem. A residual buys cost: the last row charges theirs for it at the price of the
/// multipliers, which makes a lower bound of the cost, since the problem is convex.
void compare_sharing(const SharedFrames& shared, const std::filesystem::path& reference, const Rows& rows);

}  // namespace myoid::opensim_table
