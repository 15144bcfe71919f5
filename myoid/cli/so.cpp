#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/cli/context.h"
#include "myoid/cli/stage_input.h"
#include "myoid/core/error.h"
#include "myoid/dynamics/inverse_dynamics.h"
#include "myoid/forces/force_sharing.h"
#include "myoid/kinematics/muscle_kinematics.h"
#include "myoid/model/thelen_properties.h"
#include "myoid/pipeline/result_files.h"
#include "myoid/pipeline/study_model.h"
#include "myoid/recording/storage_reader.h"
#include "myoid/signals/resample.h"

namespace myoid::cli {

void add_so(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "so",
      "Muscle force sharing (static optimization): which forces make the torques?\n"
      "Example: myoid so --model arm.osim --motion ik.mot --lowpass 6 --out so");
  struct Options {
    std::string model, motion, out, objective = "activation", emg;
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
      "Coordinate whose torque the muscles balance, repeated (default: all that are not locked)");
  command
      .add_option("--lowpass", o->cutoff_hz,
                  "Smooth the angles, -3 dB at this frequency [Hz] (default: not smoothed)")
      ->check(CLI::PositiveNumber);
  add_compat_option(command, context);
  add_common_options(command, context, {.seed = false});
  command.callback([&context, o] {
    const model::BodyModel model = load_model(o->model, context);
    if (model.muscles.empty()) throw ModelError("the model has no muscles");
    warn_of_path_differences(model, o->model, context);
    const kinematics::JointMotion motion = load_motion(model, o->motion, o->cutoff_hz, context);
    context.prepare_folder(o->out);
    context.protect_inputs(o->out, {"StaticOptimization_"}, {o->model, o->motion, o->emg});
    const TimeSeries torques = dynamics::inverse_dynamics(model, motion);
    const kinematics::MuscleKinematics muscles = kinematics::muscle_kinematics(model, motion);
    std::vector<TimeSeries> arms;
    std::vector<std::string> columns;
    for (const model::Coordinate& c : model.coordinates) {
      const bool wanted = o->coordinates.empty()
                              ? !c.locked
                              : std::find(o->coordinates.begin(), o->coordinates.end(), c.name) !=
                                    o->coordinates.end();
      if (!wanted) continue;
      arms.push_back(muscles.moment_arm.at(c.name));
      columns.push_back(dynamics::generalized_force_name(c));
    }
    for (const std::string& name : o->coordinates) (void)model.coordinate_index(name);
    const auto count = static_cast<Eigen::Index>(model.muscles.size());
    Eigen::MatrixXd optimal(motion.sample_count(), count);
    Eigen::VectorXd greatest(count);
    for (Eigen::Index m = 0; m < count; ++m) {
      const muscle::ThelenParameters p =
          model::thelen_parameters(model.muscles[static_cast<std::size_t>(m)].properties);
      greatest[m] = p.max_isometric_force_n;
      for (Eigen::Index i = 0; i < optimal.rows(); ++i) {
        optimal(i, m) = muscle::thelen_optimal_force(p, muscles.length.values()(i, m),
                                                     muscles.velocity.values()(i, m));
      }
    }
    forces::SharingOptions options{
        .objective = o->objective, .exponent = o->exponent, .reserve_nm = o->reserve_nm};
    options.min_activation = 1.0;
    for (const model::Muscle& muscle : model.muscles)
      options.min_activation = std::min(options.min_activation, muscle.properties.min_control);
    if (!o->emg.empty()) {
      options.emg = signals::resample(recording::read_storage(o->emg).data, motion.q.time_s());
      options.emg_weight = o->emg_weight;
    }
    const forces::MuscleForces shared =
        forces::share(arms, torques.select(columns), optimal, greatest, options);
    pipeline::write_shared_forces(shared, o->out);
    if (context.json) {
      const nlohmann::ordered_json json{{"out", o->out},
                                        {"frames", shared.status.size()},
                                        {"frames_not_solved", shared.frames_not_solved},
                                        {"frames_with_reserve", shared.frames_with_reserve},
                                        {"largest_kkt_residual", shared.kkt_residual.maxCoeff()}};
      fmt::print("{}\n", json.dump(2));
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
