#include "myoid/fit/intervals/signatures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

namespace myoid::fit {

namespace {

/// The numbers of one muscle in which a single error shows; ratios are to the starting value.
struct Pattern {
  std::optional<double> length_ratio, curvature, product, plateau;
  double narrowest = 1.0, widest = 1.0;  ///< Ratios of the force-length width.
};

std::map<std::string, Pattern> patterns_of(const std::vector<ParameterEstimate>& estimates) {
  std::map<std::string, Pattern> patterns;
  for (const ParameterEstimate& e : estimates) {
    // An estimate that mostly repeats its prior says nothing about the data.
    if (!std::isfinite(e.estimate) || (e.shrinkage && *e.shrinkage < 0.3)) continue;
    Pattern& p = patterns[e.muscle];
    const double ratio = e.initial > 0.0 ? e.estimate / e.initial : 1.0;
    if (e.parameter == "force_length_width") {
      p.narrowest = std::min(p.narrowest, ratio);
      p.widest = std::max(p.widest, ratio);
    }
    if (e.parameter == "optimal_fiber_length") p.length_ratio = std::min(p.length_ratio.value_or(ratio), ratio);
    if (e.parameter == "concentric_curvature") p.curvature = e.estimate;
    if (e.parameter == "eccentric_curvature_product") p.product = e.estimate;
    if (e.parameter == "eccentric_plateau") p.plateau = e.estimate;
  }
  return patterns;
}

/// Returns true for an optimal length far too short with a width far too large: the far flank of
/// this curve acts as a gain below 1.
bool is_flank(const Pattern& p) { return p.widest > 1.5 && p.length_ratio && *p.length_ratio < 0.5; }

bool product_is_not_positive(const Pattern& p) { return p.product && *p.product <= 0.0; }

/// Returns true for a step of force between shortening and lengthening.
bool is_step(const Pattern& p) { return p.plateau && *p.plateau < 0.6 && p.product && std::abs(*p.product) < 0.15; }

/// Returns true for a force-velocity curve without an effect of velocity.
bool without_velocity(const Pattern& p) {
  const bool straight = p.curvature && *p.curvature > 2.0;
  const bool plateau_near_one = p.plateau && std::abs(*p.plateau - 1.0) < 0.12;
  return (product_is_not_positive(p) && plateau_near_one) || (straight && !is_flank(p));
}

/// Returns true for a narrow force-length curve with a strongly bent force-velocity curve.
bool narrow_and_bent(const Pattern& p) {
  const bool bent = p.curvature && *p.curvature < 0.12;
  return p.narrowest < 0.5 && !is_step(p) && (bent || product_is_not_positive(p) || (p.plateau && *p.plateau > 1.6));
}

}  // namespace

std::vector<Remark> signatures(const std::vector<ParameterEstimate>& estimates) {
  std::vector<Remark> found;
  for (const auto& [muscle, p] : patterns_of(estimates)) {
    const auto add = [&, &of = muscle](RemarkCode code, std::string_view says) {
      found.push_back({.code = code, .about = of, .says = fmt::format("{}: {}: {}", of, name(code), says)});
    };
    if (without_velocity(p)) {
      add(RemarkCode::emg_delay_ignored,
          "no effect of velocity is resolved (V_sh very large, or V_sh V_shl not positive with V_ml near 1), as when "
          "the force lags the EMG and no delay is allowed for");
    }
    if (is_step(p)) {
      add(RemarkCode::gain_mismatch,
          "V_ml far below 1 with V_sh V_shl near 0 is a step in gain between shortening and lengthening: EMG is there "
          "while (almost) no force is assigned (co-contraction, or F_max or the EMG gain too high)");
    } else if (is_flank(p)) {
      add(RemarkCode::gain_mismatch,
          "an optimal length far below, a width far above its start act as a gain: F_max or EMG gain is too high");
    }
    if (narrow_and_bent(p)) {
      add(RemarkCode::co_contraction_zeroed,
          "a narrow force-length curve with a strongly bent force-velocity curve appears where an optimizer sets the "
          "antagonist to zero");
    }
  }
  return found;
}

}  // namespace myoid::fit
