#include "myoid/fit/measurement/study_data.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/ground/core/error.h"
#include "myoid/muscle/force_velocity.h"

namespace myoid::fit {

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool covers(const std::vector<std::string>& names, std::string_view name) {
  return names.empty() || contains(names, name);
}

std::map<std::string, Prior> literature_priors(const muscle::HillParameters<double>& start) {
  std::map<std::string, Prior> priors;
  for (const muscle::HillField& field : muscle::kHillFields) {
    if (const auto prior = literature_prior(field.name, start.*field.member, start.optimal_fiber_length_m)) {
      priors[std::string(field.name)] = *prior;
    }
  }
  if (start.eccentric_plateau > 1.0) {
    priors["eccentric_slope_ratio"] = {
        .mean = muscle::slope_ratio(start.velocity_law()), .sd = beliefs::kSlopeRatio.sd, .logarithmic = true};
  }
  return priors;
}

std::vector<std::string> unstated_speeds(const StudyData& data, const std::vector<std::string>& wanted) {
  std::vector<std::string> names;
  for (const MuscleSetup& setup : data.muscles) {
    if (covers(wanted, setup.name) && !contains(setup.fixed, "max_shortening_speed")) names.push_back(setup.name);
  }
  return names;
}

void free_speeds(StudyData& data, const std::vector<std::string>& muscles) {
  const muscle::Range usual = muscle::hill_field("max_shortening_speed").bounds;
  std::vector<ParameterRule> rules;
  for (MuscleSetup& setup : data.muscles) {
    if (!contains(muscles, setup.name)) continue;
    ParameterRule rule{.parameter = "max_shortening_speed", .owners = {setup.name}, .free = true, .usual = true};
    // A model's own value may lie outside a person's range; the bounds then lie about this value.
    const double start = setup.start.max_shortening_speed_mps;
    if (!setup.bounds.contains("max_shortening_speed") && (start < usual.lower || start > usual.upper)) {
      rule.lower = start / 3.0;
      rule.upper = 3.0 * start;
    }
    rules.push_back(std::move(rule));
    // The literature's V_sh belongs to its source's v_max. This v_max may differ by its own spread,
    // so the prior of V_sh is wider: ln 0.39 instead of 0.3.
    const auto curvature = setup.priors.find("concentric_curvature");
    const auto speed = setup.priors.find("max_shortening_speed");
    if (curvature != setup.priors.end() && speed != setup.priors.end() && curvature->second.logarithmic &&
        speed->second.logarithmic) {
      curvature->second.sd =
          std::hypot(curvature->second.sd, (1.0 + setup.start.concentric_curvature) * speed->second.sd);
    }
  }
  data.rules.insert(data.rules.begin(), rules.begin(), rules.end());
}

bool measures_fascicles(const StudyData& data, std::size_t muscle) {
  return std::any_of(data.trials.begin(), data.trials.end(), [&](const TrialData& trial) {
    return trial.calibration && trial.fascicle_m.size() > 0 &&
           trial.fascicle_m.col(static_cast<Eigen::Index>(muscle)).array().isFinite().any();
  });
}

std::size_t joint_count(const TrialData& trial) { return 1 + trial.more_joints.size(); }

const JointData& joint_at(const TrialData& trial, std::size_t joint) {
  return joint == 0 ? static_cast<const JointData&>(trial) : trial.more_joints[joint - 1];
}

TrialData of_joint(const TrialData& trial, std::size_t joint) {
  TrialData one = trial;
  one.more_joints.clear();
  static_cast<JointData&>(one) = joint_at(trial, joint);
  return one;
}

TrialData at_rows(const TrialData& trial, const std::vector<Eigen::Index>& rows) {
  TrialData t = trial;
  t.time_s = trial.time_s(rows);
  const auto pick = [&](auto& x) {
    if (x.rows() == trial.time_s.size()) x = x(rows, Eigen::all).eval();
  };
  const auto pick_joint = [&](JointData& of) {
    pick(of.moment_arm_m);
    for (auto* x :
         {&of.torque_nm, &of.angle_rad, &of.velocity_radps, &of.acceleration_radps2, &of.resting_nm, &of.dynamics_nm})
      pick(*x);
  };
  for (Eigen::MatrixXd* x : {&t.length_m, &t.velocity_mps, &t.force_n, &t.fascicle_m}) pick(*x);
  pick_joint(t);
  for (JointData& joint : t.more_joints) pick_joint(joint);
  return t;
}

TrialData part(const TrialData& trial, Eigen::Index first, Eigen::Index count) {
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(count));
  std::iota(rows.begin(), rows.end(), first);
  return at_rows(trial, rows);
}

Eigen::VectorXd resting_torque_nm(const TrialData& trial) {
  if (trial.resting_nm.size() > 0) return trial.resting_nm;
  return Eigen::VectorXd::Zero(trial.time_s.size());
}

std::vector<std::string> joint_names(const StudyData& data) {
  std::vector<std::string> names;
  for (const TrialData& trial : data.trials) {
    for (std::size_t j = 0; j < joint_count(trial); ++j)
      if (!contains(names, joint_at(trial, j).joint)) names.push_back(joint_at(trial, j).joint);
  }
  return names;
}

