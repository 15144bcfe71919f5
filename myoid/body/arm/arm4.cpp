#include "myoid/body/arm/arm4.h"

#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "myoid/muscle/literature.h"

namespace myoid::body {
namespace {

constexpr double kTrunkHeight_m = 1.40;
constexpr double kShoulderOffset_m = 0.17;
constexpr double kElbowHigh_rad = 150.0 * kDegree;

std::string triple(const Vec3& v) { return fmt::format("{} {} {}", v.x(), v.y(), v.z()); }

std::string body(std::string_view name, double mass_kg, const Vec3& center_m, const Vec3& I_cm) {
  return fmt::format(
      "        <Body name=\"{}\"><mass>{}</mass><mass_center>{}</mass_center>"
      "<inertia>{} 0 0 0</inertia></Body>\n",
      name, mass_kg, triple(center_m), triple(I_cm));
}

struct CoordinateText {
  std::string_view name;
  Vec3 axis;
  double default_value;
  double lower;
  double upper;
  bool locked;
};

/// Returns the frames of a joint, "<body>_offset"; the child's is that of its body.
std::string frames(std::string_view parent, std::string_view child, const Vec3& p_PF_m) {
  return fmt::format(
      "          <frames>\n"
      "            <PhysicalOffsetFrame name=\"{0}_offset\"><socket_parent>{1}</socket_parent>"
      "<translation>{2}</translation><orientation>0 0 0</orientation></PhysicalOffsetFrame>\n"
      "            <PhysicalOffsetFrame name=\"{3}_offset\"><socket_parent>/bodyset/{3}</socket_parent>"
      "<translation>0 0 0</translation><orientation>0 0 0</orientation></PhysicalOffsetFrame>\n"
      "          </frames>\n",
      parent, parent == "ground" ? std::string("/ground") : fmt::format("/bodyset/{}", parent), triple(p_PF_m), child);
}

/// Returns a joint of up to three rotations, then translations along x, y, z if `translations`.
std::string joint(std::string_view name,
                  std::string_view parent,
                  std::string_view child,
                  const Vec3& p_PF_m,
                  const std::vector<CoordinateText>& rotations,
                  const std::vector<CoordinateText>& translations = {}) {
  std::string coordinates;
  std::string axes;
  const auto add = [&](const std::vector<CoordinateText>& list, std::string_view kind) {
    Vec3 last_axis = Vec3::UnitZ();
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 axis = Vec3::Unit(static_cast<Eigen::Index>(k));
      std::string use = "<coordinates></coordinates>";
      std::string function = "<Constant name=\"function\"><value>0</value></Constant>";
      if (k < list.size()) {
        const CoordinateText& c = list[k];
        axis = c.axis;
        use = fmt::format("<coordinates>{}</coordinates>", c.name);
        function = "<LinearFunction name=\"function\"><coefficients>1 0</coefficients></LinearFunction>";
        coordinates += fmt::format(
            "            <Coordinate name=\"{}\"><default_value>{}</default_value>"
            "<range>{} {}</range><clamped>true</clamped><locked>{}</locked></Coordinate>\n",
            c.name, c.default_value, c.lower, c.upper, c.locked ? "true" : "false");
      } else if (kind == "rotation") {
        // Unused axes must differ from the used ones: permute the last axis.
        axis = Vec3(last_axis.z(), last_axis.x(), last_axis.y());
      }
      last_axis = axis;
      axes += fmt::format("            <TransformAxis name=\"{}{}\">{}<axis>{}</axis>{}</TransformAxis>\n", kind, k + 1,
                          use, triple(axis), function);
    }
  };
  add(rotations, "rotation");
  add(translations, "translation");
  return fmt::format(
      "        <CustomJoint name=\"{0}\">\n"
      "          <socket_parent_frame>{1}_offset</socket_parent_frame>\n"
      "          <socket_child_frame>{2}_offset</socket_child_frame>\n"
      "          <coordinates>\n{3}          </coordinates>\n"
      "{4}"
      "          <SpatialTransform>\n{5}          </SpatialTransform>\n"
      "        </CustomJoint>\n",
      name, parent, child, coordinates, frames(parent, child, p_PF_m), axes);
}

std::string weld(std::string_view name, std::string_view parent, std::string_view child, const Vec3& p_PF_m) {
  return fmt::format(
      "        <WeldJoint name=\"{}\">\n"
      "          <socket_parent_frame>{}_offset</socket_parent_frame>\n"
      "          <socket_child_frame>{}_offset</socket_child_frame>\n"
      "{}"
      "        </WeldJoint>\n",
      name, parent, child, frames(parent, child, p_PF_m));
}

std::string point(std::string_view name, std::string_view on, const Vec3& at_m) {
  return fmt::format(
      "                <PathPoint name=\"{}\"><socket_parent_frame>/bodyset/{}"
      "</socket_parent_frame><location>{}</location></PathPoint>\n",
      name, on, triple(at_m));
}

/// Returns a point on the upper arm that slides along it by `slope` per radian of elbow flexion.
std::string sliding_point(std::string_view name, const Vec3& at_m, double slope_mprad) {
  const auto axis = [](char letter, std::string_view function) {
    return fmt::format(
        "<socket_{0}_coordinate>/jointset/elbow/elbow_flexion</socket_{0}_coordinate>"
        "<{0}_location>{1}</{0}_location>",
        letter, function);
  };
  const auto constant = [](double value) { return fmt::format("<Constant><value>{}</value></Constant>", value); };
  return fmt::format(
      "                <MovingPathPoint name=\"{}\"><socket_parent_frame>/bodyset/upper_arm"
      "</socket_parent_frame>{}{}{}</MovingPathPoint>\n",
      name, axis('x', constant(at_m.x())),
      axis('y',
           fmt::format("<LinearFunction><coefficients>{} {}</coefficients></LinearFunction>", slope_mprad, at_m.y())),
      axis('z', constant(at_m.z())));
}

/// Points whose polygon has exactly the length of the planar muscle.
std::string path_points(const PlanarMuscle& muscle, double upper_arm_m, std::string_view insertion_body) {
  const std::string name(muscle.name);
  if (muscle.above_m == 0.0) {  // the triceps, behind the bone
    const double x_m = -muscle.pulley_m;
    const double top_m = -0.1 * upper_arm_m;
    return point(name + "-P1", "upper_arm", Vec3(x_m, top_m, 0.0)) +
           sliding_point(name + "-P2", Vec3(x_m, top_m - muscle.constant_m, 0.0), -muscle.pulley_m);
  }
  // Half of the angle that psi0 lacks to a straight line, on either side of the elbow.
  const double lean_rad = 0.5 * (kPi - muscle.straight_rad);
  const Vec3 up(std::sin(lean_rad), std::cos(lean_rad), 0.0);
  const Vec3 down(std::sin(lean_rad), -std::cos(lean_rad), 0.0);
  const Vec3 elbow(0.0, -upper_arm_m, 0.0);
  // The constant part continues along the line of its segment.
  const bool distal = muscle.name == "BRD";
  std::string points;
  if (!distal) {
    points += point(name + "-P1", "upper_arm", elbow + (muscle.above_m + muscle.constant_m) * up);
  }
  points += point(name + "-P2", "upper_arm", elbow + muscle.above_m * up);
  points += point(name + "-P3", insertion_body, muscle.below_m * down);
  if (distal) {
    points += point(name + "-P4", insertion_body, (muscle.below_m + muscle.constant_m) * down);
  }
  return points;
}

std::string muscle_text(const ArmMuscle& muscle, double upper_arm_m, std::string_view insertion_body) {
  const PlanarMuscle& path = muscle.path;
  const muscle::HillParameters<double>& p = muscle.hill;
  // Thelen's numbers of the same curves: gamma = (l_sh / l0)^2, A_f = V_sh, F_len = V_ml.
  const double width = p.force_length_width_m / p.optimal_fiber_length_m;
  return fmt::format(
      "        <Thelen2003Muscle name=\"{}\">\n"
      "          <GeometryPath name=\"geometrypath\">\n"
      "            <PathPointSet><objects>\n{}            </objects></PathPointSet>\n"
      "          </GeometryPath>\n"
      "          <max_isometric_force>{}</max_isometric_force>\n"
      "          <optimal_fiber_length>{}</optimal_fiber_length>\n"
      "          <tendon_slack_length>{}</tendon_slack_length>\n"
      "          <pennation_angle_at_optimal>{}</pennation_angle_at_optimal>\n"
      "          <max_contraction_velocity>{}</max_contraction_velocity>\n"
      "          <KshapeActive>{}</KshapeActive>\n"
      "          <Af>{}</Af>\n"
      "          <Flen>{}</Flen>\n"
      "        </Thelen2003Muscle>\n",
      path.name, path_points(path, upper_arm_m, insertion_body), p.max_isometric_force_n, p.optimal_fiber_length_m,
      p.tendon_slack_length_m, muscle.pennation_at_optimal_rad, p.max_shortening_speed_mps / p.optimal_fiber_length_m,
      width * width, p.concentric_curvature, p.eccentric_plateau);
}

std::string marker(std::string_view name, std::string_view on, const Vec3& at_m) {
  return fmt::format(
      "        <Marker name=\"{}\"><socket_parent_frame>/bodyset/{}</socket_parent_frame>"
      "<location>{}</location></Marker>\n",
      name, on, triple(at_m));
}

std::string markers(const Arm4Options& options) {
  const double upper_m = options.person.upper_arm_length_m;
  const double forearm_m = options.person.forearm_length_m;
  const double knuckle_m = forearm_m + 0.32 * forearm_m;
  const Vec3 shoulder(0.0, 0.0, kShoulderOffset_m);
  std::string text = marker("c7", "trunk", Vec3(-0.06, 0.06, 0.0)) +
                     marker("sternum", "trunk", Vec3(0.09, -0.03, 0.0)) +
                     marker("r_acromion", "trunk", shoulder + Vec3(0.0, 0.05, 0.0)) +
                     marker("r_upper_arm_front", "upper_arm", Vec3(0.045, -0.45 * upper_m, 0.02)) +
                     marker("r_upper_arm_side", "upper_arm", Vec3(0.0, -0.60 * upper_m, 0.05));
  // Landmarks of the elbow, on the segment that carries them in this recording.
  const std::string_view elbow_on = options.forearm_rotations ? "forearm_hand" : "upper_arm";
  const Vec3 elbow(0.0, options.forearm_rotations ? 0.0 : -upper_m, 0.0);
  text += marker("r_elbow", elbow_on, elbow) + marker("r_elbow_center", elbow_on, elbow) +
          marker("r_epicondyle_lateral", elbow_on, elbow + Vec3(0.0, 0.0, 0.035)) +
          marker("r_epicondyle_medial", elbow_on, elbow - Vec3(0.0, 0.0, 0.035));
  text += marker("r_forearm", "forearm_hand", Vec3(0.04, -0.5 * forearm_m, 0.01)) +
          marker("r_wrist", "forearm_hand", Vec3(0.0, -forearm_m, 0.0)) +
          marker("r_styloid_radial", "forearm_hand", Vec3(0.0, -forearm_m, 0.028)) +
          marker("r_styloid_ulnar", "forearm_hand", Vec3(0.0, -forearm_m, -0.028)) +
          marker("r_hand", "forearm_hand", Vec3(0.02, -knuckle_m, 0.0));
  return text;
}

}  // namespace

