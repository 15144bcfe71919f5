#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/cli/context.h"
#include "myoid/cli/stage_input.h"
#include "myoid/kinematics/muscle_kinematics.h"
#include "myoid/pipeline/result_files.h"

namespace myoid::cli {

void add_paths(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("paths",
                          "Musculotendon lengths, velocities and moment arms along a motion.\n"
                          "Example: myoid paths --model arm.osim --motion ik.mot --out paths");
  struct Options {
    std::string model, motion, out;
    double cutoff_hz = 0.0;
  };
  const auto o = std::make_shared<Options>();
  command.add_option("--model", o->model, "OpenSim model (.osim), or arm4")->required();
  command.add_option("--motion", o->motion, "Joint angles (.mot, .sto)")->required();
  command.add_option("--out", o->out, "Folder for MuscleAnalysis_*.sto [m, m/s]")->required();
  command
      .add_option("--lowpass", o->cutoff_hz,
                  "Smooth the angles, -3 dB at this frequency [Hz] (default: not smoothed)")
      ->check(CLI::PositiveNumber);
  add_common_options(command, context, {.seed = false});
  command.callback([&context, o] {
    const model::BodyModel model = load_model(o->model, context);
    const kinematics::JointMotion motion = load_motion(model, o->motion, o->cutoff_hz, context);
    context.prepare_folder(o->out);
    context.protect_inputs(o->out, {"MuscleAnalysis_"}, {o->model, o->motion});
    const kinematics::MuscleKinematics muscles = kinematics::muscle_kinematics(model, motion);
    pipeline::write_muscle_kinematics(muscles, o->out);
    if (context.json) {
      nlohmann::ordered_json json{{"out", o->out}, {"samples", motion.sample_count()}};
      json["muscles"] = nlohmann::ordered_json::array();
      for (Eigen::Index m = 0; m < muscles.length.channel_count(); ++m) {
        json["muscles"].push_back(
            {{"name", muscles.length.channels()[static_cast<std::size_t>(m)].name},
             {"shortest_m", muscles.length.values().col(m).minCoeff()},
             {"longest_m", muscles.length.values().col(m).maxCoeff()}});
      }
      for (const auto& [coordinate, arm] : muscles.moment_arm)
        json["moment_arms"].push_back(coordinate);
      fmt::print("{}\n", json.dump(2));
    } else {
      fmt::print("{}\n", o->out);
    }
  });
}

}  // namespace myoid::cli
