#include "myoid/fit/methods/paper.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include <Eigen/LU>
#include <fmt/format.h>

#include "myoid/fit/intervals/signatures.h"
#include "myoid/fit/intervals/verdict_rules.h"
#include "myoid/fit/intervals/verdicts.h"
#include "myoid/fit/methods/basins.h"
#include "myoid/fit/methods/paper_case.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/math/covariance.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::fit {
namespace {

/// Residual over force below which the data are free of noise and follow the model.
constexpr double kExact = 1e-6;

/// l0 and l_sh of one case with their covariance, which is 0 for a held number.
struct CaseShape {
  Eigen::Vector2d value = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};
constexpr std::array<std::string_view, 2> kShared{"optimal_fiber_length", "force_length_width"};

/// Returns where the criterion falls no further, as V_sh or P grows without limit. The end is no estimate, but shows
/// the signature of an error in the data. Empty if the steps ended otherwise.
std::optional<Eigen::VectorXd> settled_end(const MinimumSearch& search) {
  const std::vector<double>& costs = search.found.cost_history;
  const std::size_t steps = search.damped ? 10 : 1;
  const bool settled = costs.size() > steps && costs.back() > (1.0 - 1e-3) * costs[costs.size() - 1 - steps];
  return search.found.x.allFinite() && settled ? std::optional(search.found.x) : std::nullopt;
}

/// One muscle in one branch: samples, searches and covariance.
struct CaseFit {
  PaperCase samples;
  math::LeastSquaresResult search;         ///< For the minimum. Without a search, x is the start.
  PublishedSearch told;                    ///< Its message is empty where the search converged.
  std::optional<Eigen::VectorXd> minimum;  ///< The minimum, or where the criterion falls no further.
  bool computed = false;                   ///< Residuals and covariance are known.
  math::CovarianceResult covariance;
  double effective_samples = 0.0;
  double widen = 1.0;  ///< Samples over effective samples.
  double r2 = 1.0;
  bool exact = false;  ///< The data are free of noise and follow the model.

  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(samples.unknowns.size()); }
  /// Returns the position of an unknown in x, or -1 if it is held.
  [[nodiscard]] Eigen::Index position(std::string_view name) const {
    const std::vector<const muscle::HillField*>& list = samples.unknowns;
    const auto it = std::find_if(list.begin(), list.end(), [&](const muscle::HillField* u) { return u->name == name; });
    return it == list.end() ? Eigen::Index{-1} : static_cast<Eigen::Index>(it - list.begin());
  }
  [[nodiscard]] double variance(Eigen::Index i, Eigen::Index j) const {
    return covariance.unscaled(i, j) * covariance.residual_variance * widen;
  }
  /// Returns true if the search moved the value outside the range of muscles.
  [[nodiscard]] bool unphysical(Eigen::Index j, const Eigen::VectorXd& start) const {
    const muscle::Range bounds = samples.unknowns[static_cast<std::size_t>(j)]->bounds;
    const double x = search.x[j];
    return x != start[j] && std::isfinite(x) && (x < bounds.lower || x > bounds.upper);
  }
};

/// Adds covariance, effective number of samples and R² if the residuals allow.
void add_statistics(CaseFit& fit) {
  const math::LeastSquaresResult& search = fit.search;
  const auto n = static_cast<Eigen::Index>(fit.samples.samples.size());
  fit.computed =
      search.residual.size() == n && search.jacobian.allFinite() && search.residual.allFinite() && n > fit.size();
  if (!fit.computed) return;
  fit.covariance = math::covariance(search.jacobian, search.residual);
  fit.effective_samples = math::effective_sample_size(search.residual, fit.samples.pieces);
  fit.widen = static_cast<double>(n) / std::max(fit.effective_samples, 1.0);
  Eigen::VectorXd force(n);
  for (Eigen::Index i = 0; i < n; ++i) force[i] = fit.samples.samples[static_cast<std::size_t>(i)].force_n;
  fit.r2 = math::explained_share(force + search.residual, force);
  fit.exact = search.residual.norm() <= kExact * force.norm();
}

