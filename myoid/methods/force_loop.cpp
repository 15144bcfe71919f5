#include "myoid/methods/force_loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/forces/force_sharing.h"
#include "myoid/identification/muscle_activation.h"
#include "myoid/methods/torque.h"

namespace myoid::identification {
namespace {

/// Rounds in a row with growing changes that count as divergence.
constexpr int kGrowing = 4;

struct Change {
  double size = 0.0;
  std::string where;
};

Change change_of(const std::vector<MuscleSetup>& setups,
                 const std::vector<MuscleValues>& before,
                 const std::vector<MuscleValues>& after) {
  Change change;
  for (std::size_t m = 0; m < before.size(); ++m) {
    for (std::size_t k = 0; k < muscle::kHillFields.size(); ++k) {
      const double old_value = before[m][k];
      const double new_value = after[m][k];
      double size = std::abs(new_value - old_value);
      if (old_value > 0.0 && new_value > 0.0) size = std::abs(std::log(new_value / old_value));
      if (size > change.size) change = {size, setups[m].name + "." + std::string(muscle::kHillFields[k].name)};
    }
  }
  return change;
}

/// The shared forces of every trial, which also go into the data, and their change.
struct Shared {
  std::vector<InformedForces> trials;
  double force_change = 0.0;
  double reserve_nm = 0.0;
};

ForceLoopRound round_of(const Change& change, const Shared& shared) {
  return {change.size, change.where, shared.force_change, shared.reserve_nm};
}

Shared share_all(StudyData& data,
                 const std::vector<MuscleValues>& muscles,
                 double delay_s,
                 const InformedSharing& options) {
  Shared shared;
  double changed = 0.0;
  double forces = 0.0;
  double reserve = 0.0;
  double samples = 0.0;
  for (TrialData& trial : data.trials) {
    InformedForces found =
        informed_forces(trial, muscle_activation(data, trial, trial.time_s, delay_s), muscles, options);
    if (trial.force_n.rows() == found.force_n.rows()) changed += (found.force_n - trial.force_n).squaredNorm();
    forces += found.force_n.squaredNorm();
    reserve += found.reserve_nm.squaredNorm();
    samples += static_cast<double>(found.reserve_nm.size());
    trial.force_n = found.force_n;
    shared.trials.push_back(std::move(found));
  }
  shared.force_change = forces > 0.0 ? std::sqrt(changed / forces) : 0.0;
  shared.reserve_nm = std::sqrt(reserve / std::max(1.0, samples));
  return shared;
}

std::vector<MuscleValues> starting_values(const StudyData& data) {
  std::vector<MuscleValues> values;
  for (const MuscleSetup& setup : data.muscles) values.push_back(muscle_values(setup.start, setup.extras));
  return values;
}

std::vector<MuscleValues> values_of(const StudyData& data, const IdentificationResult& fit) {
  std::vector<MuscleValues> values;
  for (std::size_t m = 0; m < data.muscles.size(); ++m) {
    values.push_back(muscle_values(fit.muscles[m], data.muscles[m].extras));
  }
  return values;
}

double found_delay(const IdentificationResult& fit, double otherwise) {
  double sum = 0.0;
  int count = 0;
  for (const ParameterEstimate& e : fit.estimates) {
    if (e.parameter != "emg_delay") continue;
    sum += e.estimate;
    ++count;
  }
  return count > 0 ? sum / count : otherwise;
}

bool growing(const std::vector<ForceLoopRound>& rounds) {
  if (rounds.size() < kGrowing + 1) return false;
  for (std::size_t k = rounds.size() - kGrowing; k < rounds.size(); ++k) {
    if (rounds[k].parameter_change <= rounds[k - 1].parameter_change) return false;
  }
  return true;
}

std::string bounds_reached(const IdentificationResult& fit) {
  std::string list;
  for (const ParameterEstimate& e : fit.estimates) {
    if (e.at_bound) list += (list.empty() ? "" : ", ") + e.muscle + "." + e.parameter;
  }
  return list;
}

/// Throws InvalidInput unless the trial has torque, moment arms and activations for all muscles.
void check_sizes(const TrialData& trial, const Eigen::MatrixXd& measured, const std::vector<MuscleValues>& muscles) {
  const Eigen::Index n = trial.time_s.size();
  const auto m = static_cast<Eigen::Index>(muscles.size());
  if (trial.torque_nm.size() != n || trial.moment_arm_m.rows() != n || trial.moment_arm_m.cols() != m ||
      trial.length_m.cols() != m || measured.rows() != n || measured.cols() != m) {
    throw InvalidInput(
        fmt::format("trial '{}' has no torque, moment arms or activations for {} muscles", trial.name, m));
  }
}

/// Returns the moment arms of all joints at sample i; joints x muscles.
Eigen::MatrixXd moment_arms_at(const TrialData& trial, Eigen::Index i) {
  Eigen::MatrixXd arms(static_cast<Eigen::Index>(joint_count(trial)), trial.moment_arm_m.cols());
  arms.row(0) = trial.moment_arm_m.row(i);
  for (Eigen::Index j = 1; j < arms.rows(); ++j)
    arms.row(j) = trial.more_joints[static_cast<std::size_t>(j - 1)].moment_arm_m.row(i);
  return arms;
}

/// Returns the torques of the joints without their resting torques; n x joints.
Eigen::MatrixXd torques_of_muscles(const TrialData& trial) {
  Eigen::MatrixXd active_nm(trial.time_s.size(), static_cast<Eigen::Index>(joint_count(trial)));
  for (std::size_t j = 0; j < joint_count(trial); ++j) {
    const TrialData one = of_joint(trial, j);
    active_nm.col(static_cast<Eigen::Index>(j)) = one.torque_nm - resting_torque_nm(one);
  }
  return active_nm;
}

}  // namespace

InformedForces informed_forces(const TrialData& trial,
                               const Eigen::MatrixXd& measured,
                               const std::vector<MuscleValues>& muscles,
                               const InformedSharing& options) {
  check_sizes(trial, measured, muscles);
  const Eigen::Index n = trial.time_s.size();
  const auto m = static_cast<Eigen::Index>(muscles.size());
  const auto joints = static_cast<Eigen::Index>(joint_count(trial));
  InformedForces result{.trial = trial.name,
                        .time_s = trial.time_s,
                        .activation = Eigen::MatrixXd(n, m),
                        .measured = measured,
                        .force_n = Eigen::MatrixXd(n, m),
                        .reserve_nm = Eigen::MatrixXd(n, joints)};
  const Eigen::MatrixXd active_nm = torques_of_muscles(trial);
  const auto force_n = [&](Eigen::Index i, Eigen::Index k, double activation) {
    return tension(activation, trial.length_m(i, k), trial.velocity_mps(i, k), muscles[static_cast<std::size_t>(k)])
        .force_n;
  };
  Eigen::RowVectorXd rest(m), full(m);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = 0; k < m; ++k) {
      // The sharing uses the muscle's activation; the law multiplies by the muscle's share.
      const double share = muscles[static_cast<std::size_t>(k)][kShare];
      result.measured(i, k) = std::clamp(share * result.measured(i, k), 0.0, 1.0);
      rest[k] = force_n(i, k, 0.0);
      full[k] = force_n(i, k, 1.0 / share);
    }
    const Eigen::MatrixXd arms = moment_arms_at(trial, i);
    const Eigen::VectorXd torques = active_nm.row(i).transpose();
    const forces::SharingSolution solution = forces::solve_sharing(
        {.moment_arm = arms,
         .optimal_force = (full - rest).cwiseMax(0.0).transpose(),
         .torque = torques - arms * rest.transpose(),
         .lower = Eigen::VectorXd::Zero(m),
         .upper = Eigen::VectorXd::Ones(m),
         .weight = {},
         .reserve = Eigen::VectorXd::Constant(joints, options.reserve_nm),
         .emg = options.emg_weight > 0.0 ? Eigen::VectorXd(result.measured.row(i).transpose()) : Eigen::VectorXd(),
         .emg_weight = options.emg_weight,
         .exponent = 2.0});
    if (solution.status != forces::SharingStatus::optimal && solution.status != forces::SharingStatus::reserve_used) {
      ++result.frames_not_solved;
    }
    result.activation.row(i) = solution.activation.transpose();
    for (Eigen::Index k = 0; k < m; ++k) {
      result.force_n(i, k) = force_n(i, k, solution.activation[k] / muscles[static_cast<std::size_t>(k)][kShare]);
    }
    result.reserve_nm.row(i) = (torques - arms * result.force_n.row(i).transpose()).transpose();
  }
  return result;
}

