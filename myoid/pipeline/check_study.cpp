#include "myoid/pipeline/check_study.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/kinematics/inverse_kinematics.h"
#include "myoid/pipeline/study_model.h"
#include "myoid/pipeline/trial_input.h"
#include "myoid/recording/csv_reader.h"
#include "myoid/signals/emg_envelope.h"

namespace myoid::pipeline {
namespace {

using Level = Finding::Level;

class Check {
 public:
  explicit Check(const Study& study) : study_(study) {}

  std::vector<Finding> findings() {
    check_model();
    if (!study_.emg.has_mvc && study_.emg.kind == EmgKind::raw) {
      add(Level::warning, "study",
          "no trial is a maximal contraction (use = \"mvc\"): F_max will mean the force at the "
          "study's largest EMG");
    }
    if (study_.truth) {
      attempt("truth", [&] { (void)recording::read_csv_table(*study_.truth); });
    }
    for (const TrialSpec& trial : study_.trials) {
      if (model_) attempt(trial.name, [&] { check_trial(trial); });
    }
    if (all_read_ && !envelopes_.empty()) attempt("EMG", [&] { check_reference(); });
    std::stable_sort(findings_.begin(), findings_.end(),
                     [](const Finding& a, const Finding& b) { return a.level < b.level; });
    return std::move(findings_);
  }

 private:
  void add(Level level, std::string where, std::string message) {
    findings_.push_back({level, std::move(where), std::move(message)});
  }

  template <typename Work>
  void attempt(const std::string& where, Work work) {
    try {
      work();
    } catch (const InvalidInput& error) {
      add(Level::error, where, error.what());
      all_read_ = false;
    }
  }

  void check_model() {
    attempt("model", [&] {
      model::BodyModel model = load_model(study_);
      for (const identification::MuscleSetup& setup : muscle_setups(study_, model)) {
        for (const muscle::HillField& field : muscle::kHillFields) {
          const double value = setup.start.*field.member;
          if (value >= field.bounds.lower && value <= field.bounds.upper) continue;
          add(Level::warning, "model",
              fmt::format(
                  "{}: the model's {} of {:.4g} {} lies outside {} to {}: the search begins "
                  "at the nearest of these; [[muscle]] start sets another value",
                  setup.name, field.name, value, symbol(field.unit), field.bounds.lower,
                  field.bounds.upper));
        }
      }
      for (const std::string& text : model.unsupported) add(Level::warning, "model", text);
      for (const std::string& text : model.notes) add(Level::note, "model", text);
      model_ = std::move(model);
    });
  }

  void check_trial(const TrialSpec& spec) {
    if (spec.held_mass_kg > 0.0 && study_.model.file && !study_.model.held_mass) {
      add(Level::error, spec.name,
          "held_mass_kg is given, but [model] held_mass does not say where it acts");
    }
    const TrialInput input = read_trial_input(study_, spec, *model_);
    for (const std::string& note : input.notes) {
      const bool warning =
          std::find(input.warnings.begin(), input.warnings.end(), note) != input.warnings.end();
      add(warning ? Level::warning : Level::note, spec.name, note);
    }
    if (input.markers) check_markers(spec, *input.markers);
    if (input.emg) check_emg(spec, *input.emg);
  }

  void check_markers(const TrialSpec& spec, const recording::MarkerSeries& markers) {
    const Eigen::Index frames = markers.frame_count();
    for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
      Eigen::Index gaps = 0;
      for (Eigen::Index f = 0; f < frames; ++f) gaps += markers.missing(f, m) ? 1 : 0;
      if (gaps == 0) continue;
      add(gaps > frames / 4 ? Level::warning : Level::note, spec.name,
          fmt::format("marker '{}' is missing in {:.1f} % of the frames",
                      markers.names[static_cast<std::size_t>(m)],
                      100.0 * static_cast<double>(gaps) / static_cast<double>(frames)));
    }
    if (study_.ik.calibrate) {
      const std::vector<double>& window = study_.ik.calibrate->window_s;
      const Eigen::Index inside =
          (markers.time_s.array() >= window[0] && markers.time_s.array() <= window[1]).count();
      if (inside < 2)
        throw InvalidInput(
            fmt::format("[ik] calibrate: no frames between {} and {} s", window[0], window[1]));
    }
    // Names and weights are compared as the real thing does it, on one frame and without a step.
    recording::MarkerSeries first = markers;
    first.time_s = markers.time_s.head(1);
    first.positions_m = markers.positions_m.topRows(1);
    (void)kinematics::inverse_kinematics(
        *model_, first, {.marker_weights = study_.markers.weight, .max_iterations = 0});
  }

  void check_emg(const TrialSpec& spec, const TimeSeries& emg) {
    if (study_.emg.kind == EmgKind::activation) return;
    const bool mvc = spec.use == Use::mvc;
    if (study_.emg.kind == EmgKind::envelope) {
      envelopes_.push_back({spec.name, mvc, emg});
      return;
    }
    if (emg.mean_rate_hz() < 800.0) {
      add(Level::warning, spec.name,
          fmt::format("EMG at {:.0f} Hz: 1000 Hz or more is needed for raw EMG",
                      emg.mean_rate_hz()));
    }
    signals::EmgStages stages =
        signals::process_emg(emg, {.highpass_hz = study_.emg.highpass_hz,
                                   .lowpass_hz = study_.emg.lowpass_hz,
                                   .rectify = study_.emg.rectify,
                                   .as_published = study_.emg.as_published});
    for (const std::string& text : stages.findings) add(Level::warning, spec.name, text);
    envelopes_.push_back({spec.name, mvc, std::move(stages.envelope)});
  }

  /// A channel that never rises, a window longer than every trial.
  void check_reference() {
    std::vector<signals::TrialEnvelope> trials;
    for (const Envelope& e : envelopes_) trials.push_back({e.trial, e.is_mvc, &e.envelope});
    (void)signals::find_normalisation(trials, {.window_s = study_.emg.normalise_window_s});
  }

  struct Envelope {
    std::string trial;
    bool is_mvc = false;
    TimeSeries envelope;
  };

  const Study& study_;
  std::optional<model::BodyModel> model_;
  std::vector<Envelope> envelopes_;
  std::vector<Finding> findings_;
  bool all_read_ = true;
};

}  // namespace

std::string_view name(Finding::Level level) {
  switch (level) {
    case Level::error:
      return "error";
    case Level::warning:
      return "warning";
    case Level::note:
      return "note";
  }
  return "?";
}

std::vector<Finding> check_study(const Study& study) { return Check(study).findings(); }

}  // namespace myoid::pipeline