CaseFit search_case(PaperCase samples) {
  constexpr double kSame = 1e-6;
  CaseFit fit;
  fit.samples = std::move(samples);
  const Eigen::VectorXd start = fit.samples.start_vector();
  fit.search.x = start;
  fit.told.message = fit.samples.obstacle();
  fit.told.muscle = fit.samples.muscle;
  fit.told.fit_case = fit.samples.shortening ? FitCase::shortening : FitCase::lengthening;
  if (fit.told.message.empty()) {
    const MinimumSearch minimum = search_for_minimum(fit.samples, start);
    fit.search = minimum.found;
    fit.told.damped = minimum.damped;
    const math::LeastSquaresResult plain = search_as_published(fit.samples, start);
    fit.told.termination = fit.search.termination;
    fit.told.iterations = fit.search.iterations;
    fit.told.start_cost = fit.search.cost_history.empty() ? fit.search.cost : fit.search.cost_history.front();
    fit.told.cost = fit.search.cost;
    fit.told.plain = plain.termination;
    fit.told.plain_iterations = plain.iterations;
    const double apart = std::abs(plain.cost - fit.search.cost);
    fit.told.plain_elsewhere = plain.termination == math::Termination::converged &&
                               apart > kSame * fit.search.cost + kExact * kExact * fit.told.start_cost;
    if (fit.search.termination != math::Termination::converged) fit.told.message = fit.search.message;
    fit.minimum = fit.told.message.empty() ? std::optional(fit.search.x) : settled_end(minimum);
  }
  add_statistics(fit);
  return fit;
}

/// Returns the likely error behind a value outside physiology, known from simulation of single errors.
std::string diagnosis(const ParameterEstimate& e) {
  const std::string& p = e.parameter;
  if (p == "eccentric_plateau" && e.estimate < 1.0) {
    return "force in lengthening below the isometric one contradicts muscle physiology: EMG and assigned force "
           "disagree in gain while lengthening (co-contraction that force sharing set to zero, or F_max too high), not "
           "a property of the muscle";
  }
  if (p == "eccentric_curvature_product" && e.estimate <= 0.0) {
    return "a product that is not positive is no force-velocity curve: the velocity effect in lengthening is not "
           "resolved (an EMG delay that was not accounted for does this)";
  }
  if (p == "concentric_curvature") {
    return e.estimate > 1.0 ? "a curvature above 1 means a straight line: the velocity effect in shortening is not "
                              "resolved (an EMG delay that was not accounted for does this)"
                            : "a curvature this small is below that of the slowest muscle: co-contraction that force "
                              "sharing set to zero does this";
  }
  if (p == "force_length_width") {
    return e.initial > 0.0 && e.estimate > e.initial ? "a width this size is no muscle's: F_max or the EMG gain too "
                                                       "high, a wrong geometry or electrode flattens the curve"
                                                     : "a width this size is no muscle's: co-contraction set to zero, "
                                                       "a delay, a wrong geometry or electrode narrows the curve";
  }
  return "the value lies outside what a muscle can have: the fit describes something else";
}

/// Returns the reason why no muscle can have number j of a case; empty: a muscle can.
std::string impossible(const CaseFit& fit, Eigen::Index j, const ParameterEstimate& e) {
  const Eigen::VectorXd start = fit.samples.start_vector();
  if (fit.unphysical(j, start)) return diagnosis(e);
  const Eigen::Index length = fit.position(kShared[0]);
  const double l0 = length >= 0 ? fit.search.x[length] : fit.samples.start.optimal_fiber_length_m;
  const double x = fit.search.x[j];
  if (e.parameter != kShared[1] || fit.exact || !(l0 > 0.0) || x == start[j]) return "";
  const double width = std::abs(x) / l0;
  if (kVerdictRules.possible(width)) return "";
  return fmt::format("{:.2g} of the optimal length, and muscles have {} to {}: {}", width,
                     kVerdictRules.relative_width.lower, kVerdictRules.relative_width.upper, diagnosis(e));
}

