#pragma once

#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/time_series.h"

namespace myoid::study {

/// Finds the muscles whose moment arm about the coordinate exceeds 1 mm somewhere in its range, or
/// within 1.5 rad (or m) of its default value.
[[nodiscard]] std::vector<std::string> movers(const body::BodyModel& model, const std::string& coordinate);

/// Returns true for the usual names of the flexion of elbow, knee and ankle.
[[nodiscard]] bool is_usual(const std::string& coordinate);

/// Puts elbow, knee and ankle first and keeps the order of the other coordinates.
[[nodiscard]] std::vector<std::string> usual_first(std::vector<std::string> coordinates);

/// Returns the coordinates that the recordings move by 5 degrees or more; where they move none, all. A coordinate whose
/// angles lie beyond the model's clamped range for most of a recording is left out: it follows another convention.
[[nodiscard]] std::vector<std::string> moved_coordinates(const body::BodyModel& model,
                                                         const std::vector<std::string>& coordinates,
                                                         const std::vector<TimeSeries>& recorded);

/// A coordinate that is chosen by the electrodes.
struct CoordinateOfChannels {
  std::string name;               ///< Empty: no channel has the name of a muscle that moves a coordinate.
  std::vector<std::string> more;  ///< Coordinates whose muscles have more channels.
};

/// Finds the coordinate that the muscles of most channels move (`match_channels`), of equals the first. Elbow, knee and
/// ankle with two channels or more come before all others: a muscle of the shoulder or hip moves several of its axes.
[[nodiscard]] CoordinateOfChannels coordinate_of_channels(const body::BodyModel& model,
                                                          const std::vector<std::string>& coordinates,
                                                          const std::vector<std::string>& channels);

/// Returns the same coordinate of the other side ("knee_angle_l" of "knee_angle_r") if as many channels have names of
/// muscles that move it: channels that state no side. Empty otherwise.
[[nodiscard]] std::string same_on_the_other_side(const body::BodyModel& model,
                                                 const std::string& coordinate,
                                                 const std::vector<std::string>& channels);

}  // namespace myoid::study
