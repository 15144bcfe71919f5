#include "myoid/body/kinematics/orientation_fit.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

class FittedOrientations : public ::testing::Test {
 protected:
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-52 - 1.0; }

  void SetUp() override {
    for (std::size_t b = 1; b < arm_.bodies.size(); ++b) {
      const Mat3 R = rotation_body_xyz(Vec3(uniform(), uniform(), uniform()));
      sensors_.push_back({b - 1, static_cast<body::BodyIndex>(b), R, 1.0 + 0.5 * uniform()});
      series_.names.push_back(arm_.bodies[b].name + "_imu");
    }
  }

  [[nodiscard]] Mat3 sensor_at(const Eigen::VectorXd& q, std::size_t s) const {
    body::BodyState state = body::make_state(arm_);
    body::compute_poses(arm_, q, state);
    return state.X_GB[static_cast<std::size_t>(sensors_[s].body)].R * sensors_[s].R_BS;
  }
  /// Orientations of the postures, each turned by up to `noise_rad` about a random axis.
  void measure(const std::vector<Eigen::VectorXd>& postures, double noise_rad) {
    const auto frames = static_cast<Eigen::Index>(postures.size());
    series_.time_s = Eigen::VectorXd::LinSpaced(frames, 0.0, 0.01 * static_cast<double>(frames - 1));
    series_.quaternions.resize(frames, 4 * static_cast<Eigen::Index>(sensors_.size()));
    for (Eigen::Index i = 0; i < frames; ++i) {
      for (std::size_t s = 0; s < sensors_.size(); ++s) {
        const Mat3 error = rotation_body_xyz(noise_rad * Vec3(uniform(), uniform(), uniform()));
        const Eigen::Quaterniond q(Mat3(sensor_at(postures[static_cast<std::size_t>(i)], s) * error));
        series_.quaternions.block<1, 4>(i, 4 * static_cast<Eigen::Index>(s)) << q.w(), q.x(), q.y(), q.z();
      }
    }
  }
  [[nodiscard]] double cost(const Eigen::VectorXd& q, Eigen::Index frame) const {
    double sum = 0.0;
    for (std::size_t s = 0; s < sensors_.size(); ++s) {
      const Mat3 apart = sensor_at(q, s).transpose() * series_.rotation(frame, s);
      const double angle = Eigen::AngleAxisd(apart).angle();
      sum += 0.5 * sensors_[s].weight * angle * angle;
    }
    return sum;
  }
  [[nodiscard]] std::vector<Eigen::VectorXd> swing() const {
    std::vector<Eigen::VectorXd> postures;
    for (int i = 0; i < 20; ++i) {
      Eigen::VectorXd q = arm_.default_q();
      for (Eigen::Index c = 0; c < q.size(); ++c) {
        const body::Coordinate& k = arm_.coordinates[static_cast<std::size_t>(c)];
        if (k.locked || k.motion != body::MotionType::rotational) continue;
        const double middle = k.clamped ? 0.5 * (k.lower + k.upper) : 0.3;
        const double span = k.clamped ? 0.3 * (k.upper - k.lower) : 0.4;
        q[c] = middle + span * std::sin(0.2 * i + static_cast<double>(c));
      }
      postures.push_back(q);
    }
    return postures;
  }

  std::mt19937_64 engine_{17};
  body::BodyModel arm_ = body::parse_osim(body::arm4_osim(), "arm4.osim");
  std::vector<SensorOnBody> sensors_;
  recording::OrientationSeries series_;
};

TEST_F(FittedOrientations, GiveTheAnglesBack) {
  const auto postures = swing();
  measure(postures, 0.0);
  const OrientationFit fit = fit_orientations(arm_, series_, sensors_);
  EXPECT_EQ(fit.frames_not_converged, 0);
  for (std::size_t i = 0; i < postures.size(); ++i) {
    // Newton's steps stop at 1e-9 or so; a quaternion has sixteen digits.
    EXPECT_LT((fit.q.values().row(static_cast<Eigen::Index>(i)).transpose() - postures[i]).cwiseAbs().maxCoeff(), 1e-6)
        << i;
  }
  EXPECT_LT(fit.errors_rad.values().maxCoeff(), 1e-6);
}

// With noise: the cost, computed another way, is flat at the solution and rises along every coordinate that is free.
TEST_F(FittedOrientations, HaveTheLeastCost) {
  measure(swing(), 0.2);
  const OrientationFit fit = fit_orientations(arm_, series_, sensors_);
  EXPECT_EQ(fit.frames_not_converged, 0);
  EXPECT_GT(fit.errors_rad.values().maxCoeff(), 0.02);
  for (Eigen::Index i = 0; i < series_.time_s.size(); ++i) {
    const Eigen::VectorXd q = fit.q.values().row(i).transpose();
    for (Eigen::Index c = 0; c < q.size(); ++c) {
      const body::Coordinate& k = arm_.coordinates[static_cast<std::size_t>(c)];
      if (k.locked || k.motion != body::MotionType::rotational) continue;
      if (k.clamped && std::min(q[c] - k.lower, k.upper - q[c]) < 1e-3) continue;
      const double h = 1e-4;
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(q.size(), c);
      const double slope = (cost(q + step, i) - cost(q - step, i)) / (2.0 * h);
      EXPECT_LT(std::abs(slope), 1e-6) << k.name << " at " << i;
      EXPECT_GE(cost(q + 30.0 * step, i), cost(q, i));
      EXPECT_GE(cost(q - 30.0 * step, i), cost(q, i));
    }
    for (std::size_t s = 0; s < sensors_.size(); ++s) {
      const Mat3 apart = sensor_at(q, s).transpose() * series_.rotation(i, s);
      EXPECT_NEAR(fit.errors_rad.values()(i, static_cast<Eigen::Index>(s)), std::acos(0.5 * (apart.trace() - 1.0)),
                  1e-9);
    }
  }
}

TEST_F(FittedOrientations, LeaveOutWhatIsMissingAndRefuseLoops) {
  measure(swing(), 0.0);
  series_.quaternions.block(3, 0, 1, 4).setConstant(std::nan(""));
  series_.quaternions.row(5).setConstant(std::nan(""));
  const OrientationFit fit = fit_orientations(arm_, series_, sensors_);
  EXPECT_TRUE(std::isnan(fit.errors_rad.values()(3, 0)));
  EXPECT_EQ(fit.frames_without_sensors, 1);
  EXPECT_EQ(fit.q.values().row(5), fit.q.values().row(4));
  body::BodyModel loop = arm_;
  loop.constraints.push_back({"loop", "PointConstraint", body::FrameConstraint{.body1 = 0, .body2 = 1}});
  EXPECT_THROW((void)fit_orientations(loop, series_, sensors_), ModelError);
  EXPECT_THROW((void)fit_orientations(arm_, series_, {}), InvalidInput);
}

}  // namespace
}  // namespace myoid::body
