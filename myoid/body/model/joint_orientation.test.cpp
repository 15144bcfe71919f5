#include "myoid/body/model/joint_orientation.h"

#include <gtest/gtest.h>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

/// One body on a joint of six coordinates, drawn from `parent` to `child`.
std::string one_body(const std::string& joint, const std::string& parent, const std::string& child) {
  return R"(<OpenSimDocument Version="40000"><Model name="m"><BodySet><objects><Body name="b">
<mass>2</mass><mass_center>0.1 0 0</mass_center><inertia>0.1 0.2 0.3 0 0 0</inertia></Body></objects>
</BodySet><JointSet><objects>)" +
         joint.substr(0, joint.find('|')) + R"(
<socket_parent_frame>p</socket_parent_frame><socket_child_frame>c</socket_child_frame><frames>
<PhysicalOffsetFrame name="p"><socket_parent>)" +
         parent + R"(</socket_parent><translation>0.1 -0.2 0.3</translation>
<orientation>0.2 0.4 -0.3</orientation></PhysicalOffsetFrame>
<PhysicalOffsetFrame name="c"><socket_parent>)" +
         child + R"(</socket_parent><translation>-0.2 0.05 0.1</translation>
<orientation>-0.5 0.1 0.7</orientation></PhysicalOffsetFrame></frames>)" +
         joint.substr(joint.find('|') + 1) + "</objects></JointSet></Model></OpenSimDocument>";
}

std::string coordinates(int count) {
  std::string text = "<coordinates>";
  for (int i = 0; i < count; ++i) text += "<Coordinate name=\"q" + std::to_string(i) + "\"/>";
  return text + "</coordinates>";
}

std::string custom() {
  const auto axis = [](const char* slot, const char* q, const char* direction) {
    return std::string("<TransformAxis name=\"") + slot + "\"><coordinates>" + q + "</coordinates><axis>" + direction +
           "</axis><function><LinearFunction><coefficients>1 0.1</coefficients></LinearFunction>"
           "</function></TransformAxis>";
  };
  return "<CustomJoint name=\"j\">|" + coordinates(4) + "<SpatialTransform>" + axis("rotation1", "q0", "0 0.6 0.8") +
         axis("rotation2", "q1", "1 0 0") + axis("rotation3", "q2", "0 0 1") + axis("translation2", "q3", "0 1 0") +
         "</SpatialTransform></CustomJoint>";
}

// The other way round the same joint gives the inverse pose.
TEST(OrientJoints, AJointDrawnTowardsGroundMakesTheInversePose) {
  const std::string joints[] = {"<PinJoint name=\"j\">|" + coordinates(1) + "</PinJoint>",
                                "<SliderJoint name=\"j\">|" + coordinates(1) + "</SliderJoint>",
                                "<BallJoint name=\"j\">|" + coordinates(3) + "</BallJoint>",
                                "<PlanarJoint name=\"j\">|" + coordinates(3) + "</PlanarJoint>",
                                "<FreeJoint name=\"j\">|" + coordinates(6) + "</FreeJoint>",
                                custom()};
  for (const std::string& joint : joints) {
    const BodyModel outward = parse_osim(one_body(joint, "/ground", "/bodyset/b"), "m.osim");
    const BodyModel inward = parse_osim(one_body(joint, "/bodyset/b", "/ground"), "m.osim");
    const auto n = static_cast<Eigen::Index>(outward.coordinates.size());
    ASSERT_EQ(inward.coordinates.size(), outward.coordinates.size());
    const Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(n, 0.3, -0.6);
    const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(n, -1.0, 0.7);
    BodyState a = make_state(outward), b = make_state(inward);
    compute_poses(outward, q, a);
    compute_poses(inward, q, b);
    const Pose expected = a.X_GB[1].inverse();
    EXPECT_LT((b.X_GB[1].R - expected.R).norm(), 1e-14) << joint;
    EXPECT_LT((b.X_GB[1].p - expected.p).norm(), 1e-14) << joint;
    // Velocities are those of the poses: central differences.
    compute_velocities(inward, u, b);
    const Vec3 v = b.v_GB[1];
    BodyState s = make_state(inward);
    compute_poses(inward, q + 1e-6 * u, s);
    const Vec3 ahead = s.X_GB[1].p;
    compute_poses(inward, q - 1e-6 * u, s);
    EXPECT_LT((v - (ahead - s.X_GB[1].p) / 2e-6).norm(), 1e-9) << joint;
    // And the mass matrix that of the kinetic energy.
    const Vec3 v_cm = v + b.w_GB[1].cross(b.X_GB[1].R * inward.bodies[1].p_BBcm_B);
    const Vec3 w_B = b.X_GB[1].R.transpose() * b.w_GB[1];
    const double energy = v_cm.squaredNorm() + 0.5 * w_B.dot(inward.bodies[1].I_BBcm_B * w_B);
    EXPECT_NEAR(0.5 * u.dot(mass_matrix(inward, q, b) * u), energy, 1e-13) << joint;
  }
}

TEST(OrientJoints, SaysWhatWasTurnedAndWhatCannotBe) {
  const BodyModel m = parse_osim(
      one_body("<PinJoint name=\"j\">|" + coordinates(1) + "</PinJoint>", "/bodyset/b", "/ground"), "m.osim");
  ASSERT_FALSE(m.notes.empty());
  EXPECT_NE(m.notes.back().says.find("turned round"), std::string::npos);
  EXPECT_THROW((void)parse_osim(one_body("<EllipsoidJoint name=\"j\"><radii_x_y_z>1 1 1"
                                         "</radii_x_y_z>|" +
                                             coordinates(3) + "</EllipsoidJoint>",
                                         "/bodyset/b", "/ground"),
                                "m.osim"),
               ModelError);
}

TEST(OrientJoints, AReversedJointOfOldDocumentsIsTheInverse) {
  const auto pose = [](const char* reverse) {
    const BodyModel m = parse_osim(std::string(R"(<OpenSimDocument Version="20302"><Model name="m"><BodySet><objects>
<Body name="ground"><mass>0</mass></Body><Body name="b"><mass>1</mass><Joint><CustomJoint name="j">
<parent_body>ground</parent_body><location_in_parent>0.1 0.2 0.3</location_in_parent>
<location>0 0.5 0</location><reverse>)") +
                                       reverse + R"(</reverse><CoordinateSet><objects><Coordinate name="q">
<default_value>0.4</default_value></Coordinate></objects></CoordinateSet><SpatialTransform>
<TransformAxis name="rotation1"><coordinates>q</coordinates><axis>0 0 1</axis></TransformAxis>
<TransformAxis name="rotation2"><axis>0 1 0</axis></TransformAxis>
<TransformAxis name="rotation3"><axis>1 0 0</axis></TransformAxis></SpatialTransform></CustomJoint>
</Joint></Body></objects></BodySet></Model></OpenSimDocument>)",
                                   "m.osim");
    BodyState s = make_state(m);
    compute_poses(m, m.default_q(), s);
    return s.X_GB[1];
  };
  // Turned the other way about the same places.
  EXPECT_NEAR(pose("false").R(1, 0), std::sin(0.4), 1e-15);
  EXPECT_NEAR(pose("true").R(1, 0), -std::sin(0.4), 1e-15);
  const Vec3 at_joint = pose("true") * Vec3(0.0, 0.5, 0.0);
  EXPECT_LT((at_joint - Vec3(0.1, 0.2, 0.3)).norm(), 1e-15);
}

}  // namespace
}  // namespace myoid::body
