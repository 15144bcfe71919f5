#pragma once

#include <string>
#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/files/marker_series.h"
#include "myoid/model/body_model.h"
#include "myoid/report/scene.h"

namespace myoid {

/// Quantities that may color the muscles. A muscle's column has its name, or
/// "<name>.<quantity>", "<name>|<quantity>", ".../<name>/<quantity>", ".../<name>".
struct MuscleColoring {
  std::string name;  ///< "force", "activation"
  std::string unit;  ///< "N"; empty: dimensionless.
  TimeSeries series;
};

struct SceneInput {
  std::string name;
  TimeSeries q;  ///< All coordinates in the model's order [rad, m]; empty: the default posture.
  const recording::MarkerSeries* markers = nullptr;  ///< Measured, in ground; not owned.
  std::vector<MuscleColoring> colorings = {};
};

struct SceneOptions {
  int most_frames = 1500;
};

/// Returns the model along a motion, ready to be drawn. Frames beyond the options' number are left out, with a note.
///
/// Bones are sticks from each body's own joint to the joints of its children (where these are in the default posture),
/// and of a body without children to its mass center, or on to the farthest marker or muscle point in that direction.
/// Muscles without wrap objects, moving or conditional points are given by their points; the others by a line per frame
/// (model/path_polyline.h). Colorings and measured markers are taken at the frames' times, linearly between samples,
/// never beyond them or across a missing sample. Throws InvalidInput if q has other channels.
[[nodiscard]] report::Scene model_scene(const model::BodyModel& model,
                                        const SceneInput& input,
                                        const SceneOptions& options = {});

}  // namespace myoid
