#include "myoid/program/commands/id.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/program/cli/context.h"
#include "myoid/program/cli/option_checks.h"

namespace myoid::program {
namespace {

nlohmann::ordered_json id_json(const TimeSeries& forces, const std::string& out) {
  nlohmann::ordered_json json{{"out", out}, {"samples", forces.sample_count()}};
  for (Eigen::Index c = 0; c < forces.channel_count(); ++c) {
    const Channel& channel = forces.channels()[static_cast<std::size_t>(c)];
    json["forces"].push_back({{"name", channel.name},
                              {"unit", symbol(channel.unit)},
                              {"lowest", forces.values().col(c).minCoeff()},
                              {"highest", forces.values().col(c).maxCoeff()}});
  }
  return json;
}

}  // namespace

void add_id(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("id",
                          "Inverse dynamics: joint angles to the generalized forces that they require.\n"
                          "Example: myoid id --model arm.osim --motion ik.mot --lowpass 6 --out id.sto");
  const auto out = std::make_shared<std::string>();
  const auto o = std::make_shared<program::IdOptions>();
  command.add_option("--model", o->model, "OpenSim model (.osim), or arm4")->required();
  command.add_option("--motion", o->motion, "Joint angles (.mot, .sto)")->required();
  command.add_option("--out", *out, "Generalized forces (.sto, .mot, .csv) [N m, N]")->required();
  command
      .add_option("--lowpass", o->cutoff_hz, "Smooth the angles, -3 dB at this frequency [Hz] (default: not smoothed)")
      ->check(above_zero());
  command.add_option("--speeds", o->speeds,
                     "Speeds of the coordinates at the times of --motion (.sto), instead of its derivatives");
  command.add_option("--accelerations", o->accelerations, "Accelerations, likewise");
  command.add_option("--loads", o->loads, "Forces measured on bodies: an <ExternalLoads> file (.xml) of OpenSim");
  command.add_option("--held-mass", o->held_mass_kg, "Mass held in the hand [kg] (default 0)")->check(zero_or_more());
  command.add_option("--held-body", o->held_body,
                     "Body that holds it (default: the hand of arm4, of other models none)");
  command.add_option("--held-at", o->held_at_m, "Where on that body, x y z [m]")->expected(3);
  add_compat_option(command, context);
  add_common_options(command, context, {.seed = false});
  command.callback([&context, o, out] {
    context.prepare_file(*out, {o->model, o->motion, o->speeds, o->accelerations, o->loads});
    o->call = context.call();
    o->compat = context.compat;
    const program::IdResult result = program::id(*o);
    context.end_progress();
    program::write_id(result, *out);
    context.print(id_json(result.forces, *out), *out);
  });
}

}  // namespace myoid::program
