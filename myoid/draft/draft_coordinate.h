#pragma once

#include <string>
#include <vector>

#include "myoid/model/body_model.h"

namespace myoid {

/// Muscles that have a moment arm about the coordinate of more than 1 mm somewhere in its range, or
/// within 1.5 rad (or m) of its default value.
[[nodiscard]] std::vector<std::string> movers(const model::BodyModel& model,
                                              const std::string& coordinate);

/// True for the elbow's flexion, the knee's and the ankle's, as models usually call them.
[[nodiscard]] bool is_usual(const std::string& coordinate);

/// The usual ones first, elbow, knee, ankle; the others in their order.
[[nodiscard]] std::vector<std::string> usual_first(std::vector<std::string> coordinates);

/// The coordinate that the muscles of most channels move (`match_channels`); of equals the first;
/// empty if no channel is called like a muscle that moves one.
[[nodiscard]] std::string coordinate_of_channels(const model::BodyModel& model,
                                                 const std::vector<std::string>& coordinates,
                                                 const std::vector<std::string>& channels);

}  // namespace myoid
