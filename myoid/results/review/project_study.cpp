#include "myoid/results/review/project_study.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/name_ids.h"
#include "myoid/recording/series_file.h"
#include "myoid/run/identify_files/electrode_ties.h"

namespace myoid::results {
namespace {

using opensim::MuscleQuantity;
using opensim::Project;
using opensim::ProjectDof;
using opensim::ProjectInput;
using opensim::ProjectMuscle;
using opensim::ProjectTrial;
using opensim::TrialFile;
using opensim::TrialRole;

/// Passive force of a fiber by Thelen 2003 (J. Biomech. Eng. 125, 70), young adults: F_max at this strain.
constexpr double kPassiveForce = 1.0, kPassiveStrain = 0.6, kPassiveShape = 4.0;

bool acts(const ProjectDof& dof, const std::string& muscle) {
  return std::ranges::find(dof.muscles, muscle) != dof.muscles.end();
}

/// Returns true if a muscle with EMG acts on a joint.
bool has_emg(const Project& project, const ProjectDof& dof) {
  return std::ranges::any_of(
      project.muscles, [&](const ProjectMuscle& muscle) { return !muscle.inputs.empty() && acts(dof, muscle.name); });
}

/// Returns "semimem", or "0.5 vas_lat + 0.5 vas_med".
std::string mixture_name(const std::vector<ProjectInput>& inputs) {
  std::vector<std::string> parts;
  for (const ProjectInput& input : inputs)
    parts.push_back(input.weight == 1.0 ? input.channel : fmt::format("{:.3g} {}", input.weight, input.channel));
  return fmt::format("{}", fmt::join(parts, " + "));
}

const TrialFile* file_of(const ProjectTrial& trial, TrialRole role, const std::string& dof = {}) {
  const auto at = std::ranges::find_if(trial.files, [&](const TrialFile& file) {
    return file.role == role && file.exists && (dof.empty() || file.dof == dof);
  });
  return at == trial.files.end() ? nullptr : &*at;
}

/// Muscles that act as one.
struct Group {
  std::vector<ProjectInput> inputs;
  std::vector<const ProjectMuscle*> muscles;
};

class StudyMaker {
 public:
  StudyMaker(const Project& project, const std::vector<std::string>& joints, std::filesystem::path folder)
      : project_(project), joints_(joints), folder_(std::move(folder)) {}

  ProjectStudy make() {
    study::Study& study = result_.study;
    study.file = folder_ / "study.toml";
    if (joints_.empty()) throw InvalidInput("the project tells no joint on which a muscle with EMG acts");
    for (const std::string& joint : joints_) require_joint(joint);
    study.model.coordinate = joints_.front();
    study.model.more_coordinates.assign(joints_.begin() + 1, joints_.end());
    study.emg.kind = study::EmgKind::envelope;
    study.emg.has_mvc = false;
    study.phases.search = false;
    study.identify.methods = {fit::Method::torque};
    if (project_.model.empty()) {
      study.model.builtin = "none";
      study.identify.elastic_tendon = false;
    } else {
      study.model.file = project_.model;
    }
    for (const Group& group : groups()) add_muscles(group);
    tie();
    if (!study.model.file) add_passive_muscles();
    if (study.muscles.empty())
      throw InvalidInput(
          fmt::format("no muscle of {} has EMG: there is nothing to identify", fmt::join(joints_, ", ")));
    for (const ProjectDof& dof : project_.dofs)
      if (dof.is_calibrated && !dof.muscles.empty() && !has_emg(project_, dof))
        note(Severity::note, dof.name, fmt::format("{} is left out: none of its muscles has EMG", dof.name));
    for (const ProjectTrial& trial : project_.trials) add(trial);
    if (study.trials.empty())
      throw InvalidInput(
          "no trial has EMG, torques, and lengths with moment arms or a motion and a model: nothing can be computed "
          "again");
    if (std::ranges::count(study.trials, study::Use::calibration, &study::TrialSpec::use) < 2)
      study.identify.folds = fit::FoldKind::block;
    mix_emg();
    return std::move(result_);
  }

 private:
  void note(Severity severity, const std::string& where, std::string says) {
    result_.remarks.push_back(
        {.code = RemarkCode::reading, .severity = severity, .where = where, .about = {}, .says = std::move(says)});
  }

  void require_joint(const std::string& joint) const {
    if (std::ranges::find(project_.dofs, joint, &ProjectDof::name) != project_.dofs.end()) return;
    std::vector<std::string> names;
    for (const ProjectDof& dof : project_.dofs) names.push_back(dof.name);
    throw InvalidInput(fmt::format("the project has no joint '{}', found {}", joint, fmt::join(names, ", ")));
  }

