#include "myoid/run/prediction_gates.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/fit/intervals/verdict_rules.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/page/typeset.h"
#include "myoid/study/intake/limits.h"

namespace myoid::run {
namespace {

using fit::Fold;
using fit::IdentificationResult;
using page::Gate;
using page::GateStatus;

/// Sums the scores of several trials, joint by joint.
class Pool {
 public:
  void add(const std::string& joint, const fit::Score& s) {
    if (s.n < 2.0 || !std::isfinite(s.sse)) return;
    Joint& j = joints_[joint];
    j.n += s.n;
    j.first += s.n * s.mean_nm;
    j.second += s.sst + s.n * s.mean_nm * s.mean_nm;
    errors_ += s.sse;
  }
  [[nodiscard]] Explained result() const {
    double n = 0.0, varies = 0.0, torque = 0.0;
    for (const auto& [name, j] : joints_) {
      n += j.n;
      torque += j.second;
      varies += j.second - j.first * j.first / j.n;
    }
    Explained all;
    if (!(n > 0.0)) return all;
    all.samples = static_cast<Eigen::Index>(n);
    all.rms_nm = std::sqrt(errors_ / n);
    all.spread_nm = std::sqrt(std::max(0.0, varies) / n);
    all.torque_rms_nm = std::sqrt(torque / n);
    return all;
  }

