#include "myoid/pipeline/trial_input.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/pipeline/trial_loads.h"
#include "myoid/pipeline/trial_quality.h"
#include "myoid/recording/byte_source.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/label_match.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/storage_reader.h"
#include "myoid/recording/text_file.h"
#include "myoid/recording/toml_table.h"
#include "myoid/signals/clock_gaps.h"
#include "myoid/signals/emg_envelope.h"
#include "myoid/signals/marker_quality.h"
#include "myoid/signals/mend_markers.h"

namespace myoid::pipeline {
namespace {

void add_repairs(const std::filesystem::path& path,
                 const std::vector<recording::Repair>& repairs,
                 std::vector<std::string>& notes) {
  for (const recording::Repair& repair : repairs) {
    notes.push_back(
        repair.line > 0
            ? fmt::format("{}:{}: {}", path.filename().string(), repair.line, repair.message)
            : fmt::format("{}: {}", path.filename().string(), repair.message));
  }
}

void warn(TrialInput& input, std::string text) {
  input.notes.push_back(text);
  input.warnings.push_back(std::move(text));
}

/// Labels that differ from the model's in their writing only become the model's; of others that
/// resemble one it is asked.
void match_labels(const model::BodyModel& model,
                  const std::filesystem::path& path,
                  std::vector<std::string>& names,
                  TrialInput& input) {
  std::vector<std::string> wanted;
  for (const model::Marker& marker : model.markers) wanted.push_back(marker.name);
  const recording::LabelMatch match = recording::match_labels(names, wanted);
  for (std::string& name : names) {
    const auto same = match.same.find(name);
    if (same == match.same.end()) continue;
    input.notes.push_back(fmt::format("{}: marker '{}' is taken for the model's '{}'",
                                      path.filename().string(), name, same->second));
    name = same->second;
  }
  for (const auto& [name, like] : match.similar) {
    input.notes.push_back(
        fmt::format("{}: the model has no marker '{}'; did you mean '{}'? Then write [markers] "
                    "rename = {{ \"{}\" = \"{}\" }}",
                    path.filename().string(), name, like, name, like));
  }
}

recording::MarkerSeries read_markers(const Study& study,
                                     const model::BodyModel& model,
                                     const std::filesystem::path& path,
                                     TrialInput& input) {
  recording::MarkerFile file = recording::read_markers(path);
  std::vector<std::string>& notes = input.notes;
  add_repairs(path, file.repairs, notes);
  for (std::string& name : file.markers.names) {
    if (const auto it = study.markers.rename.find(name); it != study.markers.rename.end())
      name = it->second;
  }
  match_labels(model, path, file.markers.names, input);
  if (study.markers.up != 'y') {
    notes.push_back(fmt::format("{}: laboratory turned from {} up to y up",
                                path.filename().string(), study.markers.up));
    file.markers =
        recording::rotated(std::move(file.markers), recording::rotation_to_y_up(study.markers.up));
  }
  return std::move(file.markers);
}

/// What is wrong with the markers, then as much of it put right as can be.
recording::MarkerSeries mended(const Study& study,
                               const model::BodyModel& model,
                               recording::MarkerSeries markers,
                               TrialInput& input) {
  const std::vector<signals::ExpectedSegment> expected = segments_of(model, markers);
  input.marker_faults = signals::check_markers(markers, expected);
  bool right_unit = true;
  for (signals::Fault& fault : input.marker_faults) {
    right_unit = right_unit && fault.kind != signals::FaultKind::marker_unit;
    const bool used =
        std::any_of(model.markers.begin(), model.markers.end(),
                    [&](const model::Marker& marker) { return fault.channel == marker.name; });
    // A marker that the model does not have harms nobody.
    const bool of_one =
        std::find(markers.names.begin(), markers.names.end(), fault.channel) != markers.names.end();
    if (of_one && !used) fault.grave = false;
  }
  if (!right_unit) return markers;
  std::vector<signals::RigidSegment> segments;
  for (const signals::ExpectedSegment& e : expected) segments.push_back(e.segment);
  signals::MendedMarkers result = signals::mend_markers(
      std::move(markers), segments,
      {.undo_swaps = study.markers.undo_swaps, .fill_gaps = study.markers.fill_gaps});
  for (std::string& text : result.repairs) input.notes.push_back(std::move(text));
  return std::move(result.markers);
}

/// A clock that a person's movement can have been recorded on: pauses are warned of or refused.
void check_clock(const std::filesystem::path& path,
                 const Eigen::VectorXd& time_s,
                 TrialInput& input) {
  constexpr double kSlowest_hz = 5.0;
  const Eigen::Index n = time_s.size();
  const signals::ClockGaps gaps = signals::find_clock_gaps(time_s);
  if (gaps.usual_interval_s > 1.0 / kSlowest_hz) {
    throw ReadError(path, 0,
                    fmt::format("{} samples from {:.6g} to {:.6g}, about one per {:.3g} s: is the "
                                "time in ms or in frames? expected seconds and {} Hz or more",
                                n, time_s[0], time_s[n - 1], gaps.usual_interval_s, kSlowest_hz));
  }
  if (gaps.longest_s() > kLongestGap_s) {
    throw ClockPause(
        path,
        fmt::format("{} in its clock; a pause of more than {} s cannot be bridged: make "
                    "two trials of it, with end_s before and start_s after the gap",
                    gaps.text(), kLongestGap_s),
        signals::clock_stretches(time_s, kLongestGap_s));
  }
  if (gaps.count > 0) {
    warn(input, fmt::format("{}: {} in its clock, bridged by a spline", path.filename().string(),
                            gaps.text()));
  }
}

/// What the study asks for explicitly must be possible.
void check_cutoff(const Study& study, const std::filesystem::path& path, double rate_hz) {
  if (study.motion.smoothing != Smoothing::cutoff || study.motion.cutoff_hz < 0.45 * rate_hz)
    return;
  throw ReadError(path, 0,
                  fmt::format("[motion] cutoff_hz = {}, but this file has {:.4g} Hz; expected less "
                              "than 0.45 of that",
                              study.motion.cutoff_hz, rate_hz));
}

std::string few_samples(const TrialSpec& trial, const TimeSeries& series) {
  const auto limit = [](const std::optional<double>& time_s, std::string_view otherwise) {
    return time_s ? fmt::format("{} s", *time_s) : std::string(otherwise);
  };
  return fmt::format("{} samples from {} to {}; at least 10 are needed", series.sample_count(),
                     limit(trial.start_s, "its begin"), limit(trial.end_s, "its end"));
}

double rate_of(const Eigen::VectorXd& time_s) {
  return static_cast<double>(time_s.size() - 1) / (time_s[time_s.size() - 1] - time_s[0]);
}

TimeSeries read_motion(const std::filesystem::path& path,
                       const model::BodyModel& model,
                       TrialInput& input) {
  const recording::Storage file = recording::read_storage(path);
  add_repairs(path, file.repairs, input.notes);
  const auto is_angle = [&](const std::string& name) {
    const auto index = model.find_coordinate(name);
    return index && model.coordinates[static_cast<std::size_t>(*index)].motion ==
                        model::MotionType::rotational;
  };
  TimeSeries motion = recording::to_si(file, is_angle);
  bool any = false;
  for (Eigen::Index c = 0; c < motion.channel_count(); ++c) {
    const Channel& channel = motion.channels()[static_cast<std::size_t>(c)];
    if (!model.find_coordinate(channel.name)) continue;
    any = true;
    if (channel.unit != Unit::radian) continue;
    const double largest = motion.values().col(c).cwiseAbs().maxCoeff();
    if (largest > 4.0 * kPi) {
      throw ReadError(
          path, 0,
          fmt::format("column '{}' reaches {:.4g} although the header says inDegrees={}: these are "
                      "degrees, not radians; write inDegrees=yes "
                      "into the header",
                      channel.name, file.in_degrees ? largest / kDegree : largest,
                      file.in_degrees ? "yes" : "no"));
    }
    const double range = motion.values().col(c).maxCoeff() - motion.values().col(c).minCoeff();
    if (file.in_degrees && largest < 3.5 * kDegree && range > 0.2 * kDegree) {
      warn(input, fmt::format("{}: column '{}' stays below 3.5 degrees although the header says "
                              "inDegrees=yes; if these are radians, write inDegrees=no",
                              path.filename().string(), channel.name));
    }
  }
  if (!any) {
    std::string names;
    for (const model::Coordinate& c : model.coordinates)
      names += (names.empty() ? "" : ", ") + c.name;
    throw ReadError(path, 0,
                    fmt::format("no column is a coordinate of the model; found {}, expected some "
                                "of {}; rename the columns",
                                channel_names(motion), names));
  }
  return motion;
}

/// A muscle of the study may name its EMG by the muscle that the electrode is on (EMG-BIDS).
void name_by_target_muscle(const Study& study,
                           const std::filesystem::path& path,
                           recording::EmgFile& file,
                           std::vector<std::string>& notes) {
  std::vector<Channel> channels = file.data.channels();
  bool renamed = false;
  for (const MuscleSpec& muscle : study.muscles) {
    if (file.data.find(muscle.emg)) continue;
    std::vector<std::size_t> targets;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const auto it = file.target_muscle.find(channels[c].name);
      if (it != file.target_muscle.end() && recording::equal_ignoring_case(it->second, muscle.emg))
        targets.push_back(c);
    }
    if (targets.size() != 1) continue;
    notes.push_back(fmt::format("{}: channel '{}' is on {}", path.filename().string(),
                                channels[targets[0]].name, muscle.emg));
    channels[targets[0]].name = muscle.emg;
    renamed = true;
  }
  if (renamed) file.data = TimeSeries(file.data.time_s(), std::move(channels), file.data.values());
}

void require_channels(const Study& study,
                      const std::filesystem::path& path,
                      const TimeSeries& emg) {
  for (const MuscleSpec& muscle : study.muscles) {
    if (emg.find(muscle.emg)) continue;
    std::vector<std::string> names;
    for (const Channel& channel : emg.channels()) names.push_back(channel.name);
    const auto near = recording::nearest_word(muscle.emg, names);
    throw ReadError(
        path, 0,
        fmt::format(
            "no EMG channel '{}' for muscle {}; found {}{}; correct [[muscle]] emg in the study",
            muscle.emg, muscle.name, channel_names(emg),
            near ? fmt::format(" (did you mean '{}'?)", *near) : ""));
  }
}

/// What the study calls an envelope or an activation has to be one: raw EMG, which swings about
/// zero, and signals in other units would give muscle forces a hundred times too large, in silence.
void require_kind(const Study& study, const std::filesystem::path& path, const TimeSeries& emg) {
  if (study.emg.kind == EmgKind::raw) return;
  constexpr double kRinging = 0.2;  // of the maximum, that a filter may swing below zero
  constexpr double kLargestActivation = 2.0;
  const bool activation = study.emg.kind == EmgKind::activation;
  const char* const kind = activation ? "activation" : "envelope";
  for (const MuscleSpec& muscle : study.muscles) {
    const auto column = emg.find(muscle.emg);
    if (!column) continue;
    double low = 0.0;
    double high = 0.0;
    for (const double value : emg.values().col(*column)) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    if (low < -kRinging * high)
      throw ReadError(path, 0,
                      fmt::format("channel '{}' reaches from {:.3g} to {:.3g}, but [emg] kind = "
                                  "\"{}\" is never below zero; is it raw EMG? Then set kind = "
                                  "\"raw\"",
                                  muscle.emg, low, high, kind));
    if (activation && high > kLargestActivation)
      throw ReadError(
          path, 0,
          fmt::format("channel '{}' reaches {:.3g}, but an activation goes from 0 to 1; "
                      "percent? Divide by 100, or set [emg] kind = \"envelope\"",
                      muscle.emg, high));
  }
}

/// The EMG on the clock of the motion, and how it came there.
TimeSeries on_clock_of_motion(const Study& study,
                              const TrialSpec& trial,
                              TimeSeries emg,
                              const std::function<void(const std::filesystem::path&)>& remember,
                              TrialInput& input) {
  const auto envelopes = [&] {
    signals::EnvelopeOptions options = envelope_options(study);
    options.whitening = false;  // one trial, and for its clock alone
    return study.emg.kind == EmgKind::raw ? signals::process_emg(emg, options).envelope : emg;
  };
  input.emg_clock = trial_clock(study, trial, movement_of(input), envelopes, remember);
  if (!input.emg_clock) return emg;
  input.notes.push_back(
      fmt::format("{}: clock put on that of the motion, {} ({})", trial.emg->filename().string(),
                  signals::to_string(input.emg_clock->clock), input.emg_clock->source));
  return signals::on_study_clock(std::move(emg), input.emg_clock->clock);
}

}  // namespace

