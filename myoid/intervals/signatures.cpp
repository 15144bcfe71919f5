#include "myoid/intervals/signatures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

namespace myoid::identification {

std::vector<std::string> signatures(const std::vector<ParameterEstimate>& estimates) {
  struct Pattern {
    std::optional<double> length_ratio, curvature, product, plateau;
    double narrowest = 1.0, widest = 1.0;
    bool plateau_near_one = false;
  };
  std::map<std::string, Pattern> patterns;
  for (const ParameterEstimate& e : estimates) {
    // What is mostly the prior's says nothing about the data.
    if (!std::isfinite(e.estimate) || (e.shrinkage && *e.shrinkage < 0.3)) continue;
    Pattern& p = patterns[e.muscle];
    const double ratio = e.initial > 0.0 ? e.estimate / e.initial : 1.0;
    if (e.parameter == "force_length_width") {
      p.narrowest = std::min(p.narrowest, ratio);
      p.widest = std::max(p.widest, ratio);
    }
    if (e.parameter == "optimal_fiber_length")
      p.length_ratio = std::min(p.length_ratio.value_or(ratio), ratio);
    if (e.parameter == "concentric_curvature") p.curvature = e.estimate;
    if (e.parameter == "eccentric_curvature_product") p.product = e.estimate;
    if (e.parameter == "eccentric_plateau") {
      p.plateau = e.estimate;
      p.plateau_near_one = std::abs(e.estimate - 1.0) < 0.12;
    }
  }
  std::vector<std::string> found;
  for (const auto& [muscle, p] : patterns) {
    const bool straight = p.curvature && *p.curvature > 2.0;
    const bool bent = p.curvature && *p.curvature < 0.12;
    const bool narrow = p.narrowest < 0.5;
    // The far flank of a curve that is too wide is a gain below 1.
    const bool flank = p.widest > 1.5 && p.length_ratio && *p.length_ratio < 0.5;
    if ((p.product && *p.product <= 0.0 && p.plateau_near_one) || (straight && !flank)) {
      found.push_back(fmt::format(
          "{}: emg_delay_ignored: no effect of velocity is resolved (V_sh very large, "
          "or V_sh V_shl not positive with V_ml near 1), as when the force lags the EMG "
          "and no delay is allowed for",
          muscle));
    }
    const bool step = p.plateau && *p.plateau < 0.6 && p.product && std::abs(*p.product) < 0.15;
    if (step) {
      found.push_back(fmt::format(
          "{}: gain_mismatch: V_ml far below 1 with V_sh V_shl near 0 is a step in gain between "
          "shortening and lengthening: EMG is there while (almost) no force is assigned "
          "(co-contraction, or F_max or the EMG gain too high)",
          muscle));
    } else if (flank) {
      found.push_back(fmt::format(
          "{}: gain_mismatch: an optimal length far below and a width far above what they began at "
          "make a flank that is nothing but a gain: F_max or the EMG gain is too high",
          muscle));
    }
    if (narrow && !step &&
        (bent || (p.product && *p.product <= 0.0) || (p.plateau && *p.plateau > 1.6))) {
      found.push_back(fmt::format(
          "{}: co_contraction_zeroed: a narrow force-length curve with a strongly bent "
          "force-velocity curve is what is left when an optimizer sets the antagonist to zero",
          muscle));
    }
  }
  return found;
}

}  // namespace myoid::identification
