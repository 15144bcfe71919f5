#pragma once

#include <string>

#include "myoid/core/time_series.h"
#include "myoid/dynamics/external_loads.h"
#include "myoid/model/body_model.h"

namespace myoid::dynamics {

/// What an instrumented object (a handle with a load cell) exerts on a body of the person, as a
/// load for inverse dynamics. The object has a model of its own, whose coordinates `object_q` [rad
/// | m] follow its markers; the cell is `frame` of it. `wrench` has Fx, Fy, Fz [N], Mx, My, Mz [N
/// m] in the cell's axes about its origin; it is interpolated to the clock of `object_q`, so
/// low-pass it first. In ground, with the cell's pose (R, p) of each instant:
///
///   force R F at the point p, moment R M
///
/// Throws InvalidInput if a coordinate of the object is missing from `object_q`, a value is not
/// finite, or the wrench does not cover the time of `object_q`.
[[nodiscard]] ExternalForce instrument_load(const model::BodyModel& object,
                                            const TimeSeries& object_q,
                                            model::BodyIndex frame,
                                            const TimeSeries& wrench,
                                            model::BodyIndex applied_to,
                                            const std::string& name);

/// The same where the cell's frame is a body of the person's own model.
[[nodiscard]] ExternalForce instrument_load(model::BodyIndex frame,
                                            const TimeSeries& wrench,
                                            model::BodyIndex applied_to,
                                            const std::string& name);

}  // namespace myoid::dynamics
