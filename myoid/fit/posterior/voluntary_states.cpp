#include "myoid/fit/posterior/voluntary_states.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "myoid/ground/math/random.h"

namespace myoid::fit {
namespace {

constexpr double kAtRest = 1e-4;         // envelope of a muscle that does not pull
constexpr Eigen::Index kMirrored = 500;  // draws and their mirror images
constexpr std::uint64_t kVoluntarySeed = 33;

/// Returns R with R R' = covariance, which may be singular.
Eigen::MatrixXd root(const Eigen::MatrixXd& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

Envelope constant_envelope(double value) {
  constexpr Eigen::Index kSamples = 6;
  return {Eigen::VectorXd::LinSpaced(kSamples, 0.0, 1.0), Eigen::VectorXd::Constant(kSamples, value)};
}

}  // namespace

Eigen::VectorXd greatest_envelopes(const Likelihood& likelihood, bool from_mvc) {
  const auto channels = static_cast<Eigen::Index>(likelihood.parameters().channels().size());
  if (from_mvc) return Eigen::VectorXd::Ones(channels);
  Eigen::VectorXd greatest = Eigen::VectorXd::Constant(channels, kAtRest);
  for (const TrialRun& run : likelihood.runs()) {
    for (Eigen::Index c = 0; c < channels; ++c)
      greatest[c] = std::max(greatest[c], run.envelopes[static_cast<std::size_t>(c)].samples().maxCoeff());
  }
  return greatest;
}

TrialRun run_of(const VoluntaryStates& states,
                const Postures& postures,
                const ParameterMap& map,
                const Eigen::VectorXd& greatest_envelope) {
  const Eigen::Index n = postures.count(), blocks = 1 + states.speeds_radps.size(), rows = n * blocks;
  const auto muscle = static_cast<Eigen::Index>(states.muscle);
  TrialRun run{.joints = {states.joint},
               .time_s = Eigen::VectorXd::LinSpaced(rows, 0.0, 1.0),
               .length_m = postures.length_m.replicate(blocks, 1),
               .velocity_mps = Eigen::MatrixXd::Zero(rows, postures.length_m.cols()),
               .interval_s = 1.0,
               .reduction = Reduction(rows, 1.0, std::nullopt)};
  for (Eigen::Index s = 1; s < blocks; ++s)
    run.velocity_mps.middleRows(s * n, n) = -states.direction * states.speeds_radps[s - 1] * postures.arm_m;
  run.arm_m.setZero(rows, postures.arm_m.cols());
  run.arm_m.col(muscle) = postures.arm_m.col(muscle).replicate(blocks, 1);
  run.motion.setZero(rows, 3);
  run.resting_nm.setZero(rows);
  run.envelope_sd.setZero(greatest_envelope.size());
  run.rest.setZero(greatest_envelope.size());
  for (std::size_t c = 0; c < map.channels().size(); ++c) {
    const bool pulls = map.channel_of_muscle(states.muscle) == static_cast<int>(c);
    run.envelopes.push_back(constant_envelope(pulls ? greatest_envelope[static_cast<Eigen::Index>(c)] : kAtRest));
    const std::optional<UnseenActivation>& unseen = map.unseen_activation(c);
    // A maximal effort does not depend on the expected activation.
    run.parts.emplace_back(unseen ? unseen->parts.size() : 0, constant_envelope(0.0));
  }
  return run;
}

NormalTorque& NormalTorque::operator+=(const NormalTorque& other) {
  if (mean_nm.size() == 0) return *this = other;
  mean_nm += other.mean_nm;
  by_chance += other.by_chance;
  return *this;
}

LinearReading::LinearReading(const Likelihood& likelihood,
                             const Eigen::VectorXd& z,
                             const NoiseValues& noise,
                             const NoiseValues& of_widths,
                             const Eigen::MatrixXd& covariance)
    : likelihood_(likelihood),
      z_(z),
      noise_(noise),
      of_widths_(of_widths),
      unseen_(likelihood.unseen_given(z, noise)),
      root_z_(root(covariance)),
      root_unseen_(likelihood.unseen_given(z, of_widths).covariance.llt().matrixL()) {}

NormalTorque LinearReading::torque(const TrialRun& run, int direction) const {
  const Likelihood::ActiveTorque at = likelihood_.active_torque(run, z_, noise_);
  NormalTorque torque{direction * (at.torque_nm + at.by_unseen * unseen_.mean), {}};
  const Eigen::MatrixXd by_unseen = likelihood_.active_torque(run, z_, of_widths_).by_unseen;
  torque.by_chance.resize(at.torque_nm.size(), root_z_.cols() + root_unseen_.cols());
  torque.by_chance << direction * (at.by_z + at.by_unseen * unseen_.by_z) * root_z_,
      direction * by_unseen * root_unseen_;
  return torque;
}

Peak peak_of(const Eigen::Ref<const Eigen::VectorXd>& values, const Eigen::VectorXd& place) {
  Eigen::Index top = 0;
  Peak peak{.value = values.maxCoeff(&top), .place = 0.0, .at_end = top == 0 || top + 1 == values.size()};
  peak.place = place[top];
  if (peak.at_end) return peak;
  const double before = values[top - 1] - peak.value, after = values[top + 1] - peak.value;
  const double bend = before + after;
  if (!(bend < 0.0)) return peak;
  const double shift = 0.5 * (before - after) / bend;  // in steps, within half a step
  peak.place += shift * (place[top + 1] - place[top]);
  peak.value += 0.25 * (after - before) * shift;
  return peak;
}

Eigen::MatrixXd voluntary_draws(Eigen::Index places) {
  math::Random random(kVoluntarySeed);
  Eigen::MatrixXd chance(places, 2 * kMirrored);
  for (Eigen::Index i = 0; i < kMirrored; ++i) {
    chance.col(2 * i) = random.normals(places);
    chance.col(2 * i + 1) = -chance.col(2 * i);
  }
  return chance;
}

Peaks peaks_of(const NormalTorque& torque, const Eigen::VectorXd& place, const Eigen::MatrixXd& draws) {
  const Eigen::Index n = place.size(), count = draws.cols();
  const Eigen::VectorXd mean = torque.mean_nm.head(n);
  const Eigen::MatrixXd by = torque.by_chance.topRows(n);
  Peaks peaks{peak_of(mean, place), Eigen::VectorXd(count), Eigen::VectorXd(count)};
  const Eigen::MatrixXd off = root(by * by.transpose()) * draws.topRows(n);
  Eigen::Index top = 0;
  mean.maxCoeff(&top);
  Eigen::VectorXd drawn(n);
  for (Eigen::Index i = 0; i < count; ++i) {
    // The size of the torque is log-normal, the rest of the curve normal.
    const double larger = mean[top] > 0.0 ? off(top, i) / mean[top] : 0.0;
    drawn = (std::exp(larger) - larger) * mean + off.col(i);
    const Peak peak = peak_of(drawn, place);
    peaks.values[i] = peak.value;
    peaks.places[i] = peak.place;
    peaks.at_ends += peak.at_end ? 1.0 / static_cast<double>(count) : 0.0;
  }
  return peaks;
}

}  // namespace myoid::fit
