#include "myoid/study/checks/check_study.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/signals/emg_envelope.h"
#include "myoid/recording/tables/csv_reader.h"
#include "myoid/study/checks/load_points.h"
#include "myoid/study/checks/marker_distance.h"
#include "myoid/study/checks/open_questions.h"
#include "myoid/study/checks/recording_findings.h"
#include "myoid/study/checks/stated_loads.h"
#include "myoid/study/checks/study_plausibility.h"
#include "myoid/study/checks/unloaded_times.h"
#include "myoid/study/intake/emg_offset.h"
#include "myoid/study/intake/norm.h"
#include "myoid/study/intake/read_trial.h"
#include "myoid/study/intake/study_activation.h"
#include "myoid/study/study_model.h"
#include "myoid/study/trial_videos.h"

namespace myoid::study {
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
          "no trial is a maximal contraction (use = \"mvc\"): F_max will rest on the literature, because the share of "
          "the maximum at the largest EMG is unknown");
    }
    if (study_.model.is_arm() && !study_.subject.mass_kg)
      add(RemarkCode::no_body_mass, Severity::warning, "study",
          "[subject] mass_kg is not given: the built-in arm has the segments of a person of 73 kg");
    for (const std::string& text : study_.identify.without_effect)
      add(RemarkCode::general, Severity::warning, "study", text);
    if (auto left_out = without_paper(study_)) remarks_.push_back(std::move(*left_out));
    check_todos();
    if (study_.truth) {
      attempt("truth", [&] { (void)recording::read_csv_table(*study_.truth); });
    }
    attempt("video", [&] { require_videos(study_); });
    for (const NormSpec& norm : study_.norms) attempt("norm", [&] { (void)read_norm(norm, study_); });
    for (const TrialSpec& trial : study_.trials) {
      if (model_) attempt(trial.name, [&] { check_trial(trial); });
    }
    if (together_) add(together_->findings());
    leave_out_explained_distances();
    if (auto silent = unstated_loads(study_.trials)) remarks_.push_back(std::move(*silent));
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

  /// Exchanged labels or another vertical put markers far from the model: the error that names them is enough.
  void leave_out_explained_distances() {
    const auto explains = [](const Remark& error, const std::string& trial) {
      return error.severity == Severity::error &&
             (error.code == RemarkCode::sides_exchanged || error.code == RemarkCode::vertical_across_trunk) &&
             (error.where == trial || std::ranges::find(error.likewise, trial) != error.likewise.end());
    };
    const std::vector<Remark> all = remarks_;
    std::erase_if(remarks_, [&](const Remark& remark) {
      return remark.code == RemarkCode::model_unfit &&
             std::ranges::any_of(all, [&](const Remark& other) { return explains(other, remark.where); });
    });
  }

  /// Reports the questions that `init` left open.
  void check_todos() {
    std::error_code error;
    if (!std::filesystem::is_regular_file(study_.file, error)) return;
    if (auto asked = open_questions(read_text_file(study_.file), study_.file)) remarks_.push_back(std::move(*asked));
  }

  void check_model() {
    attempt("model", [&] {
      body::BodyModel model = load_model(study_);
      for (const fit::MuscleSetup& setup : muscle_setups(study_, model)) {
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
      for (const std::string& text : sentences(model.notes)) add(RemarkCode::reading, Severity::note, "model", text);
      model_ = std::move(model);
      together_.emplace(study_, *model_);
    });
  }

  void check_trial(const TrialSpec& trial) {
    if (trial.held_mass_kg.value_or(0.0) > 0.0) attempt(trial.name, [&] { (void)held_mass_place(study_); });
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
    if (auto distant = distant_markers(study_, spec, *model_, input)) remarks_.push_back(std::move(*distant));
    if (input.emg && study_.emg.kind == EmgKind::raw && input.emg->mean_rate_hz() < kLimits.emg.slowest_raw_emg_hz) {
      add(RemarkCode::emg_rate, Severity::warning, spec.name,
          fmt::format("EMG at {:.0f} Hz: raw EMG reaches 400 Hz and needs {:g} Hz or more", input.emg->mean_rate_hz(),
                      kLimits.emg.slowest_raw_emg_hz));
    }
  }

  /// Processes the EMG as `run` does and reports the findings of `run` on recordings, and its
  /// errors: a channel that never rises, a window longer than every trial.
  void check_recordings() {
    Study study = study_;
    study.trials = specs_;
    add(take_off_emg_offsets(study, inputs_));
    const EmgOfTrials emg = emg_of(inputs_);
    StudyActivation activation;
    activation.trials.resize(inputs_.size());
    attempt("EMG", [&] { activation = study_envelopes(study, emg); });
    for (std::size_t i = 0; i < specs_.size(); ++i) {
      const auto& stages = activation.trials[i].stages;
      if (stages)
        for (const Remark& finding : stages->findings)
          add(finding.code, finding.severity, specs_[i].name, finding.says);
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
  std::optional<body::BodyModel> model_;
  std::optional<StudyPlausibility> together_;
  std::vector<TrialSpec> specs_;    ///< The trials, or parts of trials, that could be read.
  std::vector<TrialInput> inputs_;  ///< The inputs of `specs_`.
  std::vector<Remark> remarks_;
  bool all_read_ = true;
};

}  // namespace

std::vector<Remark> check_study(const Study& study) { return StudyCheck(study).findings(); }

}  // namespace myoid::study
