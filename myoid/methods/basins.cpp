#include "myoid/methods/basins.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/methods/paper_case.h"

namespace myoid::identification {
namespace {

constexpr double kRival = 2.0;  // a chi-square of 4, of which the cost is half

}  // namespace

BasinTable find_basins(const math::LocalSearch& search,
                       const StartBox& box,
                       int starts,
                       Eigen::Index plain_samples,
                       const Progress& progress) {
  BasinTable table;
  math::MultistartOptions options;
  options.starts = starts_in(box, starts);
  options.lower = box.lower;
  options.upper = box.upper;
  options.x_tolerance = 1e-2;  // of the box, which is four spreads wide
  options.progress = progress;
  const math::MultistartResult found = math::multistart(search, options);
  table.starts = static_cast<int>(found.minima.size());
  table.failed = static_cast<int>(found.failed.size());
  for (const math::Basin& basin : found.basins) {
    if (basin.converged == 0 && &basin != found.basins.data()) {
      table.failed += static_cast<int>(basin.members.size());
      continue;
    }
    const double best = found.basins.front().cost;
    const double variance = plain_samples > 0 ? 2.0 * best / static_cast<double>(plain_samples) : 1.0;
    table.basins.push_back({.x = basin.x,
                            .cost = basin.cost,
                            .starts = static_cast<int>(basin.members.size()),
                            .converged = static_cast<int>(basin.converged),
                            .distance = distance(basin.x, found.basins.front().x, box),
                            .rival = basin.cost - best <= kRival * variance,
                            .given = basin.members.front() == 0});
  }
  return table;
}

BasinTable find_basins(const Estimator& estimator, const Weighting& weighting, int starts) {
  BasinTable table = find_basins(
      [&](const Eigen::VectorXd& start) {
        const NormalSearchResult end = estimator.search(start, weighting, 1e-9, 1e-12);
        return math::LocalMinimum{end.termination, end.x, end.cost, end.evaluations};
      },
      start_box(estimator), starts, estimator.options().weights ? 0 : estimator.model().sample_count(),
      {{}, estimator.options().progress.stop});
  table.fit = "all muscles";
  return table;
}

namespace {

/// Returns the estimate of an unknown for its first owner; null: none.
ParameterEstimate* estimate_of(const Unknown& p, IdentificationResult& result) {
  for (ParameterEstimate& e : result.estimates) {
    if (e.tied_to.empty() && e.parameter == p.field->name &&
        (p.owner == e.muscle || p.owner.starts_with(e.muscle + "+")))
      return &e;
  }
  return nullptr;
}

}  // namespace

void report_other_minima(const BasinTable& table,
                         const std::vector<Unknown>& free,
                         double cost,
                         IdentificationResult& result) {
  constexpr double kLower = 0.05;
  constexpr std::size_t kNamed = 3;
  std::vector<std::string> outside;
  int starts = 0;
  double least = cost;
  for (const BasinRow& basin : table.basins) {
    if (basin.converged == 0 || !(basin.cost <= cost + kRival)) continue;
    bool beyond = false;
    for (std::size_t j = 0; j < free.size(); ++j) {
      ParameterEstimate* e = estimate_of(free[j], result);
      if (e == nullptr || is_nuisance(*e) || !e->ci_low || !e->ci_high) continue;
      const double value = free[j].to_value(basin.x[static_cast<Eigen::Index>(j)]);
      if (value >= *e->ci_low && value <= *e->ci_high) continue;
      beyond = true;
      outside.push_back(fmt::format("{} {} {:.4g} instead of {:.4g} [{:.4g}, {:.4g}]", e->muscle, e->parameter, value,
                                    e->estimate, *e->ci_low, *e->ci_high));
      if (e->verdict != Verdict::identified) continue;
      e->verdict = Verdict::weak;
      e->reason += fmt::format("; but another minimum, as good, has {:.4g}", value);
    }
    if (!beyond) continue;
    starts += basin.starts;
    least = std::min(least, basin.cost);
  }
  if (outside.empty()) return;
  const std::size_t named = std::min(kNamed, outside.size());
  result.warnings.push_back(
      fmt::format("{} of {} other starts of the search end at a minimum that is {}, with numbers outside of their "
                  "intervals ({}{}): an interval describes one minimum only, and which of them is the person's this "
                  "recording does not tell; more kinds of movement tell them apart",
                  starts, table.starts,
                  least < cost - kLower ? fmt::format("lower (chi-square less by {:.1f})", 2.0 * (cost - least))
                                        : std::string("as good"),
                  fmt::join(outside.begin(), outside.begin() + static_cast<std::ptrdiff_t>(named), "; "),
                  outside.size() > named ? fmt::format("; and {} more", outside.size() - named) : ""));
}

void look_around(const StudyData& data, EstimatorOptions options, IdentificationResult& result) {
  constexpr int kUsualStarts = 24;
  if (!options.weights || options.estimator == EstimatorKind::posterior || result.exact ||
      result.termination != math::Termination::converged)
    return;
  options.lag = result.lag;
  options.progress.report = nullptr;
  const Estimator estimator(data, options);
  if (result.solution.size() != estimator.model().parameters().size()) return;
  const Estimator::Solution here = estimator.solve(result.solution);
  report_other_minima(
      result.basins.empty() ? find_basins(estimator, here.weighting, kUsualStarts) : result.basins.front(),
      estimator.free(), here.search.cost, result);
}

BasinTable find_paper_basins(const StudyData& data, std::size_t muscle, bool shortening, int starts) {
  const PaperCase samples = paper_case(data, muscle, shortening);
  const StartBox box = start_box(samples, data.muscles[muscle]);
  BasinTable table;
  if (box.given.size() > 0 && samples.obstacle().empty()) {
    const auto search = [&](const Eigen::VectorXd& start) {
      const math::LeastSquaresResult end = search_for_minimum(samples, start).found;
      return math::LocalMinimum{end.termination, end.x, end.cost, end.evaluations};
    };
    table = find_basins(search, box, starts, static_cast<Eigen::Index>(samples.samples.size()));
  }
  table.fit = data.muscles[muscle].name + (shortening ? " shortening" : " lengthening");
  return table;
}

}  // namespace myoid::identification
