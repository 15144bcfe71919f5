#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/tool_folder.h"

namespace myoid::opensim {
namespace {

// A pendulum about z: a bob of 2 kg whose center lies 0.5 m below the hinge, and a tip of 1 kg,
// welded on, 1 m below it.
constexpr double kBob_kg = 2.0, kBob_m = 0.5, kTip_kg = 1.0, kTip_m = 1.0, kInertia_kgm2 = 0.03;
constexpr double kMoment_kgm = kBob_kg * kBob_m + kTip_kg * kTip_m;
constexpr double kAbout_hinge_kgm2 = kBob_kg * kBob_m * kBob_m + kTip_kg * kTip_m * kTip_m + 2.0 * kInertia_kgm2;

class ToolAccelerations : public test::ToolFolder {
 protected:
  void SetUp() override {
    const auto body = [](const char* name, double mass, double y) {
      return fmt::format(
          "<Body name=\"{}\"><mass>{}</mass><mass_center>0 {} 0</mass_center>"
          "<inertia>0.01 0.02 {} 0 0 0</inertia></Body>",
          name, mass, y, kInertia_kgm2);
    };
    write("pendulum.osim",
          "<OpenSimDocument Version=\"40000\"><Model name=\"pendulum\"><gravity>0 -9.80665 0"
          "</gravity><BodySet><objects>" +
              body("bob", kBob_kg, -kBob_m) + body("tip", kTip_kg, -kTip_m) +
              "</objects></BodySet><JointSet><objects><PinJoint name=\"hinge\">"
              "<socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/bob"
              "</socket_child_frame><coordinates><Coordinate name=\"swing\"/></coordinates>"
              "</PinJoint><WeldJoint name=\"weld\"><socket_parent_frame>/bodyset/bob"
              "</socket_parent_frame><socket_child_frame>/bodyset/tip</socket_child_frame>"
              "</WeldJoint></objects></JointSet><ForceSet><objects>" +
              motor("weak", 1.0) + motor("strong", 3.0) + "</objects></ForceSet></Model></OpenSimDocument>");
    std::string text = "Coordinates\nversion=1\nnRows=60\nnColumns=2\ninDegrees=no\nendheader\ntime\tswing\n";
    for (int i = 0; i < 60; ++i) text += fmt::format("{}\t{}\n", 0.01 * i, swing(0.01 * i));
    write("motion.mot", text);
  }
  static std::string motor(const char* name, double strength) {
    return fmt::format(
        "<CoordinateActuator name=\"{}\"><coordinate>swing</coordinate><optimal_force>{}"
        "</optimal_force></CoordinateActuator>",
        name, strength);
  }
  static double swing(double t_s) { return 0.4 + 0.8 * std::sin(5.0 * t_s); }

