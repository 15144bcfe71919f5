#include "myoid/identification/estimate_remarks.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/identification/identifiability.h"

namespace myoid::identification {
namespace {

/// Widths of two intervals that differ by more than this speak of different things.
constexpr double kDisagreement = 1.5;

}  // namespace

void RouteRemarks::compare(ParameterEstimate& e) {
  double least = 0.0, most = 0.0;
  std::string narrow, wide;
  for (const RouteInterval& r : e.routes) {
    if (!r.low || !r.high) {
      open_.push_back(e.muscle + " " + e.parameter);
      continue;
    }
    const double width = *r.high - *r.low;
    if (narrow.empty() || width < least) {
      least = width;
      narrow = r.route;
    }
    if (wide.empty() || width > most) {
      most = width;
      wide = r.route;
    }
  }
  e.routes_disagree = !narrow.empty() && most > kDisagreement * least;
  if (!e.routes_disagree) return;
  ++disagree_;
  const double ratio = most / std::max(least, 1e-300);
  if (ratio <= worst_) return;
  worst_ = ratio;
  worst_text_ =
      fmt::format("{} {}, where {} gives {} times the width of {}", e.muscle, e.parameter, wide,
                  ratio < 100.0 ? fmt::format("{:.1f}", ratio) : "over 100", narrow);
}

void RouteRemarks::add_to(std::vector<std::string>& warnings, std::size_t count) const {
  if (disagree_ > 0) {
    warnings.push_back(
        fmt::format("the routes to the interval disagree by more than {} times for {} of {} "
                    "numbers, most for {}: trust the wider one (routes_disagree in "
                    "parameters.csv)",
                    kDisagreement, disagree_, count, worst_text_));
  }
  if (open_.empty()) return;
  constexpr std::size_t kNamed = 4;
  const std::size_t named = std::min(kNamed, open_.size());
  warnings.push_back(fmt::format(
      "the profile is open for {} of {} numbers ({}{}): there the data bound them on one side at "
      "most",
      open_.size(), count,
      fmt::join(open_.begin(), open_.begin() + static_cast<std::ptrdiff_t>(named), ", "),
      open_.size() > named ? ", ..." : ""));
}

double distance_from_prior(const FreeParameter& parameter, double z) {
  return std::abs(z - parameter.prior_mean) / parameter.prior_sd;
}

std::vector<PriorDistance> prior_distances(const std::vector<FreeParameter>& free,
                                           const Eigen::VectorXd& z,
                                           const StudyData& data) {
  std::vector<PriorDistance> result;
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    PriorDistance of{.muscle = data.muscles[k].name};
    double squares = 0.0;
    int count = 0;
    for (std::size_t j = 0; j < free.size(); ++j) {
      const FreeParameter& p = free[j];
      // What is tied between muscles is none of them's.
      if (p.field->scope != Scope::muscle || p.targets.size() != 1 || !(p.prior_sd > 0.0) ||
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

void add_distances_to(std::vector<std::string>& warnings,
                      const std::vector<PriorDistance>& distances) {
  for (const PriorDistance& d : distances) {
    if (std::max(d.distance, d.farthest_distance) <= VerdictRules{}.prior_conflict) continue;
    warnings.push_back(fmt::format(
        "{} has left what is known beforehand: its numbers together lie {:.1f} standard deviations "
        "away, {} {:.1f}: use none of them before the cause is known (electrode, sign, unit, mass, "
        "geometry)",
        d.muscle, d.distance, d.farthest, d.farthest_distance));
  }
}

void agree_on_tied(std::vector<ParameterEstimate>& estimates, std::size_t count) {
  if (count < 2 || estimates.size() < count || estimates.back().tied_to.empty()) return;
  const auto first = estimates.end() - static_cast<std::ptrdiff_t>(count);
  const auto worst = std::max_element(first, estimates.end(), [](const auto& a, const auto& b) {
    return severity(a.verdict) < severity(b.verdict);
  });
  const Verdict verdict = worst->verdict;
  const std::string reason = worst->reason;
  for (auto e = first; e != estimates.end(); ++e) {
    e->verdict = verdict;
    e->reason = reason;
  }
}

}  // namespace myoid::identification
