#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/body/model/constraints.h"
#include "myoid/body/osim/osim_named_frames.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/opensim/opensim_files.h"
#include "myoid/opensim/tool_stages.h"

#include "tests/support/data_folder.h"
#include "tests/support/tool_folder.h"

namespace myoid::opensim {
namespace {

class ToolOrientations : public test::ToolFolder {
 protected:
  /// How the sensor of a body is taped on: another way for each.
  static Mat3 taped(std::size_t body) {
    const auto b = static_cast<double>(body);
    return rotation_body_xyz(Vec3(0.3 * b, 0.5 - 0.2 * b, 0.1 * b * b));
  }
  /// Orientations of sensors on all bodies at these postures, as a laboratory measures them whose
  /// axes `R_LG` turns into ground's.
  void write_orientations(const std::string& name,
                          const body::BodyModel& model,
                          const Eigen::MatrixXd& q,
                          const Eigen::VectorXd& times,
                          const Mat3& R_LG) const {
    std::string text = "DataType=Quaternion\nversion=3\nendheader\ntime";
    for (std::size_t b = 1; b < model.bodies.size(); ++b) text += "\t" + model.bodies[b].name + "_imu";
    body::BodyState state = body::make_state(model);
    for (Eigen::Index i = 0; i < q.rows(); ++i) {
      text += "\n" + format_number(times[i]);
      body::compute_poses(model, q.row(i).transpose(), state);
      for (std::size_t b = 1; b < model.bodies.size(); ++b) {
        const Eigen::Quaterniond r(Mat3(R_LG * state.X_GB[b].R * taped(b)));
        text += fmt::format("\t{:.17g},{:.17g},{:.17g},{:.17g}", r.w(), r.x(), r.y(), r.z());
      }
    }
    write(name, text + "\n");
  }
  [[nodiscard]] static std::string place(const std::string& model, const std::string& more = "") {
    return "<IMUPlacer><model_file>" + model +
           "</model_file><orientation_file_for_calibration>calibration.sto"
           "</orientation_file_for_calibration><output_model_file>placed.osim"
           "</output_model_file>" +
           more + "</IMUPlacer>";
  }
  [[nodiscard]] static std::string fit(const std::string& more = "") {
    return "<IMUInverseKinematicsTool name=\"t\"><model_file>placed.osim</model_file>"
           "<orientations_file>orientations.sto</orientations_file><results_directory>r"
           "</results_directory>" +
           more + "</IMUInverseKinematicsTool>";
  }
  /// Frames of sensors in the placed model turn as those that are taped on.
  void expect_placed(const body::BodyModel& model, double tolerance) const {
    const auto path = folder_ / "placed.osim";
    const auto frames = body::named_frames(read_text_file(path), path);
    for (std::size_t b = 1; b < model.bodies.size(); ++b) {
      const auto frame = frames.find(model.bodies[b].name + "_imu");
      ASSERT_NE(frame, frames.end()) << model.bodies[b].name;
      EXPECT_LT((frame->second.X_BF.R - taped(b)).norm(), tolerance) << model.bodies[b].name;
      EXPECT_LT((frame->second.X_BF.p - model.bodies[b].p_BBcm_B).norm(), 1e-12);
    }
  }
};

const std::string kUp =
    "<sensor_to_opensim_rotations>-1.5707963267948966 0 0"
    "</sensor_to_opensim_rotations>";  // z up becomes y up
Mat3 z_up() { return Eigen::AngleAxisd(0.5 * kPi, Vec3::UnitX()).toRotationMatrix(); }

TEST_F(ToolOrientations, GiveTheSwingOfAnArmBack) {
  const Eigen::VectorXd rest = body::assemble(arm_, arm_.default_q()).q;
  write_orientations("calibration.sto", arm_, rest.transpose(), Eigen::VectorXd::Zero(1), z_up());
  ToolResult result = run(place("arm.osim", kUp));
  EXPECT_THAT(result.summary, ::testing::HasSubstr("sensors placed"));
  expect_placed(arm_, 1e-12);
  Eigen::MatrixXd q = rest.transpose().replicate(30, 1);
  for (int i = 0; i < 30; ++i) q(i, arm_.coordinate_index("elbow_flexion")) = elbow(i);
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(30, 0.0, 0.29);
  write_orientations("orientations.sto", arm_, q, times, z_up());
  result = run(fit(kUp + "<time_range>0.05 0.2</time_range>"));
  EXPECT_EQ(result.frames_failed, 0);
  EXPECT_EQ(result.frames, 16);
  const TimeSeries motion = read("r/ik_orientations.mot");
  for (Eigen::Index i = 0; i < 16; ++i)
    EXPECT_NEAR(kDegree * motion.column("elbow_flexion")[i], elbow(static_cast<int>(i) + 5), 1e-7);
  EXPECT_LT(read("r/ik_orientations_orientationErrors.sto").values().maxCoeff(), 1e-6);
}

// A laboratory whose heading is 40 degrees off: the base sensor's axis that points forward tells.
TEST_F(ToolOrientations, CorrectTheHeadingByTheBaseSensor) {
  const Eigen::VectorXd rest = body::assemble(arm_, arm_.default_q()).q;
  const Mat3 off = Eigen::AngleAxisd(40.0 * kDegree, Vec3::UnitY()).toRotationMatrix();
  const std::string base = arm_.bodies[static_cast<std::size_t>(arm_.joints[0].child)].name;
  body::BodyState state = body::make_state(arm_);
  body::compute_poses(arm_, rest, state);
  std::string text = "DataType=Quaternion\nversion=3\nendheader\ntime\t" + base + "_imu\n0";
  const auto b = static_cast<std::size_t>(arm_.joints[0].child);
  // Its -z axis points along the body's x.
  const Mat3 taped = Eigen::AngleAxisd(-0.5 * kPi, Vec3::UnitY()).toRotationMatrix();
  const Eigen::Quaterniond r(Mat3(off * state.X_GB[b].R * taped));
  text += fmt::format("\t{:.17g},{:.17g},{:.17g},{:.17g}\n", r.w(), r.x(), r.y(), r.z());
  write("calibration.sto", text);
  std::ignore = run(place("arm.osim", "<base_imu_label>" + base +
                                          "_imu</base_imu_label>"
                                          "<base_heading_axis>-z</base_heading_axis>"));
  const auto path = folder_ / "placed.osim";
  const auto frames = body::named_frames(read_text_file(path), path);
  // The angle by an arc cosine: eight digits.
  EXPECT_LT((frames.at(base + "_imu").X_BF.R - taped).norm(), 1e-7);
}

TEST_F(ToolOrientations, SayWhatDoesNotFit) {
  const Eigen::VectorXd rest = arm_.default_q();
  write_orientations("calibration.sto", arm_, rest.transpose(), Eigen::VectorXd::Zero(1), z_up());
  write_orientations("orientations.sto", arm_, rest.transpose(), Eigen::VectorXd::Zero(1), z_up());
  write("placed.osim", body::arm4_osim());
  EXPECT_THROW((void)run(fit()), ReadError);  // no frames of sensors
  EXPECT_THROW((void)run(place("arm.osim",
                               "<base_imu_label>none_imu</base_imu_label>"
                               "<base_heading_axis>x</base_heading_axis>")),
               ReadError);
  EXPECT_THROW((void)run(place("arm.osim",
                               "<base_imu_label>x</base_imu_label>"
                               "<base_heading_axis>up</base_heading_axis>")),
               ReadError);
  write("calibration.sto", "DataType=Quaternion\nendheader\ntime\tnobody_imu\n0\t1,0,0,0\n");
  EXPECT_THROW((void)run(place("arm.osim")), ReadError);
}

// Models of walking with sensors on all bodies: the angles of a known motion come back.
TEST_F(ToolOrientations, GiveTheMotionOfPublicModelsBack) {
  for (const char* name : {"gait2354", "rajagopal2016"}) {
    SCOPED_TRACE(name);
    const auto folder = test::data_folder() / "opensim" / name;
    MYOID_REQUIRE_DATA(folder / "model.osim");
    const body::BodyModel model = body::read_osim(folder / "model.osim");
    write("model.osim", read_text_file(folder / "model.osim"));
    const Eigen::VectorXd rest = body::assemble(model, model.default_q()).q;
    write_orientations("calibration.sto", model, rest.transpose(), Eigen::VectorXd::Zero(1), z_up());
    std::ignore = run(place("model.osim", kUp));
    std::vector<Remark> remarks;
    const TimeSeries motion = read_coordinates(model, folder / "smooth.mot", MissingCoordinate::default_value, remarks);
    Eigen::MatrixXd q = motion.values().topRows(40);
    for (Eigen::Index i = 0; i < q.rows(); ++i) {
      Eigen::VectorXd row = q.row(i).transpose();
      for (Eigen::Index c = 0; c < row.size(); ++c) {
        const body::Coordinate& k = model.coordinates[static_cast<std::size_t>(c)];
        if (k.locked) row[c] = k.default_value;
        if (k.clamped) row[c] = std::clamp(row[c], k.lower + 1e-3, k.upper - 1e-3);
      }
      q.row(i) = body::assemble(model, row).q.transpose();
    }
    write_orientations("orientations.sto", model, q, motion.time_s().head(40), z_up());
    const ToolResult result = run(fit(kUp));
    EXPECT_EQ(result.frames_failed, 0);
    const TimeSeries back = read("r/ik_orientations.mot");
    ASSERT_EQ(back.sample_count(), 40);
    for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
      if (model.coordinates[c].motion != body::MotionType::rotational) continue;
      const Eigen::VectorXd error =
          kDegree * back.column(model.coordinates[c].name) - q.col(static_cast<Eigen::Index>(c));
      EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-5) << model.coordinates[c].name;
    }
    EXPECT_LT(read("r/ik_orientations_orientationErrors.sto").values().maxCoeff(), 1e-5);
  }
}

}  // namespace
}  // namespace myoid::opensim
