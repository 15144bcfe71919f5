#include "myoid/fit/posterior/exploration.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "myoid/fit/posterior/marginals.h"
#include "myoid/fit/posterior/sampler.h"
#include "myoid/ground/core/progress_part.h"
#include "myoid/ground/math/draws.h"

namespace myoid::fit {
namespace {

constexpr double kLeastWeight = 0.02;  // least share of a mode's weight
constexpr double kFarBelow = 8.0;      // of ln density: a mode so far below the best weighs nothing
constexpr double kMayRise = 12.0;      // of ln density, when the unseen quantities are taken there
constexpr double kSameMode = 0.3;      // conditional standard deviations, root mean square
constexpr int kMostReferences = 4;
constexpr Eigen::Index kApproximateDraws = 4000;
constexpr int kOtherStarts = 3;  // of a fit that is reported
constexpr std::uint64_t kSeed = 20;
constexpr double kShareOfModes = 0.5;  // of the time of a fit that is reported

/// Moves the start by the prior's spread, up or down by a fixed pattern.
Eigen::VectorXd moved_start(const Density& density, int number) {
  Eigen::VectorXd z = density.parameters().start();
  const std::vector<Unknown>& free = density.parameters().free();
  for (std::size_t j = 0; j < free.size(); ++j) {
    const double sign = (j * 2654435761U >> (4 + number)) % 2 == 0 ? 1.0 : -1.0;
    z[static_cast<Eigen::Index>(j)] += sign * free[j].prior.sd;
  }
  return density.x_of(z, density.noise_of(density.start()));
}

/// The points that count as one mode.
class Basin {
 public:
  Basin(const Density& density, const Eigen::VectorXd& mode) : mode_(mode), precision_(density.gauss_newton(mode)) {}
  [[nodiscard]] bool holds(const Eigen::VectorXd& x) const {
    const Eigen::VectorXd off = x - mode_;
    return off.dot(precision_ * off) < kSameMode * kSameMode * static_cast<double>(off.size());
  }

 private:
  Eigen::VectorXd mode_;
  Eigen::MatrixXd precision_;
};

/// Finds a mode, takes the unseen quantities there, and repeats until the mode stays. Gives up
/// where the first mode lies far below `floor`.
Mode settle(Density& density, const Eigen::VectorXd& start, double floor, const Progress& progress) {
  Mode mode = find_mode(density, {.x = start}, part_of(progress, 0.0, 0.5), kRoughPromise);
  if (mode.log_density < floor - kMayRise) return mode;
  for (int pass = 0; pass < kMostReferences; ++pass) {
    density.refer_to(mode.x);
    const Basin before(density, mode.x);
    mode = find_mode(density, mode, part_of(progress, 0.5, 0.75), kRoughPromise);
    if (before.holds(mode.x)) break;
  }
  return find_mode(density, mode, part_of(progress, 0.75, 1.0));
}

/// Returns the modes of a density, the best first; at least one. Takes the unseen quantities at the
/// first start's mode. Modes far below `floor` may be left out.
std::vector<Candidate> modes_of(Density& density,
                                const std::vector<Eigen::VectorXd>& starts,
                                double floor,
                                const EstimatorOptions& options) {
  const auto progress_of = [&](std::size_t i) {
    const double each = kShareOfModes / static_cast<double>(starts.size());
    return part_of(options.progress, each * static_cast<double>(i), each * static_cast<double>(i + 1));
  };
  std::vector<Candidate> found{
      {.density = &density, .lag = options.law, .mode = settle(density, starts.front(), floor, progress_of(0))}};
  std::vector<Basin> basins{Basin(density, found.front().mode.x)};
  const auto is_known = [&](const Eigen::VectorXd& x) {
    return std::any_of(basins.begin(), basins.end(), [&](const Basin& b) { return b.holds(x); });
  };
  for (std::size_t i = 1; i < starts.size(); ++i) {
    const Progress progress = progress_of(i);
    const Mode rough = find_mode(density, {.x = starts[i]}, part_of(progress, 0.0, 0.7), kRoughPromise, is_known);
    if (!rough.converged || is_known(rough.x) || rough.log_density < found.front().mode.log_density - kFarBelow - 1.0)
      continue;
    Mode mode = find_mode(density, rough, part_of(progress, 0.7, 1.0));
    if (!mode.converged || is_known(mode.x)) continue;
    basins.emplace_back(density, mode.x);
    found.push_back({.density = &density, .lag = options.law, .mode = std::move(mode)});
  }
  options.progress.tell(kShareOfModes, kFits);
  std::stable_sort(found.begin(), found.end(),
                   [](const Candidate& a, const Candidate& b) { return a.mode.log_density > b.mode.log_density; });
  return found;
}

/// Computes the curvatures and weights of all candidates, drops light ones, and sorts the heaviest first.
void weigh_by(bool exact_curvature, std::vector<Candidate>& candidates, const Progress& progress) {
  double most = -1e300;
  for (Candidate& c : candidates) {
    add_curvature(*c.density, exact_curvature, c.mode, progress);
    most = std::max(most, c.mode.log_evidence);
  }
  double sum = 0.0;
  for (Candidate& c : candidates) sum += c.weight = std::exp(c.mode.log_evidence - most);
  std::erase_if(candidates, [&](const Candidate& c) { return c.weight < kLeastWeight * sum; });
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.weight > b.weight; });
  sum = 0.0;
  for (const Candidate& c : candidates) sum += c.weight;
  for (Candidate& c : candidates) c.weight /= sum;
}

