#include "myoid/program/steps/so.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/files/output_file.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"

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

void carry_out(Context& context, const SoOptions& o, const CLI::App& /*command*/) {
  context.prepare_folder(o.out);
  protect_files(o.out, program::kSoFiles, {o.model, o.motion, o.emg, o.loads});
  const program::SoResult result = program::so(o);
  context.end_progress();
  program::write_so(result, o.out);
  print_so(result.shared, o.out, context);
  if (result.shared.frames_not_solved > 0) context.exit_code = kQualityGateFailed;
}

}  // namespace

void add_so(CLI::App& app, Context& context) {
  add_command<SoOptions>(app, context, "so",
                         "Muscle force sharing (static optimization): which forces make the torques?\n"
                         "Example: myoid so --model arm.osim --motion ik.mot --lowpass 6 --out so",
                         {.seed = false}, carry_out);
}

}  // namespace myoid::program
