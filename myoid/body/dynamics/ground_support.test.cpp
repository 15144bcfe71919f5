#include "myoid/body/dynamics/ground_support.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"

#include "tests/support/vertical_slider.h"

namespace myoid::body {
namespace {

/// A pelvis on a free vertical translation, with a leg of two segments below and an arm beside.
body::BodyModel standing_person(double trunk_kg) {
  body::BodyModel model;
  model.bodies = {{.name = "ground"},
                  {.name = "pelvis", .mass_kg = trunk_kg},
                  {.name = "thigh", .mass_kg = 8.0},
                  {.name = "shank", .mass_kg = 4.0},
                  {.name = "arm", .mass_kg = 3.0}};
  const auto hinge = [](const char* name, int parent, int child, int coordinate, const Vec3& at) {
    body::Joint joint{.name = name, .class_name = "PinJoint", .parent = parent, .child = child};
    joint.X_PF.p = at;
    joint.coordinates = {coordinate};
    joint.rotation[0] = {Vec3::UnitZ(), coordinate, body::Linear{1.0, 0.0}};
    joint.rotation[1].axis = Vec3::UnitX();
    joint.rotation[2].axis = Vec3::UnitY();
    return joint;
  };
  model.joints = {test::vertical_slider(), hinge("hip", 1, 2, 1, Vec3::Zero()),
                  hinge("knee", 2, 3, 2, Vec3(0.0, -0.4, 0.0)), hinge("shoulder", 1, 4, 3, Vec3(0.0, 0.5, 0.0))};
  model.coordinates = {{.name = "pelvis_ty", .joint = 0, .motion = body::MotionType::translational},
                       {.name = "hip_flexion", .joint = 1},
                       {.name = "knee_angle", .joint = 2},
                       {.name = "arm_flex", .joint = 3}};
  return body::finalize(std::move(model));
}

TimeSeries forces(double vertical_n) {
  Eigen::MatrixXd values(50, 1);
  values.setConstant(vertical_n);
  return {Eigen::VectorXd::LinSpaced(50, 0.0, 1.0), {{"pelvis_ty_force", Unit::newton}}, values};
}

TEST(UnsupportedWeight, IsWhatTheTrunkWouldHaveToBear) {
  const body::BodyModel model = standing_person(60.0);
  const double weight = 75.0 * kStandardGravity;
  const auto found = unsupported_weight(model, forces(1.02 * weight));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->coordinate, "pelvis_ty");
  EXPECT_NEAR(found->weight_n, weight, 1e-9);
  EXPECT_NEAR(found->force_n, 1.02 * weight, 1e-9);
  // With a ground reaction what is left is some percent of the weight.
  EXPECT_FALSE(unsupported_weight(model, forces(0.05 * weight)));
  EXPECT_FALSE(unsupported_weight(model, forces(-0.2 * weight)));
}

TEST(UnsupportedWeight, IsNoneWhereTheModelIsFixedOrThereIsNoGravity) {
  body::BodyModel held = standing_person(60.0);
  held.coordinates[0].locked = true;
  EXPECT_FALSE(unsupported_weight(held));
  body::BodyModel weightless = standing_person(60.0);
  weightless.gravity_G.setZero();
  EXPECT_FALSE(unsupported_weight(weightless));
  EXPECT_TRUE(unsupported_weight(standing_person(60.0)));
}

TEST(UncarriedTime, IsThatInWhichAFootIsBesideThePlates) {
  const body::BodyModel model = standing_person(60.0);
  const double weight = 75.0 * kStandardGravity;
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(201, 0.0, 2.0);
  const auto residual = [&](double from_s, double to_s, double share) {
    Eigen::MatrixXd values = Eigen::MatrixXd::Constant(201, 1, 0.05 * weight);
    for (Eigen::Index i = 0; i < 201; ++i) {
      if (time[i] >= from_s - 1e-9 && time[i] <= to_s + 1e-9) values(i, 0) = share * weight;
    }
    return TimeSeries(time, {{"pelvis_ty_force", Unit::newton}}, values);
  };
  const auto found = uncarried_time(model, residual(0.0, 0.42, 1.1));
  ASSERT_TRUE(found);
  ASSERT_EQ(found->stretches.size(), 1U);
  EXPECT_NEAR(found->stretches[0].begin_s, 0.0, 1e-9);
  EXPECT_NEAR(found->stretches[0].end_s, 0.42, 1e-9);
  EXPECT_NEAR(found->share, 0.21, 1e-9);
  EXPECT_NEAR(found->force_n, 1.1 * weight, 1e-9);
  // What inverse dynamics leaves at an impact, and what someone who sits leaves throughout.
  EXPECT_FALSE(uncarried_time(model, residual(1.0, 1.03, 0.8)));
  EXPECT_FALSE(uncarried_time(model, residual(0.5, 1.0, 0.3)));
  EXPECT_FALSE(uncarried_time(model, residual(0.0, 2.0, 0.7)));
}

TEST(BearsTheBody, TheLegThatStandsAndNotTheArm) {
  const body::BodyModel model = standing_person(60.0);
  EXPECT_TRUE(bears_the_body(model, "knee_angle", model.default_q(), 75.0));
  EXPECT_TRUE(bears_the_body(model, "hip_flexion", model.default_q(), 0.0));
  EXPECT_FALSE(bears_the_body(model, "arm_flex", model.default_q(), 75.0));
}

TEST(BearsTheBody, NothingOfAModelThatIsNoWholePerson) {
  const body::BodyModel model = standing_person(30.0);
  EXPECT_FALSE(bears_the_body(model, "knee_angle", model.default_q(), 75.0));
  EXPECT_FALSE(stands(standing_person(15.0), model.default_q()));
  EXPECT_TRUE(stands(standing_person(60.0), model.default_q()));
}

/// A plate whose force is `n` for the second half of two seconds, and nothing before.
ExternalLoads plate(const Vec3& n) {
  const auto columns = [](const Vec3& late) {
    Eigen::MatrixX3d values = Eigen::MatrixX3d::Zero(200, 3);
    values.bottomRows(100).rowwise() = late.transpose();
    return LoadColumns::interpolate(math::SplineKnots(Eigen::VectorXd::LinSpaced(200, 0.0, 2.0), 1), values);
  };
  ExternalLoads loads;
  loads.forces.push_back(
      {.name = "plate", .body = 3, .force = columns(n), .point = columns(Vec3::Zero()), .torque = {}});
  return loads;
}

TEST(WrongSupport, SaysTheSignTheAxisOrTheUnitOfForcesThatDoNotCarryTheBody) {
  using ::testing::HasSubstr;
  const body::BodyModel model = standing_person(60.0);
  const double weight_n = 75.0 * kStandardGravity;
  const Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(100, 0.0, 2.0);
  const auto says = [&](const Vec3& force_n) {
    const auto wrong = wrong_support(model, plate(force_n), time_s);
    return wrong ? (wrong->is_misdirected() ? "misdirected: " : "") + wrong->sentence() : std::string();
  };
  EXPECT_EQ(says(0.95 * weight_n * Vec3::UnitY()), "");
  EXPECT_EQ(says(0.55 * weight_n * Vec3::UnitY()), "");
  // The mean while the force acts, not over the two seconds.
  EXPECT_THAT(says(-0.95 * weight_n * Vec3::UnitY()),
              AllOf(HasSubstr("misdirected: "), HasSubstr("downwards"), HasSubstr("-0.95 times")));
  EXPECT_THAT(says(0.95 * weight_n * Vec3::UnitZ()), AllOf(HasSubstr("misdirected: "), HasSubstr("sideways")));
  EXPECT_THAT(says(0.95 / 9.80665 * weight_n * Vec3::UnitY()), AllOf(HasSubstr(" 9.7 %"), HasSubstr("in kgf?")));
  EXPECT_THAT(says(0.95 / 4.4482 * weight_n * Vec3::UnitY()), HasSubstr("in lbf?"));
  EXPECT_THAT(says(0.95e-3 * weight_n * Vec3::UnitY()), AllOf(HasSubstr("in kN?"), HasSubstr(" 1000")));
  EXPECT_THAT(says(0.4 * weight_n * Vec3::UnitY()), HasSubstr("missing"));
}

TEST(WrongSupport, IsOfForcesOnTheGroundUnderABodyThatIsFree) {
  const Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(100, 0.0, 2.0);
  body::BodyModel model = standing_person(60.0);
  ExternalLoads loads = plate(-700.0 * Vec3::UnitY());
  ASSERT_TRUE(wrong_support(model, loads, time_s));
  loads.forces[0].point_frame = 3;  // a weight that hangs from the body
  EXPECT_FALSE(wrong_support(model, loads, time_s));
  loads.forces[0].point_frame = 0;
  model.coordinates[0].locked = true;
  EXPECT_FALSE(wrong_support(model, loads, time_s));
}

TEST(UnsupportedWeight, AsksNotForForcesThatAreGiven) {
  const UnsupportedWeight weight{"pelvis_ty", 765.0, 836.0};
  EXPECT_EQ(weight.sentence("").find("give"), std::string::npos);
  EXPECT_NE(weight.sentence("--loads").find("by --loads"), std::string::npos);
}

TEST(BearsTheBody, AStatedMassThatIsTooLargeTakesTheGroundFromNoModel) {
  EXPECT_TRUE(bears_the_body(standing_person(60.0), "knee_angle", standing_person(60.0).default_q(), 180.0));
}

}  // namespace
}  // namespace myoid::body
