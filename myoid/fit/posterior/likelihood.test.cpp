#include "myoid/fit/posterior/likelihood.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "myoid/fit/measurement/unseen_activations.h"

#include "tests/support/crowded_study.h"
#include "tests/support/elbow_study.h"
#include "tests/support/exact_sensors.h"
#include "tests/support/fascicle_study.h"
#include "tests/support/leg_study.h"

namespace myoid::fit {
namespace {

using test::crowded_options;
using test::crowded_study;
using test::elbow_study;
using test::ElbowStudy;
using test::freed;
using test::kNoise;
using test::kNoiseOfLeg;
using test::leg_study;

constexpr double kUnseenSd = 0.05;

/// Takes the EMG of these muscles out of the study.
void hide_emg(const std::vector<std::size_t>& muscles, const std::vector<WithoutEmg>& by, StudyData& data) {
  for (std::size_t i = 0; i < muscles.size(); ++i) {
    MuscleSetup& setup = data.muscles[muscles[i]];
    setup.emg_channel += " without EMG";
    setup.unseen = UnseenActivation{.by = by[i], .parts = {}};
  }
  expect_activations(data);
  for (const std::size_t k : muscles) data.muscles[k].unseen->sd = kUnseenSd;
}

/// Force of one muscle by the plain law: activation a (n), lengths and rates of the run.
Eigen::VectorXd written_force(const TrialRun& run, std::size_t k, const MuscleValues& p, const Eigen::VectorXd& a) {
  const auto column = static_cast<Eigen::Index>(k);
  Eigen::VectorXd force(run.time_s.size());
  for (Eigen::Index i = 0; i < force.size(); ++i) {
    const double v = run.velocity_mps(i, column), vm = p[kSpeed];
    const double off = run.length_m(i, column) - p[kSlack] - p[kFiberLength];
    double fv = 0.0;
    if (v > 0.0) {
      fv = (p[kProduct] * vm + p[kPlateau] * v) / (p[kProduct] * vm + v);
    } else if (v > -vm) {
      fv = p[kCurvature] * (vm + v) / (p[kCurvature] * vm - v);
    }
    force[i] = p[kMaxForce] * a[i] * std::exp(-std::pow(off / p[kWidth], 2)) * fv;
  }
  return force;
}

/// L by its definition: weights of a Gaussian of -3 dB at the cut-off, to three widths, in rows
/// that are a third of a period apart, all inside the run and as far from both ends.
Eigen::MatrixXd written_low_pass(const TrialRun& run, double cutoff_hz) {
  const Eigen::Index n = run.time_s.size();
  const double width = std::sqrt(std::numbers::ln2) / (2.0 * std::numbers::pi * cutoff_hz) / run.interval_s;
  const auto reach = static_cast<Eigen::Index>(std::ceil(3.0 * width));
  const auto apart = static_cast<Eigen::Index>(std::lround(1.0 / (3.0 * cutoff_hz * run.interval_s)));
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

/// What the model says of one run, written out: torques, channels' torques and errors of the motion
/// of all its joints, joint after joint.
struct WrittenRun {
  Eigen::VectorXd torque;
  Eigen::MatrixXd by_channel;  ///< n J x channels
  Eigen::MatrixXd motion;      ///< n J x errors of angles and rates, each times its size.
};

WrittenRun written_run(const Likelihood& likelihood,
                       const TrialRun& run,
                       const EstimatorOptions& options,
                       const ModelValues& values,
                       const ModelValues& reference) {
  const ParameterMap& map = likelihood.parameters();
  const Eigen::Index n = run.time_s.size(), rows = run.arm_m.rows(), joints = rows / n;
  const Eigen::Index muscles = run.arm_m.cols();
  WrittenRun written{Eigen::VectorXd::Zero(rows),
                     Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(map.channels().size())),
                     Eigen::MatrixXd::Zero(rows, 2 * joints * muscles)};
  for (Eigen::Index k = 0; k < muscles; ++k) {
    const auto muscle = static_cast<std::size_t>(k);
    const auto c = static_cast<std::size_t>(map.channel_of_muscle(muscle));
    const auto u = [&](const ModelValues& of) {
      return Eigen::VectorXd(
          run.time_s.unaryExpr([&](double t) { return run.envelopes[c].at(t - of.channels[c][kDelay]).value; }));
    };
    const auto a = [&](const ModelValues& of) { return Eigen::VectorXd(of.channels[c][kGain] * u(of)); };
    const Eigen::VectorXd force = written_force(run, muscle, values.muscles[muscle], a(values));
    const double h = 1e-5;
    const auto change = [&](Eigen::MatrixXd TrialRun::*what) {
      TrialRun longer = run, shorter = run;
      (longer.*what).col(k).array() += h;
      (shorter.*what).col(k).array() -= h;
      const Eigen::VectorXd at = a(reference);
      return Eigen::ArrayXd((written_force(longer, muscle, reference.muscles[muscle], at) -
                             written_force(shorter, muscle, reference.muscles[muscle], at)) /
                            (2.0 * h));
    };
    const Eigen::ArrayXd by_length = change(&TrialRun::length_m), by_rate = change(&TrialRun::velocity_mps);
    for (Eigen::Index j = 0; j < joints; ++j) {
      const Eigen::ArrayXd arm = run.arm_m.col(k).segment(j * n, n);
      written.torque.segment(j * n, n).array() += arm * force.array();
      // The torque is proportional to the activation, and so to the envelope; of an activation without EMG the error
      // does not grow with it, shares its gain, and belongs to the reference.
      const Eigen::ArrayXd expected = written_force(run, muscle, reference.muscles[muscle], a(reference)).array();
      const Eigen::ArrayXd by_noise =
          map.unseen_activation(c) ? Eigen::ArrayXd(arm * expected / u(reference).array()) : arm * force.array();
      written.by_channel.col(static_cast<Eigen::Index>(c)).segment(j * n, n).array() += by_noise;
      for (Eigen::Index turned = 0; turned < joints; ++turned) {
        // dq moves a length by -r dq and a rate by -r dq'.
        const Eigen::ArrayXd moved = run.arm_m.col(k).segment(turned * n, n);
        const Eigen::Index at = 2 * (k * joints + turned);
        written.motion.col(at).segment(j * n, n) = options.angle_sd_rad * arm * by_length * moved;
        written.motion.col(at + 1).segment(j * n, n) = options.angle_rate_sd_radps * arm * by_rate * moved;
      }
    }
  }
  return written;
}

/// The covariance of a run's torques before L: of the torque, of the motion and of the envelopes.
Eigen::MatrixXd written_covariance(const TrialRun& run,
                                   const WrittenRun& written,
                                   const std::vector<double>& torque_size,
                                   const NoiseValues& noise,
                                   double envelope_cutoff_hz) {
  const Eigen::Index n = run.time_s.size(), rows = written.torque.size(), joints = rows / n;
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(rows, rows);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < joints; ++j) {
      for (Eigen::Index other = 0; other < joints; ++other)
        q(j * n + i, other * n + i) = written.motion.row(j * n + i).dot(written.motion.row(other * n + i));
      for (Eigen::Index t = 0; t < n; ++t)
        q(j * n + i, j * n + t) += std::pow(torque_size[static_cast<std::size_t>(j)], 2) *
                                   std::exp(2.0 * (noise[kTorqueSd] + noise[kNoiseFieldCount + run.trial]) -
                                            std::abs(run.time_s[i] - run.time_s[t]) / std::exp(noise[kTorqueTime]));
    }
  }
  for (std::size_t c = 0; c < run.errors.size(); ++c) {
    const Eigen::Index margin = run.errors[c].from_white(run.interval_s).size() / 2;
    const Eigen::MatrixXd filter = written_noise_filter(run.errors[c], n, margin, run.interval_s);
    Eigen::MatrixXd root(rows, n + 2 * margin);
    for (Eigen::Index j = 0; j < joints; ++j) {
      Eigen::VectorXd modulation(n + 2 * margin);
      for (Eigen::Index i = 0; i < modulation.size(); ++i)
        modulation[i] =
            written.by_channel(j * n + std::clamp<Eigen::Index>(i - margin, 0, n - 1), static_cast<Eigen::Index>(c));
      root.middleRows(j * n, n) = filter * modulation.asDiagonal();
    }
    // 0.57 / (2 B T), T the time that two passes of second order average.
    const double of_noise = 0.7555 * 0.7555 / (2.0 * 150.0 * 0.4815 / envelope_cutoff_hz) * run.errors[c].share();
    q += (run.parts[c].empty() ? std::exp(2.0 * noise[kEmgFactor]) * of_noise : kUnseenSd * kUnseenSd) * root *
         root.transpose();
  }
  return q;
}

