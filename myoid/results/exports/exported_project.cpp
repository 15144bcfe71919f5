#include "myoid/results/exports/exported_project.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/osim/muscle_laws.h"
#include "myoid/fit/measurement/parameters.h"
#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/name_ids.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/results/exports/exported_curves.h"
#include "myoid/run/effort_prior.h"
#include "myoid/run/quality_gates.h"
#include "myoid/study/study_model.h"

namespace myoid::results {
namespace {

using fit::MuscleValues;
using opensim::MuscleQuantity;
using opensim::Project;
using opensim::ProjectMuscle;

constexpr double kRtSpeed = 10.0;           // [optimal fiber lengths / s], of CEINMS-RT
constexpr double kShortestTendon_m = 1e-6;  // other programs divide by the slack length
constexpr double kNegligible = 1e-3;        // of F_max
constexpr std::size_t kNamed = 8;           // muscles that a remark names
constexpr Eigen::Index kMostLevels = 400;   // of an envelope, for the match of activations

/// A number that a file holds once for all muscles.
struct SharedNumber {
  std::string_view name;
  int field;
  int over;  ///< Field by which it is divided; -1: none.
};
constexpr SharedNumber kShared[] = {
    {"force-length width / l_m0", fit::kWidth, fit::kFiberLength},
    {"V_sh", fit::kCurvature, -1},
    {"V_sh V_shl", fit::kProduct, -1},
    {"V_ml", fit::kPlateau, -1},
    {"v_max / l_m0 [1/s]", fit::kSpeed, fit::kFiberLength},
    {"passive force", fit::kPassiveForce, -1},
    {"passive strain", fit::kPassiveStrain, -1},
    {"passive shape", fit::kPassiveShape, -1},
    {"length-activation gamma", fit::kLengthActivation, -1},
    {"tendon strain", fit::kTendonStrain, -1},
};

double number_of(const SharedNumber& number, const MuscleValues& values) {
  const double value = values[static_cast<std::size_t>(number.field)];
  return number.over < 0 ? value : value / values[static_cast<std::size_t>(number.over)];
}

/// Returns "BIC 5.9 (trial lift, 1.25 s)"; of a muscle that never differs "BIC 0".
std::string percent_text(const LawDifference& difference) {
  const double percent = 100.0 * difference.of_max_force;
  std::string text = fmt::format("{} {:.{}f}", difference.muscle, percent, percent < 10.0 && percent > 0.0 ? 1 : 0);
  if (!difference.trial.empty()) text += fmt::format(" (trial {}, {:.2f} s)", difference.trial, difference.time_s);
  return text;
}

class Exporter {
 public:
  Exporter(const run::StudyResult& result, const fit::IdentificationResult& fit, ExportFormat format)
      : result_(result), data_(result.fit_input.data), fit_(fit), format_(format) {
    const fit::ParameterMap map(data_, result.fit_input.options);
    for (std::size_t m = 0; m < data_.muscles.size(); ++m) channels_.push_back(map.channel_of_muscle(m));
    exported_.format = format;
  }

  ExportedProject run() {
    Project project;
    project.dialect = is(ExportFormat::ceinms)      ? opensim::Dialect::ceinms
                      : is(ExportFormat::ceinms_rt) ? opensim::Dialect::ceinms_rt
                                                    : opensim::Dialect::nmsm;
    project.is_calibrated = true;
    project.has_mapping = true;
    if (const auto& file = result_.source.study.model.file)
      project.model = std::filesystem::absolute(*file).lexically_normal();
    share_numbers();
    match_muscles();
    if (is(ExportFormat::ceinms_rt)) share_delay();
    if (!is(ExportFormat::osimx)) set_law(project);
    set_muscles(project);
    set_dofs(project);
    without_blanks(project);
    exported_.project = std::move(project);
    exported_.differences = law_differences(data_, fit_, channels_, theirs_, format_);
    tell();
    return std::move(exported_);
  }

 private:
  [[nodiscard]] bool is(ExportFormat format) const { return format_ == format; }

  /// Takes the means of the numbers that all muscles share, weighted by F_max.
  void share_numbers() {
    for (std::size_t k = 0; k < std::size(kShared); ++k) {
      double sum = 0.0, weights = 0.0;
      for (const MuscleValues& values : fit_.values.muscles) {
        sum += values[fit::kMaxForce] * number_of(kShared[k], values);
        weights += values[fit::kMaxForce];
      }
      shared_[k] = sum / weights;
    }
  }

