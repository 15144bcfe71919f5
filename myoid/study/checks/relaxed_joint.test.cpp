#include "myoid/study/checks/relaxed_joint.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"

namespace myoid::study {
namespace {

/// A relaxed joint that is held at some angles, each with the torque of a spring.
struct HeldAngles {
  std::vector<TrialSpec> specs;
  std::vector<TimeSeries> torques, motions;

  HeldAngles(std::vector<double> angles_deg, double stiffness_nm_per_rad) {
    const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(50, 0.0, 1.0);
    for (const double angle_deg : angles_deg) {
      const double q = angle_deg * kDegree;
      specs.push_back({});
      specs.back().name = "held";
      specs.back().use = Use::passive;
      torques.emplace_back(t, std::vector<Channel>{{"ankle_moment", Unit::newton_meter}},
                           Eigen::MatrixXd::Constant(50, 1, stiffness_nm_per_rad * q));
      motions.emplace_back(t, std::vector<Channel>{{"ankle", Unit::radian}}, Eigen::MatrixXd::Constant(50, 1, q));
    }
  }
  [[nodiscard]] std::vector<EffortTrial> trials() const {
    std::vector<EffortTrial> all;
    for (std::size_t i = 0; i < specs.size(); ++i) all.push_back({&specs[i], &torques[i], TimeSeries{}, &motions[i]});
    return all;
  }
};

TEST(RelaxedJoint, ResistsByTheChangeOfTorqueOverItsRange) {
  const HeldAngles held({-30.0, -10.0, 10.0}, 20.0);
  const RelaxedJoint joint = relaxed_joint(held.trials(), "ankle", 1.0);
  EXPECT_NEAR(joint.change_nm, 20.0 * 40.0 * kDegree, 1e-9);  // round-off
  EXPECT_TRUE(joint.resists());
  EXPECT_TRUE(yielding_joint(joint, "ankle", 0.0).empty());
}

TEST(RelaxedJoint, ThatYieldsIsNamedInEveryTrial) {
  const HeldAngles held({-30.0, -10.0, 10.0}, -20.0);
  const RelaxedJoint joint = relaxed_joint(held.trials(), "ankle", 1.0);
  EXPECT_TRUE(joint.yields());
  EXPECT_EQ(yielding_joint(joint, "ankle", 0.0).size(), 3U);
}

TEST(RelaxedJoint, TellsNothingWhereWeightMayExplainTheTorqueOrTheAngleHardlyMoves) {
  EXPECT_EQ(relaxed_joint(HeldAngles({-30.0, 10.0}, -20.0).trials(), "ankle", 4.0).change_nm, 0.0);
  EXPECT_EQ(relaxed_joint(HeldAngles({1.0, 5.0}, -2000.0).trials(), "ankle", 1.0).change_nm, 0.0);
  EXPECT_EQ(relaxed_joint({}, "ankle", 1.0).change_nm, 0.0);
}

}  // namespace
}  // namespace myoid::study