/// Root mean square of each joint's L y over that of all joints.
std::vector<double> written_torque_sizes(const std::vector<TrialRun>& runs) {
  const std::size_t joints = runs.front().joints.size();
  std::vector<double> sums(joints, 0.0);
  double count = 0.0;
  for (const TrialRun& run : runs) {
    const auto m = run.measured_nm.size() / static_cast<Eigen::Index>(joints);
    count += static_cast<double>(m);
    for (std::size_t j = 0; j < joints; ++j)
      sums[j] += run.measured_nm.segment(static_cast<Eigen::Index>(j) * m, m).squaredNorm();
  }
  double all = 0.0;
  for (const double sum : sums) all += sum / static_cast<double>(joints);
  for (double& sum : sums) sum = std::sqrt(sum / all);
  return sums;
}

/// F_max over that of the reference, the geometric mean of the muscles whose strength a quantity multiplies.
Eigen::VectorXd written_strength(const Likelihood& likelihood,
                                 const Eigen::VectorXd& z,
                                 const Eigen::VectorXd& reference) {
  const ParameterMap& map = likelihood.parameters();
  const ModelValues now = map.values(z), then = map.values(reference);
  const std::vector<UnseenQuantity>& quantities = likelihood.unseen().quantities;
  Eigen::VectorXd ratio = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(quantities.size()));
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    double product = 1.0;
    for (const std::size_t k : quantities[i].strength_of)
      product *= now.muscles[k][kMaxForce] / then.muscles[k][kMaxForce];
    if (!quantities[i].strength_of.empty())
      ratio[static_cast<Eigen::Index>(i)] =
          std::pow(product, 1.0 / static_cast<double>(quantities[i].strength_of.size()));
  }
  return ratio;
}

