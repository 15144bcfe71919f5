#include "myoid/program/steps/paths.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/files/output_file.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/steps/sweep.h"

namespace myoid::program {
namespace {

nlohmann::ordered_json paths_json(const program::PathsResult& result, const std::string& out) {
  nlohmann::ordered_json json{{"out", out}, {"samples", result.samples}};
  json["muscles"] = nlohmann::ordered_json::array();
  const TimeSeries& length = result.muscles.length;
  for (Eigen::Index m = 0; m < length.channel_count(); ++m) {
    json["muscles"].push_back({{"name", length.channels()[static_cast<std::size_t>(m)].name},
                               {"shortest_m", length.values().col(m).minCoeff()},
                               {"longest_m", length.values().col(m).maxCoeff()}});
  }
  for (const auto& [coordinate, arm] : result.muscles.moment_arm) json["moment_arms"].push_back(coordinate);
  return json;
}

void run_sweep(const program::SweepOptions& options, const Context& context) {
  context.prepare_folder(options.out);
  protect_files(options.out, program::kSweepFiles, {options.model});
  const program::SweepResult result = program::sweep(options);
  const std::vector<std::filesystem::path> files = program::write_sweep(result, options.out);
  nlohmann::ordered_json json{
      {"coordinate", result.coordinate}, {"csv", files[0].string()}, {"svg", files[1].string()}};
  for (const auto& muscle : result.muscles) json["muscles"].push_back(muscle.name);
  context.print(json, fmt::format("{}\n{}", files[0].string(), files[1].string()));
}

void carry_out(Context& context, const PathsOptions& o, const CLI::App& command) {
  if (command.count("--sweep") > 0) return run_sweep(given_options<SweepOptions>(command, context), context);
  if (o.motion.empty()) throw CLI::RequiredError("--motion or --sweep");
  context.prepare_folder(o.out);
  protect_files(o.out, program::kPathsFiles, {o.model, o.motion, o.surrogates});
  const program::PathsResult result = program::paths(o);
  context.end_progress();
  program::write_paths(result, o.out);
  context.print(paths_json(result, o.out), o.out);
}

}  // namespace

void add_paths(CLI::App& app, Context& context) {
  CLI::App* const command =
      add_command<PathsOptions>(app, context, "paths",
                                "Musculotendon lengths, velocities and moment arms along a motion, or "
                                "with forces over one coordinate.\n"
                                "Example: myoid paths --model arm.osim --motion ik.mot --out paths",
                                {.seed = false}, carry_out);
  declare_options<SweepOptions>(*command);
}

}  // namespace myoid::program
