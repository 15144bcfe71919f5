#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/page/scene_page.h"
#include "myoid/program/steps/call.h"
#include "myoid/program/steps/stage_options.h"

namespace myoid::program {

/// Options of a page that shows a moving model in the browser.
struct ModelPageOptions {
  Call call;
  std::string model;                                        ///< A file (.osim), or "arm4".
  body::Compatibility compat = body::Compatibility::exact;  ///< Paths: exact, or opensim.
  std::string motion;                                       ///< Joint angles (.mot, .sto); empty: the default posture.
  std::string forces, activations;                          ///< Color the muscles along the motion (.sto).
  std::string markers;                    ///< Measured markers, shown beside the model's (.trc, .c3d).
  std::string up;                         ///< Vertical of the markers: x, -y, ...; empty: as for `ik`.
  std::vector<std::string> mesh_folders;  ///< Searched after the model's folder and its Geometry.
  std::string out;                        ///< File of `write_model_page`.
};
/// Visits all options but the model and its paths.
void visit(ModelPageOptions& options, study::SettingVisitor& v);

struct ModelPageResult {
  page::ScenePage page;  ///< With one scene.
  std::string html;
  std::vector<Remark> remarks;
};

/// Makes the page. Throws InvalidInput for forces, activations or markers without a motion.
[[nodiscard]] ModelPageResult model_page(const ModelPageOptions& options);

/// Writes the page: one file, which works offline.
void write_model_page(const ModelPageResult& result, const std::filesystem::path& path);

}  // namespace myoid::program
