#include "myoid/intervals/estimate_rows.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "myoid/intervals/estimate_remarks.h"
#include "myoid/intervals/identifiability.h"
#include "myoid/intervals/product_estimate.h"
#include "myoid/intervals/verdict_rules.h"
#include "myoid/math/statistics.h"

namespace myoid::identification {
namespace {

/// Relative change of a value below which no remark is made.
constexpr double kSubstance = 0.05;

/// Makes the rows of one solution.
struct RowMaker {
  const Estimator& estimator;
  const Estimator::Solution& solution;
  const StudyData& data;
  const Intervals& intervals;
  const IdentificationResult& fit;
  const ParameterMap& map = estimator.model().parameters();
  const Eigen::VectorXd& z = solution.search.x;
  bool exact = fit.r2 > 1.0 - 1e-10;
  std::vector<ActiveMotion> motion = active_motion(data, fit.delay_s);

  [[nodiscard]] const Unknown& unknown(Eigen::Index at) const { return map.free()[static_cast<std::size_t>(at)]; }
  [[nodiscard]] bool on_bound(Eigen::Index at) const { return solution.search.at_bound[static_cast<std::size_t>(at)]; }
  [[nodiscard]] bool determined(Eigen::Index at) const {
    return intervals.sandwich.determined[static_cast<std::size_t>(at)] || unknown(at).prior.sd > 0.0;
  }

  [[nodiscard]] bool plateau_is_flat(int muscle) const {
    const Eigen::Index at = map.find(Scope::muscle, kPlateau, muscle);
    if (at < 0) return false;
    const double quantile = math::normal_quantile(0.5 + 0.5 * kReportedProbability);
    return z[at] - quantile * std::sqrt(std::max(0.0, fit.covariance(at, at))) < kVerdictRules.flat_plateau;
  }

  /// Returns true if the force-length width is on a bound of physiology, not of the study.
  [[nodiscard]] bool width_leans(int muscle) const {
    const Eigen::Index at = map.find(Scope::muscle, kWidth, muscle);
    if (at < 0 || exact) return false;
    const Unknown& width = unknown(at);
    const bool low = z[at] - width.bounds.lower <= width.bounds.upper - z[at];
    return on_bound(at) && !(low ? width.lower_is_given : width.upper_is_given);
  }

  /// Returns the trial without which the value would leave its own interval and change by more than
  /// kSubstance; empty: none.
  [[nodiscard]] std::string rests_on(const RowScale& row, const ParameterEstimate& e, Eigen::Index at) const {
    if (!e.ci_low || !e.ci_high) return "";
    const Sandwich& sandwich = intervals.sandwich;
    const double half = 0.5 * std::abs(z_of(row, *e.ci_high) - z_of(row, *e.ci_low));
    const double substance = kSubstance * (row.parameter->field->logarithmic ? 1.0 : std::abs(z[at]));
    Eigen::Index trial = 0;
    const Eigen::VectorXd shift = sandwich.trial_shift.row(at).cwiseAbs().transpose();
    if (shift.size() < 2 || !(shift.maxCoeff(&trial) > std::max(half, substance))) return "";
    const int number = sandwich.trials[static_cast<std::size_t>(trial)];
    return data.trials[static_cast<std::size_t>(number)].name;
  }

  [[nodiscard]] ParameterEstimate of_unknown(Eigen::Index at, const Unknown::Target& target) const {
    const Unknown& p = unknown(at);
    const RowScale row{&p, target.ratio};
    const double tendons = intervals.tendon_shift.row(at).squaredNorm();
    const double sd = std::sqrt(std::max(0.0, fit.covariance(at, at)) + tendons);
    ParameterEstimate e = row_of(p, target, map, z[at]);
    e.at_bound = on_bound(at);
    if (determined(at) && std::isfinite(sd)) {
      e.std_error = p.field->logarithmic ? e.estimate * sd : std::abs(target.ratio) * sd;
      add_routes(e, row, intervals, at, z[at]);
    }
    if (p.prior.sd > 0.0) e.shrinkage = 1.0 - sd * sd / (p.prior.sd * p.prior.sd);
    VerdictContext context;
    context.tendon_share = tendons / std::max(sd * sd, 1e-300);
    context.rests_on = rests_on(row, e, at);
    return judged(std::move(e), std::move(context), at, target.owner);
  }

  [[nodiscard]] ParameterEstimate of_product(Eigen::Index at, int owner) const {
    const auto muscle = static_cast<std::size_t>(owner);
    ParameterEstimate e = product_row_of(data.muscles[muscle]);
    e.estimate = fit.values.muscles[muscle][kProduct];
    // With V_ml at 1 no force rises in lengthening, and P can leave its physical bounds.
    const muscle::Range physical = muscle::hill_field(e.parameter).bounds;
    const double inside = std::clamp(e.estimate, physical.lower, physical.upper);
    e.at_bound = inside != e.estimate;
    e.estimate = inside;
    add_product_interval(e,
                         {.curvature = map.find(Scope::muscle, kCurvature, owner),
                          .plateau = map.find(Scope::muscle, kPlateau, owner),
                          .ratio = map.find(Scope::muscle, kSlopeRatio, owner)},
                         map.free(), z, fit.covariance, intervals.bootstrap ? &*intervals.bootstrap : nullptr);
    return judged(std::move(e), {}, at, owner);
  }