  [[nodiscard]] ToolResult analyze(const std::string& analyses) const {
    return run(
        "<AnalyzeTool name=\"a\"><model_file>pendulum.osim</model_file><initial_time>0"
        "</initial_time><final_time>0.59</final_time><coordinates_file>motion.mot"
        "</coordinates_file><AnalysisSet><objects>" +
        analyses + "</objects></AnalysisSet></AnalyzeTool>");
  }
  /// Angle, speed and acceleration of each row, of a free pendulum, from the files of Kinematics.
  struct Swing {
    double q, u, acceleration;
  };
  [[nodiscard]] std::vector<Swing> swings() const {
    const TimeSeries q = read("a_k_q.sto"), u = read("a_k_u.sto");
    std::vector<Swing> rows;
    for (Eigen::Index i = 0; i < q.sample_count(); ++i) {
      const double angle = q.values()(i, 0);
      rows.push_back({angle, u.values()(i, 0), -kStandardGravity * kMoment_kgm * std::sin(angle) / kAbout_hinge_kgm2});
    }
    return rows;
  }
  static constexpr const char* kKinematics = "<Kinematics name=\"k\"><in_degrees>false</in_degrees></Kinematics>";
};

// Eight decimals in the files, times the lengths and rates of the pendulum (below 30).
constexpr double kDecimals = 1e-6;

TEST_F(ToolAccelerations, AreThoseOfAFreePendulum) {
  const ToolResult result = analyze(kKinematics);
  const TimeSeries acceleration = read("a_k_dudt.sto");
  const auto rows = swings();
  ASSERT_EQ(rows.size(), 60U);
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_NEAR(acceleration.values()(static_cast<Eigen::Index>(i), 0), rows[i].acceleration, kDecimals);
  EXPECT_THAT(sentences(result.remarks), ::testing::Contains(::testing::HasSubstr("differ from the motion's second")));
  std::ignore = analyze("<Kinematics name=\"k\"/>");
  EXPECT_NEAR(kDegree * read("a_k_dudt.sto").values()(7, 0), rows[7].acceleration, kDecimals);
}

TEST_F(ToolAccelerations, MoveBodiesPointsAndTheWholeBody) {
  std::ignore = analyze(std::string(kKinematics) +
                        "<BodyKinematics name=\"b\"><in_degrees>false</in_degrees></BodyKinematics>"
                        "<BodyKinematics name=\"own\"><bodies>tip center_of_mass</bodies><in_degrees>false"
                        "</in_degrees><express_results_in_body_local_frame>true"
                        "</express_results_in_body_local_frame></BodyKinematics>"
                        "<PointKinematics name=\"p\"><body_name>tip</body_name><relative_to_body_name>bob"
                        "</relative_to_body_name><point_name>end</point_name><point>0 -1 0</point>"
                        "</PointKinematics>");
  const TimeSeries body = read("a_b_acc_global.sto"), own = read("a_own_acc_bodyLocal.sto");
  const TimeSeries end = read("a_p_end_acc.sto");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a_own_pos_global.sto"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a_own_vel_bodyLocal.sto"));
  const auto rows = swings();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const auto [q, u, acceleration] = rows[k];
    const Vec3 across(std::cos(q), std::sin(q), 0.0), inward(-std::sin(q), std::cos(q), 0.0);
    const auto at_radius = [&](double r) { return Vec3(r * (acceleration * across + u * u * inward)); };
    const auto three = [&](const TimeSeries& table, const std::string& name) {
      return Vec3(table.column(name + "_X")[i], table.column(name + "_Y")[i], table.column(name + "_Z")[i]);
    };
    EXPECT_LT((three(body, "bob") - at_radius(kBob_m)).norm(), kDecimals);
    EXPECT_LT((three(body, "tip") - at_radius(kTip_m)).norm(), kDecimals);
    EXPECT_NEAR(body.column("tip_Oz")[i], acceleration, kDecimals);
    const Vec3 whole = at_radius(kMoment_kgm / (kBob_kg + kTip_kg));
    EXPECT_LT((three(body, "center_of_mass") - whole).norm(), kDecimals);
    EXPECT_LT((three(own, "center_of_mass") - whole).norm(), kDecimals);  // stays in ground
    const Vec3 local(kTip_m * acceleration, kTip_m * u * u, 0.0);
    EXPECT_LT((three(own, "tip") - local).norm(), kDecimals);
    EXPECT_LT((three(end, "end") - local).norm(), kDecimals);
  }
}