signals::EnvelopeOptions envelope_options(const Study& study) {
  return {.highpass_hz = study.emg.highpass_hz,
          .lowpass_hz = study.emg.lowpass_hz,
          .rectify = study.emg.rectify,
          .notch = study.emg.notch,
          .whitening = study.emg.whitening,
          .as_published = study.emg.as_published};
}

TrialInput read_trial_input(const Study& study,
                            const TrialSpec& trial,
                            const model::BodyModel& model) {
  TrialInput input;
  const auto remember = [&](const std::filesystem::path& path) {
    input.files.push_back({path.string(), sha256(recording::read_bytes(path))});
  };
  const double start = trial.start_s.value_or(-1e300);
  const double end = trial.end_s.value_or(1e300);
  if (trial.markers) {
    remember(*trial.markers);
    recording::MarkerSeries markers = read_markers(study, model, *trial.markers, input);
    if (trial.start_s || trial.end_s) {
      Eigen::Index first = 0;
      while (first < markers.frame_count() && markers.time_s[first] < start) ++first;
      Eigen::Index last = markers.frame_count();
      while (last > first && markers.time_s[last - 1] > end) --last;
      markers.time_s = markers.time_s.segment(first, last - first).eval();
      markers.positions_m = markers.positions_m.middleRows(first, last - first).eval();
    }
    if (markers.frame_count() < 10)
      throw ReadError(*trial.markers, 0,
                      fmt::format("only {} frames; at least 10 are needed", markers.frame_count()));
    check_clock(*trial.markers, markers.time_s, input);
    check_cutoff(study, *trial.markers, rate_of(markers.time_s));
    input.markers = mended(study, model, std::move(markers), input);
  }
  if (trial.motion) {
    remember(*trial.motion);
    input.motion = read_motion(*trial.motion, model, input).slice(start, end);
    require_finite(*input.motion, trial.motion->string());
    if (input.motion->sample_count() < 10)
      throw ReadError(*trial.motion, 0, few_samples(trial, *input.motion));
    check_clock(*trial.motion, input.motion->time_s(), input);
    check_cutoff(study, *trial.motion, rate_of(input.motion->time_s()));
  }
  if (trial.emg) {
    remember(*trial.emg);
    recording::EmgFile file =
        recording::read_emg(*trial.emg, study.emg.unit, study.emg.kind != EmgKind::raw);
    add_repairs(*trial.emg, file.repairs, input.notes);
    if (!file.unit_conflict.empty())
      warn(input, fmt::format("{}: {}", trial.emg->filename().string(), file.unit_conflict));
    name_by_target_muscle(study, *trial.emg, file, input.notes);
    require_channels(study, *trial.emg, file.data);
    require_kind(study, *trial.emg, file.data);
    std::vector<std::string> wanted;
    for (const MuscleSpec& muscle : study.muscles) {
      if (std::find(wanted.begin(), wanted.end(), muscle.emg) == wanted.end())
        wanted.push_back(muscle.emg);
    }
    TimeSeries emg = on_clock_of_motion(study, trial, file.data.select(wanted), remember, input);
    // The EMG may begin earlier than the motion: the delay reaches back.
    input.emg = emg.slice(start - 0.5, end);
    require_finite(*input.emg, trial.emg->string());
    if (input.emg->sample_count() < 10)
      throw ReadError(*trial.emg, 0, few_samples(trial, *input.emg));
    const Eigen::VectorXd& clock = input.emg->time_s();
    check_clock(*trial.emg, clock, input);
    const Eigen::VectorXd* motion_clock = input.markers  ? &input.markers->time_s
                                          : input.motion ? &input.motion->time_s()
                                                         : nullptr;
    if (motion_clock != nullptr) {
      const double overlap =
          std::min(clock[clock.size() - 1], (*motion_clock)[motion_clock->size() - 1]) -
          std::max(clock[0], (*motion_clock)[0]);
      const double motion_s = (*motion_clock)[motion_clock->size() - 1] - (*motion_clock)[0];
      if (overlap < std::max(0.5, 0.5 * motion_s)) {
        throw ReadError(
            *trial.emg, 0,
            fmt::format("the EMG ({:.5g} to {:.5g} s) covers less than half of the motion ({:.5g} "
                        "to {:.5g} s); are both in seconds, on one clock? If so, give the trial "
                        "the start_s and end_s that both have",
                        clock[0], clock[clock.size() - 1], (*motion_clock)[0],
                        (*motion_clock)[motion_clock->size() - 1]));
      }
      if (overlap < motion_s - 0.1) {
        warn(input, fmt::format("{}: the motion goes on for {:.3g} s without EMG; there the EMG's "
                                "end value is taken. start_s and end_s leave it out",
                                trial.emg->filename().string(), motion_s - overlap));
      }
    }
  }
  if (trial.external_torque) {
    remember(*trial.external_torque);
    recording::Storage file = recording::read_storage(*trial.external_torque);
    add_repairs(*trial.external_torque, file.repairs, input.notes);
    std::vector<Channel> columns;
    std::vector<std::string> there;
    for (const std::string& name : study_coordinates(study.model)) {
      columns.push_back({name + "_moment", Unit::newton_meter});
      if (file.data.find(columns.back().name)) there.push_back(columns.back().name);
    }
    if (there.empty()) {
      throw ReadError(
          *trial.external_torque, 0,
          fmt::format("no column '{}' [N m]; found {}", columns[0].name, channel_names(file.data)));
    }
    // A dynamometer acts on one joint: on the others nothing does.
    const TimeSeries found = file.data.select(there);
    Eigen::MatrixXd torque =
        Eigen::MatrixXd::Zero(found.sample_count(), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (const auto column = found.find(columns[i].name))
        torque.col(static_cast<Eigen::Index>(i)) = found.values().col(*column);
    }
    input.external_torque = TimeSeries(found.time_s(), std::move(columns), std::move(torque));
    if (const auto clock = loads_clock(study, trial, *trial.external_torque))
      input.external_torque = signals::on_study_clock(std::move(*input.external_torque), *clock);
    require_finite(*input.external_torque, trial.external_torque->string());
  }
  input.loads = read_trial_loads(study, trial, model, input.markers, remember, input.notes);
  return input;
}

