#include "myoid/fit/intervals/estimate_rows.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "myoid/fit/intervals/verdict_rules.h"
#include "myoid/fit/measurement/muscle_activation.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::fit {
namespace {

/// Lengths [m], each with its duration [s].
using LengthsInTime = std::vector<std::pair<double, double>>;

/// Returns the range of lengths without this much time at either end.
double span_but_for(double time_s, LengthsInTime lengths) {
  if (lengths.empty()) return 0.0;
  std::sort(lengths.begin(), lengths.end());
  const auto end_of = [&](auto from, auto to) {
    double passed_s = 0.0;
    auto at = from;
    while (std::next(at) != to && passed_s + at->second < time_s) passed_s += (at++)->second;
    return at->first;
  };
  return std::max(0.0, end_of(lengths.rbegin(), lengths.rend()) - end_of(lengths.begin(), lengths.end()));
}

}  // namespace

ParameterEstimate row_of(const Unknown& p, const Unknown::Target& target, const ParameterMap& map, double z) {
  const auto value = [&](double of) { return target.ratio * p.to_value(of); };
  ParameterEstimate e;
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
  e.muscle = muscle.name;
  e.parameter = "eccentric_curvature_product";
  e.initial = muscle.start.eccentric_curvature_product;
  return e;
}

double equivalent_deviations(double sum_of_squares, int count) {
  if (count < 1 || !(sum_of_squares > 0.0)) return 0.0;
  if (count == 1) return std::sqrt(sum_of_squares);
  const double beyond = math::chi_squared_tail(sum_of_squares, count);
  // The tail underflows: one deviation of the same square is close enough.
  return beyond > 0.0 ? -math::normal_quantile(0.5 * beyond) : std::sqrt(sum_of_squares);
}

std::vector<double> active_length_spans_m(const StudyData& data, double delay_s) {
  std::vector<LengthsInTime> lengths(data.muscles.size());
  for (const TrialData& trial : data.trials) {
    const Eigen::Index n = trial.time_s.size();
    if (!trial.calibration || n < 2) continue;
    const Eigen::MatrixXd activation = muscle_activation(data, trial, delay_s);
    const double step_s = (trial.time_s[n - 1] - trial.time_s[0]) / static_cast<double>(n - 1);
    for (const Eigen::Index i : included_rows(trial)) {
      for (std::size_t k = 0; k < lengths.size(); ++k) {
        const auto column = static_cast<Eigen::Index>(k);
        if (activation(i, column) > kVerdictRules.active) lengths[k].emplace_back(trial.length_m(i, column), step_s);
      }
    }
  }
  std::vector<double> spans;
  for (LengthsInTime& of_muscle : lengths) spans.push_back(span_but_for(kVerdictRules.least_s, std::move(of_muscle)));
  return spans;
}

double distance_from_prior(const Unknown& parameter, double z) {
  return std::abs(z - parameter.prior.mean) / parameter.prior.sd;
}

std::vector<PriorDistance> prior_distances(const std::vector<Unknown>& free,
                                           const Eigen::VectorXd& z,
                                           const StudyData& data) {
  std::vector<PriorDistance> result;
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    PriorDistance of{.muscle = data.muscles[k].name};
    double squares = 0.0;
    int count = 0;
    for (std::size_t j = 0; j < free.size(); ++j) {
      const Unknown& p = free[j];
      // A number that is tied between muscles belongs to no single muscle.
      if (p.field->scope != Scope::muscle || p.targets.size() != 1 || !(p.prior.sd > 0.0) ||
          p.targets.front().owner != static_cast<int>(k))
        continue;
      const double d = distance_from_prior(p, z[static_cast<Eigen::Index>(j)]);
      squares += d * d;
      ++count;
      if (d <= of.farthest_distance) continue;
      of.farthest_distance = d;
      of.farthest = p.field->name;
    }
    of.distance = equivalent_deviations(squares, count);
    if (count > 0) result.push_back(std::move(of));
  }
  return result;
}

void add_distances_to(std::vector<Remark>& warnings, const std::vector<PriorDistance>& distances) {
  for (const PriorDistance& d : distances) {
    if (std::max(d.distance, d.farthest_distance) <= kVerdictRules.prior_conflict) continue;
    std::string says = fmt::format(
        "{} has left what is known beforehand: its numbers together lie {:.1f} standard deviations of their priors "
        "away, {} {:.1f}: use none of them before the cause is known (electrode, sign, unit, mass, geometry)",
        d.muscle, d.distance, d.farthest, d.farthest_distance);
    warnings.push_back({.code = RemarkCode::far_from_prior, .about = d.muscle, .says = std::move(says)});
  }
}

}  // namespace myoid::fit
