#include "myoid/results/review/second_opinion.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "myoid/fit/measurement/nuisances.h"
#include "myoid/opensim/projects/ceinms_law.h"
#include "myoid/recording/series_file.h"
#include "myoid/results/review/project_study.h"
#include "myoid/study/intake/given_stages.h"

namespace myoid::results {
namespace {

using Eigen::Index;
using opensim::MuscleQuantity;
using opensim::Project;
using opensim::ProjectDof;
using opensim::ProjectMuscle;
using opensim::ProjectNumber;
using opensim::ProjectTrial;

const ProjectNumber* number_of(const ProjectMuscle& muscle, MuscleQuantity quantity) {
  const auto at = muscle.numbers.find(quantity);
  return at == muscle.numbers.end() ? nullptr : &at->second;
}

double value_of(const ProjectMuscle& muscle, MuscleQuantity quantity, double absent) {
  const ProjectNumber* number = number_of(muscle, quantity);
  return number == nullptr ? absent : number->value;
}

double strength_of(const ProjectMuscle& muscle) {
  return value_of(muscle, MuscleQuantity::max_isometric_force, 0.0) *
         value_of(muscle, MuscleQuantity::strength_coefficient, 1.0);
}

/// The quantities of a project that are one parameter of a study: a product.
struct Pairing {
  const char* parameter;
  std::vector<MuscleQuantity> quantities;
  bool adds;  ///< Numbers of lumped muscles add; else they are averaged by strength.
};
const std::vector<Pairing>& pairings() {
  static const std::vector<Pairing> all{
      {"max_isometric_force", {MuscleQuantity::max_isometric_force, MuscleQuantity::strength_coefficient}, true},
      {"optimal_fiber_length", {MuscleQuantity::optimal_fiber_length}, false},
      {"tendon_slack_length", {MuscleQuantity::tendon_slack_length}, false},
      {"max_shortening_speed", {MuscleQuantity::max_contraction_velocity, MuscleQuantity::optimal_fiber_length}, false},
  };
  return all;
}

/// A product of numbers over muscles that act as one.
struct Combined {
  double value = 0.0;
  std::optional<double> start;
  std::size_t on_bound = 0;
};

/// Returns the number of muscles that act as one; empty if a muscle lacks it.
std::optional<Combined> combined(const std::vector<const ProjectMuscle*>& muscles, const Pairing& pairing) {
  Combined sum;
  double start = 0.0, weights = 0.0;
  bool has_start = false;
  for (const ProjectMuscle* muscle : muscles) {
    double value = 1.0, before = 1.0;
    bool on_bound = false;
    for (const MuscleQuantity quantity : pairing.quantities) {
      const ProjectNumber* number = number_of(*muscle, quantity);
      if (number == nullptr && quantity == MuscleQuantity::strength_coefficient) continue;
      if (number == nullptr) return std::nullopt;
      value *= number->value;
      before *= number->start.value_or(number->value);
      has_start = has_start || number->start.has_value();
      on_bound = on_bound || number->is_on_bound();
    }
    const double weight = pairing.adds ? 1.0 : std::max(strength_of(*muscle), 1e-9);
    sum.value += weight * value;
    start += weight * before;
    weights += weight;
    sum.on_bound += on_bound ? 1 : 0;
  }
  const double share = pairing.adds ? 1.0 : weights;
  sum.value /= share;
  if (has_start) sum.start = start / share;
  return sum;
}

Standing standing_of(const fit::ParameterEstimate& e, double theirs) {
  if (e.verdict == fit::Verdict::prior_dominated || e.verdict == fit::Verdict::not_identifiable ||
      e.verdict == fit::Verdict::non_physical || !e.ci_low || !e.ci_high)
    return Standing::untold;
  return theirs >= *e.ci_low && theirs <= *e.ci_high ? Standing::agrees : Standing::differs;
}

std::vector<ReviewedNumber> numbers_of(const Project& project, const run::StudyResult& study) {
  std::vector<ReviewedNumber> numbers;
  const fit::IdentificationResult* method = run::torque_of(study.fit);
  if (method == nullptr) return numbers;
  for (const study::MuscleSpec& spec : study.source.study.muscles) {
    std::vector<const ProjectMuscle*> muscles;
    for (const std::string& name : muscles_of(spec))
      if (const ProjectMuscle* muscle = project.find(name)) muscles.push_back(muscle);
    for (const Pairing& pairing : pairings()) {
      const auto e = std::ranges::find_if(method->estimates, [&](const fit::ParameterEstimate& each) {
        return each.muscle == spec.name && each.parameter == pairing.parameter;
      });
      const std::optional<Combined> theirs = combined(muscles, pairing);
      if (e == method->estimates.end() || !theirs || muscles.empty()) continue;
      numbers.push_back({.muscle = spec.name,
                         .lumped = muscles.size(),
                         .theirs = theirs->value,
                         .start = theirs->start,
                         .on_bound = theirs->on_bound,
                         .ours = *e,
                         .standing = standing_of(*e, theirs->value)});
    }
  }
  return numbers;
}

const ProjectTrial* trial_named(const Project& project, const std::string& name) {
  const auto at = std::ranges::find(project.trials, name, &ProjectTrial::name);
  return at == project.trials.end() ? nullptr : &*at;
}

/// Lengths and moment arms of all muscles about one joint, on the clock of its torque. A study without a model has the
/// paths of its own muscles only; the project's files have those without EMG, too.
struct JointPaths {
  TimeSeries length, arm;  ///< Empty: unknown.
};

TimeSeries on_clock(const std::filesystem::path& file, const Eigen::VectorXd& time_s) {
  const TimeSeries whole = recording::read_series(file).data;
  return {time_s, whole.channels(), study::values_at(whole, time_s)};
}

JointPaths paths_of(const run::TrialResult& trial, const SecondOpinion& opinion, const std::string& joint) {
  const study::GivenSpec& given = trial.spec.given;
  if (given.lengths) {
    const Eigen::VectorXd& time_s = trial.forces.muscle_torque.time_s();
    const auto at = static_cast<std::size_t>(std::ranges::find(opinion.joints, joint) - opinion.joints.begin());
    if (at >= given.moment_arms.size()) return {};
    return {on_clock(*given.lengths, time_s), on_clock(given.moment_arms[at], time_s)};
  }
  const auto arm = trial.forces.muscles.moment_arm.find(joint);
  if (arm == trial.forces.muscles.moment_arm.end()) return {};
  return {trial.forces.muscles.length, arm->second};
}

/// Returns the muscles of a joint that the paths have, too.
std::vector<std::string> muscles_of_joint(const Project& project, const std::string& joint, const JointPaths& paths) {
  std::vector<std::string> names;
  const auto dof = std::ranges::find(project.dofs, joint, &ProjectDof::name);
  for (const ProjectMuscle& muscle : project.muscles) {
    const bool acts = dof->muscles.empty() || std::ranges::find(dof->muscles, muscle.name) != dof->muscles.end();
    if (acts && paths.length.find(muscle.name) && paths.arm.find(muscle.name)) names.push_back(muscle.name);
  }
  return names;
}

void add_their_torque(const Project& project,
                      const ProjectTrial& source,
                      const JointPaths& paths,
                      ReviewedTorque& torque) {
  const auto emg = std::ranges::find(source.files, opensim::TrialRole::emg, &opensim::TrialFile::role);
  const std::vector<std::string> names = muscles_of_joint(project, torque.joint, paths);
  if (emg == source.files.end() || names.empty()) return;
  const TimeSeries force =
      opensim::forces_by_law(project, recording::read_series(emg->path).data, paths.length, names).force;
  torque.theirs_nm = Eigen::VectorXd::Zero(torque.time_s.size());
  for (const std::string& name : names) torque.theirs_nm += force.column(name).cwiseProduct(paths.arm.column(name));
  torque.theirs = fit::score(torque.measured_nm, torque.theirs_nm);
}

void add_our_torque(const std::vector<fit::Fold>& folds, ReviewedTorque& torque) {
  const auto fold = std::ranges::find_if(
      folds, [&](const fit::Fold& each) { return each.trial == torque.trial && each.joint == torque.joint; });
  if (fold == folds.end()) return;
  torque.ours_time_s = fold->time_s;
  torque.ours_nm = fold->predicted_nm;
  torque.ours = fold->identified;
}

std::vector<ReviewedTorque> torques_of(const SecondOpinion& opinion) {
  std::vector<ReviewedTorque> torques;
  for (const run::TrialResult& trial : opinion.study.trials) {
    const ProjectTrial* source = trial_named(opinion.project, trial.spec.name);
    if (source == nullptr || !trial.failure().empty()) continue;
    for (const std::string& joint : opinion.joints) {
      const auto column = trial.forces.muscle_torque.find(joint + "_moment");
      if (!column) continue;
      ReviewedTorque torque{.trial = trial.spec.name, .joint = joint, .is_calibrating = source->is_calibrating};
      torque.time_s = trial.forces.muscle_torque.time_s();
      torque.measured_nm = trial.forces.muscle_torque.values().col(*column);
      if (opinion.no_law.empty()) add_their_torque(opinion.project, *source, paths_of(trial, opinion, joint), torque);
      add_our_torque(opinion.study.folds, torque);
      torques.push_back(std::move(torque));
    }
  }
  return torques;
}

/// Returns the mean moment arm of each muscle over the first trial that has paths [m].
std::map<std::string, double> mean_arms_m(const SecondOpinion& opinion, const std::string& joint) {
  std::map<std::string, double> arms;
  for (const run::TrialResult& trial : opinion.study.trials) {
    if (!trial.failure().empty()) continue;
    const JointPaths paths = paths_of(trial, opinion, joint);
    for (const std::string& name : muscles_of_joint(opinion.project, joint, paths))
      arms.try_emplace(name, paths.arm.column(name).mean());
    if (!arms.empty()) break;
  }
  return arms;
}

std::vector<JointStrength> strengths_of(const SecondOpinion& opinion) {
  std::vector<JointStrength> strengths;
  if (!opinion.project.has_mapping || opinion.study.trials.empty()) return strengths;
  for (const std::string& joint : opinion.joints) {
    const std::map<std::string, double> arms = mean_arms_m(opinion, joint);
    for (const bool positive : {true, false}) {
      JointStrength strength{.joint = joint, .is_positive = positive};
      std::vector<std::pair<double, std::string>> without;
      for (const ProjectMuscle& muscle : opinion.project.muscles) {
        const auto arm = arms.find(muscle.name);
        const double torque = arm == arms.end() ? 0.0 : strength_of(muscle) * arm->second;
        if (torque == 0.0 || (torque > 0.0) != positive) continue;
        strength.all_nm += std::abs(torque);
        if (muscle.inputs.empty()) without.emplace_back(std::abs(torque), muscle.name);
      }
      std::ranges::sort(without, std::ranges::greater{});
      for (const auto& [torque, name] : without) {
        strength.without_emg_nm += torque;
        strength.without_emg.push_back(name);
      }
      if (strength.all_nm > 0.0) strengths.push_back(std::move(strength));
    }
  }
  return strengths;
}

/// Returns the seconds of the trials that the calibration fitted.
double calibrated_seconds(const Project& project) {
  double seconds = 0.0;
  for (const ProjectTrial& trial : project.trials) {
    if (!trial.is_calibrating) continue;
    const auto torques = std::ranges::find(trial.files, opensim::TrialRole::torques, &opensim::TrialFile::role);
    const std::optional<Stretch> whole = torques == trial.files.end() ? std::nullopt : torques->time;
    if (const std::optional<Stretch>& used = trial.used ? trial.used : whole) seconds += used->end_s - used->begin_s;
  }
  return seconds;
}

}  // namespace

SecondOpinion second_opinion(Project project, std::vector<std::string> joints, run::StudyResult study) {
  SecondOpinion opinion{.project = std::move(project), .study = std::move(study), .joints = std::move(joints)};
  opinion.no_law = opensim::missing_of_law(opinion.project);
  opinion.torques = torques_of(opinion);
  opinion.numbers = numbers_of(opinion.project, opinion.study);
  opinion.strengths = strengths_of(opinion);
  for (std::size_t k = 0; k < std::size(opensim::kMuscleQuantityNames); ++k) {
    const opensim::UnknownCount count = unknowns(opinion.project, static_cast<MuscleQuantity>(k));
    opinion.unknowns += count.all;
    opinion.on_bound += count.on_bound;
  }
  opinion.independent_rows =
      calibrated_seconds(opinion.project) / fit::kRow_s * static_cast<double>(opinion.joints.size());
  return opinion;
}

}  // namespace myoid::results
