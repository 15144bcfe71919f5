#include "myoid/intervals/reported_interval.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "myoid/math/statistics.h"

namespace myoid::identification {
double z_of(const RowScale& row, double value) {
  const double x = value / row.ratio;
  return row.parameter->field->logarithmic ? std::log(std::max(x, 1e-300)) : x;
}

void add_routes(ParameterEstimate& e,
                const RowScale& row,
                const Intervals& intervals,
                Eigen::Index at,
                double z) {
  const double quantile = math::normal_quantile(0.5 + 0.5 * kReportedProbability);
  const FreeParameter& p = *row.parameter;
  const auto clipped = [&](double x) { return row.value(std::clamp(x, p.lower, p.upper)); };
  const auto normal = [&](const std::string& route, double variance, double spread) {
    const double sd = std::sqrt(std::max(0.0, variance));
    if (!std::isfinite(sd)) return;
    // A bound is knowledge, too: no interval reaches where no muscle lives.
    e.routes.push_back({route, clipped(z - quantile * sd), clipped(z + quantile * sd), spread});
  };
  const Sandwich& s = intervals.sandwich;
  const double by_trials = s.trial_spread.size() > at ? s.trial_spread[at] : 0.0;
  normal("sandwich", s.newey_west(at, at), s.sample_spread);
  if (s.cluster) normal("cluster", (*s.cluster)(at, at), by_trials);
  if (s.jackknife) normal("jackknife", (*s.jackknife)(at, at), by_trials);
  const auto add = [&](const std::string& route, const Interval& interval, double spread) {
    RouteInterval r{route, {}, {}, spread};
    if (interval.low) r.low = clipped(*interval.low);
    if (interval.high) r.high = clipped(*interval.high);
    if (r.low || r.high || route == "profile") e.routes.push_back(r);
  };
  const auto index = static_cast<std::size_t>(at);
  if (intervals.bootstrap) {
    add("bootstrap", intervals.bootstrap->intervals[index], intervals.bootstrap->spread);
  }
  if (intervals.profiles) add("profile", (*intervals.profiles)[index], 0.0);

  // The interval that is reported: to either side the farther of sandwich and profile, with the
  // model's error on top, but never less than trials show that differ by both. Of few trials that
  // is the jackknife, which is never too small.
  const auto reach = [&](double variance) { return quantile * std::sqrt(std::max(0.0, variance)); };
  double below = reach(intervals.sandwich.newey_west(at, at));
  double above = below;
  if (intervals.profiles) {
    const Interval& profile = (*intervals.profiles)[index];
    below = std::max(below, z - profile.low.value_or(p.lower));
    above = std::max(above, profile.high.value_or(p.upper) - z);
  }
  double least = 0.0;
  if (intervals.sandwich.cluster) {
    least = reach((*intervals.sandwich.cluster)(at, at));
  } else if (intervals.sandwich.jackknife) {
    least = reach((*intervals.sandwich.jackknife)(at, at));
  }
  if (!std::isfinite(below) || !std::isfinite(above)) return;
  const auto whole = [&](double half) {
    const double noise = half / quantile;
    const double of_tendons =
        intervals.tendon_shift.cols() > 0 ? intervals.tendon_shift.row(at).squaredNorm() : 0.0;
    const double variance =
        noise * noise + std::pow(intervals.sandwich.by_noise[at], 2) + of_tendons;
    return std::max(least, intervals.model_error
                               ? intervals.model_error->reach(at, variance, kReportedProbability)
                               : quantile * std::sqrt(variance));
  };
  e.ci_low = clipped(z - whole(below));
  e.ci_high = clipped(z + whole(above));
}

}  // namespace myoid::identification
