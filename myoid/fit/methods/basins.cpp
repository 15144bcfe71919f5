#include "myoid/fit/methods/basins.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "myoid/ground/math/sobol.h"

namespace myoid::fit {
namespace {

constexpr double kRival = 2.0;  // a chi-square of 4, of which the cost is half
constexpr double kSpreads = 2.0;

}  // namespace

StartBox start_box(const PaperCase& samples, const MuscleSetup& setup) {
  const Eigen::VectorXd given = samples.start_vector();
  StartBox box{given, given, given, given};
  for (Eigen::Index j = 0; j < given.size(); ++j) {
    const muscle::HillField& field = *samples.unknowns[static_cast<std::size_t>(j)];
    const double size = std::abs(given[j]);
    const auto prior = setup.priors.find(std::string(field.name));
    box.spread[j] = prior == setup.priors.end() ? 0.1 * size
                    : prior->second.logarithmic ? prior->second.sd * size
                                                : prior->second.sd;
    const double x = given[j], reach = kSpreads * box.spread[j];
    box.lower[j] = std::max(std::min(field.bounds.lower, x), x - reach);
    box.upper[j] = std::min(std::max(field.bounds.upper, x), x + reach);
  }
  return box;
}

std::vector<Eigen::VectorXd> starts_in(const StartBox& box, int count) {
  std::vector<Eigen::VectorXd> starts{box.given};
  if (count < 2 || box.given.size() == 0) return starts;
  Eigen::MatrixXd points(count - 1, box.given.size());
  // Points 0 and 1 of the sequence are a corner and the center. Parameters beyond its dimensions
  // use the sequence again, each further set with another scramble.
  for (Eigen::Index at = 0, set = 0; at < points.cols(); at += math::kSobolMaxDimensions, ++set) {
    const Eigen::Index width = std::min<Eigen::Index>(math::kSobolMaxDimensions, points.cols() - at);
    math::SobolOptions options{.first = 2, .scramble_seed = {}};
    if (set > 0) options.scramble_seed = static_cast<std::uint64_t>(set);
    points.middleCols(at, width) = math::sobol_points(count - 1, static_cast<int>(width), options);
  }
  for (Eigen::Index s = 0; s < points.rows(); ++s) {
    starts.emplace_back(box.lower + points.row(s).transpose().cwiseProduct(box.upper - box.lower));
  }
  return starts;
}

double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const StartBox& box) {
  return std::sqrt((a - b).cwiseQuotient(box.spread).squaredNorm() / static_cast<double>(a.size()));
}

BasinTable find_basins(
    const math::LocalSearch& search, const StartBox& box, int starts, Eigen::Index samples, const Progress& progress) {
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
    const double variance = 2.0 * best / static_cast<double>(samples);
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
  table.fit = samples.name();
  return table;
}

}  // namespace myoid::fit
