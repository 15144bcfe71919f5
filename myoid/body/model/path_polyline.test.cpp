#include "myoid/body/model/path_polyline.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "myoid/body/model/path_survey.h"
#include "myoid/body/osim/osim_reader.h"

#include "tests/support/data_folder.h"

namespace myoid::body {
namespace {

double length_of_line(const std::vector<Vec3>& line) {
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

/// A path in ground that lies on an object at its origin.
BodyModel over(const WrapObject& object, const Vec3& from, const Vec3& to) {
  BodyModel m;
  m.bodies = {{.name = "ground"}};
  m.wrap_objects = {object};
  Muscle muscle;
  muscle.name = "m";
  muscle.path.points = {{.name = "a", .p_BP = from}, {.name = "b", .p_BP = to}};
  muscle.path.wraps = {{.wrap_object = 0}};
  m.muscles = {muscle};
  return finalize(m);
}

struct Drawn {
  double length_m = 0.0;  ///< Of the path.
  double arc_m = 0.0;     ///< Of its part on wrap objects.
  double coarse_m = 0.0;  ///< What the line lacks with turns of 10 degrees.
  double fine_m = 0.0;    ///< With a quarter of that.
  std::vector<Vec3> line;
};

Drawn draw(const BodyModel& m, int muscle, const BodyState& state) {
  PathWorkspace workspace;
  PathResult result;
  const MusclePath& path = m.muscles[static_cast<std::size_t>(muscle)].path;
  compute_path(m, path, state, workspace, result);
  Drawn drawn;
  drawn.length_m = result.length_m;
  for (const PathStation& s : workspace.stations) drawn.arc_m += s.on_wrap_after ? s.arc_after_m : 0;
  drawn.line = path_polyline(m, path, state, workspace.stations);
  drawn.coarse_m = result.length_m - length_of_line(drawn.line);
  drawn.fine_m = result.length_m - length_of_line(path_polyline(m, path, state, workspace.stations, 2.5 * kDegree));
  return drawn;
}

Drawn draw(const BodyModel& m) {
  BodyState state = make_state(m);
  compute_poses(m, Eigen::VectorXd(0), state);
  return draw(m, 0, state);
}

const Vec3 kFrom(-0.08, 0.006, 0.02);
const Vec3 kTo(0.09, 0.002, -0.03);

std::vector<BodyModel> every_shape() {
  return {over({.name = "c", .shape = CylinderShape{0.03, 1.0}}, kFrom, kTo),
          over({.name = "far", .quadrant = -2, .shape = CylinderShape{0.03, 1.0}}, kFrom, kTo),
          over({.name = "s", .shape = SphereShape{0.04}}, kFrom, kTo),
          over({.name = "e", .shape = EllipsoidShape{{0.03, 0.05, 0.07}}}, kFrom, kTo),
          over({.name = "t", .shape = TorusShape{0.01, 0.04}}, Vec3(0.06, 0.0, 0.08), Vec3(0.065, 0.01, -0.08))};
}

TEST(PathPolyline, ApproachesThePathsLengthFromBelowWithTheSquareOfTheTurn) {
  for (const BodyModel& m : every_shape()) {
    const Drawn drawn = draw(m);
    const std::string& name = m.wrap_objects[0].name;
    ASSERT_GT(drawn.arc_m, 0.007) << name;
    ASSERT_GT(drawn.line.size(), 5U) << name;
    // A chord is shorter than its arc by turn^2 / 24: 0.13 % for 10 degrees. Steps are no wider,
    // hence at most that; an ellipse's radii of curvature differ along it.
    EXPECT_GT(drawn.coarse_m, 0.0) << name;
    EXPECT_LT(drawn.coarse_m, 0.004 * drawn.arc_m) << name;
    EXPECT_GT(drawn.fine_m, 0.0) << name;
    EXPECT_LT(drawn.fine_m, 0.1 * drawn.coarse_m) << name;  // 1/16 but for whole pieces
  }
}

TEST(PathPolyline, KeepsItsEndsAndLiesOnTheObjectBetweenThem) {
  for (const BodyModel& m : every_shape()) {
    const std::vector<Vec3> line = draw(m).line;
    EXPECT_EQ(line.front(), m.muscles[0].path.points[0].p_BP);
    EXPECT_EQ(line.back(), m.muscles[0].path.points[1].p_BP);
    const WrapObject& object = m.wrap_objects[0];
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      const Vec3& p = line[i];
      if (const auto* c = std::get_if<CylinderShape>(&object.shape)) {
        EXPECT_NEAR(p.head<2>().norm(), c->radius_m, 1e-15);
      }
      if (const auto* s = std::get_if<SphereShape>(&object.shape)) {
        EXPECT_NEAR(p.norm(), s->radius_m, 1e-15);
      }
      if (const auto* e = std::get_if<EllipsoidShape>(&object.shape)) {
        EXPECT_NEAR(p.cwiseQuotient(e->radii_m).norm(), 1.0, 1e-13);
      }
    }
  }
}

TEST(PathPolyline, BendsOnlyWhereItLiesOnAnObjectAndNeverSharply) {
  for (const BodyModel& m : every_shape()) {
    const std::vector<Vec3> line = draw(m).line;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      const Vec3 in = (line[i] - line[i - 1]).normalized();
      const Vec3 out = (line[i + 1] - line[i]).normalized();
      // On the flat side of the ellipsoid 10 degrees of the unit sphere are more in space.
      EXPECT_GT(in.dot(out), std::cos(25.0 * kDegree)) << m.wrap_objects[0].name << " at " << i;
    }
  }
}

TEST(PathPolyline, IsAsLongAsThePathOfEveryMuscleOfPublicModelsInRandomPostures) {
  const auto folder = test::data_folder() / "opensim";
  MYOID_REQUIRE_DATA(folder);
  int arcs = 0;
  for (const char* name : {"arm26", "gait2354", "pathzoo", "rajagopal2016", "wrapzoo"}) {
    const BodyModel m = read_osim(folder / name / "model.osim");
    BodyState state = make_state(m);
    for (std::uint64_t k = 0; k < 40; ++k) {
      compute_poses(m, random_posture(m, 5, k), state);
      for (std::size_t i = 0; i < m.muscles.size(); ++i) {
        const Drawn drawn = draw(m, static_cast<int>(i), state);
        const auto where = [&] { return m.muscles[i].name + " of " + name + std::to_string(k); };
        if (drawn.arc_m > 0.0) ++arcs;
        // Straight pieces to round-off, arcs as above; the ellipsoids here are up to 1 : 10.
        EXPECT_GT(drawn.coarse_m, -1e-9) << where();
        EXPECT_LT(drawn.coarse_m, 0.01 * drawn.arc_m + 1e-12) << where();
        EXPECT_LT(drawn.fine_m, 0.01 / 16.0 * drawn.arc_m + 1e-12) << where();
      }
    }
  }
  EXPECT_GT(arcs, 1000);
}

TEST(PathPolyline, ReachesFromTheFirstToTheLastPointInOpenSimsModeToo) {
  const auto folder = test::data_folder() / "opensim";
  MYOID_REQUIRE_DATA(folder);
  for (const char* name : {"rajagopal2016", "wrapzoo"}) {
    const BodyModel m = read_osim(folder / name / "model.osim", {.compat = kOpenSim452});
    BodyState state = make_state(m);
    for (std::uint64_t k = 0; k < 20; ++k) {
      compute_poses(m, random_posture(m, 5, k), state);
      for (std::size_t i = 0; i < m.muscles.size(); ++i) {
        for (const Vec3& p : draw(m, static_cast<int>(i), state).line) EXPECT_TRUE(p.allFinite());
      }
    }
  }
}

}  // namespace
}  // namespace myoid::body
