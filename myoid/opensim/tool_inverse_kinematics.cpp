#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/body/kinematics/marker_misfit.h"
#include "myoid/body/kinematics/motion_plausibility.h"
#include "myoid/body/model/model_plausibility.h"
#include "myoid/opensim/opensim_files.h"
#include "myoid/opensim/tool_stages.h"
#include "myoid/recording/recording.h"

namespace myoid::opensim {
namespace {

using body::OsimXml;

MarkerSeries within(MarkerSeries markers, double start_s, double end_s) {
  // The rows nearest to the ends of the range, the later of two equally near, as OpenSim takes them.
  const auto nearest = [&](double t) {
    const double* begin = markers.time_s.data();
    const double* end = begin + markers.frame_count();
    const double* after = std::lower_bound(begin, end, t);
    if (after == begin) return Eigen::Index{0};
    const bool is_after = after != end && *after - t <= t - *(after - 1);
    return static_cast<Eigen::Index>((is_after ? after : after - 1) - begin);
  };
  const Eigen::Index first = std::isfinite(start_s) ? nearest(start_s) : 0;
  const Eigen::Index last = std::isfinite(end_s) ? nearest(end_s) : markers.frame_count() - 1;
  markers.time_s = markers.time_s.segment(first, last - first + 1).eval();
  markers.positions_m = markers.positions_m.middleRows(first, last - first + 1).eval();
  return markers;
}

/// Returns the element with the task: the tool itself or, in documents before 20300, the first trial of its set.
pugi::xml_node trial_of(const ToolRun& run) {
  pugi::xml_node trial = run.setup.tool();
  int count = 0;
  for (const auto node : OsimXml::objects(run.setup.tool().child("IKTrialSet"))) {
    if (std::string_view(node.name()) != "IKTrial") continue;
    if (count++ == 0) trial = node;
  }
  if (count > 1) run.note("of the {} trials the first is solved, as in OpenSim", count);
  return trial;
}

/// The files that the set-up asks for; empty where it does not ask for one.
struct IkFiles {
  std::optional<std::filesystem::path> motion, errors, locations;
};

IkFiles claimed_files(const ToolRun& run, pugi::xml_node trial) {
  const OpensimSetup& setup = run.setup;
  const auto report = [&](const char* flag, bool otherwise, const char* ending) {
    return setup.xml().flag(setup.tool(), flag, otherwise)
               ? std::optional(setup.results_folder() / (setup.name() + ending))
               : std::nullopt;
  };
  const IkFiles files{setup.output_file(trial, "output_motion_file"),
                      report("report_errors", true, "_ik_marker_errors.sto"),
                      report("report_marker_locations", false, "_ik_model_marker_locations.sto")};
  for (const auto& file : {files.motion, files.errors, files.locations})
    if (file) run.claim(*file);
  if (!files.motion) run.note("the set-up has no <output_motion_file>: no motion is written");
  return files;
}

void write_files(const IkFiles& files, const body::BodyModel& model, const body::IkResult& solved) {
  if (files.motion) {
    write_opensim_storage(*files.motion, with_file_units(model, solved.q),
                          {.title = "Coordinates", .in_degrees = true, .description = std::string("\n") + kUnitsNote});
  }
  if (files.errors) {
    write_opensim_storage(*files.errors,
                          solved.errors.select({"total_squared_error", "marker_error_RMS", "marker_error_max"}),
                          {.title = "Model Marker Errors from IK"});
  }
  if (files.locations) {
    write_opensim_storage(*files.locations, solved.marker_locations, {.title = "Model Marker Locations from IK"});
  }
}

/// Notes the frames without a converged solution and the coordinates that no marker determines.
void note_unsolved(const ToolRun& run, const body::IkResult& solved) {
  for (std::size_t i = 0; i < solved.status.size(); ++i) {
    if (solved.status[i] == body::FrameStatus::not_converged)
      run.note("no converged solution at {} s", solved.q.time_s()[static_cast<Eigen::Index>(i)]);
  }
  if (!solved.open_coordinates.empty()) {
    run.note("not determined by the markers: {}", fmt::join(solved.open_coordinates, ", "));
  }
}

}  // namespace

void run_inverse_kinematics(const ToolRun& run) {
  const OpensimSetup& setup = run.setup;
  ToolResult& result = run.result;
  const auto trial = trial_of(run);
  const IkFiles files = claimed_files(run, trial);
  const body::BodyModel model = setup_model(setup, run.options.compat, {}, result.remarks);
  const auto marker_path = setup.required_file(trial, "marker_file");
  recording::MarkerFile file = recording::read_markers(marker_path);
  for (const Repair& repair : file.repairs)
    result.remarks.push_back({.code = RemarkCode::reading, .says = recording::to_string(marker_path, repair)});
  const auto range_s = setup.time_range(trial, "time_range");
  setup.check_range(range_s, file.markers.time_s, marker_path, result.remarks);
  const MarkerSeries markers = within(std::move(file.markers), range_s.first, range_s.second);

  body::IkOptions ik = read_ik_tasks(setup, setup.tool(), model, markers, result.remarks);
  ik.progress = run.options.progress;
  const body::IkResult solved = body::inverse_kinematics(model, markers, ik);
  // Tasks name the markers that count: markers without counterpart are no news then.
  if (!ik.only_named_markers) run.add_notes(solved.notes);
  run.add_remarks(body::implausible(model), setup.required_file(setup.tool(), "model_file").string());
  run.add_remarks(body::implausible_motion(solved.q), marker_path.string());
  write_files(files, model, solved);
  result.frames = static_cast<int>(solved.status.size());
  result.frames_failed = solved.frames_not_converged;
  note_unsolved(run, solved);
  for (const Remark& remark : body::remarks_on_ends(model, solved.q))
    result.remarks.push_back({.says = sentence(remark)});
  const body::MarkerMisfit misfit = body::marker_misfit(model, markers, solved);
  if (!misfit.warning.empty()) result.remarks.push_back({.says = misfit.warning});
  result.wrong_unit = misfit.wrong_unit;
  result.summary = fmt::format("{} frames, {} not converged, {} without markers; marker error {:.2f} mm rms{}",
                               result.frames, solved.frames_not_converged, solved.frames_without_markers,
                               1000.0 * misfit.rms_m, misfit.wrong_unit ? " (the unit of the markers is wrong)" : "");
}

}  // namespace myoid::opensim
