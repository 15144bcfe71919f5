#include "myoid/methods/basins.h"

#include <string>

#include "myoid/methods/paper_case.h"

namespace myoid::identification {
namespace {

constexpr double kRival = 2.0;  // a chi-square of 4, of which the cost is half

}  // namespace

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
  table.fit = data.muscles[muscle].name + (shortening ? " shortening" : " lengthening");
  return table;
}

}  // namespace myoid::identification
