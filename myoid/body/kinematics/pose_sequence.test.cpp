#include "myoid/body/kinematics/pose_sequence.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/body/kinematics/joint_angles.h"
#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/kinematics/limb_fit.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/recording/trc_reader.h"

#include "tests/support/data_folder.h"
#include "tests/support/marker_pairs.h"

namespace myoid::body {
namespace {

std::string coordinate_xml(const std::string& name, double lower, double upper, bool clamped) {
  return fmt::format("<Coordinate name=\"{}\"><range>{} {}</range><clamped>{}</clamped></Coordinate>", name, lower,
                     upper, clamped);
}

std::string rotation_xml(int number, const std::string& name, const std::string& axis) {
  return fmt::format(
      "<TransformAxis name=\"rotation{}\"><coordinates>{}</coordinates><axis>{}</axis>"
      "<LinearFunction><coefficients>1 0</coefficients></LinearFunction></TransformAxis>",
      number, name, axis);
}

std::string offset_xml(const std::string& name, const std::string& parent, const std::string& place) {
  return fmt::format(
      "<frames><PhysicalOffsetFrame name=\"{}\"><socket_parent>{}</socket_parent>"
      "<translation>{}</translation></PhysicalOffsetFrame></frames>",
      name, parent, place);
}

std::string marker_xml(const std::string& name, const std::string& body, const std::string& place) {
  return fmt::format(
      "<Marker name=\"{}\"><socket_parent_frame>/bodyset/{}</socket_parent_frame><location>{}</location></Marker>",
      name, body, place);
}

/// An arm on the trunk: three angles of the shoulder, the last about the upper arm's length and to 90 degrees both
/// ways, elbow from 0 to 150 degrees, turn of the forearm. Two markers on each segment.
std::string arm_joints(const std::string& side, double z) {
  return fmt::format(
             "<CustomJoint name=\"shoulder{0}\"><socket_parent_frame>f{0}</socket_parent_frame>"
             "<socket_child_frame>/bodyset/humerus{0}</socket_child_frame><coordinates>{1}{2}{3}</coordinates>{4}"
             "<SpatialTransform>{5}{6}{7}</SpatialTransform></CustomJoint>",
             side, coordinate_xml("flexion" + side, -1.5, 2.6, true),
             coordinate_xml("abduction" + side, -2.0, 1.5, true),
             coordinate_xml("turn" + side, -0.5 * kPi, 0.5 * kPi, true),
             offset_xml("f" + side, "/bodyset/trunk", fmt::format("0 0.4 {}", z)),
             rotation_xml(1, "flexion" + side, "0 0 1"), rotation_xml(2, "abduction" + side, "1 0 0"),
             rotation_xml(3, "turn" + side, "0 1 0")) +
         fmt::format(
             "<PinJoint name=\"elbow{0}\"><socket_parent_frame>e{0}</socket_parent_frame>"
             "<socket_child_frame>/bodyset/ulna{0}</socket_child_frame><coordinates>{1}</coordinates>{2}</PinJoint>",
             side, coordinate_xml("elbow" + side, 0.0, 2.62, true),
             offset_xml("e" + side, "/bodyset/humerus" + side, "0 -0.3 0"));
}

std::string arm_markers(const std::string& side) {
  return marker_xml("u1" + side, "humerus" + side, "0.03 -0.12 0.03") +
         marker_xml("u2" + side, "humerus" + side, "0 -0.29 0.04") +
         marker_xml("w1" + side, "ulna" + side, "0.03 -0.24 0.02") +
         marker_xml("w2" + side, "ulna" + side, "-0.02 -0.25 -0.03");
}

/// A floating trunk with four markers and two arms.
body::BodyModel person() {
  const auto body = [](const std::string& name) {
    return fmt::format("<Body name=\"{}\"><mass>1</mass><inertia>0.1 0.1 0.1 0 0 0</inertia></Body>", name);
  };
  return body::parse_osim(
      "<?xml version=\"1.0\"?><OpenSimDocument Version=\"40000\"><Model name=\"person\"><Ground name=\"ground\"/>"
      "<BodySet name=\"b\"><objects>" +
          body("trunk") + body("humerus_r") + body("ulna_r") + body("humerus_l") + body("ulna_l") +
          "</objects></BodySet><JointSet name=\"j\"><objects><FreeJoint name=\"root\">"
          "<socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/trunk</socket_child_frame>"
          "<coordinates><Coordinate name=\"r1\"/><Coordinate name=\"r2\"/><Coordinate name=\"r3\"/>"
          "<Coordinate name=\"t1\"/><Coordinate name=\"t2\"/><Coordinate name=\"t3\"/></coordinates></FreeJoint>" +
          arm_joints("_r", 0.18) + arm_joints("_l", -0.18) + "</objects></JointSet><MarkerSet name=\"m\"><objects>" +
          marker_xml("c7", "trunk", "-0.08 0.45 0") + marker_xml("clav", "trunk", "0.08 0.4 0.01") +
          marker_xml("asis_r", "trunk", "0.1 0 0.12") + marker_xml("asis_l", "trunk", "0.1 0 -0.12") +
          arm_markers("_r") + arm_markers("_l") + "</objects></MarkerSet></Model></OpenSimDocument>",
      "person.osim");
}

using Draws = std::mt19937_64;

double draw(Draws& random, double lower, double upper) {
  return lower + (upper - lower) * static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Elbows from 0 to 140 degrees, upper arms turned by 90 degrees both ways, the trunk anywhere.
Eigen::VectorXd any_posture(const body::BodyModel& m, Draws& random) {
  Eigen::VectorXd q(static_cast<Eigen::Index>(m.coordinates.size()));
  for (std::size_t c = 0; c < m.coordinates.size(); ++c) {
    const body::Coordinate& of = m.coordinates[c];
    double& value = q[static_cast<Eigen::Index>(c)];
    value = draw(random, of.clamped ? of.lower : -0.5, of.clamped ? of.upper : 0.5);
    if (of.name.starts_with("elbow")) value = draw(random, 0.0, 140.0 / 180.0 * kPi);
  }
  return q;
}

/// A slow movement between the postures of two random draws.
Eigen::MatrixXd movement(const body::BodyModel& m, Draws& random, Eigen::Index frames) {
  const Eigen::VectorXd a = any_posture(m, random), b = any_posture(m, random);
  Eigen::MatrixXd q(frames, a.size());
  for (Eigen::Index i = 0; i < frames; ++i) {
    for (Eigen::Index c = 0; c < a.size(); ++c) {
      const double phase = 2.0 * kPi * static_cast<double>(i) / 100.0 + 0.7 * static_cast<double>(c);
      q(i, c) = a[c] + (b[c] - a[c]) * (0.5 + 0.5 * std::sin(phase));
    }
  }
  return q;
}

/// Markers of postures, each off by an error of its own (skin) and by noise a fifth as large.
MarkerSeries made_markers(const body::BodyModel& m, const Eigen::MatrixXd& q, double error_m, Draws& random) {
  MarkerSeries series;
  series.time_s = Eigen::VectorXd::LinSpaced(q.rows(), 0.0, 0.01 * static_cast<double>(q.rows() - 1));
  series.positions_m.resize(q.rows(), static_cast<Eigen::Index>(3 * m.markers.size()));
  const auto off = [&](double size) -> Vec3 {
    return size * Vec3{draw(random, -1, 1), draw(random, -1, 1), draw(random, -1, 1)};
  };
  std::vector<Vec3> skin;
  for (const body::Marker& of : m.markers) {
    series.names.push_back(of.name);
    skin.push_back(off(1.7 * error_m));
  }
  body::BodyState state = body::make_state(m);
  for (Eigen::Index frame = 0; frame < q.rows(); ++frame) {
    body::compute_poses(m, q.row(frame).transpose(), state);
    for (std::size_t i = 0; i < m.markers.size(); ++i) {
      const Vec3 p = state.X_GB[static_cast<std::size_t>(m.markers[i].body)] * m.markers[i].p_BM;
      series.positions_m.block<1, 3>(frame, static_cast<Eigen::Index>(3 * i)) =
          (p + skin[i] + off(0.34 * error_m)).transpose();
    }
  }
  return series;
}

std::vector<PoseFit::Pair> every_marker(const body::BodyModel& m) {
  std::vector<PoseFit::Pair> pairs;
  for (std::size_t i = 0; i < m.markers.size(); ++i) pairs.push_back({i, static_cast<Eigen::Index>(i), 1.0});
  return pairs;
}

/// Returns J of a frame after the best of so many searches from random postures, every other one with the trunk of q.
double best_of_random(const body::BodyModel& m, PoseFit& fit, const Eigen::VectorXd& q, int starts, Draws& random) {
  double best = 0.5 * fit.place(q);
  for (int k = 0; k < starts; ++k) {
    Eigen::VectorXd start = any_posture(m, random);
    if (k % 2 == 0) start.head(6) = q.head(6);
    best = std::min(best, 0.5 * fit.solve(start).cost);
  }
  return best;
}

int frames_to_judge() {
  const char* text = std::getenv("MYOID_IK_JUDGE");  // a larger number by hand
  return text != nullptr ? std::max(1, std::atoi(text)) : 8;
}

unsigned movements_to_judge() {
  const char* text = std::getenv("MYOID_IK_MOVEMENTS");  // a larger number by hand
  return text != nullptr ? static_cast<unsigned>(std::max(1, std::atoi(text))) : 6;
}

TEST(PoseSequence, FindsEachOfManyUnrelatedPosturesThatFitExactly) {
  const body::BodyModel m = person();
  Draws random(7);
  Eigen::MatrixXd q(60, static_cast<Eigen::Index>(m.coordinates.size()));
  for (Eigen::Index i = 0; i < q.rows(); ++i) q.row(i) = any_posture(m, random).transpose();
  const IkResult result = inverse_kinematics(m, made_markers(m, q, 0.0, random));
  // J of exact markers is 0; round-off leaves the square of nanometers.
  EXPECT_LT(*std::max_element(result.objective.begin(), result.objective.end()), 1e-12);
}

TEST(PoseSequence, IsNeverAboveTheTruthNorAboveTwoHundredRandomStarts) {
  const body::BodyModel m = person();
  for (unsigned seed = 1; seed <= movements_to_judge(); ++seed) {
    Draws random(seed);
    const Eigen::MatrixXd truth = movement(m, random, 200);
    const MarkerSeries markers = made_markers(m, truth, 0.01, random);
    const IkResult result = inverse_kinematics(m, markers);
    const IkOptions options;
    PoseFit fit(m, options, every_marker(m));
    for (Eigen::Index i = 0; i < truth.rows(); ++i) {
      fit.set_targets(markers, i);
      const double excess = result.objective[static_cast<std::size_t>(i)] - 0.5 * fit.place(truth.row(i).transpose());
      EXPECT_LT(excess, 1e-6) << "movement " << seed << ", frame " << i;
    }
    for (int k = 0; k < frames_to_judge(); ++k) {
      const Eigen::Index i = (2 * k + 1) * truth.rows() / (2 * frames_to_judge());
      fit.set_targets(markers, i);
      const Eigen::VectorXd found = result.q.values().row(i).transpose();
      const double best = best_of_random(m, fit, found, 200, random);
      EXPECT_LE(result.objective[static_cast<std::size_t>(i)], best + 1e-6) << "movement " << seed << ", frame " << i;
    }
  }
}

/// A chain of two hinges in a plane with a marker at its tip: the elbow may be bent either way.
body::BodyModel two_hinges() {
  return body::parse_osim(
      "<?xml version=\"1.0\"?><OpenSimDocument Version=\"40000\"><Model name=\"chain\"><Ground name=\"ground\"/>"
      "<BodySet name=\"b\"><objects><Body name=\"one\"><mass>1</mass></Body><Body name=\"two\"><mass>1</mass></Body>"
      "</objects></BodySet><JointSet name=\"j\"><objects><PinJoint name=\"j1\">"
      "<socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/one</socket_child_frame>"
      "<coordinates>" +
          coordinate_xml("q1", -3.0, 3.0, true) +
          "</coordinates></PinJoint><PinJoint name=\"j2\"><socket_parent_frame>f</socket_parent_frame>"
          "<socket_child_frame>/bodyset/two</socket_child_frame><coordinates>" +
          coordinate_xml("q2", -2.5, 2.5, true) + "</coordinates>" + offset_xml("f", "/bodyset/one", "0.3 0 0") +
          "</PinJoint></objects></JointSet><MarkerSet name=\"m\"><objects>" + marker_xml("elbow", "one", "0.3 0 0") +
          marker_xml("tip", "two", "0.3 0 0") + "</objects></MarkerSet></Model></OpenSimDocument>",
      "chain.osim");
}

TEST(PoseSequence, StaysInOneOfTwoMinimaThatFitAlike) {
  // The elbow's marker, of little weight, lies on the line from the shoulder to the tip: both ways of bending fit
  // alike. Noise makes now the one, now the other better by some ten-thousandths.
  const body::BodyModel m = two_hinges();
  Draws random(5);
  MarkerSeries markers;
  markers.time_s = Eigen::VectorXd::LinSpaced(200, 0.0, 1.99);
  markers.names = {"elbow", "tip"};
  markers.positions_m.setZero(200, 6);
  for (Eigen::Index i = 0; i < 200; ++i) {
    const double turn = 0.3 * std::sin(0.05 * static_cast<double>(i));
    const Vec3 along(std::cos(turn), std::sin(turn), 0.0), across(-along[1], along[0], 0.0);
    markers.positions_m.row(i).head(3) = 0.22 * along + 2e-5 * draw(random, -1, 1) * across;
    markers.positions_m.row(i).tail(3) = 0.44 * along;
  }
  const IkResult result = inverse_kinematics(m, markers, {.marker_weights = {{"elbow", 0.05}}});
  const Eigen::VectorXd elbow = result.q.column("q2");
  EXPECT_GT(elbow.cwiseAbs().minCoeff(), 0.3);
  EXPECT_EQ((elbow.array() > 0.0).count() % 200, 0) << "the elbow changes sides";
}

TEST(PoseSequence, ChangesSidesOnceWhereAnotherMinimumBecomesClearlyBetter) {
  const body::BodyModel m = two_hinges();
  MarkerSeries markers;
  markers.time_s = Eigen::VectorXd::LinSpaced(200, 0.0, 1.99);
  markers.names = {"elbow", "tip"};
  markers.positions_m.setZero(200, 6);
  for (Eigen::Index i = 0; i < 200; ++i) {
    markers.positions_m.row(i) << 0.22, 1e-4 * (static_cast<double>(i) - 90.5), 0.0, 0.44, 0.0, 0.0;
  }
  const IkResult result = inverse_kinematics(m, markers, {.marker_weights = {{"elbow", 0.05}}});
  const Eigen::VectorXd q1 = result.q.column("q1");
  for (Eigen::Index i = 0; i < 200; ++i) {
    // The elbow stands 0.2 m beside its marker: 1e-4 m a frame change J by 0.2 % from one side to the other, and either
    // side may stand up to 1 %.
    if (std::abs(static_cast<double>(i) - 90.5) > 8.0) {
      EXPECT_EQ(q1[i] > 0.0, i > 90) << "frame " << i;
    }
  }
  EXPECT_EQ(((q1.tail(199).array() > 0.0) != (q1.head(199).array() > 0.0)).count(), 1);
}

TEST(PoseSequence, IsNeverAboveOpenSimsOwnMotions) {
  const auto folder = test::data_folder() / "opensim";
  MYOID_REQUIRE_DATA(folder);
  for (const char* name : {"arm26", "gait2354", "rajagopal2016", "wrist"}) {
    const body::BodyModel m = body::read_osim(folder / name / "model.osim");
    const MarkerSeries markers = recording::read_trc(folder / name / "noisy.trc").markers;
    const TimeSeries theirs = recording::read_storage(folder / name / "opensim/ik_noisy.mot").data;
    const IkResult result = inverse_kinematics(m, markers);
    const IkOptions options;
    PoseFit fit(m, options, test::marker_pairs(m, markers));
    ASSERT_EQ(theirs.sample_count(), markers.frame_count());
    for (Eigen::Index i = 0; i < theirs.sample_count(); ++i) {
      Eigen::VectorXd q = m.default_q();
      for (std::size_t c = 0; c < m.coordinates.size(); ++c) {
        const double unit = m.coordinates[c].motion == body::MotionType::rotational ? kDegree : 1.0;
        if (const auto column = theirs.find(m.coordinates[c].name))
          q[static_cast<Eigen::Index>(c)] = unit * theirs.values()(i, *column);
      }
      fit.set_targets(markers, i);
      EXPECT_LE(result.objective[static_cast<std::size_t>(i)], 0.5 * fit.place(q) + 1e-6) << name << ", frame " << i;
    }
  }
}

TEST(LimbFit, ALimbBeginsAtTheTrunkAndHasTheMarkersThatItCarries) {
  const body::BodyModel m = person();
  const IkOptions options;
  const auto limbs = limbs_of(m, options, every_marker(m));
  ASSERT_EQ(limbs.size(), 2U);
  for (const auto& limb : limbs) {
    EXPECT_EQ(limb->pairs().size(), 4U);
    EXPECT_EQ(limb->coordinates().size(), 4U);
  }
}

TEST(LimbFit, FindsTheOtherPostureOfALimbFromItsOwnMarkers) {
  const body::BodyModel m = person();
  Eigen::VectorXd truth = m.default_q(), stuck = m.default_q();
  truth[m.coordinate_index("turn_r")] = 1.2;
  truth[m.coordinate_index("elbow_r")] = 1.5;
  stuck[m.coordinate_index("turn_r")] = -0.5 * kPi;
  Draws random(1);
  const MarkerSeries markers = made_markers(m, truth.transpose(), 0.0, random);
  const IkOptions options;
  PoseFit whole(m, options, every_marker(m));
  whole.set_targets(markers, 0);
  (void)whole.place(stuck);
  for (const auto& limb : limbs_of(m, options, every_marker(m))) {
    limb->stand(whole, stuck, markers, 0);
    const auto others = limb->other_postures(stuck, 1.0);
    const bool right = limb->coordinates().front() == m.coordinate_index("flexion_r");
    ASSERT_EQ(others.empty(), !right) << "the left arm fits";
    if (right) {
      EXPECT_LT((others.front() - truth).cwiseAbs().maxCoeff(), 1e-6);
    }
  }
}

TEST(JointAngles, TwinsPoseTheChildAlikeWithinTheRanges) {
  body::BodyModel m = person();
  const body::Joint* root = nullptr;
  for (const body::Joint& joint : m.joints)
    if (joint.parent == 0) root = &joint;
  ASSERT_NE(root, nullptr);
  Eigen::VectorXd q = m.default_q();
  q.head(3) << 0.4, -0.3, 0.8;
  const std::vector<Eigen::VectorXd> twins = twin_angles(m, *root, q);
  ASSERT_EQ(twins.size(), 1U);
  // Angles about three axes at right angles: (q1 + pi, pi - q2, q3 + pi), each within a turn.
  EXPECT_NEAR(std::remainder(twins[0][0] - (0.4 + kPi), 2.0 * kPi), 0.0, 1e-12);
  EXPECT_NEAR(std::remainder(twins[0][1] - (kPi + 0.3), 2.0 * kPi), 0.0, 1e-12);
  EXPECT_NEAR(std::remainder(twins[0][2] - (0.8 + kPi), 2.0 * kPi), 0.0, 1e-12);
  m.coordinates[0].clamped = true;
  m.coordinates[0].lower = -1.0;
  m.coordinates[0].upper = 1.0;
  EXPECT_TRUE(twin_angles(m, *root, q).empty());
}

TEST(CoordinatesAtEnds, AreThoseThatLieThereInAQuarterOfTheFrames) {
  const body::BodyModel m = person();
  Eigen::MatrixXd q = Eigen::MatrixXd::Constant(100, static_cast<Eigen::Index>(m.coordinates.size()), 0.5);
  q.col(m.coordinate_index("turn_r")).setConstant(0.5 * kPi);
  q.col(m.coordinate_index("elbow_l")).head(30).setZero();
  q.col(m.coordinate_index("elbow_r")).head(20).setZero();
  std::vector<Channel> channels;
  for (const body::Coordinate& c : m.coordinates) channels.push_back({c.name, Unit::radian});
  const TimeSeries motion(Eigen::VectorXd::LinSpaced(100, 0.0, 0.99), channels, q);
  const std::vector<CoordinateAtEnd> list = coordinates_at_ends(m, motion);
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].coordinate, "turn_r");
  EXPECT_DOUBLE_EQ(list[0].end, m.coordinates[static_cast<std::size_t>(m.coordinate_index("turn_r"))].upper);
  EXPECT_DOUBLE_EQ(list[0].share, 1.0);
  EXPECT_EQ(list[1].coordinate, "elbow_l");
  EXPECT_DOUBLE_EQ(list[1].end, 0.0);
  EXPECT_DOUBLE_EQ(list[1].share, 0.3);
  EXPECT_EQ(remarks_on_ends(m, motion).size(), 1U);
  EXPECT_EQ(remarks_on_ends(m, motion)[0].about, "turn_r, elbow_l");
}

}  // namespace
}  // namespace myoid::body
