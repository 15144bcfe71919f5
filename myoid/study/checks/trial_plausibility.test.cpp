#include "myoid/study/checks/trial_plausibility.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/units.h"
#include "myoid/recording/laboratory_up.h"

namespace myoid::study {
namespace {

struct Elbow {
  Study study;
  body::BodyModel model = body::parse_osim(body::arm4_osim(), "arm4.osim");
  TrialSpec trial;
  TrialInput input;

  Elbow() {
    study.model.builtin = "arm4";
    trial.name = "t";
    // The motions of these tests have the elbow's angle alone.
    for (body::Coordinate& c : model.coordinates) c.locked = c.name != "elbow_flexion";
  }
  [[nodiscard]] std::vector<Remark> findings() const {
    return implausible(study, model, joint_capacities(study, model), trial, input);
  }
};

/// Sine between two angles.
TimeSeries angle(double from_deg, double to_deg) {
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(400, 0.0, 4.0);
  const Eigen::MatrixXd q =
      kDegree * (0.5 * (from_deg + to_deg) + 0.5 * (to_deg - from_deg) * (3.0 * time.array()).sin());
  return {time, {{"elbow_flexion", Unit::radian}}, q};
}

TEST(Implausible, TorqueInNewtonMillimetersIsAnErrorWithTheRemedy) {
  Elbow elbow;
  elbow.trial.external_torque = "push.sto";
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(400, 0.0, 4.0);
  for (const double peak_nm : {2.0, 20.0, 70.0}) {
    for (const double unit : {1.0, 1000.0}) {
      elbow.input.external_torque = TimeSeries(time, {{"elbow_flexion_moment", Unit::newton_meter}},
                                               Eigen::MatrixXd(unit * peak_nm * (2.0 * time.array()).sin()));
      const std::vector<Remark> found = elbow.findings();
      ASSERT_EQ(found.size(), unit > 1.0 ? 1U : 0U) << peak_nm;
      if (found.empty()) continue;
      EXPECT_EQ(found[0].severity, Severity::error);
      EXPECT_NE(found[0].says.find("push.sto reaches"), std::string::npos) << found[0].says;
      EXPECT_NE(found[0].says.find("N mm? Divide by 1000"), std::string::npos) << found[0].says;
    }
  }
}

TEST(Implausible, AnglesBeyondPeoplesAreAWarningWhereTheModelsRangeTellsNoConvention) {
  Elbow ankle;
  body::Coordinate& c =
      ankle.model.coordinates[static_cast<std::size_t>(ankle.model.coordinate_index("elbow_flexion"))];
  c.name = "ankle_angle_r";
  ankle.study.model.coordinate = c.name;
  const auto found_for = [&](double from_deg, double to_deg, double model_deg) {
    c.lower = -model_deg * kDegree;
    c.upper = model_deg * kDegree;
    TimeSeries turned = angle(from_deg, to_deg);
    ankle.input.motion = TimeSeries(turned.time_s(), {{c.name, Unit::radian}}, turned.values());
    std::vector<Remark> found = ankle.findings();
    std::erase_if(found, [](const Remark& r) { return r.code != RemarkCode::angle_outside_range; });
    return found;
  };
  // An ankle reaches 20 degrees of dorsiflexion and 50 of plantar flexion, and some people 10 more.
  EXPECT_TRUE(found_for(-36.0, 5.0, 90.0).empty());
  const std::vector<Remark> reversed = found_for(-5.0, 36.0, 90.0);
  ASSERT_EQ(reversed.size(), 1U);
  EXPECT_EQ(reversed[0].severity, Severity::warning);
  // A model of a narrower range has its own convention.
  EXPECT_TRUE(found_for(-5.0, 36.0, 40.0).empty());
}

TEST(Implausible, CoordinatesThatTheMotionLacksAreNamed) {
  Elbow elbow;
  elbow.input.motion = angle(10.0, 100.0);
  EXPECT_TRUE(elbow.findings().empty());
  for (body::Coordinate& c : elbow.model.coordinates) c.locked = false;
  const std::vector<Remark> found = elbow.findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, RemarkCode::coordinate_absent);
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_EQ(found[0].where, "t");
}

TEST(Implausible, ANegatedAngleIsAnErrorThatAsksForTheSign) {
  Elbow elbow;
  elbow.input.motion = angle(-150.0, -20.0);
  const std::vector<Remark> found = elbow.findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::error);
  EXPECT_NE(found[0].says.find("-10 to 150 deg"), std::string::npos) << found[0].says;
  EXPECT_FALSE(found[0].remedy.empty());
  EXPECT_NE(found[0].says.find("opposite"), std::string::npos) << found[0].says;
}