  /// Adds the facts about the row's muscle to the context.
  void add_muscle(VerdictContext& v, const Unknown& p, int owner) const {
    const auto k = static_cast<std::size_t>(owner);
    const MuscleSetup& muscle = data.muscles[k];
    for (const PriorDistance& of : fit.prior_distances) {
      if (of.muscle == muscle.name) v.muscle_distance = of.distance;
    }
    const MuscleValues& values = fit.values.muscles[k];
    const double width = exact ? 0.0 : values[kWidth] / values[kFiberLength];
    if (!exact && (p.field->field == kFiberLength || p.field->field == kWidth))
      v.length_span = motion[k].length_span_m / muscle.start.optimal_fiber_length_m;
    if (p.field->field == kWidth) {
      v.relative_width = width;
    } else if (p.targets.size() == 1) {
      v.curve_width = width;
      v.width_leans = width_leans(owner);
    }
    for (std::size_t other = 0; other < data.muscles.size(); ++other) {
      if (other != k && data.muscles[other].emg_channel == muscle.emg_channel)
        v.shares_electrode_with = data.muscles[other].name;
    }
    v.speed_is_free = map.find(Scope::muscle, kSpeed, owner) >= 0;
    v.never = never_done(p, motion[k], map.find(Scope::muscle, kSlopeRatio, owner) >= 0);
    v.plateau_is_flat = plateau_is_flat(owner);
  }

  /// Returns the row with its verdict; `v` holds what is known of the row alone.
  [[nodiscard]] ParameterEstimate judged(ParameterEstimate e, VerdictContext v, Eigen::Index at, int owner) const {
    const Unknown& p = unknown(at);
    const EstimatorOptions& options = estimator.options();
    if (p.field->scope == Scope::muscle) add_muscle(v, p, owner);
    v.beforehand = known_beforehand(p, options.from_mvc);
    v.prior_is_given = p.prior_is_given;
    v.prior_of_logarithm = p.field->logarithmic;
    const bool low =
        std::abs(e.estimate - p.to_value(p.bounds.lower)) <= std::abs(e.estimate - p.to_value(p.bounds.upper));
    v.given_bound = low ? p.lower_is_given : p.upper_is_given;
    v.model_error = fit.model_error;
    v.r2 = fit.r2;
    v.prior_distance = e.prior_distance.value_or(0.0);
    v.determined = determined(at);
    v.converged = solution.search.termination == math::Termination::converged;
    v.failure = solution.search.message;
    v.from_mvc = options.from_mvc;
    judge(e, v);
    if (p.is(Scope::channel, kGain)) {
      e.verdict = Verdict::prior_dominated;
      e.reason =
          "carries the uncertainty of the EMG normalisation into the intervals of F_max; the recording cannot tell it "
          "from F_max";
    }
    return e;
  }

  [[nodiscard]] std::vector<ParameterEstimate> rows() const {
    std::vector<ParameterEstimate> rows;
    for (Eigen::Index at = 0; at < z.size(); ++at) {
      const Unknown& p = unknown(at);
      for (const Unknown::Target& target : p.targets) {
        if (p.owner == "subject" && &target != &p.targets.front()) break;
        rows.push_back(of_unknown(at, target));
      }
      agree_on_tied(rows, p.targets.size());
      if (!p.is(Scope::muscle, kSlopeRatio)) continue;
      for (const Unknown::Target& target : p.targets) rows.push_back(of_product(at, target.owner));
    }
    return rows;
  }
};

}  // namespace

ParameterEstimate row_of(const Unknown& p, const Unknown::Target& target, const ParameterMap& map, double z) {
  const RowScale row{&p, target.ratio};
  ParameterEstimate e;
  e.method = "torque";
  e.fit_case = "both";
  e.muscle = map.owner_name(p, target.owner);
  if (&target != &p.targets.front()) e.tied_to = map.owner_name(p, p.targets.front().owner);
  e.parameter = std::string(p.field->name);
  e.unit = p.field->unit;
  e.initial = row.value(p.start);
  e.estimate = row.value(z);
  if (p.prior.sd > 0.0) {
    e.prior_mean = row.value(p.prior.mean);
    e.prior_sd = p.field->logarithmic ? *e.prior_mean * p.prior.sd : std::abs(target.ratio) * p.prior.sd;
    e.prior_distance = distance_from_prior(p, z);
  }
  return e;
}

ParameterEstimate product_row_of(const MuscleSetup& muscle) {
  ParameterEstimate e;
  e.method = "torque";
  e.fit_case = "both";
  e.muscle = muscle.name;
  e.parameter = "eccentric_curvature_product";
  e.initial = muscle.start.eccentric_curvature_product;
  return e;
}

std::vector<ParameterEstimate> estimate_rows(const Estimator& estimator,
                                             const Estimator::Solution& solution,
                                             const StudyData& data,
                                             const Intervals& intervals,
                                             const IdentificationResult& fit) {
  return RowMaker{estimator, solution, data, intervals, fit}.rows();
}

}  // namespace myoid::identification
