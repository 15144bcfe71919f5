#include "myoid/fit/posterior/posterior.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "myoid/fit/intervals/estimate_rows.h"
#include "myoid/fit/intervals/signatures.h"
#include "myoid/fit/intervals/verdict_rules.h"
#include "myoid/fit/intervals/verdicts.h"
#include "myoid/fit/measurement/parameter_fields.h"
#include "myoid/fit/measurement/unseen_activations.h"
#include "myoid/fit/posterior/exploration.h"
#include "myoid/fit/posterior/learned_sizes.h"
#include "myoid/fit/posterior/voluntary_torque.h"
#include "myoid/ground/core/progress_part.h"
#include "myoid/ground/math/bounded.h"
#include "myoid/ground/math/decompositions.h"
#include "myoid/ground/math/draws.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::fit {
namespace {

constexpr double kUnlike = 1.6;            // lambda from which a warning is given
constexpr Eigen::Index kKeptDraws = 1000;  // written draws
constexpr Eigen::Index kGivenDraws = 1000;
constexpr double kPriorReach = 1.96;  // standard deviations to either side hold 95 % of a prior
constexpr std::uint64_t kGivenSeed = 21;

/// Returns each source's share of every unknown's variance, by Laplace with Fisher's information.
std::vector<SourceShares> source_shares(const Candidate& best) {
  const std::vector<Unknown>& free = best.density->parameters().free();
  const Likelihood::Information of =
      best.density->likelihood().information(best.density->z_of(best.mode.x), best.density->noise_of(best.mode.x));
  const auto p = static_cast<Eigen::Index>(free.size());
  const Eigen::MatrixXd covariance = math::inverse_of_positive(of.information + best.density->precision());
  Eigen::MatrixXd part(p, kSourceCount);
  for (int s = 0; s < kSourceCount; ++s)
    part.col(s) = (covariance * of.by_source[static_cast<std::size_t>(s)] * covariance).diagonal();
  // No prior joins a channel's number with another number, so each block belongs to one source.
  const Eigen::MatrixXd pulled = best.density->precision() * covariance;
  for (Eigen::Index j = 0; j < p; ++j) {
    const Source source =
        free[static_cast<std::size_t>(j)].field->scope == Scope::channel ? Source::electrodes : Source::literature;
    part.col(static_cast<Eigen::Index>(source)) += covariance.col(j).cwiseProduct(pulled.row(j).transpose());
  }
  std::vector<SourceShares> shares(free.size());
  for (Eigen::Index j = 0; j < p; ++j) {
    for (int s = 0; s < kSourceCount; ++s)
      shares[static_cast<std::size_t>(j)][static_cast<std::size_t>(s)] =
          part(j, s) / std::max(part.row(j).sum(), 1e-300);
  }
  return shares;
}

/// Returns x with tendons as long as their priors say and fibers longer by what the tendons lose: the same torque.
Eigen::VectorXd with_tendons_of_the_model(const Density& density, const Eigen::VectorXd& x) {
  const ParameterMap& map = density.parameters();
  Eigen::VectorXd z = density.z_of(x);
  for (Eigen::Index j = 0; j < z.size(); ++j) {
    const Unknown& tendon = map.free()[static_cast<std::size_t>(j)];
    if (!density.is_exact_geometry(j)) continue;
    const Eigen::Index fiber = map.find(Scope::muscle, kFiberLength, tendon.targets.front().owner);
    if (fiber >= 0 && map.free()[static_cast<std::size_t>(fiber)].targets.size() == 1)
      z[fiber] += z[j] - tendon.prior.mean;
    z[j] = tendon.prior.mean;
  }
  return density.x_of(z, density.noise_of(x));
}

/// The second reading of z: value, 95 % interval and draws if geometry and sensors were exact.
struct Given {
  Eigen::VectorXd value, low, high;
  Eigen::VectorXd narrower;  ///< Standard deviation over the person's, per unknown.
  Eigen::MatrixXd z;         ///< Draws, unknowns x draws of equal weight.
  std::shared_ptr<const Density> density = nullptr;
  NoiseValues noise = {};
};

/// The interval has the shape of the person's: the distances of its ends from the mode are those of the person's, by
/// the ratio of both standard deviations. The draws are normal about the mode.
Given given_geometry(const Candidate& best, const Sample& sample, const Progress& progress) {
  const auto of_given = std::make_shared<Density>(*best.density);
  Density& density = *of_given;
  const Eigen::VectorXd of_person =
      math::inverse_of_positive(density.gauss_newton(best.mode.x)).diagonal().cwiseMax(0.0).cwiseSqrt();
  density.believe(Believed::geometry_and_sensors_exact);
  const Mode mode = find_mode(density, {.x = with_tendons_of_the_model(density, best.mode.x)},
                              part_of(progress, 0.7, 0.8), kRoughPromise);
  const Eigen::MatrixXd covariance = math::inverse_of_positive(density.gauss_newton(mode.x));
  const Eigen::VectorXd sd = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  const std::vector<Unknown>& free = density.parameters().free();
  const auto p = static_cast<Eigen::Index>(free.size());
  Given given{.value = density.z_of(mode.x)};
  given.density = of_given;
  given.noise = density.noise_of(mode.x);
  given.narrower = (sd.array() / of_person.array().max(1e-300)).min(1.0).head(p);
  const auto end = [&](double share) {
    Eigen::VectorXd x = mode.x;
    for (std::size_t i = 0; i < free.size(); ++i) {
      const auto j = static_cast<Eigen::Index>(i);
      const muscle::Range& bounds = free[i].bounds;
      const double z = math::weighted_quantile(sample.z.row(j).transpose(), sample.weight, share);
      const double beyond =
          math::unbounded((z - bounds.lower) / (bounds.upper - bounds.lower), free[i].bound_shape()) - best.mode.x[j];
      if (std::isfinite(beyond)) x[j] += given.narrower[j] * beyond;
    }
    return density.z_of(x);
  };
  given.low = end(0.025).cwiseMin(given.value);
  given.high = end(0.975).cwiseMax(given.value);
  const Eigen::MatrixXd draws = math::draw_normal(mode.x, covariance, kGivenDraws, kGivenSeed);
  given.z.resize(p, kGivenDraws);
  for (Eigen::Index i = 0; i < kGivenDraws; ++i) given.z.col(i) = density.z_of(draws.col(i));
  return given;
}

/// The second reading where it is not asked for: the person's value, without a width.
Given not_asked_for(const Eigen::VectorXd& z) {
  return {.value = z, .low = z, .high = z, .narrower = Eigen::VectorXd::Ones(z.size()), .z = z};
}

/// The inputs that every reported row needs.
struct Reporting {
  const StudyData& data;
  const ParameterMap& map;
  const Sample& sample;
  const std::vector<SourceShares>& shares;
  const Given& given;
  const std::vector<double>& active_span_m;  ///< Per muscle: range of its active lengths.
  const IdentificationResult& result;
  FitFacts fit;
  bool from_mvc = true;  ///< Activation 1 is a maximal effort.
};

/// Returns what F_max means without a maximal contraction, from draws of a muscle's F_max: the
/// force at the largest EMG where the share of the maximum is an unknown, the channel's gain.
std::string without_maximum(const Reporting& of, const Eigen::VectorXd& f_max, int muscle) {
  const int channel = of.map.channel_of_muscle(static_cast<std::size_t>(muscle));
  const std::vector<Unknown>& free = of.map.free();
  const auto gain = std::find_if(free.begin(), free.end(), [&](const Unknown& p) {
    return p.is(Scope::channel, kGain) && p.acts_on(channel) && p.bounds.upper <= 0.0;
  });
  if (gain == free.end())
    return "; no maximal contraction was recorded, so this is the force at the study's largest EMG, not the muscle's "
           "maximum";
  const Eigen::VectorXd share = of.sample.z.row(gain - free.begin()).array().exp().transpose();
  const Eigen::VectorXd force = f_max.cwiseProduct(share);
  const auto reach = [&](const Eigen::VectorXd& values, double p) {
    return math::weighted_quantile(values, of.sample.weight, p);
  };
  return fmt::format(
      "; no maximal contraction was recorded: the muscle pulls {:.4g} to {:.4g} N at the largest EMG, between {:.0f} "
      "and {:.0f} % of its maximum",
      reach(force, 0.025), reach(force, 0.975), 100.0 * reach(share, 0.025), 100.0 * reach(share, 0.975));
}

/// Returns the reading of draws of a number.
Reading reading_of(double value, const Eigen::VectorXd& draws, const Eigen::VectorXd& weight) {
  const double mean = draws.dot(weight);
  return {.value = value,
          .low = math::weighted_quantile(draws, weight, 0.025),
          .high = math::weighted_quantile(draws, weight, 0.975),
          .sd = std::sqrt((draws.array() - mean).square().matrix().dot(weight))};
}

/// Fills the readings and the verdict of a row from draws of its value, which has these bounds.
void judge_row(const Reporting& of,
               std::size_t unknown,
               const Eigen::VectorXd& values,
               int owner,
               const muscle::Range& bounds,
               const Reading& given,
               ParameterEstimate& e) {
  const Unknown& p = of.map.free()[unknown];
  NumberFacts facts{.fit = of.fit, .person = reading_of(e.estimate, values, of.sample.weight), .given = given};
  const double touches = kVerdictRules.on_bound * (bounds.upper - bounds.lower);
  // An interval whose mass lies on a bound is one-sided.
  if (facts.person.low - bounds.lower < touches) facts.person.low = bounds.lower;
  if (bounds.upper - facts.person.high < touches) facts.person.high = bounds.upper;
  e.at_bound = facts.person.low - bounds.lower < touches || bounds.upper - facts.person.high < touches;
  facts.at_bound = e.at_bound && !p.is(Scope::channel, kDelay);  // no delay is a delay
  // The search stays inside of the bounds: a number that is 0 by nature reaches 0 where its interval nearly does.
  const auto reach_zero = [&](Reading& reading) {
    if (reading.low < 0.05 * (reading.high - reading.low)) reading.low = 0.0;
  };
  if (zero_by_nature(e.parameter) && bounds.lower == 0.0) {
    reach_zero(facts.person);
    reach_zero(facts.given);
  }
  facts.contraction = e.shrinkage;
  if (e.shrinkage)
    facts.contraction_given =
        1.0 - std::pow(of.given.narrower[static_cast<Eigen::Index>(unknown)], 2) * (1.0 - *e.shrinkage);
  if (e.prior_distance) facts.prior_distance = std::abs(*e.prior_distance);
  facts.nuisance_gain = p.is(Scope::channel, kGain);
  if (p.prior.sd > 0.0 && zero_by_nature(e.parameter)) facts.usual_size = kPriorReach * p.prior.sd;
  if (p.is(Scope::channel, kDelay)) facts.scale = Scale::delay;
  facts.shares = of.shares[unknown];
  e.variance_shares = facts.shares;
  if (p.is(Scope::muscle, kMaxForce) && of.data.muscles[static_cast<std::size_t>(owner)].unseen)
    facts.no_effect = without_emg_says(of.data.muscles[static_cast<std::size_t>(owner)].name);
  const bool of_width = p.is(Scope::muscle, kWidth);
  if (of_width || p.is(Scope::muscle, kFiberLength)) {
    const auto k = static_cast<std::size_t>(owner);
    facts.length_span = of.active_span_m[k] / of.data.muscles[k].start.optimal_fiber_length_m;
  }
  if (of_width) {
    const MuscleValues& muscle = of.result.values.muscles[static_cast<std::size_t>(owner)];
    if (of.fit.converged && !kVerdictRules.possible(muscle[kWidth] / muscle[kFiberLength]))
      facts.impossible = "no muscle has this ratio of l_sh to l0: the fit describes another thing";
  }
  judge(e, facts);
  if (!of.from_mvc && p.is(Scope::muscle, kMaxForce)) e.reason += without_maximum(of, values, owner);
}

/// Returns 1 - variance / prior variance of an unknown, over all modes.
double contraction(const Reporting& of, std::size_t unknown) {
  const Eigen::VectorXd z = of.sample.z.row(static_cast<Eigen::Index>(unknown)).transpose();
  const double mean = z.dot(of.sample.weight), sd = prior_spread(of.map.free()[unknown]);
  return 1.0 - (z.array() - mean).square().matrix().dot(of.sample.weight) / (sd * sd);
}

ParameterEstimate reported_row(const Reporting& of, std::size_t unknown, std::size_t target_at) {
  Unknown p = of.map.free()[unknown];
  p.prior.sd = prior_spread(p);
  const Unknown::Target& target = p.targets[target_at];
  const auto at = static_cast<Eigen::Index>(unknown);
  const auto value = [&](double z) { return target.ratio * p.to_value(z); };
  ParameterEstimate e = row_of(p, target, of.map, of.result.solution[at]);
  if (p.prior.sd > 0.0) e.shrinkage = contraction(of, unknown);
  const Eigen::VectorXd draws = of.sample.z.row(at).unaryExpr([&](double z) { return value(z); }).transpose();
  Reading given{value(of.given.value[at]), value(of.given.low[at]), value(of.given.high[at])};
  // Exact in the second reading, which then determines nothing of it.
  if (is_exact_geometry(p, of.data)) given.low = given.high = given.value;
  judge_row(of, unknown, draws, target.owner, {value(p.bounds.lower), value(p.bounds.upper)}, given, e);
  return e;
}

/// Returns the row of V_sh V_shl of a muscle whose slope ratio is the unknown.
ParameterEstimate product_row(const Reporting& of, std::size_t unknown, int owner) {
  const auto k = static_cast<std::size_t>(owner);
  ParameterEstimate e = product_row_of(of.data.muscles[k]);
  const muscle::Range physical = muscle::hill_field(e.parameter).bounds;
  const auto products = [&](const Eigen::MatrixXd& z) {
    Eigen::VectorXd values(z.cols());
    for (Eigen::Index i = 0; i < z.cols(); ++i)
      values[i] = std::clamp(of.map.values(z.col(i)).muscles[k][kProduct], physical.lower, physical.upper);
    return values;
  };
  const Eigen::VectorXd draws = products(of.sample.z), given = products(of.given.z);
  const Eigen::VectorXd equal = Eigen::VectorXd::Constant(given.size(), 1.0 / static_cast<double>(given.size()));
  e.estimate = math::weighted_quantile(draws, of.sample.weight, 0.5);
  const Unknown& ratio = of.map.free()[unknown];
  if (ratio.prior.sd > 0.0) e.shrinkage = contraction(of, unknown);
  judge_row(of, unknown, draws, owner, physical, reading_of(math::weighted_quantile(given, equal, 0.5), given, equal),
            e);
  return e;
}

void add_estimates(const Reporting& of, IdentificationResult& result) {
  for (std::size_t j = 0; j < of.map.free().size(); ++j) {
    const Unknown& p = of.map.free()[j];
    result.free_parameters.push_back(p.label);
    for (std::size_t t = 0; t < p.targets.size(); ++t) {
      if (p.owner == "subject" && t > 0) break;
      result.estimates.push_back(reported_row(of, j, t));
    }
    agree_on_tied(result.estimates, p.targets.size());
    if (!p.is(Scope::muscle, kSlopeRatio)) continue;
    for (const Unknown::Target& target : p.targets) result.estimates.push_back(product_row(of, j, target.owner));
  }
}

/// Compares the muscles with their priors, about the strength that they share, and names that strength once.
void compare_with_priors(const ParameterMap& map, const StudyData& data, IdentificationResult& result) {
  constexpr double kUnusual = 2.0;  // standard deviations of persons
  const Strength strength = common_strength(map.free(), result.solution);
  result.prior_distances = prior_distances(about_strength(map.free(), strength.log_ratio), result.solution, data);
  if (std::abs(strength.log_ratio) <= kUnusual * strength.sd) return;
  result.warnings.push_back({.code = RemarkCode::unlike_person,
                             .says = fmt::format("all muscles together are {:.2g} times as strong as the model's: is "
                                                 "it of this person's size, is the torque's unit right?",
                                                 std::exp(strength.log_ratio))});
}

/// R2 below which a point fits nothing: it leaves twice the torque's variance.
constexpr double kFitsNothing = -1.0;

/// Returns the R2 of the fitted samples at z, of the joint that is explained worst.
double least_explained(const Likelihood& likelihood, const Eigen::VectorXd& z, const NoiseValues& noise) {
  const Likelihood::Residuals rows = likelihood.residuals(z, noise);
  double least = 1.0;
  for (const std::vector<Eigen::Index>& joint : rows.rows_of_joint)
    if (!joint.empty())
      least = std::min(least, math::explained_share(rows.predicted_nm(joint), rows.measured_nm(joint)));
  return least;
}

void fill_fit(const Candidate& best, const Sample& sample, IdentificationResult& result) {
  const Density& density = *best.density;
  const ParameterMap& map = density.parameters();
  const NoiseValues noise = density.noise_of(best.mode.x);
  result.termination = best.mode.converged ? math::Termination::converged : math::Termination::no_descent;
  result.message = best.mode.message;
  result.iterations = best.mode.iterations;
  result.samples_used = static_cast<int>(density.likelihood().row_count());
  result.effective_samples = 0.0;
  for (std::size_t r = 0; r < density.likelihood().runs().size(); ++r)
    result.effective_samples +=
        density.likelihood().row_weight(r) * static_cast<double>(density.likelihood().runs()[r].measured_nm.size());
  result.lag = best.lag;
  // The mean over several modes may lie between them, where nothing fits, and so may that over a curved ridge.
  const auto z = sample.z.leftCols(sample.of_best);
  const Eigen::VectorXd weight = sample.weight.head(sample.of_best) / sample.weight.head(sample.of_best).sum();
  result.solution = z * weight;
  const Eigen::VectorXd at_mode = density.z_of(best.mode.x);
  result.r2 = least_explained(density.likelihood(), at_mode, noise);
  if (result.r2 > kVerdictRules.least_r2 &&
      least_explained(density.likelihood(), result.solution, noise) < kFitsNothing)
    result.solution = at_mode;
  const Eigen::MatrixXd off = z.colwise() - result.solution;
  result.covariance = off * weight.asDiagonal() * off.transpose();
  result.values = map.values(result.solution);
  for (const MuscleValues& values : result.values.muscles) result.muscles.push_back(hill_parameters(values));
  result.delay_s = result.values.channels.front()[kDelay];
  result.noise = noise;
  result.torque_sd_nm = std::exp(noise[kTorqueSd]);
  result.model_error = std::exp(noise[kModelErrorSize]);
  const std::vector<TrialRun>& runs = density.likelihood().runs();
  result.envelope_variance.setZero(runs.front().envelope_sd.size());
  for (const TrialRun& run : runs) result.envelope_variance += run.envelope_sd.cwiseAbs2();
  result.envelope_variance *= std::exp(2.0 * noise[kEmgFactor]) / static_cast<double>(runs.size());
  for (std::size_t c = 0; c < map.channels().size(); ++c)
    if (map.unseen_activation(c)) result.envelope_variance[static_cast<Eigen::Index>(c)] = 0.0;
  const auto measured = std::max<Eigen::Index>(1, (result.envelope_variance.array() > 0.0).count());
  result.emg_cv = std::sqrt(result.envelope_variance.sum() / static_cast<double>(measured));
}

/// Keeps at most kKeptDraws draws as values, evenly spaced among all draws.
void keep_draws(const Sample& sample, const ParameterMap& map, IdentificationResult& result) {
  const Eigen::Index stride = (sample.z.cols() + kKeptDraws - 1) / kKeptDraws;
  const Eigen::Index count = (sample.z.cols() + stride - 1) / stride;
  result.draws.resize(sample.z.rows(), count);
  result.draw_weights.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < sample.z.rows(); ++j)
      result.draws(j, i) = map.free()[static_cast<std::size_t>(j)].to_value(sample.z(j, i * stride));
    result.draw_weights[i] = sample.weight[i * stride];
  }
  result.draw_weights /= result.draw_weights.sum();
}

