#include "myoid/program/commands/model_page.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/scene/model_meshes.h"
#include "myoid/body/scene/model_scene.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/program/steps/check_options.h"
#include "myoid/program/steps/stage_input.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/tables/storage_reader.h"

namespace myoid::program {
namespace {

void refuse_without_motion(const ModelPageOptions& o) {
  if (!o.motion.empty()) return;
  for (const auto& [name, value] : {std::pair{"--forces", &o.forces}, std::pair{"--activations", &o.activations},
                                    std::pair{"--markers", &o.markers}}) {
    if (!value->empty()) throw InvalidInput(fmt::format("{} is shown along a motion: give --motion too", name));
  }
}

void add_coloring(const std::string& name,
                  const std::string& unit,
                  const std::string& path,
                  body::SceneInput& input,
                  Remarks& remarks) {
  if (path.empty()) return;
  recording::Storage file = recording::read_storage(path);
  warn_of_repairs(path, file.repairs, remarks);
  input.colorings.push_back({name, unit, std::move(file.data)});
}

MarkerSeries read_page_markers(const ModelPageOptions& o, const body::BodyModel& model, Remarks& remarks) {
  recording::MarkerFile file = recording::read_markers(o.markers);
  warn_of_repairs(o.markers, file.repairs, remarks);
  return rotated(std::move(file.markers), onto_model(model, o.markers, o.up, remarks));
}

}  // namespace

void visit(ModelPageOptions& o, study::SettingVisitor& v) {
  constexpr std::string_view kGroup = "Page of a model";
  constexpr study::OptionFacts kOfPage{.group = kGroup, .needs = "html"};
  v.path("html", o.out,
         {.says = "Of a model: write a page that shows it in the browser, moving; one file, works offline.",
          .option = {.group = kGroup}});
  v.path("motion", o.motion, {.says = "Joint angles to play on the page (.mot, .sto).", .option = kOfPage});
  v.path("forces", o.forces, {.says = "Muscle forces [N] to color by (.sto).", .option = kOfPage});
  v.path("activations", o.activations, {.says = "Muscle activations, 0..1, to color by (.sto).", .option = kOfPage});
  v.path("markers", o.markers,
         {.says = "Measured markers to show beside the model's (.trc, .c3d).", .option = kOfPage});
  v.paths("meshes", o.mesh_folders,
          {.says = "Folder with the model's meshes (.vtp, .stl, .obj), repeated; the model's folder and its subfolder "
                   "Geometry are looked through without it.",
           .option = kOfPage});
  visit_up(o.up, v,
           {.says = "Vertical axis of --markers.",
            .otherwise = "as a .c3d file says, else as the model",
            .option = kOfPage});
}

ModelPageResult model_page(const ModelPageOptions& o) {
  refuse_without_motion(o);
  check_options(o);
  Remarks remarks(o.call);
  const body::BodyModel model = load_model(o.model, o.compat, remarks);
  body::SceneInput input;
  input.name = "default posture";
  ModelPageResult result;
  result.page.title = model.name.empty() ? o.model : model.name;
  result.page.subtitle = std::filesystem::path(o.model).filename().string();
  if (!o.motion.empty()) {
    input.name = std::filesystem::path(o.motion).filename().string();
    result.page.subtitle += ", " + input.name;
    input.q = load_motion(model, o.motion, {}, o.call, remarks).q;
  }
  add_coloring("force", "N", o.forces, input, remarks);
  add_coloring("activation", "", o.activations, input, remarks);
  std::optional<MarkerSeries> markers;
  if (!o.markers.empty()) {
    markers = read_page_markers(o, model, remarks);
    input.markers = &*markers;
  }
  result.page.scenes.push_back(body::model_scene(model, input));
  if (o.model != "arm4") {
    body::MeshOptions meshes;
    meshes.folders.assign(o.mesh_folders.begin(), o.mesh_folders.end());
    body::add_meshes(body::load_meshes(read_text_file(o.model), o.model, meshes), result.page);
  }
  result.html = page::scene_page(result.page);
  result.remarks = remarks.list();
  return result;
}

void write_model_page(const ModelPageResult& result, const std::filesystem::path& path) {
  write_file(path, result.html);
}

}  // namespace myoid::program
