#include "myoid/run/design/design_knowledge.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "myoid/fit/intervals/verdicts.h"
#include "myoid/fit/measurement/unlikeness.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/math/decompositions.h"
#include "myoid/ground/math/random.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::run {

using fit::ParameterEstimate;
using fit::Unknown;

namespace {

/// Returns the owner and the parameter of "BIC.optimal_fiber_length".
std::pair<std::string, std::string> split_label(const std::string& label) {
  const std::size_t dot = label.find('.');
  return {label.substr(0, dot), label.substr(dot + 1)};
}

}  // namespace

Knowledge knowledge_of(const std::vector<Unknown>& free, const std::optional<EarlierRun>& earlier) {
  const auto p = static_cast<Eigen::Index>(free.size());
  Knowledge known{Eigen::VectorXd(p), Eigen::MatrixXd::Zero(p, p), {}};
  for (Eigen::Index j = 0; j < p; ++j) {
    const Unknown& f = free[static_cast<std::size_t>(j)];
    const double sd = f.prior.sd > 0.0 ? f.prior.sd : 0.25 * (f.bounds.upper - f.bounds.lower);
    known.mean[j] = f.prior.sd > 0.0 ? f.prior.mean : f.start;
    known.covariance(j, j) = sd * sd;
  }
  Eigen::MatrixXd precision = fit::prior_precision(free);
  for (Eigen::Index j = 0; j < p; ++j) {
    if (!(precision(j, j) > 0.0)) precision(j, j) = 1.0 / known.covariance(j, j);
  }
  known.covariance = precision.llt().solve(Eigen::MatrixXd::Identity(p, p));
  const Eigen::VectorXd sd_before = known.covariance.diagonal().cwiseSqrt();
  if (earlier) {
    std::vector<std::pair<Eigen::Index, Eigen::Index>> pairs;
    for (Eigen::Index j = 0; j < p; ++j) {
      const auto it = std::ranges::find(earlier->parameters, free[static_cast<std::size_t>(j)].label);
      if (it == earlier->parameters.end()) continue;
      const Eigen::Index from = it - earlier->parameters.begin();
      if (std::isfinite(earlier->estimate[from])) pairs.emplace_back(j, from);
    }
    for (const auto& [a, from_a] : pairs) {
      known.covariance.row(a).setZero();
      known.covariance.col(a).setZero();
    }
    for (const auto& [a, from_a] : pairs) {
      const bool logarithmic = free[static_cast<std::size_t>(a)].field->logarithmic;
      known.mean[a] = logarithmic ? std::log(earlier->estimate[from_a]) : earlier->estimate[from_a];
      for (const auto& [b, from_b] : pairs) known.covariance(a, b) = earlier->covariance(from_a, from_b);
    }
  }
  // Scaled by the prior: a direction that the run left undetermined has no variance in its
  // covariance, and keeps its prior. The least standard deviation of a direction is a ten-thousandth of the prior's, so
  // that its inverse stays positive definite in double precision.
  const Eigen::VectorXd unit = sd_before.cwiseInverse();
  const math::SymmetricEigen axes = math::symmetric_eigen(unit.asDiagonal() * known.covariance * unit.asDiagonal());
  if (!axes.values.allFinite()) throw InvalidInput("design: the covariance of the earlier run is not finite");
  Eigen::VectorXd variance = axes.values;
  for (double& v : variance) v = v <= 1e-14 ? 1.0 : std::max(v, 1e-8);
  const Eigen::MatrixXd scaled = sd_before.asDiagonal() * axes.vectors;
  known.covariance = scaled * variance.asDiagonal() * scaled.transpose();
  const Eigen::MatrixXd inverse = unit.asDiagonal() * axes.vectors;
  known.precision = inverse * variance.cwiseInverse().asDiagonal() * inverse.transpose();
  return known;
}

