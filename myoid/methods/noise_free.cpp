#include "myoid/methods/noise_free.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace myoid::identification {
namespace {

constexpr int kStarts = 12;
constexpr Eigen::Index kFewSamples = 500, kSamplesAnUnknown = 10;
/// Share of the data's sum of squares above which a search has left residuals.
constexpr double kNear = 1e-4;
constexpr double kMet = 1e-12;
constexpr double kLeast = 10.0;  ///< Samples that even a short trial keeps.

bool leaves_at_most(double share, const Estimator& estimator, const NormalSearchResult& search) {
  return 2.0 * search.cost <= share * estimator.model().measured().squaredNorm();
}

/// Returns start number s; the delay has several minima, so the searches begin at several delays.
Eigen::VectorXd start_number(const Estimator& estimator, int s) {
  const Eigen::VectorXd start = estimator.model().parameters().start();
  Eigen::VectorXd x = s == 0 ? start : estimator.moved_start(start, s);
  for (std::size_t j = 0; j < estimator.free().size(); ++j) {
    const Unknown& f = estimator.free()[j];
    if (f.is(Scope::channel, kDelay))
      x[static_cast<Eigen::Index>(j)] = f.bounds.lower + (f.bounds.upper - f.bounds.lower) * 0.2 * (s % 4);
  }
  return x;
}

/// Returns the solution from the first start that leads to a minimum without residuals.
std::optional<Estimator::Solution> first_without_residuals(const Estimator& estimator) {
  Weighting as_they_are;
  as_they_are.sd_nm = Eigen::VectorXd::Ones(estimator.model().sample_count());
  as_they_are.noise.resize(static_cast<std::size_t>(estimator.model().joint_count()));
  for (int s = 0; s < kStarts; ++s) {
    const NormalSearchResult look = estimator.search(start_number(estimator, s), as_they_are, 1e-6, 1e-6);
    if (!leaves_at_most(kNear, estimator, look)) continue;
    Estimator::Solution attempt = estimator.solve(look.x);
    if (leaves_at_most(kMet, estimator, attempt.search)) return attempt;
  }
  return std::nullopt;
}

/// Takes row floor((i + g i mod 1) apart) as sample i, g the golden ratio, so that no period of a
/// movement is a multiple of the steps.
std::vector<Eigen::Index> irregular_rows(Eigen::Index count, double apart) {
  std::vector<Eigen::Index> rows;
  for (double i = 0.0; i * apart < static_cast<double>(count); i += 1.0) {
    const double shift = std::fmod(i * std::numbers::phi, 1.0);
    const auto row = static_cast<Eigen::Index>((i + shift) * apart);
    if (row < count && (rows.empty() || row > rows.back())) rows.push_back(row);
  }
  return rows;
}

}  // namespace

StudyData few_samples(const StudyData& data, Eigen::Index count) {
  Eigen::Index all = 0;
  for (const TrialData& trial : data.trials) all += trial.calibration ? trial.time_s.size() : 0;
  if (all <= count) return data;
  const double apart = static_cast<double>(all) / static_cast<double>(count);
  StudyData few = data;
  for (TrialData& trial : few.trials) {
    if (!trial.calibration) continue;
    const Eigen::Index n = trial.time_s.size();
    trial = at_rows(trial, irregular_rows(n, std::min(apart, static_cast<double>(n) / kLeast)));
  }
  return few;
}

std::optional<Estimator::Solution> noise_free_solution(const StudyData& data, const Estimator& whole) {
  const auto unknowns = static_cast<Eigen::Index>(whole.free().size());
  const Eigen::Index count = std::max(kFewSamples, kSamplesAnUnknown * unknowns);
  if (whole.model().sample_count() <= count) return first_without_residuals(whole);
  EstimatorOptions at_all = whole.options();
  at_all.max_rate_hz = std::numeric_limits<double>::infinity();
  const auto found = first_without_residuals(Estimator(few_samples(data, count), at_all));
  if (!found) return std::nullopt;
  Estimator::Solution polished = whole.solve(found->search.x);
  if (!leaves_at_most(kMet, whole, polished.search)) return std::nullopt;
  return polished;
}

}  // namespace myoid::identification
