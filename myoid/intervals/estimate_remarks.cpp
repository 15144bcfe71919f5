#include "myoid/intervals/estimate_remarks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/identification/muscle_activation.h"
#include "myoid/intervals/identifiability.h"
#include "myoid/intervals/verdict_rules.h"

namespace myoid::identification {
namespace {

/// Ratio of widths above which two intervals contradict each other.
constexpr double kDisagreement = 1.5;
/// Chance spreads by which two widths may differ; no pair of a hundred differs by more.
constexpr double kDeviations = 3.0;
/// Share of an identified number's allowed error below which no verdict changes.
constexpr double kNegligible = 0.1;

double tolerance(const ParameterEstimate& e) {
  if (e.parameter == "emg_delay") return kVerdictRules.delay_identified_s;
  if (zero_by_nature(e.parameter)) return e.prior_sd.value_or(0.0);
  return kVerdictRules.identified_half_width * std::abs(e.estimate);
}

}  // namespace

void RouteRemarks::compare(ParameterEstimate& e) {
  const RouteInterval* narrow = nullptr;
  const RouteInterval* wide = nullptr;
  double ratio = 1.0, width = 0.0;
  const auto width_of = [](const RouteInterval& r) { return std::max(*r.high - *r.low, 1e-300); };
  for (const RouteInterval& a : e.routes) {
    if (!a.low || !a.high) {
      open_.push_back(e.muscle + " " + e.parameter);
      continue;
    }
    width = std::max(width, width_of(a));
    for (const RouteInterval& b : e.routes) {
      if (!b.low || !b.high) continue;
      const double here = width_of(a) / width_of(b);
      const double by_chance = std::exp(kDeviations * std::hypot(a.spread, b.spread));
      if (!(here > std::max(kDisagreement, by_chance)) || !(here > ratio)) continue;  // nor without a number
      ratio = here;
      wide = &a;
      narrow = &b;
    }
  }
  e.routes_disagree = wide != nullptr && 0.5 * width > kNegligible * tolerance(e);
  if (!e.routes_disagree) return;
  ++disagree_;
  const bool beyond = e.ci_low && e.ci_high && width_of(*wide) > 1.05 * (*e.ci_high - *e.ci_low);
  beyond_ += beyond ? 1 : 0;
  if (ratio <= worst_) return;
  worst_ = ratio;
  worst_text_ = fmt::format("{} {}, where {} gives {} times the width of {}", e.muscle, e.parameter, wide->route,
                            ratio < 100.0 ? fmt::format("{:.1f}", ratio) : "over 100", narrow->route);
}

void RouteRemarks::add_to(std::vector<std::string>& warnings, std::size_t count) const {
  if (disagree_ > 0) {
    warnings.push_back(fmt::format(
        "the routes to the interval disagree by more than chance makes of them for {} of {} numbers, most for {}: {} "
        "(routes_disagree in parameters.csv)",
        disagree_, count, worst_text_,
        beyond_ == 0 ? std::string("the wider one is what is reported")
                     : fmt::format("for {} of them a route is wider than what is reported: trust that one", beyond_)));
  }
  if (open_.empty()) return;
  constexpr std::size_t kNamed = 4;
  const std::size_t named = std::min(kNamed, open_.size());
  warnings.push_back(fmt::format(
      "the profile is open for {} of {} numbers ({}{}): there the data bound them on one side at most", open_.size(),
      count, fmt::join(open_.begin(), open_.begin() + static_cast<std::ptrdiff_t>(named), ", "),
      open_.size() > named ? ", ..." : ""));
}

namespace {

/// Lengths [m], each with its duration [s].
using LengthsInTime = std::vector<std::pair<double, double>>;

/// Returns the range of lengths without this much time at either end.
double span_but_for(double time_s, LengthsInTime lengths) {
  if (lengths.empty()) return 0.0;
  std::sort(lengths.begin(), lengths.end());
  const auto end_of = [&](auto from, auto to) {
    double passed_s = 0.0;
    auto at = from;
    while (std::next(at) != to && passed_s + at->second < time_s) passed_s += (at++)->second;
    return at->first;
  };
  return std::max(0.0, end_of(lengths.rbegin(), lengths.rend()) - end_of(lengths.begin(), lengths.end()));
}

}  // namespace

std::vector<ActiveMotion> active_motion(const StudyData& data, double delay_s) {
  const std::size_t muscles = data.muscles.size();
  std::vector<double> shortening_s(muscles, 0.0), lengthening_s(muscles, 0.0);
  std::vector<LengthsInTime> lengths(muscles);
  for (const TrialData& trial : data.trials) {
    const Eigen::Index n = trial.time_s.size();
    if (!trial.calibration || n < 2) continue;
    const Eigen::MatrixXd activation = muscle_activation(data, trial, trial.time_s, delay_s);
    const double step_s = (trial.time_s[n - 1] - trial.time_s[0]) / static_cast<double>(n - 1);
    for (const Eigen::Index i : included_rows(trial)) {
      for (std::size_t k = 0; k < muscles; ++k) {
        const auto column = static_cast<Eigen::Index>(k);
        const double least = kVerdictRules.moving_share * data.muscles[k].start.max_shortening_speed_mps;
        const double v = trial.velocity_mps(i, column);
        if (!(activation(i, column) > kVerdictRules.active)) continue;
        lengths[k].emplace_back(trial.length_m(i, column), step_s);
        if (v > least) lengthening_s[k] += step_s;
        if (v < -least) shortening_s[k] += step_s;
      }
    }
  }
  std::vector<ActiveMotion> result(muscles);
  for (std::size_t k = 0; k < muscles; ++k)
    result[k] = {.shortened = shortening_s[k] >= kVerdictRules.least_s,
                 .lengthened = lengthening_s[k] >= kVerdictRules.least_s,
                 .length_span_m = span_but_for(kVerdictRules.least_s, std::move(lengths[k]))};
  return result;
}

std::string never_done(const Unknown& parameter, const ActiveMotion& motion, bool by_ratio) {
  const ParameterField& field = *parameter.field;
  if (field.scope != Scope::muscle) return "";
  const bool lengthening = field.field == kProduct || field.field == kPlateau || field.field == kSlopeRatio;
  if (lengthening && !motion.lengthened) return "lengthened";
  const bool elsewhere = by_ratio && motion.lengthened;
  if (field.field == kCurvature && !motion.shortened && !elsewhere) return "shortened";
  return "";
}

std::string known_beforehand(const Unknown& parameter, bool from_mvc) {
  const ParameterField& field = *parameter.field;
  if (parameter.prior_is_given) return "what the study gave beforehand";
  if (field.scope != Scope::muscle || field.zero_by_nature) return "what is expected beforehand";
  if (field.field == kMaxForce && !from_mvc) return "what any effort may be, 1/20 to 1 of the literature's strength";
  return "the literature's value";
}

double distance_from_prior(const Unknown& parameter, double z) {
  return std::abs(z - parameter.prior.mean) / parameter.prior.sd;
}

std::vector<PriorDistance> prior_distances(const std::vector<Unknown>& free,
                                           const Eigen::VectorXd& z,
                                           const StudyData& data) {
  std::vector<PriorDistance> result;
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    PriorDistance of{.muscle = data.muscles[k].name};
    double squares = 0.0;
    int count = 0;
    for (std::size_t j = 0; j < free.size(); ++j) {
      const Unknown& p = free[j];
      // A number that is tied between muscles belongs to no single muscle.
      if (p.field->scope != Scope::muscle || p.targets.size() != 1 || !(p.prior.sd > 0.0) ||
          p.targets.front().owner != static_cast<int>(k))
        continue;
      const double d = distance_from_prior(p, z[static_cast<Eigen::Index>(j)]);
      squares += d * d;
      ++count;
      if (d <= of.farthest_distance) continue;
      of.farthest_distance = d;
      of.farthest = p.field->name;
    }
    of.distance = equivalent_deviations(squares, count);
    if (count > 0) result.push_back(std::move(of));
  }
  return result;
}

