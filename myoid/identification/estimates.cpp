#include "myoid/identification/estimates.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/identification/discrepancy.h"
#include "myoid/identification/estimate_remarks.h"
#include "myoid/identification/identifiability.h"
#include "myoid/identification/profile_likelihood.h"
#include "myoid/identification/uncertainty.h"
#include "myoid/math/statistics.h"

namespace myoid::identification {
namespace {

constexpr double kProbability = 0.95;  ///< Of every interval.

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

struct Intervals {
  Sandwich sandwich;
  std::optional<Discrepancy> model_error;
  std::optional<BootstrapResult> bootstrap;
  std::optional<std::vector<Interval>> profiles;
};

/// Scale of a row: what a number of the solver is in the row's unit.
struct RowScale {
  const FreeParameter* parameter = nullptr;
  double ratio = 1.0;
  [[nodiscard]] double value(double z) const { return ratio * parameter->to_value(z); }
};

/// The solver's number of a value of this row.
double z_of(const RowScale& row, double value) {
  const double x = value / row.ratio;
  return row.parameter->field->logarithmic ? std::log(std::max(x, 1e-300)) : x;
}

void add_routes(ParameterEstimate& e,
                const RowScale& row,
                const Intervals& intervals,
                Eigen::Index at,
                double z,
                double quantile) {
  const FreeParameter& p = *row.parameter;
  const auto clipped = [&](double x) { return row.value(std::clamp(x, p.lower, p.upper)); };
  const auto normal = [&](const std::string& route, double variance) {
    const double sd = std::sqrt(std::max(0.0, variance));
    if (!std::isfinite(sd)) return;
    // A bound is knowledge, too: no interval reaches where no muscle lives.
    e.routes.push_back({route, clipped(z - quantile * sd), clipped(z + quantile * sd)});
  };
  normal("sandwich", intervals.sandwich.newey_west(at, at));
  if (intervals.sandwich.cluster) normal("cluster", (*intervals.sandwich.cluster)(at, at));
  if (intervals.sandwich.jackknife) normal("jackknife", (*intervals.sandwich.jackknife)(at, at));
  const auto add = [&](const std::string& route, const Interval& interval) {
    RouteInterval r{route, {}, {}};
    if (interval.low) r.low = clipped(*interval.low);
    if (interval.high) r.high = clipped(*interval.high);
    if (r.low || r.high || route == "profile") e.routes.push_back(r);
  };
  const auto index = static_cast<std::size_t>(at);
  if (intervals.bootstrap) add("bootstrap", intervals.bootstrap->intervals[index]);
  if (intervals.profiles) add("profile", (*intervals.profiles)[index]);

  // The interval that is reported: to either side the farther of sandwich and profile, with the
  // model's error on top, but never less than trials show that differ by both. Of few trials that
  // is the jackknife, which is never too small.
  const auto reach = [&](double variance) { return quantile * std::sqrt(std::max(0.0, variance)); };
  double below = reach(intervals.sandwich.newey_west(at, at));
  double above = below;
  if (intervals.profiles) {
    const Interval& profile = (*intervals.profiles)[index];
    below = std::max(below, z - profile.low.value_or(p.lower));
    above = std::max(above, profile.high.value_or(p.upper) - z);
  }
  double least = 0.0;
  if (intervals.sandwich.cluster) {
    least = reach((*intervals.sandwich.cluster)(at, at));
  } else if (intervals.sandwich.jackknife) {
    least = reach((*intervals.sandwich.jackknife)(at, at));
  }
  if (!std::isfinite(below) || !std::isfinite(above)) return;
  const auto whole = [&](double half) {
    const double noise = half / quantile;
    const double variance = noise * noise + std::pow(intervals.sandwich.by_noise[at], 2);
    return std::max(least, intervals.model_error
                               ? intervals.model_error->reach(at, variance, kProbability)
                               : quantile * std::sqrt(variance));
  };
  e.ci_low = clipped(z - whole(below));
  e.ci_high = clipped(z + whole(above));
}

/// Draws from a normal distribution with this covariance, the same in every run.
Eigen::MatrixXd draws_about(const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance, int n) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
  const Eigen::MatrixXd root =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  Eigen::MatrixXd result(n, mean.size());
  // Quasi-random: the additive recurrence with square roots of primes, through the normal quantile.
  const double primes[] = {2.0, 3.0, 5.0};
  for (int i = 0; i < n; ++i) {
    Eigen::VectorXd u(mean.size());
    for (Eigen::Index j = 0; j < mean.size(); ++j) {
      const double x = (i + 0.5) * std::sqrt(primes[j % 3]) + 0.37 * static_cast<double>(j);
      u[j] = math::normal_quantile(std::clamp(x - std::floor(x), 1e-6, 1.0 - 1e-6));
    }
    result.row(i) = (mean + root * u).transpose();
  }
  return result;
}

/// Standard deviation of ln x and quantiles of x.
struct Spread {
  double log_sd = 0.0;
  double low = 0.0, high = 0.0;
};

Spread spread_of(std::vector<double> logs) {
  std::sort(logs.begin(), logs.end());
  const auto at = [&](double share) {
    return logs[static_cast<std::size_t>(share * static_cast<double>(logs.size() - 1))];
  };
  // Robust: the far tail is where V_ml comes down to 1 and the logarithm has no end.
  return {(at(0.8413) - at(0.1587)) / 2.0, std::exp(at(0.025)), std::exp(at(0.975))};
}

struct Positions {
  Eigen::Index curvature = -1, plateau = -1, ratio = -1;
};

/// ln P of draws of (ln V_sh, V_ml, ln S).
std::vector<double> log_products(const Eigen::MatrixXd& draws) {
  std::vector<double> logs;
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    const double vsh = std::exp(draws(i, 0));
    const double rise = std::max(draws(i, 1) - 1.0, 0.002);
    logs.push_back(std::log(rise) + draws(i, 0) - draws(i, 2) - std::log1p(vsh));
  }
  return logs;
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
  result.dynamics = options.dynamics;
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
  result.condition = intervals.sandwich.condition;
  if (options.intervals.bootstrap > 0) {
    intervals.bootstrap = bootstrap(estimator, solution);
    result.bootstrap_replicates = static_cast<int>(intervals.bootstrap->replicates.rows());
    result.bootstrap_failed = intervals.bootstrap->failed;
  }
  if (options.intervals.profile) intervals.profiles = profile(estimator, solution);