/// Drops the candidates that weigh little by Gauss and Newton's curvature, and weighs the others by the exact one.
void weigh(std::vector<Candidate>& candidates, const EstimatorOptions& options) {
  const double best =
      std::max_element(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        return a.mode.log_density < b.mode.log_density;
      })->mode.log_density;
  std::erase_if(candidates, [best](const Candidate& c) { return c.mode.log_density < best - kFarBelow; });
  if (candidates.size() > 1 || !options.marginals) weigh_by(false, candidates, options.progress);
  if (options.marginals) weigh_by(true, candidates, options.progress);
}

/// Draws about one mode: from the density itself where the options ask for draws, else from its
/// marginals, else from the normal approximation.
Eigen::MatrixXd draws_about(const Candidate& c, const EstimatorOptions& options, std::uint64_t seed, Sample& sample) {
  const auto log_density = [](const Density& of) {
    return [&of](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) { return of.value(x, gradient); };
  };
  const auto count = [&](Eigen::Index of_all) {
    return std::max<Eigen::Index>(100, std::lround(c.weight * static_cast<double>(of_all)));
  };
  if (options.posterior_draws > 0) {
    Density integrated = *c.density;
    integrated.integrate_unlikeness();
    Sampled sampled =
        sample_density(log_density(integrated), c.mode, count(options.posterior_draws), seed, options.progress);
    sample.rhat = std::max(sample.rhat, sampled.rhat);
    sample.accepted = std::min(sample.accepted, sampled.accepted);
    sample.approximate = sample.approximate || !sampled.trusted();
    return std::move(sampled.draws);
  }
  if (!options.marginals) return math::draw_normal(c.mode.x, c.mode.covariance, count(kApproximateDraws), seed);
  // Each trial has an ln b, which is not reported.
  const Eigen::Index reported = c.density->parameters().size() + kNoiseFieldCount;
  return draw_about(c.mode, marginals(log_density(*c.density), c.mode, reported, options.progress),
                    count(kApproximateDraws), seed);
}

Sample sample(const std::vector<Candidate>& candidates, const EstimatorOptions& options) {
  Sample all;
  std::vector<Eigen::MatrixXd> parts;
  Eigen::Index count = 0;
  for (const Candidate& c : candidates) {
    parts.push_back(draws_about(c, options, kSeed + 10 * parts.size(), all));
    count += parts.back().cols();
  }
  const Eigen::Index p = candidates.front().density->parameters().size();
  all.of_best = parts.front().cols();
  all.z.resize(p, count);
  all.noise.resize(candidates.front().density->size() - p, count);
  all.weight.resize(count);
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Eigen::Index of_mode = parts[i].cols();
    for (Eigen::Index k = 0; k < of_mode; ++k) {
      all.z.col(first + k) = candidates[i].density->z_of(parts[i].col(k));
      all.noise.col(first + k) = candidates[i].density->noise_of(parts[i].col(k));
    }
    all.weight.segment(first, of_mode).setConstant(candidates[i].weight * (1.0 / static_cast<double>(of_mode)));
    first += of_mode;
  }
  return all;
}

/// Returns the mode next to another fit's answer, with that fit's law of lag. Other modes are not looked for.
Exploration explore_from(const FittedUnknowns& at, const StudyData& data, EstimatorOptions options) {
  options.law = at.lag;
  Exploration found;
  Density& density = *found.densities.emplace_back(std::make_unique<Density>(data, options));
  const Eigen::VectorXd start = density.start_at(at);
  density.refer_to(start);
  Mode mode = find_mode(density, {.x = start}, options.progress, kRoughPromise);
  if (!Basin(density, start).holds(mode.x)) {
    density.refer_to(mode.x);
    mode = find_mode(density, mode, options.progress, kRoughPromise);
  }
  found.modes.push_back({.density = &density, .lag = at.lag, .mode = std::move(mode)});
  weigh(found.modes, options);
  found.sample = sample(found.modes, options);
  return found;
}

}  // namespace

Exploration explore(const StudyData& data, const EstimatorOptions& options) {
  if (options.begin_at) return explore_from(*options.begin_at, data, options);
  Exploration found;
  Density& by_delay = *found.densities.emplace_back(std::make_unique<Density>(data, options));
  std::vector<Eigen::VectorXd> starts{by_delay.start()};
  const int others = options.marginals ? kOtherStarts : 0;
  for (int s = 0; s < others; ++s) starts.push_back(moved_start(by_delay, s));
  found.modes = modes_of(by_delay, starts, -1e300, options);
  if (options.choose_lag && options.law == EmgLag::delay) {
    EstimatorOptions with_lags = options;
    with_lags.law = EmgLag::shared;
    Density& by_lags = *found.densities.emplace_back(std::make_unique<Density>(data, with_lags));
    const Mode best = found.modes.front().mode;
    by_lags.refer_to(best.x);
    for (Candidate& c : modes_of(by_lags, {best.x}, best.log_density - kFarBelow, with_lags))
      found.modes.push_back(std::move(c));
  }
  weigh(found.modes, options);
  found.sample = sample(found.modes, options);
  return found;
}

}  // namespace myoid::fit
