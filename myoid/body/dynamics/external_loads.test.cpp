#include "myoid/body/dynamics/external_loads.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/dynamics/inverse_dynamics.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"

#include "tests/support/message_of.h"

namespace myoid::body {
namespace {

class Loads : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("myoid_loads_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
    arm_ = body::parse_osim(body::arm4_osim(), "arm4.osim");
    body_ = arm_.bodies.back().name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  void write_set(const std::string& body, const std::string& more) const {
    write("loads.xml",
          "<?xml version=\"1.0\"?>\n<OpenSimDocument Version=\"40000\">\n"
          "<ExternalLoads name=\"l\"><objects>\n<ExternalForce name=\"grip\">\n"
          "<applied_to_body>" +
              body + "</applied_to_body>\n" + more +
              "</ExternalForce></objects><datafile>loads.mot</datafile></ExternalLoads>\n"
              "</OpenSimDocument>\n");
  }
  [[nodiscard]] ExternalLoads read() const { return read_external_loads(arm_, folder_ / "loads.xml"); }

  static constexpr const char* kIdentifiers =
      "<force_expressed_in_body>ground</force_expressed_in_body>"
      "<point_expressed_in_body>ground</point_expressed_in_body>"
      "<force_identifier>f_v</force_identifier><point_identifier>f_p</point_identifier>"
      "<torque_identifier>f_t</torque_identifier>";
  static std::string data(const std::string& rows) {
    return "loads\nversion=1\nnRows=4\nnColumns=10\ninDegrees=no\nendheader\n"
           "time\tf_vx\tf_vy\tf_vz\tf_px\tf_py\tf_pz\tf_tx\tf_ty\tf_tz\n" +
           rows;
  }

  std::filesystem::path folder_;
  body::BodyModel arm_;
  std::string body_;
};

TEST_F(Loads, AForceAtAPointOfGroundTurnsAboutTheBodysOrigin) {
  write_set(body_, kIdentifiers);
  write("loads.mot", data("0\t1\t2\t3\t0.1\t0.2\t0.3\t0\t0.5\t0\n0.1\t1\t2\t3\t0.1\t0.2\t0.3\t0\t0.5\t0\n"
                          "0.2\t1\t2\t3\t0.1\t0.2\t0.3\t0\t0.5\t0\n0.3\t1\t2\t3\t0.1\t0.2\t0.3\t0\t0.5\t0\n"));
  const ExternalLoads loads = read();
  body::BodyState state = body::make_state(arm_);
  body::compute_poses(arm_, arm_.default_q(), state);
  std::vector<body::BodyWrench> wrenches;
  loads.append_wrenches(state, 0.17, wrenches);
  ASSERT_EQ(wrenches.size(), 1U);
  const Vec3 f(1.0, 2.0, 3.0);
  const Vec3 arm = Vec3(0.1, 0.2, 0.3) - state.X_GB.back().p;
  EXPECT_LT((wrenches[0].f_G - f).norm(), 1e-12);
  EXPECT_LT((wrenches[0].m_G - arm.cross(f) - Vec3(0.0, 0.5, 0.0)).norm(), 1e-12);
}

TEST_F(Loads, GeneralizedForcesBalanceTheLoadByVirtualWork) {
  // Expressed in the body itself, at its own point: tau of the load is -J' f.
  write_set(body_, "<force_expressed_in_body>" + body_ + "</force_expressed_in_body>" + "<point_expressed_in_body>" +
                       body_ + "</point_expressed_in_body>" +
                       "<force_identifier>f_v</force_identifier>"
                       "<point_identifier>f_p</point_identifier>");
  std::string rows;
  for (int i = 0; i < 8; ++i) rows += std::to_string(0.1 * i) + "\t4\t-5\t6\t0.01\t-0.2\t0.02\t0\t0\t0\n";
  write("loads.mot", data(rows));
  const ExternalLoads loads = read();
  const auto n = static_cast<Eigen::Index>(arm_.coordinates.size());
  Eigen::MatrixXd q(8, n);
  std::vector<Channel> channels;
  for (const auto& c : arm_.coordinates) channels.push_back({c.name, Unit::radian});
  for (int i = 0; i < 8; ++i) q.row(i) = (arm_.default_q().array() + 0.1 * i).transpose();
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(8, 0.0, 0.7);
  const body::JointMotion motion = body::joint_motion(arm_, {t, channels, q}).motion;
  const Eigen::MatrixXd with = inverse_dynamics(arm_, motion, {.loads = &loads, .passive_forces = false}).values();
  const Eigen::MatrixXd without = inverse_dynamics(arm_, motion).values();
  body::BodyState state = body::make_state(arm_);
  body::compute_poses(arm_, motion.q.values().row(3).transpose(), state);
  const auto b = static_cast<body::BodyIndex>(arm_.bodies.size()) - 1;
  const Eigen::VectorXd expected = -body::station_jacobian(arm_, state, b, Vec3(0.01, -0.2, 0.02)).transpose() *
                                   (state.X_GB.back().R * Vec3(4.0, -5.0, 6.0));
  EXPECT_LT((with.row(3) - without.row(3) - expected.transpose()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(expected.norm(), 0.1);
}

TEST_F(Loads, APointThatIsNoNumberWhileUnloadedIsMendedAndSaid) {
  write_set(body_, kIdentifiers);
  write("loads.mot", data("0\t0\t500\t0\t0.1\t0\t0\t0\t0\t0\n0.1\t0\t0.01\t0\tNaN\tNaN\tNaN\t0\t0\t0\n"
                          "0.2\t0\t0\t0\t1e9\t0\t0\t0\t0\t0\n0.3\t0\t500\t0\t0.4\t0\t0\t0\t0\t0\n"));
  const ExternalLoads loads = read();
  // What the table's reader says, and what became of it.
  ASSERT_EQ(loads.notes.size(), 2U);
  EXPECT_THAT(loads.notes[0].says, ::testing::HasSubstr("loads.mot"));
  EXPECT_THAT(loads.notes[1].says, ::testing::HasSubstr("2 rows"));
  EXPECT_NEAR(loads.forces[0].point->at(0.1)[0], 0.2, 1e-12);
  EXPECT_NEAR(loads.forces[0].point->at(0.2)[0], 0.3, 1e-12);
}

TEST_F(Loads, WhatCannotBeUsedIsNamedWithItsLine) {
  const auto message = [&] { return test::message_of([&] { (void)read(); }); };
  write("loads.mot", data("0\t0\t5\t0\t0\t0\t0\t0\t0\t0\n0.1\t0\t5\t0\tNaN\t0\t0\t0\t0\t0\n"));
  write_set("foot", kIdentifiers);
  EXPECT_THAT(message(),
              ::testing::AllOf(::testing::HasSubstr("loads.xml:4"), ::testing::HasSubstr("no body of the model")));
  write_set(body_, "<force_identifier>g_v</force_identifier>");
  EXPECT_THAT(message(), ::testing::HasSubstr("begins 0 columns"));
  write_set(body_, kIdentifiers);
  EXPECT_THAT(message(), ::testing::HasSubstr("while its force acts"));
  std::string slow;
  for (int i = 0; i < 20; ++i) slow += std::to_string(10 * i) + "\t0\t5\t0\t0\t0\t0\t0\t0\t0\n";
  write("loads.mot", data(slow));
  EXPECT_THROW((void)read(), ReadError) << "milliseconds";
  write("loads.xml", "<OpenSimDocument><ExternalLoads>");
  EXPECT_THAT(message(), ::testing::HasSubstr("not valid XML"));
}

TEST_F(Loads, APauseOfTheClockIsSaid) {
  write_set(body_, kIdentifiers);
  const auto pauses = [&](double later_s) {
    std::string rows;
    for (int i = 0; i < 20; ++i)
      rows += std::to_string(0.01 * i + (i < 10 ? 0.0 : later_s)) + "\t0\t5\t0\t0\t0\t0\t0\t0\t0\n";
    write("loads.mot", data(rows));
    const ExternalLoads loads = read();
    return std::count_if(loads.notes.begin(), loads.notes.end(),
                         [](const Remark& note) { return note.code == RemarkCode::clock_pause; });
  };
  EXPECT_EQ(pauses(0.0), 0);
  EXPECT_EQ(pauses(0.5), 1);
}

// Expressed in the body that it loads, force, torque and point turn with it.
TEST_F(Loads, AForceInTheBodysOwnFrameTurnsWithTheBody) {
  write("loads.mot", data("0 10 0 0 0.1 0 0 0 0 2\n1 10 0 0 0.1 0 0 0 0 2\n2 10 0 0 0.1 0 0 0 0 "
                          "2\n3 10 0 0 0.1 0 0 0 0 2\n"));
  write_set(body_, "<force_expressed_in_body>" + body_ + "</force_expressed_in_body><point_expressed_in_body>" + body_ +
                       "</point_expressed_in_body><force_identifier>f_v</force_identifier>"
                       "<point_identifier>f_p</point_identifier>"
                       "<torque_identifier>f_t</torque_identifier>");
  const ExternalLoads loads = read();
  const auto n = static_cast<Eigen::Index>(arm_.coordinates.size());
  body::BodyState state = body::make_state(arm_);
  body::compute_poses(arm_, Eigen::VectorXd::LinSpaced(n, 0.3, 1.1), state);
  std::vector<body::BodyWrench> wrenches;
  loads.append_wrenches(state, 1.3, wrenches);
  ASSERT_EQ(wrenches.size(), 1U);
  const Mat3& R = state.X_GB[static_cast<std::size_t>(wrenches[0].body)].R;
  EXPECT_LT((wrenches[0].f_G - R * Vec3(10.0, 0.0, 0.0)).norm(), 1e-12);
  // Force and lever are parallel: the torque alone is left.
  EXPECT_LT((wrenches[0].m_G - R * Vec3(0.0, 0.0, 2.0)).norm(), 1e-12);
}

// Without a point the force acts at the body's origin; without a force the torque alone acts.
TEST_F(Loads, AForceWithoutAPointAndATorqueAlone) {
  write("loads.mot", data("0 3 4 5 9 9 9 1 2 3\n1 3 4 5 9 9 9 1 2 3\n2 3 4 5 9 9 9 1 2 3\n3 3 4 5 "
                          "9 9 9 1 2 3\n"));
  body::BodyState state = body::make_state(arm_);
  body::compute_poses(arm_, arm_.default_q(), state);
  write_set(body_, "<force_identifier>f_v</force_identifier>");
  std::vector<body::BodyWrench> wrenches;
  read().append_wrenches(state, 1.0, wrenches);
  ASSERT_EQ(wrenches.size(), 1U);
  EXPECT_LT((wrenches[0].f_G - Vec3(3.0, 4.0, 5.0)).norm() + wrenches[0].m_G.norm(), 1e-12);
  write_set(body_, "<torque_identifier>f_t</torque_identifier>");
  wrenches.clear();
  read().append_wrenches(state, 1.0, wrenches);
  ASSERT_EQ(wrenches.size(), 1U);
  EXPECT_LT((wrenches[0].m_G - Vec3(1.0, 2.0, 3.0)).norm() + wrenches[0].f_G.norm(), 1e-12);
}

}  // namespace
}  // namespace myoid::body
