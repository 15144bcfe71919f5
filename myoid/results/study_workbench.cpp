#include "myoid/results/study_workbench.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include <fmt/format.h>

#include "myoid/fit/methods/prediction.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/page/typeset.h"
#include "myoid/results/movable_muscles.h"
#include "myoid/results/norm_bands.h"
#include "myoid/results/prediction_files.h"
#include "myoid/results/study_scene.h"
#include "myoid/run/prediction_gates.h"
#include "myoid/study/study_ids.h"

namespace myoid::results {
namespace {

using fit::IdentificationResult;
using page::Badge;
using page::CarpetRow;
using page::Role;
using page::TimeLine;
using page::TimePlot;
using page::TrialMark;
using page::WorkbenchTrial;

constexpr Eigen::Index kMostSamples = 15000;  // of a plot over all trials
constexpr Eigen::Index kLeastSamples = 250;   // of a plot of one trial
constexpr Eigen::Index kCarpetColumns = 160;
constexpr Eigen::Index kRawColumns = 300;
constexpr Eigen::Index kMostForces = 40;  // of muscles without a fit: the strongest

/// Adds the series of a trial, thinned to the samples that a plot may have.
class TrialPlots {
 public:
  TrialPlots(WorkbenchTrial& trial, std::string folder, Eigen::Index most)
      : trial_(trial), folder_(std::move(folder)), most_(most) {}

  /// Folder of the trial's files, relative to the page.
  [[nodiscard]] const std::string& folder() const { return folder_; }

  /// Returns every k-th value, so that at most `most` are left.
  [[nodiscard]] Eigen::VectorXd thinned(const Eigen::Ref<const Eigen::VectorXd>& values) const {
    const Eigen::Index step = std::max<Eigen::Index>(1, (values.size() + most_ - 1) / most_);
    return values(Eigen::seq(0, Eigen::last, step));
  }

  /// Returns the number of the thinned clock.
  int clock(const Eigen::VectorXd& time_s) { return whole_clock(thinned(time_s)); }

  int whole_clock(const Eigen::VectorXd& time_s) {
    for (std::size_t k = 0; k < trial_.clocks.size(); ++k)
      if (trial_.clocks[k].size() == time_s.size() && trial_.clocks[k] == time_s) return static_cast<int>(k);
    trial_.clocks.push_back(time_s);
    return static_cast<int>(trial_.clocks.size()) - 1;
  }

  [[nodiscard]] TimeLine line(std::string name,
                              Role role,
                              const Eigen::VectorXd& time_s,
                              const Eigen::Ref<const Eigen::VectorXd>& values) {
    return {std::move(name), role, clock(time_s), thinned(values), {}};
  }

  [[nodiscard]] TimeLine band(std::string name,
                              const Eigen::VectorXd& time_s,
                              const Eigen::VectorXd& low,
                              const Eigen::VectorXd& high) {
    return {std::move(name), Role::band, clock(time_s), thinned(low), thinned(high)};
  }

  void add(TimePlot plot) {
    if (!plot.lines.empty()) trial_.plots.push_back(std::move(plot));
  }