TEST(Implausible, AnAngleOfAnotherConventionIsOnlyAWarningWhereTheRangeIsNoLimit) {
  Elbow elbow;
  elbow.input.motion = angle(200.0, 300.0);  // neither it nor its negative is in -10 to 150
  ASSERT_EQ(elbow.findings().size(), 1U);
  EXPECT_EQ(elbow.findings()[0].severity, Severity::error);
  EXPECT_EQ(elbow.findings()[0].code, RemarkCode::angle_outside_range);
  EXPECT_EQ(elbow.findings()[0].says.find("opposite"), std::string::npos);
  body::Coordinate& c =
      elbow.model.coordinates[static_cast<std::size_t>(elbow.model.coordinate_index("elbow_flexion"))];
  c.clamped = false;
  EXPECT_EQ(elbow.findings()[0].severity, Severity::warning);
  c.lower = c.upper = 0.0;  // the model has no range
  EXPECT_TRUE(elbow.findings().empty());
}

TEST(Implausible, AHeldMassCountsWhereItIsHeld) {
  Elbow elbow;
  elbow.study.subject.mass_kg = 75.0;
  elbow.trial.held_mass_kg = 5.5;
  const std::string forearm = elbow.model.bodies.back().name;
  elbow.study.model.held_mass = {.body = forearm, .p_BP_m = Vec3(0.0, -0.2, 0.0)};
  EXPECT_TRUE(elbow.findings().empty());
  elbow.study.model.held_mass->p_BP_m = Vec3(0.0, -2.5, 0.0);  // 135 N m
  EXPECT_EQ(elbow.findings().size(), 1U);
  // Muscles need not hold a mass that their joint does not move.
  elbow.trial.held_mass_kg = 60.0;
  elbow.study.model.held_mass->body = "ground";
  EXPECT_TRUE(elbow.findings().empty());
  // A model file without the place of the mass gives no load either.
  elbow.study.model.held_mass.reset();
  EXPECT_EQ(elbow.findings().size(), 1U);
  elbow.study.model.file = "arm.osim";
  EXPECT_TRUE(elbow.findings().empty());
}

TEST(Implausible, APostureBeyondTheRangeIsAWarningAndAFewDegreesAreNone) {
  Elbow elbow;
  elbow.input.motion = angle(-30.0, 130.0);
  const std::vector<Remark> found = elbow.findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::warning);
  elbow.input.motion = angle(-15.0, 155.0);
  EXPECT_TRUE(elbow.findings().empty());
}

TEST(Implausible, AHeldMassThatNoMuscleHoldsIsAWarningAndOneBeyondThePersonsAnError) {
  Elbow elbow;
  elbow.study.subject.mass_kg = 75.0;
  elbow.input.motion = angle(10.0, 130.0);
  elbow.trial.held_mass_kg = 5.5;
  EXPECT_TRUE(elbow.findings().empty());
  // A mass that can be held may be too much for a movement.
  elbow.trial.held_mass_kg = 27.0;
  EXPECT_EQ(elbow.findings().size(), 1U);
  elbow.trial.use = Use::isometric;
  EXPECT_TRUE(elbow.findings().empty());
  elbow.trial.use = Use::calibration;
  elbow.trial.held_mass_kg = 55.0;
  std::vector<Remark> found = elbow.findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_NE(found[0].says.find("decimal point"), std::string::npos) << found[0].says;
  elbow.trial.held_mass_kg = 550.0;
  found = elbow.findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::error);
}

/// Whole trunk with an arm: four markers on the trunk, which stands on a free joint.
body::BodyModel trunk_with_arm() {
  body::BodyModel model;
  model.bodies = {{.name = "ground"},
                  {.name = "thorax", .mass_kg = 40.0},
                  {.name = "humerus", .mass_kg = 2.0},
                  {.name = "forearm", .mass_kg = 1.5}};
  const auto hinge = [](const char* name, int parent, int child, int coordinate) {
    body::Joint joint{.name = name, .class_name = "PinJoint", .parent = parent, .child = child};
    joint.coordinates = {coordinate};
    joint.rotation[0] = {Vec3::UnitZ(), coordinate, body::Linear{1.0, 0.0}};
    joint.rotation[1].axis = Vec3::UnitX();
    joint.rotation[2].axis = Vec3::UnitY();
    return joint;
  };
  model.joints = {hinge("root", 0, 1, 0), hinge("shoulder", 1, 2, 1), hinge("elbow", 2, 3, 2)};
  model.joints[2].X_PF.p = Vec3(0.0, -0.3, 0.0);
  for (const char* name : {"tilt", "shoulder", "elbow_flexion"}) {
    model.coordinates.push_back({.name = name, .joint = static_cast<int>(model.coordinates.size())});
  }
  const std::vector<Vec3> places{{0, 0, 0}, {0.1, 0.4, 0}, {0, 0.4, 0.2}, {0, 0.4, -0.2}, {0.1, 0.1, 0.1}};
  for (std::size_t i = 0; i < places.size(); ++i) model.markers.push_back({"T" + std::to_string(i), 1, places[i]});
  return body::finalize(std::move(model));
}

