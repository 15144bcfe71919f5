#include "myoid/run/design/posterior_information.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "myoid/fit/beliefs/beliefs.h"

#include "tests/support/elbow_study.h"

namespace myoid::run {
namespace {

using fit::Believed;
using fit::EstimatorOptions;
using fit::StudyData;

EstimatorOptions options_of(const StudyData& data) {
  EstimatorOptions options;
  for (const fit::MuscleSetup& muscle : data.muscles) options.state(muscle.emg_channel).gain_sd = 0.05;
  return options;
}

StudyData three_trials() { return test::elbow_study({.trials = 3, .seconds = 8.0, .with_priors = true}).data; }

PosteriorInformation informant(const StudyData& data, Believed believed, double emg_factor = 1.0) {
  return {data,
          data.trials,
          options_of(data),
          {.torque_sd_nm = 0.4, .emg_factor = emg_factor, .model_error = 0.03},
          believed};
}

TEST(PosteriorInformation, OfASessionOfOneMovementIsThatOfTheLikelihoodOfItsRecording) {
  StudyData data = three_trials();
  data.trials.resize(1);
  constexpr double kNoNoise = 1e-6;  // of the envelopes: both smooth them by nothing
  const PosteriorInformation plan = informant(data, Believed::nothing_exact, kNoNoise);
  const fit::Likelihood likelihood(data, options_of(data));
  const Eigen::VectorXd z = likelihood.parameters().start();
  const Eigen::MatrixXd m = plan.of(data.trials[0], z);
  const Eigen::Index p = z.size(), q = static_cast<Eigen::Index>(plan.quantities().size());
  ASSERT_EQ(m.rows(), p + q);
  // Schur's complement of the quantities, whose precision is 1 beforehand.
  const Eigen::MatrixXd of_unseen = m.bottomRightCorner(q, q) + Eigen::MatrixXd::Identity(q, q);
  const Eigen::MatrixXd left =
      m.topLeftCorner(p, p) - m.topRightCorner(p, q) * of_unseen.ldlt().solve(m.bottomLeftCorner(q, p));
  fit::NoiseValues noise = fit::NoiseValues::Zero(fit::kNoiseFieldCount + 1);
  noise.head(4) << std::log(0.4), std::log(fit::beliefs::kTorqueNoiseTime.value), std::log(1e-3),
      std::log(0.03);  // kappa: at least a thousandth
  const Eigen::MatrixXd whole = likelihood.information(z, noise).information;
  EXPECT_LT((left - whole).norm(), 1e-4 * whole.norm());
}

TEST(PosteriorInformation, ExactGeometryAndSensorsWeighNothing) {
  const StudyData data = three_trials();
  const PosteriorInformation plan = informant(data, Believed::geometry_and_sensors_exact);
  const fit::Likelihood likelihood(data, options_of(data));
  const Eigen::VectorXd z = likelihood.parameters().start();
  const Eigen::MatrixXd m = plan.of(data.trials[0], z);
  EXPECT_EQ(m, plan.of(data.trials[0], z));
  int of_the_session = 0;
  for (std::size_t i = 0; i < plan.quantities().size(); ++i) {
    const Eigen::Index at = z.size() + static_cast<Eigen::Index>(i);
    const bool lasts = likelihood.unseen().quantities[i].lasts();
    EXPECT_EQ(m(at, at) > 0.0, !lasts) << plan.quantities()[i];
    of_the_session += !lasts;
  }
  EXPECT_GT(of_the_session, 8);
}

TEST(PosteriorInformation, LessNoiseOfTheEmgTellsMore) {
  const StudyData data = three_trials();
  const Eigen::VectorXd z = fit::Likelihood(data, options_of(data)).parameters().start();
  const auto of_strength = [&](double emg_factor) {
    return informant(data, Believed::nothing_exact, emg_factor).of(data.trials[0], z)(0, 0);
  };
  EXPECT_GT(of_strength(0.2), 1.5 * of_strength(1.0));
}

TEST(PosteriorInformation, AStrongPersonIsStrongInEveryMuscle) {
  const StudyData data = three_trials();
  fit::EstimatorOptions options = options_of(data);
  options.unseen.strength = 0.5;
  const fit::ParameterMap map(data, options);
  const std::vector<fit::Unknown>& free = map.free();
  const Knowledge known = knowledge_of(free, std::nullopt);
  std::vector<Eigen::Index> strength;
  for (std::size_t j = 0; j < free.size(); ++j) {
    if (free[j].label.ends_with("max_isometric_force")) strength.push_back(static_cast<Eigen::Index>(j));
  }
  ASSERT_EQ(strength.size(), 4U);
  const Eigen::MatrixXd of_strength = known.covariance(strength, strength);
  for (Eigen::Index i = 0; i < 4; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) EXPECT_NEAR(of_strength(i, j), 0.5 * 0.5, 1e-9);
  }
}

}  // namespace
}  // namespace myoid::run
