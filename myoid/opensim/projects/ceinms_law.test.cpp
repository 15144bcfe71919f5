#include "myoid/opensim/projects/ceinms_law.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::opensim {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Quantity = MuscleQuantity;

/// One muscle with one channel. The curves are straight lines, through which a natural spline is the line itself.
Project project(Dialect dialect = Dialect::ceinms) {
  Project p{.dialect = dialect, .tendon = "stiff", .common = {.damping = 0.1, .percentage_change = 0.15}};
  p.curves = {{"activeForceLength", {0.0, 1.0, 2.0}, {0.2, 0.7, 1.2}},
              {"passiveForceLength", {0.0, 2.0}, {0.0, 0.4}},
              {"forceVelocity", {-1.0, 0.0, 1.0}, {0.0, 1.0, 2.0}},
              {"tendonForceStrain", {0.0, 0.1}, {0.0, 4.0}}};
  ProjectMuscle muscle{.name = "soleus_r", .inputs = {{"sol", 1.0}}};
  const auto set = [&](Quantity quantity, double value) { muscle.numbers[quantity].value = value; };
  set(Quantity::c1, -0.5);
  set(Quantity::c2, -0.4);
  set(Quantity::shape_factor, -2.0);
  set(Quantity::optimal_fiber_length, 0.05);
  set(Quantity::pennation_angle, 0.3);
  set(Quantity::tendon_slack_length, 0.25);
  set(Quantity::max_isometric_force, 3000.0);
  set(Quantity::strength_coefficient, 1.5);
  p.muscles = {muscle};
  return p;
}

TimeSeries series(const std::string& name, double rate_hz, const VectorXd& values) {
  return {VectorXd::LinSpaced(values.size(), 0.0, static_cast<double>(values.size() - 1) / rate_hz),
          {{name, Unit::dimensionless}},
          Eigen::MatrixXd(values)};
}

LawForces forces(const Project& p, const VectorXd& emg, const VectorXd& lengths) {
  return forces_by_law(p, series("sol", 1000.0, emg), series("soleus_r", 100.0, lengths), {"soleus_r"});
}

double shaped(double u) { return (std::exp(-2.0 * u) - 1.0) / (std::exp(-2.0) - 1.0); }

TEST(CeinmsLaw, OfASteadyContractionIsTheClosedForm) {
  const double a = shaped(0.6);
  const double along = 0.29 - 0.25, height = 0.05 * std::sin(0.3);
  const LawForces found = forces(project(), VectorXd::Constant(500, 0.6), VectorXd::Constant(50, 0.29));
  const double fiber = std::hypot(along, height);
  const double active = 0.2 + 0.5 * fiber / (0.05 * (1.0 + 0.15 * (1.0 - a)));
  const double expected = 3000.0 * 1.5 * (active * a + 0.2 * fiber / 0.05) * along / fiber;
  EXPECT_NEAR(found.activation.values()(30, 0), a, 1e-12);
  EXPECT_NEAR(found.force.values()(30, 0), expected, 1e-8);

  // CEINMS-RT: the height grows with the optimal length at the activation, the pennation does not.
  const double height_rt = 0.05 * (1.0 + 0.15 * (1.0 - a)) * std::sin(0.3), fiber_rt = std::hypot(along, height_rt);
  const double active_rt = 0.2 + 0.5 * fiber_rt / (0.05 * (1.0 + 0.15 * (1.0 - a)));
  const double cosine = std::sqrt(1.0 - std::pow(0.05 * std::sin(0.3) / fiber_rt, 2));
  const LawForces rt = forces(project(Dialect::ceinms_rt), VectorXd::Constant(500, 0.6), VectorXd::Constant(50, 0.29));
  EXPECT_NEAR(rt.force.values()(30, 0), 4500.0 * (active_rt * a + 0.2 * fiber_rt / 0.05) * cosine, 1e-8);
}

TEST(CeinmsLaw, SpeedAndDampingActAtAConstantSpeed) {
  Project p = project();
  p.muscles[0].numbers[Quantity::pennation_angle].value = 0.0;
  const VectorXd lengths = VectorXd::LinSpaced(50, 0.29, 0.29 + 0.49 * 0.1);  // 0.1 m/s: a fifth of 10 l0/s
  const double force = forces(p, VectorXd::Constant(500, 0.0), lengths).force.values()(20, 0);
  EXPECT_NEAR(force, 4500.0 * (0.2 * (0.04 + 0.02) / 0.05 + 0.1 * 0.2), 1e-8);
  const double active = forces(p, VectorXd::Constant(500, 1.0), lengths).force.values()(20, 0) - force;
  EXPECT_NEAR(active, 4500.0 * (0.2 + 0.5 * 0.06 / 0.05) * 1.2, 1e-8);
}

