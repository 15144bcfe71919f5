#include "myoid/identification/basins.h"

namespace myoid::identification {

BasinTable find_basins(const math::LocalSearch& search,
                       const StartBox& box,
                       int starts,
                       Eigen::Index plain_samples,
                       const Progress& progress) {
  BasinTable table;
  math::MultistartOptions options;
  options.starts = 0;
  options.given = starts_in(box, starts);
  options.lower = box.lower;
  options.upper = box.upper;
  options.x_tolerance = 1e-2;  // of the box, which is four spreads wide
  options.progress = progress;
  const math::MultistartResult found = math::multistart(search, options);
  table.starts = static_cast<int>(found.starts.size());
  table.failed = static_cast<int>(found.failed.size());
  constexpr double kRival = 2.0;  // a chi-square of 4, of which the cost is half
  for (const math::Basin& basin : found.basins) {
    const double best = found.basins.front().cost;
    const double variance =
        plain_samples > 0 ? 2.0 * best / static_cast<double>(plain_samples) : 1.0;
    table.basins.push_back({.x = basin.x,
                            .cost = basin.cost,
                            .starts = static_cast<int>(basin.members.size()),
                            .converged = static_cast<int>(basin.converged),
                            .distance = distance(basin.x, found.basins.front().x, box),
                            .rival = basin.cost - best <= kRival * variance});
  }
  return table;
}

}  // namespace myoid::identification
