#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/arm/arm4.h"
#include "myoid/cli/context.h"
#include "myoid/cli/stage_input.h"
#include "myoid/core/json_text.h"
#include "myoid/files/text_file.h"
#include "myoid/kinematics/muscle_kinematics.h"
#include "myoid/kinematics/surrogate_file.h"
#include "myoid/model/path_survey.h"
#include "myoid/results/stage_files.h"

namespace myoid::cli {

namespace {

void warn_of_jumps(const model::BodyModel& model, const Context& context) {
  for (const model::PathJump& jump : model::find_jumps(model))
    context.warn(model::describe(model, jump));
}

/// The polynomials of the file, or new ones where it has none of this model.
std::vector<kinematics::PathSurrogate> load_surrogates(const std::filesystem::path& path,
                                                       const std::string& model_file,
                                                       const model::BodyModel& model,
                                                       double tolerance_mm,
                                                       const Context& context) {
  kinematics::SurrogateOptions options{.length_tolerance_m = 1e-3 * tolerance_mm,
                                       .arm_tolerance_m = 5e-3 * tolerance_mm,
                                       .progress = context.progress()};
  const std::string text =
      model_file == "arm4" ? model::arm4_osim() : recording::read_text_file(model_file);
  const std::string key = kinematics::surrogate_key(text, model.compat, options);
  auto surrogates = kinematics::read_surrogates(path, model, key);
  if (!surrogates) {
    surrogates = kinematics::fit_surrogates(model, options);
    context.end_progress();
    kinematics::write_surrogates(path, model, key, *surrogates);
  }
  double length_mm = 0.0;
  double arm_mm = 0.0;
  std::vector<std::string> outside;
  for (const kinematics::PathSurrogate& s : *surrogates) {
    if (!s.within_tolerance) {
      outside.push_back(fmt::format("{} ({:.2g} mm)", s.muscle, 1e3 * s.length_error_m));
      continue;
    }
    length_mm = std::max(length_mm, 1e3 * s.length_error_m);
    arm_mm = std::max(arm_mm, 1e3 * s.arm_error_m);
  }
  context.log(fmt::format(
      "{}: polynomials for {} of {} muscles, errors at most {:.2g} mm in length and {:.2g} mm in "
      "moment arm",
      path.string(), surrogates->size() - outside.size(), surrogates->size(), length_mm, arm_mm));
  if (!outside.empty()) {
    context.warn(fmt::format("no polynomial is within tolerance for {}; their paths are computed",
                             fmt::join(outside, ", ")));
  }
  return std::move(*surrogates);
}

}  // namespace

void add_paths(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("paths",
                          "Musculotendon lengths, velocities and moment arms along a motion.\n"
                          "Example: myoid paths --model arm.osim --motion ik.mot --out paths");
  struct Options {
    std::string model, motion, out, surrogates;
    double cutoff_hz = 0.0, tolerance_mm = 0.2;
    bool check_jumps = false;
  };
  const auto o = std::make_shared<Options>();
  command.add_option("--model", o->model, "OpenSim model (.osim), or arm4")->required();
  command.add_option("--motion", o->motion, "Joint angles (.mot, .sto)")->required();
  command.add_option("--out", o->out, "Folder for MuscleAnalysis_*.sto [m, m/s]")->required();
  command
      .add_option("--lowpass", o->cutoff_hz,
                  "Smooth the angles, -3 dB at this frequency [Hz] (default: not smoothed)")
      ->check(above_zero());
  command.add_option("--surrogate", o->surrogates,
                     "File of fitted polynomials (.json) to use in the place of paths where they "
                     "are within tolerance; made if it is not there or belongs to another model");
  command
      .add_option("--surrogate-tolerance", o->tolerance_mm,
                  "Greatest error of a length [mm]; five times that for moment arms [mm/rad]")
      ->check(above_zero())
      ->capture_default_str();
  command.add_flag("--check-jumps", o->check_jumps,
                   "Tell where a length or moment arm jumps over the range of a coordinate");
  add_compat_option(command, context);
  add_common_options(command, context, {.seed = false});
  command.callback([&context, o] {
    const model::BodyModel model = load_model(o->model, context);
    warn_of_path_differences(model, o->model, context);
    const kinematics::JointMotion motion = load_motion(model, o->motion, o->cutoff_hz, context);
    context.prepare_folder(o->out);
    context.protect_inputs(o->out, {"MuscleAnalysis_"}, {o->model, o->motion});
    if (o->check_jumps) warn_of_jumps(model, context);
    std::vector<kinematics::PathSurrogate> surrogates;
    if (!o->surrogates.empty()) {
      context.protect_inputs(o->out, {"MuscleAnalysis_"}, {o->surrogates});
      surrogates = load_surrogates(o->surrogates, o->model, model, o->tolerance_mm, context);
    }
    const kinematics::MuscleKinematics muscles = kinematics::muscle_kinematics(
        model, motion,
        {.surrogates = surrogates.empty() ? nullptr : &surrogates, .progress = context.progress()});
    context.end_progress();
    if (!surrogates.empty()) {
      context.log(fmt::format("{} of {} paths are from polynomials", muscles.from_surrogates,
                              motion.sample_count() * muscles.length.channel_count()));
    }
    write_muscle_kinematics(muscles, o->out);
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
      fmt::print("{}\n", json_text(json));
    } else {
      fmt::print("{}\n", o->out);
    }
  });
}

}  // namespace myoid::cli