/// Returns true if V_ml of a case is not clearly above 1.
bool plateau_is_flat(const CaseFit& fit) {
  const Eigen::Index plateau = fit.position("eccentric_plateau");
  if (plateau < 0 || !std::isfinite(fit.search.x[plateau])) return false;
  const double sd = fit.computed ? std::sqrt(fit.variance(plateau, plateau)) : 0.0;
  return std::abs(fit.search.x[plateau] - 1.0) < math::normal_quantile(0.975) * sd;
}

/// Returns number j of a case with its verdict. `refuted`: how improbable it is that both branches have equal l0 and
/// l_sh; empty: they may be equal.
ParameterEstimate estimate_of(const CaseFit& fit, Eigen::Index j, bool shared_forces, const std::string& refuted) {
  const Eigen::VectorXd start = fit.samples.start_vector();
  const Eigen::VectorXd& x = fit.search.x;
  const muscle::HillField& field = *fit.samples.unknowns[static_cast<std::size_t>(j)];
  ParameterEstimate e;
  e.muscle = fit.samples.muscle;
  e.parameter = std::string(field.name);
  e.unit = field.unit;
  e.method = Method::paper;
  e.fit_case = fit.told.fit_case;
  e.initial = start[j];
  e.estimate = std::abs(x[j]) <= 1e3 * std::abs(start[j]) ? x[j] : std::numeric_limits<double>::quiet_NaN();
  NumberFacts facts{.fit = {.converged = fit.told.message.empty(),
                            .failure = fit.told.message,
                            .of_force = true,
                            .shared_force = shared_forces,
                            .given_strength = !shared_forces && !fit.exact,
                            .one_reading = true,
                            .r2 = fit.r2},
                    .person = {.value = e.estimate},
                    .determined = fit.computed && fit.covariance.determined[static_cast<std::size_t>(j)]};
  if (!std::isfinite(e.estimate) && facts.fit.converged) {
    facts.fit.converged = false;
    facts.fit.failure = "it gave no number";
  }
  if (facts.determined && facts.fit.converged && !shared_forces) {
    facts.person.sd = std::sqrt(fit.variance(j, j));
    facts.person.low = e.estimate - math::normal_quantile(0.975) * facts.person.sd;
    facts.person.high = e.estimate + math::normal_quantile(0.975) * facts.person.sd;
  }
  for (Eigen::Index other = 0; other < fit.size(); ++other) {
    if (fit.unphysical(other, start))
      facts.bad_company = std::string(fit.samples.unknowns[static_cast<std::size_t>(other)]->name);
  }
  facts.impossible = impossible(fit, j, e);
  if (e.parameter == "eccentric_curvature_product" && plateau_is_flat(fit))
    facts.no_effect =
        "no rise of force in lengthening is resolved (V_ml not clearly above 1), and without one this number has no "
        "effect";
  if (!refuted.empty()) {
    const bool shared = std::find(kShared.begin(), kShared.end(), e.parameter) != kShared.end();
    facts.contradiction = fmt::format(
        "{} ({}): one muscle has one of each, the model is refuted",
        shared ? "the other branch gives another value" : "the two branches give different l0 or l_sh", refuted);
  }
  judge(e, facts);
  return e;
}

