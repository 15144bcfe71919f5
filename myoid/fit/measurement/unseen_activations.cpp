#include "myoid/fit/measurement/unseen_activations.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/ground/core/error.h"

namespace myoid::fit {
namespace {

constexpr double kInterval_s = 0.01;  // at which envelopes are factorized
constexpr Eigen::Index kMostEnvelopeRows = 4000;
constexpr int kPasses = 400;  // multiplicative updates
constexpr double kTiny = 1e-12;
constexpr const char* kConstantName = "expected activation without EMG";

/// Returns every stride-th row of the channels in a trial, never below zero.
Eigen::MatrixXd envelopes_in(const TrialData& trial, const std::vector<std::string>& channels, Eigen::Index stride) {
  const Eigen::MatrixXd values = trial.activation.select(channels).values().cwiseMax(0.0);
  const Eigen::Index rows = (values.rows() + stride - 1) / stride;
  return values(Eigen::seqN(0, rows, stride), Eigen::all);
}

Eigen::Index stride_of(const TrialData& trial) {
  return std::max<Eigen::Index>(1, std::lround(kInterval_s / trial.activation.mean_interval_s()));
}

/// Returns the envelopes of the fitted trials, one below the other.
Eigen::MatrixXd fitted_envelopes(const StudyData& data, const std::vector<std::string>& channels) {
  Eigen::MatrixXd all(0, static_cast<Eigen::Index>(channels.size()));
  for (const TrialData& trial : data.trials) {
    if (!trial.calibration) continue;
    const Eigen::MatrixXd here = envelopes_in(trial, channels, stride_of(trial));
    all.conservativeResize(all.rows() + here.rows(), Eigen::NoChange);
    all.bottomRows(here.rows()) = here;
  }
  const Eigen::Index stride = std::max<Eigen::Index>(1, all.rows() / kMostEnvelopeRows);
  return all(Eigen::seqN(0, (all.rows() + stride - 1) / stride, stride), Eigen::all);
}

/// Improves H by Lee and Seung's multiplicative rule (Nature 401, 788, 1999): no step leaves the non-negative numbers,
/// and none enlarges the distance from X to H W'.
void improve(const Eigen::MatrixXd& x, const Eigen::MatrixXd& w, Eigen::MatrixXd& h) {
  const Eigen::MatrixXd wanted = x * w, found = h * (w.transpose() * w);
  h.array() *= (wanted.array() + kTiny) / (found.array() + kTiny);
}

/// Returns rows of X that are far from each other's span, as the first synergies.
Eigen::MatrixXd far_rows(const Eigen::MatrixXd& x, Eigen::Index count) {
  Eigen::MatrixXd left = x, w(x.cols(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    Eigen::Index row = 0;
    left.rowwise().squaredNorm().maxCoeff(&row);
    w.col(k) = x.row(row).transpose().array() + 1e-3 * x.maxCoeff();
    const Eigen::VectorXd direction = left.row(row).transpose().normalized();
    left -= (left * direction) * direction.transpose();
  }
  return w;
}

/// Adds the channels unless the trial has them.
void add_channels(TrialData& trial, const std::vector<std::string>& names, const Eigen::MatrixXd& values) {
  if (trial.activation.find(names.front())) return;
  std::vector<Channel> channels = trial.activation.channels();
  for (const std::string& name : names) channels.push_back({name, Unit::dimensionless});
  Eigen::MatrixXd all(values.rows(), trial.activation.channel_count() + values.cols());
  all << trial.activation.values(), values;
  trial.activation = TimeSeries(trial.activation.time_s(), std::move(channels), std::move(all));
}

std::vector<std::string> add_constant(StudyData& data) {
  for (TrialData& trial : data.trials)
    add_channels(trial, {kConstantName},
                 Eigen::VectorXd::Constant(trial.activation.sample_count(), beliefs::kUnseenActivation.value));
  return {kConstantName};
}

/// Adds the synergies to all trials; together they have the mean activation that is believed.
std::vector<std::string> add_synergies(StudyData& data, const std::vector<std::string>& channels) {
  const Eigen::MatrixXd fitted = fitted_envelopes(data, channels);
  // No channel counts more than another one because its muscle acts more.
  const Eigen::RowVectorXd size = fitted.colwise().norm().cwiseMax(kTiny);
  const Eigen::MatrixXd w = synergies_of(fitted.array().rowwise() / size.array());
  const Eigen::RowVectorXd mean =
      activations_of(w, fitted.array().rowwise() / size.array()).colwise().mean().cwiseMax(kTiny);
  std::vector<std::string> names;
  for (Eigen::Index k = 0; k < w.cols(); ++k) names.push_back(fmt::format("synergy {} of the EMG", k + 1));
  const double each = beliefs::kUnseenActivation.value / static_cast<double>(w.cols());
  for (TrialData& trial : data.trials) {
    const Eigen::MatrixXd h = activations_of(w, envelopes_in(trial, channels, 1).array().rowwise() / size.array());
    add_channels(trial, names, each * (h.array().rowwise() / mean.array()).matrix());
  }
  return names;
}

/// Fills the prior of one muscle and adds the sum of its parts to every trial.
void expect(const std::vector<std::string>& parts, double cutoff_hz, MuscleSetup& muscle, StudyData& data) {
  const bool constant = muscle.unseen->by == WithoutEmg::unseen;
  muscle.unseen->parts = parts;
  muscle.unseen->part_sd = constant ? 0.0 : beliefs::kSynergyWeight.sd;
  muscle.unseen->sd = (constant ? beliefs::kUnseenActivation : beliefs::kOwnActivation).sd;
  muscle.unseen->cutoff_hz = cutoff_hz;
  for (TrialData& trial : data.trials) {
    const Eigen::VectorXd sum = trial.activation.select(parts).values().rowwise().sum();
    add_channels(trial, {muscle.emg_channel}, sum);
  }
}

}  // namespace

std::vector<std::string> measured_channels(const StudyData& data) {
  std::vector<std::string> names;
  for (const MuscleSetup& muscle : data.muscles)
    if (!muscle.unseen && !contains(names, muscle.emg_channel)) names.push_back(muscle.emg_channel);
  return names;
}

Eigen::MatrixXd activations_of(const Eigen::MatrixXd& synergies, const Eigen::MatrixXd& envelopes) {
  Eigen::MatrixXd h = (envelopes * synergies).cwiseMax(kTiny);
  for (int pass = 0; pass < kPasses; ++pass) improve(envelopes, synergies, h);
  return h;
}

Eigen::MatrixXd synergies_of(const Eigen::MatrixXd& envelopes, double unexplained) {
  const double all = std::max(envelopes.squaredNorm(), kTiny);
  Eigen::MatrixXd w;
  for (Eigen::Index count = 1; count <= envelopes.cols(); ++count) {
    w = far_rows(envelopes, count);
    Eigen::MatrixXd h = (envelopes * w).cwiseMax(kTiny);
    for (int pass = 0; pass < kPasses; ++pass) {
      improve(envelopes, w, h);
      improve(envelopes.transpose(), h, w);
    }
    if ((envelopes - h * w.transpose()).squaredNorm() <= unexplained * all) break;
  }
  return w;
}

double bandwidth_hz(const Eigen::MatrixXd& values, double interval_s) {
  constexpr double kSlowest_hz = 0.25, kFastest_hz = 6.0;
  constexpr double kAtHalf = 0.3017;  // sin(x) / x = 1/2 at x = 2 pi times this
  const Eigen::MatrixXd changes = values.rowwise() - values.colwise().mean();
  const double variance = changes.squaredNorm() / static_cast<double>(changes.rows());
  const auto last =
      std::min<Eigen::Index>(changes.rows() - 1, static_cast<Eigen::Index>(kAtHalf / kSlowest_hz / interval_s));
  double before = variance;
  for (Eigen::Index lag = 1; lag <= last && variance > 0.0; ++lag) {
    const Eigen::Index rows = changes.rows() - lag;
    const double here = changes.topRows(rows).cwiseProduct(changes.bottomRows(rows)).sum() / static_cast<double>(rows);
    if (here <= 0.5 * variance) {
      const double part = (before - 0.5 * variance) / std::max(before - here, kTiny);
      return std::clamp(kAtHalf / ((static_cast<double>(lag - 1) + part) * interval_s), kSlowest_hz, kFastest_hz);
    }
    before = here;
  }
  return kSlowest_hz;
}

std::string without_emg_says(const std::string& muscle) {
  return fmt::format(
      "no EMG of {} was recorded: its force is the product of F_max and an activation that is not known; record its "
      "EMG",
      muscle);
}

void expect_activations(StudyData& data) {
  const auto uses = [&](WithoutEmg by) {
    return std::ranges::any_of(data.muscles,
                               [&](const MuscleSetup& muscle) { return muscle.unseen && muscle.unseen->by == by; });
  };
  if (!uses(WithoutEmg::unseen) && !uses(WithoutEmg::synergies)) return;
  const std::vector<std::string> channels = measured_channels(data);
  if (channels.empty())
    throw InvalidInput("no muscle has EMG, expected EMG of one at least: the torque alone tells no muscle");
  double cutoff_hz = 0.0, fitted = 0.0;
  for (const TrialData& trial : data.trials) {
    if (!trial.calibration) continue;
    const Eigen::Index stride = stride_of(trial);
    cutoff_hz += bandwidth_hz(envelopes_in(trial, channels, stride),
                              static_cast<double>(stride) * trial.activation.mean_interval_s());
    ++fitted;
  }
  cutoff_hz /= std::max(fitted, 1.0);
  std::vector<std::string> constant, synergies;
  if (uses(WithoutEmg::unseen)) constant = add_constant(data);
  if (uses(WithoutEmg::synergies)) synergies = add_synergies(data, channels);
  for (MuscleSetup& muscle : data.muscles)
    if (muscle.unseen) expect(muscle.unseen->by == WithoutEmg::unseen ? constant : synergies, cutoff_hz, muscle, data);
}

void expect_activations_of(const StudyData& fitted, std::vector<TrialData>& others) {
  const std::vector<std::string> channels = measured_channels(fitted);
  if (std::ranges::none_of(fitted.muscles, [](const MuscleSetup& muscle) { return muscle.unseen.has_value(); })) return;
  StudyData both = fitted;
  for (TrialData& trial : others) {
    trial.calibration = false;
    trial.activation = trial.activation.select(channels);
    both.trials.push_back(trial);
  }
  expect_activations(both);
  std::ranges::copy(both.trials.end() - std::ssize(others), both.trials.end(), others.begin());
}

}  // namespace myoid::fit
