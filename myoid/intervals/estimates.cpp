#include "myoid/intervals/estimates.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/intervals/discrepancy.h"
#include "myoid/intervals/estimate_remarks.h"
#include "myoid/intervals/held_tendon.h"
#include "myoid/intervals/identifiability.h"
#include "myoid/intervals/product_estimate.h"
#include "myoid/intervals/profile_likelihood.h"
#include "myoid/intervals/reported_interval.h"
#include "myoid/intervals/signatures.h"
#include "myoid/intervals/uncertainty.h"
#include "myoid/math/statistics.h"

namespace myoid::identification {
namespace {

/// Relative change of a value that is worth a remark.
constexpr double kSubstance = 0.05;

/// R2 of the residual model's own rows, the least of all joints.
double explained_share(const ResidualModel& model, const Eigen::VectorXd& z) {
  Evaluation at;
  model.evaluate(z, ResidualModel::Depth::value, at);
  double least = 1.0;
  for (int joint = 0; joint < model.joint_count(); ++joint) {
    std::vector<Eigen::Index> rows;
    for (const Piece& piece : model.pieces()) {
      for (Eigen::Index i = 0; piece.joint == joint && i < piece.count; ++i)
        rows.push_back(piece.first + i);
    }
    if (rows.empty()) continue;
    const Eigen::VectorXd measured = model.measured()(rows);
    const Eigen::VectorXd off = measured.array() - measured.mean();
    // A torque that does not change has nothing to explain but itself.
    const double total = off.squaredNorm() > 1e-6 * measured.squaredNorm() ? off.squaredNorm()
                                                                           : measured.squaredNorm();
    if (total > 0.0)
      least = std::min(least, 1.0 - (at.predicted(rows) - measured).squaredNorm() / total);
  }
  return least;
}

}  // namespace

void report_estimates(const Estimator& estimator,
                      const Estimator::Solution& solution,
                      const StudyData& data,
                      const EstimateContext& context,
                      IdentificationResult& result) {
  const EstimatorOptions& options = estimator.options();
  const ResidualModel& model = estimator.model();
  const std::vector<FreeParameter>& free = estimator.free();
  const Eigen::VectorXd& z = solution.search.x;
  result.method = context.method;
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
  result.lag = options.lag;
  result.r2 = explained_share(model, z);
  for (const MuscleValues& values : result.values.muscles)
    result.muscles.push_back(hill_parameters(values));
  result.delay_s = result.values.channels.front()[kDelay];

  Intervals intervals;
  intervals.sandwich = sandwich(estimator, solution);
  result.covariance = intervals.sandwich.newey_west +
                      intervals.sandwich.by_noise * intervals.sandwich.by_noise.transpose();
  if (options.model_error && options.weights) {
    intervals.model_error = discrepancy(estimator, solution, intervals.sandwich.model_based);
    result.covariance += intervals.model_error->covariance;
    result.model_error = intervals.model_error->relative_size;
  }
  intervals.tendon_shift = held_tendon_shift(estimator, solution, data);
  result.condition = intervals.sandwich.condition;
  if (options.intervals.bootstrap > 0) {
    intervals.bootstrap = bootstrap(estimator, solution);
    result.bootstrap_replicates = static_cast<int>(intervals.bootstrap->replicates.rows());
    result.bootstrap_failed = intervals.bootstrap->failed;
  }
  if (options.intervals.profile)
    intervals.profiles = profile(estimator, solution, intervals.sandwich.newey_west.diagonal());

  const double quantile = math::normal_quantile(0.5 + 0.5 * kReportedProbability);
  const auto muscles = data.muscles.size();
  std::vector<bool> flat(muscles, false);
  std::vector<ProductPositions> positions(muscles);
  for (std::size_t j = 0; j < free.size(); ++j) {
    if (free[j].field->scope != Scope::muscle) continue;
    const auto at = static_cast<Eigen::Index>(j);
    for (const FreeParameter::Target& target : free[j].targets) {
      ProductPositions& p = positions[static_cast<std::size_t>(target.owner)];
      if (free[j].field->field == kCurvature) p.curvature = at;
      if (free[j].field->field == kSlopeRatio) p.ratio = at;
      if (free[j].field->field != kPlateau) continue;
      p.plateau = at;
      flat[static_cast<std::size_t>(target.owner)] =
          z[at] - quantile * std::sqrt(std::max(0.0, result.covariance(at, at))) <
          VerdictRules{}.flat_plateau;
    }
  }
  result.prior_distances = prior_distances(free, z, data);
  RouteRemarks routes;
  const bool exact = result.r2 > 1.0 - 1e-10;
  const std::vector<ActiveMotion> motion = active_motion(data, result.delay_s);
  const auto unknown = [&](int field, int muscle) {
    return std::find_if(free.begin(), free.end(), [&](const FreeParameter& p) {
      return p.field->scope == Scope::muscle && p.field->field == field &&
             std::any_of(p.targets.begin(), p.targets.end(),
                         [&](const auto& target) { return target.owner == muscle; });
    });
  };
  const auto is_free = [&](int field, int muscle) { return unknown(field, muscle) != free.end(); };
  // On a bound that is nobody's but physiology's.
  const auto width_leans = [&](int muscle) {
    const auto width = unknown(kWidth, muscle);
    if (width == free.end() || exact) return false;
    const auto at = static_cast<std::size_t>(width - free.begin());
    const double z_at = z[static_cast<Eigen::Index>(at)];
    return solution.search.at_bound[at] &&
           !(z_at - width->lower <= width->upper - z_at ? width->lower_is_given
                                                        : width->upper_is_given);
  };
  const auto judged = [&](ParameterEstimate e, const FreeParameter& p, bool determined, int owner,
                          const std::string& rests_on, double tendon_share) {
    VerdictContext v;
    v.rests_on = rests_on;
    v.tendon_share = tendon_share;
    if (p.field->scope == Scope::muscle) {
      const auto k = static_cast<std::size_t>(owner);
      for (const PriorDistance& of : result.prior_distances) {
        if (of.muscle == data.muscles[k].name) v.muscle_distance = of.distance;
      }
      const MuscleValues& values = result.values.muscles[k];
      const double width = exact ? 0.0 : values[kWidth] / values[kFiberLength];
      if (!exact && (p.field->field == kFiberLength || p.field->field == kWidth))
        v.length_span = motion[k].length_span_m / data.muscles[k].start.optimal_fiber_length_m;
      if (p.field->field == kWidth) {
        v.relative_width = width;
      } else if (p.targets.size() == 1) {
        v.curve_width = width;
        v.width_leans = width_leans(owner);
      }
      for (std::size_t other = 0; other < muscles; ++other) {
        if (other != k && data.muscles[other].emg_channel == data.muscles[k].emg_channel)
          v.shares_electrode_with = data.muscles[other].name;
      }
    }
    if (p.field->scope == Scope::muscle) {
      v.speed_is_free = is_free(kSpeed, owner);
      v.never = never_done(p, motion[static_cast<std::size_t>(owner)], is_free(kSlopeRatio, owner));
    }
    v.beforehand = known_beforehand(p, options.from_mvc);
    v.prior_is_given = p.prior_is_given;
    v.prior_of_logarithm = p.field->logarithmic;
    const bool low =
        std::abs(e.estimate - p.to_value(p.lower)) <= std::abs(e.estimate - p.to_value(p.upper));
    v.given_bound = low ? p.lower_is_given : p.upper_is_given;
    v.model_error = result.model_error;
    v.r2 = result.r2;
    v.prior_distance = e.prior_distance.value_or(0.0);
    v.determined = determined;
    v.converged = solution.search.termination == math::Termination::converged;
    v.failure = solution.search.message;
    v.from_mvc = options.from_mvc;
    v.plateau_is_flat = p.field->scope == Scope::muscle && flat[static_cast<std::size_t>(owner)];
    judge(e, v);
    if (p.field->scope == Scope::channel && p.field->field == kGain) {
      e.verdict = Verdict::prior_dominated;
      e.reason =
          "carries the uncertainty of the EMG normalisation into the intervals of F_max; the "
          "recording cannot tell it from F_max";
    }
    routes.compare(e);
    result.estimates.push_back(std::move(e));
  };
  const auto owner_name = [&](const FreeParameter& p, const FreeParameter::Target& target) {
    const auto k = static_cast<std::size_t>(target.owner);
    if (p.owner == "subject") return p.owner;
    return p.field->scope == Scope::muscle    ? data.muscles[k].name
           : p.field->scope == Scope::channel ? model.parameters().channels()[k]
                                              : model.parameters().joints()[k];
  };
  for (std::size_t j = 0; j < free.size(); ++j) {
    const FreeParameter& p = free[j];
    const auto at = static_cast<Eigen::Index>(j);
    result.free_parameters.push_back(p.label);
    const double sd = std::sqrt(std::max(0.0, result.covariance(at, at)) +
                                intervals.tendon_shift.row(at).squaredNorm());
    const bool determined = intervals.sandwich.determined[j] || p.prior_sd > 0.0;
    for (const FreeParameter::Target& target : p.targets) {
      if (p.owner == "subject" && &target != &p.targets.front()) break;
      const RowScale row{&p, target.ratio};
      ParameterEstimate e;
      e.method = context.method;
      e.fit_case = "both";
      e.muscle = owner_name(p, target);
      if (&target != &p.targets.front()) e.tied_to = owner_name(p, p.targets.front());
      e.parameter = std::string(p.field->name);
      e.unit = p.field->unit;
      e.initial = row.value(p.start);
      e.estimate = row.value(z[at]);
      e.at_bound = solution.search.at_bound[j];
      if (determined && std::isfinite(sd)) {
        e.std_error = p.field->logarithmic ? e.estimate * sd : std::abs(target.ratio) * sd;
        add_routes(e, row, intervals, at, z[at]);
      }
      if (p.prior_sd > 0.0) {
        e.prior_mean = row.value(p.prior_mean);
        e.prior_sd =
            p.field->logarithmic ? *e.prior_mean * p.prior_sd : std::abs(target.ratio) * p.prior_sd;
        e.shrinkage = 1.0 - sd * sd / (p.prior_sd * p.prior_sd);
        e.prior_distance = distance_from_prior(p, z[at]);
      }
      std::string rests_on;
      if (e.ci_low && e.ci_high) {
        // Without which trial the value would leave its own interval, and by a matter of substance.
        const double half = 0.5 * std::abs(z_of(row, *e.ci_high) - z_of(row, *e.ci_low));
        const double substance = kSubstance * (p.field->logarithmic ? 1.0 : std::abs(z[at]));
        Eigen::Index trial = 0;
        const Eigen::VectorXd shift = intervals.sandwich.trial_shift.row(at).cwiseAbs().transpose();
        if (shift.size() > 1 && shift.maxCoeff(&trial) > std::max(half, substance))
          rests_on = data.trials[static_cast<std::size_t>(
                                     intervals.sandwich.trials[static_cast<std::size_t>(trial)])]
                         .name;
      }
      judged(std::move(e), p, determined, target.owner, rests_on,
             intervals.tendon_shift.row(at).squaredNorm() / std::max(sd * sd, 1e-300));
    }
    agree_on_tied(result.estimates, p.targets.size());
    // Where the slope ratio is the unknown, the product follows.
    if (p.field->scope != Scope::muscle || p.field->field != kSlopeRatio) continue;
    for (const FreeParameter::Target& target : p.targets) {
      const auto k = static_cast<std::size_t>(target.owner);
      const ProductPositions& where = positions[k];
      ParameterEstimate e;
      e.method = context.method;
      e.fit_case = "both";
      e.muscle = data.muscles[k].name;
      e.parameter = "eccentric_curvature_product";
      e.initial = data.muscles[k].start.eccentric_curvature_product;
      e.estimate = result.values.muscles[k][kProduct];
      // Where V_ml leans on 1 nothing rises, and P follows to where no muscle is: on its bound.
      const muscle::Range physical = muscle::hill_field(e.parameter).bounds;
      const double inside = std::clamp(e.estimate, physical.lower, physical.upper);
      e.at_bound = inside != e.estimate;
      e.estimate = inside;
      add_product_interval(e, where, free, z, result.covariance,
                           intervals.bootstrap ? &*intervals.bootstrap : nullptr);
      judged(std::move(e), p, determined, target.owner, "", 0.0);
    }
  }

  routes.add_to(result.warnings, result.estimates.size());

  const auto is_gain = [&](Eigen::Index j) {
    const ParameterField& field = *free[static_cast<std::size_t>(j)].field;
    return field.scope == Scope::channel && field.field == kGain;
  };
  const auto label = [&](Eigen::Index j) { return free[static_cast<std::size_t>(j)].label; };
  for (const CollinearSet& set : collinear_sets(intervals.sandwich.information)) {
    // A gain is a nuisance that is known to go with F_max.
    if (std::any_of(set.parameters.begin(), set.parameters.end(), is_gain)) continue;
    std::vector<std::string> names;
    for (const Eigen::Index j : set.parameters) names.push_back(label(j));
    result.collinear.push_back(
        fmt::format("{} (collinearity index {:.0f})", fmt::join(names, ", "), set.index));
  }
  for (Eigen::Index k = 0; k < intervals.sandwich.undetermined.cols(); ++k) {
    std::vector<std::string> parts;
    for (Eigen::Index j = 0; j < z.size(); ++j) {
      const double share = intervals.sandwich.undetermined(j, k);
      if (std::abs(share) > 0.05) parts.push_back(fmt::format("{:+.2f} {}", share, label(j)));
    }
    result.undetermined.push_back(fmt::format("{}", fmt::join(parts, " ")));
  }
  if (options.weights && options.correct_attenuation && !solution.weighting.corrected) {
    result.warnings.push_back(
        "the noise of the EMG is too large against what the recording tells of the muscles' "
        "torques "
        "for its effect on the strengths to be taken out: they may come out too weak, above all "
        "where muscles work against each other");
  }
  if (result.r2 < VerdictRules{}.least_r2) {
    result.warnings.push_back(fmt::format(
        "the fit explains little of what it was fitted to (R2 {:.2f}): no number is called "
        "identified; look for a wrong sign, unit, order of files or column",
        result.r2));
  }
  if (result.model_error > VerdictRules{}.model_error) {
    result.warnings.push_back(
        fmt::format("what the model leaves of the torque depends on posture, effort and speed as "
                    "if it were wrong "
                    "by {:.0f} %: the estimates describe the fit rather than the muscles, and the "
                    "truth may lie "
                    "outside the intervals",
                    100.0 * result.model_error));
  }
  add_distances_to(result.warnings, result.prior_distances);
  if (result.bootstrap_failed > 0) {
    result.warnings.push_back(fmt::format("{} of {} bootstrap replicates did not converge",
                                          result.bootstrap_failed,
                                          result.bootstrap_failed + result.bootstrap_replicates));
  }
  if (result.termination == math::Termination::converged)
    result.diagnoses = signatures(result.estimates);
}

}  // namespace myoid::identification
