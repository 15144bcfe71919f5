#include "myoid/checks/check_study.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/checks/load_points.h"
#include "myoid/checks/recording_findings.h"
#include "myoid/checks/study_plausibility.h"
#include "myoid/checks/unloaded_times.h"
#include "myoid/core/error.h"
#include "myoid/files/file_format.h"
#include "myoid/files/label_match.h"
#include "myoid/files/text_file.h"
#include "myoid/intake/norm.h"
#include "myoid/intake/read_trial.h"
#include "myoid/intake/study_activation.h"
#include "myoid/intake/trial_markers.h"
#include "myoid/kinematics/inverse_kinematics.h"
#include "myoid/recording/channel_choice.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/plate_standing.h"
#include "myoid/recording/recording.h"
#include "myoid/signals/clock_offset.h"
#include "myoid/signals/emg_envelope.h"
#include "myoid/signals/emg_levels.h"
#include "myoid/signals/emg_quality.h"
#include "myoid/signals/marker_quality.h"
#include "myoid/signals/plate_quality.h"
#include "myoid/study/study_model.h"
#include "myoid/study/trial_videos.h"
#include "myoid/tables/csv_reader.h"
#include "myoid/tables/storage_reader.h"

namespace myoid {
namespace {

/// Returns the message of an error without the file and the line at its beginning.
std::string without_place(const ReadError& error) {
  const std::size_t colons = error.line() == 0 ? 2 : 3 + std::to_string(error.line()).size();
  return std::string(error.what()).substr(error.path().string().size() + colons);
}

class StudyCheck {
 public:
  explicit StudyCheck(const Study& study) : study_(study) {}

  std::vector<Remark> findings() {
    check_model();
    if (!study_.emg.has_mvc && study_.emg.kind != EmgKind::activation) {
      add(RemarkCode::no_maximal_contraction, Severity::warning, "study",
          study_.identify.estimator == identification::EstimatorKind::posterior
              ? "no trial is a maximal contraction (use = \"mvc\"): F_max will rest on the literature, because the "
                "share of the maximum at the largest EMG is unknown"
              : "no trial is a maximal contraction (use = \"mvc\"): F_max will mean the force at the study's largest "
                "EMG");
    }
    if (!study_.model.file && !study_.subject.mass_kg)
      add(RemarkCode::no_body_mass, Severity::warning, "study",
          "[subject] mass_kg is not given: the built-in arm has the segments of a person of 73 kg");
    if (study_.identify.estimator == identification::EstimatorKind::least_squares &&
        study_.beliefs != identification::UnseenSpreads{})
      add(RemarkCode::general, Severity::note, "study",
          "[beliefs] are those of the estimator posterior; least_squares, which the study asks for, uses none of them");
    check_todos();
    if (study_.truth) {
      attempt("truth", [&] { (void)recording::read_csv_table(*study_.truth); });
    }
    attempt("video", [&] { require_videos(study_); });
    for (const NormSpec& norm : study_.norms) attempt("norm", [&] { (void)read_norm(norm, study_); });
    for (const TrialSpec& trial : study_.trials) {
      if (model_) attempt(trial.name, [&] { check_trial(trial); });
    }
    if (together_) {
      add(together_->findings());
    }
    if (!inputs_.empty()) attempt("EMG", [&] { check_recordings(); });
    sort_by_severity(remarks_);
    return grouped(remarks_);
  }

 private:
  void add(RemarkCode code, Severity severity, std::string where, std::string says) {
    remarks_.push_back({.code = code, .severity = severity, .where = std::move(where), .says = std::move(says)});
  }

  void add(std::vector<Remark> remarks, const std::string& where) {
    for (Remark& remark : remarks) {
      remark.where = where;
      remarks_.push_back(std::move(remark));
    }
  }
  void add(std::vector<Remark> remarks) { std::ranges::move(remarks, std::back_inserter(remarks_)); }

  void refuse(const std::string& where, std::string says, std::string complaint) {
    remarks_.push_back({.code = RemarkCode::refused,
                        .severity = Severity::error,
                        .where = where,
                        .about = std::move(complaint),
                        .says = std::move(says)});
    all_read_ = false;
  }

  template <typename Work>
  void attempt(const std::string& where, Work work) {
    // Errors that differ only in their file are of one kind.
    try {
      work();
    } catch (const ReadError& error) {
      refuse(where, error.what(), without_place(error));
    } catch (const InvalidInput& error) {
      refuse(where, error.what(), error.what());
    }
  }

