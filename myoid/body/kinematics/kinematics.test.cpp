#include <cmath>
#include <string_view>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/recording/trc_reader.h"

#include "tests/support/data_folder.h"

namespace myoid::body {
namespace {

body::BodyModel arm() { return body::parse_osim(body::arm4_osim({}), "arm4.osim"); }

/// Markers of the model along coordinates of our own.
MarkerSeries markers_of(const body::BodyModel& m, const Eigen::MatrixXd& q) {
  MarkerSeries series;
  series.time_s = Eigen::VectorXd::LinSpaced(q.rows(), 0.0, 0.01 * static_cast<double>(q.rows() - 1));
  series.positions_m.resize(q.rows(), static_cast<Eigen::Index>(3 * m.markers.size()));
  for (const body::Marker& marker : m.markers) series.names.push_back(marker.name);
  body::BodyState state = body::make_state(m);
  for (Eigen::Index frame = 0; frame < q.rows(); ++frame) {
    body::compute_poses(m, q.row(frame).transpose(), state);
    for (std::size_t i = 0; i < m.markers.size(); ++i) {
      series.positions_m.block<1, 3>(frame, static_cast<Eigen::Index>(3 * i)) =
          (state.X_GB[static_cast<std::size_t>(m.markers[i].body)] * m.markers[i].p_BM).transpose();
    }
  }
  return series;
}

Eigen::MatrixXd swing(const body::BodyModel& m, Eigen::Index frames) {
  Eigen::MatrixXd q(frames, static_cast<Eigen::Index>(m.coordinates.size()));
  for (Eigen::Index i = 0; i < frames; ++i) {
    for (Eigen::Index c = 0; c < q.cols(); ++c)
      q(i, c) = 0.4 + 0.3 * std::sin(0.1 * static_cast<double>(i) + static_cast<double>(c));
  }
  return q;
}

TEST(InverseKinematics, GivesBackTheAnglesThatMadeTheMarkers) {
  const body::BodyModel m = arm();
  const Eigen::MatrixXd q = swing(m, 60);
  const IkResult result = inverse_kinematics(m, markers_of(m, q));
  EXPECT_LT((result.q.values() - q).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_EQ(result.frames_not_converged, 0);
  EXPECT_TRUE(result.open_coordinates.empty());
}

TEST(InverseKinematics, AnUnclampedCoordinateThatBeginsATurnAwayComesBackIntoItsRange) {
  const body::BodyModel m = arm();
  const Eigen::MatrixXd q = swing(m, 20);
  body::BodyModel away = m;
  for (body::Coordinate& c : away.coordinates) {
    if (c.motion != body::MotionType::rotational) continue;
    c.clamped = false;
    c.lower = -1.0;
    c.upper = 2.0;
    c.default_value += 4.0 * kPi;
  }
  const IkResult result = inverse_kinematics(away, markers_of(m, q));
  EXPECT_LT((result.q.values() - q).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(InverseKinematics, AMissingMarkerIsLeftOutOfItsFrames) {
  const body::BodyModel m = arm();
  const Eigen::MatrixXd q = swing(m, 30);
  MarkerSeries markers = markers_of(m, q);
  const auto wrist = std::find(markers.names.begin(), markers.names.end(), "r_wrist") - markers.names.begin();
  for (Eigen::Index frame = 10; frame < 20; ++frame) markers.positions_m.block<1, 3>(frame, 3 * wrist).setConstant(NAN);
  const IkResult result = inverse_kinematics(m, markers);
  EXPECT_LT((result.q.values() - q).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_TRUE(std::isnan(result.errors.column("r_wrist")[15]));
}

TEST(InverseKinematics, AFrameWithoutMarkersKeepsThePoseBeforeAndSaysSo) {
  const body::BodyModel m = arm();
  MarkerSeries markers = markers_of(m, swing(m, 5));
  markers.positions_m.row(3).setConstant(NAN);
  const IkResult result = inverse_kinematics(m, markers);
  EXPECT_EQ(result.status[3], FrameStatus::no_markers);
  EXPECT_EQ(result.q.values().row(3), result.q.values().row(2));
}

TEST(InverseKinematics, NamesTheCoordinatesThatTheMarkersLeaveOpen) {
  const body::BodyModel m = arm();
  MarkerSeries markers = markers_of(m, swing(m, 3));
  const int forearm = *m.find_body("forearm_hand");
  for (std::size_t i = 0; i < m.markers.size(); ++i) {
    if (m.markers[i].body == forearm) {
      markers.positions_m.middleCols(static_cast<Eigen::Index>(3 * i), 3).setConstant(NAN);
    }
  }
  const IkResult result = inverse_kinematics(m, markers);
  EXPECT_EQ(result.open_coordinates, std::vector<std::string>{"elbow_flexion"});
}

TEST(InverseKinematics, RefusesARecordingWithoutAnyMarkerOfTheModel) {
  MarkerSeries markers = markers_of(arm(), swing(arm(), 2));
  for (std::string& name : markers.names) name += "_x";
  EXPECT_THROW((void)inverse_kinematics(arm(), markers), InvalidInput);
}

TEST(InverseKinematics, RefusesAWeightOfAMarkerThatTheModelLacks) {
  const MarkerSeries markers = markers_of(arm(), swing(arm(), 2));
  try {
    (void)inverse_kinematics(arm(), markers, {.marker_weights = {{"acromion", 10.0}}});
    FAIL() << "was ignored";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string_view(error.what()).find("'acromion'"), std::string_view::npos);
    EXPECT_NE(std::string_view(error.what()).find(arm().markers[0].name), std::string_view::npos);
  }
}

TEST(InverseKinematics, ConvergesWhereTheMarkersLieFarFromTheModel) {
  // Targets pulled to five times their distance from the shoulder: the curvature of the markers'
  // paths, which Gauss-Newton leaves out, then exceeds what it keeps.
  const body::BodyModel m = arm();
  MarkerSeries markers = markers_of(m, swing(m, 30));
  markers.positions_m *= 5.0;
  const IkResult result = inverse_kinematics(m, markers);
  EXPECT_EQ(result.frames_not_converged, 0);
  // A minimum: the cost of the pose held a little beside it is higher in every coordinate.
  for (const double step : {-1e-4, 1e-4}) {
    for (std::size_t c = 0; c < m.coordinates.size(); ++c) {
      const body::Coordinate& coordinate = m.coordinates[c];
      if (coordinate.locked) continue;
      Eigen::MatrixXd beside = result.q.values();
      const auto column = static_cast<Eigen::Index>(c);
      beside.col(column).array() += step;
      if (coordinate.clamped)  // at an end of its range only the inside is to be compared
        beside.col(column) = beside.col(column).cwiseMax(coordinate.lower).cwiseMin(coordinate.upper);
      const Eigen::MatrixXd here = markers_of(m, result.q.values()).positions_m;
      const Eigen::MatrixXd there = markers_of(m, beside).positions_m;
      const Eigen::VectorXd rise =
          (there - markers.positions_m).rowwise().squaredNorm() - (here - markers.positions_m).rowwise().squaredNorm();
      // Where both are the same pose the rise is 0; elsewhere second order: above 1e-9.
      EXPECT_GE(rise.minCoeff(), 0.0) << coordinate.name;
    }
  }
}

TEST(InverseKinematics, AgreesWithOpenSimsConvergedSolution) {
  const auto folder = test::data_folder() / "opensim/trial_arm26";
  MYOID_REQUIRE_DATA(folder);
  const body::BodyModel m = body::read_osim(folder / "model.osim");
  const IkResult result = inverse_kinematics(m, recording::read_trc(folder / "arm26_elbow_flex.trc").markers);
  const recording::Storage tight = recording::read_storage(folder / "opensim/ik_tight.mot");
  ASSERT_EQ(result.q.sample_count(), tight.data.sample_count());
  for (const char* name : {"r_shoulder_elev", "r_elbow_flex"}) {
    // The reference has 8 decimals; 0.002 degrees is what its own convergence promises.
    EXPECT_LT((result.q.column(name) / kDegree - tight.data.column(name)).cwiseAbs().maxCoeff(), 0.002) << name;
  }
  const recording::Storage errors = recording::read_storage(folder / "opensim/tight_ik_marker_errors.sto");
  const Eigen::VectorXd theirs = errors.data.column("total_squared_error");
  // Ours is never above theirs by more than the eighth decimal they print.
  EXPECT_LE((result.errors.column("total_squared_error") - theirs).maxCoeff(), 0.51e-8);
}

TEST(JointMotion, DifferentiatesEveryCoordinateAndRestsWhereTheMotionIsSilent) {
  const body::BodyModel m = arm();
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(401, 0.0, 4.0);
  const TimeSeries q(t, {{"elbow_flexion", Unit::radian}}, (2.0 * t.array()).sin().matrix());
  const MotionResult result = joint_motion(m, q);
  EXPECT_NEAR(result.motion.qddot.column("elbow_flexion")[200], -4.0 * std::sin(4.0), 1e-6);
  EXPECT_EQ(result.motion.qdot.column("shoulder_flexion")[10], 0.0);
  EXPECT_TRUE(result.notes.empty());
}

TEST(JointMotion, RefusesAMotionOfAnotherModel) {
  EXPECT_THROW(
      (void)joint_motion(arm(), {Eigen::VectorXd::LinSpaced(5, 0, 1), {{"knee"}}, Eigen::MatrixXd::Zero(5, 1)}),
      InvalidInput);
}

}  // namespace
}  // namespace myoid::body
