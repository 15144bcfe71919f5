#include "myoid/recording/plate_zero.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/recording/c3d/c3d_writer.h"
#include "myoid/recording/plate_standing.h"

#include "tests/support/data_folder.h"
#include "tests/support/plate_from_disk.h"
#include "tests/support/plate_recording.h"
#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

using test::from_disk;
using test::notes_of;
using testing::HasSubstr;

/// A plate of a type that is empty in its first 200 samples (20 frames).
C3dFile empty_at_first(int type) {
  C3dFile file = test::plate_recording(type);
  file.analog.topRows(200).setZero();
  return file;
}

void name_zero(C3dFile& file, double first, double last) {
  file.groups[0].parameters.push_back(test::c3d_numbers("ZERO", C3dType::integer, {2}, {first, last}));
}

/// Adds what an amplifier adds, to forces and moments; type 1 has a point in channels 3 and 4.
void add_offsets(C3dFile& file, int type, float scale) {
  for (Eigen::Index c = 0; c < file.analog.cols(); ++c) {
    if (type == 1 && (c == 3 || c == 4)) continue;
    file.analog.col(c).array() += scale * static_cast<float>(3 * c % 7 - 2);
  }
}

TEST(PlateZero, TheMeanOfTheFramesThatTheFileNamesIsSubtractedFromEveryType) {
  for (int type = 1; type <= 4; ++type) {
    const Recording plain = from_disk(empty_at_first(type));
    C3dFile file = empty_at_first(type);
    add_offsets(file, type, type == 4 ? 0.01F : 5.0F);
    name_zero(file, 1, 20);
    Recording zeroed = from_disk(file);
    (void)stand_plates(zeroed, std::nullopt);
    Recording reference = plain;
    (void)stand_plates(reference, std::nullopt);
    const ForcePlate a = zeroed.force_plate(zeroed.plates[0]);
    const ForcePlate b = reference.force_plate(reference.plates[0]);
    // Channels are reals of 24 bits: 4e-5 N of 700 N, in type 4 6e-8 V times 500 N/V; 0.03 N mm of 300 N m.
    EXPECT_LT((a.force_n - b.force_n).cwiseAbs().maxCoeff(), 2e-4) << type;
    EXPECT_LT((a.moment_nm - b.moment_nm).cwiseAbs().maxCoeff(), 2e-4) << type;
    EXPECT_LT((a.pressure_center_m.bottomRows(810) - b.pressure_center_m.bottomRows(810)).cwiseAbs().maxCoeff(), 1e-6)
        << type;
    EXPECT_EQ(a.side.turn, b.side.turn) << type;
  }
}

TEST(PlateZero, AnOffsetAboveTheStepDoesNotDecideTheSign) {
  // 800 of 1010 samples are empty and read +212 N; the step of -560 N is short.
  C3dFile file = test::plate_recording(2);
  file.analog.topRows(800).setZero();
  file.analog.col(2).array() += 212.0F;
  name_zero(file, 1, 50);
  Recording zeroed = from_disk(file);
  (void)stand_plates(zeroed, std::nullopt);
  const ForcePlate plate = zeroed.force_plate(zeroed.plates[0]);
  EXPECT_EQ(plate.side.turn, 1.0);
  EXPECT_LT(plate.force_n.topRows(800).cwiseAbs().maxCoeff(), 1e-4);
  for (Eigen::Index i = 800; i < 1010; i += 30)
    EXPECT_LT((plate.force_n.row(i).transpose() - test::PlateLoad::force_n(0.001 * static_cast<double>(i))).norm(),
              1e-4);
  EXPECT_THAT(notes_of(zeroed), HasSubstr("frames 1 to 50"));
}

TEST(PlateZero, APlateThatIsLoadedThereKeepsItsForceAndTheFileHearsIt) {
  C3dFile standing = test::plate_recording(2);  // 540 to 700 N all the time, least at its end
  name_zero(standing, 1, 10);
  C3dFile leaves = test::plate_recording(2);  // and then nobody
  leaves.analog.bottomRows(300).setZero();
  name_zero(leaves, 1, 10);
  C3dFile steps = test::plate_recording(2);  // a step that begins within the frames
  steps.analog.topRows(50).setZero();
  name_zero(steps, 0, 10);
  for (const C3dFile& file : {standing, leaves, steps}) {
    Recording recording = from_disk(file);
    EXPECT_EQ(recording.plates[0].baseline.size(), 0);
    EXPECT_THAT(notes_of(recording), HasSubstr("in which FORCE_PLATFORM:ZERO calls it empty; nothing is subtracted"));
  }
}

TEST(PlateZero, WhereTheForceNeverChangesTheMarkersTellAStandingPersonFromAnOffset) {
  for (const bool above : {true, false}) {
    test::PlateCase c;
    c.markers = 3;
    c.marker_Z_m = above ? Vec3(0.4, 1.2, 0.1) : Vec3(2.4, 1.2, 0.1);
    C3dFile file = test::plate_recording(c);
    file.analog.rowwise() = Eigen::RowVectorXf(file.analog.row(0));
    for (Eigen::Index i = 0; i < file.analog.rows(); ++i) file.analog(i, 2) += static_cast<float>(i % 5);
    name_zero(file, 1, 10);
    EXPECT_EQ(from_disk(file).plates[0].baseline.size(), above ? 0 : 6);
  }
}

TEST(PlateZero, FramesAreCountedFromOneAndZerosMeanNone) {
  const auto samples = [](double first, double last, std::int64_t first_frame = 1) {
    C3dFile file = test::plate_recording(2);
    file.first_frame = first_frame;
    name_zero(file, first, last);
    std::vector<Repair> notes;
    const auto found = zero_samples(file, 101, 0, notes);
    return found ? std::to_string(found->first) + "+" + std::to_string(found->count)
                 : (notes.empty() ? "none" : "none, noted");
  };
  EXPECT_EQ(samples(1, 20), "0+200");
  EXPECT_EQ(samples(0, 10), "0+100");  // the guide: 0 is to be read as 1
  EXPECT_EQ(samples(5, 5), "40+10");
  EXPECT_EQ(samples(101, 101), "1000+10");
  EXPECT_EQ(samples(0, 0), "none");
  EXPECT_EQ(samples(1, 0), "none");
  EXPECT_EQ(samples(0, 0.5), "none");
  EXPECT_EQ(samples(-1, -1), "none");
  EXPECT_EQ(samples(90, 200), "none, noted");
  EXPECT_EQ(samples(-3, 10), "none, noted");
  EXPECT_EQ(samples(1, 10, 480), "0+100");     // from the start of the file
  EXPECT_EQ(samples(485, 490, 480), "50+60");  // the file was cut before frame 480
}

TEST(PlateZero, TheSameStepWithAndWithoutAnOffsetGivesTheSameForce) {
  const auto folder = test::data_folder() / "round3" / "recordings";
  MYOID_REQUIRE_DATA(folder);
  Recording plain = read_recording(folder / "t2.c3d");
  Recording zeroed = read_recording(folder / "t2_zero.c3d");
  for (Recording* recording : {&plain, &zeroed}) (void)stand_plates(*recording, std::nullopt);
  const ForcePlate a = plain.force_plate(plain.plates[0]);
  const ForcePlate b = zeroed.force_plate(zeroed.plates[0]);
  EXPECT_LT((a.force_n - b.force_n).cwiseAbs().maxCoeff(), 1e-4);  // 24 bits of 725 N
  EXPECT_LT((a.moment_nm - b.moment_nm).cwiseAbs().maxCoeff(), 1e-4);
}

}  // namespace
}  // namespace myoid::recording