  /// Reports the questions that `init` left open.
  void check_todos() {
    std::error_code error;
    if (!std::filesystem::is_regular_file(study_.file, error)) return;
    const std::string text = recording::read_text_file(study_.file);
    std::vector<std::string> asked;
    const auto lines = recording::split_lines(text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto at = lines[i].find("# TODO: ");
      if (at == std::string_view::npos) continue;
      std::string what(recording::trim(lines[i].substr(at + 8)));
      constexpr std::size_t kMost = 60;
      if (what.size() > kMost) what = what.substr(0, what.rfind(' ', kMost)) + " ...";
      asked.push_back(fmt::format("line {}: {}", i + 1, what));
    }
    if (asked.empty()) return;
    add(RemarkCode::unanswered, Severity::warning, study_.file.filename().string(),
        fmt::format("{} line{} still ask{} for an answer (TODO), or for being deleted: {}", asked.size(),
                    asked.size() == 1 ? "" : "s", asked.size() == 1 ? "s" : "", fmt::join(asked, "; ")));
  }

  void check_model() {
    attempt("model", [&] {
      model::BodyModel model = load_model(study_);
      for (const identification::MuscleSetup& setup : muscle_setups(study_, model)) {
        for (const muscle::HillField& field : muscle::kHillFields) {
          const double value = setup.start.*field.member;
          if (value >= field.bounds.lower && value <= field.bounds.upper) continue;
          add(RemarkCode::start_outside_bounds, Severity::warning, "model",
              fmt::format("{}: the model's {} of {:.4g} {} lies outside {} to {}: the search begins at the nearest of "
                          "these; [[muscle]] start sets another value",
                          setup.name, field.name, value, symbol(field.unit), field.bounds.lower, field.bounds.upper));
        }
      }
      for (const std::string& text : model.unsupported)
        add(RemarkCode::model_unsupported, Severity::warning, "model", text);
      for (const std::string& text : model.notes) add(RemarkCode::reading, Severity::note, "model", text);
      model_ = std::move(model);
      together_.emplace(study_, *model_);
    });
  }

  void check_trial(const TrialSpec& trial) {
    if (trial.held_mass_kg > 0.0) attempt(trial.name, [&] { (void)held_mass_place(study_); });
    for (TrialPart& part : read_trial_parts(study_, trial, *model_)) {
      check_part(part.spec, part.input);
      specs_.push_back(std::move(part.spec));
      inputs_.push_back(std::move(part.input));
    }
  }

  void check_part(const TrialSpec& spec, const TrialInput& input) {
    add(input.remarks, spec.name);
    together_->look_at(spec, input);
    add(unloaded_times(*model_, spec, input));
    if (input.markers) check_markers(*input.markers);
    if (input.emg && study_.emg.kind == EmgKind::raw && input.emg->mean_rate_hz() < kLimits.slowest_raw_emg_hz) {
      add(RemarkCode::emg_rate, Severity::warning, spec.name,
          fmt::format("EMG at {:.0f} Hz: raw EMG reaches 400 Hz and needs {:g} Hz or more", input.emg->mean_rate_hz(),
                      kLimits.slowest_raw_emg_hz));
    }
  }

  void check_markers(const recording::MarkerSeries& markers) {
    if (study_.ik.calibrate) (void)calibration_window(*study_.ik.calibrate, markers);
    // Names and weights are compared as inverse kinematics does, on one frame and without a step.
    (void)kinematics::inverse_kinematics(
        *model_, recording::MarkerSeries{markers.time_s.head(1), markers.names, markers.positions_m.topRows(1)},
        {.marker_weights = study_.markers.weight, .max_iterations = 0});
  }

  /// Processes the EMG as `run` does and reports the findings of `run` on recordings, and its
  /// errors: a channel that never rises, a window longer than every trial.
  void check_recordings() {
    Study study = study_;
    study.trials = specs_;
    const EmgOfTrials emg = emg_of(inputs_);
    StudyActivation activation;
    activation.trials.resize(inputs_.size());
    attempt("EMG", [&] { activation = study_envelopes(study, emg); });
    for (std::size_t i = 0; i < specs_.size(); ++i) {
      const auto& stages = activation.trials[i].stages;
      if (stages)
        for (const std::string& text : stages->findings)
          add(RemarkCode::emg_processing, Severity::note, specs_[i].name, text);
      // Without a reference only the levels are available.
      if (emg[i] != nullptr) activation.trials[i].activation = stages ? stages->envelope : *emg[i];
    }
    const bool all_read = all_read_;
    if (all_read) attempt("EMG", [&] { normalise(study, emg, activation); });
    RecordingFindings found = recording_findings(study, *model_, inputs_, activation);
    for (std::vector<Remark>& of_trial : found.of_trials) add(std::move(of_trial));
    add(std::move(found.levels), "EMG");
    if (all_read) add(std::move(found.dynamometers));
  }

