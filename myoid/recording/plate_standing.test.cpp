#include "myoid/recording/plate_standing.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/recording/c3d/c3d_writer.h"
#include "myoid/recording/ground_reaction.h"
#include "myoid/recording/laboratory_up.h"

#include "tests/support/data_folder.h"
#include "tests/support/message_of.h"
#include "tests/support/plate_from_disk.h"
#include "tests/support/plate_recording.h"
#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

using test::from_disk;
using test::notes_of;
using test::PlateCase;
using test::PlateLoad;
using testing::AllOf;
using testing::HasSubstr;

/// The columns of the ground reaction against the load, turned from z up to y up by R_YZ.
void expect_the_load(const TimeSeries& grf, const Mat3& R_YZ) {
  for (Eigen::Index i = 0; i < grf.sample_count(); i += 37) {
    const double t = grf.time_s()[i];
    const Vec3 force = grf.values().block<1, 3>(i, 0).transpose();
    const Vec3 point = grf.values().block<1, 3>(i, 3).transpose();
    const Vec3 torque = grf.values().block<1, 3>(i, 6).transpose();
    ASSERT_GT(force.y(), 500.0);
    // Channels are reals of 24 bits: 4e-5 of 700 N; 0.015 N mm of 300 000 over 540 N.
    ASSERT_LT((force - R_YZ * PlateLoad::force_n(t)).norm(), 1e-4) << t;
    ASSERT_LT((point - R_YZ * PlateLoad::point_m(t)).norm(), 1e-6) << t;
    ASSERT_LT((torque - R_YZ * Vec3(0, 0, PlateLoad::free_nm(t))).norm(), 3e-4) << t;
  }
}

std::string words(const PlateCase& c, char up) {
  return "type " + std::to_string(c.type) + ", up " + up + ", first corner " + std::to_string(c.first_corner) +
         (c.reversed ? ", reversed" : "") + (c.on_plate ? ", on the plate" : "") + ", screen '" + c.screen + "'";
}

TEST(StandPlates, GiveTheForceOnThePersonInEveryLaboratoryTypeAndOrderOfCorners) {
  int cases = 0;
  for (const char up : {'x', 'y', 'z'}) {
    for (int variant = 0; variant < 4 * 4 * 2 * 2 * 2; ++variant) {
      PlateCase c;
      c.type = 1 + variant % 4;
      c.first_corner = variant / 4 % 4;
      c.reversed = variant / 16 % 2 == 1;
      c.on_plate = variant / 32 % 2 == 1;
      c.screen = variant / 64 % 2 == 1 ? std::string("+") + static_cast<char>(up - 32) : "";
      c.R_LZ = test::laboratory_with_up(up);
      Recording recording = from_disk(c);
      const LaboratoryUp found = stand_plates(recording, std::nullopt);
      ASSERT_TRUE(found.up_L) << words(c, up);
      ASSERT_EQ(axis_name(*found.up_L), std::string(1, up)) << words(c, up);
      const Mat3 R_YL = rotation_to_y_up(*found.up_L);
      std::vector<Repair> notes;
      const TimeSeries grf = ground_reaction(recording.force_plates(), {.R_YG = R_YL}, notes);
      expect_the_load(grf, R_YL * c.R_LZ);
      if (testing::Test::HasFatalFailure()) FAIL() << words(c, up);
      ++cases;
    }
  }
  EXPECT_EQ(cases, 384);
}

TEST(StandPlates, AnUpThatPointsAgainstAnAxisComesFromTheScreenOrTheMarkers) {
  PlateCase c;
  c.R_LZ.diagonal() << 1, -1, -1;  // z of the file points down
  c.marker_Z_m = {0.4, 1.2, 1.0};
  c.markers = 8;
  for (const char* screen : {"-Z", ""}) {
    c.screen = screen;
    Recording recording = from_disk(c);
    const LaboratoryUp found = stand_plates(recording, std::nullopt);
    ASSERT_EQ(axis_name(*found.up_L), "-z") << screen;
    std::vector<Repair> notes;
    const Mat3 R_YL = rotation_to_y_up(*found.up_L);
    expect_the_load(ground_reaction(recording.force_plates(), {.R_YG = R_YL}, notes), R_YL * c.R_LZ);
  }
}