  /// Returns true for a number that the format holds once for all muscles.
  [[nodiscard]] bool is_shared(const SharedNumber& number) const {
    if (is(ExportFormat::osimx)) return false;
    return number.field != fit::kSpeed || is(ExportFormat::ceinms_rt);
  }

  /// Returns values with the numbers that all muscles share.
  [[nodiscard]] MuscleValues shared_values(MuscleValues values) const {
    for (std::size_t k = 0; k < std::size(kShared); ++k) {
      if (!is_shared(kShared[k])) continue;
      const double unit = kShared[k].over < 0 ? 1.0 : values[static_cast<std::size_t>(kShared[k].over)];
      values[static_cast<std::size_t>(kShared[k].field)] = shared_[k] * unit;
    }
    if (is(ExportFormat::ceinms_rt)) values[fit::kTendonStrain] = 0.0;
    return values;
  }

  /// Returns values of the envelope of a muscle's channel in all trials, at most kMostLevels.
  [[nodiscard]] std::vector<double> levels(std::size_t m) const {
    Eigen::Index count = 0;
    for (const fit::TrialData& trial : data_.trials) count += trial.activation.sample_count();
    const Eigen::Index stride = std::max<Eigen::Index>(1, count / kMostLevels);
    std::vector<double> values;
    for (const fit::TrialData& trial : data_.trials) {
      const auto column = trial.activation.values().col(trial.activation.index(data_.muscles[m].emg_channel));
      for (Eigen::Index k = 0; k < column.size(); k += stride) values.push_back(std::max(0.0, column[k]));
    }
    return values;
  }

  void match_muscles() {
    rate_hz_ = data_.trials.empty() ? 0.0 : data_.trials.front().activation.mean_rate_hz();
    for (std::size_t m = 0; m < data_.muscles.size(); ++m) {
      const MuscleValues& own = fit_.values.muscles[m];
      const fit::ChannelValues& channel = fit_.values.channels[static_cast<std::size_t>(channels_[m])];
      const std::vector<double> envelope = levels(m);
      ForeignMuscle theirs{.values = shared_values(own)};
      theirs.values[fit::kShare] = 1.0;
      theirs.values[fit::kSlack] = std::max(own[fit::kSlack], kShortestTendon_m);
      if (is(ExportFormat::osimx)) {
        theirs.nmsm = nmsm_numbers(channel, fit_.lag, own[fit::kShare], envelope);
        theirs.values[fit::kPennation] = model_pennation(m);
      } else {
        theirs.ceinms = ceinms_activation(channel, fit_.lag, envelope, rate_hz_);
        theirs.values[fit::kMaxForce] *= own[fit::kShare] * theirs.ceinms.scale;
      }
      theirs_.push_back(theirs);
    }
  }

  /// Gives all muscles the mean delay, weighted by F_max: CEINMS-RT has one for all.
  void share_delay() {
    double sum = 0.0, weights = 0.0;
    for (std::size_t m = 0; m < theirs_.size(); ++m) {
      sum += fit_.values.muscles[m][fit::kMaxForce] * theirs_[m].ceinms.delay_s;
      weights += fit_.values.muscles[m][fit::kMaxForce];
    }
    for (ForeignMuscle& each : theirs_) each.ceinms.delay_s = sum / weights;
  }

  /// Returns the model's muscles that a muscle of the fit stands for; empty without a model.
  [[nodiscard]] std::vector<const body::Muscle*> heads(std::size_t m) const {
    std::vector<const body::Muscle*> found;
    const study::Study& study = result_.source.study;
    if (study.model.is_none()) return found;
    const auto spec = std::ranges::find(study.muscles, data_.muscles[m].name, &study::MuscleSpec::name);
    for (const std::string& name : spec->osim)
      found.push_back(
          &result_.source.model->muscles[static_cast<std::size_t>(result_.source.model->muscle_index(name))]);
    return found;
  }

  [[nodiscard]] double model_pennation(std::size_t m) const {
    const std::vector<const body::Muscle*> of_model = heads(m);
    if (of_model.empty()) return fit_.values.muscles[m][fit::kPennation];
    double sum = 0.0, weights = 0.0;
    for (const body::Muscle* head : of_model) {
      sum += head->properties.max_isometric_force_n * head->properties.pennation_at_optimal_rad;
      weights += head->properties.max_isometric_force_n;
    }
    return sum / weights;
  }

