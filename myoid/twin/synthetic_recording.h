#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "myoid/core/geometry.h"
#include "myoid/core/time_series.h"
#include "myoid/files/marker_series.h"
#include "myoid/twin/instruments.h"
#include "myoid/virtual_person/control.h"
#include "myoid/virtual_person/departures.h"
#include "myoid/virtual_person/draw_truth.h"
#include "myoid/virtual_person/protocol.h"
#include "myoid/virtual_person/true_arm.h"
#include "myoid/virtual_person/virtual_arm.h"

namespace myoid::twin {

/// The parameters of the virtual person, and the numbers that the identification is to find.
struct Truth {
  /// In the order of kArmMuscles. At L2, where nobody has such parameters, those of the fitted
  /// model that come closest to the person (effective_truth.h).
  HillSet muscles;
  /// The muscle does at t what its EMG said at t - delay; at L2, as nearly as a delay can say it.
  double emg_delay_s = 0.0;
  PerMuscle effort = {1.0, 1.0, 1.0,
                      1.0};  ///< What the MVC trials reach of the greatest activation.
  Instruments instruments;
  BesideMuscles beside;        ///< L0, L1.
  Departures departures;       ///< L0, L1.
  int draws = 1;               ///< Persons drawn until every trial could be done.
  std::optional<TrueArm> arm;  ///< L2: what the person really is.
  PerMuscle misfit = {};       ///< L2: of `muscles`, a share of the torque.
};

/// The truth over time in one trial, on the clock of the markers.
struct TrueTrial {
  TimeSeries motion;      ///< elbow_flexion [rad], its speed and acceleration.
  TimeSeries torque;      ///< elbow_flexion_moment (of the muscles), then ..._external_moment and
                          ///< ..._passive_moment (of the joint) [N m].
  TimeSeries activation;  ///< Per muscle: what the muscle does, after the delay.
  TimeSeries force;       ///< Per muscle [N].
  TimeSeries length;      ///< Per muscle: fiber length [m].
  /// L2: of each head HEAD_activation, HEAD_fiber_length [m] and HEAD_tendon_force [N].
  std::optional<TimeSeries> heads;
  TimeSeries state;         ///< `cold`, 1 to 0 in a warm-up; fatigued_MUSCLE, share of strength.
  PerMuscle fatigued = {};  ///< Share of strength that is gone in the middle of the trial.
  EmgClock emg_clock;
};

/// The recording of one trial.
struct VirtualTrial {
  TrialProtocol protocol;
  recording::MarkerSeries markers;  ///< In ground, Y up.
  /// Per electrode: raw EMG [V], or the exact activation (before the delay) in a noise-free
  /// recording.
  TimeSeries emg;
  /// elbow_flexion_moment [N m]: torque that the dynamometer exerts on the forearm about the axis
  /// of flexion, positive if it flexes. The muscles' is M(q) qddot + ... - gravity - this one.
  std::optional<TimeSeries> external_torque;
  TrueTrial truth;
};

/// A virtual experiment: everything that `write_virtual_recording` puts into files, as values.
struct VirtualRecording {
  Protocol protocol;
  std::uint64_t seed = 0;
  std::string model_osim;  ///< Text of the model file: the arm with the literature's muscles.
  std::string held_body;   ///< Body of the model that holds the mass, and where [m].
  Vec3 held_at_m = Vec3::Zero();
  Truth truth;
  std::vector<VirtualTrial> trials;
};

/// Performs the protocol with a virtual person drawn from the priors with this seed; the same seed
/// gives the same recording to the bit.
///
/// L0 and L1, the built-in arm (four muscles, rigid tendons): a motion with five continuous
/// derivatives is chosen, the torque that it requires is computed, and shared among the muscles by
/// activations that solve T = sum r_i F_i exactly, with co-contraction and slowly changing
/// proportions; against a dynamometer the activations are chosen and the dynamometer exerts what is
/// left. The electrode sees the activation `emg_delay_s` earlier.
///
/// L2, seven heads (true_arm.h): the person tries to follow that motion and is simulated forward
/// (SimulatedPerformance); the motion recorded is what came of it.
///
/// Then the instruments record (instruments.h). If a trial would need an activation above 0.95,
/// another person is drawn. Throws InvalidInput, naming the trial, if 500 persons could not do it.
[[nodiscard]] VirtualRecording make_virtual_recording(const Protocol& protocol, std::uint64_t seed);

/// The same person doing the same, without recorded trials: for tables of truths.
[[nodiscard]] VirtualRecording make_virtual_person(const Protocol& protocol, std::uint64_t seed);

}  // namespace myoid::twin
