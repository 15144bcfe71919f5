#pragma once

#include <cstdint>
#include <vector>

#include "myoid/lab/virtual_person/control.h"
#include "myoid/lab/virtual_person/protocol.h"
#include "myoid/lab/virtual_person/smooth_motion.h"

namespace myoid::lab {

/// One effort against a dynamometer: rises, holds, falls; 0 outside.
struct Effort {
  double start_s = 0.0;
  double rise_s = 1.0;
  double hold_s = 1.0;
  bool flexion = true;
  Coordination coordination;  ///< Coordination in this effort; its co-contraction is not used.

  /// Returns the level, 0..1, with five continuous derivatives.
  [[nodiscard]] double level(double time_s) const;
  [[nodiscard]] double end_s() const { return start_s + 2.0 * rise_s + hold_s; }
};

/// A slow modulation: 1 + depth cos(2 pi f t + phase).
struct Modulation {
  double depth = 0.0;
  double frequency_hz = 0.1;
  double phase_rad = 0.0;

  [[nodiscard]] double operator()(double time_s) const;
};

/// The acts of a virtual person in one trial, at any time. They begin before the recording and end
/// after it, because muscles act a little later than the electrodes show.
struct TrialScript {
  TrialProtocol protocol;
  double duration_s = 0.0;
  SmoothMotion motion;
  std::vector<Effort> efforts;        ///< For isometric and maximal trials; else empty.
  Coordination mean;                  ///< Mean of the trial.
  Modulation brachioradialis_change;  ///< Its departure from 1 is added to the mean.
  Modulation brachialis_change;
  Modulation co_contraction_change;             ///< Factor on the co-contraction.
  bool eased = false;                           ///< Coordination::eased.
  PerMuscle mvc_effort = {1.0, 1.0, 1.0, 1.0};  ///< Share of the greatest activation that an MVC trial reaches.
  double emg_gain_first = 1.0;                  ///< EMG per excitation at the beginning.
  double emg_gain_last = 1.0;                   ///< EMG per excitation at the end; a straight line in between.

  /// Returns 1 at the beginning of a trial with a warm-up, fading to 0.05 at its end; else 0.
  [[nodiscard]] double cold(double time_s) const;

  [[nodiscard]] double emg_gain(double time_s) const;

  /// Returns the shares of the torque at this time, in trials with a motion.
  [[nodiscard]] Coordination coordination(double time_s) const;

  /// Returns the activations in a trial against the dynamometer, or of relaxed muscles.
  [[nodiscard]] PerMuscle prescribed_activations(double time_s) const;

  /// Returns true if `prescribed_activations` apply and the dynamometer exerts the rest of the
  /// torque; false if the muscles must exert the torque that the motion requires.
  [[nodiscard]] bool against_dynamometer() const;
};

/// Draws the random part of the protocol. The streams depend on the name of the trial, so that a
/// further trial does not change the others.
[[nodiscard]] TrialScript make_script(const TrialProtocol& trial, const ControlSpec& control, std::uint64_t seed);

}  // namespace myoid::lab