TEST(CeinmsLaw, FiltersTheExcitationAtTheSamplesOfTheEmgAndDelaysIt) {
  Project p = project();
  p.common.delay_s = 0.02;
  p.muscles[0].numbers[Quantity::shape_factor].value = 0.0;
  VectorXd step = VectorXd::Zero(500);
  step.tail(400).setOnes();  // at 0.1 s
  const LawForces found = forces(p, step, VectorXd::Constant(50, 0.29));
  // u_k = 0.3 e_k + 0.9 u_(k-1) - 0.2 u_(k-2) has the poles 0.5 and 0.4: u_n = 1 - 1.5 0.5^n + 0.8 0.4^n.
  const double tenth = 1.0 - 1.5 * std::pow(0.5, 10) + 0.8 * std::pow(0.4, 10);
  EXPECT_EQ(found.activation.values()(11, 0), 0.0);
  EXPECT_NEAR(found.activation.values()(13, 0), tenth, 1e-9);  // 0.13 s: 10 samples after 0.12 s
}

TEST(CeinmsLaw, AnElasticTendonCarriesTheForceOfItsMuscle) {
  Project p = project();
  p.tendon = "equilibriumElastic";
  const double a = shaped(0.5), strain = 0.021;
  // The fiber length whose force stretches the tendon by this strain, from the muscle's own closed form.
  double low = 0.02, high = 0.1;
  const auto force_at = [&](double fiber) {
    const double cosine = std::sqrt(1.0 - std::pow(0.05 * std::sin(0.3) / fiber, 2));
    return (a * (0.2 + 0.5 * fiber / (0.05 * (1.0 + 0.15 * (1.0 - a)))) + 0.2 * fiber / 0.05) * cosine;
  };
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (force_at(middle) < 40.0 * strain ? low : high) = middle;
  }
  const double length = low * std::sqrt(1.0 - std::pow(0.05 * std::sin(0.3) / low, 2)) + 0.25 * (1.0 + strain);
  const LawForces found = forces(p, VectorXd::Constant(5000, 0.5), VectorXd::Constant(500, length));
  EXPECT_NEAR(found.force.values()(499, 0), 4500.0 * 40.0 * strain, 1e-5);
}

TEST(CeinmsLaw, LeavesMusclesWithoutEmgPassiveAndAveragesChannels) {
  Project p = project();
  p.muscles[0].inputs.clear();
  const LawForces passive = forces(p, VectorXd::Constant(500, 0.6), VectorXd::Constant(50, 0.29));
  EXPECT_EQ(passive.activation.values().cwiseAbs().maxCoeff(), 0.0);
  EXPECT_GT(passive.force.values()(30, 0), 0.0);
  p.muscles[0].inputs = {{"sol", 0.5}, {"sol", 0.5}};
  const double mean = forces(p, VectorXd::Constant(500, 0.6), VectorXd::Constant(50, 0.29)).activation.values()(30, 0);
  EXPECT_NEAR(mean, shaped(0.6), 1e-12);
}

TEST(CeinmsLaw, SaysWhatTheFilesLack) {
  EXPECT_TRUE(missing_of_law(project()).empty());
  Project p = project();
  p.curves.pop_back();
  EXPECT_TRUE(missing_of_law(p).empty());
  p.tendon = "equilibriumElastic";
  EXPECT_FALSE(missing_of_law(p).empty());
  p = project(Dialect::nmsm);
  EXPECT_FALSE(missing_of_law(p).empty());
  EXPECT_THROW((void)forces(p, VectorXd::Zero(500), VectorXd::Constant(50, 0.29)), InvalidInput);
  p = project();
  p.muscles[0].inputs = {{"none", 1.0}};
  EXPECT_THROW((void)forces(p, VectorXd::Zero(500), VectorXd::Constant(50, 0.29)), InvalidInput);
}

TEST(RecursiveActivation, AnswersAStepAsALagDoes) {
  constexpr double kInterval_s = 0.01, kTau_s = 0.05;
  Eigen::VectorXd step = Eigen::VectorXd::Ones(200);
  step.head(50).setZero();
  const double c = -std::exp(-kInterval_s / kTau_s);
  const Eigen::VectorXd one = recursive_activation(step, c, 0.0);
  for (int k = 0; k < 150; ++k) EXPECT_NEAR(one[50 + k], 1.0 - std::exp(-(k + 1) * kInterval_s / kTau_s), 1e-13);
  EXPECT_EQ(one.head(50).cwiseAbs().maxCoeff(), 0.0);
  // Two lags are one after the other, in any order.
  const double other = -std::exp(-kInterval_s / 0.02);
  const Eigen::VectorXd chain = recursive_activation(one, other, 0.0);
  EXPECT_LT((recursive_activation(step, c, other) - chain).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_EQ(recursive_activation(step, 0.0, 0.0), step);
}

TEST(ExponentialShape, RunsFromZeroToOneAndBendsByItsFactor) {
  for (const double factor : {-3.0, -1e-5, 0.0, 2.0}) {
    EXPECT_EQ(exponential_shape(0.0, factor), 0.0);
    EXPECT_NEAR(exponential_shape(1.0, factor), 1.0, 1e-15);
  }
  EXPECT_NEAR(exponential_shape(0.5, -2.0), (1.0 - std::exp(-1.0)) / (1.0 - std::exp(-2.0)), 1e-15);
  EXPECT_NEAR(exponential_shape(0.5, -1e-5), 0.5, 2e-6);
}

// At full excitation du/dt = (1 - u) / tau, at none -u / (4 tau). The scheme is of second order: (T / tau)^2 / 3 is
// 3e-3.

}  // namespace
}  // namespace myoid::opensim
