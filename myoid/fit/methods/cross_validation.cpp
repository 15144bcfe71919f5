#include "myoid/fit/methods/cross_validation.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "myoid/fit/measurement/muscle_activation.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/fit/posterior/drive.h"
#include "myoid/ground/core/parallel.h"
#include "myoid/ground/math/decompositions.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::fit {
namespace {

double duration_s(const TrialData& trial) { return trial.time_s[trial.time_s.size() - 1] - trial.time_s[0]; }

constexpr int kBlocks = 5;
constexpr double kGap_s = 0.5;  // on either side of a block
/// Duration from which a trial is cut into blocks: half of it remains beside a block and its gaps.
constexpr double kLeastForBlocks_s = 2.0 * kGap_s / (0.5 - 1.0 / kBlocks);

TrialData used(TrialData trial, bool calibration) {
  trial.calibration = calibration;
  return trial;
}

/// Adds block `b` of a trial to be predicted, and the fitted parts on either side of the block.
void cut(const TrialData& trial, int b, Split& split) {
  const Eigen::Index n = trial.time_s.size();
  const Eigen::Index begin = n * b / kBlocks;
  const Eigen::Index end = n * (b + 1) / kBlocks;
  const auto gap = static_cast<Eigen::Index>(std::ceil(kGap_s * static_cast<double>(n - 1) / duration_s(trial)));
  std::vector<TrialData>& to = split.data.trials;
  to.push_back(used(part(trial, begin, end - begin), false));
  if (begin > 2 * gap) to.push_back(used(part(trial, 0, begin - gap), true));
  if (n - end > 2 * gap) to.push_back(used(part(trial, end + gap, n - end - gap), true));
}

/// Says which other part can be left out, or how long a recording must be if none can.
std::string other_part(const std::vector<const TrialData*>& trials, const CrossValidationOptions& how) {
  double longest_s = 0.0;
  for (const TrialData* trial : trials) longest_s = std::max(longest_s, duration_s(*trial));
  const bool blocks = longest_s >= kLeastForBlocks_s;
  if (blocks || trials.size() > 1)
    return fmt::format("; {} can be: set {} to \"{}\"", trials.size() > 1 ? "whole trials" : "blocks of it",
                       how.setting, trials.size() > 1 ? "trial" : "block");
  return fmt::format(
      ", and its {:.2g} s are too short for blocks ({:g} s on either side of a block serve neither side, and half of "
      "the trial must be left to fit); record a second trial, or one of {:.2g} s or more",
      longest_s, kGap_s, kLeastForBlocks_s);
}

std::vector<Split> block_splits(const StudyData& data,
                                const std::vector<const TrialData*>& trials,
                                const CrossValidationOptions& how,
                                std::string& why_not) {
  if (std::ranges::none_of(trials, [](const TrialData* t) { return duration_s(*t) >= kLeastForBlocks_s; })) {
    why_not =
        (trials.size() > 1 ? fmt::format("no trial has the {:.2g} s from which blocks are left out", kLeastForBlocks_s)
                           : "there is only one trial to fit") +
        other_part(trials, how);
    return {};
  }
  std::vector<Split> result;
  for (int b = 0; b < kBlocks; ++b) {
    Split split{fmt::format("block {} of {}", b + 1, kBlocks),
                {.muscles = data.muscles, .trials = {}, .rules = data.rules}};
    for (const TrialData* trial : trials) {
      if (trial->reference || duration_s(*trial) < kLeastForBlocks_s) {
        split.data.trials.push_back(*trial);
      } else {
        cut(*trial, b, split);
      }
    }
    result.push_back(std::move(split));
  }
  return result;
}

std::vector<Split> named_splits(const StudyData& data,
                                const std::vector<const TrialData*>& trials,
                                const CrossValidationOptions& how,
                                std::string& why_not) {
  const auto name_of = [&](const TrialData& trial) {
    return how.kind == FoldKind::condition && !trial.condition.empty() ? trial.condition : trial.name;
  };
  std::vector<Split> result;
  for (const TrialData* trial : trials) {
    if (trial->reference) continue;
    const std::string name = name_of(*trial);
    if (std::any_of(result.begin(), result.end(), [&](const Split& s) { return s.name == name; })) continue;
    Split split{name, {.muscles = data.muscles, .trials = {}, .rules = data.rules}};
    for (const TrialData* other : trials)
      split.data.trials.push_back(used(*other, other->reference || name_of(*other) != name));
    result.push_back(std::move(split));
  }
  if (result.size() >= 2) return result;
  why_not = fmt::format("there is only one {} to fit{}", how.kind == FoldKind::condition ? "condition" : "trial",
                        other_part(trials, how));
  return {};
}

/// Returns the regressors of baseline (ii): activation times moment arm, per muscle.
Eigen::MatrixXd regressors(const StudyData& data, const TrialData& trial, double delay_s) {
  return muscle_activation(data, trial, delay_s).cwiseProduct(trial.moment_arm_m);
}

Eigen::VectorXd joined(const std::vector<Eigen::VectorXd>& parts) {
  Eigen::Index n = 0;
  for (const Eigen::VectorXd& x : parts) n += x.size();
  Eigen::VectorXd all(n);
  Eigen::Index at = 0;
  for (const Eigen::VectorXd& x : parts) {
    all.segment(at, x.size()) = x;
    at += x.size();
  }
  return all;
}

/// Returns the view of one joint in every trial that has it.
std::vector<TrialData> joint_views(const std::vector<TrialData>& trials, const std::string& joint) {
  std::vector<TrialData> views;
  for (const TrialData& trial : trials) {
    for (std::size_t j = 0; j < joint_count(trial); ++j) {
      if (joint_at(trial, j).joint == joint) views.push_back(of_joint(trial, j));
    }
  }
  return views;
}

/// The parameters that predict a fold.
struct Predictors {
  const StudyData& data;
  const IdentificationResult& fit;
  const TrialPredictions& predictions;
  std::vector<muscle::HillParameters<double>> literature;
  double literature_delay_s = 0.0;
  double cutoff_hz = 0.0;  ///< Cut-off of the fit.
};

/// The constants of the baselines, from the fitted trials.
struct Baselines {
  double gain = 0.0;       ///< Gain of the literature's muscles.
  Eigen::VectorXd slopes;  ///< Slopes of the torque on the regressors.
  double mean_nm = 0.0;
};

Baselines baselines(const std::vector<TrialData>& training, const Predictors& by) {
  double product = 0.0, square = 0.0, sum = 0.0, count = 0.0;
  const auto m = static_cast<Eigen::Index>(by.data.muscles.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(m, m);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(m);
  for (const TrialData& t : training) {
    // Every prediction includes the measured resting torque of the joint.
    const Eigen::VectorXd resting = resting_torque_nm(t);
    const Eigen::VectorXd active = t.torque_nm - resting;
    const Eigen::VectorXd torque =
        predict(by.data, t, by.literature, by.literature_delay_s, by.fit.lag).torque_nm - resting;
    product += torque.dot(active);
    square += torque.squaredNorm();
    sum += t.torque_nm.sum();
    count += static_cast<double>(t.torque_nm.size());
    const Eigen::MatrixXd x = regressors(by.data, t, by.fit.delay_s);
    normal += x.transpose() * x;
    right += x.transpose() * active;
  }
  return {.gain = square > 0.0 ? product / square : 0.0,
          .slopes = math::shortest_solution(normal, right),
          .mean_nm = sum / count};
}

/// Pairs of curves, trial after trial.
struct Curves {
  std::vector<Eigen::VectorXd> measured, predicted;
  void add(const Eigen::VectorXd& m, const Eigen::VectorXd& p) {
    measured.push_back(m);
    predicted.push_back(p);
  }
  [[nodiscard]] Score scored() const { return score(joined(measured), joined(predicted)); }
};

/// Returns the shift [s] of the prediction, within +-0.2 s, at which it correlates best with the measurement: positive
/// if the prediction comes late.
double best_lag_s(const Eigen::VectorXd& time_s, const Eigen::VectorXd& measured, const Eigen::VectorXd& predicted) {
  constexpr double kLimit_s = 0.2;
  const Eigen::Index n = time_s.size();
  if (n < 3) return 0.0;
  const double step = (time_s[n - 1] - time_s[0]) / static_cast<double>(n - 1);
  const auto most = std::min<Eigen::Index>(static_cast<Eigen::Index>(kLimit_s / step), n / 3);
  double best = -std::numeric_limits<double>::infinity();
  Eigen::Index at = 0;
  for (Eigen::Index k = -most; k <= most; ++k) {
    const Eigen::Index m = n - std::abs(k);
    const Eigen::VectorXd x = measured.segment(k < 0 ? -k : 0, m);
    const Eigen::VectorXd y = predicted.segment(k > 0 ? k : 0, m);
    const Eigen::ArrayXd xc = x.array() - x.mean();
    const Eigen::ArrayXd yc = y.array() - y.mean();
    const double size = std::sqrt(xc.square().sum() * yc.square().sum());
    const double correlation = size > 0.0 ? (xc * yc).sum() / size : 0.0;
    if (correlation > best) {
      best = correlation;
      at = k;
    }
  }
  return static_cast<double>(at) * step;
}

Fold score_joint(const std::string& name,
                 const std::vector<TrialData>& training,
                 const std::vector<TrialData>& held,
                 const Predictors& by) {
  const Baselines from = baselines(training, by);
  Fold fold;
  fold.trial = name;
  fold.gain = from.gain;
  std::vector<Eigen::VectorXd> time, deviation;
  Curves identified, band, literature, regression;
  for (const TrialData& t : held) {
    const std::vector<Eigen::Index> rows = included_rows(t);
    const TrialFit found = by.predictions.of(t);
    const Eigen::VectorXd& torque = found.torque_fit_nm;
    const Eigen::VectorXd resting = resting_torque_nm(t);
    const Eigen::VectorXd muscles =
        predict(by.data, t, by.literature, by.literature_delay_s, by.fit.lag).torque_nm - resting;
    const Eigen::VectorXd regressed = regressors(by.data, t, by.fit.delay_s) * from.slopes;
    const Eigen::VectorXd measured = t.torque_nm(rows);
    fold.add(found);
    time.emplace_back(t.time_s(rows));
    identified.add(measured, torque(rows));
    if (found.torque_sd_nm.size() > 0) deviation.emplace_back(found.torque_sd_nm(rows));
    band.add(below(t.time_s, t.torque_nm, by.cutoff_hz)(rows), below(t.time_s, torque, by.cutoff_hz)(rows));
    literature.add(measured, (resting + from.gain * muscles)(rows));
    regression.add(measured, (resting + regressed)(rows));
    fold.lag_s += best_lag_s(t.time_s, t.torque_nm, torque) / static_cast<double>(held.size());
  }
  Curves seen;
  for (const TrialData& t : training) {
    const std::vector<Eigen::Index> rows = included_rows(t);
    const Eigen::VectorXd torque = predict(by.data, t, by.fit.values, by.fit.lag).torque_nm;
    seen.add(t.torque_nm(rows), torque(rows));
  }
  fold.fitted = seen.scored();
  fold.time_s = joined(time);
  fold.measured_nm = joined(identified.measured);
  fold.predicted_nm = joined(identified.predicted);
  fold.predicted_sd_nm = joined(deviation);
  fold.literature_nm = joined(literature.predicted);
  fold.covered = covered_share(fold.measured_nm, fold.predicted_nm, fold.predicted_sd_nm);
  fold.identified = identified.scored();
  fold.band = band.scored();
  fold.literature = literature.scored();
  fold.regression = regression.scored();
  fold.constant = score(fold.measured_nm, Eigen::VectorXd::Constant(fold.measured_nm.size(), from.mean_nm));
  return fold;
}

/// Fits one split and scores the trials that it left out, joint by joint.
std::vector<Fold> score_split(Split split, const SplitFit& fit_to, const EstimatorOptions& options) {
  EstimatorOptions of_fold = of_a_fold(options);
  of_fold.drives = std::make_shared<DriveMemory>(of_fold.drives);
  const IdentificationResult fit = fit_to(split.data, of_fold);
  const TrialPredictions predictions(split.data, of_fold, fit);
  std::vector<muscle::HillParameters<double>> literature;
  for (const MuscleSetup& setup : split.data.muscles) literature.push_back(setup.start);
  const Predictors by{.data = split.data,
                      .fit = fit,
                      .predictions = predictions,
                      .literature = literature,
                      .literature_delay_s = options.usual_delay_s(),
                      .cutoff_hz = options.residual_cutoff_hz.value_or(0.0)};
  std::vector<TrialData> training, held;
  for (const TrialData& t : split.data.trials) (t.calibration ? training : held).push_back(t);
  std::vector<Fold> folds;
  const UnseenEffort unseen = unseen_effort(split.data);
  for (const std::string& joint : joint_names(split.data)) {
    const std::vector<TrialData> of_joint = joint_views(held, joint);
    if (of_joint.empty()) continue;
    Fold fold = score_joint(split.name, joint_views(training, joint), of_joint, by);
    fold.joint = joint;
    fold.parameters = fit.estimates;
    fold.lag = fit.lag;
    fold.unseen = unseen;
    fold.converged = fit.termination == math::Termination::converged;
    folds.push_back(std::move(fold));
  }
  return folds;
}

}  // namespace

std::vector<Split> splits(const StudyData& data, const CrossValidationOptions& how, std::string* why_not) {
  std::vector<const TrialData*> trials;
  for (const TrialData& trial : data.trials) {
    if (trial.calibration && trial.time_s.size() > 1) trials.push_back(&trial);
  }
  std::string reason;
  std::vector<Split> result =
      how.kind == FoldKind::block ? block_splits(data, trials, how, reason) : named_splits(data, trials, how, reason);
  if (why_not != nullptr) *why_not = std::move(reason);
  return result;
}

UnseenEffort unseen_effort(const StudyData& data) {
  constexpr double kWindow_s = 0.5;
  UnseenEffort found;
  for (const MuscleSetup& muscle : data.muscles) {
    double seen = 0.0, unseen = 0.0;
    for (const TrialData& trial : data.trials) {
      if (trial.time_s.size() == 0 || !trial.activation.find(muscle.emg_channel)) continue;
      const TimeSeries within = trial.activation.slice(trial.time_s[0], trial.time_s[trial.time_s.size() - 1]);
      if (within.sample_count() < 2) continue;
      double& most = trial.calibration ? seen : unseen;
      most = std::max(most, math::greatest_mean(within.column(muscle.emg_channel), within.mean_rate_hz(), kWindow_s));
    }
    if (seen > 0.0 && unseen > found.ratio * seen) found = {muscle.emg_channel, unseen / seen};
  }
  return found;
}

EstimatorOptions of_a_fold(EstimatorOptions options) {
  options.predictions = false;
  options.posterior_draws = 0;
  options.marginals = false;
  options.progress.report = nullptr;
  return options;
}

std::vector<Fold> cross_validate(const StudyData& data,
                                 const SplitFit& fit,
                                 const EstimatorOptions& options,
                                 const CrossValidationOptions& how) {
  std::vector<Split> all = splits(data, how);
  const EstimatorOptions shared = remembering_drives(options);
  std::vector<std::vector<Fold>> of_split(all.size());
  std::atomic<std::size_t> done{0};
  parallel_each(all.size(), [&](std::size_t f) {
    of_split[f] = score_split(std::move(all[f]), fit, shared);
    const std::size_t ended = ++done;
    options.progress.tell(static_cast<double>(ended) / static_cast<double>(all.size()),
                          fmt::format("predicts parts left out, {} of {} done", ended, all.size()));
  });
  std::vector<Fold> folds;
  for (std::vector<Fold>& of_one : of_split) std::move(of_one.begin(), of_one.end(), std::back_inserter(folds));
  return folds;
}

}  // namespace myoid::fit
