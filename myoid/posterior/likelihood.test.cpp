#include "myoid/posterior/likelihood.h"

#include <cmath>
#include <complex>
#include <numbers>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "myoid/core/error.h"

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

using test::elbow_study;
using test::ElbowStudy;
using test::freed;

/// Two trials, each with its own share of the torque's error.
const NoiseValues kNoise = (NoiseValues(6) << -0.9, -1.4, 0.1, -3.0, 0.3, -0.4).finished();

/// Two muscles on one electrode, exponent, gain, offset and an elastic law of length free.
ElbowStudy crowded_study() {
  ElbowStudy study = elbow_study(
      {.trials = 2, .seconds = 6.0, .emg_cv = 0.08, .torque_sd_nm = 0.4, .with_priors = true});
  study.data.muscles[1].emg_channel = study.data.muscles[0].emg_channel;
  study.data.rules = {freed("emg_exponent"), freed("length_activation"),
                      freed("joint_torque_offset")};
  study.data.rules[0].value = 1.2;
  study.data.rules[1].tie = true;
  study.data.rules[1].value = 0.1;
  return study;
}

EstimatorOptions crowded_options() {
  EstimatorOptions options;
  options.angle_sd_rad = 0.01;
  for (const char* channel : {"BIC", "BRD", "TRI"}) {
    options.gain_prior_sd[channel] = 0.1;
    options.emg_bandwidth_hz[channel] = 150.0;
  }
  return options;
}

/// Torque of one muscle by the plain law: activation a (n), arms, lengths and rates of the run.
Eigen::VectorXd written_muscle(const TrialRun& run,
                               std::size_t k,
                               const MuscleValues& p,
                               const Eigen::VectorXd& a) {
  const auto column = static_cast<Eigen::Index>(k);
  Eigen::VectorXd torque(run.time_s.size());
  for (Eigen::Index i = 0; i < torque.size(); ++i) {
    const double v = run.velocity_mps(i, column), vm = p[kSpeed];
    const double off = run.length_m(i, column) - p[kSlack] - p[kFiberLength];
    double fv = 0.0;
    if (v > 0.0) {
      fv = (p[kProduct] * vm + p[kPlateau] * v) / (p[kProduct] * vm + v);
    } else if (v > -vm) {
      fv = p[kCurvature] * (vm + v) / (p[kCurvature] * vm - v);
    }
    torque[i] =
        run.arm_m(i, column) * p[kMaxForce] * a[i] * std::exp(-std::pow(off / p[kWidth], 2)) * fv;
  }
  return torque;
}

/// L by its definition: weights of a Gaussian of -3 dB at the cut-off, to three widths, in rows
/// that are a third of a period apart, all inside the run and as far from both ends.
Eigen::MatrixXd written_low_pass(const TrialRun& run, double cutoff_hz) {
  const Eigen::Index n = run.time_s.size();
  const double width =
      std::sqrt(std::numbers::ln2) / (2.0 * std::numbers::pi * cutoff_hz) / run.interval_s;
  const auto reach = static_cast<Eigen::Index>(std::ceil(3.0 * width));
  const auto apart =
      static_cast<Eigen::Index>(std::lround(1.0 / (3.0 * cutoff_hz * run.interval_s)));
  const Eigen::Index free = n - 2 * reach - 1;
  Eigen::MatrixXd l = Eigen::MatrixXd::Zero(free / apart + 1, n);
  for (Eigen::Index j = 0; j < l.rows(); ++j) {
    const Eigen::Index centre = reach + free % apart / 2 + j * apart;
    for (Eigen::Index i = centre - reach; i <= centre + reach; ++i)
      l(j, i) = std::exp(-0.5 * std::pow(static_cast<double>(i - centre) / width, 2));
    l.row(j) /= l.row(j).sum();
  }
  return l;
}