  const Study& study_;
  std::optional<model::BodyModel> model_;
  std::optional<StudyPlausibility> together_;
  std::vector<TrialSpec> specs_;    ///< The trials, or parts of trials, that could be read.
  std::vector<TrialInput> inputs_;  ///< The inputs of `specs_`.
  std::vector<Remark> remarks_;
  bool all_read_ = true;
};

}  // namespace

namespace {

/// Returns the channels that may be EMG, or only those named so if there are some, since others may be a load cell's. A
/// storage file has no units of channels: all of them count if its title states a voltage.
std::optional<TimeSeries> voltages(const std::filesystem::path& path,
                                   const recording::AnalogChannels& analog,
                                   const std::vector<recording::PlateSetup>& plates) {
  const std::vector<std::string> names = recording::emg_channels(analog.channels(), plates);
  std::vector<std::string> named_emg;
  for (const std::string& name : names) {
    if (recording::plain_label(name).find("emg") != std::string::npos) named_emg.push_back(name);
  }
  if (!named_emg.empty()) return analog.select(named_emg);
  if (!names.empty()) return analog.select(names);
  if (recording::format_of(path) != recording::FileFormat::storage) return std::nullopt;
  if (!recording::stated_voltage(recording::read_storage(path))) return std::nullopt;
  return recording::read_emg(path, "", false).data;
}

/// Reports channels of a recording whose EMG does not rise from rest.
std::vector<Remark> levels_alone(const TimeSeries& emg, bool raw, const std::string& where) {
  constexpr double kSlowest_hz = 100.0;  // twice the rate that the high-pass needs
  if (raw && emg.mean_rate_hz() < kSlowest_hz) return {};
  signals::EnvelopeOptions options;
  options.whitening = false;
  const signals::EmgStages stages = raw ? signals::process_emg(emg, options) : signals::EmgStages{};
  const std::vector<signals::TrialEnvelope> one{{where, false, raw ? &stages.envelope : &emg, {}, stages.flatness}};
  std::vector<Remark> faults = signals::check_emg_levels(one);
  // A muscle may rest or work throughout one recording. Noise alone is a fault.
  for (Remark& fault : faults) {
    const auto c = one.front().envelope->find(fault.about);
    const bool noise = raw && c && stages.flatness[*c] > signals::kLimits.noise_flatness;
    const bool resting = fault.code == RemarkCode::emg_low_signal && !noise;
    fault.severity = std::max(fault.severity, resting ? Severity::note : Severity::warning);
  }
  return faults;
}

}  // namespace

std::vector<Remark> check_recording(const std::filesystem::path& path, const std::optional<Vec3>& stated_up_L) {
  recording::Recording file = recording::read_recording(path);
  const std::string where = path.filename().string();
  std::vector<Remark> findings;
  bool standing = true;
  try {
    const recording::LaboratoryUp up = recording::stand_plates(file, stated_up_L);
    if (up.up_L)
      findings.push_back({.code = RemarkCode::reading,
                          .severity = Severity::note,
                          .where = where,
                          .says = fmt::format("{} is up ({})", recording::axis_name(*up.up_L), up.because)});
  } catch (const InvalidInput& error) {
    findings.push_back(
        {.code = RemarkCode::refused, .severity = Severity::error, .where = where, .says = error.what()});
    standing = false;
  }
  for (const recording::Repair& repair : file.repairs)
    findings.push_back({.code = RemarkCode::reading,
                        .severity = Severity::note,
                        .where = where,
                        .says = recording::to_string(repair)});
  const auto add = [&](std::vector<Remark> faults) {
    for (Remark& fault : faults) {
      fault.where = where;
      findings.push_back(std::move(fault));
    }
  };
  std::vector<Remark> of_markers = signals::check_markers(file.markers);
  for (Remark& fault : of_markers) {
    // A label of the laboratory's list that nobody used. A study warns of it where its model has that marker.
    const Eigen::VectorXd& t = file.markers.time_s;
    const bool never = fault.code == RemarkCode::marker_gap && fault.value >= t[t.size() - 1] - t[0];
    if (never) fault.severity = std::max(fault.severity, Severity::note);
  }
  add(std::move(of_markers));
  if (const auto emg = voltages(path, file.analog, file.plates)) {
    require_finite(*emg, path.string());
    constexpr Eigen::Index kFewest = 10;
    if (emg->sample_count() < kFewest)
      throw ReadError(path, 0,
                      fmt::format("only {} sample{} of EMG; at least {} are needed", emg->sample_count(),
                                  emg->sample_count() == 1 ? "" : "s", kFewest));
    std::vector<Remark> faults = signals::check_emg(*emg, {.remedies = signals::EmgRemedies::none});
    const bool raw = std::ranges::none_of(faults, [](const Remark& f) { return f.code == RemarkCode::emg_envelope; });
    add(std::move(faults));
    add(levels_alone(*emg, raw, where));
    if (auto uneven = signals::check_clock_evenness(emg->time_s(), "EMG")) add({*uneven});
  }
  for (const recording::PlateSetup& plate : file.plates) {
    if (standing) add(signals::check_force_plate(file.force_plate(plate)));
  }
  sort_by_severity(findings);
  return findings;
}

std::vector<Remark> check_study(const Study& study) { return StudyCheck(study).findings(); }

}  // namespace myoid
