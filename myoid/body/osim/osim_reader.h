#pragma once

#include <filesystem>
#include <string_view>

#include "myoid/body/model/body_model.h"

namespace myoid::body {

struct OsimOptions {
  Compat compat;  ///< Copied to BodyModel::compat; also decides the rounding of old documents.
};

/// Reads an OpenSim model, document version 10600 to 4xxxx, as a BodyModel.
///
/// Joints: Weld, Pin, Slider, Universal, Gimbal, Ball, Free, Planar, Ellipsoid, Scapulothoracic, Custom. Speeds are the
/// rates of the coordinates, also where OpenSim's speeds are angular velocities (body/kinematics/angular_speeds.h has
/// OpenSim's). A loop of joints is cut as OpenSim does. Functions: Constant, Linear, Polynomial, PiecewiseLinear,
/// SimmSpline and NaturalCubicSpline, cubic GCVSpline, Multiplier. Path points: fixed, conditional, moving. Wrap
/// objects: cylinder, ellipsoid, sphere, torus. Muscles of every class with the curves of Thelen, Millard, Schutte and
/// DeGrooteFregly. Actuators: Coordinate-, Point-, Torque-. Passive forces: limit forces, bushings, springs, ligaments.
/// Constraints: couplers of one coordinate, weld, point, distance, point on line. Values that an object omits come from
/// `<defaults>`, then from the class.
///
/// `BodyModel::unsupported` lists the unsupported parts of the file and their effect on results, `notes` the harmless
/// omissions. Throws ReadError with the line for bad XML, a missing element or socket, an unknown frame or a text that
/// is no number; ModelError for a tree that does not close or cannot be moved.
[[nodiscard]] BodyModel read_osim(const std::filesystem::path& path, const OsimOptions& options = {});
[[nodiscard]] BodyModel parse_osim(std::string_view xml,
                                   const std::filesystem::path& path,
                                   const OsimOptions& options = {});

/// No two neighboring segments of a person or an animal have their origins farther apart.
inline constexpr double kLongestSegment_m = 10.0;
/// Throws ReadError if a joint, other than to ground, has its segments' origins farther apart at the default posture.
void require_lengths_in_m(const BodyModel& model, const std::filesystem::path& path);

/// Reads the force set of a file whose root holds a <ForceSet> (reserve actuators) into a copy of
/// the model. Of two forces with one name the model keeps its own, as OpenSim does, with a note.
[[nodiscard]] BodyModel with_force_set(BodyModel model, const std::filesystem::path& path);

}  // namespace myoid::body
