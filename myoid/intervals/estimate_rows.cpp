#include "myoid/intervals/estimate_rows.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "myoid/intervals/estimate_remarks.h"

namespace myoid::identification {

ParameterEstimate row_of(const Unknown& p, const Unknown::Target& target, const ParameterMap& map, double z) {
  const auto value = [&](double of) { return target.ratio * p.to_value(of); };
  ParameterEstimate e;
  e.method = "torque";
  e.fit_case = "both";
  e.muscle = map.owner_name(p, target.owner);
  if (&target != &p.targets.front()) e.tied_to = map.owner_name(p, p.targets.front().owner);
  e.parameter = std::string(p.field->name);
  e.unit = p.field->unit;
  e.initial = value(p.start);
  e.estimate = value(z);
  if (p.prior.sd > 0.0) {
    e.prior_mean = value(p.prior.mean);
    e.prior_sd = p.field->logarithmic ? *e.prior_mean * p.prior.sd : std::abs(target.ratio) * p.prior.sd;
    e.prior_distance = distance_from_prior(p, z);
  }
  return e;
}

ParameterEstimate product_row_of(const MuscleSetup& muscle) {
  ParameterEstimate e;
  e.method = "torque";
  e.fit_case = "both";
  e.muscle = muscle.name;
  e.parameter = "eccentric_curvature_product";
  e.initial = muscle.start.eccentric_curvature_product;
  return e;
}

void agree_on_tied(std::vector<ParameterEstimate>& estimates, std::size_t count) {
  if (count < 2 || estimates.size() < count || estimates.back().tied_to.empty()) return;
  const auto first = estimates.end() - static_cast<std::ptrdiff_t>(count);
  const auto worst = std::max_element(
      first, estimates.end(), [](const auto& a, const auto& b) { return severity(a.verdict) < severity(b.verdict); });
  const Verdict verdict = worst->verdict;
  const std::string reason = worst->reason;
  for (auto e = first; e != estimates.end(); ++e) {
    e->verdict = verdict;
    e->reason = reason;
  }
}

}  // namespace myoid::identification