std::vector<Eigen::VectorXd> draw_persons(const std::vector<Unknown>& free,
                                          const Knowledge& known,
                                          int count,
                                          std::uint64_t seed) {
  const Eigen::LLT<Eigen::MatrixXd> factor(known.covariance);
  math::Random random(math::seed_for(seed, "design persons"));
  std::vector<Eigen::VectorXd> persons;
  for (int k = 0; k < count; ++k) {
    Eigen::VectorXd z = known.mean;
    if (k > 0) z += factor.matrixL() * random.normals(z.size());
    for (Eigen::Index j = 0; j < z.size(); ++j) {
      const Unknown& f = free[static_cast<std::size_t>(j)];
      z[j] = std::clamp(z[j], f.bounds.lower, f.bounds.upper);
    }
    persons.push_back(std::move(z));
  }
  return persons;
}

std::vector<Eigen::Index> targets_of(const std::vector<Unknown>& free, const std::vector<std::string>& wanted) {
  std::vector<Eigen::Index> targets;
  std::set<std::string> known{"all"};
  for (std::size_t j = 0; j < free.size(); ++j) {
    const auto [owner, parameter] = split_label(free[j].label);
    known.insert({free[j].label, owner, parameter});
    // A nuisance is free so that the others include its uncertainty; if named, it is a target, too.
    const bool nuisance = free[j].field->name == "emg_gain" || free[j].field->name == "max_shortening_speed";
    const auto names_it = [&, &owner = owner, &parameter = parameter](const std::string& w) {
      return w == free[j].label || w == owner || w == parameter || (w == "all" && !nuisance);
    };
    if (std::ranges::any_of(wanted, names_it)) targets.push_back(static_cast<Eigen::Index>(j));
  }
  for (const std::string& w : wanted) {
    if (known.contains(w)) continue;
    throw InvalidInput(fmt::format("target '{}' is no parameter, muscle or muscle.parameter that can be identified{}",
                                   w, not_among(w, free, &Unknown::label)));
  }
  return targets;
}

const ParameterEstimate* found_by(const std::optional<EarlierRun>& earlier, const Unknown& f) {
  if (!earlier) return nullptr;
  const std::string owners = split_label(f.label).first;
  const std::string owner = owners.substr(0, owners.find('+'));
  for (const ParameterEstimate& e : earlier->estimates) {
    if ((e.muscle == owner || e.muscle == owners) && e.parameter == f.field->name && e.ci_low && e.ci_high &&
        std::isfinite(e.estimate))
      return &e;
  }
  return nullptr;
}

ParameterEstimate expected_estimate(const Unknown& f, const Expectation& expectation) {
  const auto& [mean, sd, prior_sd, model_error, found, ratio] = expectation;
  ParameterEstimate e;
  std::tie(e.muscle, e.parameter) = split_label(f.label);
  e.unit = f.field->unit;
  e.initial = e.estimate = f.to_value(mean);
  double below = math::normal_quantile(0.975) * sd, above = below;
  if (found != nullptr) {
    // The run's own interval shrinks by the same ratio.
    const bool logarithmic = f.field->logarithmic;
    const auto scaled = [&](double value) { return logarithmic ? std::log(std::max(value, 1e-300)) : value; };
    below = expectation.ratio * (scaled(found->estimate) - scaled(*found->ci_low));
    above = expectation.ratio * (scaled(*found->ci_high) - scaled(found->estimate));
  }
  e.prior_mean = e.estimate;
  e.prior_sd = f.field->logarithmic ? e.estimate * prior_sd : prior_sd;
  e.shrinkage = 1.0 - sd * sd / (prior_sd * prior_sd);
  fit::NumberFacts facts{.fit = {.one_reading = true, .model_error = model_error},
                         .person = {.value = e.estimate,
                                    .low = f.to_value(std::max(mean - below, f.bounds.lower)),
                                    .high = f.to_value(std::min(mean + above, f.bounds.upper)),
                                    .sd = f.field->logarithmic ? e.estimate * sd : sd},
                         .nuisance_gain = f.is(fit::Scope::channel, fit::kGain),
                         .contraction = e.shrinkage};
  if (f.is(fit::Scope::channel, fit::kDelay)) facts.scale = fit::Scale::delay;
  if (fit::zero_by_nature(e.parameter)) facts.usual_size = math::normal_quantile(0.975) * *e.prior_sd;
  fit::judge(e, facts);
  return e;
}

}  // namespace myoid::run