  void set_law(Project& project) const {
    MuscleValues unit = fit_.values.muscles.front();
    unit[fit::kMaxForce] = unit[fit::kFiberLength] = 1.0;
    unit[fit::kPennation] = 0.0;
    for (std::size_t k = 0; k < std::size(kShared); ++k) unit[static_cast<std::size_t>(kShared[k].field)] = shared_[k];
    const bool is_elastic = unit[fit::kTendonStrain] > 0.0 && is(ExportFormat::ceinms);
    const double speed = is(ExportFormat::ceinms_rt) ? unit[fit::kSpeed] / kRtSpeed : 1.0;
    project.curves = exported_curves(unit, speed, is_elastic);
    project.common.percentage_change = unit[fit::kLengthActivation];
    project.common.damping = 0.0;
    if (is(ExportFormat::ceinms)) project.common.delay_s = theirs_.front().ceinms.delay_s;
    project.tendon = is_elastic ? "equilibriumElastic" : "stiff";
    project.activation = "exponential";
  }

  void set_muscles(Project& project) {
    for (std::size_t m = 0; m < data_.muscles.size(); ++m) {
      const std::vector<const body::Muscle*> of_model = heads(m);
      if (of_model.size() > 1) {
        for (const body::Muscle* head : of_model) project.muscles.push_back(muscle(m, *head));
      } else {
        const muscle::HillParameters<double>& start = data_.muscles[m].start;
        project.muscles.push_back(muscle(m, of_model.empty() ? data_.muscles[m].name : of_model.front()->name, start));
      }
      names_.insert(names_.end(), std::max<std::size_t>(1, of_model.size()), m);
    }
  }

  [[nodiscard]] ProjectMuscle muscle(std::size_t m, const body::Muscle& head) const {
    return muscle(m, head.name, body::hill_parameters(head.properties));
  }

  /// Returns one muscle that begins at these numbers and changes in proportion to the fit's.
  [[nodiscard]] ProjectMuscle muscle(std::size_t m,
                                     const std::string& name,
                                     const muscle::HillParameters<double>& start) const {
    const muscle::HillParameters<double>& group = data_.muscles[m].start;
    const MuscleValues& own = fit_.values.muscles[m];
    const ForeignMuscle& theirs = theirs_[m];
    ProjectMuscle found{name, {}, {{data_.muscles[m].emg_channel, 1.0}}};
    if (data_.muscles[m].unseen) found.inputs.clear();
    const auto set = [&](MuscleQuantity quantity, double value, double before) {
      found.numbers[quantity] = {.value = value, .start = before};
    };
    const auto changed = [&](double of_head, double of_group, double identified) {
      return of_group > 0.0 ? of_head * (identified / of_group) : identified;
    };
    const double before_slack = std::max(start.tendon_slack_length_m, kShortestTendon_m);
    set(MuscleQuantity::optimal_fiber_length,
        changed(start.optimal_fiber_length_m, group.optimal_fiber_length_m, own[fit::kFiberLength]),
        start.optimal_fiber_length_m);
    set(MuscleQuantity::tendon_slack_length,
        std::max(changed(start.tendon_slack_length_m, group.tendon_slack_length_m, own[fit::kSlack]),
                 kShortestTendon_m),
        before_slack);
    if (is(ExportFormat::osimx)) {
      set(MuscleQuantity::max_isometric_force,
          changed(start.max_isometric_force_n, group.max_isometric_force_n, own[fit::kMaxForce]),
          start.max_isometric_force_n);
      set(MuscleQuantity::delay, theirs.nmsm.delay_s, theirs.nmsm.delay_s);
      set(MuscleQuantity::activation_time, theirs.nmsm.time_constant_s, theirs.nmsm.time_constant_s);
      set(MuscleQuantity::activation_nonlinearity, theirs.nmsm.nonlinearity, 0.0);
      set(MuscleQuantity::emg_scale, theirs.nmsm.emg_scale, 1.0);
      return found;
    }
    set(MuscleQuantity::c1, theirs.ceinms.c1, theirs.ceinms.c1);
    set(MuscleQuantity::c2, theirs.ceinms.c2, theirs.ceinms.c2);
    set(MuscleQuantity::shape_factor, theirs.ceinms.shape_factor, theirs.ceinms.shape_factor);
    set(MuscleQuantity::pennation_angle, own[fit::kPennation], data_.muscles[m].extras.pennation_angle_rad);
    set(MuscleQuantity::max_isometric_force, start.max_isometric_force_n, start.max_isometric_force_n);
    set(MuscleQuantity::strength_coefficient, theirs.values[fit::kMaxForce] / group.max_isometric_force_n, 1.0);
    if (is(ExportFormat::ceinms)) {
      set(MuscleQuantity::delay, theirs.ceinms.delay_s, theirs.ceinms.delay_s);
      set(MuscleQuantity::max_contraction_velocity, own[fit::kSpeed] / own[fit::kFiberLength],
          group.max_shortening_speed_mps / group.optimal_fiber_length_m);
    }
    return found;
  }