std::vector<Eigen::Index> included_rows(const TrialData& trial) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < trial.time_s.size(); ++i) {
    const double t = trial.time_s[i];
    const bool excluded = std::any_of(trial.excluded.begin(), trial.excluded.end(),
                                      [t](const Stretch& x) { return t >= x.begin_s && t <= x.end_s; });
    if (!excluded) rows.push_back(i);
  }
  return rows;
}

Eigen::MatrixXd motion_of(const JointData& joint, Eigen::Index n) {
  if (joint.angle_rad.size() != n || joint.velocity_radps.size() != n || joint.acceleration_radps2.size() != n)
    return {};
  Eigen::MatrixXd motion(n, 3);
  motion << joint.angle_rad, joint.velocity_radps, joint.acceleration_radps2;
  return motion;
}

std::vector<std::vector<Eigen::Index>> fitted_stretches(const TrialData& trial,
                                                        double max_rate_hz,
                                                        double longest_delay_s) {
  const Eigen::Index all = trial.time_s.size();
  if (trial.torque_nm.size() != all || trial.moment_arm_m.rows() != all)
    throw InvalidInput(fmt::format("trial '{}' has no torque or no moment arms", trial.name));
  const double begin = trial.time_s[0], end = trial.time_s[all - 1], span = end - begin;
  const double interval = span / static_cast<double>(all - 1);
  const auto stride = std::max<Eigen::Index>(1, std::lround(1.0 / (interval * max_rate_hz)));
  const double edge_s = std::min(0.1, 0.02 * span), reach_s = std::min(longest_delay_s, 0.1 * span);
  const Eigen::VectorXd& clock = trial.activation.time_s();
  std::vector<bool> included(static_cast<std::size_t>(all), false);
  for (const Eigen::Index i : included_rows(trial)) included[static_cast<std::size_t>(i)] = true;
  std::vector<std::vector<Eigen::Index>> found(1);
  for (Eigen::Index i = 0; i < all; i += stride) {
    const double t = trial.time_s[i];
    if (included[static_cast<std::size_t>(i)] && t >= begin + edge_s && t <= end - edge_s &&
        t - reach_s >= clock[0] - 1e-9 && t <= clock[clock.size() - 1] + 1e-9) {
      found.back().push_back(i);
      continue;
    }
    if (!found.back().empty()) found.emplace_back();
  }
  return found;
}

void validate(const StudyData& data) {
  if (data.muscles.empty()) throw InvalidInput("identification: there are no muscles");
  if (data.trials.empty()) throw InvalidInput("identification: there are no trials");
  for (const MuscleSetup& muscle : data.muscles) {
    try {
      muscle::validate(muscle.start);
    } catch (const InvalidInput& error) {
      throw InvalidInput(fmt::format("muscle '{}': {}", muscle.name, error.what()));
    }
    for (const std::string& name : muscle.fixed) (void)muscle::hill_field(name);
  }
  const auto m = static_cast<Eigen::Index>(data.muscles.size());
  for (const TrialData& trial : data.trials) {
    const Eigen::Index n = trial.time_s.size();
    const auto sized = [&](const Eigen::MatrixXd& x) { return x.rows() == n && x.cols() == m; };
    if (n < 2 || !sized(trial.length_m) || !sized(trial.velocity_mps)) {
      throw InvalidInput(
          fmt::format("trial '{}': lengths and velocities must be {} samples x {} muscles", trial.name, n, m));
    }
    if (!trial.length_m.allFinite() || !trial.velocity_mps.allFinite() || !trial.moment_arm_m.allFinite() ||
        !trial.torque_nm.allFinite() || !trial.force_n.allFinite() || !trial.resting_nm.allFinite()) {
      throw InvalidInput(
          fmt::format("trial '{}': a length, velocity, moment arm, torque or force is not a number", trial.name));
    }
    if (trial.fascicle_m.size() > 0 && !sized(trial.fascicle_m))
      throw InvalidInput(
          fmt::format("trial '{}': fascicle lengths must be {} samples x {} muscles or none, found {} x {}", trial.name,
                      n, m, trial.fascicle_m.rows(), trial.fascicle_m.cols()));
    const auto resting_or_none = [n](const Eigen::VectorXd& x) {
      return x.size() == 0 || (x.size() == n && x.allFinite());
    };
    if (!resting_or_none(trial.resting_nm) || !resting_or_none(trial.dynamics_nm))
      throw InvalidInput(fmt::format("trial '{}': a part of the torque must be {} samples or none, found {} and {}",
                                     trial.name, n, trial.resting_nm.size(), trial.dynamics_nm.size()));
    for (const JointData& joint : trial.more_joints) {
      if (joint.torque_nm.size() != n || !sized(joint.moment_arm_m) || !joint.torque_nm.allFinite() ||
          !joint.moment_arm_m.allFinite() || !resting_or_none(joint.resting_nm) ||
          joint.dynamics_nm.size() != trial.dynamics_nm.size() || !resting_or_none(joint.dynamics_nm)) {
        throw InvalidInput(
            fmt::format("trial '{}', joint '{}': torque and moment arms must be {} finite samples x {} muscles",
                        trial.name, joint.joint, n, m));
      }
    }
    require_finite(trial.activation, fmt::format("trial '{}': activation", trial.name));
    for (const MuscleSetup& muscle : data.muscles) {
      (void)trial.activation.index(muscle.emg_channel);
      if (!muscle.unseen) continue;
      for (const std::string& part : muscle.unseen->parts) (void)trial.activation.index(part);
    }
  }
}

}  // namespace myoid::fit
