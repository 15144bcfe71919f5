#include "myoid/program/commands/ik.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/files/output_file.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/option_checks.h"

namespace myoid::program {
namespace {

void print_ik(const program::IkResult& result, const std::string& out, const Context& context) {
  const body::IkResult& ik = result.solved;
  const std::string errors = program::marker_errors_path(out).string();
  const double worst_mm = 1000.0 * result.misfit.rms_m;
  context.print({{"out", out},
                 {"marker_errors", errors},
                 {"frames", ik.status.size()},
                 {"frames_not_converged", ik.frames_not_converged},
                 {"not_converged", result.not_converged},
                 {"frames_without_markers", ik.frames_without_markers},
                 {"marker_error_rms_m", worst_mm / 1000.0},
                 {"wrong_unit", result.misfit.wrong_unit},
                 {"undetermined", ik.open_coordinates}},
                fmt::format("{} frames, {} not converged, {} without markers; marker error {:.2f} mm rms{}\n{}\n{}",
                            ik.status.size(), ik.frames_not_converged, ik.frames_without_markers, worst_mm,
                            result.misfit.wrong_unit ? " (the unit of the markers is wrong)" : "", out, errors));
}

}  // namespace

void add_ik(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand("ik",
                                          "Inverse kinematics: markers to joint angles.\n"
                                          "Example: myoid ik --model arm.osim --markers flex.trc --out ik.mot");
  const auto out = std::make_shared<std::string>();
  const auto o = std::make_shared<program::IkOptions>();
  command.add_option("--model", o->model, "OpenSim model (.osim), or arm4")->required();
  command.add_option("--markers", o->markers, "Markers (.trc, .c3d)")->required();
  command.add_option("--out", *out, "Joint angles (.mot); the marker errors go beside it")->required();
  command
      .add_option(
          "--up", o->up,
          "Vertical axis of the laboratory: x, y, z, -x, -y or -z (default: as a .c3d file says, else as the model)")
      ->check(one_of({"x", "y", "z", "-x", "-y", "-z"}));
  command.add_option("--weight", o->weights, "MARKER=WEIGHT, repeated; 1 where not given");
  command.add_option("--lock", o->lock, "Coordinate held at its default value, repeated");
  command.add_option("--unlock", o->unlock, "Coordinate freed although the model locks it, repeated");
  add_compat_option(command, context);
  add_common_options(command, context, {.threads = false, .seed = false});
  command.callback([&context, o, out] {
    context.prepare_file(*out, {o->model, o->markers});
    check_companion(program::marker_errors_path(*out), {o->model, o->markers}, context.overwrite,
                    program::kMarkerErrorsBegin);
    o->call = context.call();
    o->compat = context.compat;
    const program::IkResult result = program::ik(*o);
    context.end_progress();
    program::write_ik(result, *out);
    print_ik(result, *out, context);
    if (result.misfit.wrong_unit || result.solved.frames_not_converged > 0) context.exit_code = kQualityGateFailed;
  });
}

}  // namespace myoid::program
