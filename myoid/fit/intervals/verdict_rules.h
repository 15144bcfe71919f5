#pragma once

#include "myoid/ground/core/units.h"
#include "myoid/muscle/literature.h"

namespace myoid::fit {

/// The thresholds of all verdicts.
struct VerdictRules {
  /// Half width, value to farther end of the 95 % interval over the value. Up to this limit a
  /// number is `identified`: nine times in ten the value is within 10 % (0.10 times 1.96 / 1.645).
  double identified_half_width = 0.12;
  double weak_half_width = 0.60;      ///< Up to this half width `weak`, beyond it `not_identifiable`.
  double least_shrinkage = 0.30;      ///< Below, the value is `prior_dominated`.
  double half_shrinkage = 0.50;       ///< Below, at most `weak`: half of the information is the prior's.
  double delay_identified_s = 0.012;  ///< Half width of the EMG delay, absolute.
  double delay_weak_s = 0.05;
  double angle_identified_rad = 10.0 * kDegree;  ///< Half width of an angle, absolute.
  double angle_weak_rad = 30.0 * kDegree;
  double model_error = 0.20;  ///< Systematic error of the model above which nothing is `identified`.
  /// Share of a moving joint's torque that its angle, rate and acceleration explain, above which
  /// nothing of a muscle is `identified`.
  double motion_alone = 0.98;
  /// Distance from the prior's mean, in its spreads, above which at most `weak`.
  double prior_conflict = 3.0;
  /// Share of the optimal fiber length. If a muscle's active lengths span less, F_max f_l(l) is one
  /// number, and the data do not determine l0 and l_sh.
  double least_length_span = 0.05;
  muscle::Range relative_width = muscle::kRelativeWidths;  ///< l_sh over l0 of real muscles.
  [[nodiscard]] bool possible(double width) const {
    return width == 0.0 || (width >= relative_width.lower && width <= relative_width.upper);
  }
  double least_r2 = 0.50;   ///< A fit that explains less of the torque identifies nothing.
  double on_bound = 0.001;  ///< Share of the possible range: an interval that ends nearer to a bound is cut off.
  double active = 0.02, least_s = 0.1;  ///< A muscle acts above this activation, and has done so only after this time.
};

inline constexpr VerdictRules kVerdictRules;

}  // namespace myoid::fit
