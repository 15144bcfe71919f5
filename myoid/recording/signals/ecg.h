#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace myoid::recording {

/// The heart in an EMG channel.
struct EcgBeats {
  std::vector<Eigen::Index> at;  ///< Sample of each beat's steepest wave.
  double rate_hz = 0.0;          ///< Median number of beats a second.
  double alike = 0.0;            ///< Median correlation of a beat with the mean of the others.
  double amplitude = 0.0;        ///< Mean height of the steepest waves between 8 and 40 Hz, in the unit of the EMG.
};

/// Finds the heart's electric field in raw EMG, which lies over the trunk's: waves between 8 and 40 Hz that come 0.6 to
/// 3 times a second at regular intervals (`kLimits.emg.ecg_irregular`), with silence between them, and, unlike bursts
/// of a muscle, have one shape (`kLimits.emg.ecg_alike`). Empty for fewer than six beats, or a rate below 200 Hz.
[[nodiscard]] std::optional<EcgBeats> find_ecg(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_hz);

/// Subtracts from each beat the mean beat of up to 30 around it, 0.2 s before to 0.4 s behind the steepest wave, scaled
/// to this beat by least squares and faded out at its ends. The EMG of the mean beat averages out to 1 / sqrt(30).
[[nodiscard]] Eigen::VectorXd without_ecg(const Eigen::Ref<const Eigen::VectorXd>& x,
                                          double rate_hz,
                                          const EcgBeats& beats);

}  // namespace myoid::recording