 private:
  struct Joint {
    double n = 0.0, first = 0.0,
           second = 0.0;  ///< Number of samples, sum and sum of squares of the torque.
  };
  std::map<std::string, Joint> joints_;
  double errors_ = 0.0;
};

/// Names the folds that are predicted badly (R2 below 0.5) and whose EMG reaches at least 1.5 times that of the fitted
/// trials: "'fast': biceps 2.8 times". Empty if there are none.
std::string beyond_what_was_fitted(const std::vector<Fold>& folds) {
  constexpr double kBadly = 0.5, kFar = 1.5;
  constexpr std::size_t kNamed = 3;
  std::vector<std::string> found;
  for (const Fold& f : folds) {
    if (f.unseen.ratio >= kFar && f.identified.r2() < kBadly && found.size() < kNamed)
      found.push_back(fmt::format("'{}': {} {:.1f} times", f.trial, f.unseen.channel, f.unseen.ratio));
  }
  return fmt::format("{}", fmt::join(found, ", "));
}

/// Returns how many robust standard deviations each value lies above the median.
std::vector<double> deviations(std::vector<double> values) {
  constexpr double kRobust = 1.4826;
  const double middle = math::median(values);
  std::vector<double> off;
  for (const double x : values) off.push_back(std::abs(x - middle));
  const double sd = kRobust * math::median(std::move(off));
  for (double& x : values) x = x > middle ? (x - middle) / sd : 0.0;
  return values;
}

/// Returns the logarithm of the error over the spread of the torque. Efforts of several sizes have errors of several
/// sizes in N m, but alike shares. A torque without spread counts as one that is not explained.
double log_share(const fit::Score& s) {
  const double share = s.nrmse_sd();
  return share > 0.0 && std::isfinite(share) ? std::log(share) : 0.0;
}

/// Returns the limits of `is_wrong` in words.
std::string when_wrong() {
  return fmt::format("fails if the errors are larger than the torque, or than {:g} % of it at an R2 below {:g}",
                     100.0 * study::kGateLimits.unrelated_share, study::kGateLimits.mean);
}

/// Returns the status of a prediction; it passes only if it is `good` by another measure, too.
GateStatus status_of(const Explained& share, bool good) {
  if (share.is_wrong()) return GateStatus::fail;
  return good && share.r2() > study::kGateLimits.explains ? GateStatus::pass : GateStatus::warn;
}

Gate distance_gate(const IdentificationResult& fit) {
  constexpr double kFar = fit::kVerdictRules.prior_conflict;
  std::vector<std::string> far;
  double most = 0.0;
  for (const fit::PriorDistance& d : fit.prior_distances) {
    most = std::max({most, d.distance, d.farthest_distance});
    if (std::max(d.distance, d.farthest_distance) <= kFar) continue;
    far.push_back(
        fmt::format("{} {:.1f} ({} {:.1f})", d.muscle, d.distance, page::spelled(d.farthest), d.farthest_distance));
  }
  return {"Muscles within what is known of them", far.empty() ? GateStatus::pass : GateStatus::warn,
          far.empty() ? fmt::format("at most {:.1f} standard deviations between people from the literature", most)
                      : fmt::format("farther from the literature than people differ, in standard deviations: {}",
                                    fmt::join(far, "; ")),
          fmt::format("every muscle's numbers, one by one and together, within {:.0f}; of the logarithm of what cannot "
                      "be negative, such as F_max and lengths",
                      kFar),
          "Do not use the numbers of a muscle beyond before the cause is known: a label, sign, unit, mass or geometry "
          "that is wrong, or a model too simple for the recording."};
}

}  // namespace

double Explained::r2() const { return spread_nm > 0.0 ? 1.0 - rms_nm * rms_nm / (spread_nm * spread_nm) : 0.0; }

bool Explained::is_wrong() const {
  return rms_nm > torque_rms_nm ||
         (r2() < study::kGateLimits.mean && rms_nm > study::kGateLimits.unrelated_share * torque_rms_nm);
}

std::string Explained::text() const {
  return fmt::format("R2 {:.2f}: {:.2f} N m rms below 1.5 Hz, where the torque is {:.2f} rms and varies by {:.2f}",
                     r2(), rms_nm, torque_rms_nm, spread_nm);
}

Explained explained(const IdentificationResult& fit, bool calibration) {
  Pool pool;
  for (const fit::TrialFit& t : fit.trials) {
    if (t.calibration == calibration) pool.add(t.joint, t.band);
  }
  return pool.result();
}

Explained explained(const std::vector<Fold>& folds) {
  Pool pool;
  for (const Fold& f : folds) pool.add(f.joint, f.band);
  return pool.result();
}

std::string generalises_badly(const std::vector<Fold>& folds) {
  constexpr double kWorse = 2.0;     // times the error of the fitted trials
  constexpr double kExplains = 0.5;  // share of the squares from which a prediction is good enough
  double seen = 0.0, unseen = 0.0, spread = 0.0, worst = 0.0, count = 0.0;
  std::string where;
  for (const Fold& f : folds) {
    const auto n = static_cast<double>(f.measured_nm.size());
    if (!(f.fitted.rmse_nm() > 0.0) || !std::isfinite(f.identified.rmse_nm()) || n < 2.0) continue;
    seen += n * std::pow(f.fitted.rmse_nm(), 2);
    unseen += n * std::pow(f.identified.rmse_nm(), 2);
    spread += (f.measured_nm.array() - f.measured_nm.mean()).square().sum();
    count += n;
    if (f.identified.rmse_nm() / f.fitted.rmse_nm() <= worst) continue;
    worst = f.identified.rmse_nm() / f.fitted.rmse_nm();
    where = f.trial;
  }
  const bool bad = count > 0.0 && unseen > kWorse * kWorse * seen && unseen > (1.0 - kExplains) * spread;
  if (!bad) return "";
  return fmt::format(
      "left-out data are predicted {:.1f} times worse than fitted data ({:.3g} N m rms instead of {:.3g}; most in "
      "'{}'). The samples of one movement share the model's error, and many of them pull the numbers along with this "
      "error, away from the priors. Record other movements (angles, speeds, loads) rather than more of the same, and "
      "trust neither numbers nor predictions beyond the movements that were fitted",
      std::sqrt(unseen / seen), std::sqrt(unseen / count), std::sqrt(seen / count), where);
}

std::vector<OutlyingFold> outlying_folds(const std::vector<Fold>& folds) {
  constexpr std::size_t kFewest = 5;
  std::map<std::string, std::vector<const Fold*>> joints;
  for (const Fold& f : folds) {
    if (f.identified.rmse_nm() > 0.0 && std::isfinite(f.identified.rmse_nm())) joints[f.joint].push_back(&f);
  }
  std::vector<OutlyingFold> found;
  for (const auto& [joint, of_joint] : joints) {
    if (of_joint.size() < kFewest) continue;
    std::vector<double> errors, shares, r2;  // errors in N m, and over the spread of the trial's own torque
    for (const Fold* f : of_joint) {
      errors.push_back(std::log(f->identified.rmse_nm()));
      shares.push_back(log_share(f->identified));
      r2.push_back(f->identified.r2());
    }
    const double middle = math::median(errors), middle_r2 = math::median(std::move(r2));
    const std::vector<double> far = deviations(errors), far_share = deviations(shares);
    for (std::size_t i = 0; i < of_joint.size(); ++i) {
      const Fold& f = *of_joint[i];
      if (std::max(far[i], far_share[i]) <= study::kGateLimits.far_fold ||
          errors[i] - middle <= std::log(study::kGateLimits.larger_fold) || f.identified.r2() >= middle_r2)
        continue;
      found.push_back({f.trial, joint, f.identified.rmse_nm(), f.identified.r2(), std::exp(middle)});
    }
  }
  return found;
}

std::vector<Gate> fit_gates(const IdentificationResult& fit) {
  std::vector<Gate> gates;
  if (const Explained own = explained(fit, true); own.samples > 0) {
    // The fit's own R2 leaves out the ends of trials, and is of the joint that is explained least.
    const bool fitted = fit.r2 >= fit::kVerdictRules.least_r2;
    const bool none = fit.r2 < study::kGateLimits.mean;
    gates.push_back({"Describes the torque it was fitted to", none ? GateStatus::fail : status_of(own, fitted),
                     own.text() + (fitted ? "" : fmt::format("; R2 {:.2f} of the fitted samples", fit.r2)),
                     fmt::format("R2 of whole trials and of the fitted samples above 0.5; below {:g} of the fitted "
                                 "samples it fails, and it ",
                                 study::kGateLimits.mean) +
                         when_wrong(),
                     "Muscles that do not even make the torque they were fitted to are none."});
  }
  if (const Explained held = explained(fit, false); held.samples > 0) {
    gates.push_back({"Predicts the trials held back", status_of(held, true), held.text(),
                     "R2 above 0.5; " + when_wrong(), "Below 0 their mean torque predicts them better."});
  }
  if (!fit.prior_distances.empty()) gates.push_back(distance_gate(fit));
  // The distances have a gate of their own.
  std::vector<Remark> others = fit.warnings;
  std::erase_if(others, [](const Remark& remark) { return remark.code == RemarkCode::far_from_prior; });
  if (!others.empty())
    gates.push_back({"Fit without reservations", GateStatus::warn,
                     fmt::format("{}", fmt::join(sentences(others), "; ")), "none",
                     "Every number of the fit rests on it."});
  return gates;
}

std::vector<Gate> fold_gates(const std::vector<Fold>& folds, bool wanted, const std::string& remedy) {
  constexpr const char* kName = "Predicts torque it has not seen";
  if (folds.empty())
    return {{.name = kName,
             .status = GateStatus::info,
             .value = wanted ? "not asked: no part of the data could be left out" : "not asked: cross_validate = false",
             .why = "Without it nothing tells whether the numbers hold beyond the data of the fit.",
             .asked = false}};
  std::vector<Gate> gates;
  const Explained all = explained(folds);
  // The errors are not smoothed, because the literature's prediction has no score below 1.5 Hz.
  double literature = 0.0, identified = 0.0, count = 0.0;
  int better = 0;
  for (const Fold& f : folds) {
    literature += f.literature.sse;
    identified += f.identified.sse;
    count += f.identified.n;
    better += f.identified.rmse_nm() < f.literature.rmse_nm() ? 1 : 0;
  }
  std::string hint = fmt::format("Better in {} of the {} left out.", better, folds.size());
  if (const std::string beyond = beyond_what_was_fitted(folds); !beyond.empty())
    hint += fmt::format(" EMG beyond all that was fitted ({}): that prediction extrapolates. {}", beyond, remedy);
  const bool beats = identified < literature && 2 * better > static_cast<int>(folds.size());
  gates.push_back(
      {kName, status_of(all, beats),
       fmt::format("{}; unfiltered {:.2f} N m, the literature with its best gain {:.2f} N m", all.text(),
                   std::sqrt(identified / std::max(count, 1.0)), std::sqrt(literature / std::max(count, 1.0))),
       "R2 above 0.5 and better than the literature's parameters, over all and in most trials; " + when_wrong(),
       std::move(hint)});
  const std::vector<OutlyingFold> outlying = outlying_folds(folds);
  if (!outlying.empty()) {
    std::vector<std::string> texts;
    for (const OutlyingFold& f : outlying)
      texts.push_back(fmt::format("{}: {:.2f} N m rms (R2 {:.2f}), the others about {:.2f}", f.trial, f.rms_nm, f.r2,
                                  f.usual_rms_nm));
    gates.push_back({"Trials alike", GateStatus::warn, fmt::format("{}", fmt::join(texts, "; ")),
                     "no error stands out from the others",
                     "Is a file, a label, the held mass or the clock of that trial wrong? Mend it, or leave it out."});
  }
  return gates;
}

}  // namespace myoid::run
