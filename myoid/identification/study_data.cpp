#include "myoid/identification/study_data.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/identification/envelope.h"
#include "myoid/muscle/force_velocity.h"
#include "myoid/muscle/literature.h"

namespace myoid::identification {

std::map<std::string, Prior> literature_priors(const muscle::HillParameters<double>& start) {
  constexpr double kSlopeRatioSd = 0.5;
  std::map<std::string, Prior> priors;
  for (const muscle::HillField& field : muscle::kHillFields) {
    if (const auto prior = muscle::literature_prior(field.name, start.*field.member,
                                                    start.optimal_fiber_length_m)) {
      priors[std::string(field.name)] = *prior;
    }
  }
  // v_max is held at its start by default. What it spreads by then shows in V_sh: at small speeds
  // only the slope (1 + 1/V_sh) / v_max acts, and d ln V_sh = -(1 + V_sh) d ln v_max along it.
  const auto curvature = priors.find("concentric_curvature");
  const auto speed = priors.find("max_shortening_speed");
  if (curvature != priors.end() && speed != priors.end()) {
    curvature->second.sd =
        std::hypot(curvature->second.sd, (1.0 + start.concentric_curvature) * speed->second.sd);
  }
  if (start.eccentric_plateau > 1.0) {
    priors["eccentric_slope_ratio"] = {.mean = muscle::slope_ratio(start.velocity_shape()),
                                       .sd = kSlopeRatioSd,
                                       .logarithmic = true};
  }
  return priors;
}

std::size_t joint_count(const TrialData& trial) { return 1 + trial.more_joints.size(); }

TrialData of_joint(const TrialData& trial, std::size_t joint) {
  TrialData one = trial;
  one.more_joints.clear();
  if (joint == 0) return one;
  const JointData& of = trial.more_joints[joint - 1];
  one.joint = of.name;
  one.torque_nm = of.torque_nm;
  one.moment_arm_m = of.moment_arm_m;
  one.angle_rad = of.angle_rad;
  one.velocity_radps = of.velocity_radps;
  one.acceleration_radps2 = of.acceleration_radps2;
  one.resting_nm = of.resting_nm;
  return one;
}

TrialData part(const TrialData& trial, Eigen::Index first, Eigen::Index count) {
  TrialData t = trial;
  t.time_s = trial.time_s.segment(first, count);
  t.length_m = trial.length_m.middleRows(first, count);
  t.velocity_mps = trial.velocity_mps.middleRows(first, count);
  t.moment_arm_m = trial.moment_arm_m.middleRows(first, count);
  t.torque_nm = trial.torque_nm.segment(first, count);
  if (trial.force_n.rows() == trial.time_s.size())
    t.force_n = trial.force_n.middleRows(first, count);
  const auto cut = [&](Eigen::VectorXd& x) {
    if (x.size() == trial.time_s.size()) x = x.segment(first, count).eval();
  };
  cut(t.angle_rad);
  cut(t.velocity_radps);
  cut(t.acceleration_radps2);
  cut(t.resting_nm);
  for (JointData& joint : t.more_joints) {
    cut(joint.torque_nm);
    cut(joint.angle_rad);
    cut(joint.velocity_radps);
    cut(joint.acceleration_radps2);
    cut(joint.resting_nm);
    joint.moment_arm_m = joint.moment_arm_m.middleRows(first, count).eval();
  }
  return t;
}

Eigen::VectorXd resting_torque_nm(const TrialData& trial) {
  if (trial.resting_nm.size() > 0) return trial.resting_nm;
  return Eigen::VectorXd::Zero(trial.time_s.size());
}

std::vector<std::string> joint_names(const StudyData& data) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const TrialData& trial : data.trials) {
    add(trial.joint);
    for (const JointData& joint : trial.more_joints) add(joint.name);
  }
  return names;
}

std::vector<Eigen::Index> included_rows(const TrialData& trial) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < trial.time_s.size(); ++i) {
    const double t = trial.time_s[i];
    const bool excluded =
        std::any_of(trial.excluded.begin(), trial.excluded.end(),
                    [t](const Stretch& x) { return t >= x.begin_s && t <= x.end_s; });
    if (!excluded) rows.push_back(i);
  }
  return rows;
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
      throw InvalidInput(fmt::format(
          "trial '{}': lengths and velocities must be {} samples x {} muscles", trial.name, n, m));
    }
    if (!trial.length_m.allFinite() || !trial.velocity_mps.allFinite() ||
        !trial.moment_arm_m.allFinite() || !trial.torque_nm.allFinite() ||
        !trial.force_n.allFinite() || !trial.resting_nm.allFinite()) {
      throw InvalidInput(
          fmt::format("trial '{}': a length, velocity, moment arm, torque or force is not a number",
                      trial.name));
    }
    const auto resting_or_none = [n](const Eigen::VectorXd& x) {
      return x.size() == 0 || (x.size() == n && x.allFinite());
    };
    if (!resting_or_none(trial.resting_nm))
      throw InvalidInput(
          fmt::format("trial '{}': the resting torque must be {} samples or none, "
                      "found {}",
                      trial.name, n, trial.resting_nm.size()));
    for (const JointData& joint : trial.more_joints) {
      if (joint.torque_nm.size() != n || !sized(joint.moment_arm_m) ||
          !joint.torque_nm.allFinite() || !joint.moment_arm_m.allFinite() ||
          !resting_or_none(joint.resting_nm)) {
        throw InvalidInput(fmt::format(
            "trial '{}', joint '{}': torque and moment arms must be {} finite samples x {} muscles",
            trial.name, joint.name, n, m));
      }
    }
    require_finite(trial.activation, fmt::format("trial '{}': activation", trial.name));
    for (const MuscleSetup& muscle : data.muscles) (void)trial.activation.index(muscle.emg_channel);
  }
}

Eigen::MatrixXd muscle_activation(const StudyData& data,
                                  const TrialData& trial,
                                  const Eigen::VectorXd& time_s,
                                  double delay_s,
                                  Eigen::MatrixXd* slope) {
  Eigen::MatrixXd activation(time_s.size(), static_cast<Eigen::Index>(data.muscles.size()));
  if (slope != nullptr) slope->resize(activation.rows(), activation.cols());
  std::map<Eigen::Index, Eigen::Index> done;  // channel -> first muscle that uses it
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const Eigen::Index channel = trial.activation.index(data.muscles[k].emg_channel);
    if (const auto it = done.find(channel); it != done.end()) {
      activation.col(column) = activation.col(it->second);
      if (slope != nullptr) slope->col(column) = slope->col(it->second);
      continue;
    }
    done[channel] = column;
    const Envelope envelope(trial.activation.time_s(), trial.activation.values().col(channel));
    for (Eigen::Index i = 0; i < time_s.size(); ++i) {
      const Envelope::Value value = envelope.at(time_s[i] - delay_s);
      activation(i, column) = value.value;
      if (slope != nullptr) (*slope)(i, column) = value.slope;
    }
  }
  return activation;
}

}  // namespace myoid::identification
