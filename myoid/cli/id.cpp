#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/arm/arm4.h"
#include "myoid/cli/context.h"
#include "myoid/cli/stage_input.h"
#include "myoid/core/error.h"
#include "myoid/core/json_text.h"
#include "myoid/dynamics/external_loads.h"
#include "myoid/dynamics/ground_support.h"
#include "myoid/dynamics/held_mass.h"
#include "myoid/dynamics/inverse_dynamics.h"
#include "myoid/tables/series_file.h"

namespace myoid::cli {

void add_id(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "id",
      "Inverse dynamics: joint angles to the generalized forces that they require.\n"
      "Example: myoid id --model arm.osim --motion ik.mot --lowpass 6 --out id.sto");
  struct Options {
    std::string model, motion, speeds, accelerations, loads, out, body;
    double cutoff_hz = 0.0;
    double mass_kg = 0.0;
    std::vector<double> at{0.0, 0.0, 0.0};
  };
  const auto o = std::make_shared<Options>();
  command.add_option("--model", o->model, "OpenSim model (.osim), or arm4")->required();
  command.add_option("--motion", o->motion, "Joint angles (.mot, .sto)")->required();
  command.add_option("--out", o->out, "Generalized forces (.sto, .mot, .csv) [N m, N]")->required();
  command
      .add_option("--lowpass", o->cutoff_hz,
                  "Smooth the angles, -3 dB at this frequency [Hz] (default: not smoothed)")
      ->check(above_zero());
  command.add_option("--speeds", o->speeds,
                     "Speeds of the coordinates at the times of --motion (.sto), instead of its "
                     "derivatives");
  command.add_option("--accelerations", o->accelerations, "Accelerations, likewise");
  command.add_option("--loads", o->loads,
                     "Forces measured on bodies: an <ExternalLoads> file (.xml) of OpenSim");
  command.add_option("--held-mass", o->mass_kg, "Mass held in the hand [kg] (default 0)")
      ->check(zero_or_more());
  command.add_option("--held-body", o->body,
                     "Body that holds it (default: the hand of arm4, of other models none)");
  command.add_option("--held-at", o->at, "Where on that body, x y z [m]")->expected(3);
  add_compat_option(command, context);
  add_common_options(command, context, {.seed = false});
  command.callback([&context, o] {
    context.prepare_file(o->out, {o->model, o->motion, o->speeds, o->accelerations, o->loads});
    if (o->cutoff_hz > 0.0 && !(o->speeds.empty() && o->accelerations.empty()))
      throw InvalidInput(
          "--lowpass smooths angles that are differentiated: leave it out with "
          "--speeds or --accelerations");
    model::BodyModel model = load_model(o->model, context);
    if (o->mass_kg != 0.0) {
      Vec3 p_BP_m(o->at[0], o->at[1], o->at[2]);
      std::string body = o->body;
      if (body.empty() && o->model == "arm4") {
        body = "forearm_hand";
        if (p_BP_m.isZero()) p_BP_m = model::arm4_held_at_m();
      }
      if (body.empty()) {
        std::vector<std::string> names;
        for (std::size_t i = 1; i < model.bodies.size(); ++i) names.push_back(model.bodies[i].name);
        throw InvalidInput(
            fmt::format("--held-mass {} needs --held-body, the body that carries it, one of {}",
                        o->mass_kg, fmt::join(names, ", ")));
      }
      model = dynamics::with_held_mass(std::move(model), body, p_BP_m, o->mass_kg);
    }
    const kinematics::JointMotion motion =
        with_derivatives(load_motion(model, o->motion, o->cutoff_hz, context), model, o->speeds,
                         o->accelerations, context);
    std::optional<dynamics::ExternalLoads> loads;
    if (!o->loads.empty()) loads = load_external_loads(model, o->loads, motion, context);
    const TimeSeries forces =
        dynamics::inverse_dynamics(model, motion, {.loads = loads ? &*loads : nullptr});
    if (const auto weight = dynamics::unsupported_weight(model, forces);
        weight && dynamics::stands(model, motion.q.values().row(0).transpose()))
      context.warn(weight->sentence("--loads"));
    recording::write_series(o->out, forces, "Inverse Dynamics Generalized Forces");
    if (context.json) {
      nlohmann::ordered_json json{{"out", o->out}, {"samples", forces.sample_count()}};
      for (Eigen::Index c = 0; c < forces.channel_count(); ++c) {
        const Channel& channel = forces.channels()[static_cast<std::size_t>(c)];
        json["forces"].push_back({{"name", channel.name},
                                  {"unit", symbol(channel.unit)},
                                  {"lowest", forces.values().col(c).minCoeff()},
                                  {"highest", forces.values().col(c).maxCoeff()}});
      }
      fmt::print("{}\n", json_text(json));
    } else {
      fmt::print("{}\n", o->out);
    }
  });
}

}  // namespace myoid::cli
