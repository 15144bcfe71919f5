#include "myoid/intervals/estimates.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/intervals/discrepancy.h"
#include "myoid/intervals/estimate_remarks.h"
#include "myoid/intervals/estimate_rows.h"
#include "myoid/intervals/held_tendon.h"
#include "myoid/intervals/profile_likelihood.h"
#include "myoid/intervals/reported_interval.h"
#include "myoid/intervals/signatures.h"
#include "myoid/intervals/uncertainty.h"
#include "myoid/intervals/verdict_rules.h"
#include "myoid/math/statistics.h"

namespace myoid::identification {
namespace {

/// Returns the least R² of all joints, over the rows of the residual model.
double explained_share(const ResidualModel& model, const Eigen::VectorXd& z) {
  Evaluation at;
  model.evaluate(z, ResidualModel::Depth::value, at);
  double least = 1.0;
  for (int joint = 0; joint < model.joint_count(); ++joint) {
    const std::vector<Eigen::Index> rows = model.rows_of_joint(joint);
    if (rows.empty()) continue;
    least = std::min(least, math::explained_share(at.predicted(rows), model.measured()(rows)));
  }
  return least;
}

/// Computes the intervals by every route that the options ask for.
Intervals all_intervals(const Estimator& estimator, const Estimator::Solution& solution, const StudyData& data) {
  const EstimatorOptions& options = estimator.options();
  Intervals intervals;
  intervals.sandwich = sandwich(estimator, solution);
  if (options.model_error && options.weights)
    intervals.model_error = discrepancy(estimator, solution, intervals.sandwich.model_based);
  intervals.tendon_shift = held_tendon_shift(estimator, solution, data);
  if (options.intervals.bootstrap > 0) intervals.bootstrap = bootstrap(estimator, solution);
  if (options.intervals.profile)
    intervals.profiles = profile(estimator, solution, intervals.sandwich.newey_west.diagonal());
  return intervals;
}

/// Returns the facts about a fit as a whole: its end, samples, noise, values and covariance.
IdentificationResult summary_of(const Estimator& estimator,
                                const Estimator::Solution& solution,
                                const StudyData& data,
                                const Intervals& intervals) {
  const ResidualModel& model = estimator.model();
  const Eigen::VectorXd& z = solution.search.x;
  IdentificationResult result;
  result.method = "torque";
  result.termination = solution.search.termination;
  result.message = solution.search.message;
  result.iterations = solution.search.iterations;
  result.samples_used = static_cast<int>(model.sample_count());
  result.samples_dropped = model.dropped();
  result.effective_samples = solution.weighting.share * static_cast<double>(model.sample_count());
  result.torque_sd_nm = solution.weighting.noise.front().torque_sd_nm;
  result.emg_cv = solution.weighting.noise.front().emg_cv;
  result.envelope_variance = estimator.envelope_variance(solution.weighting.noise.front());
  result.solution = z;
  result.values = model.parameters().values(z);
  result.lag = estimator.options().lag;
  result.r2 = explained_share(model, z);
  for (const MuscleValues& values : result.values.muscles) result.muscles.push_back(hill_parameters(values));
  result.delay_s = result.values.channels.front()[kDelay];
  result.covariance =
      intervals.sandwich.newey_west + intervals.sandwich.by_noise * intervals.sandwich.by_noise.transpose();
  if (intervals.model_error) {
    result.covariance += intervals.model_error->covariance;
    result.model_error = intervals.model_error->relative_size;
  }
  result.condition = intervals.sandwich.condition;
  if (intervals.bootstrap) {
    result.bootstrap_replicates = static_cast<int>(intervals.bootstrap->replicates.rows());
    result.bootstrap_failed = intervals.bootstrap->failed;
  }
  for (const Unknown& p : estimator.free()) result.free_parameters.push_back(p.label);
  result.prior_distances = prior_distances(estimator.free(), z, data);
  return result;
}

/// Describes sets of parameters that the data hardly separate, one sentence per set.
std::vector<std::string> collinear_sentences(const std::vector<Unknown>& free, const Eigen::MatrixXd& information) {
  const auto is_gain = [&](Eigen::Index j) { return free[static_cast<std::size_t>(j)].is(Scope::channel, kGain); };
  std::vector<std::string> sentences;
  for (const CollinearSet& set : collinear_sets(information)) {
    // A gain is a nuisance and always collinear with F_max.
    if (std::any_of(set.parameters.begin(), set.parameters.end(), is_gain)) continue;
    std::vector<std::string> names;
    for (const Eigen::Index j : set.parameters) names.push_back(free[static_cast<std::size_t>(j)].label);
    sentences.push_back(fmt::format("{} (collinearity index {:.0f})", fmt::join(names, ", "), set.index));
  }
  return sentences;
}

/// Returns the directions that the data leave open, each as a sum of parameters.
std::vector<std::string> undetermined_sums(const std::vector<Unknown>& free, const Eigen::MatrixXd& directions) {
  std::vector<std::string> sums;
  for (Eigen::Index k = 0; k < directions.cols(); ++k) {
    std::vector<std::string> parts;
    for (Eigen::Index j = 0; j < directions.rows(); ++j) {
      const double share = directions(j, k);
      if (std::abs(share) > 0.05)
        parts.push_back(fmt::format("{:+.2f} {}", share, free[static_cast<std::size_t>(j)].label));
    }
    sums.push_back(fmt::format("{}", fmt::join(parts, " ")));
  }
  return sums;
}

/// Returns reasons to doubt the fit as a whole.
std::vector<std::string> warnings_of(const IdentificationResult& result,
                                     const EstimatorOptions& options,
                                     bool corrected) {
  std::vector<std::string> warnings;
  if (options.weights && options.correct_attenuation && !corrected) {
    warnings.push_back(
        "the noise of the EMG is too large against what the recording tells of the muscles' torques for its effect on "
        "the strengths to be taken out: they may come out too weak, above all where muscles work against each other");
  }
  if (result.r2 < kVerdictRules.least_r2) {
    warnings.push_back(fmt::format(
        "{} (R2 {:.2f}, of the joint that is explained least, without the ends of the trials): no number is called "
        "identified; look for a wrong sign, unit, offset, clock, order of files or column",
        kExplainsLittle, result.r2));
  }
  if (result.model_error > kVerdictRules.model_error) {
    warnings.push_back(fmt::format(
        "what the model leaves of the torque depends on posture, effort and speed as if it were wrong by {:.0f} %: the "
        "estimates describe the fit rather than the muscles, and the truth may lie outside the intervals",
        100.0 * result.model_error));
  }
  add_distances_to(warnings, result.prior_distances);
  if (result.bootstrap_failed > 0) {
    warnings.push_back(fmt::format("{} of {} bootstrap replicates did not converge", result.bootstrap_failed,
                                   result.bootstrap_failed + result.bootstrap_replicates));
  }
  return warnings;
}

}  // namespace

IdentificationResult report_estimates(const Estimator& estimator,
                                      const Estimator::Solution& solution,
                                      const StudyData& data) {
  const Intervals intervals = all_intervals(estimator, solution, data);
  IdentificationResult result = summary_of(estimator, solution, data, intervals);
  result.estimates = estimate_rows(estimator, solution, data, intervals, result);
  RouteRemarks routes;
  for (ParameterEstimate& e : result.estimates) routes.compare(e);
  routes.add_to(result.interval_warnings, result.estimates.size());
  for (std::string& warning : warnings_of(result, estimator.options(), solution.weighting.corrected))
    result.warnings.push_back(std::move(warning));
  result.collinear = collinear_sentences(estimator.free(), intervals.sandwich.information);
  result.undetermined = undetermined_sums(estimator.free(), intervals.sandwich.undetermined);
  if (result.termination == math::Termination::converged) result.diagnoses = signatures(result.estimates);
  return result;
}

}  // namespace myoid::identification
