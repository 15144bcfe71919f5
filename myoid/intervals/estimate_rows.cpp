#include "myoid/intervals/estimate_rows.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "myoid/intervals/estimate_remarks.h"
#include "myoid/intervals/identifiability.h"
#include "myoid/intervals/product_estimate.h"
#include "myoid/math/statistics.h"

namespace myoid::identification {
namespace {

/// Relative change of a value below which no remark is made.
constexpr double kSubstance = 0.05;

/// One row, with two facts about its uncertainty that its verdict needs.
struct UnjudgedRow {
  ParameterEstimate estimate;
  std::string rests_on;       ///< VerdictContext::rests_on.
  double tendon_share = 0.0;  ///< VerdictContext::tendon_share.
};

/// Makes the rows of one solution.
class RowMaker {
 public:
  RowMaker(const Estimator& estimator,
           const Estimator::Solution& solution,
           const StudyData& data,
           const Intervals& intervals,
           const IdentificationResult& fit)
      : estimator_(estimator),
        solution_(solution),
        data_(data),
        intervals_(intervals),
        fit_(fit),
        z_(solution.search.x),
        exact_(fit.r2 > 1.0 - 1e-10),
        motion_(active_motion(data, fit.delay_s)) {}

  [[nodiscard]] std::vector<ParameterEstimate> rows() const;

 private:
  [[nodiscard]] const Unknown& unknown(Eigen::Index at) const {
    return estimator_.free()[static_cast<std::size_t>(at)];
  }
  /// Returns the solver's variable of a muscle's number; empty for a held number.
  [[nodiscard]] std::optional<Eigen::Index> position(int field, int muscle) const;
  [[nodiscard]] bool plateau_is_flat(int muscle) const;
  /// Returns true if the force-length width is on a bound of physiology, not of the study.
  [[nodiscard]] bool width_leans(int muscle) const;
  [[nodiscard]] std::string owner_name(const Unknown& p, const Unknown::Target& target) const;
  /// Returns the trial without which the value would leave its own interval and change by more than
  /// kSubstance; empty: none.
  [[nodiscard]] std::string rests_on(const RowScale& row, const ParameterEstimate& e, Eigen::Index at) const;
  [[nodiscard]] double standard_deviation(Eigen::Index at) const;
  [[nodiscard]] bool determined(Eigen::Index at) const;
  [[nodiscard]] UnjudgedRow row_of_unknown(Eigen::Index at, const Unknown::Target& target) const;
  [[nodiscard]] UnjudgedRow row_of_product(std::size_t muscle) const;
  /// Adds the facts about the row's muscle to the context.
  void add_muscle(VerdictContext& v, const Unknown& p, int owner) const;
  [[nodiscard]] VerdictContext context_of(const UnjudgedRow& row, Eigen::Index at, int owner) const;
  [[nodiscard]] ParameterEstimate judged(UnjudgedRow row, Eigen::Index at, int owner) const;

