#include "myoid/program/steps/ik.h"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/kinematics/motion_plausibility.h"
#include "myoid/ground/core/error.h"
#include "myoid/program/steps/check_options.h"
#include "myoid/program/steps/stage_input.h"
#include "myoid/recording/recording.h"
#include "myoid/results/stage_files.h"

namespace myoid::program {
namespace {

/// Returns the runs of frames that did not converge: "12 to 15 (0.11 to 0.14 s)". Frames count from
/// 1, as in the first column of a .trc.
std::vector<std::string> runs_not_converged(const body::IkResult& result) {
  std::vector<std::string> runs;
  const auto fails = [&](std::size_t i) {
    return i < result.status.size() && result.status[i] == body::FrameStatus::not_converged;
  };
  const auto time = [&](std::size_t i) { return result.q.time_s()[static_cast<Eigen::Index>(i)]; };
  for (std::size_t first = 0; first < result.status.size(); ++first) {
    if (!fails(first)) continue;
    std::size_t last = first;
    while (fails(last + 1)) ++last;
    runs.push_back(last == first
                       ? fmt::format("{} ({:.6g} s)", first + 1, time(first))
                       : fmt::format("{} to {} ({:.6g} to {:.6g} s)", first + 1, last + 1, time(first), time(last)));
    first = last;
  }
  return runs;
}

body::BodyModel read_posed_model(const IkOptions& o, Remarks& remarks) {
  body::BodyModel model = load_model(o.model, o.compat, remarks);
  for (const std::string& name : o.lock)
    model.coordinates[static_cast<std::size_t>(model.coordinate_index(name))].locked = true;
  for (const std::string& name : o.unlock)
    model.coordinates[static_cast<std::size_t>(model.coordinate_index(name))].locked = false;
  return model;
}

std::map<std::string, double> marker_weights(const std::vector<std::string>& pairs) {
  std::map<std::string, double> weights;
  for (const std::string& pair : pairs) {
    const std::size_t equal = pair.rfind('=');
    const auto value = equal == std::string::npos ? std::nullopt : parse_number(pair.substr(equal + 1));
    if (!value) throw InvalidInput(fmt::format("--weight {}: expected MARKER=NUMBER", pair));
    weights[pair.substr(0, equal)] = *value;
  }
  return weights;
}

}  // namespace

void visit(IkOptions& o, study::SettingVisitor& v) {
  visit_model(o.model, v);
  v.path("markers", o.markers, {.says = "Markers (.trc, .c3d).", .required = "a file"});
  v.path("out", o.out, {.says = "Joint angles (.mot); the marker errors go beside it.", .required = "a file"});
  visit_up(o.up, v,
           {.says = "Vertical axis of the laboratory.", .otherwise = "as a .c3d file says, else as the model"});
  v.texts("weight", o.weights, {.says = "MARKER=WEIGHT, repeated; 1 where not given."});
  v.texts("lock", o.lock, {.says = "Coordinate held at its default value, repeated."});
  v.texts("unlock", o.unlock, {.says = "Coordinate freed although the model locks it, repeated."});
  visit_compat(o.compat, v);
}

IkResult ik(const IkOptions& o) {
  check_options(o);
  Remarks remarks(o.call);
  IkResult result;
  result.model = read_posed_model(o, remarks);
  recording::MarkerFile file = recording::read_markers(o.markers);
  warn_of_repairs(o.markers, file.repairs, remarks);
  const MarkerSeries markers =
      cut(rotated(std::move(file.markers), onto_model(result.model, o.markers, o.up, remarks)), o.call);
  const body::IkOptions options{.marker_weights = marker_weights(o.weights), .progress = o.call.progress};
  result.solved = body::inverse_kinematics(result.model, markers, options);
  for (std::string& note : sentences(result.solved.notes)) remarks.warn(std::move(note));
  for (Remark& remark : body::remarks_on_ends(result.model, result.solved.q)) remarks.add(std::move(remark));
  result.misfit = body::marker_misfit(result.model, markers, result.solved);
  if (!result.misfit.warning.empty()) remarks.warn(result.misfit.warning);
  result.not_converged = runs_not_converged(result.solved);
  if (!result.not_converged.empty())
    remarks.warn(fmt::format("not converged: frames {}", fmt::join(result.not_converged, ", ")));
  remarks.add(body::implausible_motion(result.solved.q), o.markers);
  if (!result.solved.open_coordinates.empty())
    remarks.warn(fmt::format("not determined by the markers: {}", fmt::join(result.solved.open_coordinates, ", ")));
  result.remarks = remarks.list();
  return result;
}

std::filesystem::path marker_errors_path(const std::filesystem::path& motion) {
  return motion.parent_path() / (motion.stem().string() + "_marker_errors.sto");
}

void write_ik(const IkResult& result, const std::filesystem::path& path) {
  results::write_motion(result.model, result.solved.q, path, {});
  results::write_marker_errors(result.solved, marker_errors_path(path));
}

}  // namespace myoid::program
