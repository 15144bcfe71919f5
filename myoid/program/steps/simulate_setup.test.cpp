#include "myoid/program/steps/simulate_setup.h"

#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::program {
namespace {

using testing::ElementsAre;

TEST(SimulateSetup, PlacesTurningCoordinatesInDegreesAndSlidingOnesInMeters) {
  SimulateOptions o;
  o.initial = {"knee=90", "slide=0.25"};
  o.initial_speed = {"knee=-180"};
  o.lock = {"slide"};
  body::SimulationStart start;
  start.q = {1.0, 1.0, 1.0};
  std::vector<body::Device> devices(3);
  place(o, {{"hip", true}, {"knee", true}, {"slide", false}}, start, devices);
  constexpr double kPi = std::numbers::pi;
  EXPECT_THAT(start.q, ElementsAre(1.0, testing::DoubleEq(kPi / 2.0), 0.25));
  EXPECT_THAT(start.qdot, ElementsAre(0.0, testing::DoubleEq(-kPi), 0.0));
  o.lock = {"ankle"};
  EXPECT_THROW(place(o, {{"hip", true}}, start, devices), InvalidInput);
}

TEST(SimulateSetup, TheTimeIsTheFilesUnlessTheCallSaysOtherwise) {
  const test::TemporaryFolder folder;
  write_file(folder / "u.sto", "u\nversion=1\ninDegrees=no\nendheader\ntime\tA\n2\t0.1\n5\t0.2\n");
  SimulateOptions o;
  Remarks remarks(o.call);
  Drive drive = read_drive(o, {"A"}, remarks);
  EXPECT_EQ(drive.start_s, 0.0);
  EXPECT_EQ(drive.end_s, 1.0);
  o.excitations = folder / "u.sto";
  drive = read_drive(o, {"A"}, remarks);
  EXPECT_EQ(drive.start_s, 2.0);
  EXPECT_EQ(drive.end_s, 5.0);
  o.call.start_s = 3.0;
  drive = read_drive(o, {"A"}, remarks);
  EXPECT_EQ(drive.start_s, 3.0);
  EXPECT_EQ(drive.end_s, 5.0);
  EXPECT_THROW((void)read_drive(o, {"B"}, remarks), ReadError);
}

}  // namespace
}  // namespace myoid::program
