#include "myoid/program/commands/so.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/files/output_file.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/option_checks.h"

namespace myoid::program {
namespace {

void print_so(const body::MuscleForces& shared, const std::string& out, const Context& context) {
  context.print({{"out", out},
                 {"frames", shared.status.size()},
                 {"frames_not_solved", shared.frames_not_solved},
                 {"frames_with_reserve", shared.frames_with_reserve},
                 {"largest_kkt_residual", shared.kkt_residual.maxCoeff()}},
                fmt::format("{} frames: {} not solved, {} where a reserve helps; largest KKT residual {:.1e}\n{}",
                            shared.status.size(), shared.frames_not_solved, shared.frames_with_reserve,
                            shared.kkt_residual.maxCoeff(), out));
}

}  // namespace

void add_so(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand("so",
                                          "Muscle force sharing (static optimization): which forces make the torques?\n"
                                          "Example: myoid so --model arm.osim --motion ik.mot --lowpass 6 --out so");
  const auto out = std::make_shared<std::string>();
  const auto o = std::make_shared<program::SoOptions>();
  command.add_option("--model", o->model, "OpenSim model (.osim), or arm4")->required();
  command.add_option("--motion", o->motion, "Joint angles (.mot, .sto)")->required();
  command.add_option("--out", *out, "Folder for StaticOptimization_*")->required();
  command.add_option("--objective", o->objective, "activation, force or stress (default activation)")
      ->check(one_of({"activation", "force", "stress"}));
  command.add_option("--exponent", o->exponent, "Exponent of the sum, above 1 (default 2)");
  command.add_option("--emg", o->emg, "Measured activations by muscle name (.sto), to stay near");
  command.add_option("--emg-weight", o->emg_weight, "Weight of that term (default 1)");
  command.add_option("--reserve", o->reserve_nm, "Optimal torque of the reserve on every coordinate [N m] (default 1)");
  command.add_option(
      "--coordinate", o->coordinates,
      "Coordinate whose torque the muscles balance, repeated (default: all that take a value of their own)");
  command
      .add_option("--lowpass", o->cutoff_hz, "Smooth the angles, -3 dB at this frequency [Hz] (default: not smoothed)")
      ->check(above_zero());
  command.add_option("--loads", o->loads, "Forces measured on bodies: an <ExternalLoads> file (.xml) of OpenSim");
  command
      .add_option("--tendon", o->tendon,
                  "rigid, or elastic: fiber and tendon in balance by the muscle's own curves, in every frame for "
                  "itself: the tendon's own rate is left out (default rigid)")
      ->check(one_of({"rigid", "elastic"}));
  command.add_flag("--passive", o->passive,
                   "The fibers' passive springs and dampers pull too, and the muscles share the rest");
  add_compat_option(command, context);
  add_common_options(command, context, {.seed = false});
  command.callback([&context, o, out] {
    context.prepare_folder(*out);
    protect_files(*out, program::kSoFiles, {o->model, o->motion, o->emg, o->loads});
    o->call = context.call();
    o->compat = context.compat;
    o->compare_with_opensim = !context.quiet;
    const program::SoResult result = program::so(*o);
    context.end_progress();
    program::write_so(result, *out);
    print_so(result.shared, *out, context);
    if (result.shared.frames_not_solved > 0) context.exit_code = kQualityGateFailed;
  });
}

}  // namespace myoid::program
