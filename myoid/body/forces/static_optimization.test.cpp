#include "myoid/body/forces/static_optimization.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/body/dynamics/inverse_dynamics.h"
#include "myoid/body/forces/force_sharing.h"
#include "myoid/body/forces/opensim_muscle.h"
#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/kinematics/muscle_kinematics.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/recording/signals/opensim_lowpass.h"
#include "myoid/recording/tables/storage_reader.h"

#include "tests/support/data_folder.h"

namespace myoid::body {
namespace {

const SharingOptions kAsOpenSim{.reserve_nm = 1e-3, .min_activation = 0.01};

/// The whole way from joint angles to muscle forces, on OpenSim's elbow flexion of arm26, with its own filter.
class Arm26Trial : public ::testing::Test {
 protected:
  static std::filesystem::path folder() { return test::data_folder() / "opensim/trial_arm26"; }
  static TimeSeries reference(const std::string& file) {
    return recording::read_storage(folder() / "opensim" / file).data;
  }

  void SetUp() override {
    MYOID_REQUIRE_DATA(folder());
    model_ = body::read_osim(folder() / "model.osim");
    const TimeSeries q =
        recording::to_si(recording::read_storage(folder() / "opensim/ik.mot"), [](const std::string&) { return true; });
    motion_ = body::joint_motion(model_, recording::opensim_lowpass(q, 6.0)).motion;
    torque_ = body::inverse_dynamics(model_, motion_);
  }

  /// Force of Thelen's muscle at full activation, frames x muscles, from lengths [m] and speeds [m/s].
  [[nodiscard]] Eigen::MatrixXd optimal_forces(const Eigen::MatrixXd& length, const Eigen::MatrixXd& speed) const {
    Eigen::MatrixXd force_n(length.rows(), length.cols());
    for (Eigen::Index i = 0; i < length.cols(); ++i) {
      const OpensimMuscle muscle(model_.muscles[static_cast<std::size_t>(i)], model_.compat);
      for (Eigen::Index row = 0; row < length.rows(); ++row) {
        force_n(row, i) = muscle.optimal_force(length(row, i), speed(row, i));
      }
    }
    return force_n;
  }

  [[nodiscard]] Eigen::VectorXd max_forces() const {
    Eigen::VectorXd force_n(static_cast<Eigen::Index>(model_.muscles.size()));
    for (std::size_t i = 0; i < model_.muscles.size(); ++i) {
      force_n[static_cast<Eigen::Index>(i)] = model_.muscles[i].properties.max_isometric_force_n;
    }
    return force_n;
  }

  /// Difference of a channel from a column of OpenSim's, whose rows are those of the record without its added ends.
  static Eigen::VectorXd difference(const TimeSeries& ours,
                                    const std::string& channel,
                                    const TimeSeries& theirs,
                                    const std::string& column) {
    Eigen::Index first = 0;
    (ours.time_s().array() - theirs.time_s()[0]).abs().minCoeff(&first);
    const Eigen::Index n = theirs.sample_count();
    EXPECT_LT((ours.time_s().segment(first, n) - theirs.time_s()).cwiseAbs().maxCoeff(), 2e-8) << channel;
    return (ours.column(channel).segment(first, n) - theirs.column(column)).cwiseAbs();
  }

