#pragma once

#include <cstdint>
#include <vector>

#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/lab/virtual_person/performance.h"
#include "myoid/lab/virtual_person/protocol.h"
#include "myoid/lab/virtual_person/virtual_arm.h"

namespace myoid::lab {

/// The instruments on one person.
struct Instruments {
  std::vector<MarkerError> markers;  ///< In the order of VirtualArm::markers.
  PerMuscle greatest_v = {};         ///< Rms of the raw EMG at full activation.
  PerMuscle exponent = {};           ///< p: excitation = (rms / greatest_v)^p.
  PerMuscle crosstalk = {};          ///< Share of the neighbour's signal in a channel.
  PerMuscle baseline = {};           ///< Rms of the amplifier's noise, relative to greatest_v.
  PerMuscle spectrum = {};           ///< Factor on Shwedyk's frequencies.
  double clock_drift = 0.0;          ///< Relative drift of the EMG's clock.
};

/// Draws the instruments; each kind from a stream of its own.
[[nodiscard]] Instruments attach_instruments(const Protocol& protocol, const VirtualArm& arm, std::uint64_t seed);

/// The true time at the file's time t of this trial: (1 + drift) t + offset.
struct EmgClock {
  double offset_s = 0.0;
  double drift = 0.0;
  [[nodiscard]] double true_time_s(double file_time_s) const { return file_time_s + drift * file_time_s + offset_s; }
};
[[nodiscard]] EmgClock emg_clock(const Protocol& protocol,
                                 const Instruments& instruments,
                                 const std::string& trial,
                                 std::uint64_t seed);

/// Returns times from 0 to the end of a trial.
[[nodiscard]] Eigen::VectorXd clock(double duration_s, double rate_hz);

/// Returns markers in ground with the errors of cameras and skin; NaN while a marker is hidden. Exact at level L0.
[[nodiscard]] MarkerSeries record_markers(const Protocol& protocol,
                                          const VirtualArm& arm,
                                          const Instruments& instruments,
                                          const Performance& performance,
                                          std::uint64_t seed);

/// Returns raw EMG [V] of each electrode: BIC, BRA if it has one, BRD, TRI. At level L0 returns the
/// exact excitation instead.
///
///   channel = greatest (s_i + x s_neighbour + baseline w + hum + artefact),  s_i = u_i^(1/p) n_i
///
/// n_i is noise of Shwedyk's spectrum, whose frequencies fatigue lowers by its share, Gaussian or
/// made of the discharges of motor units (EmgNoise::motor_units); w is white. Neighbours: BRA of
/// BIC, BIC of BRA, and of BRD the radial wrist extensors, which have no electrode and hold the
/// hand (half of the biceps' excitation and 0.05 per kilogram). A SensorTruth::crosstalk adds the
/// same share of every other channel's s. The amplifier's bandwidth comes last.
[[nodiscard]] TimeSeries record_emg(const Protocol& protocol,
                                    const Instruments& instruments,
                                    const Performance& performance,
                                    const EmgClock& emg_clock,
                                    std::uint64_t seed);

/// Returns elbow_flexion_moment [N m] of the dynamometer: scale * torque + offset (SensorTruth), and noise.
[[nodiscard]] TimeSeries record_torque(const Protocol& protocol,
                                       const Performance& performance,
                                       const Eigen::VectorXd& time_s,
                                       const Eigen::VectorXd& external_torque_nm,
                                       std::uint64_t seed);

/// Returns the fascicle lengths [m] that ultrasound shows of each muscle at 30 Hz, in all of these times: those of the
/// fibers times a scale plus an offset, drawn from the beliefs of the identification and the same in all trials, and an
/// error (SensorTruth) that lasts a second.
[[nodiscard]] TimeSeries record_fascicles(const Protocol& protocol,
                                          const Performance& performance,
                                          double duration_s,
                                          std::uint64_t seed);

/// Returns true if the brachialis has a (wire) electrode in this protocol.
[[nodiscard]] bool has_brachialis_electrode(const Protocol& protocol);

}  // namespace myoid::lab
