#include "myoid/fit/measurement/nuisances.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/fit/measurement/parameters.h"

namespace myoid::fit {
namespace {

constexpr double kStrained = 0.5;  // of the greatest EMG
constexpr std::string_view kSpeedName = "max_shortening_speed";

/// Returns true for a rule that frees a parameter, and that neither the study nor the user gives.
bool is_freed_as_usual(const ParameterRule& rule) { return rule.usual && rule.free.value_or(false); }

/// Returns the belief as a rule, with its spread in units of `unit`.
ParameterRule nuisance(const Belief& belief, double unit = 1.0) {
  ParameterRule r;
  r.parameter = belief.name;
  r.free = true;
  r.prior_mean = belief.value;
  r.prior_sd = belief.sd * unit;
  r.usual = true;
  return r;
}

/// A joint's largest moment arm of every muscle, and a flag: all fitted trials have its motion.
struct JointReach {
  Eigen::VectorXd arm_m;
  bool motion = true;
};

void widen(const JointData& of, Eigen::Index samples, JointReach& joint) {
  joint.motion = joint.motion && motion_of(of, samples).size() > 0;
  if (of.moment_arm_m.rows() == 0) return;
  const Eigen::VectorXd here = of.moment_arm_m.cwiseAbs().colwise().maxCoeff().transpose();
  joint.arm_m = joint.arm_m.size() == 0 ? here : Eigen::VectorXd(joint.arm_m.cwiseMax(here));
}

/// Returns the EMG channels that exceed kStrained of the maximum in a fitted trial.
std::vector<std::string> strained_channels(const StudyData& data) {
  std::vector<std::string> channels;
  for (const MuscleSetup& muscle : data.muscles) {
    const std::string& channel = muscle.emg_channel;
    if (muscle.unseen || std::ranges::find(channels, channel) != channels.end()) continue;
    const bool strained = std::ranges::any_of(data.trials, [&](const TrialData& trial) {
      return trial.calibration && trial.activation.find(channel) &&
             trial.activation.column(channel).maxCoeff() >= kStrained;
    });
    if (strained) channels.push_back(channel);
  }
  return channels;
}

}  // namespace

std::vector<ParameterRule> nuisance_rules(const StudyData& data, bool exponents) {
  std::vector<ParameterRule> rules{nuisance(beliefs::kLengthActivation)};
  rules.back().tie = true;
  if (exponents) {
    ParameterRule exponent = nuisance(beliefs::kEmgExponent);
    exponent.owners = strained_channels(data);
    if (!exponent.owners.empty()) rules.push_back(std::move(exponent));
  }
  std::map<std::string, JointReach> joints;
  for (const TrialData& trial : data.trials) {
    if (!trial.calibration) continue;
    for (std::size_t j = 0; j < joint_count(trial); ++j)
      widen(joint_at(trial, j), trial.time_s.size(), joints[joint_at(trial, j).joint]);
  }
  for (const auto& [name, joint] : joints) {
    if (joint.arm_m.size() != static_cast<Eigen::Index>(data.muscles.size())) continue;
    double strength_nm = 0.0;
    for (Eigen::Index k = 0; k < joint.arm_m.size(); ++k)
      strength_nm += joint.arm_m[k] * data.muscles[static_cast<std::size_t>(k)].start.max_isometric_force_n;
    for (const Belief* belief : {&beliefs::kStiffnessShare, &beliefs::kOffsetShare, &beliefs::kViscosityShare}) {
      if (belief != &beliefs::kOffsetShare && !joint.motion) continue;
      ParameterRule r = nuisance(*belief, strength_nm);
      r.owners = {name};
      if (strength_nm > 0.0) rules.push_back(std::move(r));
    }
  }
  return rules;
}

bool tells_nuisances(const StudyData& data, const EstimatorOptions& options) {
  double rows = 0.0;
  for (const TrialData& trial : data.trials) {
    if (!trial.calibration) continue;
    const double all = (trial.time_s[trial.time_s.size() - 1] - trial.time_s[0]) / kRow_s;
    const double most = options.unseen.independent_rows > 0.0 ? options.unseen.independent_rows : all;
    rows += static_cast<double>(joint_count(trial)) * std::min(most, all);
  }
  StudyData held = data;
  hold_nuisances(held);
  return rows >= 1.5 * static_cast<double>(ParameterMap(held, options).size());
}

void hold_nuisances(StudyData& data, std::string_view but) {
  std::erase_if(data.rules, [&](const ParameterRule& rule) {
    return is_freed_as_usual(rule) && rule.parameter != but && rule.parameter != kSpeedName;
  });
}

void hold_speeds(StudyData& data) {
  std::erase_if(data.rules,
                [](const ParameterRule& rule) { return is_freed_as_usual(rule) && rule.parameter == kSpeedName; });
}

}  // namespace myoid::fit