std::array<muscle::HillParameters<double>, 4> arm4_muscles(const ArmOptions& options) {
  const PlanarElbow elbow = planar_elbow(options);
  std::array<muscle::HillParameters<double>, 4> result;
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = muscle::literature_parameters(muscle::literature_muscle(elbow.muscles[i].name));
    result[i].tendon_slack_length_m =
        travel(elbow.muscles[i], kArmOptimalAt_rad[i]).length_m - result[i].optimal_fiber_length_m;
  }
  return result;
}

Vec3 arm4_shoulder_rad(bool horizontal) { return horizontal ? Vec3(0.5 * kPi, 0.0, 0.5 * kPi) : Vec3(Vec3::Zero()); }

Vec3 arm4_held_at_m(const ArmOptions& options) { return {0.0, -held_at_m(options), 0.0}; }

std::string arm4_osim(const Arm4Options& options) {
  const PlanarElbow elbow = planar_elbow(options.person);
  const std::array<muscle::HillParameters<double>, 4> parameters = arm4_muscles(options.person);
  std::vector<ArmMuscle> muscles;
  for (std::size_t i = 0; i < parameters.size(); ++i) muscles.push_back({elbow.muscles[i], parameters[i]});
  return arm_osim(options, "arm4", muscles);
}

std::string arm_osim(const Arm4Options& options, std::string_view name, const std::vector<ArmMuscle>& muscles) {
  const SegmentInertia upper = upper_arm(options.person);
  const SegmentInertia forearm = forearm_with_hand(options.person);
  const double upper_m = options.person.upper_arm_length_m;
  const Vec3 shoulder_rad = arm4_shoulder_rad(options.horizontal);
  const bool rotations = options.forearm_rotations;

  std::string bodies = body("trunk", 0.5 * options.person.mass_kg, Vec3(0.0, -0.25, 0.0), Vec3(1.0, 0.5, 1.0));
  bodies += body("upper_arm", upper.mass_kg, Vec3(0.0, -upper.center_m, 0.0), upper.I_cm_kgm2);
  if (rotations) bodies += body("ulna", 1e-6, Vec3::Zero(), Vec3::Constant(1e-9));
  bodies += body("forearm_hand", forearm.mass_kg, Vec3(0.0, -forearm.center_m, 0.0), forearm.I_cm_kgm2);

  const Vec3 base_m(0.0, kTrunkHeight_m, 0.0);
  std::string joints;
  if (rotations) {
    joints += joint("base", "ground", "trunk", base_m, {{"base_heading", Vec3::UnitY(), 0.0, -kPi, kPi, true}},
                    {{"base_tx", Vec3::UnitX(), 0.0, -10.0, 10.0, true},
                     {"base_ty", Vec3::UnitY(), 0.0, -10.0, 10.0, true},
                     {"base_tz", Vec3::UnitZ(), 0.0, -10.0, 10.0, true}});
  } else {
    joints += weld("base", "ground", "trunk", base_m);
  }
  const Vec3 shoulder_m(0.0, 0.0, kShoulderOffset_m);
  if (options.elbow_only) {
    joints += weld("shoulder", "trunk", "upper_arm", shoulder_m);
  } else {
    joints += joint("shoulder", "trunk", "upper_arm", shoulder_m,
                    {{"shoulder_flexion", Vec3::UnitZ(), shoulder_rad.x(), -kPi, kPi, false},
                     {"shoulder_adduction", Vec3::UnitX(), shoulder_rad.y(), -kPi, 0.5 * kPi, false},
                     {"shoulder_rotation", Vec3::UnitY(), shoulder_rad.z(), -kPi, kPi, false}});
  }
  const Vec3 elbow_m(0.0, -upper_m, 0.0);
  joints += joint("elbow", "upper_arm", rotations ? "ulna" : "forearm_hand", elbow_m,
                  {{"elbow_flexion", Vec3::UnitZ(), 0.0, -10.0 * kDegree, kElbowHigh_rad, false}});
  if (rotations) {
    joints += joint("forearm", "ulna", "forearm_hand", Vec3::Zero(),
                    {{"elbow_carrying", Vec3::UnitX(), 0.0, -0.6, 0.6, true},
                     {"forearm_rotation", Vec3::UnitY(), 0.0, -kPi, kPi, true}});
  }

  std::string forces;
  for (const ArmMuscle& muscle : muscles) forces += muscle_text(muscle, upper_m, rotations ? "ulna" : "forearm_hand");

  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<OpenSimDocument Version=\"40000\">\n"
      "  <Model name=\"{}\">\n"
      "    <length_units>meters</length_units>\n"
      "    <force_units>N</force_units>\n"
      "    <gravity>0 {} 0</gravity>\n"
      "    <Ground name=\"ground\"></Ground>\n"
      "    <BodySet name=\"bodyset\">\n      <objects>\n{}      </objects>\n    </BodySet>\n"
      "    <JointSet name=\"jointset\">\n      <objects>\n{}      </objects>\n    </JointSet>\n"
      "    <ForceSet name=\"forceset\">\n      <objects>\n{}      </objects>\n    </ForceSet>\n"
      "    <MarkerSet name=\"markerset\">\n      <objects>\n{}      </objects>\n    </MarkerSet>\n"
      "  </Model>\n"
      "</OpenSimDocument>\n",
      name, -kStandardGravity, bodies, joints, forces, markers(options));
}

}  // namespace myoid::body
