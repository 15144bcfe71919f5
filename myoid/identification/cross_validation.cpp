#include "myoid/identification/cross_validation.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <Eigen/QR>
#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "myoid/identification/paper.h"

namespace myoid::identification {
namespace {

/// What a fold is fitted on, and what it predicts.
struct Split {
  std::string name;
  std::vector<TrialData> training, held;
};

std::vector<Split> make_splits(const StudyData& data, const CrossValidationOptions& options) {
  std::vector<Split> splits;
  std::vector<const TrialData*> trials;
  for (const TrialData& trial : data.trials) {
    if (trial.calibration) trials.push_back(&trial);
  }
  if (options.kind == FoldKind::block) {
    for (int b = 0; b < options.blocks; ++b) {
      Split split;
      split.name = fmt::format("block {} of {}", b + 1, options.blocks);
      for (const TrialData* trial : trials) {
        const Eigen::Index n = trial->time_s.size();
        const Eigen::Index begin = n * b / options.blocks;
        const Eigen::Index end = n * (b + 1) / options.blocks;
        const double rate = static_cast<double>(n - 1) / (trial->time_s[n - 1] - trial->time_s[0]);
        const auto gap = static_cast<Eigen::Index>(std::ceil(options.gap_s * rate));
        if (end - begin < 4) continue;
        split.held.push_back(part(*trial, begin, end - begin));
        if (begin - gap > 10) split.training.push_back(part(*trial, 0, begin - gap));
        if (n - end - gap > 10) split.training.push_back(part(*trial, end + gap, n - end - gap));
      }
      splits.push_back(std::move(split));
    }
  } else {
    std::vector<std::string> names;
    const auto name_of = [&](const TrialData& trial) {
      return options.kind == FoldKind::condition && !trial.condition.empty() ? trial.condition
                                                                             : trial.name;
    };
    for (const TrialData* trial : trials) {
      const std::string name = name_of(*trial);
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    for (const std::string& name : names) {
      Split split;
      split.name = name;
      for (const TrialData* trial : trials)
        (name_of(*trial) == name ? split.held : split.training).push_back(*trial);
      splits.push_back(std::move(split));
    }
  }
  std::erase_if(splits, [](const Split& s) { return s.held.empty() || s.training.empty(); });
  if (splits.size() < 2) splits.clear();
  return splits;
}

/// Regressors of baseline (ii): activation times moment arm, per muscle.
Eigen::MatrixXd regressors(const StudyData& data, const TrialData& trial, double delay_s) {
  return muscle_activation(data, trial, trial.time_s, delay_s).cwiseProduct(trial.moment_arm_m);
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

/// The one joint's part of every trial that has it.
std::vector<TrialData> joint_views(const std::vector<TrialData>& trials, const std::string& joint) {
  std::vector<TrialData> views;
  for (const TrialData& trial : trials) {
    for (std::size_t j = 0; j < joint_count(trial); ++j) {
      const std::string& name = j == 0 ? trial.joint : trial.more_joints[j - 1].name;
      if (name == joint) views.push_back(of_joint(trial, j));
    }
  }
  return views;
}

/// Parameters by which a fold is predicted.
struct Predictors {
  const StudyData& data;
  const IdentificationResult& fit;
  std::vector<muscle::HillParameters<double>> literature, shortening, lengthening;
  double literature_delay_s = 0.0;
  double cutoff_hz = 0.0;  ///< Of the fit.
  double envelope_cutoff_hz = 0.0;
  bool paper = false;
};

Fold score_joint(const std::string& name,
                 const std::vector<TrialData>& training,
                 const std::vector<TrialData>& held,
                 const Predictors& by) {
  // Baselines from the training trials.
  double product = 0.0, square = 0.0, sum = 0.0, count = 0.0;
  const auto m = static_cast<Eigen::Index>(by.data.muscles.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(m, m);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(m);
  for (const TrialData& t : training) {
    // Whoever predicts knows what the joint was measured to do by itself.
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
  const Eigen::VectorXd slopes = normal.completeOrthogonalDecomposition().solve(right);
  Fold fold;
  fold.trial = name;
  fold.gain = square > 0.0 ? product / square : 0.0;
  std::vector<Eigen::VectorXd> time, measured, predicted, by_literature, by_regression, by_paper;
  std::vector<Eigen::VectorXd> slow_measured, slow_predicted;
  for (const TrialData& t : held) {
    const std::vector<Eigen::Index> rows = included_rows(t);
    const SmoothPrediction found = predict(by.data, t, by.fit, by.envelope_cutoff_hz).smooth;
    const Eigen::VectorXd& whole = found.torque_nm;
    // The others carry the same noise, and have the same smoothing.
    const auto smooth = [&](const Eigen::VectorXd& torque) {
      return below(t.time_s, torque, found.cutoff_hz);
    };
    const Eigen::VectorXd resting = resting_torque_nm(t);
    const Eigen::VectorXd muscles =
        predict(by.data, t, by.literature, by.literature_delay_s, by.fit.lag).torque_nm - resting;
    const Eigen::VectorXd before = resting + fold.gain * smooth(muscles);
    const Eigen::VectorXd regressed =
        resting + smooth(regressors(by.data, t, by.fit.delay_s) * slopes);
    time.emplace_back(t.time_s(rows));
    measured.emplace_back(t.torque_nm(rows));
    predicted.emplace_back(whole(rows));
    slow_measured.emplace_back(below(t.time_s, t.torque_nm, by.cutoff_hz)(rows));
    slow_predicted.emplace_back(below(t.time_s, whole, by.cutoff_hz)(rows));
    by_literature.emplace_back(before(rows));
    by_regression.emplace_back(regressed(rows));
    if (by.paper) {
      const Eigen::MatrixXd slow = predict(by.data, t, by.shortening, 0.0).force_n;
      const Eigen::MatrixXd fast = predict(by.data, t, by.lengthening, 0.0).force_n;
      const Eigen::MatrixXd force = (t.velocity_mps.array() <= 0.0).select(slow, fast);
      const Eigen::VectorXd paper =
          resting + smooth(t.moment_arm_m.cwiseProduct(force).rowwise().sum());
      by_paper.emplace_back(paper(rows));
    }
    fold.lag_s += best_lag_s(t.time_s, t.torque_nm, whole) / static_cast<double>(held.size());
  }
  fold.time_s = joined(time);
  fold.measured_nm = joined(measured);
  fold.predicted_nm = joined(predicted);
  fold.literature_nm = joined(by_literature);
  fold.identified = score(fold.measured_nm, fold.predicted_nm);
  fold.band = score(joined(slow_measured), joined(slow_predicted));
  fold.literature = score(fold.measured_nm, fold.literature_nm);
  fold.regression = score(fold.measured_nm, joined(by_regression));
  fold.constant =
      score(fold.measured_nm, Eigen::VectorXd::Constant(fold.measured_nm.size(), sum / count));
  if (by.paper) fold.paper = score(fold.measured_nm, joined(by_paper));
  return fold;
}

}  // namespace

double best_lag_s(const Eigen::VectorXd& time_s,
                  const Eigen::VectorXd& measured,
                  const Eigen::VectorXd& predicted,
                  double limit_s) {
  const Eigen::Index n = time_s.size();
  if (n < 3) return 0.0;
  const double step = (time_s[n - 1] - time_s[0]) / static_cast<double>(n - 1);
  const auto most = std::min<Eigen::Index>(static_cast<Eigen::Index>(limit_s / step), n / 3);
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

std::vector<Fold> cross_validate(const StudyData& data,
                                 const TorqueOptions& options,
                                 const CrossValidationOptions& how) {
  const std::vector<Split> splits = make_splits(data, how);
  std::vector<muscle::HillParameters<double>> literature;
  for (const MuscleSetup& setup : data.muscles) literature.push_back(setup.start);
  const std::vector<std::string> joints = joint_names(data);
  std::vector<std::vector<Fold>> of_split(splits.size());
  oneapi::tbb::parallel_for(std::size_t{0}, splits.size(), [&](std::size_t f) {
    const Split& split = splits[f];
    StudyData training = data;
    training.trials = split.training;
    TorqueOptions once = options;
    once.starts = 1;
    once.multistart = 0;
    once.passes =
        once.warm_start.size() > 0 ? 2 : once.passes;  // the noise hardly changes with one trial
    once.predictions = false;
    once.intervals = {};
    once.progress.report = nullptr;
    const IdentificationResult fit = identify_torque(training, once);
    Predictors by{.data = data,
                  .fit = fit,
                  .literature = literature,
                  .shortening = literature,
                  .lengthening = literature,
                  .literature_delay_s = options.delay_s.value_or(options.delay_prior_mean_s),
                  .cutoff_hz = options.residual_cutoff_hz.value_or(0.0),
                  .envelope_cutoff_hz = options.envelope_cutoff_hz};
    by.paper = std::all_of(split.training.begin(), split.training.end(),
                           [](const TrialData& t) { return t.force_n.rows() == t.time_s.size(); });
    if (by.paper) {
      for (const ParameterEstimate& e :
           identify_paper(training, {.muscles = options.muscles}).estimates) {
        if (!std::isfinite(e.estimate)) continue;
        for (std::size_t k = 0; k < data.muscles.size(); ++k) {
          if (data.muscles[k].name == e.muscle)
            (e.fit_case == "shortening" ? by.shortening : by.lengthening)[k].*
                muscle::hill_field(e.parameter).member = e.estimate;
        }
      }
    }
    for (const std::string& joint : joints) {
      const std::vector<TrialData> held = joint_views(split.held, joint);
      if (held.empty()) continue;
      of_split[f].push_back(score_joint(split.name, joint_views(split.training, joint), held, by));
      of_split[f].back().joint = joint;
    }
  });
  std::vector<Fold> folds;
  for (std::vector<Fold>& of_one : of_split)
    std::move(of_one.begin(), of_one.end(), std::back_inserter(folds));
  return folds;
}

}  // namespace myoid::identification
