#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"

namespace myoid::run {

/// The numbers of a fit if the activations without EMG are expected otherwise: by the synergies of the measured EMG in
/// place of a constant, and by a constant in place of synergies.
struct OtherChoice {
  struct Number {
    std::string muscle, parameter;
    double other = 0.0;  ///< The estimate, moved as the mode moves.
    double moved = 0.0;  ///< By so many widths of the 95 % interval to that side.
    [[nodiscard]] bool outside() const { return moved > 1.0; }
  };
  std::string other;  ///< The choice in words.
  std::vector<Number> numbers;

  /// Returns the number of this estimate; null: it has none, as V_sh V_shl.
  [[nodiscard]] const Number* of(const fit::ParameterEstimate& estimate) const;
  /// Returns how many numbers leave their interval.
  [[nodiscard]] std::ptrdiff_t outside() const;
  [[nodiscard]] std::string sentence() const;
};

/// Fits the other choice from the fit's answer on, by the normal approximation. Empty where every muscle has EMG, or
/// the fit is of exact data.
[[nodiscard]] std::optional<OtherChoice> other_choice(const fit::StudyData& data,
                                                      const fit::EstimatorOptions& options,
                                                      const fit::IdentificationResult& torque);

}  // namespace myoid::run