void add_distances_to(std::vector<std::string>& warnings, const std::vector<PriorDistance>& distances) {
  for (const PriorDistance& d : distances) {
    if (std::max(d.distance, d.farthest_distance) <= kVerdictRules.prior_conflict) continue;
    warnings.push_back(fmt::format(
        "{} has left what is known beforehand: its numbers together lie {:.1f} standard deviations of their priors "
        "away, {} {:.1f}: use none of them before the cause is known (electrode, sign, unit, mass, geometry)",
        d.muscle, d.distance, d.farthest, d.farthest_distance));
  }
}

std::string lag_remark(const IdentificationResult& result) {
  if (!result.shared_lag_gain) return {};
  const double gain = std::abs(*result.shared_lag_gain);
  const bool clear = gain >= 4.0;  // two standard deviations
  return fmt::format(
      "The muscles follow their EMG {}; {}.",
      result.lag == EmgLag::shared
          ? "with the lags of excitation and activation, of which the delay is the mean"
          : "with a delay that leaves its shape as it is, not with the lags of excitation and activation",
      clear ? fmt::format("the recording tells that (chi-square less by {:.0f})", gain)
            : std::string("the recording hardly tells which"));
}

void agree_on_tied(std::vector<ParameterEstimate>& estimates, std::size_t count) {
  if (count < 2 || estimates.size() < count || estimates.back().tied_to.empty()) return;
  const auto first = estimates.end() - static_cast<std::ptrdiff_t>(count);
  const auto worst = std::max_element(
      first, estimates.end(), [](const auto& a, const auto& b) { return severity(a.verdict) < severity(b.verdict); });
  const Verdict verdict = worst->verdict;
  const std::string reason = worst->reason;
  for (auto e = first; e != estimates.end(); ++e) {
    e->verdict = verdict;
    e->reason = reason;
  }
}

}  // namespace myoid::identification