  /// Returns the joints of the study that a muscle acts on, as flags.
  [[nodiscard]] std::vector<bool> joints_of(const std::string& muscle) const {
    std::vector<bool> flags;
    for (const std::string& joint : joints_) {
      const auto dof = std::ranges::find(project_.dofs, joint, &ProjectDof::name);
      // A project that does not say which muscles act on a joint leaves that to the model.
      flags.push_back(dof->muscles.empty() || acts(*dof, muscle));
    }
    return flags;
  }

  [[nodiscard]] std::vector<Group> groups() const {
    std::map<std::pair<std::string, std::vector<bool>>, std::size_t> at;
    std::vector<Group> groups;
    for (const ProjectMuscle& muscle : project_.muscles) {
      std::vector<bool> joints = joints_of(muscle.name);
      if (muscle.inputs.empty() || std::ranges::find(joints, true) == joints.end()) continue;
      const auto [place, is_new] = at.try_emplace({mixture_name(muscle.inputs), std::move(joints)}, groups.size());
      if (is_new) groups.push_back({.inputs = muscle.inputs, .muscles = {}});
      groups[place->second].muscles.push_back(&muscle);
    }
    return groups;
  }

  void add_muscles(const Group& group) {
    const std::string channel = mixture_name(group.inputs);
    is_mixed_ = is_mixed_ || group.inputs.size() > 1 || group.inputs.front().weight != 1.0;
    mixtures_.insert_or_assign(channel, group.inputs);
    if (group.muscles.size() > 1 && result_.study.model.file) {
      study::MuscleSpec lumped{
          .name = fmt::format("{} and {} more of {}", group.muscles.front()->name, group.muscles.size() - 1, channel),
          .osim = {},
          .emg = channel,
          .same_as = {},
          .start = {},
          .fixed = {}};
      for (const ProjectMuscle* muscle : group.muscles) lumped.osim.push_back(muscle->name);
      result_.study.muscles.push_back(std::move(lumped));
      return;
    }
    for (const ProjectMuscle* muscle : group.muscles)
      result_.study.muscles.push_back({.name = muscle->name,
                                       .osim = {muscle->name},
                                       .emg = channel,
                                       .same_as = {},
                                       .start = starts_of(*muscle),
                                       .fixed = {}});
  }

  void set(const char* parameter, std::vector<std::string> owners, double value) {
    fit::ParameterRule rule;
    rule.parameter = parameter;
    rule.owners = std::move(owners);
    rule.value = value;
    result_.study.parameters.push_back(std::move(rule));
  }

  /// Without a model gives the muscles the subject's pennation and the passive force of OpenSim's muscles.
  void add_passive_muscles() {
    for (const study::MuscleSpec& spec : result_.study.muscles) {
      const ProjectMuscle* muscle = project_.find(spec.name);
      const auto pennation = muscle->numbers.find(MuscleQuantity::pennation_angle);
      if (pennation != muscle->numbers.end()) set("pennation_angle", {spec.name}, pennation->second.value);
    }
    set("passive_force", {}, kPassiveForce);
    set("passive_strain", {}, kPassiveStrain);
    set("passive_shape", {}, kPassiveShape);
  }

  /// Gives muscles of one electrode one scale of each parameter.
  void tie() {
    std::vector<fit::MuscleSetup> muscles;
    for (const study::MuscleSpec& muscle : result_.study.muscles) {
      fit::MuscleSetup& setup = muscles.emplace_back();
      setup.name = muscle.name;
      setup.emg_channel = muscle.emg;
    }
    result_.study.parameters = run::electrode_ties(muscles).rules;
  }

  static std::map<std::string, double> starts_of(const ProjectMuscle& muscle) {
    const auto start = [&](MuscleQuantity quantity) -> std::optional<double> {
      const auto at = muscle.numbers.find(quantity);
      if (at == muscle.numbers.end()) return std::nullopt;
      return at->second.start.value_or(at->second.value);
    };
    std::map<std::string, double> starts;
    // Without the coefficient, by which a calibration fits the person: the prior is about the model's muscle.
    if (const auto force = start(MuscleQuantity::max_isometric_force)) starts["max_isometric_force"] = *force;
    const auto length = start(MuscleQuantity::optimal_fiber_length);
    if (length) starts["optimal_fiber_length"] = *length;
    if (const auto slack = start(MuscleQuantity::tendon_slack_length)) starts["tendon_slack_length"] = *slack;
    const auto speed = start(MuscleQuantity::max_contraction_velocity);
    if (length && speed) starts["max_shortening_speed"] = *length * *speed;
    return starts;
  }