/// Returns l0 and l_sh of a case; empty if the fit does not determine all its unknowns, or there is none.
std::optional<CaseShape> shape_of(const std::optional<CaseFit>& of_case) {
  if (!of_case) return std::nullopt;
  const CaseFit& fit = *of_case;
  if (!fit.told.message.empty() || !fit.computed || fit.covariance.rank < fit.size()) return std::nullopt;
  CaseShape shape;
  shape.value = {fit.samples.start.optimal_fiber_length_m, fit.samples.start.force_length_width_m};
  for (Eigen::Index a = 0; a < 2; ++a) {
    const Eigen::Index i = fit.position(kShared[static_cast<std::size_t>(a)]);
    if (i < 0) continue;
    shape.value[a] = fit.search.x[i];
    for (Eigen::Index b = 0; b < 2; ++b) {
      const Eigen::Index j = fit.position(kShared[static_cast<std::size_t>(b)]);
      if (j >= 0) shape.covariance(a, b) = fit.variance(i, j);
    }
  }
  return shape;
}

/// Fits a muscle in one branch and counts the fit in `result`; empty if all numbers are held.
std::optional<CaseFit> fit_case(const StudyData& data,
                                std::size_t muscle,
                                bool shortening,
                                IdentificationResult& result) {
  PaperCase samples = paper_case(data, muscle, shortening);
  result.samples_dropped += samples.dropped;
  result.samples_used += static_cast<int>(samples.samples.size());
  result.muscles[muscle] = samples.start;
  if (samples.unknowns.empty()) return std::nullopt;
  CaseFit fit = search_case(std::move(samples));
  result.published.push_back(fit.told);
  result.iterations += fit.search.iterations;
  if (!fit.told.message.empty())
    result.message += fmt::format("{}, {}: {}. ", fit.told.muscle, name(fit.told.fit_case), fit.told.message);
  result.effective_samples += fit.effective_samples;
  result.r2 = std::min(result.r2, fit.r2);
  return fit;
}

/// Adds the numbers of a case, and to `minima` the minimum in which signatures of errors show.
void add_estimates(const CaseFit& fit,
                   bool shared_forces,
                   const std::string& refuted,
                   IdentificationResult& result,
                   std::vector<ParameterEstimate>& minima) {
  for (Eigen::Index j = 0; j < fit.size(); ++j) {
    const ParameterEstimate& e = result.estimates.emplace_back(estimate_of(fit, j, shared_forces, refuted));
    if (!fit.minimum) continue;
    const double x = (*fit.minimum)[j];
    minima.push_back(e);
    minima.back().estimate = e.parameter == kShared[1] ? std::abs(x) : x;
  }
}

/// Applies a Wald test to the numbers that both cases share and neither holds. Returns its probability if it rejects.
std::string compare_branches(const std::string& muscle,
                             const CaseShape& shortening,
                             const CaseShape& lengthening,
                             IdentificationResult& result) {
  constexpr double kReject = 0.01;
  const Eigen::Vector2d difference = lengthening.value - shortening.value;
  const Eigen::Matrix2d covariance = shortening.covariance + lengthening.covariance;
  std::vector<Eigen::Index> free;
  for (Eigen::Index j = 0; j < 2; ++j) {
    if (covariance(j, j) > 0.0) free.push_back(j);
  }
  // Data without noise leave differences from rounding alone: a thousandth rejects nothing.
  constexpr double kRounding = 1e-3;
  Eigen::MatrixXd of_free = covariance(free, free);
  for (std::size_t i = 0; i < free.size(); ++i)
    of_free(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) +=
        std::pow(kRounding * shortening.value[free[i]], 2);
  if (free.empty() || !(of_free.determinant() > 0.0)) return "";
  const Eigen::VectorXd d = difference(free);
  const double wald = d.dot(of_free.inverse() * d);
  const double p = math::chi_squared_tail(wald, static_cast<double>(free.size()));
  result.branch_tests.push_back({muscle, difference[0], difference[1], wald, p});
  if (!(p < kReject)) return "";
  std::string how = p < 0.001 ? "p < 0.001" : fmt::format("p = {:.3f}", p);
  std::string says = fmt::format(
      "{}: shortening and lengthening give different l0 or l_sh (by {:+.1f} and {:+.1f} mm, {}): one muscle has one of "
      "each, so the model or the data are wrong for it, and none of its numbers is called identified",
      muscle, 1000.0 * difference[0], 1000.0 * difference[1], how);
  result.warnings.push_back({.code = RemarkCode::branches_differ, .about = muscle, .says = std::move(says)});
  return how;
}