  /// Adds each joint with the muscles that have a moment arm about it.
  void set_dofs(Project& project) const {
    constexpr double kLeastArm_m = 1e-6;
    for (const std::string& joint : fit::joint_names(data_)) {
      std::vector<bool> acts(data_.muscles.size(), false);
      for (const fit::TrialData& trial : data_.trials) {
        for (std::size_t j = 0; j < fit::joint_count(trial); ++j) {
          const fit::JointData& data = fit::joint_at(trial, j);
          if (data.joint != joint || data.moment_arm_m.rows() == 0) continue;
          for (std::size_t m = 0; m < acts.size(); ++m)
            if (data.moment_arm_m.col(static_cast<Eigen::Index>(m)).cwiseAbs().maxCoeff() > kLeastArm_m) acts[m] = true;
        }
      }
      opensim::ProjectDof dof{joint, {}, true};
      for (std::size_t k = 0; k < project.muscles.size(); ++k)
        if (acts[names_[k]]) dof.muscles.push_back(project.muscles[k].name);
      project.dofs.push_back(std::move(dof));
    }
  }

  /// Gives muscles ids in the place of names if one has blanks, which lists of names in these files separate.
  void without_blanks(Project& project) {
    std::vector<std::string> names;
    for (const ProjectMuscle& each : project.muscles) names.push_back(each.name);
    if (std::ranges::all_of(names, [](const std::string& name) { return split_words(name).size() == 1; })) return;
    const NameIds ids(names, IdFor::file, {});
    for (ProjectMuscle& each : project.muscles) each.name = ids.of(each.name);
    for (opensim::ProjectDof& dof : project.dofs)
      for (std::string& name : dof.muscles) name = ids.of(name);
    note("names of muscles with blanks become {}",
         name_list(project.muscles, [](const ProjectMuscle& each) { return each.name; }));
  }

  template <typename... Values>
  void note(fmt::format_string<Values...> text, Values&&... values) {
    add(Severity::note, fmt::format(text, std::forward<Values>(values)...));
  }
  void add(Severity severity, const std::string& text, std::optional<double> value = {}) {
    exported_.remarks.push_back({.severity = severity,
                                 .about = std::string(choice_name(format_)),
                                 .value = value,
                                 .says = fmt::format("{}: {}", choice_name(format_), text)});
  }

  void tell() {
    tell_differences();
    tell_program();
    std::size_t unsure = 0, all = 0;
    for (const fit::ParameterEstimate& e : fit_.estimates) {
      if (std::ranges::find(data_.muscles, e.muscle, &fit::MuscleSetup::name) == data_.muscles.end()) continue;
      if (!std::ranges::any_of(muscle::kHillFields, [&](const auto& field) { return field.name == e.parameter; }))
        continue;
      ++all;
      if (e.verdict != fit::Verdict::identified) ++unsure;
    }
    if (unsure > 0)
      note(
          "{} of {} of the muscles are not identified; the file holds them too, because they predict the torque "
          "together",
          unsure, counted(all, "number"));
    if (!run::from_maximal_effort(result_.source.study.emg))
      note("no trial is a maximal contraction: forces are those at the greatest recorded effort");
  }

