#pragma once

#include <filesystem>
#include <utility>

#include <Eigen/Core>
#include <pugixml.hpp>

#include "myoid/body/osim/osim_editor.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/opensim/tool_stages.h"

namespace myoid::opensim {

/// Reads the markers of a file. Measuring and placing usually read one file: each repair is noted once.
[[nodiscard]] MarkerSeries markers_of(const ToolRun& run, const std::filesystem::path& file);

/// Returns the first and last frame of a time range; all frames for a range without a frame.
[[nodiscard]] std::pair<Eigen::Index, Eigen::Index> frames_in(const MarkerSeries& markers,
                                                              std::pair<double, double> range);

/// Runs <MarkerPlacer>: fits the model to the mean of the static trial, moves all markers but the
/// fixed ones to their measured places, and writes the pose and the marker set if asked for.
void place_markers(const ToolRun& run, pugi::xml_node placer, body::OsimEditor& editor);

}  // namespace myoid::opensim
