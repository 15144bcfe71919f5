#include "myoid/program/steps/id.h"

#include <nlohmann/json.hpp>

#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"

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

void carry_out(Context& context, const IdOptions& o, const CLI::App& /*command*/) {
  context.prepare_file(o.out, {o.model, o.motion, o.speeds, o.accelerations, o.loads});
  const program::IdResult result = program::id(o);
  context.end_progress();
  program::write_id(result, o.out);
  context.print(id_json(result.forces, o.out), o.out);
}

}  // namespace

void add_id(CLI::App& app, Context& context) {
  add_command<IdOptions>(app, context, "id",
                         "Inverse dynamics: joint angles to the generalized forces that they require.\n"
                         "Example: myoid id --model arm.osim --motion ik.mot --lowpass 6 --out id.sto",
                         {.seed = false}, carry_out);
}

}  // namespace myoid::program