  const double quantile = math::normal_quantile(0.5 + 0.5 * kProbability);
  const auto muscles = data.muscles.size();
  std::vector<bool> flat(muscles, false);
  std::vector<Positions> positions(muscles);
  for (std::size_t j = 0; j < free.size(); ++j) {
    if (free[j].field->scope != Scope::muscle) continue;
    const auto at = static_cast<Eigen::Index>(j);
    for (const FreeParameter::Target& target : free[j].targets) {
      Positions& p = positions[static_cast<std::size_t>(target.owner)];
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
  const auto judged = [&](ParameterEstimate e, const FreeParameter& p, bool determined, int owner,
                          const std::string& rests_on) {
    VerdictContext v;
    v.rests_on = rests_on;
    if (p.field->scope == Scope::muscle) {
      const auto k = static_cast<std::size_t>(owner);
      for (const PriorDistance& of : result.prior_distances) {
        if (of.muscle == data.muscles[k].name) v.muscle_distance = of.distance;
      }
      const MuscleValues& values = result.values.muscles[k];
      const double width = exact ? 0.0 : values[kWidth] / values[kFiberLength];
      if (p.field->field == kWidth) {
        v.relative_width = width;
      } else if (p.targets.size() == 1) {
        v.curve_width = width;
      }
      for (std::size_t other = 0; other < muscles; ++other) {
        if (other != k && data.muscles[other].emg_channel == data.muscles[k].emg_channel)
          v.shares_electrode_with = data.muscles[other].name;
      }
    }
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
    const double sd = std::sqrt(std::max(0.0, result.covariance(at, at)));
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
        add_routes(e, row, intervals, at, z[at], quantile);
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
      judged(std::move(e), p, determined, target.owner, rests_on);
    }
    agree_on_tied(result.estimates, p.targets.size());
    // Where the slope ratio is the unknown, the product follows.
    if (p.field->scope != Scope::muscle || p.field->field != kSlopeRatio) continue;
    for (const FreeParameter::Target& target : p.targets) {
      const auto k = static_cast<std::size_t>(target.owner);
      const Positions& where = positions[k];
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
      if (where.curvature >= 0 && where.plateau >= 0) {
        const std::vector<Eigen::Index> three{where.curvature, where.plateau, at};
        constexpr int kDraws = 2000;
        const Spread posterior =
            spread_of(log_products(draws_about(z(three), result.covariance(three, three), kDraws)));
        e.std_error = e.estimate * posterior.log_sd;
        e.ci_low = posterior.low;
        e.ci_high = posterior.high;
        e.routes.push_back({"sandwich", e.ci_low, e.ci_high});
        if (intervals.bootstrap && intervals.bootstrap->replicates.rows() >= 40) {
          const Spread boot =
              spread_of(log_products(intervals.bootstrap->replicates(Eigen::all, three)));
          e.routes.push_back({"bootstrap", boot.low, boot.high});
        }
        Eigen::Vector3d mean = z(three);
        Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
        bool all_priors = true;
        for (int i = 0; i < 3; ++i) {
          const FreeParameter& f =
              free[static_cast<std::size_t>(three[static_cast<std::size_t>(i)])];
          all_priors = all_priors && f.prior_sd > 0.0;
          mean[i] = f.prior_mean;
          spread(i, i) = f.prior_sd * f.prior_sd;
        }
        if (all_priors) {
          const Spread prior = spread_of(log_products(draws_about(mean, spread, kDraws)));
          e.prior_mean = std::exp(std::log(std::max(mean[1] - 1.0, 0.002)) + mean[0] - mean[2] -
                                  std::log1p(std::exp(mean[0])));
          e.prior_sd = *e.prior_mean * prior.log_sd;
          e.shrinkage = 1.0 - std::pow(posterior.log_sd / prior.log_sd, 2);
        }
      }
      judged(std::move(e), p, determined, target.owner, "");
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
  diagnose(result);
}

}  // namespace myoid::identification
