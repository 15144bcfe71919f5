#include "myoid/posterior/posterior.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/intervals/estimate_remarks.h"
#include "myoid/intervals/signatures.h"
#include "myoid/intervals/verdict_rules.h"
#include "myoid/math/explained_share.h"
#include "myoid/math/statistics.h"
#include "myoid/muscle/hill_parameters.h"
#include "myoid/posterior/density.h"
#include "myoid/posterior/importance.h"
#include "myoid/posterior/marginals.h"
#include "myoid/posterior/mode.h"
#include "myoid/posterior/verdicts.h"

namespace myoid::identification {
namespace {

constexpr double kLeastWeight = 0.02;  // of a mode
constexpr double kSameMode = 0.3;      // conditional standard deviations, root mean square
constexpr int kMostReferences = 4;
constexpr Eigen::Index kUncheckedDraws = 4000;
constexpr Eigen::Index kDrawStride = 4;  // of the draws that are written
constexpr int kOtherStarts = 1;
constexpr std::uint64_t kSeed = 20;

/// A mode of one of the densities, and its weight among all.
struct Candidate {
  const Density* density = nullptr;
  EmgLag lag = EmgLag::delay;
  Mode mode;
  double weight = 0.0;
};

/// The start moved by a spread of the prior, up or down by a fixed pattern.
Eigen::VectorXd moved_start(const Density& density, int number) {
  Eigen::VectorXd z = density.parameters().start();
  const std::vector<Unknown>& free = density.parameters().free();
  for (std::size_t j = 0; j < free.size(); ++j) {
    const double sign = (j * 2654435761U >> (4 + number)) % 2 == 0 ? 1.0 : -1.0;
    z[static_cast<Eigen::Index>(j)] += sign * free[j].prior.sd;
  }
  return density.x_of(z, density.noise_of(density.start()));
}

bool same(const Candidate& a, const Mode& b) {
  const Eigen::VectorXd off = a.mode.x - b.x;
  const double squared = off.dot(a.density->gauss_newton(a.mode.x) * off);
  return squared < kSameMode * kSameMode * static_cast<double>(off.size());
}

/// Climbs, takes the unseen quantities at the top, and climbs again until the top stays.
Mode settle(Density& density, const Eigen::VectorXd& start, const Progress& progress) {
  Mode mode = find_mode(density, start, progress);
  for (int pass = 0; pass < kMostReferences; ++pass) {
    density.refer_to(mode.x);
    const Candidate before{.density = &density, .mode = mode};
    mode = find_mode(density, mode.x, progress);
    if (same(before, mode)) break;
  }
  return mode;
}

/// The modes of a density, the best first; at least one. The unseen quantities are those of the
/// first start's mode.
std::vector<Candidate> modes_of(Density& density,
                                const std::vector<Eigen::VectorXd>& starts,
                                const EstimatorOptions& options) {
  std::vector<Candidate> found;
  for (const Eigen::VectorXd& start : starts) {
    Mode mode = found.empty() ? settle(density, start, options.progress)
                              : find_mode(density, start, options.progress);
    if (!mode.converged && !found.empty()) continue;
    if (std::any_of(found.begin(), found.end(),
                    [&](const Candidate& other) { return same(other, mode); }))
      continue;
    found.push_back({.density = &density, .lag = options.lag, .mode = std::move(mode)});
  }
  std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.mode.log_density > b.mode.log_density;
  });
  return found;
}

