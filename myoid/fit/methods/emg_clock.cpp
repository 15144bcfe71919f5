#include "myoid/fit/methods/emg_clock.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/fit/intervals/score.h"
#include "myoid/fit/intervals/verdict_rules.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/ground/core/numbers.h"

namespace myoid::fit {
namespace {

constexpr double kCutoff_hz = 1.5;
constexpr double kLeadStep_s = 0.1;
constexpr int kReach = 15;  ///< Steps to either side.

double lead_of(std::size_t k) { return kLeadStep_s * (static_cast<int>(k) - kReach); }

bool contains(const UsualLead& usual, std::size_t k) {
  constexpr double kRound_s = 1e-6;
  return lead_of(k) > usual.earliest_s - kRound_s && lead_of(k) < usual.latest_s + kRound_s;
}

/// The errors by lead: where they are least, and least among the usual leads.
struct LeadErrors {
  std::size_t best = 0;
  double least = kInfinity, usual = kInfinity;
  bool unique = true, inside = true;  ///< Of `best`: among the usual leads.

  LeadErrors(const std::vector<double>& rms, const UsualLead& leads) {
    constexpr double kAlike = 1.1;
    constexpr std::size_t kApart = 3;
    best = static_cast<std::size_t>(std::min_element(rms.begin(), rms.end()) - rms.begin());
    least = rms[best];
    inside = contains(leads, best);
    unique = best > 0 && best + 1 < rms.size();
    for (std::size_t k = 0; k < rms.size(); ++k) {
      if (contains(leads, k)) usual = std::min(usual, rms[k]);
      const bool valley = k > 0 && k + 1 < rms.size() && rms[k] <= rms[k - 1] && rms[k] <= rms[k + 1];
      if (valley && (k > best ? k - best : best - k) >= kApart && rms[k] < kAlike * least) unique = false;
    }
  }
  [[nodiscard]] bool shifted(double gain) const { return unique && !inside && least < gain * usual; }
};

constexpr double kStep_s = 0.02, kFarthest_s = 1.0;
constexpr std::size_t kFewestSamples = 10;  // samples

/// Sums of squared errors over samples, with the EMG as it is stamped and moved to earlier times.
struct Errors {
  double n = 0.0, as_stamped = 0.0, moved = 0.0;
  double gain = 0.0;  ///< Fall of chi-square.
  Errors& operator+=(const Errors& more) {
    n += more.n;
    as_stamped += more.as_stamped;
    moved += more.moved;
    gain += more.gain;
    return *this;
  }
};

/// Returns the low-passed error of each joint's torque, n x joints.
Eigen::MatrixXd errors_nm(
    const StudyData& data, const TrialData& whole, ModelValues values, double earlier_s, double cutoff_hz) {
  for (ChannelValues& channel : values.channels) channel[kDelay] = -earlier_s;
  Eigen::MatrixXd found(whole.time_s.size(), static_cast<Eigen::Index>(joint_count(whole)));
  for (std::size_t j = 0; j < joint_count(whole); ++j) {
    const TrialData trial = of_joint(whole, j);
    const Eigen::VectorXd error_nm = predict(data, trial, values, EmgLag::delay).torque_nm - trial.torque_nm;
    found.col(static_cast<Eigen::Index>(j)) = below(trial.time_s, error_nm, cutoff_hz);
  }
  return found;
}

}  // namespace

LabelFit fit_of_labels(const StudyData& data, double lead_s) {
  std::vector<muscle::HillParameters<double>> literature;
  for (const MuscleSetup& setup : data.muscles) literature.push_back(setup.start);
  std::vector<std::vector<std::pair<Eigen::VectorXd, Eigen::VectorXd>>> trials;  // measured and predicted, by joint
  double product = 0.0, square = 0.0, sum = 0.0, total = 0.0, count = 0.0;
  for (const TrialData& whole : data.trials) {
    if (!whole.calibration) continue;
    trials.emplace_back();
    for (std::size_t j = 0; j < joint_count(whole); ++j) {
      const TrialData trial = of_joint(whole, j);
      const std::vector<Eigen::Index> rows = included_rows(trial);
      if (rows.empty()) continue;
      // No electrode shows the resting torque of the joint.
      const Eigen::VectorXd resting = resting_torque_nm(trial);
      const Eigen::VectorXd torque = predict(data, trial, literature, lead_s).torque_nm - resting;
      const auto& [measured, predicted] =
          trials.back().emplace_back(below(trial.time_s, trial.torque_nm - resting, kCutoff_hz)(rows),
                                     below(trial.time_s, torque, kCutoff_hz)(rows));
      product += predicted.dot(measured);
      square += predicted.squaredNorm();
      sum += measured.sum();
      total += measured.squaredNorm();
      count += static_cast<double>(rows.size());
    }
  }
  LabelFit fit;
  if (!(count > 0.0)) return fit;
  const double gain = square > 0.0 ? std::max(0.0, product / square) : 0.0;
  total -= sum * sum / count;  // about the mean
  double errors = 0.0;
  for (const auto& trial : trials) {
    double of_trial = 0.0, samples = 0.0;
    for (const auto& [measured, predicted] : trial) {
      of_trial += (measured - gain * predicted).squaredNorm();
      samples += static_cast<double>(measured.size());
    }
    errors += of_trial;
    fit.trial_rms_nm.push_back(samples > 0.0 ? std::sqrt(of_trial / samples) : 0.0);
  }
  fit.rms_nm = std::sqrt(errors / count);
  fit.r2 = total > 0.0 ? 1.0 - errors / total : 0.0;
  return fit;
}

std::string ShiftedEmg::sentence() const {
  return fmt::format(
      "with the EMG {:.1f} s {} the literature's muscles make the torque to {:.2f} N m rms, with a lead of {:g} to "
      "{:g} s, as EMG has, only to {:.2f}: were the recordings started together?",
      std::abs(lead_s), lead_s < 0.0 ? "earlier" : "later", rms_nm, usual.earliest_s, usual.latest_s, usual_rms_nm);
}

std::optional<ShiftedEmg> shifted_emg(const StudyData& data, const UsualLead& usual) {
  constexpr double kDescribes = 0.5, kBetter = 0.95;
  std::vector<LabelFit> fits;
  std::vector<double> of_all;
  for (std::size_t k = 0; k <= 2 * kReach; ++k) {
    fits.push_back(fit_of_labels(data, lead_of(k)));
    of_all.push_back(fits.back().rms_nm);
  }
  const LeadErrors all(of_all, usual);
  if (!all.shifted(kBetter) || fits[all.best].r2 <= kDescribes) return std::nullopt;
  const std::size_t trials = fits.front().trial_rms_nm.size();
  std::size_t alike = 0;
  for (std::size_t t = 0; t < trials; ++t) {
    std::vector<double> rms;
    for (const LabelFit& fit : fits) rms.push_back(fit.trial_rms_nm[t]);
    const LeadErrors of_trial(rms, usual);
    if (!of_trial.inside && (lead_of(of_trial.best) < 0.0) == (lead_of(all.best) < 0.0)) ++alike;
  }
  if (4 * alike < 3 * trials) return std::nullopt;
  return ShiftedEmg{lead_of(all.best), all.least, all.usual, usual};
}

std::string LateEmg::sentence() const {
  return fmt::format(
      "the delay is as good as 0, and with the EMG of {} taken {:.2f} s earlier the same muscles err by {:.3g} "
      "N m rms instead of {:.3g}: EMG that comes after the torque has a late clock, or an envelope that was filtered "
      "in one direction",
      trial.empty() ? "all trials" : "'" + trial + "'", late_s, moved_nm, as_stamped_nm);
}

std::optional<LateEmg> late_emg(const StudyData& data, const IdentificationResult& fit, double residual_cutoff_hz) {
  const double independent = fit.effective_samples / std::max(1, fit.samples_used);
  double most = std::pow(kVerdictRules.prior_conflict, 2);
  std::optional<LateEmg> found;
  const auto take = [&](const std::string& trial, double earlier_s, const Errors& e) {
    // The delays of single trials scatter about the fitted one.
    if (!(e.gain > most) || (!trial.empty() && earlier_s <= kVerdictRules.delay_weak_s)) return;
    most = e.gain;
    found = LateEmg{trial, earlier_s, std::sqrt(e.as_stamped / e.n), std::sqrt(e.moved / e.n)};
  };
  std::vector<Eigen::MatrixXd> as_stamped;
  for (const TrialData& trial : data.trials)
    as_stamped.push_back(errors_nm(data, trial, fit.values, 0.0, residual_cutoff_hz));
  for (double earlier_s = kStep_s; earlier_s <= kFarthest_s; earlier_s += kStep_s) {
    Errors all;
    for (std::size_t i = 0; i < data.trials.size(); ++i) {
      const TrialData& trial = data.trials[i];
      const double end_s = trial.activation.time_s()[trial.activation.sample_count() - 1];
      std::vector<Eigen::Index> rows = included_rows(trial);
      std::erase_if(rows, [&](Eigen::Index row) { return trial.time_s[row] + earlier_s > end_s; });
      if (!trial.calibration || rows.size() < kFewestSamples) continue;
      const Eigen::MatrixXd moved = errors_nm(data, trial, fit.values, earlier_s, residual_cutoff_hz);
      Errors of_trial{.n = static_cast<double>(rows.size()),
                      .as_stamped = as_stamped[i](rows, Eigen::all).squaredNorm(),
                      .moved = moved(rows, Eigen::all).squaredNorm()};
      of_trial.gain = independent * of_trial.n *
                      std::log(of_trial.as_stamped / std::max(of_trial.moved, 1e-12 * of_trial.as_stamped + 1e-300));
      take(trial.name, earlier_s, of_trial);
      all += of_trial;
    }
    take("", earlier_s, all);
  }
  return found;
}

std::optional<LateEmg> late_emg_of_no_delay(const StudyData& data,
                                            const EstimatorOptions& options,
                                            const IdentificationResult& fit) {
  const auto is_none = [](const ParameterEstimate& e) {
    return e.parameter == "emg_delay" && e.estimate < beliefs::kEmgDelay.value &&
           (!e.ci_high || *e.ci_high - e.estimate > e.estimate);
  };
  if (std::ranges::none_of(fit.estimates, is_none)) return std::nullopt;
  return late_emg(data, fit, options.residual_cutoff_hz.value_or(0.0));
}

}  // namespace myoid::fit