TEST(Implausible, AVerticalThatLiesAcrossTheTrunkIsAWarning) {
  Elbow elbow;
  elbow.model = trunk_with_arm();
  MarkerSeries markers;
  markers.time_s = Eigen::VectorXd::LinSpaced(20, 0.0, 0.19);
  markers.positions_m.resize(20, 0);
  for (const body::Marker& m : elbow.model.markers) {
    markers.names.push_back(m.name);
    markers.positions_m.conservativeResize(Eigen::NoChange, markers.positions_m.cols() + 3);
    // A laboratory whose z points up: the model's (x, y, z) is its (x, -z, y).
    markers.positions_m.rightCols(3) = Vec3(m.p_BM.x(), -m.p_BM.z(), m.p_BM.y()).transpose().replicate(20, 1);
  }
  elbow.study.model.builtin.clear();
  for (const char up : {'z', 'x', 'y'}) {
    elbow.study.markers.up = up;
    elbow.input.up_L = Vec3::Unit(up - 'x');
    elbow.input.markers = rotated(markers, rotation_to_y_up(up));
    const std::vector<Remark> found = elbow.findings();
    ASSERT_EQ(found.size(), up == 'z' ? 0U : 1U) << up;
    if (found.empty()) continue;
    EXPECT_EQ(found[0].severity, Severity::warning);
    EXPECT_NE(found[0].says.find("up = \"z\""), std::string::npos) << found[0].says;
  }
}

/// Returns the finding for a trunk whose long axis points there, in a laboratory whose y points up.
std::vector<Remark> of_a_trunk_along(const Vec3& axis, const std::string& coordinate = "") {
  Elbow elbow;
  elbow.model = trunk_with_arm();
  elbow.study.model.builtin.clear();
  if (!coordinate.empty()) elbow.study.model.coordinate = coordinate;
  elbow.study.markers.up = 'y';
  MarkerSeries& markers = elbow.input.markers.emplace();
  markers.time_s = Eigen::VectorXd::LinSpaced(20, 0.0, 0.19);
  markers.positions_m.resize(20, 0);
  const Mat3 R = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitY(), axis).toRotationMatrix();
  for (const body::Marker& m : elbow.model.markers) {
    markers.names.push_back(m.name);
    markers.positions_m.conservativeResize(Eigen::NoChange, markers.positions_m.cols() + 3);
    markers.positions_m.rightCols(3) = (R * m.p_BM).transpose().replicate(20, 1);
  }
  return elbow.findings();
}

TEST(Implausible, AVerticalInAnyOfSixDirectionsIsFound) {
  for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitZ())}) {
    for (const double sign : {1.0, -1.0}) {
      const std::vector<Remark> found = of_a_trunk_along(sign * axis);
      ASSERT_EQ(found.size(), 1U);
      const std::string name = recording::axis_name(sign * axis);
      EXPECT_NE(found[0].says.find("with " + name + " up"), std::string::npos) << found[0].says;
      // [markers] up has no word for an axis that points down.
      EXPECT_EQ(found[0].says.find("up = \"" + name) != std::string::npos, sign > 0.0) << found[0].says;
    }
  }
}

TEST(Implausible, ALeaningTrunkOrALimbIsNoWrongVertical) {
  const auto leaning = [](double deg) { return Vec3(0.0, std::cos(deg * kDegree), std::sin(deg * kDegree)); };
  EXPECT_EQ(of_a_trunk_along(leaning(65.0)).size(), 1U);
  EXPECT_TRUE(of_a_trunk_along(leaning(57.0)).empty());
  // Across, but not upright by another axis either.
  EXPECT_TRUE(of_a_trunk_along(Vec3(0.65, 0.4, 0.65)).empty());
  // A body that the study's joint moves may have any orientation.
  EXPECT_TRUE(of_a_trunk_along(leaning(90.0), "tilt").empty());
  EXPECT_TRUE(of_a_trunk_along(leaning(90.0), "shoulder").empty());
}

TEST(Implausible, APassiveTrialWithoutAMeasuredTorqueGivesNothingAndIsSaid) {
  Elbow elbow;
  elbow.input.motion = angle(20.0, 90.0);
  EXPECT_TRUE(elbow.findings().empty());
  elbow.trial.use = Use::passive;
  const std::vector<Remark> found = elbow.findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_NE(sentence(found[0]).find("give external_torque"), std::string::npos) << sentence(found[0]);
  elbow.trial.load_cell = "cell.csv";
  EXPECT_TRUE(elbow.findings().empty());
}

}  // namespace
}  // namespace myoid::study
