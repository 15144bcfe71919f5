#include "myoid/study/intake/trial_markers.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/kinematics/marker_misfit.h"
#include "myoid/body/kinematics/marker_places.h"
#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/files/label_match.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/signals/marker_quality.h"
#include "myoid/recording/signals/mend_markers.h"
#include "myoid/study/intake/clock_check.h"
#include "myoid/study/trial_up.h"

namespace myoid::study {
namespace {

/// Renames labels whose spelling alone differs from the model's.
void match_labels(const body::BodyModel& model,
                  const std::filesystem::path& path,
                  std::vector<std::string>& names,
                  TrialInput& input) {
  std::vector<std::string> wanted;
  for (const body::Marker& marker : model.markers) wanted.push_back(marker.name);
  const LabelMatch match = ground::match_labels(names, wanted);
  for (std::string& name : names) {
    const auto same = match.same.find(name);
    if (same == match.same.end()) continue;
    add_notes(
        {fmt::format("{}: marker '{}' is taken for the model's '{}'", path.filename().string(), name, same->second)},
        input.remarks);
    name = same->second;
  }
}

/// Renames the markers as the study says. Notes a name that the file lacks, as well as the new one.
void rename_markers(const Study& study,
                    const std::filesystem::path& path,
                    std::vector<std::string>& names,
                    TrialInput& input) {
  for (const auto& [from, to] : study.markers.rename) {
    const bool there = std::ranges::find(names, from) != names.end() || std::ranges::find(names, to) != names.end();
    if (!there)
      add_notes({fmt::format("{}: [markers] rename has no effect: there is no marker '{}'{}", path.filename().string(),
                             from, did_you_mean(from, names))},
                input.remarks);
  }
  for (std::string& name : names) {
    if (const auto it = study.markers.rename.find(name); it != study.markers.rename.end()) name = it->second;
  }
}

/// Asks about markers that stand at places of the model's under another name.
void ask_by_place(const body::BodyModel& model,
                  const std::filesystem::path& path,
                  const MarkerSeries& markers,
                  TrialInput& input) {
  const std::vector<body::PlacedMarker> pairs = body::markers_by_place(model, markers);
  if (!pairs.empty())
    add_notes({fmt::format("{}: {} Then name them in [markers] rename", path.filename().string(),
                           body::place_question(pairs))},
              input.remarks);
}

MarkerSeries read_markers(const Study& study,
                          const body::BodyModel& model,
                          const std::filesystem::path& path,
                          TrialInput& input) {
  recording::MarkerFile file = recording::read_markers(path);
  std::vector<Remark>& remarks = input.remarks;
  add_repairs(path, file.repairs, remarks);
  rename_markers(study, path, file.markers.names, input);
  match_labels(model, path, file.markers.names, input);
  ask_by_place(model, path, file.markers, input);
  const recording::LaboratoryUp up = trial_up(study.markers.up, path, model);
  input.up_L = *up.up_L;
  if (*up.up_L != model_up(model)) {
    add_notes({fmt::format("{}: {}", path.filename().string(), up_note(up, model))}, remarks);
    file.markers = rotated(std::move(file.markers), rotation_onto(model, *up.up_L));
  }
  return std::move(file.markers);
}

/// Returns the frames from `start_s` to `end_s`, both included.
MarkerSeries frames_between(const MarkerSeries& markers, double start_s, double end_s) {
  const double* const begin = markers.time_s.data();
  const double* const end = begin + markers.frame_count();
  const double* const first = std::lower_bound(begin, end, start_s);
  const Eigen::Index count = std::upper_bound(first, end, end_s) - first;
  return {markers.time_s.segment(first - begin, count), markers.names,
          markers.positions_m.middleRows(first - begin, count)};
}

/// Returns true for a marker on which the model's pose rests.
bool is_used(const Study& study, const body::BodyModel& model, const std::string& marker) {
  const auto weight = study.markers.weight.find(marker);
  return model.find_marker(marker) && (weight == study.markers.weight.end() || weight->second > 0.0);
}

/// Joins the gaps of markers that the model does not use in one note. All other faults of these markers become notes.
std::vector<Remark> without_idle_markers(const Study& study,
                                         const body::BodyModel& model,
                                         const MarkerSeries& markers,
                                         std::vector<Remark> faults) {
  std::vector<Remark> kept;
  std::vector<std::string> idle;
  for (Remark& fault : faults) {
    const bool of_one = std::ranges::find(markers.names, fault.about) != markers.names.end();
    if (of_one && !is_used(study, model, fault.about)) {
      fault.severity = std::max(fault.severity, Severity::note);
      if (fault.code == RemarkCode::marker_gap) {
        idle.push_back(fault.about);
        continue;
      }
    }
    kept.push_back(std::move(fault));
  }
  if (!idle.empty())
    kept.push_back({.code = RemarkCode::marker_gap,
                    .severity = Severity::note,
                    .about = fmt::format("{}", fmt::join(idle, ", ")),
                    .says = fmt::format("{} that the model does not use {} gaps: {}", counted(idle.size(), "marker"),
                                        idle.size() == 1 ? "has" : "have", some_of(idle))});
  return kept;
}

/// Says of the gaps in use how they were filled.
void tell_filled(const std::map<std::string, std::string>& filled, std::vector<Remark>& faults) {
  for (Remark& fault : faults) {
    const auto words = fault.code == RemarkCode::marker_gap ? filled.find(fault.about) : filled.end();
    if (words != filled.end()) fault.says += ": " + words->second;
  }
}

/// Notes the faults of the markers and repairs as many as possible.
MarkerSeries mended(const Study& study,
                    const body::BodyModel& model,
                    const std::filesystem::path& path,
                    MarkerSeries markers,
                    TrialInput& input) {
  const std::vector<recording::ExpectedSegment> expected = body::segments_of(model, markers);
  input.marker_faults = without_idle_markers(study, model, markers, recording::check_markers(markers, expected));
  bool right_unit = true;
  for (const Remark& fault : input.marker_faults) {
    right_unit = right_unit && fault.code != RemarkCode::marker_unit;
    // In a wrong unit no other check of the trial is meaningful.
    if (fault.severity == Severity::error) throw ReadError(path, 0, sentence(fault));
  }
  if (!right_unit) return markers;
  std::vector<recording::RigidSegment> segments;
  for (const recording::ExpectedSegment& e : expected) segments.push_back(e.segment);
  recording::MendedMarkers result = recording::mend_markers(
      std::move(markers), segments, {.undo_swaps = study.markers.undo_swaps, .fill_gaps = study.markers.fill_gaps});
  add_notes(result.swaps, input.remarks);
  tell_filled(result.filled, input.marker_faults);
  return std::move(result.markers);
}

}  // namespace

MarkerSeries read_trial_markers(const Study& study,
                                const TrialSpec& trial,
                                const body::BodyModel& model,
                                TrialInput& input) {
  MarkerSeries markers = read_markers(study, model, *trial.markers, input);
  if (trial.start_s || trial.end_s)
    markers = frames_between(markers, trial.start_s.value_or(-1e300), trial.end_s.value_or(1e300));
  if (markers.frame_count() < 10)
    throw ReadError(*trial.markers, 0, fmt::format("only {} frames; at least 10 are needed", markers.frame_count()));
  if (std::string pauses = check_clock(*trial.markers, markers.time_s); !pauses.empty())
    warn(input, RemarkCode::clock_pause, std::move(pauses));
  check_cutoff(study, *trial.markers, markers.time_s);
  return mended(study, model, *trial.markers, std::move(markers), input);
}

MarkerSeries calibration_window(const CalibrationSpec& spec, const MarkerSeries& markers) {
  MarkerSeries window = frames_between(markers, spec.window_s[0], spec.window_s[1]);
  if (window.frame_count() < 2)
    throw InvalidInput(
        fmt::format("[ik] calibrate: no frames between {} and {} s", spec.window_s[0], spec.window_s[1]));
  return window;
}

}  // namespace myoid::study