/// The symmetric square root of the Toeplitz matrix of R on a line of n + 2 margin samples, its
/// middle n rows: white noise through it has the autocorrelation R.
Eigen::MatrixXd written_noise_filter(const EnvelopeError& error,
                                     Eigen::Index n,
                                     Eigen::Index margin,
                                     double interval_s) {
  const Eigen::VectorXd h = error.from_white(interval_s);
  const Eigen::Index reach = h.size() / 2;
  Eigen::MatrixXd filter = Eigen::MatrixXd::Zero(n, n + 2 * margin);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = -reach; j <= reach; ++j) filter(i, i + margin + j) = h[reach + j];
  return filter;
}

TEST(Likelihood, TheValueIsThatOfTheWholeCovarianceWrittenOut) {
  ElbowStudy study = elbow_study(
      {.trials = 2, .seconds = 7.0, .emg_cv = 0.08, .torque_sd_nm = 0.4, .with_priors = true});
  // The second muscle shares the electrode of the first.
  study.data.muscles[1].emg_channel = study.data.muscles[0].emg_channel;
  EstimatorOptions options;
  options.angle_sd_rad = 0.01;
  options.angle_rate_sd_radps = 0.1;
  Likelihood likelihood(study.data, options);
  const ParameterMap& map = likelihood.parameters();
  const Eigen::VectorXd reference = map.start();
  Eigen::VectorXd z = reference;
  for (Eigen::Index j = 0; j < z.size(); ++j)
    z[j] += 0.1 * map.free()[static_cast<std::size_t>(j)].prior.sd *
            std::sin(1.0 + 2.0 * static_cast<double>(j));
  const ModelValues values = map.values(z), before = map.values(reference);
  const std::vector<TrialRun>& runs = likelihood.runs();
  ASSERT_EQ(runs.size(), 2U);
  for (const Believed believed : {Believed::nothing_exact, Believed::geometry_and_sensors_exact}) {
    likelihood.believe(believed);
    const Eigen::Index rows = likelihood.row_count();
    Eigen::MatrixXd sigma = Eigen::MatrixXd::Zero(rows, rows);
    Eigen::VectorXd residual(rows);
    Eigen::MatrixXd shapes(rows, static_cast<Eigen::Index>(likelihood.unseen().quantities.size()));
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(shapes.cols());
    Eigen::Index first = 0;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const TrialRun& run = runs[r];
      const Eigen::Index n = run.time_s.size(), m = run.measured_nm.size();
      const Eigen::MatrixXd l = written_low_pass(run, 1.5);
      ASSERT_EQ(l.rows(), m);
      Eigen::VectorXd torque = Eigen::VectorXd::Zero(n);
      Eigen::MatrixXd by_channel = Eigen::MatrixXd::Zero(n, 3);
      Eigen::VectorXd motion = Eigen::VectorXd::Zero(n);
      for (std::size_t k = 0; k < 4; ++k) {
        const auto c = static_cast<std::size_t>(map.channel_of_muscle(k));
        const auto column = static_cast<Eigen::Index>(k);
        const auto a = [&](const ModelValues& of) {
          return Eigen::VectorXd(run.time_s.unaryExpr(
              [&](double t) { return run.envelopes[c].at(t - of.channels[c][kDelay]).value; }));
        };
        const Eigen::VectorXd own = written_muscle(run, k, values.muscles[k], a(values));
        torque += own;
        // The torque is proportional to the activation, and so to the envelope.
        by_channel.col(static_cast<Eigen::Index>(c)) += own;
        const double h = 1e-5;
        const auto change = [&](Eigen::MatrixXd TrialRun::*what) {
          TrialRun longer = run, shorter = run;
          (longer.*what).col(column).array() += h;
          (shorter.*what).col(column).array() -= h;
          const Eigen::VectorXd at = a(before);
          return Eigen::VectorXd((written_muscle(longer, k, before.muscles[k], at) -
                                  written_muscle(shorter, k, before.muscles[k], at)) /
                                 (2.0 * h));
        };
        // dq moves a length by -r dq and a rate by -r dq'.
        const auto arm = run.arm_m.col(column).array();
        motion.array() += (0.01 * arm * change(&TrialRun::length_m).array()).square() +
                          (0.1 * arm * change(&TrialRun::velocity_mps).array()).square();
      }
      Eigen::MatrixXd q = motion.asDiagonal();
      for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < n; ++j)
          q(i, j) +=
              std::exp(2.0 * (kNoise[kTorqueSd] + kNoise[kNoiseFieldCount + run.trial]) -
                       std::abs(run.time_s[i] - run.time_s[j]) / std::exp(kNoise[kTorqueTime]));
      }
      for (std::size_t c = 0; c < 3; ++c) {
        const Eigen::Index margin = run.errors[c].from_white(run.interval_s).size() / 2;
        const Eigen::MatrixXd filter =
            written_noise_filter(run.errors[c], n, margin, run.interval_s);
        Eigen::VectorXd modulation(n + 2 * margin);
        for (Eigen::Index i = 0; i < modulation.size(); ++i)
          modulation[i] = by_channel(std::clamp<Eigen::Index>(i - margin, 0, n - 1),
                                     static_cast<Eigen::Index>(c));
        // 0.57 / (2 B T), T the time that two passes of second order average.
        const double variance = 0.7555 * 0.7555 /
                                (2.0 * 150.0 * 0.4815 / options.envelope_cutoff_hz) *
                                run.errors[c].share();
        const Eigen::MatrixXd root = filter * modulation.asDiagonal();
        q += std::exp(2.0 * kNoise[kEmgFactor]) * variance * root * root.transpose();
      }
      sigma.block(first, first, m, m) = l * q * l.transpose();
      residual.segment(first, m) = run.measured_nm - l * torque;
      shapes.middleRows(first, m) = l * likelihood.unseen().columns[r];
      first += m;
    }
    for (Eigen::Index i = 0; i < shapes.cols(); ++i) {
      const UnseenQuantity& of = likelihood.unseen().quantities[static_cast<std::size_t>(i)];
      if (believed == Believed::geometry_and_sensors_exact && of.source != Source::model) continue;
      const double weight = of.weight * (of.of_the_model ? std::exp(kNoise[kModelErrorSize]) : 1.0);
      sigma += weight * weight * shapes.col(i) * shapes.col(i).transpose();
      weights[i] = weight;
    }
    const Eigen::LDLT<Eigen::MatrixXd> factor(sigma);
    const double direct =
        -0.5 * residual.dot(factor.solve(residual)) - 0.5 * factor.vectorD().array().log().sum();
    // The program's derivatives by ln u, length and rate are secants.
    EXPECT_NEAR(likelihood.value(z, kNoise), direct, 1e-5 * std::abs(direct));
    // The unseen quantities given the torque: conditional moments of a joint normal density.
    const Eigen::MatrixXd weighted = shapes * weights.asDiagonal();
    const Eigen::MatrixXd gain = factor.solve(weighted);
    const Likelihood::UnseenGiven given = likelihood.unseen_given(z, kNoise);
    EXPECT_LT((given.mean - gain.transpose() * residual).cwiseAbs().maxCoeff(), 1e-4);
    const Eigen::MatrixXd left =
        Eigen::MatrixXd::Identity(weights.size(), weights.size()) - weighted.transpose() * gain;
    EXPECT_LT((given.covariance - left).cwiseAbs().maxCoeff(), 1e-4);
  }
}

