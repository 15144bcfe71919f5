#include "myoid/fit/methods/plain_fit.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/fit/intervals/estimate_rows.h"
#include "myoid/fit/intervals/verdicts.h"
#include "myoid/fit/measurement/nuisances.h"
#include "myoid/fit/posterior/drive.h"
#include "myoid/fit/posterior/torque_signals.h"
#include "myoid/fit/posterior/trial_run.h"
#include "myoid/ground/core/parallel.h"
#include "myoid/ground/math/covariance.h"
#include "myoid/ground/math/least_squares.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::fit {
namespace {

constexpr int kStarts = 12;
constexpr Eigen::Index kFewSamples = 500, kSamplesAnUnknown = 10;
/// Share of the data's sum of squares above which a search has left residuals.
constexpr double kNear = 1e-4;
constexpr double kMet = 1e-12;
constexpr double kLeast = 10.0;              ///< Samples that even a short trial keeps.
constexpr Eigen::Index kMostUnknowns = 100;  ///< A step of the search takes time with their cube.
constexpr double kNamed = 0.05;              ///< Share of an open direction from which it names a number.

/// Residuals and unknowns of one study. Rows are those of the runs, one after the other.
class PlainFit {
 public:
  PlainFit(const StudyData& data, const EstimatorOptions& options)
      : map_(data, options), runs_(trial_runs(data, options, map_)), lag_(options.law), progress_(options.progress) {
    for (const TrialRun& run : runs_) rows_ += run.row_count();
    measured_nm_.resize(rows_);
    Eigen::Index first = 0;
    for (const TrialRun& run : runs_) {
      measured_nm_.segment(first, run.row_count()) = run.measured_nm;
      first += run.row_count();
    }
  }

  [[nodiscard]] const ParameterMap& map() const { return map_; }
  [[nodiscard]] Eigen::Index row_count() const { return rows_; }
  [[nodiscard]] const Eigen::VectorXd& measured_nm() const { return measured_nm_; }

  [[nodiscard]] math::LeastSquaresResult search(const Eigen::VectorXd& start,
                                                double step_tolerance,
                                                double cost_tolerance) const {
    return math::minimize(
        {.residual_count = rows_,
         .evaluate = [this](const auto& z, auto& r, auto* j) { residual(z, r, j); },
         .lower = bounds(&muscle::Range::lower),
         .upper = bounds(&muscle::Range::upper)},
        start, {.step_tolerance = step_tolerance, .cost_tolerance = cost_tolerance, .progress = {{}, progress_.stop}});
  }

  [[nodiscard]] bool leaves_at_most(double share, const math::LeastSquaresResult& found) const {
    return 2.0 * found.cost <= share * measured_nm_.squaredNorm();
  }

  /// Returns start number s: the given start, or one moved by a usual spread in a fixed pattern of signs. The delay has
  /// several minima, so the searches begin at several delays.
  [[nodiscard]] Eigen::VectorXd start_number(int s) const {
    Eigen::VectorXd z = map_.start();
    for (std::size_t j = 0; j < map_.free().size(); ++j) {
      const Unknown& f = map_.free()[j];
      const auto at = static_cast<Eigen::Index>(j);
      const double step = s == 0 ? 0.0 : f.field->logarithmic ? 0.3 : 0.1 * std::abs(f.start);
      const std::uint64_t mixed =
          (static_cast<std::uint64_t>(s) * 0x9E3779B97F4A7C15ULL) ^ ((j + 1) * 0xD1B54A32D192ED03ULL);
      const double sign = ((mixed >> 33) & 1U) == 0 ? 1.0 : -1.0;
      z[at] = std::clamp(z[at] + sign * step, f.bounds.lower, f.bounds.upper);
      if (f.is(Scope::channel, kDelay)) z[at] = f.bounds.lower + (f.bounds.upper - f.bounds.lower) * 0.2 * (s % 4);
    }
    return z;
  }

  /// Returns the first search that ends at a minimum without residuals.
  [[nodiscard]] std::optional<math::LeastSquaresResult> first_without_residuals() const {
    for (int s = 0; s < kStarts; ++s) {
      const math::LeastSquaresResult look = search(start_number(s), 1e-6, 1e-6);
      if (!leaves_at_most(kNear, look)) continue;
      math::LeastSquaresResult attempt = search(look.x, 1e-12, 1e-15);
      if (leaves_at_most(kMet, attempt)) return attempt;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] Eigen::VectorXd bounds(double muscle::Range::*end) const {
    Eigen::VectorXd of_all(map_.size());
    for (Eigen::Index j = 0; j < of_all.size(); ++j) of_all[j] = map_.free()[static_cast<std::size_t>(j)].bounds.*end;
    return of_all;
  }

  void residual(const Eigen::VectorXd& z, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) const {
    std::vector<ParameterMap::Chain> all;
    const ModelValues values = map_.values(z, jacobian == nullptr ? nullptr : &all);
    const ChainsByOwner chains(map_, all);
    std::vector<Eigen::Index> first(runs_.size() + 1, 0);
    for (std::size_t i = 0; i < runs_.size(); ++i) first[i + 1] = first[i] + runs_[i].row_count();
    parallel_ranges(runs_.size(), std::size_t{1}, [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const RunEvaluation at(runs_[i], map_, lag_, values, jacobian == nullptr ? nullptr : &chains);
        const Eigen::Index n = runs_[i].row_count();
        r.segment(first[i], n) = at.signals().torque_nm - runs_[i].measured_nm;
        if (jacobian != nullptr) jacobian->middleRows(first[i], n) = at.jacobian(map_.size());
      }
    });
  }