/// Qualisys writes X_SCREEN = -X and Y_SCREEN = -Z where z points up.
TEST(StandPlates, TheSignOfTheScreenYieldsToMarkersCornersAndLoad) {
  int cases = 0;
  for (const char up : {'x', 'y', 'z'}) {
    for (int variant = 0; variant < 4 * 4 * 3 * 2; ++variant) {
      PlateCase c;
      c.type = 1 + variant % 4;
      c.markers = std::array{1, 4, 7, 9}.at(static_cast<std::size_t>(variant / 4 % 4));
      c.reversed = variant / 16 % 3 == 1;
      c.on_plate = variant / 16 % 3 == 2;
      c.loaded = variant / 48 == 0;
      if (!c.loaded && c.on_plate) continue;
      c.marker_Z_m = {0.4, 1.2, 1.0};
      c.R_LZ = test::laboratory_with_up(up);
      const std::string axis(1, static_cast<char>(up - 32));
      c.screen = "+" + axis;
      Recording said = from_disk(c);
      c.screen = "-" + axis;
      Recording screen = from_disk(c);
      const LaboratoryUp honest = stand_plates(said, std::nullopt);
      const LaboratoryUp found = stand_plates(screen, std::nullopt);
      ASSERT_EQ(axis_name(*honest.up_L), std::string(1, up)) << words(c, up);
      ASSERT_EQ(axis_name(*found.up_L), std::string(1, up)) << words(c, up) << ", " << c.markers << " markers";
      EXPECT_EQ(notes_of(screen), notes_of(said)) << words(c, up);
      EXPECT_EQ(screen.force_plate(screen.plates[0]).force_n, said.force_plate(said.plates[0]).force_n);
      ++cases;
    }
  }
  EXPECT_EQ(cases, 240);
}

TEST(StandPlates, AFileThatConformsToTheGuideHeadDownIsTakenSoOnlyIfAllSaySo) {
  PlateCase c;
  c.R_LZ.diagonal() << 1, -1, -1;  // z of the file points down
  const auto up = [&] {
    Recording recording = from_disk(c);
    return axis_name(*stand_plates(recording, std::nullopt).up_L);
  };
  c.screen = "-Z";
  EXPECT_EQ(up(), "-z");  // screen, corners, load, and origin
  c.screen = "+Z";
  EXPECT_EQ(up(), "z");
  c.screen = "";
  EXPECT_EQ(up(), "z");
  c.markers = 5;
  c.marker_Z_m = {0.4, 1.2, 1.0};
  EXPECT_EQ(up(), "-z");  // and markers
}

TEST(StandPlates, WithoutPlatesTheScreenNamesTheAxisAndTheMarkersItsSign) {
  const auto up = [](const char* screen, int markers, double height_m) {
    PlateCase c;
    c.screen = screen;
    c.markers = markers;
    c.marker_Z_m = {0.1, 0.2, height_m};
    C3dFile file = test::plate_recording(c);
    file.groups.erase(file.groups.begin());
    Recording recording = from_disk(file);
    const LaboratoryUp found = stand_plates(recording, std::nullopt);
    return found.up_L ? axis_name(*found.up_L) : std::string("none");
  };
  for (const int markers : {1, 4, 12}) {
    EXPECT_EQ(up("-Z", markers, 1.0), "z") << markers;
    EXPECT_EQ(up("+Z", markers, 1.0), "z") << markers;
    EXPECT_EQ(up("", markers, 1.0), "none") << markers;
    EXPECT_EQ(up("+Z", markers, -1.0), "z") << markers;  // an origin above the person
  }
  EXPECT_EQ(up("-Y", 12, 1.0), "y");
  EXPECT_EQ(up("-Z", 12, -1.0), "-z");
}