  body::BodyModel model_;
  body::JointMotion motion_;
  TimeSeries torque_;
};

TEST_F(Arm26Trial, TorquesOfTheFilteredMotionAreOpenSims) {
  const TimeSeries theirs = reference("id_filtered.sto");
  for (const char* name : {"r_shoulder_elev_moment", "r_elbow_flex_moment"}) {
    EXPECT_LT(difference(torque_, name, theirs, name).maxCoeff(), 6e-9);  // the file has 8 decimals
  }
}

TEST_F(Arm26Trial, MuscleForcesFromOpenSimsGeometryAreItsStaticOptimization) {
  // Lengths, speeds and moment arms are read: what remains is Thelen's muscle and the sharing.
  // OpenSim's interior-point search stops short of the optimum (1e-8 of its own measure), most
  // where a muscle comes to its bound of 0.01: 4e-5 in a few frames.
  const TimeSeries lengths = reference("arm26_Outputs.sto");
  const TimeSeries moment_arms = reference("arm26_moment_arms.sto");
  const Eigen::Index n = lengths.sample_count();
  const auto muscle_count = static_cast<Eigen::Index>(model_.muscles.size());
  Eigen::MatrixXd length(n, muscle_count), speed(n, muscle_count);
  std::vector<Channel> names;
  for (const body::Muscle& muscle : model_.muscles) {
    const auto column = static_cast<Eigen::Index>(names.size());
    names.push_back({muscle.name, Unit::meter});
    length.col(column) = lengths.column(muscle.name + "|length");
    speed.col(column) = lengths.column(muscle.name + "|lengthening_speed");
  }
  std::vector<TimeSeries> arms;
  for (const body::Coordinate& coordinate : model_.coordinates) {
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(n, muscle_count);  // columns of zeros are left out of the file
    for (const Channel& channel : moment_arms.channels()) {
      for (Eigen::Index i = 0; i < muscle_count; ++i) {
        if (channel.name == names[static_cast<std::size_t>(i)].name + "|" + coordinate.name)
          values.col(i) = moment_arms.column(channel.name);
      }
    }
    arms.emplace_back(lengths.time_s(), names, values);
  }
  Eigen::Index first = 0;
  (torque_.time_s().array() - lengths.time_s()[0]).abs().minCoeff(&first);
  const TimeSeries torque(lengths.time_s(), torque_.channels(), torque_.values().middleRows(first, n));
  const MuscleForces shared = share(arms, torque, optimal_forces(length, speed), max_forces(), kAsOpenSim);
  for (const body::Muscle& muscle : model_.muscles) {
    const Eigen::VectorXd d =
        difference(shared.activation, muscle.name, reference("so_StaticOptimization_activation.sto"), muscle.name);
    EXPECT_GT((d.array() < 2e-6).count(), 100) << muscle.name;  // of 121 frames
    EXPECT_LT(d.maxCoeff(), 5e-5) << muscle.name;
  }
}

TEST_F(Arm26Trial, MuscleForcesFromOurGeometryAreOpenSims) {
  // The same with our own paths: in compat mode as far as OpenSim's search goes. Exact paths
  // differ, BRA's by 0.2 mm in moment arm (oblique cylinder), BIClong's by 0.24 mm (ellipsoid), of
  // 10 mm and more: percents of a force, which the others make up for.
  struct Bound {
    body::Compat compat;
    double length_m, velocity_mps, activation, force_n;
  };
  for (const Bound& bound :
       {Bound{body::kOpenSim452, 1e-9, 1e-8, 5e-5, 0.05}, Bound{body::Compat{}, 5e-5, 1e-3, 4e-3, 2.0}}) {
    body::BodyModel model = model_;
    model.compat = bound.compat;
    SCOPED_TRACE(name_of(model.compat));
    const body::MuscleKinematics muscles = body::muscle_kinematics(model, motion_);
    std::vector<TimeSeries> arms;
    for (const body::Coordinate& coordinate : model.coordinates) arms.push_back(muscles.moment_arm.at(coordinate.name));
    const MuscleForces shared = share(arms, torque_, optimal_forces(muscles.length.values(), muscles.velocity.values()),
                                      max_forces(), kAsOpenSim);
    const TimeSeries lengths = reference("arm26_Outputs.sto");
    const TimeSeries activation = reference("so_StaticOptimization_activation.sto");
    const TimeSeries force = reference("so_StaticOptimization_force.sto");
    for (const body::Muscle& muscle : model.muscles) {
      SCOPED_TRACE(muscle.name);
      const std::string& name = muscle.name;
      EXPECT_LT(difference(muscles.length, name, lengths, name + "|length").maxCoeff(), bound.length_m);
      EXPECT_LT(difference(muscles.velocity, name, lengths, name + "|lengthening_speed").maxCoeff(),
                bound.velocity_mps);
      EXPECT_LT(difference(shared.activation, name, activation, name).maxCoeff(), bound.activation);
      EXPECT_LT(difference(shared.force, name, force, name).maxCoeff(), bound.force_n);
    }
  }
}

}  // namespace
}  // namespace myoid::body
