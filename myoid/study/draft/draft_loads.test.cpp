#include "myoid/study/draft/draft_loads.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/units.h"

namespace myoid::study {
namespace {

using ::testing::HasSubstr;

double kg_of(const std::string& name) {
  const auto mass = mass_in_name(name);
  return mass ? mass->kg() : -1.0;
}

TEST(MassInName, IsANumberWithAUnitOrBehindAWordForALoad) {
  EXPECT_EQ(kg_of("flex_2.5kg"), 2.5);
  EXPECT_EQ(kg_of("flex 2p5 kg slow"), 2.5);
  EXPECT_EQ(kg_of("load5p5_t1"), 5.5);
  EXPECT_EQ(kg_of("weight_3"), 3.0);
  EXPECT_EQ(kg_of("load0"), 0.0);
  EXPECT_EQ(kg_of("5lb_slow"), 2.268);  // 5 x 0.45359237
  EXPECT_EQ(mass_in_name("load5p5")->unit, "");
  for (const char* name : {"walk36", "flex_0.5hz", "sub-01_t2", "kg", "slow", "", "5kgm", "1000kg"})
    EXPECT_EQ(kg_of(name), -1.0) << name;
  EXPECT_EQ(kg_of(std::string(200000, '1')), -1.0);
}

/// A wrist that the model knows, and a box that moves to and fro on its own; "loose" changes its place on the box.
MarkerSeries with_a_box(const std::string& known) {
  MarkerSeries markers;
  const Eigen::Index frames = 100;
  markers.time_s = Eigen::VectorXd::LinSpaced(frames, 0.0, 0.99);
  markers.names = {known, "box 1", "box 2", "box 3", "loose"};
  markers.positions_m.resize(frames, 15);
  for (Eigen::Index i = 0; i < frames; ++i) {
    const double shift = 0.3 * std::sin(0.1 * static_cast<double>(i));
    const double turn = 0.5 * std::sin(0.07 * static_cast<double>(i));
    const Mat3 R = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
    const Vec3 at(shift, 0.2, 0.0);
    markers.positions_m.block<1, 3>(i, 0) = Vec3(0.0, 1.0, 0.0).transpose();
    const std::array<Vec3, 3> box{Vec3(0.0, 0.0, 0.0), Vec3(0.2, 0.0, 0.0), Vec3(0.0, 0.3, 0.1)};
    for (Eigen::Index k = 0; k < 3; ++k)
      markers.positions_m.block<1, 3>(i, 3 + 3 * k) = (at + R * box[static_cast<std::size_t>(k)]).transpose();
    markers.positions_m.block<1, 3>(i, 12) = (at + R * Vec3(0.1 + 0.5 * shift, 0.1, 0.0)).transpose();
  }
  return markers;
}

TEST(ObjectMarkers, AreRigidAmongThemselvesAndNotOfTheModel) {
  const body::BodyModel model = body::parse_osim(body::arm4_osim(), "arm4.osim");
  EXPECT_EQ(object_markers(with_a_box(model.markers[0].name), model),
            (std::vector<std::string>{"box 1", "box 2", "box 3"}));
  // A cluster on the person keeps its distance from a marker of the model.
  MarkerSeries worn = with_a_box(model.markers[0].name);
  for (Eigen::Index i = 0; i < worn.frame_count(); ++i)
    worn.positions_m.block<1, 3>(i, 0) = worn.positions_m.block<1, 3>(i, 3) + Vec3(0.05, 0.0, 0.0).transpose();
  EXPECT_TRUE(object_markers(worn, model).empty());
  EXPECT_TRUE(object_markers(with_a_box("unknown"), model).empty());
}

TEST(ObjectMarkers, TheAxesOfASegmentThatAGaitModelWritesAreNone) {
  const body::BodyModel model = body::parse_osim(body::arm4_osim(), "arm4.osim");
  MarkerSeries axes = with_a_box(model.markers[0].name);
  axes.names = {model.markers[0].name, "RTIO", "RTIA", "RTIL", "RTIP"};
  EXPECT_TRUE(object_markers(axes, model).empty());
  axes.names.back() = "loose";
  EXPECT_EQ(object_markers(axes, model).size(), 3U);
}

TEST(LoadChannels, AreForcesAndVoltagesBesideEmgThatNoPlateHas) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(50, 0.0, 1.0);
  Eigen::MatrixXd values(50, 6);
  for (Eigen::Index c = 0; c < 6; ++c) values.col(c) = t;
  values.col(5).setConstant(0.1);
  const TimeSeries analog(t,
                          {{"BIC.EMG1", Unit::volt},
                           {"Voltage.1", Unit::volt},
                           {"Fz1", Unit::newton},
                           {"Acc X", Unit::volt},
                           {"handle", Unit::dimensionless},
                           {"Voltage.2", Unit::volt}},
                          values);
  EXPECT_EQ(load_channels(analog, {}), (std::vector<std::string>{"Voltage.1", "Fz1", "handle"}));
  recording::PlateSetup plate;
  plate.channels = {2};
  EXPECT_EQ(load_channels(analog, {plate}), (std::vector<std::string>{"Voltage.1", "handle"}));
  // Without a channel that is named so, any voltage may be EMG.
  EXPECT_TRUE(load_channels(analog.select({"Voltage.1"}), {}).empty());
}

TEST(AskForLoads, AsksOnceAndPrefillsWhatTheNameTells) {
  DraftText out;
  bool asked = false;
  ask_for_loads("slow", {}, true, asked, out);
  ask_for_loads("fast", {}, true, asked, out);
  EXPECT_EQ(out.questions.size(), 1U);
  ask_for_loads("load5p5_t1", {.object_markers = {"box 1", "box 2", "box 3"}, .channels = {"Voltage.1"}}, true, asked,
                out);
  EXPECT_EQ(out.questions.size(), 4U);
  EXPECT_THAT(out.toml, HasSubstr("# held_mass_kg = 0.0\n# held_mass_kg = 0.0\n"));
  EXPECT_THAT(out.toml, HasSubstr("# held_mass_kg = 5.5\n"));
}

TEST(AskForLoads, ATorqueIsOfADynamometerAndNotOfALoadCell) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(50, 0.0, 1.0);
  Eigen::MatrixXd values(50, 2);
  values << t, t;
  const TimeSeries analog(t, {{"Fz", Unit::newton}, {"Torque", Unit::newton_meter}}, values);
  EXPECT_TRUE(only_torques(analog, {"Torque"}));
  EXPECT_FALSE(only_torques(analog, {"Torque", "Fz"}));
  EXPECT_FALSE(only_torques(analog, {}));
  DraftText out;
  bool asked = true;
  ask_for_loads("ramp", {.channels = {"Torque"}, .only_torques = true}, false, asked, out);
  EXPECT_THAT(out.toml, HasSubstr("Torque is of no force plate, in N m: a dynamometer? Then external_torque"));
  ask_for_loads("lift", {.channels = {"Torque", "Fz"}}, false, asked, out);
  EXPECT_THAT(out.toml, HasSubstr("Torque, Fz are of no force plate: a load cell?"));
}

}  // namespace
}  // namespace myoid::study
