#include "myoid/lab/virtual_person/virtual_arm.h"

#include <cmath>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::lab {
namespace {

/// Lumps heads into one muscle each: F_max added up, other numbers in the mean by F_max.
void lump(const std::vector<body::ArmHead>& heads, HillSet& muscles) {
  for (std::size_t m = 0; m < muscles.size(); ++m) {
    muscle::HillParameters<double> sum;
    double total_n = 0.0;
    for (const body::ArmHead& head : heads) {
      if (static_cast<std::size_t>(head.lump) == m) total_n += head.hill.max_isometric_force_n;
    }
    for (const body::ArmHead& head : heads) {
      if (static_cast<std::size_t>(head.lump) != m) continue;
      const double share = head.hill.max_isometric_force_n / total_n;
      for (const muscle::HillField& field : muscle::kHillFields)
        sum.*(field.member) += share * (head.hill.*(field.member));
    }
    sum.max_isometric_force_n = total_n;
    muscles[m] = sum;
  }
}

}  // namespace

body::ArmOptions arm_options(const VirtualSubject& subject) {
  return {.mass_kg = subject.mass_kg,
          .female = subject.sex == "female",
          .upper_arm_length_m = subject.upper_arm_length_m,
          .forearm_length_m = subject.forearm_length_m};
}

VirtualArm::VirtualArm(const VirtualSubject& subject, bool seven_heads) {
  const body::ArmOptions person = arm_options(subject);
  elbow = body::planar_elbow(person);
  literature = body::arm4_muscles(person);
  osim = seven_heads ? body::arm7_osim({.person = person}) : body::arm4_osim({.person = person});
  body_model = body::parse_osim(osim, "model.osim");
  held_at_m = body::arm4_held_at_m(person);
  if (!seven_heads) return;
  const auto seven = body::arm7_heads(person);
  heads.assign(seven.begin(), seven.end());
  lump(heads, literature);
}

std::vector<std::string> VirtualArm::marker_names() const {
  std::vector<std::string> names;
  for (const body::Marker& marker : body_model.markers) names.push_back(marker.name);
  return names;
}

std::vector<MarkerSegment> VirtualArm::marker_segments() const {
  std::vector<MarkerSegment> segments;
  for (const body::Marker& marker : body_model.markers) {
    const std::string& body = body_model.bodies[static_cast<std::size_t>(marker.body)].name;
    segments.push_back(body == kHeldBody     ? MarkerSegment::forearm
                       : body == "upper_arm" ? MarkerSegment::upper_arm
                                             : MarkerSegment::trunk);
  }
  return segments;
}

body::MuscleTravel VirtualArm::modelled_travel(std::size_t muscle, double elbow_flexion_rad) const {
  if (heads.empty()) return body::travel(elbow.muscles[muscle], elbow_flexion_rad);
  body::MuscleTravel mean;
  double strength_n = 0.0;
  for (const body::ArmHead& head : heads) {
    if (static_cast<std::size_t>(head.lump) != muscle) continue;
    const body::MuscleTravel now = body::travel(head.path, elbow_flexion_rad);
    const double force_n = head.hill.max_isometric_force_n;
    strength_n += force_n;
    mean.length_m += force_n * now.length_m;
    mean.moment_arm_m += force_n * now.moment_arm_m;
    mean.moment_arm_slope_mprad += force_n * now.moment_arm_slope_mprad;
  }
  return {mean.length_m / strength_n, mean.moment_arm_m / strength_n, mean.moment_arm_slope_mprad / strength_n};
}

MuscleGeometry geometry_of(const std::array<body::PlanarMuscle, 4>& paths, const Moment& elbow_flexion_rad) {
  MuscleGeometry result;
  for (std::size_t i = 0; i < kArmMuscles.size(); ++i) {
    const body::MuscleTravel now = body::travel(paths[i], elbow_flexion_rad.value);
    result.length_m[i] = now.length_m;
    result.velocity_mps[i] = -now.moment_arm_m * elbow_flexion_rad.first;
    result.moment_arm_m[i] = now.moment_arm_m;
  }
  return result;
}

Eigen::MatrixXd VirtualArm::markers_m(const Eigen::Ref<const Eigen::VectorXd>& elbow_flexion_rad,
                                      Plane plane,
                                      const std::vector<MarkerError>& errors) const {
  const body::BodyModel& arm = body_model;
  body::BodyState state = body::make_state(arm);
  Eigen::VectorXd q = arm.default_q();
  const Vec3 shoulder_rad = body::arm4_shoulder_rad(plane == Plane::horizontal);
  const int elbow_coordinate = arm.coordinate_index("elbow_flexion");
  q(arm.coordinate_index("shoulder_flexion")) = shoulder_rad.x();
  q(arm.coordinate_index("shoulder_adduction")) = shoulder_rad.y();
  q(arm.coordinate_index("shoulder_rotation")) = shoulder_rad.z();

  Eigen::MatrixXd result(elbow_flexion_rad.size(), 3 * static_cast<Eigen::Index>(arm.markers.size()));
  for (Eigen::Index k = 0; k < result.rows(); ++k) {
    q(elbow_coordinate) = elbow_flexion_rad(k);
    body::compute_poses(arm, q, state);
    Eigen::Index column = 0;
    for (const body::Marker& marker : arm.markers) {
      const Pose& X_GB = state.X_GB[static_cast<std::size_t>(marker.body)];
      Vec3 p_BM = marker.p_BM;
      if (!errors.empty()) {
        const MarkerError& error = errors[static_cast<std::size_t>(column / 3)];
        p_BM += error.misplaced_m + std::sin(elbow_flexion_rad(k) + error.phase_rad) * error.soft_tissue_m;
      }
      result.block<1, 3>(k, column) = (X_GB * p_BM).transpose();
      column += 3;
    }
  }
  return result;
}

}  // namespace myoid::lab
