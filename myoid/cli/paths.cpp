#include <fmt/format.h>

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
  command.add_option("--lowpass", o->cutoff_hz,
                     "Smooth the angles, -3 dB at this frequency [Hz] (default: not smoothed)");
  add_common_options(command, context);
  command.callback([&context, o] {
    const model::BodyModel model = load_model(o->model, context);
    const kinematics::JointMotion motion = load_motion(model, o->motion, o->cutoff_hz, context);
    context.prepare_folder(o->out);
    pipeline::write_muscle_kinematics(kinematics::muscle_kinematics(model, motion), o->out);
    fmt::print("{}\n", o->out);
  });
}

}  // namespace myoid::cli
