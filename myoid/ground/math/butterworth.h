#pragma once

#include <vector>

namespace myoid::inline ground::math {

/// One section of a digital filter: y = b0 x + b1 x1 + b2 x2 - a1 y1 - a2 y2. A first-order section has b2 = a2 = 0.
struct SecondOrderSection {
  double b0 = 1.0, b1 = 0.0, b2 = 0.0, a1 = 0.0, a2 = 0.0;
};

enum class FilterBand { low_pass, high_pass };

/// Designs a digital Butterworth filter of any order >= 1 as second-order sections. The analog prototype
///   |H(w)|^2 = 1 / (1 + (w / w_c)^(2 order))        (its reciprocal in w for a high-pass)
/// is transformed bilinearly with the cut-off pre-warped, w_c = tan(pi f_c / f_s), so that the gain of one pass at
/// `cutoff_hz` is exactly 1/sqrt(2). Throws InvalidInput unless 0 < cutoff_hz < rate_hz / 2 and order >= 1.
[[nodiscard]] std::vector<SecondOrderSection> design_butterworth(FilterBand band,
                                                                 int order,
                                                                 double cutoff_hz,
                                                                 double rate_hz);

/// Returns the cut-off to design so that a forward and a backward pass together have -3 dB at `cutoff_hz`. In the
/// pre-warped domain w = tan(pi f / f_s), w_design = w / C with C = (sqrt(2) - 1)^(1 / (2 order)) for a low-pass and w
/// C for a high-pass. Order 2: C = 0.8022; 6 Hz at 30 Hz gives 7.03 Hz. Throws as `design_butterworth`, and if the
/// corrected cut-off is not below rate_hz / 2.
[[nodiscard]] double two_pass_cutoff_hz(FilterBand band, int order, double cutoff_hz, double rate_hz);

/// Returns |H| of one pass at a frequency.
[[nodiscard]] double gain(const std::vector<SecondOrderSection>& sections, double frequency_hz, double rate_hz);

}  // namespace myoid::inline ground::math
