#include "myoid/intake/trial_markers.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/files/label_match.h"
#include "myoid/intake/clock_check.h"
#include "myoid/kinematics/marker_misfit.h"
#include "myoid/kinematics/marker_places.h"
#include "myoid/recording/recording.h"
#include "myoid/signals/marker_quality.h"
#include "myoid/signals/mend_markers.h"
#include "myoid/study/trial_up.h"

namespace myoid {
namespace {

/// Renames labels whose spelling alone differs from the model's.
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
    add_notes(
        {fmt::format("{}: marker '{}' is taken for the model's '{}'", path.filename().string(), name, same->second)},
        input.remarks);
    name = same->second;
  }
}

/// Asks about markers that stand at places of the model's under another name.
void ask_by_place(const model::BodyModel& model,
                  const std::filesystem::path& path,
                  const recording::MarkerSeries& markers,
                  TrialInput& input) {
  const std::vector<kinematics::PlacedMarker> pairs = kinematics::markers_by_place(model, markers);
  if (!pairs.empty())
    add_notes({fmt::format("{}: {} Then name them in [markers] rename", path.filename().string(),
                           kinematics::place_question(pairs))},
              input.remarks);
}

recording::MarkerSeries read_markers(const Study& study,
                                     const model::BodyModel& model,
                                     const std::filesystem::path& path,
                                     TrialInput& input) {
  recording::MarkerFile file = recording::read_markers(path);
  std::vector<Remark>& remarks = input.remarks;
  add_repairs(path, file.repairs, remarks);
  for (std::string& name : file.markers.names) {
    if (const auto it = study.markers.rename.find(name); it != study.markers.rename.end()) name = it->second;
  }
  match_labels(model, path, file.markers.names, input);
  ask_by_place(model, path, file.markers, input);
  const recording::LaboratoryUp up = trial_up(study.markers.up, path, model);
  input.up_L = *up.up_L;
  if (*up.up_L != model_up(model)) {
    add_notes({fmt::format("{}: {}", path.filename().string(), up_note(up, model))}, remarks);
    file.markers = recording::rotated(std::move(file.markers), rotation_onto(model, *up.up_L));
  }
  return std::move(file.markers);
}

/// Returns the frames from `start_s` to `end_s`, both included.
recording::MarkerSeries frames_between(const recording::MarkerSeries& markers, double start_s, double end_s) {
  const double* const begin = markers.time_s.data();
  const double* const end = begin + markers.frame_count();
  const double* const first = std::lower_bound(begin, end, start_s);
  const Eigen::Index count = std::upper_bound(first, end, end_s) - first;
  return {markers.time_s.segment(first - begin, count), markers.names,
          markers.positions_m.middleRows(first - begin, count)};
}

/// Notes the faults of the markers and repairs as many as possible.
recording::MarkerSeries mended(const Study& study,
                               const model::BodyModel& model,
                               const std::filesystem::path& path,
                               recording::MarkerSeries markers,
                               TrialInput& input) {
  const std::vector<signals::ExpectedSegment> expected = kinematics::segments_of(model, markers);
  input.marker_faults = signals::check_markers(markers, expected);
  bool right_unit = true;
  for (Remark& fault : input.marker_faults) {
    right_unit = right_unit && fault.code != RemarkCode::marker_unit;
    // In a wrong unit no other check of the trial is meaningful.
    if (fault.severity == Severity::error) throw ReadError(path, 0, sentence(fault));
    const bool used =
        std::ranges::any_of(model.markers, [&](const model::Marker& marker) { return fault.about == marker.name; });
    // A fault of a marker that the model lacks has no effect.
    const bool of_one = std::ranges::find(markers.names, fault.about) != markers.names.end();
    if (of_one && !used) fault.severity = Severity::note;
  }
  if (!right_unit) return markers;
  std::vector<signals::RigidSegment> segments;
  for (const signals::ExpectedSegment& e : expected) segments.push_back(e.segment);
  signals::MendedMarkers result = signals::mend_markers(
      std::move(markers), segments, {.undo_swaps = study.markers.undo_swaps, .fill_gaps = study.markers.fill_gaps});
  add_notes(result.repairs, input.remarks);
  return std::move(result.markers);
}

}  // namespace

recording::MarkerSeries read_trial_markers(const Study& study,
                                           const TrialSpec& trial,
                                           const model::BodyModel& model,
                                           TrialInput& input) {
  recording::MarkerSeries markers = read_markers(study, model, *trial.markers, input);
  if (trial.start_s || trial.end_s)
    markers = frames_between(markers, trial.start_s.value_or(-1e300), trial.end_s.value_or(1e300));
  if (markers.frame_count() < 10)
    throw ReadError(*trial.markers, 0, fmt::format("only {} frames; at least 10 are needed", markers.frame_count()));
  if (std::string pauses = check_clock(*trial.markers, markers.time_s); !pauses.empty())
    warn(input, RemarkCode::clock_pause, std::move(pauses));
  check_cutoff(study, *trial.markers, markers.time_s);
  return mended(study, model, *trial.markers, std::move(markers), input);
}

recording::MarkerSeries calibration_window(const CalibrationSpec& spec, const recording::MarkerSeries& markers) {
  recording::MarkerSeries window = frames_between(markers, spec.window_s[0], spec.window_s[1]);
  if (window.frame_count() < 2)
    throw InvalidInput(
        fmt::format("[ik] calibrate: no frames between {} and {} s", spec.window_s[0], spec.window_s[1]));
  return window;
}

}  // namespace myoid
