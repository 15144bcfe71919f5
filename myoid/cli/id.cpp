#include <fmt/format.h>

#include "myoid/cli/context.h"
#include "myoid/cli/stage_input.h"
#include "myoid/dynamics/held_mass.h"
#include "myoid/dynamics/inverse_dynamics.h"
#include "myoid/recording/storage_writer.h"

namespace myoid::cli {

void add_id(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "id",
      "Inverse dynamics: joint angles to the generalized forces that they require.\n"
      "Example: myoid id --model arm.osim --motion ik.mot --lowpass 6 --out id.sto");
  struct Options {
    std::string model, motion, out, body;
    double cutoff_hz = 0.0;
    double mass_kg = 0.0;
    std::vector<double> at{0.0, 0.0, 0.0};
  };
  const auto o = std::make_shared<Options>();
  command.add_option("--model", o->model, "OpenSim model (.osim), or arm4")->required();
  command.add_option("--motion", o->motion, "Joint angles (.mot, .sto)")->required();
  command.add_option("--out", o->out, "Generalized forces (.sto) [N m, N]")->required();
  command.add_option("--lowpass", o->cutoff_hz,
                     "Smooth the angles, -3 dB at this frequency [Hz] (default: not smoothed)");
  command.add_option("--held-mass", o->mass_kg, "Mass held in the hand [kg] (default 0)");
  command.add_option("--held-body", o->body, "Body that holds it");
  command.add_option("--held-at", o->at, "Where on that body, x y z [m]")->expected(3);
  add_common_options(command, context);
  command.callback([&context, o] {
    context.refuse_existing(o->out);
    model::BodyModel model = load_model(o->model, context);
    if (o->mass_kg != 0.0)
      model = dynamics::with_held_mass(std::move(model), o->body,
                                       Vec3(o->at[0], o->at[1], o->at[2]), o->mass_kg);
    const TimeSeries forces =
        dynamics::inverse_dynamics(model, load_motion(model, o->motion, o->cutoff_hz, context));
    recording::write_storage(o->out, forces, {.title = "Inverse Dynamics Generalized Forces"});
    fmt::print("{}\n", o->out);
  });
}

}  // namespace myoid::cli
