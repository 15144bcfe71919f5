// Force plates of every type, from the C3D file to the moment of a joint, against closed forms.
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/recording/c3d/c3d_writer.h"
#include "myoid/recording/tables/storage_reader.h"

#include "program.h"
#include "tests/support/plate_recording.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::TimeSeries;
using myoid::Vec3;
using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::PlateLoad;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::AllOf;
using testing::HasSubstr;

/// Laboratory z up to model y up.
Vec3 y_up(const Vec3& v) { return {v.x(), v.z(), -v.y()}; }

constexpr double kMass_kg = 2.0;
constexpr double kGravity = 9.81;
constexpr double kAngle_rad = 0.3;

/// A rod that hangs from the ground's origin on a pin about z, with a muscle on either side.
const std::string kRod =
    "<OpenSimDocument Version=\"40000\"><Model name=\"rod\"><gravity>0 -9.81 0</gravity><BodySet>"
    "<objects><Body name=\"rod\"><mass>2</mass><mass_center>0 -1 0</mass_center><inertia>1 1 1 0 0 "
    "0</inertia></Body></objects></BodySet><JointSet><objects><PinJoint name=\"j\">"
    "<socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/rod"
    "</socket_child_frame><coordinates><Coordinate name=\"q\"><range>-1.5 1.5</range></Coordinate>"
    "</coordinates></PinJoint></objects></JointSet><ForceSet><objects>" +
    [] {
      std::string muscles;
      for (const auto& [name, x] : {std::pair("FLX", "0.05"), std::pair("EXT", "-0.05")}) {
        muscles += std::string("<Thelen2003Muscle name=\"") + name +
                   "\"><max_isometric_force>8000</max_isometric_force><optimal_fiber_length>0.3"
                   "</optimal_fiber_length><tendon_slack_length>0.2</tendon_slack_length>"
                   "<GeometryPath><PathPointSet><objects><PathPoint name=\"o\">"
                   "<socket_parent_frame>/ground</socket_parent_frame><location>" +
                   x +
                   " 0.2 0</location></PathPoint><PathPoint name=\"i\"><socket_parent_frame>"
                   "/bodyset/rod</socket_parent_frame><location>" +
                   x +
                   " -0.3 0</location></PathPoint></objects></PathPointSet></GeometryPath>"
                   "</Thelen2003Muscle>";
      }
      return muscles;
    }() +
    "</objects></ForceSet></Model></OpenSimDocument>";

/// The rod held still.
std::string still_motion() {
  std::string text = "Coordinates\nversion=1\nnRows=101\nnColumns=2\ninDegrees=no\nendheader\ntime\tq\n";
  for (int k = 0; k <= 100; ++k) text += std::to_string(0.01 * k) + "\t" + std::to_string(kAngle_rad) + "\n";
  return text;
}

/// What the pin must give: it holds the weight, which pulls the rod down, against the plate's load.
double moment_nm(double t) {
  const Vec3 moment =
      y_up(PlateLoad::point_m(t)).cross(y_up(PlateLoad::force_n(t))) + y_up(Vec3(0, 0, PlateLoad::free_nm(t)));
  return kMass_kg * kGravity * std::sin(kAngle_rad) - moment.z();
}

class PlatesOfType : public testing::TestWithParam<int> {};

