#include "myoid/math/multistart.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "myoid/core/error.h"
#include "myoid/math/sobol.h"

namespace myoid::math {
namespace {

void validate(const MultistartOptions& options) {
  const Eigen::Index p = options.lower.size();
  if (p == 0 || options.upper.size() != p) {
    throw InvalidInput(
        fmt::format("multistart: the box has {} lower and {} upper ends", options.lower.size(), options.upper.size()));
  }
  if (!options.logarithmic.empty() && static_cast<Eigen::Index>(options.logarithmic.size()) != p) {
    throw InvalidInput(
        fmt::format("multistart: {} logarithmic flags for {} parameters", options.logarithmic.size(), p));
  }
  if (options.starts < 0 || options.starts + static_cast<Eigen::Index>(options.given.size()) < 1)
    throw InvalidInput(fmt::format("multistart: {} starts; at least 1 is needed", options.starts));
  if (!(options.x_tolerance >= 0.0) || !(options.rival_cost >= 0.0))
    throw InvalidInput("multistart: the tolerances must not be negative");
  for (Eigen::Index j = 0; j < p; ++j) {
    const double low = options.lower[j], high = options.upper[j];
    const bool logarithmic = !options.logarithmic.empty() && options.logarithmic[static_cast<std::size_t>(j)];
    if (!std::isfinite(low) || !std::isfinite(high) || low > high || (logarithmic && low <= 0.0)) {
      throw InvalidInput(
          fmt::format("multistart: parameter {} has the box [{}, {}]; finite ends that rise{} are needed", j + 1, low,
                      high, logarithmic ? ", both positive (it is logarithmic)," : ""));
    }
  }
  for (const Eigen::VectorXd& start : options.given) {
    if (start.size() != p) {
      throw InvalidInput(fmt::format("multistart: a given start has {} parameters, the box {}", start.size(), p));
    }
  }
}

/// Maps parameters to shares of the box's width and back, logarithmic sides in their logarithm.
struct Box {
  const MultistartOptions& options;

  [[nodiscard]] bool logarithmic(Eigen::Index j) const {
    return !options.logarithmic.empty() && options.logarithmic[static_cast<std::size_t>(j)];
  }
  [[nodiscard]] double inside(Eigen::Index j, double share) const {
    const double low = options.lower[j], high = options.upper[j];
    const double value = logarithmic(j) ? low * std::pow(high / low, share) : low + share * (high - low);
    return std::clamp(value, low, high);
  }
  [[nodiscard]] double share(Eigen::Index j, double value) const {
    const double low = options.lower[j], high = options.upper[j];
    if (low == high) return value - low;
    if (logarithmic(j) && value > 0.0) return std::log(value / low) / std::log(high / low);
    return (value - low) / (high - low);
  }
  [[nodiscard]] bool same(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
    for (Eigen::Index j = 0; j < a.size(); ++j) {
      if (!(std::abs(share(j, a[j]) - share(j, b[j])) <= options.x_tolerance)) return false;
    }
    return true;
  }
};

/// Gathers the minima into basins, lowest first, so that the best member names the basin; ties go by index.
void gather(const Box& box, MultistartResult& result) {
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
                              [&](const Basin& known) { return box.same(known.x, minimum(i).x); });
    if (basin == result.basins.end()) {
      result.basins.push_back({.x = minimum(i).x, .cost = minimum(i).cost, .members = {}});
      basin = std::prev(result.basins.end());
    }
    basin->members.push_back(i);
    if (minimum(i).termination == Termination::converged) ++basin->converged;
  }
  for (Basin& basin : result.basins) {
    std::sort(basin.members.begin(), basin.members.end());
    basin.rival = basin.cost - result.basins.front().cost <= box.options.rival_cost;
  }
}

}  // namespace

MultistartResult multistart(const LocalSearch& search, const MultistartOptions& options) {
  validate(options);
  const Box box{options};
  MultistartResult result;
  result.starts = options.given;
  const Eigen::Index p = options.lower.size();
  Eigen::MatrixXd cube(0, p);
  if (options.starts > 0)
    cube = sobol_points(
        options.starts, static_cast<int>(std::min<Eigen::Index>(p, 1000)),
        {.first = 1, .scramble_seed = options.scramble_seed});  // 1 skips the origin: the first point is the center
  for (Eigen::Index i = 0; i < cube.rows(); ++i) {
    Eigen::VectorXd start(p);
    for (Eigen::Index j = 0; j < p; ++j) start[j] = box.inside(j, cube(i, j));
    result.starts.push_back(start);
  }
  result.minima.resize(result.starts.size());
  std::atomic<std::size_t> done{0};
  oneapi::tbb::parallel_for(std::size_t{0}, result.starts.size(), [&](std::size_t i) {
    options.progress.check();
    result.minima[i] = search(result.starts[i], static_cast<Eigen::Index>(i));
    const double share = static_cast<double>(++done) / static_cast<double>(result.starts.size());
    options.progress.tell(share, "searching from many starts");
  });
  for (const LocalMinimum& minimum : result.minima) result.evaluations += minimum.evaluations;
  gather(box, result);
  return result;
}

MultistartResult multistart(const LeastSquaresProblem& problem,
                            const LeastSquaresOptions& search,
                            const MultistartOptions& options) {
  LeastSquaresOptions quiet = search;
  quiet.progress = {.report = {}, .stop = options.progress.stop};
  return multistart(
      [&](const Eigen::VectorXd& start, Eigen::Index) {
        Eigen::VectorXd inside = start;
        if (problem.lower.size() == start.size()) inside = inside.cwiseMax(problem.lower).eval();
        if (problem.upper.size() == start.size()) inside = inside.cwiseMin(problem.upper).eval();
        LocalMinimum end;
        end.x = inside;
        // minimize() throws for a start outside the domain: test it first.
        Eigen::VectorXd r = Eigen::VectorXd::Zero(problem.residual_count);
        Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(problem.residual_count, start.size());
        problem.evaluate(inside, r, &jacobian);
        end.evaluations = 1;
        end.termination = Termination::not_finite;
        if (!std::isfinite(r.squaredNorm()) || !jacobian.allFinite()) return end;
        const LeastSquaresResult fit = minimize(problem, inside, quiet);
        return LocalMinimum{
            .termination = fit.termination, .x = fit.x, .cost = fit.cost, .evaluations = fit.evaluations + 1};
      },
      options);
}

}  // namespace myoid::math
