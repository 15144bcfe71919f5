// `myoid so` as a user runs it: whichever tendon, passive force or load, muscles and reserves make
// the torques that `myoid id` finds.
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/recording/tables/storage_reader.h"

#include "tests/pipeline/program.h"
#include "tests/support/temporary_folder.h"

namespace myoid {
namespace {

using test::Finished;
using test::myoid;
using test::TemporaryFolder;
using test::write_text;

/// An elbow that swings and, to see whether forces are shared or lent, slowly enough for 1 N m.
void write_motion(const std::string& file) {
  std::string text = "m\nversion=1\ninDegrees=yes\nendheader\ntime\telbow_flexion\n";
  for (int i = 0; i <= 60; ++i)
    text += std::to_string(0.02 * i) + "\t" + std::to_string(70.0 + 25.0 * std::sin(0.12 * i)) + "\n";
  write_text(file, text);
}

/// 20 N upward on the hand, at its center of mass and growing.
std::vector<std::string> with_loads(const TemporaryFolder& folder) {
  std::string data = "loads\nversion=1\ninDegrees=no\nendheader\ntime\tf_x\tf_y\tf_z\tp_x\tp_y\tp_z\n";
  for (int i = 0; i <= 60; ++i)
    data += std::to_string(0.02 * i) + "\t0\t" + std::to_string(10.0 + 0.1 * i) + "\t0\t0\t-0.2\t0\n";
  write_text(folder / "loads.mot", data);
  write_text(folder / "loads.xml",
             "<OpenSimDocument Version=\"40000\"><ExternalLoads name=\"l\"><objects>"
             "<ExternalForce name=\"push\"><applied_to_body>forearm_hand</applied_to_body>"
             "<force_expressed_in_body>ground</force_expressed_in_body>"
             "<point_expressed_in_body>forearm_hand</point_expressed_in_body>"
             "<force_identifier>f_</force_identifier><point_identifier>p_</point_identifier>"
             "</ExternalForce></objects><datafile>loads.mot</datafile></ExternalLoads>"
             "</OpenSimDocument>");
  return {"--loads", folder / "loads.xml"};
}

class ForceSharing : public ::testing::Test {
 protected:
  void SetUp() override {
    write_motion(folder_ / "m.mot");
    (void)run("paths", "paths", {});
  }

  Finished run(const std::string& command, const std::string& out, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{command,           "--model", "arm4",       "--motion",
                                       folder_ / "m.mot", "--out",   folder_ / out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished finished = myoid(arguments);
    EXPECT_EQ(finished.exit_code, 0) << command << ": " << finished.err;
    return finished;
  }
  TimeSeries read(const std::string& file) const { return recording::read_storage(folder_ / file).data; }

  /// sum r F and the reserve against the torque of inverse dynamics; returns the forces.
  TimeSeries check_torque(const std::string& name, const std::vector<std::string>& loads) const {
    (void)run("id", name + "_id.sto", loads);
    const TimeSeries forces = read(name + "/StaticOptimization_force.sto");
    const TimeSeries arms = read("paths/MuscleAnalysis_MomentArm_elbow_flexion.sto");
    Eigen::VectorXd torque = forces.values().rightCols(1).col(0);
    for (const Channel& channel : forces.channels()) {
      const auto reserve = channel.name.find("elbow_flexion");
      if (reserve != std::string::npos) torque = forces.column(channel.name);
    }
    for (const Channel& muscle : arms.channels())
      torque += arms.column(muscle.name).cwiseProduct(forces.column(muscle.name));
    const Eigen::VectorXd expected = read(name + "_id.sto").column("elbow_flexion_moment");
    // The files have all digits of a double; the solver stops at 1e-9 of the torque.
    EXPECT_LT((torque - expected).cwiseAbs().maxCoeff(), 1e-7) << name;
    EXPECT_GE(read(name + "/StaticOptimization_activation.sto").values().minCoeff(), 0.0);
    return forces;
  }

  TemporaryFolder folder_;
};

TEST_F(ForceSharing, RigidOrElasticWithOrWithoutPassiveForceTheTorqueIsMade) {
  (void)run("so", "rigid", {});
  (void)run("so", "elastic", {"--tendon", "elastic"});
  (void)run("so", "passive", {"--tendon", "elastic", "--passive"});
  const TimeSeries rigid = check_torque("rigid", {});
  const TimeSeries elastic = check_torque("elastic", {});
  const TimeSeries passive = check_torque("passive", {});
  // They are different problems with different answers.
  EXPECT_GT((rigid.values() - elastic.values()).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_GT((passive.values() - elastic.values()).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(ForceSharing, AMeasuredLoadIsCarriedByTheMuscles) {
  const std::vector<std::string> loads = with_loads(folder_);
  (void)run("so", "loaded", loads);
  (void)run("so", "bare", {});
  const TimeSeries loaded = check_torque("loaded", loads);
  const TimeSeries bare = check_torque("bare", {});
  EXPECT_GT((loaded.values() - bare.values()).cwiseAbs().maxCoeff(), 1.0);
}

TEST_F(ForceSharing, AnUnknownTendonIsRefusedWithTheTwoThereAre) {
  const Finished finished =
      myoid({"so", "--model", "arm4", "--motion", folder_ / "m.mot", "--out", folder_ / "so", "--tendon", "soft"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.err, ::testing::HasSubstr("elastic"));
}

}  // namespace
}  // namespace myoid