  /// Adds a trial, or says why it cannot be used.
  void add(const ProjectTrial& trial) {
    study::TrialSpec spec;
    spec.name = trial.name;
    const TrialFile* emg = file_of(trial, TrialRole::emg);
    const TrialFile* torques = file_of(trial, TrialRole::torques);
    if (emg == nullptr || torques == nullptr)
      return note(Severity::note, trial.name, emg == nullptr ? "left out: no EMG" : "left out: no torques");
    spec.emg = emg->path;
    spec.given.torques = torques->path;
    const TrialFile* lengths = file_of(trial, TrialRole::lengths);
    bool is_given = lengths != nullptr;
    for (const std::string& joint : joints_) {
      const TrialFile* arms = file_of(trial, TrialRole::moment_arms, joint);
      is_given = is_given && arms != nullptr;
      if (arms != nullptr) spec.given.moment_arms.push_back(arms->path);
    }
    const TrialFile* motion = file_of(trial, TrialRole::motion);
    if (is_given) {
      spec.given.lengths = lengths->path;
    } else if (motion != nullptr && !project_.model.empty()) {
      spec.given.moment_arms.clear();
      spec.motion = motion->path;
    } else {
      return note(Severity::note, trial.name, "left out: neither lengths with moment arms nor a motion with the model");
    }
    const bool in_seconds = project_.dialect == opensim::Dialect::ceinms || project_.dialect == opensim::Dialect::mrs;
    if (in_seconds && trial.used) {
      // A script of the redundancy solver may name a stretch that goes beyond the recording.
      if (!torques->time || trial.used->begin_s > torques->time->begin_s) spec.start_s = trial.used->begin_s;
      if (!torques->time || trial.used->end_s < torques->time->end_s) spec.end_s = trial.used->end_s;
    }
    if (torques->time) {
      // Two windows of the normalization must fit into a trial, or the trial alone shows no level of rest.
      const double length_s = spec.end_s.value_or(torques->time->end_s) - spec.start_s.value_or(torques->time->begin_s);
      double& window_s = result_.study.emg.normalise_window_s;
      window_s = std::min(window_s, 0.5 * length_s);
    }
    result_.study.trials.push_back(std::move(spec));
  }

  /// Mixes the channels of every trial if a muscle takes a mixture.
  void mix_emg() {
    if (!is_mixed_) return;
    std::vector<std::string> names;
    for (const study::TrialSpec& trial : result_.study.trials) names.push_back(trial.name);
    const std::vector<std::string> ids = ids_of(names);
    for (std::size_t i = 0; i < names.size(); ++i) {
      std::filesystem::path& emg = *result_.study.trials[i].emg;
      const TimeSeries of_file = recording::read_series(emg).data;
      Eigen::MatrixXd values =
          Eigen::MatrixXd::Zero(of_file.sample_count(), static_cast<Eigen::Index>(mixtures_.size()));
      std::vector<Channel> channels;
      for (const auto& [name, inputs] : mixtures_) {
        for (const ProjectInput& input : inputs)
          values.col(static_cast<Eigen::Index>(channels.size())) += input.weight * of_file.column(input.channel);
        channels.push_back({name, Unit::dimensionless});
      }
      emg = folder_ / "emg" / (ids[i] + ".sto");
      result_.mixed.push_back({emg, TimeSeries(of_file.time_s(), std::move(channels), std::move(values))});
    }
    note(Severity::note, "", "muscles that take several EMG channels have a column of their own in emg/");
  }

  const Project& project_;
  const std::vector<std::string>& joints_;
  std::filesystem::path folder_;
  std::map<std::string, std::vector<ProjectInput>> mixtures_;
  bool is_mixed_ = false;
  ProjectStudy result_;
};

}  // namespace

std::vector<std::string> reviewed_joints(const Project& project) {
  std::vector<std::string> fitted, driven;
  for (const ProjectDof& dof : project.dofs) {
    const bool is_driven = has_emg(project, dof);
    if (dof.is_calibrated && (is_driven || dof.muscles.empty())) fitted.push_back(dof.name);
    if (is_driven) driven.push_back(dof.name);
  }
  return fitted.empty() ? driven : fitted;
}

ProjectStudy study_of_project(const Project& project,
                              const std::vector<std::string>& joints,
                              const std::filesystem::path& folder) {
  return StudyMaker(project, joints, folder).make();
}

std::vector<std::string> muscles_of(const study::MuscleSpec& muscle) {
  return muscle.osim.empty() ? std::vector{muscle.name} : muscle.osim;
}

}  // namespace myoid::results
