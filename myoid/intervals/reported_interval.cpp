#include "myoid/intervals/reported_interval.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "myoid/math/statistics.h"

namespace myoid::identification {
namespace {

/// One unknown of a fit and the scale of its row.
struct RowOfFit {
  const RowScale& row;
  const Intervals& intervals;
  Eigen::Index at = 0;
  double z = 0.0;

  /// Returns the row's value of a solver's number, clamped to the bounds: these are knowledge, too,
  /// and no interval reaches beyond.
  [[nodiscard]] double clipped(double x) const {
    return row.value(std::clamp(x, row.parameter->bounds.lower, row.parameter->bounds.upper));
  }
};

double quantile() { return math::normal_quantile(0.5 + 0.5 * kReportedProbability); }

/// Returns the half width of the interval of a normal number with this variance.
double reach(double variance) { return quantile() * std::sqrt(std::max(0.0, variance)); }

std::vector<RouteInterval> routes_of(const RowOfFit& of) {
  const Sandwich& s = of.intervals.sandwich;
  std::vector<RouteInterval> routes;
  const auto add_normal = [&](const std::string& route, double variance, double spread) {
    const double sd = std::sqrt(std::max(0.0, variance));
    if (!std::isfinite(sd)) return;
    routes.push_back({route, of.clipped(of.z - quantile() * sd), of.clipped(of.z + quantile() * sd), spread});
  };
  const double by_trials = s.trial_spread.size() > of.at ? s.trial_spread[of.at] : 0.0;
  add_normal("sandwich", s.newey_west(of.at, of.at), s.sample_spread);
  if (s.cluster) add_normal("cluster", (*s.cluster)(of.at, of.at), by_trials);
  if (s.jackknife) add_normal("jackknife", (*s.jackknife)(of.at, of.at), by_trials);
  const auto add = [&](const std::string& route, const Interval& interval, double spread) {
    RouteInterval r{route, {}, {}, spread};
    if (interval.low) r.low = of.clipped(*interval.low);
    if (interval.high) r.high = of.clipped(*interval.high);
    if (r.low || r.high || route == "profile") routes.push_back(std::move(r));
  };
  const auto index = static_cast<std::size_t>(of.at);
  if (const auto& bootstrap = of.intervals.bootstrap) add("bootstrap", bootstrap->intervals[index], bootstrap->spread);
  if (of.intervals.profiles) add("profile", (*of.intervals.profiles)[index], 0.0);
  return routes;
}

/// Returns the noise's reach below and above the estimate: the wider of sandwich and profile.
std::pair<double, double> reaches_of_noise(const RowOfFit& of) {
  const double normal = reach(of.intervals.sandwich.newey_west(of.at, of.at));
  if (!of.intervals.profiles) return {normal, normal};
  const Interval& profile = (*of.intervals.profiles)[static_cast<std::size_t>(of.at)];
  const Unknown& p = *of.row.parameter;
  return {std::max(normal, of.z - profile.low.value_or(p.bounds.lower)),
          std::max(normal, profile.high.value_or(p.bounds.upper) - of.z)};
}

/// Returns the least reach by the differences between trials; 0 with few trials. With too few
/// trials for clusters the jackknife replaces them; it is never too small.
double reach_of_trials(const Sandwich& sandwich, Eigen::Index at) {
  if (sandwich.cluster) return reach((*sandwich.cluster)(at, at));
  return sandwich.jackknife ? reach((*sandwich.jackknife)(at, at)) : 0.0;
}

/// Adds the errors of EMG noise, held tendons and the model to the reach `noise`.
double whole_reach(const RowOfFit& of, double noise) {
  const Intervals& intervals = of.intervals;
  const double sd = noise / quantile();
  const double of_tendons = intervals.tendon_shift.cols() > 0 ? intervals.tendon_shift.row(of.at).squaredNorm() : 0.0;
  const double variance = sd * sd + std::pow(intervals.sandwich.by_noise[of.at], 2) + of_tendons;
  const double whole = intervals.model_error ? intervals.model_error->reach(of.at, variance, kReportedProbability)
                                             : quantile() * std::sqrt(variance);
  return std::max(reach_of_trials(intervals.sandwich, of.at), whole);
}

}  // namespace

double z_of(const RowScale& row, double value) {
  const double x = value / row.ratio;
  return row.parameter->field->logarithmic ? std::log(std::max(x, 1e-300)) : x;
}

void add_routes(ParameterEstimate& e, const RowScale& row, const Intervals& intervals, Eigen::Index at, double z) {
  const RowOfFit of{.row = row, .intervals = intervals, .at = at, .z = z};
  e.routes = routes_of(of);
  const auto [below, above] = reaches_of_noise(of);
  if (!std::isfinite(below) || !std::isfinite(above)) return;
  e.ci_low = of.clipped(z - whole_reach(of, below));
  e.ci_high = of.clipped(z + whole_reach(of, above));
}

}  // namespace myoid::identification
