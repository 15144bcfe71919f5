#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

/// Two EMG channels whose exchange makes the recording far more probable.
struct ExchangedElectrodes {
  std::string first, second;
  double log_odds = 0.0;  ///< ln of the evidence with these names exchanged, over that as they are.
  double r2 = 0.0;        ///< Of the fit with the names as they are.
  [[nodiscard]] std::string sentence() const;
};

/// Fits the study again with two channels exchanged, and returns the pair that makes it the most probable, by
/// kExchangedOdds at least (Laplace's evidence). Pairs are tried of which a muscle lies far from what is known of
/// people in `fit`, of `data` by `options`; all, where this fit explains less than 90 % of the torque.
[[nodiscard]] std::optional<ExchangedElectrodes> exchanged_electrodes(const StudyData& data,
                                                                      const EstimatorOptions& options,
                                                                      const IdentificationResult& fit);

inline constexpr double kExchangedOdds = 5.0;  ///< ln of the odds from which an exchange is named: 150 to 1.

}  // namespace myoid::fit
