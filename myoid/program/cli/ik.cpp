#include "myoid/program/steps/ik.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/files/output_file.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"

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

void carry_out(Context& context, const IkOptions& o, const CLI::App& /*command*/) {
  context.prepare_file(o.out, {o.model, o.markers});
  check_companion(program::marker_errors_path(o.out), {o.model, o.markers}, context.overwrite,
                  program::kMarkerErrorsBegin);
  const program::IkResult result = program::ik(o);
  context.end_progress();
  program::write_ik(result, o.out);
  print_ik(result, o.out, context);
  if (result.misfit.wrong_unit || result.solved.frames_not_converged > 0) context.exit_code = kQualityGateFailed;
}

}  // namespace

void add_ik(CLI::App& app, Context& context) {
  add_command<IkOptions>(app, context, "ik",
                         "Inverse kinematics: markers to joint angles.\n"
                         "Example: myoid ik --model arm.osim --markers flex.trc --out ik.mot",
                         {.threads = false, .seed = false}, carry_out);
}

}  // namespace myoid::program