/// Adds the table of minima, and a warning if the given start missed the lowest one.
void add_basins(const StudyData& data,
                std::size_t muscle,
                bool shortening,
                const PaperOptions& options,
                IdentificationResult& result) {
  BasinTable table = find_paper_basins(data, muscle, shortening, options.multistart);
  if (table.basins.empty()) return;
  const BasinRow& best = table.basins.front();
  if (!best.given && best.converged > 0)
    result.warnings.push_back(
        {.code = RemarkCode::lower_minimum,
         .about = table.fit,
         .says = fmt::format("{}: {} of {} starts end lower than the given one, whose numbers stand, as published",
                             table.fit, best.starts, table.starts)});
  result.basins.push_back(std::move(table));
}

/// Returns the numbers of all muscles in one branch.
std::vector<muscle::HillParameters<double>> in_branch(const StudyData& data,
                                                      const IdentificationResult& result,
                                                      FitCase branch) {
  std::vector<muscle::HillParameters<double>> muscles = result.muscles;
  for (const ParameterEstimate& e : result.estimates) {
    if (e.fit_case != branch || !std::isfinite(e.estimate)) continue;
    for (std::size_t k = 0; k < muscles.size(); ++k)
      if (data.muscles[k].name == e.muscle) muscles[k].*muscle::hill_field(e.parameter).member = e.estimate;
  }
  return muscles;
}

/// Predicts forces and torques of a trial by the starting and the identified numbers.
TrialFit predicted(const StudyData& data, const TrialData& trial, const IdentificationResult& result) {
  TrialFit fit = unfitted_trial(trial);
  std::vector<muscle::HillParameters<double>> literature;
  for (const MuscleSetup& setup : data.muscles) literature.push_back(setup.start);
  const auto force_n = [&](const auto& muscles) { return predict(data, trial, muscles, 0.0).force_n; };
  fit.literature_force_n = force_n(literature);
  fit.force_fit_n = (trial.velocity_mps.array() <= 0.0)
                        .select(force_n(in_branch(data, result, FitCase::shortening)),
                                force_n(in_branch(data, result, FitCase::lengthening)));
  add_torques_of_forces(trial, fit);
  return fit;
}

}  // namespace

IdentificationResult identify_paper(const StudyData& data, const PaperOptions& options) {
  validate(data);
  const auto begin = std::chrono::steady_clock::now();
  IdentificationResult result;
  std::vector<ParameterEstimate> minima;
  result.method = Method::paper;
  result.termination = math::Termination::converged;
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    result.muscles.push_back(data.muscles[k].start);
    if (!covers(options.muscles, data.muscles[k].name)) continue;
    const std::array cases{fit_case(data, k, true, result), fit_case(data, k, false, result)};
    for (const bool branch : {true, false}) {
      if (options.multistart > 1) add_basins(data, k, branch, options, result);
    }
    const std::optional<CaseShape> shortening = shape_of(cases[0]), lengthening = shape_of(cases[1]);
    const std::string refuted =
        shortening && lengthening ? compare_branches(data.muscles[k].name, *shortening, *lengthening, result) : "";
    for (const std::optional<CaseFit>& of : cases) {
      if (of) add_estimates(*of, options.shared_forces, refuted, result, minima);
    }
  }
  if (!result.message.empty()) result.termination = math::Termination::no_descent;
  result.diagnoses = signatures(minima);
  for (const TrialData& trial : data.trials) result.trials.push_back(predicted(data, trial, result));
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace myoid::fit