/// Leaves the modes that weigh something, with curvatures and weights, the heaviest first.
void weigh(std::vector<Candidate>& candidates, const Progress& progress) {
  const double best = std::max_element(candidates.begin(), candidates.end(),
                                       [](const Candidate& a, const Candidate& b) {
                                         return a.mode.log_density < b.mode.log_density;
                                       })
                          ->mode.log_density;
  std::erase_if(candidates, [best](const Candidate& c) { return c.mode.log_density < best - 8.0; });
  double most = -1e300;
  for (Candidate& c : candidates) {
    add_curvature(*c.density, c.mode, progress);
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

/// Draws of z from all modes.
struct Sample {
  Eigen::MatrixXd z;  ///< unknowns x draws
  Eigen::VectorXd weight;
  double khat = 0.0;
  bool approximate = false;
};

Sample sample(const std::vector<Candidate>& candidates, const EstimatorOptions& options) {
  const int draws = options.posterior_draws;
  std::vector<Draws> parts;
  Eigen::Index count = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& c = candidates[i];
    const bool checked = draws > 0;
    const auto wanted = static_cast<Eigen::Index>(
        std::max(100.0, c.weight * static_cast<double>(checked ? draws : kUncheckedDraws)));
    const auto log_density = [&](const Eigen::VectorXd& x) {
      return checked ? c.density->value(x) : 0.0;
    };
    const auto with_gradient = [&](const Eigen::VectorXd& x, Eigen::VectorXd& gradient) {
      return c.density->value(x, gradient);
    };
    const std::uint64_t seed = kSeed + 10 * i;
    parts.push_back(
        checked ? draw(log_density, c.mode.x, c.mode.covariance, wanted, seed)
        : options.marginals
            ? draw_about(c.mode, marginals(with_gradient, c.mode, options.progress), wanted, seed)
            : draw_normal(c.mode.x, c.mode.covariance, wanted, seed));
    count += wanted;
  }
  Sample all;
  all.z.resize(candidates.front().density->parameters().size(), count);
  all.weight.resize(count);
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (Eigen::Index k = 0; k < parts[i].x.cols(); ++k)
      all.z.col(first + k) = candidates[i].density->z_of(parts[i].x.col(k));
    all.weight.segment(first, parts[i].x.cols()) = candidates[i].weight * parts[i].weight;
    all.khat = std::max(all.khat, parts[i].khat);
    all.approximate = all.approximate || parts[i].approximate;
    first += parts[i].x.cols();
  }
  return all;
}

/// Of every unknown, what each source is of its variance by Laplace with Fisher's information.
std::vector<SourceShares> source_shares(const Candidate& best) {
  const std::vector<Unknown>& free = best.density->parameters().free();
  const Likelihood::Information of = best.density->likelihood().information(
      best.density->z_of(best.mode.x), best.density->noise_of(best.mode.x));
  const auto p = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd all = of.information + best.density->precision();
  all.diagonal() *= 1.0 + 1e-10;
  const Eigen::MatrixXd covariance = all.ldlt().solve(Eigen::MatrixXd::Identity(p, p));
  Eigen::MatrixXd part(p, kSourceCount);
  for (int s = 0; s < kSourceCount; ++s)
    part.col(s) = (covariance * of.by_source[static_cast<std::size_t>(s)] * covariance).diagonal();
  // No prior joins a channel's number with another's: the precision is one block for each source.
  const Eigen::MatrixXd pulled = best.density->precision() * covariance;
  for (Eigen::Index j = 0; j < p; ++j) {
    const Source source = free[static_cast<std::size_t>(j)].field->scope == Scope::channel
                              ? Source::electrodes
                              : Source::literature;
    part.col(static_cast<Eigen::Index>(source)) +=
        covariance.col(j).cwiseProduct(pulled.row(j).transpose());
  }
  std::vector<SourceShares> shares(free.size());
  for (Eigen::Index j = 0; j < p; ++j) {
    for (int s = 0; s < kSourceCount; ++s)
      shares[static_cast<std::size_t>(j)][static_cast<std::size_t>(s)] =
          part(j, s) / std::max(part.row(j).sum(), 1e-300);
  }
  return shares;
}

/// The interval of z, were geometry and sensors exact: Laplace's, with the curvature of Gauss and
/// Newton.
struct Given {
  Eigen::VectorXd low, high;
};

Given given_geometry(Density density, const Candidate& best, const Progress& progress) {
  density.believe(Believed::geometry_and_sensors_exact);
  const Mode mode = find_mode(density, best.mode.x, progress);
  const Eigen::MatrixXd precision = density.gauss_newton(mode.x);
  const Eigen::MatrixXd covariance =
      precision.ldlt().solve(Eigen::MatrixXd::Identity(precision.rows(), precision.cols()));
  const Eigen::VectorXd reach =
      math::normal_quantile(0.975) * covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  return {density.z_of(mode.x - reach), density.z_of(mode.x + reach)};
}