TEST(StandPlates, OnStairsTheLowestStepIsTheFloor) {
  // The second plate is a step 0.7 m above the first, in front of a person of 8 markers from 0.4 m on.
  PlateCase c;
  c.screen = "-Z";
  c.markers = 8;
  c.marker_Z_m = {0.4, 1.2, 0.4};
  C3dFile file = test::plate_recording(c);
  auto& p = file.groups[0].parameters;
  const std::vector<double> low = p[2].numbers;
  std::vector<double> corners = low;
  for (std::size_t k = 2; k < 12; k += 3) corners[k] += 700.0;
  corners.insert(corners.end(), low.begin(), low.end());
  std::vector<double> origin = p[3].numbers;
  origin.insert(origin.end(), p[3].numbers.begin(), p[3].numbers.end());
  p = {test::c3d_numbers("USED", C3dType::integer, {}, {2}), test::c3d_numbers("TYPE", C3dType::integer, {2}, {2, 2}),
       test::c3d_numbers("CORNERS", C3dType::real, {3, 4, 2}, corners),
       test::c3d_numbers("ORIGIN", C3dType::real, {3, 2}, origin),
       test::c3d_numbers("CHANNEL", C3dType::integer, {6, 2}, {1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5, 6})};
  Recording recording = from_disk(file);
  EXPECT_EQ(axis_name(*stand_plates(recording, std::nullopt).up_L), "z");
}

TEST(StandPlates, OneLaboratoryIsTheSameWithTheScreensOfQualisysAndVicon) {
  const auto folder = test::data_folder() / "round3" / "recordings";
  MYOID_REQUIRE_DATA(folder);
  for (const char* markers : {"0", "7", "9"}) {
    Recording q = read_recording(folder / (std::string("scr_q_") + markers + ".c3d"));
    Recording v = read_recording(folder / (std::string("scr_v_") + markers + ".c3d"));
    EXPECT_EQ(axis_name(*stand_plates(q, std::nullopt).up_L), "z");
    EXPECT_EQ(axis_name(*stand_plates(v, std::nullopt).up_L), "z");
    EXPECT_EQ(notes_of(q), notes_of(v)) << markers;
    EXPECT_EQ(q.force_plate(q.plates[0]).force_n, v.force_plate(v.plates[0]).force_n);
    EXPECT_EQ(q.force_plate(q.plates[0]).moment_nm, v.force_plate(v.plates[0]).moment_nm);
  }
}

TEST(StandPlates, RefusesAFileThatContradictsItselfAndNamesBoth) {
  const auto refusal = [](const PlateCase& c) {
    Recording recording = from_disk(c);
    return test::message_of([&] { stand_plates(recording, std::nullopt); });
  };
  PlateCase other_screen;
  other_screen.screen = "+Y";
  EXPECT_THAT(refusal(other_screen), AllOf(HasSubstr("POINT:Y_SCREEN"), HasSubstr("FORCE_PLATFORM:CORNERS"),
                                           HasSubstr("plate 1 faces z"), HasSubstr("--up")));
  for (const char* screen : {"+Z", ""}) {
    PlateCase exchanged;
    exchanged.screen = screen;
    exchanged.channel_order = {3, 2, 1};
    EXPECT_THAT(refusal(exchanged),
                AllOf(HasSubstr("plate 1 faces z"), HasSubstr("mean force"), HasSubstr("from the normal")))
        << screen;
  }
}

TEST(StandPlates, WhatIsToldOverridesTheFile) {
  PlateCase c;
  c.screen = "+Y";
  Recording recording = from_disk(c);
  const LaboratoryUp found = stand_plates(recording, Vec3::UnitZ().eval());
  EXPECT_EQ(axis_name(*found.up_L), "z");
  std::vector<Repair> notes;
  const Mat3 R_YL = rotation_to_y_up(*found.up_L);
  expect_the_load(ground_reaction(recording.force_plates(), {.R_YG = R_YL}, notes), R_YL);
  c.screen = "+Z";
  Recording another = from_disk(c);
  stand_plates(another, Vec3::UnitY().eval());
  EXPECT_THAT(notes_of(another), HasSubstr("as y, as told"));
}

TEST(StandPlates, AFloorInclinedBy25DegreesIsStillAFloor) {
  PlateCase c;
  c.R_LZ = Eigen::AngleAxisd(25.0 * kDegree, Vec3(1.0, 0.3, 0.0).normalized()).toRotationMatrix();
  Recording recording = from_disk(c);
  const LaboratoryUp found = stand_plates(recording, std::nullopt);
  EXPECT_EQ(axis_name(*found.up_L), "z");
  const ForcePlate plate = recording.force_plate(recording.plates[0]);
  EXPECT_TRUE(plate.side.is_floor);
  for (Eigen::Index i = 0; i < 1010; i += 101)
    EXPECT_LT((plate.force_n.row(i).transpose() - c.R_LZ * PlateLoad::force_n(0.001 * static_cast<double>(i))).norm(),
              1e-4);
}

