#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/cli/context.h"
#include "myoid/cli/stage_input.h"
#include "myoid/core/error.h"
#include "myoid/core/json_text.h"
#include "myoid/kinematics/inverse_kinematics.h"
#include "myoid/kinematics/marker_misfit.h"
#include "myoid/recording/plate_standing.h"
#include "myoid/recording/recording.h"
#include "myoid/results/stage_files.h"
#include "myoid/study/trial_up.h"

namespace myoid::cli {
namespace {

/// Runs of frames that did not converge: "12 to 15 (0.11 to 0.14 s)". Frames count from 1, as in
/// the first column of a .trc.
std::vector<std::string> not_converged(const kinematics::IkResult& result) {
  std::vector<std::string> runs;
  const auto fails = [&](std::size_t i) {
    return i < result.status.size() && result.status[i] == kinematics::FrameStatus::not_converged;
  };
  const auto time = [&](std::size_t i) { return result.q.time_s()[static_cast<Eigen::Index>(i)]; };
  for (std::size_t first = 0; first < result.status.size(); ++first) {
    if (!fails(first)) continue;
    std::size_t last = first;
    while (fails(last + 1)) ++last;
    runs.push_back(last == first ? fmt::format("{} ({:.6g} s)", first + 1, time(first))
                                 : fmt::format("{} to {} ({:.6g} to {:.6g} s)", first + 1, last + 1,
                                               time(first), time(last)));
    first = last;
  }
  return runs;
}

}  // namespace

namespace {

/// The rotation of a marker file's laboratory onto the model's: with `up` ("z", "-y"), or where it
/// is empty as the file says, which is logged; a file that does not say stands as the model.
Mat3 onto_model(const model::BodyModel& model,
                const std::string& markers,
                const std::string& up,
                const Context& context) {
  if (const auto told = recording::axis_vector(up)) return rotation_onto(model, *told);
  const recording::LaboratoryUp own = trial_up(kUpOfTheFile, markers, model);
  if (*own.up_L != model_up(model))
    context.log(fmt::format("note: {}: {}", markers, up_note(own, model)));
  return rotation_onto(model, *own.up_L);
}

}  // namespace

void add_ik(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("ik",
                          "Inverse kinematics: markers to joint angles.\n"
                          "Example: myoid ik --model arm.osim --markers flex.trc --out ik.mot");
  struct Options {
    std::string model, markers, out, up;
    std::vector<std::string> weights, lock, unlock;
  };
  const auto o = std::make_shared<Options>();
  command.add_option("--model", o->model, "OpenSim model (.osim), or arm4")->required();
  command.add_option("--markers", o->markers, "Markers (.trc, .c3d)")->required();
  command.add_option("--out", o->out, "Joint angles (.mot); the marker errors go beside it")
      ->required();
  command
      .add_option("--up", o->up,
                  "Vertical axis of the laboratory: x, y, z, -x, -y or -z "
                  "(default: as a .c3d file says, else as the model)")
      ->check(CLI::IsMember({"x", "y", "z", "-x", "-y", "-z"}));
  command.add_option("--weight", o->weights, "MARKER=WEIGHT, repeated; 1 where not given");
  command.add_option("--lock", o->lock, "Coordinate held at its default value, repeated");
  command.add_option("--unlock", o->unlock,
                     "Coordinate freed although the model locks it, repeated");
  add_compat_option(command, context);
  add_common_options(command, context, {.threads = false, .seed = false});
  command.callback([&context, o] {
    const std::filesystem::path out = o->out;
    const auto errors = out.parent_path() / (out.stem().string() + "_marker_errors.sto");
    context.prepare_file(out, {o->model, o->markers});
    context.prepare_file(errors, {o->model, o->markers});
    model::BodyModel model = load_model(o->model, context);
    for (const std::string& name : o->lock)
      model.coordinates[static_cast<std::size_t>(model.coordinate_index(name))].locked = true;
    for (const std::string& name : o->unlock)
      model.coordinates[static_cast<std::size_t>(model.coordinate_index(name))].locked = false;
    recording::MarkerFile file = recording::read_markers(o->markers);
    for (const recording::Repair& repair : file.repairs)
      context.warn(recording::to_string(o->markers, repair));
    recording::MarkerSeries markers =
        recording::rotated(std::move(file.markers), onto_model(model, o->markers, o->up, context));
    if (context.start_s || context.end_s) {
      Eigen::Index first = 0;
      while (first < markers.frame_count() &&
             markers.time_s[first] < context.start_s.value_or(-1e300))
        ++first;
      Eigen::Index last = markers.frame_count();
      while (last > first && markers.time_s[last - 1] > context.end_s.value_or(1e300)) --last;
      if (last == first) throw InvalidInput("no frames lie between --start and --end");
      markers.time_s = markers.time_s.segment(first, last - first).eval();
      markers.positions_m = markers.positions_m.middleRows(first, last - first).eval();
    }
    kinematics::IkOptions options{.progress = context.progress()};
    for (const std::string& pair : o->weights) {
      const std::size_t equal = pair.rfind('=');
      const auto value = equal == std::string::npos
                             ? std::nullopt
                             : recording::parse_number(pair.substr(equal + 1));
      if (!value) throw InvalidInput(fmt::format("--weight {}: expected MARKER=NUMBER", pair));
      options.marker_weights[pair.substr(0, equal)] = *value;
    }
    const kinematics::IkResult result = kinematics::inverse_kinematics(model, markers, options);
    context.end_progress();
    for (const std::string& note : result.notes) context.warn(note);
    write_motion(model, result.q, o->out, {});
    write_marker_errors(result, errors);
    const kinematics::MarkerMisfit misfit = kinematics::marker_misfit(model, markers, result);
    if (!misfit.warning.empty()) context.warn(misfit.warning);
    if (misfit.wrong_unit) context.exit_code = kQualityGateFailed;
    const double worst_mm = 1000.0 * misfit.rms_m;
    const std::vector<std::string> stalled = not_converged(result);
    if (!stalled.empty())
      context.warn(fmt::format("not converged: frames {}", fmt::join(stalled, ", ")));
    if (!result.undetermined.empty())
      context.warn(
          fmt::format("not determined by the markers: {}", fmt::join(result.undetermined, ", ")));
    if (context.json) {
      const nlohmann::ordered_json json{{"out", o->out},
                                        {"marker_errors", errors.string()},
                                        {"frames", result.status.size()},
                                        {"frames_not_converged", result.frames_not_converged},
                                        {"not_converged", stalled},
                                        {"frames_without_markers", result.frames_without_markers},
                                        {"marker_error_rms_m", worst_mm / 1000.0},
                                        {"wrong_unit", misfit.wrong_unit},
                                        {"undetermined", result.undetermined}};
      fmt::print("{}\n", json_text(json));
    } else {
      fmt::print("{} frames, {} not converged, {} without markers; marker error {:.2f} mm rms{}\n",
                 result.status.size(), result.frames_not_converged, result.frames_without_markers,
                 worst_mm, misfit.wrong_unit ? " (the unit of the markers is wrong)" : "");
      fmt::print("{}\n{}\n", o->out, errors.string());
    }
    if (result.frames_not_converged > 0) context.exit_code = kQualityGateFailed;
  });
}

}  // namespace myoid::cli
