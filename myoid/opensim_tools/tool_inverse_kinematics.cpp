#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/kinematics/inverse_kinematics.h"
#include "myoid/kinematics/marker_misfit.h"
#include "myoid/opensim_tools/opensim_files.h"
#include "myoid/opensim_tools/tool_stages.h"
#include "myoid/recording/recording.h"

namespace myoid {
namespace {

using model::OsimXml;

constexpr const char* kMotionDescription =
    "\nUnits are S.I. units (second, meters, Newtons, ...)\nIf the header above contains a line "
    "with "
    "'inDegrees', this indicates whether rotational values are in degrees (yes) or radians "
    "(no).\n\n";

recording::MarkerSeries within(recording::MarkerSeries markers, double start_s, double end_s) {
  // The rows nearest to the ends of the range, as OpenSim takes them.
  const auto nearest = [&](double t) {
    Eigen::Index row = 0;
    (markers.time_s.array() - t).abs().minCoeff(&row);
    return row;
  };
  const Eigen::Index first = std::isfinite(start_s) ? nearest(start_s) : 0;
  const Eigen::Index last = std::isfinite(end_s) ? nearest(end_s) : markers.frame_count() - 1;
  markers.time_s = markers.time_s.segment(first, last - first + 1).eval();
  markers.positions_m = markers.positions_m.middleRows(first, last - first + 1).eval();
  return markers;
}

/// What is solved: the tool itself or, in documents before 20300, the first trial of its set.
pugi::xml_node trial_of(const OpensimSetup& setup, std::vector<std::string>& notes) {
  pugi::xml_node trial = setup.tool();
  int count = 0;
  for (const auto node : OsimXml::objects(setup.tool().child("IKTrialSet"))) {
    if (std::string_view(node.name()) != "IKTrial") continue;
    if (count++ == 0) trial = node;
  }
  if (count > 1)
    notes.push_back(fmt::format("of the {} trials the first is solved, as in OpenSim", count));
  return trial;
}

}  // namespace

void run_inverse_kinematics(const OpensimSetup& setup,
                            const ToolOptions& options,
                            ToolResult& result) {
  const auto& xml = setup.xml();
  const auto tool = setup.tool();
  const auto trial = trial_of(setup, result.notes);
  const auto out = setup.output_file(trial, "output_motion_file");
  const bool report_errors = xml.flag(tool, "report_errors", true);
  const bool report_locations = xml.flag(tool, "report_marker_locations", false);
  const auto errors_file = setup.results_folder() / (setup.name() + "_ik_marker_errors.sto");
  const auto locations_file =
      setup.results_folder() / (setup.name() + "_ik_model_marker_locations.sto");
  if (out) claim_file(options, *out, result);
  if (report_errors) claim_file(options, errors_file, result);
  if (report_locations) claim_file(options, locations_file, result);
  if (!out) result.notes.push_back("the set-up has no <output_motion_file>: no motion is written");

  const model::BodyModel model = setup_model(setup, options.compat, {}, result.notes);
  const auto marker_path = setup.required_file(trial, "marker_file");
  recording::MarkerFile file = recording::read_markers(marker_path);
  for (const recording::Repair& repair : file.repairs)
    result.notes.push_back(recording::to_string(marker_path, repair));
  const auto range_s = setup.time_range(trial, "time_range");
  setup.check_range(range_s, file.markers.time_s, marker_path, result.notes);
  const recording::MarkerSeries markers =
      within(std::move(file.markers), range_s.first, range_s.second);

  kinematics::IkOptions ik = read_ik_tasks(setup, tool, model, markers, result.notes);
  ik.progress = options.progress;
  const kinematics::IkResult solved = kinematics::inverse_kinematics(model, markers, ik);
  // What no task asks for need not be said.
  if (!ik.only_named_markers)
    result.notes.insert(result.notes.end(), solved.notes.begin(), solved.notes.end());
  if (out) {
    write_opensim_storage(
        *out, with_file_units(model, solved.q),
        {.title = "Coordinates", .in_degrees = true, .description = kMotionDescription});
  }
  if (report_errors) {
    write_opensim_storage(
        errors_file,
        solved.errors.select({"total_squared_error", "marker_error_RMS", "marker_error_max"}),
        {.title = "Model Marker Errors from IK"});
  }
  if (report_locations) {
    write_opensim_storage(locations_file, solved.marker_locations,
                          {.title = "Model Marker Locations from IK"});
  }
  result.frames = static_cast<int>(solved.status.size());
  result.frames_failed = solved.frames_not_converged;
  for (std::size_t i = 0; i < solved.status.size(); ++i) {
    if (solved.status[i] == kinematics::FrameStatus::not_converged)
      result.notes.push_back(fmt::format("no converged solution at {} s",
                                         markers.time_s[static_cast<Eigen::Index>(i)]));
  }
  if (!solved.undetermined.empty()) {
    std::string names;
    for (const std::string& name : solved.undetermined) names += (names.empty() ? "" : ", ") + name;
    result.notes.push_back("not determined by the markers: " + names);
  }
  const kinematics::MarkerMisfit misfit = kinematics::marker_misfit(model, markers, solved);
  if (!misfit.warning.empty()) result.notes.push_back(misfit.warning);
  result.wrong_unit = misfit.wrong_unit;
  result.summary = fmt::format(
      "{} frames, {} not converged, {} without markers; marker error {:.2f} mm rms{}",
      result.frames, solved.frames_not_converged, solved.frames_without_markers,
      1000.0 * misfit.rms_m, misfit.wrong_unit ? " (the unit of the markers is wrong)" : "");
}

}  // namespace myoid
