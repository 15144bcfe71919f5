#include "myoid/fit/methods/basins.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <string>

#include "myoid/ground/core/parallel.h"
#include "myoid/ground/math/sobol.h"

namespace myoid::fit {
namespace {

constexpr double kRival = 2.0;  // a chi-square of 4, of which the cost is half
constexpr double kSpreads = 2.0;
constexpr double kOneBasin = 1e-2;  // of the box, which is four spreads wide

/// Returns true if two ends differ by no more than kOneBasin of the box's width in any unknown.
bool is_one_basin(const StartBox& box, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  for (Eigen::Index j = 0; j < a.size(); ++j) {
    const double low = box.lower[j], high = box.upper[j], width = low == high ? 1.0 : high - low;
    if (!(std::abs((a[j] - low) / width - (b[j] - low) / width) <= kOneBasin)) return false;
  }
  return true;
}

/// Returns the indices of the finite ends.
std::vector<std::size_t> by_rising_cost(const std::vector<LocalMinimum>& ends) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (std::isfinite(ends[i].cost) && ends[i].x.allFinite()) order.push_back(i);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return ends[i].cost; });
  return order;
}

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
  // Points 0 and 1 of the sequence are a corner and the center.
  const Eigen::MatrixXd points =
      math::sobol_points(count - 1, static_cast<int>(box.given.size()), {.first = 2, .scramble_seed = {}});
  for (Eigen::Index s = 0; s < points.rows(); ++s)
    starts.emplace_back(box.lower + points.row(s).transpose().cwiseProduct(box.upper - box.lower));
  return starts;
}

double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const StartBox& box) {
  return std::sqrt((a - b).cwiseQuotient(box.spread).squaredNorm() / static_cast<double>(a.size()));
}

BasinTable find_basins(
    const LocalSearch& search, const StartBox& box, int starts, Eigen::Index samples, const Progress& progress) {
  const std::vector<Eigen::VectorXd> from = starts_in(box, starts);
  std::vector<LocalMinimum> ends(from.size());
  std::atomic<std::size_t> done{0};
  parallel_each(from.size(), [&](std::size_t i) {
    progress.check();
    ends[i] = search(from[i]);
    progress.tell(static_cast<double>(++done) / static_cast<double>(from.size()), "searching from many starts");
  });
  BasinTable table{.fit = {}, .starts = static_cast<int>(ends.size())};
  // The lowest end names its basin; ties go by index.
  for (const std::size_t i : by_rising_cost(ends)) {
    const LocalMinimum& end = ends[i];
    auto basin = std::ranges::find_if(table.basins, [&](const BasinRow& b) { return is_one_basin(box, b.x, end.x); });
    if (basin == table.basins.end()) {
      const double best = table.basins.empty() ? end.cost : table.basins.front().cost;
      const double variance = 2.0 * best / static_cast<double>(samples);
      const Eigen::VectorXd& best_x = table.basins.empty() ? end.x : table.basins.front().x;
      table.basins.push_back({.x = end.x,
                              .cost = end.cost,
                              .distance = distance(end.x, best_x, box),
                              .rival = end.cost - best <= kRival * variance});
      basin = std::prev(table.basins.end());
    }
    ++basin->starts;
    if (end.termination == math::Termination::converged) ++basin->converged;
    basin->given = basin->given || i == 0;
  }
  if (table.basins.size() > 1)
    table.basins.erase(std::remove_if(std::next(table.basins.begin()), table.basins.end(),
                                      [](const BasinRow& basin) { return basin.converged == 0; }),
                       table.basins.end());
  table.failed = table.starts;
  for (const BasinRow& basin : table.basins) table.failed -= basin.starts;
  return table;
}

BasinTable find_paper_basins(const StudyData& data, std::size_t muscle, bool shortening, int starts) {
  const PaperCase samples = paper_case(data, muscle, shortening);
  const StartBox box = start_box(samples, data.muscles[muscle]);
  BasinTable table;
  if (box.given.size() > 0 && samples.obstacle().empty()) {
    const auto search = [&](const Eigen::VectorXd& start) {
      const math::LeastSquaresResult end = search_for_minimum(samples, start).found;
      return LocalMinimum{end.termination, end.x, end.cost, end.evaluations};
    };
    table = find_basins(search, box, starts, static_cast<Eigen::Index>(samples.samples.size()));
  }
  table.fit = samples.name();
  return table;
}

}  // namespace myoid::fit
