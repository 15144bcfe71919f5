#pragma once

namespace myoid::inline ground {

/// A Gaussian belief about a parameter before the data: mean and standard deviation, in the
/// parameter's own unit, or of its natural logarithm if `logarithmic`.
struct Prior {
  double mean = 0.0;  ///< In the parameter's unit also when `logarithmic` (the median).
  double sd = 0.0;    ///< > 0. If `logarithmic`: of ln(value), hence a relative spread.
  bool logarithmic = false;

  friend bool operator==(const Prior&, const Prior&) = default;
};

}  // namespace myoid::inline ground