namespace {

/// Returns the root mean square of the torques of all trials and joints.
double torque_size_nm(const StudyData& data) {
  double squares = 0.0, samples = 0.0;
  for (const TrialData& trial : data.trials) {
    const Eigen::MatrixXd torques = torques_of_muscles(trial);
    squares += torques.squaredNorm();
    samples += static_cast<double>(torques.size());
  }
  return std::sqrt(squares / std::max(1.0, samples));
}

/// Takes the muscles from the posterior of the torque, and shares the forces among them.
ForceLoop forces_of_posterior(StudyData data, const ForceLoopOptions& options) {
  ForceLoop loop;
  EstimatorOptions estimator = options.force.estimator;
  estimator.predictions = false;
  loop.fit = identify_torque(data, estimator);
  const std::vector<MuscleValues>& found = loop.fit.values.muscles;
  const Change change = change_of(data.muscles, starting_values(data), found);
  Shared shared = share_all(data, found, loop.fit.delay_s, options.sharing);
  loop.forces = std::move(shared.trials);
  loop.rounds.push_back(round_of(change, shared));
  const bool ended = loop.fit.termination == math::Termination::converged;
  loop.end = ended ? LoopEnd::converged : LoopEnd::diverged;
  loop.message = ended ? fmt::format(
                             "the posterior of the torque finds the muscles without shared forces; the forces that "
                             "these muscles share leave {:.2g} N m of the torque, whose root mean square is {:.3g} N m",
                             shared.reserve_nm, torque_size_nm(data))
                       : "the search for the posterior's mode did not end: " + loop.fit.message;
  return loop;
}

}  // namespace