/// What the reporting of rows has at hand.
struct Reporting {
  const StudyData& data;
  const ParameterMap& map;
  const Sample& sample;
  const std::vector<SourceShares>& shares;
  const Given& given;
  const std::vector<ActiveMotion>& motion;  ///< Of the muscles.
  const IdentificationResult& result;
  bool converged = true;
};

std::string owner_name(const Reporting& of, const Unknown& p, int owner) {
  if (p.owner == "subject") return p.owner;
  const auto k = static_cast<std::size_t>(owner);
  return p.field->scope == Scope::muscle    ? of.data.muscles[k].name
         : p.field->scope == Scope::channel ? of.map.channels()[k]
                                            : of.map.joints()[k];
}

/// Fills the interval and the verdict of a row from draws of its value.
void judge_row(const Reporting& of,
               std::size_t unknown,
               const Eigen::VectorXd& values,
               int owner,
               ParameterEstimate& e,
               PosteriorFacts facts) {
  const Unknown& p = of.map.free()[unknown];
  const Eigen::VectorXd& weight = of.sample.weight;
  e.ci_low = weighted_quantile(values, weight, 0.025);
  e.ci_high = weighted_quantile(values, weight, 0.975);
  const double mean = values.dot(weight);
  e.std_error = std::sqrt((values.array() - mean).square().matrix().dot(weight));
  e.routes.push_back({.route = "posterior", .low = e.ci_low, .high = e.ci_high});
  facts.converged = of.converged;
  facts.approximate = of.sample.approximate;
  facts.value = e.estimate;
  facts.low = *e.ci_low;
  facts.high = *e.ci_high;
  facts.contraction = e.shrinkage;
  facts.nuisance_gain = p.field->scope == Scope::channel && p.field->field == kGain;
  facts.is_delay = p.field->scope == Scope::channel && p.field->field == kDelay;
  facts.shares = of.shares[unknown];
  facts.r2 = of.result.r2;
  e.variance_shares = facts.shares;
  const bool of_width = p.field->scope == Scope::muscle && p.field->field == kWidth;
  if (of_width || (p.field->scope == Scope::muscle && p.field->field == kFiberLength)) {
    const auto k = static_cast<std::size_t>(owner);
    facts.length_span =
        of.motion[k].length_span_m / of.data.muscles[k].start.optimal_fiber_length_m;
  }
  if (of_width) {
    const MuscleValues& muscle = of.result.values.muscles[static_cast<std::size_t>(owner)];
    facts.possible = VerdictRules{}.possible(muscle[kWidth] / muscle[kFiberLength]);
  }
  const Finding found = finding(facts);
  e.verdict = verdict_of(found);
  e.reason = reason_of(found, facts);
}

ParameterEstimate row_of(const Reporting& of, std::size_t unknown, std::size_t target_at) {
  const Unknown& p = of.map.free()[unknown];
  const Unknown::Target& target = p.targets[target_at];
  const auto at = static_cast<Eigen::Index>(unknown);
  const auto value = [&](double z) { return target.ratio * p.to_value(z); };
  ParameterEstimate e;
  e.method = "torque";
  e.fit_case = "both";
  e.muscle = owner_name(of, p, target.owner);
  if (target_at > 0) e.tied_to = owner_name(of, p, p.targets.front().owner);
  e.parameter = std::string(p.field->name);
  e.unit = p.field->unit;
  e.initial = value(p.start);
  e.estimate = value(of.result.solution[at]);
  if (p.prior.sd > 0.0) {
    e.prior_mean = value(p.prior.mean);
    e.prior_sd =
        p.field->logarithmic ? *e.prior_mean * p.prior.sd : std::abs(target.ratio) * p.prior.sd;
    e.shrinkage = 1.0 - of.result.covariance(at, at) / (p.prior.sd * p.prior.sd);
    e.prior_distance = distance_from_prior(p, of.result.solution[at]);
  }
  PosteriorFacts facts;
  const Eigen::VectorXd draws =
      of.sample.z.row(at).unaryExpr([&](double z) { return value(z); }).transpose();
  facts.low_given = value(of.given.low[at]);
  facts.high_given = value(of.given.high[at]);
  judge_row(of, unknown, draws, target.owner, e, facts);
  e.routes.push_back(
      {.route = "geometry_and_sensors_exact", .low = facts.low_given, .high = facts.high_given});
  return e;
}

