#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"

namespace myoid::run {

/// A mistake in the EMG without which the recording is far more probable: two channels are exchanged, in every trial or
/// in one, or all channels of one trial have another gain.
struct MistakenEmg {
  std::string trial;          ///< Empty: every trial.
  std::string first, second;  ///< The exchanged channels; empty: the gain or the clock is another.
  double gain = 1.0;          ///< The trial's EMG over that which its torque tells.
  double late_s = 0.0;        ///< Of the trial's EMG after the time that its torque tells; not 0: the clock is another.
  double log_odds = 0.0;      ///< ln of the evidence without the mistake, over that as it is.
  double r2 = 0.0;            ///< Of the fit with the EMG as it is.
  [[nodiscard]] bool is_exchange() const { return !first.empty(); }
  [[nodiscard]] bool is_clock() const { return late_s != 0.0; }
  [[nodiscard]] bool is_gain() const { return !is_exchange() && !is_clock(); }
  /// Returns true where no number of the fit is to be used: it explains less than `least_r2` of the torque, or the
  /// trial's gain or clock is another by kSureOdds.
  [[nodiscard]] bool spoils_all(double least_r2) const;
  [[nodiscard]] std::string about_trial() const;  ///< "electrodes of BIC and TRI exchanged"
  [[nodiscard]] std::string finding() const;      ///< "electrodes of BIC and TRI exchanged in trial 'slow'"
  [[nodiscard]] std::string sentence() const;     ///< The finding and its odds.
  [[nodiscard]] std::string remedy() const { return finding() + ": mend that first"; }
};

/// Fits the study again without a mistake, and returns that which makes it the most probable, by kMistakenOdds at least
/// (Laplace's evidence). In every trial, pairs are tried of which a muscle lies far from what is known of people in
/// `fit`, of `data` by `options`; all, where this fit explains less than 90 % of the torque. In one trial, exchanges,
/// gains and clocks are tried whose errors are far larger than the other trials' (ln b, noise_model.h): the muscles
/// that the other trials tell choose the mistake, and a fit to all trials confirms it.
[[nodiscard]] std::optional<MistakenEmg> mistaken_emg(const fit::StudyData& data,
                                                      const fit::EstimatorOptions& options,
                                                      const fit::IdentificationResult& fit);

inline constexpr double kMistakenOdds = 5.0;  ///< ln of the odds from which a mistake is named: 150 to 1.
/// ln of the odds that no other fault explains, 10^10: from these on a mistake is named where a muscle has no EMG,
/// whose pull may be another mistake's, and another gain or clock makes the fit fail.
inline constexpr double kSureOdds = 23.0;

}  // namespace myoid::run
