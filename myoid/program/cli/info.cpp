#include "myoid/program/commands/info.h"

#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/option_checks.h"
#include "myoid/program/cli/say.h"
#include "myoid/program/commands/model_page.h"
#include "myoid/program/contents/contents_text.h"

namespace myoid::program {
namespace {

/// Adds --html, --motion, --forces, --activations, --markers, --meshes and --up.
void add_model_page_options(CLI::App& command, program::ModelPageOptions& options, std::string& page) {
  command.option_defaults()->group("Page of a model");
  CLI::Option* const html = command.add_option(
      "--html", page, "Of a model: write a page that shows it in the browser, moving; one file, works offline");
  const auto add = [&](const char* name, std::string& value, const char* text) {
    command.add_option(name, value, text)->needs(html);
  };
  add("--motion", options.motion, "Joint angles to play on the page (.mot, .sto)");
  add("--forces", options.forces, "Muscle forces [N] to color by (.sto)");
  add("--activations", options.activations, "Muscle activations, 0..1, to color by (.sto)");
  add("--markers", options.markers, "Measured markers to show beside the model's (.trc, .c3d)");
  command
      .add_option("--meshes", options.mesh_folders,
                  "Folder with the model's meshes (.vtp, .stl, .obj), repeated; the model's folder and its subfolder "
                  "Geometry are looked through without it")
      ->needs(html);
  command
      .add_option("--up", options.up,
                  "Vertical axis of --markers: x, y, z, -x, -y or -z (default: as a .c3d file says, else as the model)")
      ->check(one_of({"x", "y", "z", "-x", "-y", "-z"}))
      ->needs(html);
  command.option_defaults()->group("Options");
}

/// Writes the page of the model, which must be the only file.
void write_page(const std::vector<std::string>& files,
                program::ModelPageOptions options,
                const std::string& html,
                const Context& context) {
  if (files.size() != 1 || !program::is_model(files.front()))
    throw InvalidInput("--html shows one model: give one .osim, or arm4");
  options.model = files.front();
  context.prepare_file(html, {options.model, options.motion, options.forces, options.activations, options.markers});
  options.compat = context.compat;
  options.call = context.call();
  const program::ModelPageResult result = program::model_page(options);
  const page::Scene& scene = result.page.scenes.front();
  for (const std::string& note : sentences(scene.notes)) context.log(fmt::format("{}: {}", html, note));
  program::write_model_page(result, html);
  context.print({{"html", html}},
                fmt::format("{}: {} bodies, {} muscles, {} frames, {:.2f} MB", html, scene.bodies.size(),
                            scene.muscles.size(), scene.time_s.size(), 1e-6 * static_cast<double>(result.html.size())));
}

}  // namespace

void add_info(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand("info",
                                          "Says what a file holds: channels, units, rates, duration, gaps, repairs; of "
                                          "a model also its unsupported elements.\n"
                                          "Example: myoid info arm.osim flex.trc");
  const auto files = std::make_shared<std::vector<std::string>>();
  const auto o = std::make_shared<program::InfoOptions>();
  const auto page = std::make_shared<program::ModelPageOptions>();
  const auto html = std::make_shared<std::string>();
  command.add_flag(
      "--compare-compat", o->ask.compare_compat,
      "Of a model: for which muscles exact paths differ from OpenSim 4.5.2's, and by how much, over random postures");
  command.add_option("--postures", o->ask.postures, "Random postures for --compare-compat")
      ->check(between(1, 1000000))
      ->capture_default_str();
  command.add_flag("--jumps", o->ask.jumps,
                   "Of a model: where a muscle's length or moment arm jumps over the range of a coordinate");
  add_model_page_options(command, *page, *html);
  add_compat_option(command, context);
  command
      .add_option("files", *files,
                  program::known_endings() +
                      "; arm4; or a project of CEINMS, CEINMS-RT, NMSM or the muscle redundancy "
                      "solver (its folder, .xml, .osimx or .m)")
      ->required();
  add_common_options(command, context);
  command.callback([&context, files, o, page, html] {
    if (!html->empty()) return write_page(*files, *page, *html, context);
    if (context.start_s || context.end_s) context.warn("--start and --end have no effect without --html");
    o->call = context.call();
    o->compat = context.compat;
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const std::string& file : *files) {
      o->file = file;
      nlohmann::ordered_json contents = program::info(*o);
      if (!context.json) {
        say("{}{}", contents_text(contents), files->size() > 1 ? "\n" : "");
      }
      all.push_back(std::move(contents));
    }
    if (context.json) say_whole(json_text(all) + "\n");
  });
}

}  // namespace myoid::program
