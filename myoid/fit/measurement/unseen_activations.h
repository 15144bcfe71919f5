#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

/// Fills the channels of all muscles without EMG in all trials, and UnseenActivation by the beliefs: the activation is
/// expected to be a constant, or the sum of the synergies of the measured EMG, each scaled to the same mean over the
/// fitted trials. Its error lasts as long as the measured activations do. Data whose muscles all have EMG stay as they
/// are. Throws InvalidInput if no muscle has EMG.
void expect_activations(StudyData& data);

/// Returns the measured channels that the muscles name, each once.
[[nodiscard]] std::vector<std::string> measured_channels(const StudyData& data);

/// Returns the reason for which F_max of such a muscle is not told, with the remedy.
[[nodiscard]] std::string without_emg_says(const std::string& muscle);

/// Fills these channels of trials that another study recorded anew, by the synergies of `fitted`.
void expect_activations_of(const StudyData& fitted, std::vector<TrialData>& others);

/// Returns W, channels x factors, of the non-negative factorization X = H W' of envelopes X, n x channels: the fewest
/// factors that leave at most `unexplained` of the sum of squares. Deterministic.
[[nodiscard]] Eigen::MatrixXd synergies_of(const Eigen::MatrixXd& envelopes, double unexplained = 0.1);

/// Returns the non-negative H, n x factors, for which H W' is nearest to the envelopes by least squares.
[[nodiscard]] Eigen::MatrixXd activations_of(const Eigen::MatrixXd& synergies, const Eigen::MatrixXd& envelopes);

/// Returns the cut-off of a signal without power above it, and with equal power below, whose autocorrelation falls to a
/// half as fast as that of the columns' changes: 0.25 to 6 Hz. Rows are `interval_s` apart.
[[nodiscard]] double bandwidth_hz(const Eigen::MatrixXd& values, double interval_s);

}  // namespace myoid::fit