/// V_sh V_shl of a muscle whose slope ratio is the unknown.
ParameterEstimate product_row(const Reporting& of, std::size_t unknown, int owner) {
  const auto k = static_cast<std::size_t>(owner);
  ParameterEstimate e;
  e.method = "torque";
  e.fit_case = "both";
  e.muscle = of.data.muscles[k].name;
  e.parameter = "eccentric_curvature_product";
  e.initial = of.data.muscles[k].start.eccentric_curvature_product;
  const muscle::Range physical = muscle::hill_field(e.parameter).bounds;
  Eigen::VectorXd draws(of.sample.z.cols());
  for (Eigen::Index i = 0; i < draws.size(); ++i)
    draws[i] = std::clamp(of.map.values(of.sample.z.col(i)).muscles[k][kProduct], physical.lower,
                          physical.upper);
  e.estimate = weighted_quantile(draws, of.sample.weight, 0.5);
  const Unknown& ratio = of.map.free()[unknown];
  if (ratio.prior.sd > 0.0) {
    const auto at = static_cast<Eigen::Index>(unknown);
    e.shrinkage = 1.0 - of.result.covariance(at, at) / (ratio.prior.sd * ratio.prior.sd);
  }
  PosteriorFacts facts;
  facts.low_given = weighted_quantile(draws, of.sample.weight, 0.025);
  facts.high_given = weighted_quantile(draws, of.sample.weight, 0.975);
  judge_row(of, unknown, draws, owner, e, facts);
  return e;
}

void add_estimates(const Reporting& of, IdentificationResult& result) {
  for (std::size_t j = 0; j < of.map.free().size(); ++j) {
    const Unknown& p = of.map.free()[j];
    result.free_parameters.push_back(p.label);
    for (std::size_t t = 0; t < p.targets.size(); ++t) {
      if (p.owner == "subject" && t > 0) break;
      result.estimates.push_back(row_of(of, j, t));
    }
    agree_on_tied(result.estimates, p.targets.size());
    if (p.field->scope != Scope::muscle || p.field->field != kSlopeRatio) continue;
    for (const Unknown::Target& target : p.targets)
      result.estimates.push_back(product_row(of, j, target.owner));
  }
}

void fill_fit(const Candidate& best,
              const Sample& sample,
              const StudyData& data,
              IdentificationResult& result) {
  const Density& density = *best.density;
  const ParameterMap& map = density.parameters();
  const NoiseValues noise = density.noise_of(best.mode.x);
  result.method = "torque";
  result.termination =
      best.mode.converged ? math::Termination::converged : math::Termination::no_descent;
  result.message = best.mode.message;
  result.iterations = best.mode.iterations;
  result.samples_used = static_cast<int>(density.likelihood().row_count());
  result.effective_samples = static_cast<double>(result.samples_used);
  result.lag = best.lag;
  result.solution = sample.z * sample.weight;
  const Eigen::MatrixXd off = sample.z.colwise() - result.solution;
  result.covariance = off * sample.weight.asDiagonal() * off.transpose();
  result.values = map.values(result.solution);
  for (const MuscleValues& values : result.values.muscles)
    result.muscles.push_back(hill_parameters(values));
  result.delay_s = result.values.channels.front()[kDelay];
  result.noise = Eigen::Map<const Eigen::VectorXd>(noise.data(), kNoiseFieldCount);
  result.torque_sd_nm = std::exp(noise[kTorqueSd]);
  result.model_error = std::exp(noise[kModelErrorSize]);
  const std::vector<TrialRun>& runs = density.likelihood().runs();
  result.envelope_variance.setZero(runs.front().envelope_sd.size());
  for (const TrialRun& run : runs) result.envelope_variance += run.envelope_sd.cwiseAbs2();
  result.envelope_variance *= std::exp(2.0 * noise[kEmgFactor]) / static_cast<double>(runs.size());
  result.emg_cv = std::sqrt(result.envelope_variance.mean());
  const Likelihood::Residuals rows = density.likelihood().residuals(result.solution);
  for (const std::vector<Eigen::Index>& joint : rows.rows_of_joint) {
    if (!joint.empty())
      result.r2 = std::min(
          result.r2, math::explained_share(rows.predicted_nm(joint), rows.measured_nm(joint)));
  }
  result.prior_distances = prior_distances(map.free(), result.solution, data);
}

