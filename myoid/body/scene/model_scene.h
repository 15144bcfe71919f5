#pragma once

#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/page/scene.h"

namespace myoid::body {

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
  const MarkerSeries* markers = nullptr;  ///< Measured, in ground; not owned.
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
/// (body/model/path_polyline.h). Colorings and measured markers are taken at the frames' times, linearly between
/// samples, never beyond them or across a missing sample. Throws InvalidInput if q has other channels.
[[nodiscard]] page::Scene model_scene(const body::BodyModel& model,
                                      const SceneInput& input,
                                      const SceneOptions& options = {});

}  // namespace myoid::body
