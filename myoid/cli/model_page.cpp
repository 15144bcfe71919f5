#include "myoid/cli/model_page.h"

#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "myoid/cli/stage_input.h"
#include "myoid/core/error.h"
#include "myoid/files/atomic_file.h"
#include "myoid/files/text_file.h"
#include "myoid/recording/recording.h"
#include "myoid/report/scene_page.h"
#include "myoid/scene/model_meshes.h"
#include "myoid/scene/model_scene.h"
#include "myoid/tables/storage_reader.h"

namespace myoid::cli {
namespace {

MuscleColoring coloring(const std::string& name,
                        const std::string& unit,
                        const std::string& path,
                        const Context& context) {
  recording::Storage file = recording::read_storage(path);
  for (const recording::Repair& repair : file.repairs)
    context.warn(recording::to_string(path, repair));
  return {name, unit, std::move(file.data)};
}

}  // namespace

void add_model_page_options(CLI::App& command, ModelPageOptions& options) {
  CLI::Option* const html = command.add_option(
      "--html", options.html,
      "Of a model: write a page that shows it in the browser, moving; one file, works offline");
  const auto add = [&](const char* name, std::string& value, const char* text) {
    command.add_option(name, value, text)->needs(html);
  };
  add("--motion", options.motion, "Joint angles to play on the page (.mot, .sto)");
  add("--forces", options.forces, "Muscle forces [N] to color by (.sto)");
  add("--activations", options.activations, "Muscle activations, 0..1, to color by (.sto)");
  add("--markers", options.markers, "Measured markers to show beside the model's (.trc, .c3d)");
  command
      .add_option("--meshes", options.mesh_folders,
                  "Folder with the model's meshes (.vtp, .stl, .obj), repeated; the model's folder "
                  "and its subfolder Geometry are looked through without it")
      ->needs(html);
  command.add_option("--up", options.up, "Vertical axis of --markers: x, y or z (default y)")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->needs(html);
}

std::string write_model_page(const std::string& model_file,
                             const ModelPageOptions& options,
                             const Context& context) {
  if (options.motion.empty()) {
    for (const auto& [name, value] :
         {std::pair{"--forces", &options.forces}, std::pair{"--activations", &options.activations},
          std::pair{"--markers", &options.markers}}) {
      if (!value->empty())
        throw InvalidInput(fmt::format("{} is shown along a motion: give --motion too", name));
    }
  }
  context.prepare_file(options.html, {model_file, options.motion, options.forces,
                                      options.activations, options.markers});
  const model::BodyModel model = load_model(model_file, context);
  SceneInput input;
  input.name = "default posture";
  report::ScenePage page{.title = model.name.empty() ? model_file : model.name};
  page.subtitle = std::filesystem::path(model_file).filename().string();
  if (!options.motion.empty()) {
    input.name = std::filesystem::path(options.motion).filename().string();
    page.subtitle += ", " + input.name;
    input.q = load_motion(model, options.motion, 0.0, context).q;
  }
  if (!options.forces.empty())
    input.colorings.push_back(coloring("force", "N", options.forces, context));
  if (!options.activations.empty())
    input.colorings.push_back(coloring("activation", "", options.activations, context));
  std::optional<recording::MarkerSeries> markers;
  if (!options.markers.empty()) {
    recording::MarkerFile file = recording::read_markers(options.markers);
    for (const recording::Repair& repair : file.repairs)
      context.warn(recording::to_string(options.markers, repair));
    markers =
        recording::rotated(std::move(file.markers), recording::rotation_to_y_up(options.up[0]));
    input.markers = &*markers;
  }
  page.scenes.push_back(model_scene(model, input));
  if (model_file != "arm4") {
    MeshOptions meshes;
    meshes.folders.assign(options.mesh_folders.begin(), options.mesh_folders.end());
    add_meshes(load_meshes(recording::read_text_file(model_file), model_file, meshes), page);
  }
  const report::Scene& scene = page.scenes.front();
  for (const std::string& note : scene.notes)
    context.log(fmt::format("{}: {}", options.html, note));
  const std::string text = report::scene_page(page);
  recording::write_file(options.html, text);
  return fmt::format("{}: {} bodies, {} muscles, {} frames, {:.2f} MB", options.html,
                     scene.bodies.size(), scene.muscles.size(), scene.time_s.size(),
                     1e-6 * static_cast<double>(text.size()));
}

}  // namespace myoid::cli
