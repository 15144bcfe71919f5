#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "myoid/ground/core/geometry.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/lab/twin/instruments.h"
#include "myoid/lab/virtual_person/control.h"
#include "myoid/lab/virtual_person/departures.h"
#include "myoid/lab/virtual_person/draw_truth.h"
#include "myoid/lab/virtual_person/protocol.h"
#include "myoid/lab/virtual_person/true_arm.h"
#include "myoid/lab/virtual_person/virtual_arm.h"

namespace myoid::lab {

/// The parameters of the virtual person, and the numbers that the identification seeks.
struct Truth {
  /// In the order of kArmMuscles. At L2, where no person has such parameters, those of the fitted
  /// model that come closest to the person (effective_truth.h).
  HillSet muscles;
  /// The muscle's activation at t follows the EMG at t - delay; at L2 approximately.
  double emg_delay_s = 0.0;
  PerMuscle effort = {1.0, 1.0, 1.0, 1.0};  ///< Share of the greatest activation that the MVC trials reach.
  Instruments instruments;
  BesideMuscles beside;        ///< L0, L1.
  Departures departures;       ///< L0, L1.
  int draws = 1;               ///< Number of persons drawn until one could do every trial.
  std::optional<TrueArm> arm;  ///< L2: the person's true arm.
  PerMuscle misfit = {};       ///< L2: misfit of `muscles`, relative to the torque.
};

/// The truth over time in one trial, on the clock of the markers.
struct TrueTrial {
  TimeSeries motion;      ///< elbow_flexion [rad], its speed and acceleration.
  TimeSeries torque;      ///< elbow_flexion_moment (of the muscles), then ..._external_moment and
                          ///< ..._passive_moment (of the joint) [N m].
  TimeSeries activation;  ///< Per muscle: activation, after the delay.
  TimeSeries force;       ///< Per muscle [N].
  /// L2: for each head HEAD_activation, HEAD_fiber_length [m] and HEAD_tendon_force [N].
  std::optional<TimeSeries> heads;
  TimeSeries state;         ///< `cold`, 1 to 0 in a warm-up; fatigued_MUSCLE, share of strength.
  PerMuscle fatigued = {};  ///< Share of strength lost in the middle of the trial.
  EmgClock emg_clock;
};

/// The recording of one trial.
struct VirtualTrial {
  TrialProtocol protocol;
  MarkerSeries markers;  ///< In ground, Y up.
  /// Per electrode: raw EMG [V], or the exact activation (before the delay) in a noise-free recording.
  TimeSeries emg;
  /// elbow_flexion_moment [N m]: torque of the dynamometer on the forearm about the axis of
  /// flexion, positive in flexion. The muscles' torque is M(q) qddot + ... - gravity - this torque.
  std::optional<TimeSeries> external_torque;
  std::optional<TimeSeries> fascicles;  ///< Lengths by ultrasound [m], per muscle.
  TrueTrial truth;
};

/// A virtual experiment as values: the content of all files of `write_virtual_recording`.
struct VirtualRecording {
  Protocol protocol;
  std::uint64_t seed = 0;
  std::string model_osim;         ///< Text of the model file: the arm with the literature's muscles.
  Vec3 held_at_m = Vec3::Zero();  ///< Place of the held mass in `kHeldBody`.
  Truth truth;
  std::vector<VirtualTrial> trials;
};

/// Performs the protocol with a virtual person drawn from the priors with this seed; the same seed
/// gives the same recording to the bit.
///
/// L0 and L1, the built-in arm (four muscles, rigid tendons): a motion with five continuous derivatives is chosen and
/// its torque computed. Activations that solve T = sum r_i F_i exactly, with co-contraction and slowly changing
/// proportions, share this torque among the muscles. Against a dynamometer the activations are chosen and the
/// dynamometer exerts the rest. The electrode sees the activation `emg_delay_s` earlier.
///
/// L2, seven heads (true_arm.h): the person tries to follow this motion and is simulated forward
/// (SimulatedPerformance); the recorded motion is the simulated one.
///
/// Then the instruments record (instruments.h). If a trial needs an activation above 0.95, another
/// person is drawn. Throws InvalidInput with the trial's name if 500 persons could not do it.
[[nodiscard]] VirtualRecording make_virtual_recording(const Protocol& protocol, std::uint64_t seed);

/// Draws the same person with the same performance, without records: for tables of truths.
[[nodiscard]] VirtualRecording make_virtual_person(const Protocol& protocol, std::uint64_t seed);

}  // namespace myoid::lab