 private:
  WorkbenchTrial& trial_;
  std::string folder_;
  Eigen::Index most_;
};

/// Returns the index of the stretch, of `columns` equal ones, that contains a time.
Eigen::Index column_of(double time_s, const Stretch& when, Eigen::Index columns) {
  const double share = (time_s - when.begin_s) / std::max(1e-9, when.end_s - when.begin_s);
  return std::clamp<Eigen::Index>(static_cast<Eigen::Index>(share * static_cast<double>(columns)), 0, columns - 1);
}

/// Returns the greatest value in each stretch; NaN if values are missing.
Eigen::VectorXd greatest(const Eigen::VectorXd& time_s,
                         const Eigen::Ref<const Eigen::VectorXd>& values,
                         const Stretch& when,
                         Eigen::Index columns) {
  constexpr double kUnseen = -kInfinity;
  Eigen::VectorXd result = Eigen::VectorXd::Constant(columns, kUnseen);
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    double& at = result[column_of(time_s[i], when, columns)];
    at = std::isfinite(values[i]) && !std::isnan(at) ? std::max(at, values[i]) : kNan;
  }
  // A stretch shorter than the sampling interval takes the preceding value.
  for (Eigen::Index i = 0; i < columns; ++i) {
    if (result[i] == kUnseen) result[i] = i > 0 ? result[i - 1] : kNan;
  }
  return result;
}

void add_angles(const run::StudyResult& result, const run::TrialResult& trial, TrialPlots& plots) {
  if (!trial.has_motion()) return;
  const TimeSeries& q = trial.motion.joints.q;
  for (const std::string& name : study::study_coordinates(result.source.study.model)) {
    const auto column = q.find(name);
    if (!column) continue;
    plots.add({.kind = "angle",
               .title = page::spelled(name),
               .unit = "deg",
               .lines = {plots.line("angle", Role::reference, q.time_s(), q.values().col(*column) / kDegree)},
               .file = plots.folder() + "/ik.mot"});
  }
}

/// Adds the measured forces on the person, in the frame of their file.
void add_loads(const run::TrialResult& trial, TrialPlots& plots) {
  if (!trial.has_motion() || !trial.input.loads) return;
  const Eigen::VectorXd& t = trial.motion.joints.q.time_s();
  for (const auto& load : trial.input.loads->forces) {
    if (!load.force) continue;
    Eigen::MatrixXd force(t.size(), 3);
    for (Eigen::Index i = 0; i < t.size(); ++i)
      force.row(i) = load.force->at(trial.input.loads->data_time_s(t[i])).transpose();
    TimePlot plot{.kind = "load", .title = load.name, .unit = "N"};
    for (Eigen::Index k = 0; k < 3; ++k)
      plot.lines.push_back(plots.line(std::string(1, "xyz"[k]), Role::reference, t, force.col(k)));
    plots.add(std::move(plot));
  }
}

const fit::Fold* fold_of(const run::StudyResult& result,
                         const std::string& trial,
                         const std::string& joint,
                         Eigen::Index samples) {
  for (const fit::Fold& fold : result.folds)
    if (fold.trial == trial && fold.joint == joint && fold.predicted_nm.size() == samples) return &fold;
  return nullptr;
}

void add_torques(const run::StudyResult& result,
                 const IdentificationResult* fit,
                 const run::TrialResult& trial,
                 TrialPlots& plots) {
  const std::vector<std::string> joints = study::study_coordinates(result.source.study.model);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    TimePlot plot{.kind = "torque",
                  .title = page::spelled(joints[j]),
                  .unit = "N m",
                  .joint = static_cast<int>(j),
                  .file = plots.folder() + "/id.sto"};
    const auto fitted = [&]() -> const fit::TrialFit* {
      if (fit == nullptr) return nullptr;
      for (const fit::TrialFit& t : fit->trials)
        if (t.trial == trial.spec.name && (t.joint == joints[j] || joints.size() == 1)) return &t;
      return nullptr;
    }();
    if (fitted != nullptr) {
      const Eigen::VectorXd& t = fitted->time_s;
      const auto add = [&](const char* name, Role role, const Eigen::VectorXd& torque_nm) {
        if (torque_nm.size() == t.size()) plot.lines.push_back(plots.line(name, role, t, torque_nm));
      };
      add("measured", Role::reference, fitted->torque_nm);
      add("literature", Role::literature, fitted->literature_torque_nm);
      add("identified", Role::identified, fitted->torque_fit_nm);
      const auto* fold = fold_of(result, trial.spec.name, fitted->joint, t.size());
      const Band band = fold != nullptr ? prediction_band(fold->predicted_nm, fold->predicted_sd_nm)
                                        : prediction_band(fitted->torque_fit_nm, fitted->torque_sd_nm);
      if (fold != nullptr) add("left out", Role::unseen, fold->predicted_nm);
      if (band.low.size() == t.size())
        plot.lines.insert(plot.lines.begin(), plots.band("95 % band", t, band.low, band.high));
    } else if (trial.has_motion() && static_cast<Eigen::Index>(j) < trial.forces.muscle_torque.channel_count()) {
      const TimeSeries& torque = trial.forces.muscle_torque;
      plot.lines.push_back(
          plots.line("measured", Role::reference, torque.time_s(), torque.values().col(static_cast<Eigen::Index>(j))));
    }
    plots.add(std::move(plot));
  }
}

