#include "myoid/fit/methods/late_emg.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/fit/intervals/score.h"
#include "myoid/fit/intervals/verdict_rules.h"
#include "myoid/fit/methods/prediction.h"

namespace myoid::fit {
namespace {

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
