#include "myoid/recording/plate_unit.h"

#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/recording/c3d/c3d_writer.h"
#include "myoid/recording/plate_standing.h"

#include "tests/support/plate_recording.h"
#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

using testing::HasSubstr;

ForcePlate plate_of(const C3dFile& file, std::string& notes) {
  const test::TemporaryFolder folder;
  write_c3d(folder / "plate.c3d", file);
  Recording recording = read_recording(folder / "plate.c3d");
  (void)stand_plates(recording, std::nullopt);
  for (const Repair& repair : recording.repairs) notes += repair.message + "\n";
  return recording.force_plate(recording.plates.at(0));
}

/// The center of pressure and the free moment of `PlateLoad`.
void expect_the_load(const ForcePlate& plate, const std::string& about) {
  for (Eigen::Index i = 0; i < 1010; i += 101) {
    const double t = 0.001 * static_cast<double>(i);
    EXPECT_LT((plate.pressure_center_m.row(i).transpose() - test::PlateLoad::point_m(t)).norm(), 1e-6) << about;
    EXPECT_NEAR(plate.free_moment_nm(i, 2), test::PlateLoad::free_nm(t), 3e-4) << about;
  }
}

C3dParameter& parameter(C3dFile& file, const std::string& name) {
  for (C3dParameter& p : file.groups[0].parameters)
    if (p.name == name) return p;
  throw std::out_of_range(name);
}

TEST(PlateUnit, MomentsThatPutTheForce45MetersAwayAreInNewtonMillimeters) {
  C3dFile file = test::plate_recording(2);
  for (std::size_t c = 3; c < 6; ++c) file.channels[c].unit_text = "Nm";
  std::string notes;
  expect_the_load(plate_of(file, notes), "Nm");
  EXPECT_THAT(notes, HasSubstr("in N mm"));

  C3dFile point = test::plate_recording(1);
  for (std::size_t c = 3; c < 5; ++c) point.channels[c].unit_text = "m";
  notes.clear();
  expect_the_load(plate_of(point, notes), "m");
  EXPECT_THAT(notes, HasSubstr("in mm"));

  C3dFile twist = test::plate_recording(2);  // the moment about the normal alone
  twist.channels[5].unit_text = "Nm";
  notes.clear();
  expect_the_load(plate_of(twist, notes), "Mz");
  EXPECT_THAT(notes, HasSubstr("normal exceeds"));
}

TEST(PlateUnit, MomentsThatKeepTheForceWithinATenthOfAMillimeterAreInNewtonMeters) {
  C3dFile file = test::plate_recording(2);
  file.analog.rightCols<3>() *= 1e-3F;
  std::string notes;
  expect_the_load(plate_of(file, notes), "Nmm");
  EXPECT_THAT(notes, HasSubstr("in N m\n"));

  C3dFile matrix = test::plate_recording(4);  // a matrix that gives N m
  C3dParameter& calibration = parameter(matrix, "CAL_MATRIX");
  for (std::size_t i = 0; i < 36; ++i)
    if (i % 6 >= 3) calibration.numbers[i] *= 1e-3;
  notes.clear();
  const ForcePlate plate = plate_of(matrix, notes);
  EXPECT_THAT(notes, HasSubstr("in N m\n"));
  for (Eigen::Index i = 0; i < 1010; i += 101)
    EXPECT_LT(
        (plate.pressure_center_m.row(i).transpose() - test::PlateLoad::point_m(0.001 * static_cast<double>(i))).norm(),
        1e-5);
}

TEST(PlateUnit, LengthsOfTheParametersInAnotherUnitAreTakenSo) {
  for (const int type : {2, 3}) {
    C3dFile file = test::plate_recording(type);
    for (double& x : parameter(file, "CORNERS").numbers) x *= 1e-3;
    for (double& x : parameter(file, "ORIGIN").numbers) x *= 1e-3;
    std::string notes;
    expect_the_load(plate_of(file, notes), "corners in m");
    EXPECT_THAT(notes, testing::AllOf(HasSubstr("FORCE_PLATFORM:CORNERS would"), HasSubstr("FORCE_PLATFORM:ORIGIN is")))
        << type;
  }
}

TEST(PlateUnit, ARightUnitHasNoNoteWhereverTheForceIs) {
  for (int type = 1; type <= 4; ++type) {
    std::string notes;
    expect_the_load(plate_of(test::plate_recording(type), notes), "as stated");
    EXPECT_THAT(notes, testing::Not(HasSubstr("taken in"))) << type;
    C3dFile moved = test::plate_recording(type);  // the corners of another plate: 2 m beside
    for (std::size_t k = 0; k < 12; k += 3) parameter(moved, "CORNERS").numbers[k] += 2000.0;
    notes.clear();
    (void)plate_of(moved, notes);
    EXPECT_THAT(notes, testing::Not(HasSubstr("taken in"))) << type;
  }
}

}  // namespace
}  // namespace myoid::recording
