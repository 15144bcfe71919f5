#pragma once

#include <filesystem>
#include <string_view>

#include "myoid/model/body_model.h"

namespace myoid::model {

/// Reads an OpenSim model, document version 30517 or 40000 and later, as a BodyModel.
///
/// Joints: Weld, Pin, Slider, Universal, Gimbal, Ball, Free, Planar, Custom, each written as six
/// axes. (Ball and Free: their speeds are the rates of the coordinates here, so that inverse
/// dynamics is right in them.) Functions: Constant, Linear, Polynomial, PiecewiseLinear, SimmSpline
/// and NaturalCubicSpline, Multiplier. Path points: fixed, conditional, moving. Wrap objects:
/// cylinder and ellipsoid. Every muscle class: the numbers they share; Thelen's own. Coordinate
/// actuators. Values that an object omits come from `<defaults>`, then from the class.
///
/// What cannot be taken as it is stands in `BodyModel::unsupported` (constraints, other joints and
/// wrap objects, with the names of what they would change); what was left out without harm in
/// `notes`. Throws ReadError with the line for bad XML, a missing element, an unknown frame or a
/// text that is no number; ModelError for a tree that does not close.
[[nodiscard]] BodyModel read_osim(const std::filesystem::path& path);
[[nodiscard]] BodyModel parse_osim(std::string_view xml, const std::filesystem::path& path);

}  // namespace myoid::model