/// Puts the greatest voluntary torques before the muscles' numbers, read at the mode, which fits the measured torque:
/// the means of numbers that err together need not.
void add_voluntary(const Reporting& of,
                   const Candidate& best,
                   const NoiseValues& of_widths,
                   const EstimatorOptions& options,
                   IdentificationResult& result) {
  const Eigen::MatrixXd off = of.given.z.colwise() - of.given.z.rowwise().mean();
  VoluntaryTorques torques = voluntary_torques(
      of.data, options,
      {best.density->likelihood(), best.density->z_of(best.mode.x), result.noise, of_widths, result.covariance},
      {of.given.density->likelihood(), of.given.value, of.given.noise, of.given.noise,
       off * off.transpose() / static_cast<double>(off.cols())},
      of.fit);
  result.estimates.insert(result.estimates.begin(), std::make_move_iterator(torques.estimates.begin()),
                          std::make_move_iterator(torques.estimates.end()));
  result.voluntary = std::move(torques.curves);
}

void add_warnings(const std::vector<Candidate>& candidates,
                  const Sample& sample,
                  double unlikeness,
                  IdentificationResult& result) {
  const auto warn = [&](RemarkCode code, std::string says) { result.warnings.push_back({.code = code, .says = says}); };
  if (result.r2 < kVerdictRules.least_r2)
    warn(RemarkCode::fit_poor,
         fmt::format("the fit explains little of the fitted samples (R2 {:.2f} of the worst joint, without the ends "
                     "of the trials): no number is called identified; look for a wrong sign, unit, offset, clock, "
                     "order of files or column",
                     result.r2));
  if (candidates.size() > 1)
    warn(RemarkCode::several_modes, fmt::format("{} unlike sets of numbers explain the recording nearly as well, the "
                                                "best with {:.0f} % of the odds: intervals are over all",
                                                candidates.size(), 100.0 * candidates.front().weight));
  if (sample.approximate)
    warn(RemarkCode::draws_unreliable,
         fmt::format("the draws of the posterior are not to be relied on: the sampler's chains differ (R-hat {:.2f}; "
                     "limit 1.10) or took {:.0f} % of their proposals (limit 40 %). Ask for more draws",
                     sample.rhat, 100.0 * sample.accepted));
  if (unlikeness > kUnlike)
    warn(RemarkCode::unlike_person,
         fmt::format("the muscles lie {:.1f} times as far from the model's numbers as people usually do: so much wider "
                     "are the priors here. Was the model scaled to this person?",
                     unlikeness));
  if (result.model_error > kVerdictRules.model_error)
    warn(RemarkCode::model_unfit,
         fmt::format("the unexplained part depends on posture, effort and speed as if the model were wrong by {:.0f} %",
                     100.0 * result.model_error));
  add_distances_to(result.warnings, result.prior_distances);
}

}  // namespace