TEST_P(PlatesOfType, ConvertedTheyLoadTheJointAsTheClosedFormSays) {
  const TemporaryFolder folder;
  const auto at = [&](const char* name) { return (folder / name).string(); };
  ::myoid::recording::write_c3d(at("f.c3d"), ::myoid::test::plate_recording(GetParam()));
  write_text(at("rod.osim"), kRod);
  write_text(at("q.mot"), still_motion());
  const Finished made = myoid({"convert", at("f.c3d"), at("out"), "--body", "rod"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("up is z"));
  const Finished again = myoid({"convert", at("f.c3d"), at("out"), "--body", "rod", "--overwrite"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  const TimeSeries load = ::myoid::recording::read_storage(at("out/f_grf.mot")).data;
  ASSERT_EQ(load.sample_count(), 1010);
  for (Eigen::Index i = 0; i < load.sample_count(); i += 101) {
    const double t = load.time_s()[i];
    const auto vector = [&](const std::string& name) {
      return Vec3(load.column(name + "x")[i], load.column(name + "y")[i], load.column(name + "z")[i]);
    };
    // Channels are reals of 24 bits: 1e-7 of 700 N, and of 300 000 N mm over 540 N.
    EXPECT_LT((vector("ground_force_1_v") - y_up(PlateLoad::force_n(t))).norm(), 3e-4);
    EXPECT_LT((vector("ground_force_1_p") - y_up(PlateLoad::point_m(t))).norm(), 1e-6);
    EXPECT_LT((vector("ground_torque_1_") - y_up(Vec3(0, 0, PlateLoad::free_nm(t)))).norm(), 3e-4);
  }
  const Finished solved = myoid({"id", "--model", at("rod.osim"), "--motion", at("q.mot"), "--loads",
                                 at("out/f_grf.xml"), "--out", at("id.sto")});
  ASSERT_EQ(solved.exit_code, 0) << solved.err;
  const TimeSeries torque = ::myoid::recording::read_storage(at("id.sto")).data;
  ASSERT_EQ(torque.sample_count(), 101);
  // Up to 750 N m; times are written to the microsecond, the load changes by 400 N m in a second.
  for (Eigen::Index i = 0; i < torque.sample_count(); ++i)
    EXPECT_NEAR(torque.column("q_moment")[i], moment_nm(torque.time_s()[i]), 2e-3);
}

TEST_P(PlatesOfType, InAStudyTheyGiveTheSameMoment) {
  const TemporaryFolder folder;
  const auto at = [&](const char* name) { return (folder / name).string(); };
  ::myoid::recording::write_c3d(at("f.c3d"), ::myoid::test::plate_recording(GetParam()));
  write_text(at("rod.osim"), kRod);
  write_text(at("q.mot"), still_motion());
  std::string emg = "time,FLX [mV],EXT [mV]\n";
  for (int i = 0; i <= 1000; ++i) {
    const double t = 0.001 * i;
    const double burst = std::sin(500.0 * t) * (1.0 + std::sin(6.0 * t));
    emg += std::to_string(t) + "," + std::to_string(0.2 * burst) + "," +
           std::to_string(0.1 * std::cos(700.0 * t) * (1.2 + std::cos(5.0 * t))) + "\n";
  }
  write_text(at("emg.csv"), emg);
  write_text(at("study.toml"),
             "[subject]\nname = \"P\"\n[model]\nfile = \"rod.osim\"\ncoordinate = \"q\"\n"
             "[motion]\ncutoff_hz = 6\n"
             "[[muscle]]\nname = \"FLX\"\nemg = \"FLX\"\n[[muscle]]\nname = \"EXT\"\nemg = \"EXT\"\n"
             "[[trial]]\nname = \"hold\"\nmotion = \"q.mot\"\nemg = \"emg.csv\"\n"
             "force_plates = { file = \"f.c3d\", bodies = [\"rod\"], lowpass_hz = 200 }\n");
  const Finished ran = myoid({"run", at("study.toml"), "--out", at("results")});
  ASSERT_TRUE(ran.exit_code == 0 || ran.exit_code == 4) << ran.exit_code << ran.err << ran.out;
  const TimeSeries torque = ::myoid::recording::read_storage(at("results/hold/id.sto")).data;
  ASSERT_GT(torque.sample_count(), 50);
  // A filter of 200 Hz takes 1e-3 of 4 rad/s and rings at the ends, which are left out.
  for (Eigen::Index i = 0; i < torque.sample_count(); ++i) {
    const double t = torque.time_s()[i];
    if (t < 0.1 || t > 0.9) continue;
    EXPECT_NEAR(torque.column("q_moment")[i], moment_nm(t), 0.3) << t;
  }
}

TEST(ForcePlates, ConvertCheckAndRunRefuseTheSameContradictionAndTakeWhatIsTold) {
  const TemporaryFolder folder;
  const auto at = [&](const char* name) { return (folder / name).string(); };
  ::myoid::test::PlateCase contradicts;
  contradicts.screen = "+Y";
  ::myoid::recording::write_c3d(at("f.c3d"), ::myoid::test::plate_recording(contradicts));
  const auto why = AllOf(HasSubstr("f.c3d"), HasSubstr("POINT:Y_SCREEN says that y points up"),
                         HasSubstr("the surface of plate 1 faces z"));
  const Finished converted = myoid({"convert", at("f.c3d"), at("f.mot")});
  EXPECT_EQ(converted.exit_code, 3);
  EXPECT_THAT(converted.err, why);
  const Finished checked = myoid({"check", at("f.c3d")});
  EXPECT_EQ(checked.exit_code, 3);
  EXPECT_THAT(checked.out, why);
  EXPECT_EQ(myoid({"convert", at("f.c3d"), at("f.mot"), "--up", "z"}).exit_code, 0);
  const Finished told = myoid({"check", at("f.c3d"), "--up", "z"});
  EXPECT_EQ(told.exit_code, 0) << told.out;
}

INSTANTIATE_TEST_SUITE_P(OfEveryType, PlatesOfType, testing::Values(1, 2, 3, 4));

}  // namespace
