#pragma once

namespace myoid::identification {

/// One muscle at one instant of a recording.
struct MuscleSample {
  double time_s = 0.0;
  double activation = 0.0;  ///< 0..1
  double fiber_length_m = 0.0;
  double fiber_velocity_mps = 0.0;  ///< Lengthening positive.
  double force_n = 0.0;             ///< From force sharing.
};

}  // namespace myoid::identification