std::vector<TrialPart> read_trial_parts(const Study& study,
                                        const TrialSpec& trial,
                                        const model::BodyModel& model) {
  std::vector<TrialPart> parts;
  try {
    parts.push_back({trial, read_trial_input(study, trial, model)});
    return parts;
  } catch (const ClockPause& pause) {
    if (study.ik.calibrate) throw;
    int number = 0;
    for (const signals::ClockStretch& stretch : pause.stretches()) {
      TrialSpec spec = trial;
      spec.name = fmt::format("{}.{}", trial.name, ++number);
      spec.start_s = std::max(trial.start_s.value_or(stretch.begin_s), stretch.begin_s);
      spec.end_s = std::min(trial.end_s.value_or(stretch.end_s), stretch.end_s);
      if (*spec.end_s - *spec.start_s < kShortestPart_s) continue;
      // The other recording may pause elsewhere.
      for (TrialPart& part : read_trial_parts(study, spec, model)) parts.push_back(std::move(part));
    }
    if (parts.empty()) throw;
    for (TrialPart& part : parts) {
      warn(part.input,
           fmt::format("part of trial '{}', which is cut at the pauses of its clock ({})",
                       trial.name, pause.path().filename().string()));
    }
  }
  return parts;
}

}  // namespace myoid::pipeline