  ParameterMap map_;
  std::vector<TrialRun> runs_;
  EmgLag lag_;
  Progress progress_;
  Eigen::Index rows_ = 0;
  Eigen::VectorXd measured_nm_;
};

/// Takes row floor((i + g i mod 1) apart) as sample i, g the golden ratio, so that no period of a
/// movement is a multiple of the steps.
std::vector<Eigen::Index> irregular_rows(Eigen::Index count, double apart) {
  std::vector<Eigen::Index> rows;
  for (double i = 0.0; i * apart < static_cast<double>(count); i += 1.0) {
    const double shift = std::fmod(i * std::numbers::phi, 1.0);
    const auto row = static_cast<Eigen::Index>((i + shift) * apart);
    if (row < count && (rows.empty() || row > rows.back())) rows.push_back(row);
  }
  return rows;
}

/// Returns the options without priors, and so without gains, and without low-pass, whose envelopes are the drives.
EstimatorOptions plain(EstimatorOptions options) {
  options.priors = false;
  options.residual_cutoff_hz.reset();
  options.max_rate_hz = std::max(options.max_rate_hz, kNoiseFreeRate_hz);
  options.drives = std::make_shared<DriveMemory>(0.0);
  options.begin_at.reset();
  return options;
}

std::optional<math::LeastSquaresResult> minimum_of(const StudyData& data,
                                                   const EstimatorOptions& options,
                                                   const PlainFit& whole) {
  const Eigen::Index count = std::max(kFewSamples, kSamplesAnUnknown * whole.map().size());
  if (whole.row_count() <= count) return whole.first_without_residuals();
  EstimatorOptions at_all = options;
  at_all.max_rate_hz = std::numeric_limits<double>::infinity();
  const auto found = PlainFit(few_samples(data, count), at_all).first_without_residuals();
  if (!found) return std::nullopt;
  math::LeastSquaresResult polished = whole.search(found->x, 1e-12, 1e-15);
  if (!whole.leaves_at_most(kMet, polished)) return std::nullopt;
  return polished;
}

/// Makes the rows of an exact fit.
struct ExactRows {
  const StudyData& data;
  const ParameterMap& map;
  const math::LeastSquaresResult& found;
  const math::CovarianceResult& covariance;
  const IdentificationResult& fit;

  [[nodiscard]] double sd(Eigen::Index j) const { return std::sqrt(std::max(0.0, fit.covariance(j, j))); }

  /// Fills interval and verdict of a row whose value is `of` the unknown j.
  template <class Value>
  void fill(ParameterEstimate& e, Eigen::Index j, const Value& of) const {
    const Unknown& p = map.free()[static_cast<std::size_t>(j)];
    NumberFacts facts{.fit = {.converged = found.termination == math::Termination::converged,
                              .failure = found.message,
                              .one_reading = true},
                      .person = {.value = e.estimate},
                      .determined = covariance.determined[static_cast<std::size_t>(j)]};
    e.at_bound = found.at_bound[static_cast<std::size_t>(j)];
    if (facts.determined) {
      const double reach = math::normal_quantile(0.975) * sd(j), z = found.x[j];
      const double one = of(std::max(z - reach, p.bounds.lower)), other = of(std::min(z + reach, p.bounds.upper));
      facts.person.low = std::min({one, other, e.estimate});
      facts.person.high = std::max({one, other, e.estimate});
      facts.person.sd = 0.5 * std::abs(of(z + sd(j)) - of(z - sd(j)));
    }
    facts.given = facts.person;
    if (p.is(Scope::channel, kDelay)) facts.scale = Scale::delay;
    if (zero_by_nature(e.parameter)) facts.usual_size = 1.0;
    facts.at_bound = e.at_bound && facts.scale != Scale::delay && !zero_by_nature(e.parameter);
    judge(e, facts);
  }

