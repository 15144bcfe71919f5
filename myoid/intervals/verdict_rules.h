#pragma once

#include <string>

#include "myoid/muscle/literature.h"

namespace myoid::identification {

/// The thresholds of the verdicts, in one place.
struct VerdictRules {
  /// Farther end of the 95 % interval from the value, relative: at most this is `identified`: nine
  /// times in ten the value is then within 10 % (0.10 times 1.96 / 1.645) ...
  double identified_half_width = 0.12;
  double weak_half_width = 0.60;      ///< ... at most this `weak`, beyond it `not_identifiable`.
  double least_shrinkage = 0.30;      ///< Below, the value is `prior_dominated`.
  double half_shrinkage = 0.50;       ///< Below, at most `weak`: half of it is the prior's.
  double delay_identified_s = 0.012;  ///< Half width of the EMG delay, absolute.
  double delay_weak_s = 0.05;
  double model_error =
      0.20;  ///< Systematic error of the model above which nothing is `identified`.
  double prior_conflict = 3.0;  ///< Spreads of the prior away from its mean: at most `weak`.
  double prior_stays = 1.0;     ///< So near, a value that is not narrowed is the literature's.
  /// A share of the optimal fiber length: where a muscle's active lengths span less, F_max f_l(l)
  /// is one number, and nothing is told of l0 and l_sh.
  double least_length_span = 0.05;
  double flat_plateau = 1.02;  ///< V_ml whose interval reaches below says nothing about P.
  muscle::Range relative_width = muscle::kRelativeWidths;  ///< l_sh over l0 that a muscle can have.
  [[nodiscard]] bool possible(double width) const {
    return width == 0.0 || (width >= relative_width.lower && width <= relative_width.upper);
  }
  double least_r2 = 0.50;        ///< A fit that explains less of the torque identifies nothing.
  double no_delay_s = 1e-6;      ///< A delay on its bound that is no larger is 0.
  double any_shrinkage = 0.005;  ///< Below, the recording does not narrow the prior at all.
  double mostly_tendon = 0.5;    ///< Share of the variance that is the tendon slack length's.
  // A muscle is active above this activation, and moves above this share of v_max; for less than
  // this time it never did.
  double active = 0.02, moving_share = 0.01, least_s = 0.1;
};

/// Why nothing is told of a muscle's l0 and l_sh whose active lengths span `span` of l0.
[[nodiscard]] std::string one_length_text(double span);

/// The thresholds as a table in Markdown, which docs/theory/identification.md holds.
[[nodiscard]] std::string verdict_rules_markdown(const VerdictRules& rules = {});

}  // namespace myoid::identification
