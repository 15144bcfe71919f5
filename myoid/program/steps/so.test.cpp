#include "myoid/program/steps/so.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/program/steps/id.h"
#include "myoid/program/steps/ik.h"
#include "myoid/program/steps/paths.h"
#include "myoid/program/steps/stage_input.h"

#include "tests/support/temporary_folder.h"

namespace myoid::program {
namespace {

/// An elbow that swings for a second.
std::string swinging_elbow(const test::TemporaryFolder& folder) {
  std::string text = "m\nversion=1\ninDegrees=yes\nendheader\ntime\telbow_flexion\n";
  for (int i = 0; i <= 50; ++i)
    text += std::to_string(0.02 * i) + "\t" + std::to_string(70.0 + 25.0 * std::sin(0.12 * i)) + "\n";
  write_file(folder / "m.mot", text);
  return folder / "m.mot";
}

TEST(SoFunction, MusclesAndReserveMakeTheTorqueOfInverseDynamics) {
  const test::TemporaryFolder folder;
  const std::string motion = swinging_elbow(folder);
  IdOptions id_options;
  id_options.model = "arm4";
  id_options.motion = motion;
  PathsOptions paths_options;
  paths_options.model = "arm4";
  paths_options.motion = motion;
  SoOptions so_options;
  so_options.model = "arm4";
  so_options.motion = motion;
  so_options.coordinates = {"elbow_flexion"};
  const Eigen::VectorXd torque = id(id_options).forces.column("elbow_flexion_moment");
  const TimeSeries arms = paths(paths_options).muscles.moment_arm.at("elbow_flexion");
  const SoResult shared = so(so_options);
  EXPECT_EQ(shared.shared.frames_not_solved, 0);
  // Muscles of the class have 0.01 as their least control, and the extensor is not needed.
  EXPECT_EQ(shared.shared.activation.values().minCoeff(), 0.01);
  for (Eigen::Index i = 0; i < torque.size(); ++i) {
    const double made =
        arms.values().row(i).dot(shared.shared.force.values().row(i)) + shared.shared.reserve.values()(i, 0);
    EXPECT_NEAR(made, torque[i], 1e-8) << i;  // the dual's tolerance on torques of some 3 N m
  }
  so_options.cutoff_hz = -1.0;
  EXPECT_THROW((void)so(so_options), InvalidInput);
}

TEST(SoFunction, OnlyTheTimeOfTheCallIsUsed) {
  const test::TemporaryFolder folder;
  IdOptions options;
  options.model = "arm4";
  options.motion = swinging_elbow(folder);
  const TimeSeries whole = id(options).forces;
  options.call.start_s = 0.4;
  options.call.end_s = 0.6;
  const TimeSeries part = id(options).forces;
  ASSERT_EQ(part.sample_count(), 11);
  // Derivatives are those of the whole file.
  EXPECT_EQ(part.values(), whole.values().middleRows(20, 11));
  options.call.start_s = 5.0;
  options.call.end_s.reset();
  EXPECT_THROW((void)id(options), InvalidInput);
}

TEST(IkFunction, TheMarkerErrorsLieBesideTheMotion) {
  EXPECT_EQ(marker_errors_path("out/flex.mot"), "out/flex_marker_errors.sto");
  EXPECT_EQ(marker_errors_path("flex.mot"), "flex_marker_errors.sto");
}

TEST(StageInput, MarkersAreCutToTheTimeOfTheCall) {
  MarkerSeries markers{Eigen::Vector3d(0.0, 1.0, 2.0), {"A"}, Eigen::MatrixXd(3, 3)};
  markers.positions_m << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  Call call;
  call.start_s = 0.5;
  const MarkerSeries later = cut(markers, call);
  EXPECT_EQ(later.time_s, Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(later.positions_m(0, 0), 4.0);
  call.start_s = 3.0;
  EXPECT_THROW((void)cut(markers, call), InvalidInput);
}

}  // namespace
}  // namespace myoid::program