/// Every kDrawStride-th draw, as values.
void keep_draws(const Sample& sample, const ParameterMap& map, IdentificationResult& result) {
  const Eigen::Index count = (sample.z.cols() + kDrawStride - 1) / kDrawStride;
  result.draws.resize(sample.z.rows(), count);
  result.draw_weights.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < sample.z.rows(); ++j)
      result.draws(j, i) =
          map.free()[static_cast<std::size_t>(j)].to_value(sample.z(j, i * kDrawStride));
    result.draw_weights[i] = sample.weight[i * kDrawStride];
  }
  result.draw_weights /= result.draw_weights.sum();
}

void add_warnings(const std::vector<Candidate>& candidates,
                  const Sample& sample,
                  IdentificationResult& result) {
  if (candidates.size() > 1)
    result.warnings.push_back(
        fmt::format("the posterior has {} modes that are nearly as good, the best with {:.0f} % of "
                    "it: the intervals are over all of them",
                    candidates.size(), 100.0 * candidates.front().weight));
  if (sample.approximate)
    result.warnings.push_back(fmt::format(
        "the intervals are those of a normal approximation of the posterior: draws from "
        "it cannot be reweighed (Pareto k-hat {:.2f}, 0.70 is the limit)",
        sample.khat));
  if (result.model_error > VerdictRules{}.model_error)
    result.warnings.push_back(fmt::format(
        "what the model leaves of the torque depends on posture, effort and speed as if it were "
        "wrong by {:.0f} %",
        100.0 * result.model_error));
  add_distances_to(result.warnings, result.prior_distances);
}

}  // namespace

IdentificationResult identify_by_posterior(const StudyData& data, const EstimatorOptions& options) {
  validate(data);
  if (!options.priors)
    throw InvalidInput(
        "the estimator posterior rests on what is known of people, and the study does without "
        "(priors = false): take the estimator least_squares");
  const auto begin = std::chrono::steady_clock::now();
  Density by_delay(data, options);
  std::vector<Eigen::VectorXd> starts{by_delay.start()};
  const int others = options.multistart > 1        ? options.multistart - 1
                     : options.posterior_draws > 0 ? kOtherStarts
                                                   : 0;
  for (int s = 0; s < others; ++s) starts.push_back(moved_start(by_delay, s));
  std::vector<Candidate> candidates = modes_of(by_delay, starts, options);
  std::unique_ptr<Density> by_lags;
  EstimatorOptions with_lags = options;
  with_lags.lag = EmgLag::shared;
  if (options.choose_lag && options.lag == EmgLag::delay) {
    by_lags = std::make_unique<Density>(data, with_lags);
    const std::vector<Eigen::VectorXd> from{candidates.front().mode.x};
    for (Candidate& c : modes_of(*by_lags, from, with_lags)) candidates.push_back(std::move(c));
  }
  weigh(candidates, options.progress);
  const Candidate& best = candidates.front();
  const Sample drawn = sample(candidates, options);

  IdentificationResult result;
  fill_fit(best, drawn, data, result);
  const Given given = given_geometry(*best.density, best, options.progress);
  const std::vector<SourceShares> shares = source_shares(best);
  const std::vector<ActiveMotion> motion = active_motion(data, result.delay_s);
  add_estimates(
      {data, best.density->parameters(), drawn, shares, given, motion, result, best.mode.converged},
      result);
  if (options.marginals) keep_draws(drawn, best.density->parameters(), result);
  add_warnings(candidates, drawn, result);
  if (best.mode.converged) result.diagnoses = signatures(result.estimates);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace myoid::identification