TEST(StandPlates, APlateThatIsNeverLoadedSaysUpByItsCornersAndGivesNothing) {
  PlateCase c;
  c.R_LZ = test::laboratory_with_up('y');
  c.loaded = false;
  Recording recording = from_disk(c);
  EXPECT_EQ(axis_name(*stand_plates(recording, std::nullopt).up_L), "y");
  std::vector<Repair> notes;
  const TimeSeries grf = ground_reaction(recording.force_plates(), {}, notes);
  EXPECT_EQ(grf.values().leftCols(3).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_THAT(notes[0].message, HasSubstr("never loaded"));
}

/// A floor under `PlateLoad` and beside it a second plate, of type 2, with its own frame and force
/// on the person in the laboratory of `PlateLoad`.
Recording floor_and(const Mat3& R_LP, const Vec3& middle_m, const Vec3& force_n, bool on_plate) {
  PlateCase c;
  c.on_plate = on_plate;
  C3dFile file = test::plate_recording(c);
  const Eigen::Index n = file.analog.rows();
  file.analog.conservativeResize(n, 12);
  const Vec3 f = (on_plate ? -1.0 : 1.0) * (R_LP.transpose() * force_n);
  for (Eigen::Index i = 0; i < n; ++i) {
    file.analog.row(i).tail<6>().setZero();
    if (i >= 300 && i < 700) file.analog.block<1, 3>(i, 6) = f.cast<float>().transpose();
  }
  for (const char* name : {"Fx2", "Fy2", "Fz2"}) file.channels.push_back({name, "N"});
  for (const char* name : {"Mx2", "My2", "Mz2"}) file.channels.push_back({name, "Nmm"});
  std::vector<double> corners = file.groups[0].parameters[2].numbers;
  for (const auto& [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
    const Vec3 corner = middle_m + R_LP * Vec3(0.3 * x, 0.2 * y, 0.0);
    for (const double v : corner) corners.push_back(1000.0 * v);
  }
  std::vector<double> origin = file.groups[0].parameters[3].numbers;
  origin.insert(origin.end(), {0, 0, 0});
  file.groups[0].parameters = {
      test::c3d_numbers("USED", C3dType::integer, {}, {2}), test::c3d_numbers("TYPE", C3dType::integer, {2}, {2, 2}),
      test::c3d_numbers("CORNERS", C3dType::real, {3, 4, 2}, corners),
      test::c3d_numbers("ORIGIN", C3dType::real, {3, 2}, origin),
      test::c3d_numbers("CHANNEL", C3dType::integer, {6, 2}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12})};
  return from_disk(file);
}

TEST(StandPlates, APlateThatNeverChangesTellsNothing) {
  C3dFile file = test::plate_recording(2);
  file.analog.rowwise() = Eigen::RowVectorXf(file.analog.row(file.analog.rows() / 2));
  Recording recording = from_disk(file);
  ASSERT_EQ(recording.plates.size(), 1U);
  (void)stand_plates(recording, std::nullopt);
  EXPECT_EQ(recording.force_plates()[0].force_n.norm(), 0.0);
  EXPECT_THAT(notes_of(recording), HasSubstr("unplugged"));
  EXPECT_THAT(notes_of(recording), testing::Not(HasSubstr("turned round")));
}

TEST(StandPlates, AWallHasTheSignOfTheFloorWhetherItPushesOrPulls) {
  // z of the wall points along x, away from a person who is on its side of -x.
  const Mat3 R_LP = (Mat3() << 0, 0, 1, 0, 1, 0, -1, 0, 0).finished();
  for (const bool on_plate : {false, true}) {
    for (const Vec3& force : {Vec3(-120, 10, 30), Vec3(120, 10, 30), Vec3(4, 90, 0)}) {
      Recording recording = floor_and(R_LP, {1.0, 1.2, 1.0}, force, on_plate);
      EXPECT_EQ(axis_name(*stand_plates(recording, std::nullopt).up_L), "z");
      std::vector<Repair> notes;
      const TimeSeries grf = ground_reaction(recording.force_plates(), {}, notes);
      EXPECT_LT((grf.values().block<1, 3>(500, 9).transpose() - force).norm(), 1e-4);
      // Without a moment about the middle, the force acts there, whatever its direction.
      EXPECT_LT((grf.values().block<1, 3>(500, 12).transpose() - Vec3(1.0, 1.2, 1.0)).norm(), 1e-6);
      EXPECT_EQ(grf.values().block(100, 9, 1, 3).norm(), 0.0);
      EXPECT_THAT(notes_of(recording), HasSubstr("force plate 2 is a wall"));
    }
  }
}

TEST(StandPlates, TwoLoadedPlatesThatFaceDifferentAxesAreRefusedWithoutAScreen) {
  const Mat3 R_LP = (Mat3() << 0, 0, 1, 0, 1, 0, -1, 0, 0).finished();
  Recording recording = floor_and(R_LP, {1.0, 1.2, 1.0}, {-900, 10, 30}, false);
  EXPECT_THAT(test::message_of([&] { stand_plates(recording, std::nullopt); }),
              AllOf(HasSubstr("plate 1 faces z"), HasSubstr("plate 2 faces x")));
}

TEST(ScreenUp, ReadsTheWaysItIsWritten) {
  const auto up = [](const char* name, const char* text, const char* right = "") {
    C3dFile file;
    file.groups = {{.id = 1, .name = "POINT"}};
    file.groups[0].parameters = {test::c3d_text(name, text), test::c3d_text("X_SCREEN", right)};
    const auto found = screen_up(file);
    return found ? axis_name(*found) : std::string("none");
  };
  EXPECT_EQ(up("Y_SCREEN", "+Z"), "z");
  EXPECT_EQ(up("Y_SCREEN", "Y   "), "y");
  EXPECT_EQ(up("Y_SCREEN", "z-"), "-z");
  EXPECT_EQ(up("Y_SCREEN", "-X", "+Y"), "-x");
  EXPECT_EQ(up("Y_SCREEN", "+Z", "-Z"), "none");
  EXPECT_EQ(up("Y_SCREEN", "up"), "none");
  EXPECT_EQ(up("SCREEN", "+X+Z"), "z");
  EXPECT_EQ(up("SCREEN", "+X"), "none");
}

TEST(RotationToYUp, BringsEitherDirectionOfEachAxisToY) {
  for (const char* name : {"x", "y", "z", "-x", "-y", "-z"}) {
    const Mat3 R = rotation_to_y_up(*axis_vector(name));
    EXPECT_EQ(R * *axis_vector(name), Vec3::UnitY()) << name;
    EXPECT_EQ(R * R.transpose(), Mat3::Identity()) << name;
    EXPECT_EQ(R.determinant(), 1.0) << name;
  }
}

TEST(StandPlates, OfPublicRecordingsPushThePersonUpWithTheWeightOfAPerson) {
  const auto folder = test::data_folder() / "c3d";
  MYOID_REQUIRE_DATA(folder);
  for (const char* name : {"sample01/Eb015pi.c3d", "sample01/Eb015vr.c3d", "sample09/PlugInC3D.c3d",
                           "others/FunctionalWalk.c3d", "others/Gait.c3d", "others/parameterOverflow.c3d"}) {
    Recording recording = read_recording(folder / name);
    const LaboratoryUp up = stand_plates(recording, std::nullopt);
    ASSERT_TRUE(up.up_L) << name;
    EXPECT_EQ(axis_name(*up.up_L), "z") << name;
    for (const ForcePlate& plate : recording.force_plates()) {
      if (plate.force_n.isZero(0.0)) {  // 1448 N in every sample
        EXPECT_EQ(std::string(name) + std::to_string(plate.number), "others/parameterOverflow.c3d3");
        continue;
      }
      const Eigen::VectorXd vertical = plate.force_n.col(2);
      EXPECT_TRUE(plate.side.is_floor) << name;
      EXPECT_GT(vertical.maxCoeff(), -3.0 * vertical.minCoeff()) << name << plate.number;
    }
  }
}

}  // namespace
}  // namespace myoid::recording
