#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/time_series.h"
#include "myoid/signals/emg_envelope.h"
#include "myoid/simulation/synthetic_recording.h"

namespace myoid::simulation {

/// One trial of a virtual person as an identification takes it; n samples of BIC, BRA, BRD and TRI.
struct ReadyTrial {
  std::string name;
  std::string use;           ///< As in a study: calibration, validation, isometric, mvc, passive.
  bool calibration = false;  ///< To be fitted (calibration and isometric).
  Eigen::VectorXd time_s;
  Eigen::MatrixXd length_m;      ///< n x 4: musculotendon lengths in the model.
  Eigen::MatrixXd velocity_mps;  ///< n x 4
  Eigen::MatrixXd moment_arm_m;  ///< n x 4
  Eigen::VectorXd torque_nm;     ///< n: what the muscles must provide.
  TimeSeries activation;         ///< Normalized envelope of each electrode.
};

/// A virtual person, ready for identification.
struct ReadyPerson {
  Protocol protocol;
  std::uint64_t seed = 0;
  Truth truth;
  HillSet literature;  ///< Where a search begins, and the means of the priors.
  /// Channel of each muscle: its own, or BIC for a brachialis without an electrode.
  std::vector<std::string> channels;
  std::vector<signals::ChannelNormalisation> normalisation;  ///< Empty at level L0.
  std::vector<ReadyTrial> trials;  ///< Those that `run` would hand to the identification.
};

/// What `myoid run` makes of the recording, in memory and by the same functions: EMG filtered,
/// rectified, smoothed and normalized by the greatest; inverse kinematics from the markers,
/// smoothing at the envelope's cut-off (at L0 none), inverse dynamics, muscle kinematics. Trials
/// for MVC and relaxed ones serve the normalization only.
[[nodiscard]] ReadyPerson identification_ready(const VirtualRecording& recording);

/// `make_virtual_recording`, then that. One person at level L2 with the rich protocol (300 s) takes
/// about one and a half core-seconds. Threads: none of its own beyond the library's; call it from a
/// parallel loop over persons.
[[nodiscard]] ReadyPerson make_identification_ready(const Protocol& protocol, std::uint64_t seed);

}  // namespace myoid::simulation