ForceLoop iterate_forces(StudyData data, const ForceLoopOptions& options) {
  validate(data);
  if (options.force.estimator.estimator == EstimatorKind::posterior)
    return forces_of_posterior(std::move(data), options);
  ForceLoop loop;
  double delay_s = options.delay_s;
  std::vector<MuscleValues> muscles = starting_values(data);
  Shared shared = share_all(data, muscles, delay_s, options.sharing);
  for (int round = 0; round < options.max_rounds; ++round) {
    options.force.estimator.progress.check();
    loop.fit = identify_force(data, options.force);
    const std::vector<MuscleValues> found = values_of(data, loop.fit);
    const Change change = change_of(data.muscles, muscles, found);
    muscles = found;
    delay_s = found_delay(loop.fit, delay_s);
    shared = share_all(data, muscles, delay_s, options.sharing);
    loop.rounds.push_back(round_of(change, shared));
    options.force.estimator.progress.tell(
        static_cast<double>(round + 1) / options.max_rounds,
        fmt::format("round {}: {} changes by {:.2g}", round + 1, change.where, change.size));
    if (!std::isfinite(change.size) || growing(loop.rounds)) {
      loop.end = LoopEnd::diverged;
      break;
    }
    if (change.size < options.tolerance) {
      loop.end = LoopEnd::converged;
      break;
    }
  }
  loop.forces = std::move(shared.trials);
  const ForceLoopRound& last = loop.rounds.back();
  const std::string bounds = bounds_reached(loop.fit);
  const auto count = loop.rounds.size();
  switch (loop.end) {
    case LoopEnd::converged:
      loop.message = fmt::format("forces and parameters agree after {} rounds", count);
      break;
    case LoopEnd::diverged:
      loop.message = fmt::format(
          "forces and parameters drive each other away: {} changed by {:.2g} in round {}, more than in each of the "
          "rounds before; do not use these numbers",
          last.parameter, last.parameter_change, count);
      break;
    case LoopEnd::not_settled:
      loop.message =
          fmt::format("forces and parameters had not settled after {} rounds: {} still changes by {:.2g} a round",
                      count, last.parameter, last.parameter_change);
      break;
  }
  if (!bounds.empty()) loop.message += "; at a bound: " + bounds;
  return loop;
}

}  // namespace myoid::identification
