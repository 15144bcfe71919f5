#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/progress.h"
#include "myoid/identification/start_box.h"
#include "myoid/math/multistart.h"

namespace myoid::identification {

/// Where searches from several starts ended together.
struct BasinRow {
  Eigen::VectorXd x;      ///< Of its lowest end, in the solver's scale.
  double cost = 0.0;      ///< Of that end.
  int starts = 0;         ///< That ended here ...
  int converged = 0;      ///< ... and converged.
  double distance = 0.0;  ///< From the best: root mean square over the unknowns, in spreads of what
                          ///< is known beforehand (StartBox).
  bool rival = false;     ///< As good as the best: a chi-square of at most 4 worse.
};

struct BasinTable {
  std::string fit;  ///< "all muscles", or the muscle's name with, in method paper, the branch.
  int starts = 0;
  int failed = 0;                ///< Starts that ended at no finite cost.
  std::vector<BasinRow> basins;  ///< By rising cost.
};

/// Searches from the given start and Sobol points of the box, in parallel. Two ends are one basin
/// if no unknown differs by more than 0.04 spreads. `plain_samples` is the number of residuals of a
/// cost that does not weight them, which their own variance then turns into chi-square; 0: it does.
/// Throws Interrupted.
[[nodiscard]] BasinTable find_basins(const math::LocalSearch& search,
                                     const StartBox& box,
                                     int starts,
                                     Eigen::Index plain_samples = 0,
                                     const Progress& progress = {});

}  // namespace myoid::identification