  const Estimator& estimator_;
  const Estimator::Solution& solution_;
  const StudyData& data_;
  const Intervals& intervals_;
  const IdentificationResult& fit_;
  const Eigen::VectorXd& z_;
  bool exact_;
  std::vector<ActiveMotion> motion_;
};

std::optional<Eigen::Index> RowMaker::position(int field, int muscle) const {
  for (Eigen::Index at = 0; at < z_.size(); ++at) {
    if (unknown(at).is(Scope::muscle, field) && unknown(at).acts_on(muscle)) return at;
  }
  return std::nullopt;
}

bool RowMaker::plateau_is_flat(int muscle) const {
  const auto at = position(kPlateau, muscle);
  if (!at) return false;
  const double quantile = math::normal_quantile(0.5 + 0.5 * kReportedProbability);
  return z_[*at] - quantile * std::sqrt(std::max(0.0, fit_.covariance(*at, *at))) < VerdictRules{}.flat_plateau;
}

bool RowMaker::width_leans(int muscle) const {
  const auto at = position(kWidth, muscle);
  if (!at || exact_) return false;
  const Unknown& width = unknown(*at);
  const bool low = z_[*at] - width.bounds.lower <= width.bounds.upper - z_[*at];
  return solution_.search.at_bound[static_cast<std::size_t>(*at)] &&
         !(low ? width.lower_is_given : width.upper_is_given);
}

std::string RowMaker::owner_name(const Unknown& p, const Unknown::Target& target) const {
  const auto k = static_cast<std::size_t>(target.owner);
  if (p.owner == "subject") return p.owner;
  const ParameterMap& parameters = estimator_.model().parameters();
  return p.field->scope == Scope::muscle    ? data_.muscles[k].name
         : p.field->scope == Scope::channel ? parameters.channels()[k]
                                            : parameters.joints()[k];
}

std::string RowMaker::rests_on(const RowScale& row, const ParameterEstimate& e, Eigen::Index at) const {
  if (!e.ci_low || !e.ci_high) return "";
  const Sandwich& sandwich = intervals_.sandwich;
  const double half = 0.5 * std::abs(z_of(row, *e.ci_high) - z_of(row, *e.ci_low));
  const double substance = kSubstance * (row.parameter->field->logarithmic ? 1.0 : std::abs(z_[at]));
  Eigen::Index trial = 0;
  const Eigen::VectorXd shift = sandwich.trial_shift.row(at).cwiseAbs().transpose();
  if (shift.size() < 2 || !(shift.maxCoeff(&trial) > std::max(half, substance))) return "";
  const int number = sandwich.trials[static_cast<std::size_t>(trial)];
  return data_.trials[static_cast<std::size_t>(number)].name;
}

double RowMaker::standard_deviation(Eigen::Index at) const {
  return std::sqrt(std::max(0.0, fit_.covariance(at, at)) + intervals_.tendon_shift.row(at).squaredNorm());
}

bool RowMaker::determined(Eigen::Index at) const {
  return intervals_.sandwich.determined[static_cast<std::size_t>(at)] || unknown(at).prior.sd > 0.0;
}

UnjudgedRow RowMaker::row_of_unknown(Eigen::Index at, const Unknown::Target& target) const {
  const Unknown& p = unknown(at);
  const double sd = standard_deviation(at);
  const RowScale row{&p, target.ratio};
  ParameterEstimate e;
  e.method = fit_.method;
  e.fit_case = "both";
  e.muscle = owner_name(p, target);
  if (&target != &p.targets.front()) e.tied_to = owner_name(p, p.targets.front());
  e.parameter = std::string(p.field->name);
  e.unit = p.field->unit;
  e.initial = row.value(p.start);
  e.estimate = row.value(z_[at]);
  e.at_bound = solution_.search.at_bound[static_cast<std::size_t>(at)];
  if (determined(at) && std::isfinite(sd)) {
    e.std_error = p.field->logarithmic ? e.estimate * sd : std::abs(target.ratio) * sd;
    add_routes(e, row, intervals_, at, z_[at]);
  }
  if (p.prior.sd > 0.0) {
    e.prior_mean = row.value(p.prior.mean);
    e.prior_sd = p.field->logarithmic ? *e.prior_mean * p.prior.sd : std::abs(target.ratio) * p.prior.sd;
    e.shrinkage = 1.0 - sd * sd / (p.prior.sd * p.prior.sd);
    e.prior_distance = distance_from_prior(p, z_[at]);
  }
  const double tendon_share = intervals_.tendon_shift.row(at).squaredNorm() / std::max(sd * sd, 1e-300);
  std::string trial = rests_on(row, e, at);
  return {std::move(e), std::move(trial), tendon_share};
}

UnjudgedRow RowMaker::row_of_product(std::size_t muscle) const {
  const int owner = static_cast<int>(muscle);
  ParameterEstimate e;
  e.method = fit_.method;
  e.fit_case = "both";
  e.muscle = data_.muscles[muscle].name;
  e.parameter = "eccentric_curvature_product";
  e.initial = data_.muscles[muscle].start.eccentric_curvature_product;
  e.estimate = fit_.values.muscles[muscle][kProduct];
  // With V_ml at 1 no force rises in lengthening, and P can leave its physical bounds.
  const muscle::Range physical = muscle::hill_field(e.parameter).bounds;
  const double inside = std::clamp(e.estimate, physical.lower, physical.upper);
  e.at_bound = inside != e.estimate;
  e.estimate = inside;
  add_product_interval(e,
                       {.curvature = position(kCurvature, owner).value_or(-1),
                        .plateau = position(kPlateau, owner).value_or(-1),
                        .ratio = position(kSlopeRatio, owner).value_or(-1)},
                       estimator_.free(), z_, fit_.covariance, intervals_.bootstrap ? &*intervals_.bootstrap : nullptr);
  return {.estimate = std::move(e), .rests_on = {}};
}

void RowMaker::add_muscle(VerdictContext& v, const Unknown& p, int owner) const {
  const auto k = static_cast<std::size_t>(owner);
  const MuscleSetup& muscle = data_.muscles[k];
  for (const PriorDistance& of : fit_.prior_distances) {
    if (of.muscle == muscle.name) v.muscle_distance = of.distance;
  }
  const MuscleValues& values = fit_.values.muscles[k];
  const double width = exact_ ? 0.0 : values[kWidth] / values[kFiberLength];
  if (!exact_ && (p.field->field == kFiberLength || p.field->field == kWidth))
    v.length_span = motion_[k].length_span_m / muscle.start.optimal_fiber_length_m;
  if (p.field->field == kWidth) {
    v.relative_width = width;
  } else if (p.targets.size() == 1) {
    v.curve_width = width;
    v.width_leans = width_leans(owner);
  }
  for (std::size_t other = 0; other < data_.muscles.size(); ++other) {
    if (other != k && data_.muscles[other].emg_channel == muscle.emg_channel)
      v.shares_electrode_with = data_.muscles[other].name;
  }
  v.speed_is_free = position(kSpeed, owner).has_value();
  v.never = never_done(p, motion_[k], position(kSlopeRatio, owner).has_value());
  v.plateau_is_flat = plateau_is_flat(owner);
}

VerdictContext RowMaker::context_of(const UnjudgedRow& row, Eigen::Index at, int owner) const {
  const Unknown& p = unknown(at);
  const ParameterEstimate& e = row.estimate;
  const EstimatorOptions& options = estimator_.options();
  VerdictContext v;
  v.rests_on = row.rests_on;
  v.tendon_share = row.tendon_share;
  if (p.field->scope == Scope::muscle) add_muscle(v, p, owner);
  v.beforehand = known_beforehand(p, options.from_mvc);
  v.prior_is_given = p.prior_is_given;
  v.prior_of_logarithm = p.field->logarithmic;
  const bool low =
      std::abs(e.estimate - p.to_value(p.bounds.lower)) <= std::abs(e.estimate - p.to_value(p.bounds.upper));
  v.given_bound = low ? p.lower_is_given : p.upper_is_given;
  v.model_error = fit_.model_error;
  v.r2 = fit_.r2;
  v.prior_distance = e.prior_distance.value_or(0.0);
  v.determined = determined(at);
  v.converged = solution_.search.termination == math::Termination::converged;
  v.failure = solution_.search.message;
  v.from_mvc = options.from_mvc;
  return v;
}

ParameterEstimate RowMaker::judged(UnjudgedRow row, Eigen::Index at, int owner) const {
  const VerdictContext context = context_of(row, at, owner);
  ParameterEstimate e = std::move(row.estimate);
  judge(e, context);
  if (unknown(at).is(Scope::channel, kGain)) {
    e.verdict = Verdict::prior_dominated;
    e.reason =
        "carries the uncertainty of the EMG normalisation into the intervals of F_max; the recording cannot tell it "
        "from F_max";
  }
  return e;
}

std::vector<ParameterEstimate> RowMaker::rows() const {
  std::vector<ParameterEstimate> rows;
  for (Eigen::Index at = 0; at < z_.size(); ++at) {
    const Unknown& p = unknown(at);
    for (const Unknown::Target& target : p.targets) {
      if (p.owner == "subject" && &target != &p.targets.front()) break;
      rows.push_back(judged(row_of_unknown(at, target), at, target.owner));
    }
    agree_on_tied(rows, p.targets.size());
    if (!p.is(Scope::muscle, kSlopeRatio)) continue;
    for (const Unknown::Target& target : p.targets)
      rows.push_back(judged(row_of_product(static_cast<std::size_t>(target.owner)), at, target.owner));
  }
  return rows;
}

}  // namespace

std::vector<ParameterEstimate> estimate_rows(const Estimator& estimator,
                                             const Estimator::Solution& solution,
                                             const StudyData& data,
                                             const Intervals& intervals,
                                             const IdentificationResult& fit) {
  return RowMaker(estimator, solution, data, intervals, fit).rows();
}

}  // namespace myoid::identification
