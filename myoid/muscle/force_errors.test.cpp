#include "myoid/muscle/force_errors.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/small_muscle.h"

namespace myoid::muscle {
namespace {

/// The muscle on a rigid tendon: its force is F_max times a function of motion and activation.
IsolatedModel rigid_muscle() {
  IsolatedModel model = test::small_muscle();
  model.laws.mode = TendonMode::rigid;
  return model;
}

struct Errors {
  Eigen::VectorXd of;
  Eigen::MatrixXd slopes;
};

Errors errors_at(ForceErrors& errors, const Eigen::VectorXd& x) {
  const Eigen::Index rows = errors.count() + errors.unknowns();
  Errors at{.of = Eigen::VectorXd(rows), .slopes = Eigen::MatrixXd(rows, errors.unknowns())};
  errors.evaluate(x, at.of, &at.slopes);
  return at;
}

TEST(ForceErrors, AreThoseOfForcesThatGrowWithTheMaximalForce) {
  const IsolatedModel start = rigid_muscle();
  const std::vector<IsolatedRecording> recordings = test::swings(start, {0.0008, 0.003});
  const IsolatedFitOptions options{.parameters = {"max_isometric_force"}};
  ForceErrors errors(start, recordings, options);
  ASSERT_EQ(errors.count(), 120);
  const Errors at = errors_at(errors, errors.start_logs() + Eigen::VectorXd::Constant(1, std::log(1.25)));
  for (Eigen::Index i = 0; i < 120; ++i) {
    // F (e^u - 1) and its derivative F e^u: the thinned lengths move forces by less than 1e-3, and the central
    // difference over 2 h = 0.01 is wrong by h^2 / 6.
    const double force_n = recordings[static_cast<std::size_t>(i / 60)].force_n[i % 60];
    EXPECT_NEAR(at.of[i], 0.25 * force_n, 2e-3 * force_n + 1e-6) << i;
    EXPECT_NEAR(at.slopes(i, 0), 1.25 * force_n, 2e-3 * force_n + 1e-6) << i;
  }
  EXPECT_EQ(at.of[120], 0.0);  // no belief
}

TEST(ForceErrors, HeldSlopesStayAndCostOneSimulationOfEachRecording) {
  const IsolatedModel start = rigid_muscle();
  const std::vector<IsolatedRecording> recordings = test::swings(start, {0.0008, 0.003});
  const IsolatedFitOptions options{.parameters = {"max_isometric_force"}};
  ForceErrors errors(start, recordings, options);
  const Eigen::VectorXd near = errors.start_logs(), far = near + Eigen::VectorXd::Constant(1, 0.2);
  const Errors at_near = errors_at(errors, near), at_far = errors_at(errors, far);
  errors.hold_slopes(near);
  errors.use_held_slopes(true);
  const int before = errors.evaluations();
  const Errors held = errors_at(errors, far);
  EXPECT_EQ(errors.evaluations(), before + 2);
  EXPECT_EQ(held.of, at_far.of);
  EXPECT_EQ(held.slopes, at_near.slopes);
  errors.use_held_slopes(false);
  EXPECT_EQ(errors_at(errors, far).slopes, at_far.slopes);
}

TEST(ForceErrors, ARecordingThatIsLeftOutHasNoRows) {
  const IsolatedModel start = rigid_muscle();
  const std::vector<IsolatedRecording> recordings = test::swings(start, {0.0008, 0.002, 0.003});
  const IsolatedFitOptions options{.parameters = {"max_isometric_force"}};
  ForceErrors errors(start, recordings, options);
  const Eigen::VectorXd x = errors.start_logs() + Eigen::VectorXd::Constant(1, 0.1);
  const Eigen::VectorXd all = errors_at(errors, x).of;
  errors.use_all_but(1);
  EXPECT_EQ(errors.uses(), 2);
  EXPECT_EQ(errors.lengths(), (std::vector<Eigen::Index>{60, 60}));
  const Eigen::VectorXd two = errors_at(errors, x).of;
  EXPECT_EQ(two.head(60), all.head(60));
  EXPECT_EQ(two.segment(60, 60), all.segment(120, 60));
}

TEST(ForceErrors, BeliefsAreDistancesFromTheStartInTheirSpreads) {
  const IsolatedModel start = rigid_muscle();
  const std::vector<IsolatedRecording> recordings = test::swings(start, {0.0008, 0.003});
  const IsolatedFitOptions options{
      .parameters = {"max_isometric_force", "max_shortening_speed"}, .reach = 3.0, .own = {"max_isometric_force"}};
  ForceErrors errors(start, recordings, options);
  constexpr double kNoise_n = 0.02, kScatter = 0.1;
  errors.believe(kNoise_n, Eigen::VectorXd::Constant(1, kScatter));
  ASSERT_EQ(errors.unknowns(), 4);
  Eigen::Vector4d x;
  x << errors.start_logs() + Eigen::Vector2d(0.2, -0.1), 0.05, -0.03;
  const Errors at = errors_at(errors, x);
  const double common = kNoise_n * 1.96 / std::log(3.0), own = kNoise_n / kScatter;
  EXPECT_NEAR((at.of.tail(4) - Eigen::Vector4d(0.2 * common, -0.1 * common, 0.05 * own, -0.03 * own)).norm(), 0.0,
              1e-15);
  EXPECT_NEAR((at.slopes.bottomRows(4).diagonal() - Eigen::Vector4d(common, common, own, own)).cwiseAbs().maxCoeff(),
              0.0, 1e-15);
  // A recording's own value moves its own forces, as the common one moves all.
  EXPECT_EQ(at.slopes.block(0, 2, 60, 1), at.slopes.block(0, 0, 60, 1));
  EXPECT_TRUE(at.slopes.block(60, 2, 60, 1).isZero(0.0));
  EXPECT_EQ(at.slopes.block(60, 3, 60, 1), at.slopes.block(60, 0, 60, 1));
  EXPECT_NEAR(errors.logs_of_use(x, 1)[0], x[0] - 0.03, 1e-15);
}

TEST(ForceErrors, DenseForcesCountEveryTwoMilliseconds) {
  const IsolatedModel start = rigid_muscle();
  IsolatedRecording dense = test::swing(0.001, "dense");
  dense.time_s = Eigen::VectorXd::LinSpaced(1001, 0.0, 0.5);
  dense.force_n = isolated_force(start, dense);
  const std::vector<IsolatedRecording> recordings{dense};
  const IsolatedFitOptions options{.parameters = {"max_isometric_force"}};
  const ForceErrors errors(start, recordings, options);
  EXPECT_EQ(errors.count(), 251);
}

TEST(ForceErrors, ForcesEndWhereTheStepsOfTheIntegrationDo) {
  const IsolatedModel start = test::small_muscle();
  const IsolatedRecording recording = test::swing(0.001, "swing");
  EXPECT_FALSE(force_of(start, recording.input, recording.time_s, 1e-7, 5).allFinite());
  EXPECT_TRUE(force_of(start, recording.input, recording.time_s, 1e-7, 20'000).allFinite());
}

}  // namespace
}  // namespace myoid::muscle