// The moment that the motion takes, I a + g m sin(q): by one motor on the coordinate, or by the
// model's own motors, which share it by the squares of their strengths, 1 : 9.
TEST_F(ToolAccelerations, InverseDynamicsSharesTheMomentOfTheMotion) {
  std::ignore = analyze(
      "<InverseDynamics name=\"one\"><use_model_force_set>false</use_model_force_set>"
      "</InverseDynamics><InverseDynamics name=\"own\"/>");
  const TimeSeries one = read("a_one.sto"), own = read("a_own.sto");
  for (Eigen::Index i = 15; i < 45; ++i) {
    const double t = one.time_s()[i], q = swing(t);
    const double moment = -20.0 * std::sin(5.0 * t) * kAbout_hinge_kgm2 + kStandardGravity * kMoment_kgm * std::sin(q);
    // The quintic spline's second derivative of a sine of 5 rad/s at 100 Hz, away from the ends.
    EXPECT_NEAR(one.column("swing_moment")[i], moment, 1e-3);
    EXPECT_NEAR(own.column("weak")[i], 0.1 * one.column("swing_moment")[i], kDecimals);
    EXPECT_NEAR(own.column("strong")[i], 0.9 * one.column("swing_moment")[i], kDecimals);
  }
}

TEST_F(ToolAccelerations, ActuationHasForceSpeedAndPower) {
  std::ignore = analyze(std::string(kKinematics) + "<Actuation name=\"act\"/>");
  const TimeSeries speed = read("a_act_speed.sto");
  const auto rows = swings();
  for (std::size_t i = 0; i < rows.size(); ++i)
    EXPECT_NEAR(speed.column("strong")[static_cast<Eigen::Index>(i)], rows[i].u, kDecimals);
  EXPECT_EQ(read("a_act_force.sto").values().norm(), 0.0);  // without control
  EXPECT_EQ(read("a_act_power.sto").channel_count(), 2);
}

// Controls of a file drive the motors: 2 of a strength of 3 accelerate by 6 N m more, and do work
// at the pendulum's speed.
TEST_F(ToolAccelerations, CountTheControlsOfActuators) {
  write("controls.sto",
        "c\nversion=1\nnRows=2\nnColumns=2\ninDegrees=no\nendheader\ntime\t/forceset/strong\n"
        "0\t2\n1\t2\n");
  std::ignore =
      run("<AnalyzeTool name=\"a\"><model_file>pendulum.osim</model_file><initial_time>0</initial_time>"
          "<final_time>0.59</final_time><coordinates_file>motion.mot</coordinates_file><ControllerSet>"
          "<objects><ControlSetController><controls_file>controls.sto</controls_file>"
          "</ControlSetController></objects></ControllerSet><AnalysisSet><objects>" +
          std::string(kKinematics) + "<Actuation name=\"act\"/></objects></AnalysisSet></AnalyzeTool>");
  const TimeSeries acceleration = read("a_k_dudt.sto"), power = read("a_act_power.sto");
  const auto rows = swings();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    EXPECT_NEAR(acceleration.values()(i, 0), rows[k].acceleration + 6.0 / kAbout_hinge_kgm2, kDecimals);
    EXPECT_NEAR(power.column("strong")[i], 6.0 * rows[k].u, kDecimals);
    EXPECT_EQ(power.column("weak")[i], 0.0);
  }
}

TEST_F(ToolAccelerations, AreLeftOutWithWordsWhereNothingHasMass) {
  write("pendulum.osim",
        "<OpenSimDocument Version=\"40000\"><Model name=\"m\"><BodySet><objects><Body name=\"b\">"
        "<mass>0</mass><mass_center>0 0 0</mass_center><inertia>0 0 0 0 0 0</inertia></Body>"
        "</objects></BodySet><JointSet><objects><PinJoint name=\"hinge\"><socket_parent_frame>"
        "/ground</socket_parent_frame><socket_child_frame>/bodyset/b</socket_child_frame>"
        "<coordinates><Coordinate name=\"swing\"/></coordinates></PinJoint></objects></JointSet>"
        "</Model></OpenSimDocument>");
  const ToolResult result = analyze(kKinematics);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a_k_q.sto"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a_k_dudt.sto"));
  EXPECT_THAT(sentences(result.remarks),
              ::testing::Contains(::testing::AllOf(::testing::HasSubstr("'swing'"),
                                                   ::testing::HasSubstr("accelerations are not written"))));
}

}  // namespace
}  // namespace myoid::opensim