TEST(Likelihood, TheGradientIsThatOfDifferences) {
  const ElbowStudy study = crowded_study();
  for (const Believed believed : {Believed::nothing_exact, Believed::geometry_and_sensors_exact}) {
    Likelihood likelihood(study.data, crowded_options());
    likelihood.believe(believed);
    Eigen::VectorXd z = likelihood.parameters().start();
    for (Eigen::Index j = 0; j < z.size(); ++j)
      z[j] += 0.1 * likelihood.parameters().free()[static_cast<std::size_t>(j)].prior.sd *
              std::cos(3.0 * static_cast<double>(j));
    Likelihood::Gradient gradient;
    EXPECT_EQ(likelihood.value(z, kNoise, &gradient), likelihood.value(z, kNoise));
    const auto slope = [](const auto& at, double h) {
      return (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
    };
    for (Eigen::Index j = 0; j < z.size(); ++j) {
      const Unknown& of = likelihood.parameters().free()[static_cast<std::size_t>(j)];
      const double difference = slope(
          [&](double h) {
            return likelihood.value(z + h * Eigen::VectorXd::Unit(z.size(), j), kNoise);
          },
          1e-3 * std::max(1e-3, of.prior.sd));
      EXPECT_NEAR(gradient.by_z[j], difference, 1e-4 * (1.0 + std::abs(difference))) << of.label;
    }
    for (Eigen::Index i = 0; i < kNoise.size(); ++i) {
      const double difference = slope(
          [&](double h) {
            NoiseValues moved = kNoise;
            moved[i] += h;
            return likelihood.value(z, moved);
          },
          1e-3);
      EXPECT_NEAR(gradient.by_noise[i], difference, 1e-5 * (1.0 + std::abs(difference))) << i;
    }
  }
}

TEST(Likelihood, TheUnseenQuantitiesAreThoseOfTheReference) {
  const ElbowStudy study = crowded_study();
  Likelihood likelihood(study.data, crowded_options());
  const Eigen::VectorXd z = likelihood.parameters().start();
  const double value = likelihood.value(z, kNoise);
  Eigen::VectorXd stronger = z;
  stronger[0] += 0.3;
  likelihood.refer_to(stronger);
  const double other = likelihood.value(z, kNoise);
  EXPECT_GT(std::abs(other - value), 1e-3);
  // A muscle that is stronger by e^0.3 has columns that are as much larger.
  const auto name = study.data.muscles[0].name + ".error_strength";
  const Unseen& unseen = likelihood.unseen();
  for (std::size_t i = 0; i < unseen.quantities.size(); ++i) {
    if (unseen.quantities[i].name != name) continue;
    const Eigen::VectorXd more = unseen.columns[0].col(static_cast<Eigen::Index>(i));
    const Likelihood fresh(study.data, crowded_options());
    const Eigen::VectorXd plain = fresh.unseen().columns[0].col(static_cast<Eigen::Index>(i));
    EXPECT_LT((more - std::exp(0.3) * plain).norm(), 1e-9 * more.norm());
  }
  likelihood.refer_to(z);
  EXPECT_EQ(likelihood.value(z, kNoise), value);
}

TEST(Likelihood, HasTheSameBitsForEveryNumberOfThreads) {
  const ElbowStudy study = crowded_study();
  const Likelihood likelihood(study.data, crowded_options());
  using Limit = oneapi::tbb::global_control;
  const auto on = [&](std::size_t threads, Likelihood::Gradient& gradient) {
    const Limit limit(Limit::max_allowed_parallelism, threads);
    return likelihood.value(likelihood.parameters().start(), kNoise, &gradient);
  };
  Likelihood::Gradient one, three;
  const double value = on(1, one);
  EXPECT_EQ(value, on(3, three));
  EXPECT_EQ(one.by_z, three.by_z);
  EXPECT_EQ(one.by_noise, three.by_noise);
}

TEST(Likelihood, TheSharesOfTheSourcesAddToTheInformation) {
  const ElbowStudy study = crowded_study();
  const Likelihood likelihood(study.data, crowded_options());
  const Eigen::VectorXd z = likelihood.parameters().start();
  const Likelihood::Information found = likelihood.information(z, kNoise);
  EXPECT_GT(found.information(0, 0), 0.0);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(z.size(), z.size());
  for (const Eigen::MatrixXd& part : found.by_source) sum += part;
  EXPECT_LT((sum - found.information).norm(), 1e-9 * sum.norm());
  for (const Eigen::MatrixXd& part : found.by_source)
    EXPECT_GE(part.diagonal().minCoeff(), -1e-9 * sum.norm());
}

TEST(Likelihood, RefusesSeveralJoints) {
  ElbowStudy study = elbow_study({.trials = 1, .seconds = 5.0});
  JointData wrist;
  wrist.name = "wrist";
  wrist.torque_nm = study.data.trials[0].torque_nm;
  wrist.moment_arm_m = study.data.trials[0].moment_arm_m;
  study.data.trials[0].more_joints.push_back(wrist);
  EXPECT_THROW(Likelihood(study.data, {}), InvalidInput);
}

}  // namespace
}  // namespace myoid::identification
