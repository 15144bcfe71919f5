#pragma once

#include <string>

#include "myoid/body/dynamics/external_loads.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/time_series.h"

namespace myoid::body {

/// Returns the load that an instrumented object (a handle with a load cell) exerts on a body of the
/// person, for inverse dynamics. The object has a separate model, whose coordinates `object_q` [rad
/// | m] follow the object's markers; the cell is the body `frame` of that model. `wrench` has Fx,
/// Fy, Fz [N], Mx, My, Mz [N m] in the cell's axes about its origin. The wrench is interpolated to the clock of
/// `object_q`: low-pass it first. In ground, with the cell's pose (R, p) of each instant:
///
///   force R F at the point p, moment R M
///
/// Throws InvalidInput if a coordinate of the object is missing from `object_q`, a value is not
/// finite, or the wrench does not cover the time of `object_q`.
[[nodiscard]] ExternalForce instrument_load(const body::BodyModel& object,
                                            const TimeSeries& object_q,
                                            body::BodyIndex frame,
                                            const TimeSeries& wrench,
                                            body::BodyIndex applied_to,
                                            const std::string& name);

/// Returns the load of a cell whose frame is a body of the person's own model.
[[nodiscard]] ExternalForce instrument_load(body::BodyIndex frame,
                                            const TimeSeries& wrench,
                                            body::BodyIndex applied_to,
                                            const std::string& name);

}  // namespace myoid::body
