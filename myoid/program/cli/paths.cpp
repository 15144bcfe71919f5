#include "myoid/program/commands/paths.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/files/output_file.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/option_checks.h"
#include "myoid/program/commands/sweep.h"

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

void run_sweep(const program::SweepOptions& options, const std::string& out, const Context& context) {
  context.prepare_folder(out);
  protect_files(out, program::kSweepFiles, {options.model});
  const program::SweepResult result = program::sweep(options);
  const std::vector<std::filesystem::path> files = program::write_sweep(result, out);
  nlohmann::ordered_json json{
      {"coordinate", result.coordinate}, {"csv", files[0].string()}, {"svg", files[1].string()}};
  for (const auto& muscle : result.muscles) json["muscles"].push_back(muscle.name);
  context.print(json, fmt::format("{}\n{}", files[0].string(), files[1].string()));
}

}  // namespace

void add_paths(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand("paths",
                                          "Musculotendon lengths, velocities and moment arms along a motion, or "
                                          "with forces over one coordinate.\n"
                                          "Example: myoid paths --model arm.osim --motion ik.mot --out paths");
  const auto out = std::make_shared<std::string>();
  const auto o = std::make_shared<program::PathsOptions>();
  command.add_option("--model", o->model, "OpenSim model (.osim), or arm4")->required();
  const auto swept = std::make_shared<program::SweepOptions>();
  CLI::Option* const motion = command.add_option("--motion", o->motion, "Joint angles (.mot, .sto)");
  CLI::Option* const over =
      command
          .add_option("--sweep", swept->coordinate,
                      "Instead of a motion this coordinate over its range, or COORDINATE=FROM:TO [deg, m]: a table and "
                      "a picture of moment arms, lengths and forces")
          ->excludes(motion);
  command.add_option("--muscle", swept->muscles, "With --sweep only this muscle, repeated")->needs(over);
  command.add_option("--out", *out, "Folder for MuscleAnalysis_*.sto [m, m/s], or sweep_*.csv and .svg")->required();
  command
      .add_option("--lowpass", o->cutoff_hz, "Smooth the angles, -3 dB at this frequency [Hz] (default: not smoothed)")
      ->check(above_zero())
      ->excludes(over);
  command
      .add_option("--surrogate", o->surrogates,
                  "File of fitted polynomials (.json) to use in the place of paths where they are within tolerance; "
                  "made if it is not there or belongs to another model")
      ->excludes(over);
  command
      .add_option("--surrogate-tolerance", o->tolerance_mm,
                  "Greatest error of a length [mm]; five times that for moment arms [mm/rad]")
      ->check(above_zero())
      ->capture_default_str();
  command
      .add_flag("--check-jumps", o->check_jumps,
                "Tell where a length or moment arm jumps over the range of a coordinate")
      ->excludes(over);
  add_compat_option(command, context);
  add_common_options(command, context, {.seed = false});
  command.callback([&context, o, out, swept] {
    if (!swept->coordinate.empty()) {
      swept->call = context.call();
      swept->model = o->model;
      swept->compat = context.compat;
      run_sweep(*swept, *out, context);
      return;
    }
    if (o->motion.empty()) throw CLI::RequiredError("--motion or --sweep");
    context.prepare_folder(*out);
    protect_files(*out, program::kPathsFiles, {o->model, o->motion, o->surrogates});
    o->call = context.call();
    o->compat = context.compat;
    o->compare_with_opensim = !context.quiet;
    const program::PathsResult result = program::paths(*o);
    context.end_progress();
    program::write_paths(result, *out);
    context.print(paths_json(result, *out), *out);
  });
}

}  // namespace myoid::program