/// The weight of a row of a run: of a trial's rows per joint, `most` count.
double written_row_weight(const std::vector<TrialRun>& runs, const TrialRun& of, double most) {
  double count = 0.0;
  for (const TrialRun& run : runs)
    if (run.trial == of.trial)
      count += static_cast<double>(run.measured_nm.size()) / static_cast<double>(run.joints.size());
  return std::min(1.0, most / count);
}

/// The density by one dense covariance of all runs, and the unseen quantities given the torques.
void expect_written_out(const StudyData& data, const NoiseValues& noise, Believed believed) {
  EstimatorOptions options;
  options.angle_sd_rad = 0.01;
  options.angle_rate_sd_radps = 0.1;
  Likelihood likelihood(data, options);
  likelihood.believe(believed);
  const ParameterMap& map = likelihood.parameters();
  const Eigen::VectorXd reference = map.start();
  Eigen::VectorXd z = reference;
  for (Eigen::Index j = 0; j < z.size(); ++j)
    z[j] += 0.1 * map.free()[static_cast<std::size_t>(j)].prior.sd * std::sin(1.0 + 2.0 * static_cast<double>(j));
  const std::vector<TrialRun>& runs = likelihood.runs();
  ASSERT_EQ(runs.size(), 2U);
  const Eigen::Index rows = likelihood.row_count();
  Eigen::MatrixXd sigma = Eigen::MatrixXd::Zero(rows, rows);
  Eigen::VectorXd residual(rows);
  Eigen::MatrixXd shapes(rows, static_cast<Eigen::Index>(likelihood.unseen().quantities.size()));
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(shapes.cols());
  Eigen::Index first = 0;
  double counted_twice = 0.0;  // of the determinants of the runs, whose power is the rows' weight
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const TrialRun& run = runs[r];
    const double weight = written_row_weight(runs, run, options.unseen.independent_rows);
    ASSERT_LT(weight, 1.0);
    const Eigen::MatrixXd of_joint = written_low_pass(run, 1.5);
    const Eigen::Index n = run.time_s.size(), m = run.measured_nm.size(), joints = m / of_joint.rows();
    Eigen::MatrixXd l = Eigen::MatrixXd::Zero(m, n * joints);
    for (Eigen::Index j = 0; j < joints; ++j) l.block(j * of_joint.rows(), j * n, of_joint.rows(), n) = of_joint;
    const WrittenRun written = written_run(likelihood, run, options, map.values(z), map.values(reference));
    sigma.block(first, first, m, m) =
        l * written_covariance(run, written, written_torque_sizes(runs), noise, options.envelope_cutoff_hz) *
        l.transpose();
    // The least error of a joint's torque, in each row.
    for (Eigen::Index j = 0; j < joints; ++j)
      sigma.diagonal().segment(first + j * of_joint.rows(), of_joint.rows()).array() +=
          std::pow(0.002 * likelihood.torque_size_nm() * written_torque_sizes(runs)[static_cast<std::size_t>(j)], 2);
    const auto log_determinant = [&] {
      return sigma.block(first, first, m, m).eval().ldlt().vectorD().array().log().sum();
    };
    counted_twice -= weight * log_determinant();
    sigma.block(first, first, m, m) /= weight;
    counted_twice += log_determinant();
    residual.segment(first, m) = run.measured_nm - l * written.torque;
    Eigen::MatrixXd turned = likelihood.unseen().columns[r];
    for (std::size_t s = 0; s < likelihood.unseen().slopes.size(); ++s) {
      const auto& [quantity, unknown, reach] = likelihood.unseen().slopes[s];
      turned.col(quantity) += reach * std::tanh((z[unknown] - reference[unknown]) / reach) *
                              likelihood.unseen().by_slope[r].col(static_cast<Eigen::Index>(s));
    }
    shapes.middleRows(first, m) = l * turned;
    first += m;
  }
  for (Eigen::Index i = 0; i < shapes.cols(); ++i) {
    const UnseenQuantity& of = likelihood.unseen().quantities[static_cast<std::size_t>(i)];
    if (believed == Believed::geometry_and_sensors_exact && of.lasts()) continue;
    weights[i] = of.weight * (of.size ? std::exp(noise[*of.size]) : 1.0);
    sigma += weights[i] * weights[i] * shapes.col(i) * shapes.col(i).transpose();
  }
  const Eigen::LDLT<Eigen::MatrixXd> factor(sigma);
  // In the quadratic form strengths grow with the root of F_max.
  const Eigen::VectorXd ratio = written_strength(likelihood, z, reference);
  for (Eigen::Index i = 0; i < shapes.cols(); ++i)
    sigma += (ratio[i] - 1.0) * weights[i] * weights[i] * shapes.col(i) * shapes.col(i).transpose();
  const double direct =
      -0.5 * residual.dot(sigma.ldlt().solve(residual)) - 0.5 * (factor.vectorD().array().log().sum() - counted_twice);
  // The program's derivatives by ln u, length and rate are secants.
  EXPECT_NEAR(likelihood.value(z, noise), direct, 1e-5 * std::abs(direct));
  // The unseen quantities given the torque: conditional moments of a joint normal density.
  const Eigen::MatrixXd weighted = shapes * weights.asDiagonal();
  const Eigen::MatrixXd gain = factor.solve(weighted);
  const Likelihood::UnseenGiven given = likelihood.unseen_given(z, noise);
  EXPECT_LT((given.mean - gain.transpose() * residual).cwiseAbs().maxCoeff(), 1e-4);
  const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(weights.size(), weights.size()) - weighted.transpose() * gain;
  EXPECT_LT((given.covariance - left).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(Likelihood, TheValueIsThatOfTheWholeCovarianceWrittenOut) {
  ElbowStudy study =
      elbow_study({.trials = 2, .seconds = 7.0, .emg_cv = 0.08, .torque_sd_nm = 0.4, .with_priors = true});
  // The second muscle shares the electrode of the first.
  study.data.muscles[1].emg_channel = study.data.muscles[0].emg_channel;
  for (const Believed believed : {Believed::nothing_exact, Believed::geometry_and_sensors_exact})
    expect_written_out(study.data, kNoise, believed);
}

TEST(Likelihood, TheValueOfTwoJointsIsThatOfTheWholeCovarianceWrittenOut) {
  const ElbowStudy study = leg_study({.seconds = 7.0, .emg_cv = 0.1, .torque_sd_nm = 1.0});
  for (const Believed believed : {Believed::nothing_exact, Believed::geometry_and_sensors_exact})
    expect_written_out(study.data, kNoiseOfLeg, believed);
}

TEST(Likelihood, TheValueWithoutEmgOfOneMuscleIsThatOfTheWholeCovarianceWrittenOut) {
  for (const WithoutEmg by : {WithoutEmg::unseen, WithoutEmg::synergies}) {
    ElbowStudy study = leg_study({.seconds = 7.0, .emg_cv = 0.1, .torque_sd_nm = 1.0});
    hide_emg({1}, {by}, study.data);  // of both joints
    expect_written_out(study.data, kNoiseOfLeg, Believed::nothing_exact);
  }
}

/// Compares the gradient with differences of the value.
void expect_gradient(const Likelihood& likelihood, const NoiseValues& noise) {
  Eigen::VectorXd z = likelihood.parameters().start();
  for (Eigen::Index j = 0; j < z.size(); ++j)
    z[j] += 0.1 * likelihood.parameters().free()[static_cast<std::size_t>(j)].prior.sd *
            std::cos(3.0 * static_cast<double>(j));
  Likelihood::Gradient gradient;
  EXPECT_EQ(likelihood.value(z, noise, &gradient), likelihood.value(z, noise));
  const auto slope = [](const auto& at, double h) {
    return (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
  };
  for (Eigen::Index j = 0; j < z.size(); ++j) {
    const Unknown& of = likelihood.parameters().free()[static_cast<std::size_t>(j)];
    const double difference =
        slope([&](double h) { return likelihood.value(z + h * Eigen::VectorXd::Unit(z.size(), j), noise); },
              1e-3 * std::max(1e-3, of.prior.sd));
    EXPECT_NEAR(gradient.by_z[j], difference, 1e-4 * (1.0 + std::abs(difference))) << of.label;
  }
  for (Eigen::Index i = 0; i < noise.size(); ++i) {
    const double difference = slope(
        [&](double h) {
          NoiseValues moved = noise;
          moved[i] += h;
          return likelihood.value(z, moved);
        },
        1e-3);
    EXPECT_NEAR(gradient.by_noise[i], difference, 1e-5 * (1.0 + std::abs(difference))) << i;
  }
}

TEST(Likelihood, TheGradientIsThatOfDifferences) {
  const ElbowStudy study = crowded_study();
  for (const Believed believed : {Believed::nothing_exact, Believed::geometry_and_sensors_exact}) {
    Likelihood likelihood(study.data, crowded_options());
    likelihood.believe(believed);
    expect_gradient(likelihood, kNoise);
  }
}

TEST(Likelihood, TheGradientOfTwoJointsIsThatOfDifferences) {
  ElbowStudy study = leg_study({.seconds = 6.0, .emg_cv = 0.1, .torque_sd_nm = 1.0});
  study.data.rules = {freed("emg_exponent"), freed("joint_torque_offset"), freed("joint_stiffness", {"knee"})};
  EstimatorOptions options;
  options.angle_sd_rad = 0.01;
  for (const test::LegMuscle& muscle : test::kLegMuscles) {
    options.state(muscle.name).gain_sd = 0.1;
    options.state(muscle.name).bandwidth_hz = 150.0;
    options.state(muscle.name).rest = 0.02;
  }
  expect_gradient(Likelihood(study.data, options), kNoiseOfLeg);
}

TEST(Likelihood, TheGradientWithoutEmgOfTwoMusclesIsThatOfDifferences) {
  ElbowStudy study = leg_study({.seconds = 6.0, .emg_cv = 0.1, .torque_sd_nm = 1.0});
  study.data.rules = {freed("joint_torque_offset")};
  hide_emg({1, 4}, {WithoutEmg::synergies, WithoutEmg::unseen}, study.data);
  expect_gradient(Likelihood(study.data, {}), kNoiseOfLeg);
}

TEST(Likelihood, TheGradientWithFasciclesIsThatOfDifferences) {
  StudyData data =
      test::fascicle_study(
          elbow_study({.trials = 2, .seconds = 7.0, .emg_cv = 0.08, .torque_sd_nm = 0.4, .with_priors = true}), 5)
          .data;
  data.trials[1].fascicle_m.topRows(300).setConstant(std::numeric_limits<double>::quiet_NaN());
  const Likelihood likelihood(data, {});
  ASSERT_EQ(likelihood.fascicle_place(), kNoise.size());
  NoiseValues noise(kNoise.size() + 1);
  noise << kNoise, 0.3;
  expect_gradient(likelihood, noise);
}

/// Rigid tendons and an exact geometry leave nothing that torque and fibers share: the lengths add their own density.
TEST(Likelihood, FasciclesOfRigidTendonsAddTheirOwnDensity) {
  ElbowStudy study =
      elbow_study({.trials = 1, .seconds = 7.0, .emg_cv = 0.08, .torque_sd_nm = 0.4, .with_priors = true});
  EstimatorOptions options;
  options.unseen = test::no_unseen_errors();
  const StudyData bare = study.data;
  TrialData& trial = study.data.trials[0];
  const Eigen::Index n = trial.time_s.size(), absent = n / 3;
  trial.fascicle_m.setConstant(n, 4, std::numeric_limits<double>::quiet_NaN());
  for (Eigen::Index i = absent; i < n; ++i)
    trial.fascicle_m(i, 1) = 0.1 + 0.004 * std::sin(3.0 * trial.time_s[i]) + 0.01 * trial.time_s[i];
  const Likelihood with(study.data, options), without(bare, options);
  const Eigen::VectorXd z = with.parameters().start();
  NoiseValues noise(kNoiseFieldCount + 2);
  noise << kNoise.head(kNoiseFieldCount + 1), 0.3;
  const TrialRun& run = with.runs()[0];
  const Eigen::MatrixXd l = written_low_pass(run, 1.5);
  // The run's samples of the measurement, by time.
  const Eigen::Index samples = run.time_s.size();
  Eigen::VectorXd measured(samples), fiber(samples);
  const double slack = study.data.muscles[1].start.tendon_slack_length_m;
  for (Eigen::Index i = 0; i < samples; ++i) {
    const Eigen::Index row = std::lround((run.time_s[i] - trial.time_s[0]) * 100.0);
    measured[i] = trial.fascicle_m(row, 1);
    fiber[i] = trial.length_m(row, 1) - slack;
  }
  std::vector<Eigen::Index> rows;
  for (Eigen::Index j = 0; j < l.rows(); ++j) {
    Eigen::Index first = 0;
    while (l(j, first) == 0.0) ++first;
    if (std::isfinite(measured[first])) rows.push_back(j);
  }
  ASSERT_GT(rows.size(), 10U);
  ASSERT_LT(static_cast<Eigen::Index>(rows.size()), l.rows());
  Eigen::MatrixXd error(samples, samples);
  for (Eigen::Index i = 0; i < samples; ++i)
    for (Eigen::Index j = 0; j < samples; ++j)
      error(i, j) = std::pow(0.002 * std::exp(0.3), 2) * std::exp(-std::abs(run.time_s[i] - run.time_s[j]));
  const Eigen::MatrixXd low = l(rows, Eigen::all);
  Eigen::MatrixXd own = low * error * low.transpose();
  own.diagonal().array() += std::pow(0.0002, 2);
  const double weight = written_row_weight(with.runs(), run, options.unseen.independent_rows);
  const auto log_determinant = [](const Eigen::MatrixXd& m) { return m.ldlt().vectorD().array().log().sum(); };
  const Eigen::VectorXd seen = low * fiber, one = low * Eigen::VectorXd::Ones(samples);
  const Eigen::MatrixXd weighted = own / weight;
  const Eigen::MatrixXd sigma =
      weighted + 0.05 * 0.05 * seen * seen.transpose() + 0.002 * 0.002 * one * one.transpose();
  const Eigen::VectorXd residual = low * measured.unaryExpr([](double v) { return std::isnan(v) ? 0.0 : v; }) - seen;
  const double of_lengths = -0.5 * residual.dot(sigma.ldlt().solve(residual)) - 0.5 * log_determinant(sigma) +
                            0.5 * log_determinant(weighted) - 0.5 * weight * log_determinant(own);
  // A row without a length adds the determinant of its error alone.
  const auto absent_rows = static_cast<double>(l.rows()) - static_cast<double>(rows.size());
  const double of_absent = -0.5 * weight * absent_rows * std::log(1e6);
  const double added = with.value(z, noise) - without.value(z, noise.head(kNoiseFieldCount + 1));
  EXPECT_NEAR(added, of_lengths + of_absent, 1e-6 * std::abs(of_lengths));
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

// All moment arms of the person are 10 % longer than the study says.
TEST(Likelihood, TheExplanationHasTheErrorsOfTheGeometryThatTheTorqueTells) {
  ElbowStudy study = elbow_study({.trials = 2, .seconds = 10.0, .true_arm_scale = 1.1});
  for (std::size_t k = 0; k < 4; ++k) study.data.muscles[k].start = study.truth[k];
  EstimatorOptions options;
  options.delay_s = study.delay_s;
  options.unseen.gain_drift = 0.0;
  options.unseen.model_error = 1e-3;
  Likelihood likelihood(study.data, options);
  const Eigen::VectorXd z = likelihood.parameters().start();
  likelihood.refer_to(z);
  NoiseValues noise = NoiseValues::Zero(kNoiseFieldCount);
  noise[kTorqueSd] = std::log(0.01 * likelihood.torque_size_nm());
  noise[kTorqueTime] = std::log(0.3);
  noise[kEmgFactor] = noise[kModelErrorSize] = std::log(1e-3);
  const Likelihood::Residuals rows = likelihood.residuals(z, noise);
  likelihood.believe(Believed::geometry_and_sensors_exact);
  const Likelihood::Residuals exact = likelihood.residuals(z, noise);
  const double size = rows.measured_nm.norm();
  EXPECT_EQ(rows.measured_nm, exact.measured_nm);
  EXPECT_GT((exact.predicted_nm - exact.measured_nm).norm(), 0.05 * size);
  EXPECT_LT((rows.predicted_nm - rows.measured_nm).norm(), 0.01 * size);
}

}  // namespace
}  // namespace myoid::fit