  void tell_differences() {
    std::vector<LawDifference> sorted = exported_.differences;
    std::ranges::sort(sorted, std::ranges::greater{}, &LawDifference::of_max_force);
    if (sorted.empty() || sorted.front().of_max_force <= kNegligible) return;
    std::string text =
        "its law differs from ours; greatest difference of force over the recorded samples, in % of F_max:";
    for (std::size_t k = 0; k < std::min(sorted.size(), kNamed); ++k)
      text += (k == 0 ? " " : ", ") + percent_text(sorted[k]);
    if (sorted.size() > kNamed) text += fmt::format(" and less in {} more", sorted.size() - kNamed);
    const std::string causes = shared_causes();
    if (!causes.empty()) text += fmt::format("; all muscles share {}", causes);
    add(Severity::warning, text, sorted.front().of_max_force);
  }

  /// Returns "V_sh 0.31 (0.25 to 0.4)" for each number that differs between muscles and is shared.
  [[nodiscard]] std::string shared_causes() const {
    std::vector<std::string> causes;
    for (std::size_t k = 0; k < std::size(kShared); ++k) {
      if (!is_shared(kShared[k])) continue;
      double low = shared_[k], high = shared_[k];
      for (const MuscleValues& values : fit_.values.muscles) {
        low = std::min(low, number_of(kShared[k], values));
        high = std::max(high, number_of(kShared[k], values));
      }
      constexpr double kRounding = 1e-9;
      if (high - low <= kRounding * std::abs(shared_[k])) continue;
      causes.push_back(fmt::format("{} {:.3g} ({:.3g} to {:.3g})", kShared[k].name, shared_[k], low, high));
    }
    return name_list(causes);
  }

  /// Tells what stands in other files of the program.
  void tell_program() {
    const bool has_lags = theirs_.front().ceinms.c1 != 0.0 || theirs_.front().ceinms.c2 != 0.0;
    if (is(ExportFormat::ceinms))
      note("run it with <tendon><{}/></tendon> and <activation><exponential/></activation>", exported_.project->tendon);
    if (is(ExportFormat::ceinms_rt))
      note("run it with a stiff tendon, and with a delay of {:.1f} ms, which stands in no subject",
           1e3 * theirs_.front().ceinms.delay_s);
    if (!is(ExportFormat::osimx) && has_lags) note("c1 and c2 hold for EMG of {:.5g} Hz", rate_hz_);
    if (is(ExportFormat::osimx)) note("its pennation angles and v_max are those of the model and of the settings");
    if (result_.source.study.model.is_none() || !result_.source.study.model.file)
      note("the file names no OpenSim model: the study has none");
    if (std::ranges::any_of(fit_.values.muscles,
                            [](const MuscleValues& values) { return values[fit::kSlack] < kShortestTendon_m; }))
      note("tendon slack lengths of 0 become {} m", kShortestTendon_m);
  }

  const run::StudyResult& result_;
  const fit::StudyData& data_;
  const fit::IdentificationResult& fit_;
  ExportFormat format_;
  std::vector<int> channels_;
  double shared_[std::size(kShared)] = {};
  std::vector<ForeignMuscle> theirs_;
  std::vector<std::size_t> names_;  ///< Muscle of the fit, of each muscle of the project.
  double rate_hz_ = 0.0;
  ExportedProject exported_;
};

}  // namespace

ExportedProject exported_project(const run::StudyResult& result, ExportFormat format) {
  const fit::IdentificationResult* fit = run::best_method(result.fit);
  const auto nothing = [&](std::string_view why) {
    ExportedProject none{.format = format};
    none.remarks.push_back({.code = RemarkCode::refused,
                            .about = std::string(choice_name(format)),
                            .says = fmt::format("{}: nothing is written: {}", choice_name(format), why)});
    return none;
  };
  if (fit == nullptr) return nothing("method torque or force expected, found paper alone");
  if (run::motion_is_unreliable(result.source.study, result.trials))
    return nothing("a quality gate of the motion failed");
  return Exporter(result, *fit, format).run();
}

std::vector<ExportedProject> exported_projects(const run::StudyResult& result,
                                               const std::vector<ExportFormat>& formats) {
  std::vector<ExportedProject> exported;
  for (const ExportFormat format : formats) {
    if (format == ExportFormat::osim) continue;
    if (std::ranges::find(exported, format, &ExportedProject::format) != exported.end()) continue;
    exported.push_back(exported_project(result, format));
  }
  return exported;
}

std::vector<Remark> remarks_of(const std::vector<ExportedProject>& exported) {
  std::vector<Remark> all;
  for (const ExportedProject& each : exported) all.insert(all.end(), each.remarks.begin(), each.remarks.end());
  return all;
}

}  // namespace myoid::results