/// Adds raw EMG as the least and the greatest value in equal stretches, with the envelope.
void add_emg(const run::TrialResult& trial, TrialPlots& plots) {
  if (trial.emg.stages) {
    const TimeSeries& raw = trial.emg.stages->raw;
    const TimeSeries& envelope = trial.emg.stages->envelope;
    const Eigen::VectorXd& t = raw.time_s();
    const Eigen::Index columns = std::min(kRawColumns, raw.sample_count());
    const Stretch when{t[0], t[t.size() - 1]};
    const double width = (when.end_s - when.begin_s) / static_cast<double>(columns);
    const int clock =
        plots.whole_clock(Eigen::VectorXd::LinSpaced(columns, when.begin_s + 0.5 * width, when.end_s - 0.5 * width));
    for (Eigen::Index c = 0; c < raw.channel_count(); ++c) {
      const Eigen::VectorXd mv = 1e3 * raw.values().col(c);
      plots.add(
          {.kind = "emg",
           .title = raw.channels()[at(c)].name,
           .unit = "mV",
           .lines = {{"raw", Role::raw, clock, -greatest(t, -mv, when, columns), greatest(t, mv, when, columns)},
                     plots.line("envelope", Role::identified, envelope.time_s(), 1e3 * envelope.values().col(c))}});
    }
  }
  const TimeSeries& activation = trial.emg.activation;
  if (activation.empty()) return;
  TimePlot plot{
      .kind = "activation", .title = "activation by EMG", .unit = "", .file = plots.folder() + "/activation.sto"};
  for (Eigen::Index c = 0; c < activation.channel_count(); ++c)
    plot.lines.push_back(plots.line(activation.channels()[at(c)].name, Role::reference, activation.time_s(),
                                    activation.values().col(c)));
  plots.add(std::move(plot));
}

void add_fitted_forces(const run::StudyResult& result,
                       const fit::TrialData& data,
                       const fit::TrialFit& fit,
                       TrialPlots& plots) {
  for (std::size_t m = 0; m < result.fit_input.data.muscles.size(); ++m) {
    const auto c = static_cast<Eigen::Index>(m);
    TimePlot plot{.kind = "force",
                  .title = result.fit_input.data.muscles[m].name,
                  .unit = "N",
                  .muscle = static_cast<int>(m),
                  .file = plots.folder() + "/identified_forces.sto"};
    if (data.force_n.cols() > c)
      plot.lines.push_back(plots.line("shared", Role::reference, data.time_s, data.force_n.col(c)));
    if (fit.literature_force_n.cols() > c)
      plot.lines.push_back(plots.line("literature", Role::literature, data.time_s, fit.literature_force_n.col(c)));
    if (fit.force_fit_n.cols() > c && fit.force_fit_n.col(c).allFinite())
      plot.lines.push_back(plots.line("identified", Role::identified, data.time_s, fit.force_fit_n.col(c)));
    plots.add(std::move(plot));
  }
}

