#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/cli/context.h"
#include "myoid/cli/stage_input.h"
#include "myoid/core/error.h"
#include "myoid/core/json_text.h"
#include "myoid/dynamics/external_loads.h"
#include "myoid/dynamics/ground_support.h"
#include "myoid/forces/force_sharing.h"
#include "myoid/forces/sharing_input.h"
#include "myoid/recording/recording.h"
#include "myoid/results/stage_files.h"
#include "myoid/signals/resample.h"
#include "myoid/simulation/muscle_force_law.h"
#include "myoid/study/study_model.h"
#include "myoid/tables/storage_reader.h"

namespace myoid::cli {

void add_so(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "so",
      "Muscle force sharing (static optimization): which forces make the torques?\n"
      "Example: myoid so --model arm.osim --motion ik.mot --lowpass 6 --out so");
  struct Options {
    std::string model, motion, out, objective = "activation", emg, loads, tendon = "rigid";
    bool passive = false;
    std::vector<std::string> coordinates;
    double exponent = 2.0, emg_weight = 1.0, reserve_nm = 1.0, cutoff_hz = 0.0;
  };
  const auto o = std::make_shared<Options>();
  command.add_option("--model", o->model, "OpenSim model (.osim), or arm4")->required();
  command.add_option("--motion", o->motion, "Joint angles (.mot, .sto)")->required();
  command.add_option("--out", o->out, "Folder for StaticOptimization_*")->required();
  command
      .add_option("--objective", o->objective, "activation, force or stress (default activation)")
      ->check(CLI::IsMember({"activation", "force", "stress"}));
  command.add_option("--exponent", o->exponent, "Exponent of the sum, above 1 (default 2)");
  command.add_option("--emg", o->emg, "Measured activations by muscle name (.sto), to stay near");
  command.add_option("--emg-weight", o->emg_weight, "Weight of that term (default 1)");
  command.add_option("--reserve", o->reserve_nm,
                     "Optimal torque of the reserve on every coordinate [N m] (default 1)");
  command.add_option(
      "--coordinate", o->coordinates,
      "Coordinate whose torque the muscles balance, repeated (default: all that take a value of "
      "their own)");
  command
      .add_option("--lowpass", o->cutoff_hz,
                  "Smooth the angles, -3 dB at this frequency [Hz] (default: not smoothed)")
      ->check(above_zero());
  command.add_option("--loads", o->loads,
                     "Forces measured on bodies: an <ExternalLoads> file (.xml) of OpenSim");
  command
      .add_option("--tendon", o->tendon,
                  "rigid, or elastic: fiber and tendon in balance by the muscle's own curves, in "
                  "every frame for itself: the tendon's own rate is left out (default rigid)")
      ->check(CLI::IsMember({"rigid", "elastic"}));
  command.add_flag("--passive", o->passive,
                   "The fibers' passive springs and dampers pull too, and the muscles share the "
                   "rest");
  add_compat_option(command, context);
  add_common_options(command, context, {.seed = false});
  command.callback([&context, o] {
    const model::BodyModel model = load_model(o->model, context);
    warn_of_path_differences(model, o->model, context);
    const kinematics::JointMotion motion = load_motion(model, o->motion, o->cutoff_hz, context);
    context.prepare_folder(o->out);
    context.protect_inputs(o->out, {"StaticOptimization_"},
                           {o->model, o->motion, o->emg, o->loads});
    std::optional<dynamics::ExternalLoads> loads;
    if (!o->loads.empty()) loads = load_external_loads(model, o->loads, motion, context);
    if (const auto weight = dynamics::unsupported_weight(model);
        weight && !loads && dynamics::stands(model, motion.q.values().row(0).transpose()))
      context.warn(weight->sentence("--loads"));
    const forces::SharingInput input =
        forces::sharing_input(model, motion, o->coordinates, loads ? &*loads : nullptr);
    for (const std::string& note : input.notes) context.warn(note);
    forces::SharingOptions options{
        .objective = o->objective, .exponent = o->exponent, .reserve_nm = o->reserve_nm};
    if (!o->emg.empty()) {
      const recording::Storage emg = recording::read_storage(o->emg);
      for (const recording::Repair& repair : emg.repairs)
        context.warn(recording::to_string(o->emg, repair));
      options.emg = signals::resample(emg.data, motion.q.time_s());
      options.emg_weight = o->emg_weight;
    }
    const bool elastic = o->tendon == "elastic";
    if (elastic || o->passive) {
      options.law = simulation::muscle_force_law(
          model, input.muscles, {.elastic_tendon = elastic, .passive_force = o->passive});
    }
    const forces::MuscleForces shared = forces::share(input, std::move(options));
    write_shared_forces(shared, o->out);
    if (context.json) {
      const nlohmann::ordered_json json{{"out", o->out},
                                        {"frames", shared.status.size()},
                                        {"frames_not_solved", shared.frames_not_solved},
                                        {"frames_with_reserve", shared.frames_with_reserve},
                                        {"largest_kkt_residual", shared.kkt_residual.maxCoeff()}};
      fmt::print("{}\n", json_text(json));
    } else {
      fmt::print(
          "{} frames: {} not solved, {} where a reserve helps; largest KKT residual {:.1e}\n{}\n",
          shared.status.size(), shared.frames_not_solved, shared.frames_with_reserve,
          shared.kkt_residual.maxCoeff(), o->out);
    }
    if (shared.frames_not_solved > 0) context.exit_code = kQualityGateFailed;
  });
}

}  // namespace myoid::cli