  [[nodiscard]] std::vector<ParameterEstimate> rows() const {
    std::vector<ParameterEstimate> rows;
    for (Eigen::Index j = 0; j < map.size(); ++j) {
      const Unknown& p = map.free()[static_cast<std::size_t>(j)];
      for (const Unknown::Target& target : p.targets) {
        if (p.owner == "subject" && &target != &p.targets.front()) break;
        ParameterEstimate& e = rows.emplace_back(row_of(p, target, map, found.x[j]));
        fill(e, j, [&](double z) { return target.ratio * p.to_value(z); });
      }
      agree_on_tied(rows, p.targets.size());
      if (!p.is(Scope::muscle, kSlopeRatio)) continue;
      for (const Unknown::Target& target : p.targets) {
        const auto k = static_cast<std::size_t>(target.owner);
        ParameterEstimate& e = rows.emplace_back(product_row_of(data.muscles[k]));
        e.estimate = fit.values.muscles[k][kProduct];
        fill(e, j, [&](double z) {
          Eigen::VectorXd moved = found.x;
          moved[j] = z;
          return map.values(moved).muscles[k][kProduct];
        });
      }
    }
    return rows;
  }
};

/// Returns the directions that the data leave open, each as a sum of parameters.
std::vector<std::string> undetermined_sums(const std::vector<Unknown>& free, const Eigen::MatrixXd& directions) {
  std::vector<std::string> sums;
  for (Eigen::Index k = 0; k < directions.cols(); ++k) {
    std::vector<std::string> parts;
    for (Eigen::Index j = 0; j < directions.rows(); ++j) {
      if (std::abs(directions(j, k)) > kNamed)
        parts.push_back(fmt::format("{:+.2f} {}", directions(j, k), free[static_cast<std::size_t>(j)].label));
    }
    sums.push_back(fmt::format("{}", fmt::join(parts, " ")));
  }
  return sums;
}

}  // namespace

StudyData few_samples(const StudyData& data, Eigen::Index count) {
  Eigen::Index all = 0;
  for (const TrialData& trial : data.trials) all += trial.calibration ? trial.time_s.size() : 0;
  if (all <= count) return data;
  const double apart = static_cast<double>(all) / static_cast<double>(count);
  StudyData few = data;
  for (TrialData& trial : few.trials) {
    if (!trial.calibration) continue;
    const Eigen::Index n = trial.time_s.size();
    trial = at_rows(trial, irregular_rows(n, std::min(apart, static_cast<double>(n) / kLeast)));
  }
  return few;
}

std::optional<IdentificationResult> fit_exactly(const StudyData& data, const EstimatorOptions& options) {
  validate(data);
  const auto begin = std::chrono::steady_clock::now();
  const EstimatorOptions as_it_is = plain(options);
  const PlainFit whole(data, as_it_is);
  if (whole.map().size() == 0 || whole.map().size() > kMostUnknowns) return std::nullopt;
  const std::optional<math::LeastSquaresResult> found = minimum_of(data, as_it_is, whole);
  if (!found) return std::nullopt;
  const math::CovarianceResult covariance = math::covariance(found->jacobian, found->residual);
  IdentificationResult result;
  result.exact = true;
  result.termination = found->termination;
  result.message = found->message;
  result.iterations = found->iterations;
  result.samples_used = static_cast<int>(whole.row_count());
  result.effective_samples = static_cast<double>(whole.row_count());
  result.solution = found->x;
  result.covariance = covariance.residual_variance * covariance.unscaled;
  result.values = whole.map().values(found->x);
  for (const MuscleValues& values : result.values.muscles) result.muscles.push_back(hill_parameters(values));
  result.lag = as_it_is.law;
  result.delay_s = result.values.channels.front()[kDelay];
  result.r2 = math::explained_share(whole.measured_nm() + found->residual, whole.measured_nm());
  result.torque_sd_nm = std::sqrt(covariance.residual_variance);
  for (const Unknown& p : whole.map().free()) result.free_parameters.push_back(p.label);
  result.estimates = ExactRows{data, whole.map(), *found, covariance, result}.rows();
  result.open_sums = undetermined_sums(whole.map().free(), covariance.undetermined);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

std::optional<IdentificationResult> exact_fit(const StudyData& data, const EstimatorOptions& options) {
  for (std::size_t k = 0; k < data.muscles.size(); ++k)
    // A length by ultrasound has noise, and an activation without EMG is a guess.
    if (measures_fascicles(data, k) || data.muscles[k].unseen) return std::nullopt;
  StudyData freed = data;
  hold_nuisances(freed);
  StudyData held = freed;
  hold_speeds(held);
  if (auto fit = fit_exactly(held, options)) return fit;
  if (freed.rules != held.rules)
    if (auto fit = fit_exactly(freed, options)) return fit;
  StudyData of_emg = data;
  hold_nuisances(of_emg, beliefs::kEmgExponent.name);
  hold_speeds(of_emg);
  return of_emg.rules == held.rules ? std::nullopt : fit_exactly(of_emg, options);
}

}  // namespace myoid::fit