IdentificationResult identify_by_posterior(const StudyData& data, const EstimatorOptions& options) {
  validate(data);
  if (!options.priors) throw std::logic_error("the posterior rests on priors");
  const auto begin = std::chrono::steady_clock::now();
  const Exploration explored = explore(data, options);
  const std::vector<Candidate>& candidates = explored.modes;
  const Candidate& best = candidates.front();
  Sample drawn = explored.sample;

  IdentificationResult result;
  fill_fit(best, drawn, result);
  compare_with_priors(best.density->parameters(), data, result);
  // A fit whose numbers are not reported needs no second interval.
  const Given given =
      options.marginals ? given_geometry(best, drawn, options.progress) : not_asked_for(result.solution);
  const LearnedSizes sizes = learned_sizes(best);
  // Draws of the sampler are from the density over all sizes.
  if (options.posterior_draws == 0) {
    stretch(sizes.wider, best.density->parameters(), drawn);
    result.covariance = sizes.wider.asDiagonal() * result.covariance * sizes.wider.asDiagonal();
  }
  const std::vector<SourceShares> shares = source_shares(best);
  const std::vector<double> active_span_m = active_length_spans_m(data, result.delay_s);
  const Reporting of{data,
                     best.density->parameters(),
                     drawn,
                     shares,
                     given,
                     active_span_m,
                     result,
                     {.converged = best.mode.converged,
                      .of_force = options.measured_is_force,
                      .approximate = drawn.approximate,
                      .r2 = result.r2,
                      .model_error = result.model_error},
                     options.from_mvc};
  add_estimates(of, result);
  if (options.marginals && options.predictions && !options.measured_is_force)
    add_voluntary(of, best, sizes.noise, options, result);
  if (options.marginals) keep_draws(drawn, best.density->parameters(), result);
  add_warnings(candidates, drawn, best.density->unlikeness(), result);
  if (best.mode.converged) result.diagnoses = signatures(result.estimates);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace myoid::fit