/// Adds shared forces of the model's muscles, the strongest first.
void add_shared_forces(const run::TrialResult& trial, TrialPlots& plots) {
  const TimeSeries& force = trial.forces.shared.force;
  if (force.empty()) return;
  std::vector<Eigen::Index> order(at(force.channel_count()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::stable_sort(order, std::greater{}, [&](Eigen::Index c) { return force.values().col(c).maxCoeff(); });
  if (order.size() > kMostForces) order.resize(kMostForces);
  for (const Eigen::Index c : order) {
    plots.add({.kind = "force",
               .title = force.channels()[at(c)].name,
               .unit = "N",
               .lines = {plots.line("shared", Role::reference, force.time_s(), force.values().col(c))},
               .file = trial.spec.given.forces ? "" : plots.folder() + "/StaticOptimization_force.sto"});
  }
}

void add_carpet(const run::TrialResult& trial, WorkbenchTrial& shown) {
  const TimeSeries& emg = trial.emg.activation;
  const TimeSeries empty;
  const TimeSeries& errors = trial.motion.ik ? trial.motion.ik->errors : empty;
  bool any = false;
  for (const TimeSeries* series : {&emg, &errors}) {
    if (series->empty()) continue;
    const auto& t = series->time_s();
    const Stretch own{t[0], t[t.size() - 1]};
    shown.carpet_when =
        any ? Stretch{std::min(shown.carpet_when.begin_s, own.begin_s), std::max(shown.carpet_when.end_s, own.end_s)}
            : own;
    any = true;
  }
  const auto add = [&](const TimeSeries& of, Eigen::Index c, const char* kind, const char* unit, double scale) {
    const Eigen::Index columns = std::min(kCarpetColumns, of.sample_count());
    shown.carpet.push_back({of.channels()[at(c)].name, kind, unit,
                            greatest(of.time_s(), scale * of.values().col(c), shown.carpet_when, columns)});
  };
  for (Eigen::Index c = 0; c < emg.channel_count(); ++c) add(emg, c, "EMG", "", 1.0);
  for (Eigen::Index c = 3; c < errors.channel_count(); ++c) add(errors, c, "marker", "mm", 1e3);
}

/// True if a torque's own mean predicts it better, and the error is no small part of it: of an effort that is held R2
/// tells nothing.
bool is_missed(const fit::Score& score) {
  constexpr double kSmall = 0.25;
  const double torque_nm = std::sqrt(score.sst / std::max(score.n, 1.0) + score.mean_nm * score.mean_nm);
  return score.n >= 2.0 && score.r2() < 0.0 && score.rmse_nm() > kSmall * torque_nm;
}

void add_remarks(const run::StudyResult& result,
                 const IdentificationResult* fit,
                 const std::vector<run::OutlyingFold>& outlying,
                 const run::TrialResult& trial,
                 WorkbenchTrial& shown) {
  shown.badge = Badge::good;
  const auto worse = [&](Badge badge) {
    if (shown.badge != Badge::bad) shown.badge = badge;
  };
  if (!trial.failure().empty()) {
    worse(Badge::bad);
    shown.remarks.push_back({.severity = Severity::error, .says = "Could not be computed: " + trial.failure()});
  }
  for (const run::OutlyingFold& fold : outlying) {
    if (fold.trial != trial.spec.name) continue;
    worse(Badge::bad);
    std::string says = fmt::format(
        "Predicted worse than the other trials: {:.2f} N m rms, where {:.2f} is usual. Look at its files, labels, held "
        "mass and clock.",
        fold.rms_nm, fold.usual_rms_nm);
    shown.remarks.push_back({.code = RemarkCode::not_predicted, .says = std::move(says)});
  }
  for (const Remark& remark : trial.remarks) {
    if (remark.severity != Severity::warning) continue;
    worse(Badge::weak);
    shown.remarks.push_back(remark);
  }
  for (const Remark& fault : trial.faults) {
    if (fault.severity != Severity::warning && fault.severity != Severity::error) continue;
    worse(Badge::weak);
    shown.marks.push_back({.about = fault.about, .when = fault.when, .badge = Badge::weak, .text = sentence(fault)});
  }
  if (fit == nullptr) return;
  for (const fit::TrialFit& t : fit->trials) {
    if (t.trial != trial.spec.name || t.torque_fit_nm.size() == 0) continue;
    if (is_missed(t.score)) worse(Badge::weak);
    shown.remarks.push_back(
        {.severity = Severity::note,
         .says = fmt::format("{}: torque {} within {:.2f} N m rms (R² {:.2f}).", page::spelled(t.joint),
                             t.calibration ? "described" : "predicted", t.score.rmse_nm(), t.score.r2())});
  }
  for (const fit::Fold& fold : result.folds) {
    if (fold.trial != trial.spec.name) continue;
    if (is_missed(fold.identified)) worse(Badge::weak);
    shown.remarks.push_back({.severity = Severity::note,
                             .says = fmt::format("Left out, it is predicted within {:.2f} N m rms (R² {:.2f}).",
                                                 fold.identified.rmse_nm(), fold.identified.r2())});
  }
}

/// Adds the inputs of the muscles' law, with the activation that the fit uses.
void add_drives(const run::StudyResult& result,
                const IdentificationResult& fit,
                const fit::TrialFit& fitted,
                fit::TrialData data,
                TrialPlots& plots,
                WorkbenchTrial& shown) {
  if (fit.values.muscles.size() != result.fit_input.data.muscles.size()) return;
  if (!fitted.drive.empty()) data.activation = fitted.drive;
  const fit::Prediction prediction = fit::predict(result.fit_input.data, data, fit.values, fit.lag);
  for (std::size_t m = 0; m < result.fit_input.data.muscles.size(); ++m) {
    const auto c = static_cast<Eigen::Index>(m);
    page::MuscleDrive drive{plots.thinned(prediction.activation.col(c)),
                            plots.thinned(data.length_m.col(c)),
                            plots.thinned(data.velocity_mps.col(c)),
                            {}};
    for (std::size_t j = 0; j < joint_count(data); ++j)
      if (const Eigen::MatrixXd& arm_m = joint_at(data, j).moment_arm_m; arm_m.cols() > c)
        drive.moment_arm_m.push_back(plots.thinned(arm_m.col(c)));
    shown.drives.push_back(std::move(drive));
  }
}

WorkbenchTrial shown_trial(const run::StudyResult& result,
                           const IdentificationResult* fit,
                           const std::vector<run::OutlyingFold>& outlying,
                           const run::TrialResult& trial,
                           const std::string& folder,
                           Eigen::Index most) {
  WorkbenchTrial shown{.name = trial.spec.name, .use = std::string(choice_name(trial.spec.use))};
  TrialPlots plots(shown, folder, most);
  const auto& all = result.fit_input.data.trials;
  const auto data = std::ranges::find(all, trial.spec.name, &fit::TrialData::name);
  const fit::TrialFit* fitted = nullptr;
  if (fit != nullptr && data != all.end()) {
    plots.clock(data->time_s);
    fitted = run::trial_of(*fit, trial.spec.name);
    if (fitted != nullptr) add_drives(result, *fit, *fitted, *data, plots, shown);
  }
  add_angles(result, trial, plots);
  add_torques(result, fit, trial, plots);
  add_loads(trial, plots);
  add_emg(trial, plots);
  if (fitted != nullptr)
    add_fitted_forces(result, *data, *fitted, plots);
  else
    add_shared_forces(trial, plots);
  add_norms(result.source, trial, shown);
  add_carpet(trial, shown);
  add_remarks(result, fit, outlying, trial, shown);
  return shown;
}

/// Returns the path from `folder`. A browser takes the parts of a path literally and follows no links.
std::string path_from(const std::filesystem::path& folder, const std::filesystem::path& file) {
  const auto whole = [](const std::filesystem::path& path) {
    return std::filesystem::absolute(path).lexically_normal();
  };
  return whole(file).lexically_relative(whole(folder / "")).generic_string();
}

}  // namespace

page::Workbench study_workbench(const run::StudyResult& result, const std::filesystem::path& folder) {
  page::Workbench workbench{.scenes = study_scenes(result)};
  const IdentificationResult* fit = run::best_method(result.fit);
  if (fit == nullptr && !result.fit.methods.empty()) fit = &result.fit.methods.front();
  const auto& muscles = result.fit_input.data.muscles;
  if (fit != nullptr && fit->values.muscles.size() != muscles.size()) fit = nullptr;
  if (fit != nullptr) add_movable_muscles(*fit, muscles, workbench);
  const Eigen::Index most = std::max(
      kLeastSamples, kMostSamples / std::max<Eigen::Index>(1, static_cast<Eigen::Index>(result.trials.size())));
  const std::vector<run::OutlyingFold> outlying = run::outlying_folds(result.folds);
  const NameIds ids = study::trial_ids(result.source.study);
  int scene = 0;
  for (const run::TrialResult& trial : result.trials) {
    WorkbenchTrial shown = shown_trial(result, fit, outlying, trial, ids.of(trial.spec.name), most);
    if (trial.has_motion() && !result.source.study.model.is_none()) shown.scene = scene++;
    if (trial.spec.video) shown.video = path_from(folder, *trial.spec.video);
    shown.video_offset_s = trial.spec.video_offset_s;
    if (!shown.plots.empty() || shown.scene >= 0 || shown.badge == Badge::bad)
      workbench.trials.push_back(std::move(shown));
  }
  return workbench;
}

}  // namespace myoid::results
