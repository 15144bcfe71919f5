#include "myoid/body/forces/sharing_input.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/dynamics/inverse_dynamics.h"
#include "myoid/body/forces/opensim_muscle.h"
#include "myoid/body/model/constraints.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

std::vector<Eigen::Index> balanced(const body::BodyModel& model, const std::vector<std::string>& names) {
  std::vector<Eigen::Index> result;
  for (const std::string& name : names) {
    const int c = model.coordinate_index(name);
    if (model.is_constrained(c)) {
      throw ModelError(
          fmt::format("coordinate '{}' is locked, prescribed or follows another: no torque of its own moves it", name));
    }
  }
  for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
    const bool wanted = names.empty() ? !model.is_constrained(static_cast<int>(c))
                                      : std::find(names.begin(), names.end(), model.coordinates[c].name) != names.end();
    if (wanted) result.push_back(static_cast<Eigen::Index>(c));
  }
  return result;
}

/// Adds the muscles' paths and strengths to the torques.
void add_muscles(const body::BodyModel& model, body::MuscleKinematics muscles, SharingInput& input) {
  input.muscles = std::move(muscles);
  const Eigen::Index frames = input.torques.sample_count();
  const auto count = static_cast<Eigen::Index>(model.muscles.size());
  input.optimal_force_n.resize(frames, count);
  input.max_isometric_force_n.resize(count);
  input.min_activation = 1.0;
  for (Eigen::Index m = 0; m < count; ++m) {
    const OpensimMuscle muscle(model.muscles[at(m)], model.compat);
    if (!muscle.has_own_curves()) {
      input.notes.push_back({.severity = Severity::note,
                             .says = fmt::format("muscle '{}' of class {}: its strength is that of Thelen's curves",
                                                 model.muscles[at(m)].name, model.muscles[at(m)].class_name)});
    }
    input.min_activation = std::min(input.min_activation, model.muscles[at(m)].properties.control.least);
    input.max_isometric_force_n[m] = muscle.properties().max_isometric_force_n;
    for (Eigen::Index i = 0; i < frames; ++i)
      input.optimal_force_n(i, m) =
          muscle.optimal_force(input.muscles.length.values()(i, m), input.muscles.velocity.values()(i, m));
  }
}

}  // namespace

SharingInput sharing_input(const body::BodyModel& model,
                           TimeSeries torques,
                           body::MuscleKinematics muscles,
                           const std::vector<std::string>& coordinates) {
  SharingInput input;
  input.torques = std::move(torques);
  for (const std::string& name : coordinates) input.moment_arms.push_back(muscles.moment_arm.at(name));
  add_muscles(model, std::move(muscles), input);
  return input;
}

SharingInput sharing_input(const body::BodyModel& model,
                           const body::JointMotion& motion,
                           body::MuscleKinematics muscles,
                           const std::vector<std::string>& coordinates,
                           const body::ExternalLoads* loads) {
  if (model.muscles.empty()) throw ModelError("the model has no muscles");
  SharingInput input;
  const std::vector<Eigen::Index> chosen = balanced(model, coordinates);
  if (!model.constraints.empty()) {
    input.notes.push_back(
        {.severity = Severity::note,
         .says = "joints form closed loops: the forces of their constraints are not known here; run-tool's "
                 "static optimization projects them out"});
  }
  const TimeSeries tau = body::inverse_dynamics(model, motion, {.loads = loads, .passive_forces = true});
  const Eigen::Index frames = motion.sample_count();
  const auto rows = static_cast<Eigen::Index>(chosen.size());
  Eigen::MatrixXd torque(frames, rows);
  body::BodyState state = body::make_state(model);
  for (Eigen::Index i = 0; i < frames; ++i) {
    state.q = motion.q.values().row(i).transpose();
    // Derivatives of all coordinates by each: only through couplers here.
    for (Eigen::Index k = 0; k < rows; ++k) {
      Eigen::VectorXd rate = Eigen::VectorXd::Unit(state.q.size(), chosen[at(k)]);
      for (std::size_t round = 0; round < model.couplers.size(); ++round) {
        for (const body::CoordinateCoupler& c : model.couplers)
          rate[c.dependent] = evaluate(c.function, state.q[c.independent]).first * rate[c.independent];
      }
      torque(i, k) = tau.values().row(i).dot(rate);
    }
  }
  std::vector<Channel> channels;
  for (const Eigen::Index c : chosen) {
    channels.push_back(tau.channels()[at(c)]);
    // These moment arms include the couplers.
    input.moment_arms.push_back(muscles.moment_arm.at(model.coordinates[at(c)].name));
  }
  input.torques = TimeSeries(tau.time_s(), std::move(channels), std::move(torque));
  add_muscles(model, std::move(muscles), input);
  return input;
}

MuscleForces share(const SharingInput& input, SharingOptions options) {
  options.min_activation = input.min_activation;
  return share(input.moment_arms, input.torques, input.optimal_force_n, input.max_isometric_force_n, options);
}

}  // namespace myoid::body
