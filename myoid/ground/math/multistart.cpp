#include "myoid/ground/math/multistart.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground::math {
namespace {

void validate(const MultistartOptions& options) {
  const Eigen::Index p = options.lower.size();
  if (p == 0 || options.upper.size() != p) {
    throw InvalidInput(
        fmt::format("multistart: the box has {} lower and {} upper ends", options.lower.size(), options.upper.size()));
  }
  if (options.starts.empty()) throw InvalidInput("multistart: there is no start");
  if (!(options.x_tolerance >= 0.0)) throw InvalidInput("multistart: the tolerance must not be negative");
  for (Eigen::Index j = 0; j < p; ++j) {
    const double low = options.lower[j], high = options.upper[j];
    if (!std::isfinite(low) || !std::isfinite(high) || low > high) {
      throw InvalidInput(fmt::format("multistart: parameter {} has the box [{}, {}]; finite ends that rise are needed",
                                     j + 1, low, high));
    }
  }
  for (const Eigen::VectorXd& start : options.starts) {
    if (start.size() != p) {
      throw InvalidInput(fmt::format("multistart: a start has {} parameters, the box {}", start.size(), p));
    }
  }
}

/// Returns true if two ends differ by no more than the tolerance, a share of the box's width.
bool same(const MultistartOptions& options, const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  for (Eigen::Index j = 0; j < a.size(); ++j) {
    const double low = options.lower[j], high = options.upper[j], width = low == high ? 1.0 : high - low;
    if (!(std::abs((a[j] - low) / width - (b[j] - low) / width) <= options.x_tolerance)) return false;
  }
  return true;
}

/// Gathers the minima into basins, lowest first, so that the best member names the basin; ties go by index.
void gather(const MultistartOptions& options, MultistartResult& result) {
  std::vector<Eigen::Index> order(result.minima.size());
  std::iota(order.begin(), order.end(), 0);
  const auto minimum = [&](Eigen::Index i) -> const LocalMinimum& {
    return result.minima[static_cast<std::size_t>(i)];
  };
  std::erase_if(order, [&](Eigen::Index i) {
    const bool failed = !std::isfinite(minimum(i).cost) || !minimum(i).x.allFinite();
    if (failed) result.failed.push_back(i);
    return failed;
  });
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return minimum(a).cost < minimum(b).cost; });
  for (const Eigen::Index i : order) {
    auto basin = std::find_if(result.basins.begin(), result.basins.end(),
                              [&](const Basin& known) { return same(options, known.x, minimum(i).x); });
    if (basin == result.basins.end()) {
      result.basins.push_back({.x = minimum(i).x, .cost = minimum(i).cost, .members = {}});
      basin = std::prev(result.basins.end());
    }
    basin->members.push_back(i);
    if (minimum(i).termination == Termination::converged) ++basin->converged;
  }
  for (Basin& basin : result.basins) std::sort(basin.members.begin(), basin.members.end());
}

}  // namespace

MultistartResult multistart(const LocalSearch& search, const MultistartOptions& options) {
  validate(options);
  MultistartResult result;
  result.minima.resize(options.starts.size());
  std::atomic<std::size_t> done{0};
  oneapi::tbb::parallel_for(std::size_t{0}, options.starts.size(), [&](std::size_t i) {
    options.progress.check();
    result.minima[i] = search(options.starts[i]);
    const double share = static_cast<double>(++done) / static_cast<double>(options.starts.size());
    options.progress.tell(share, "searching from many starts");
  });
  gather(options, result);
  return result;
}

}  // namespace myoid::inline ground::math
