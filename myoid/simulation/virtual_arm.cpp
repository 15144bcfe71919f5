#include "myoid/simulation/virtual_arm.h"

#include <utility>

#include "myoid/core/units.h"
#include "myoid/model/arm4.h"
#include "myoid/model/kinematic_tree.h"
#include "myoid/model/planar_elbow.h"
#include "myoid/muscle/hill_muscle.h"

namespace myoid::simulation {
namespace {

model::ArmOptions arm_of(const VirtualSubject& subject) {
  return {.mass_kg = subject.mass_kg,
          .female = subject.sex == "female",
          .upper_arm_length_m = subject.upper_arm_length_m,
          .forearm_length_m = subject.forearm_length_m};
}

}  // namespace

struct VirtualArm::Parts {
  model::PlanarElbow elbow;
  HillSet literature;
  std::string osim;
  Vec3 held_at_m = Vec3::Zero();
  std::vector<std::string> marker_names;
};

VirtualArm::VirtualArm(const VirtualSubject& subject) : parts_(std::make_unique<Parts>()) {
  const model::ArmOptions arm = arm_of(subject);
  parts_->elbow = model::planar_elbow(arm);
  parts_->literature = model::arm4_muscles(arm);
  parts_->osim = model::arm4_osim({.person = arm});
  parts_->held_at_m = model::arm4_held_at_m(arm);
}

VirtualArm::~VirtualArm() = default;
VirtualArm::VirtualArm(VirtualArm&&) noexcept = default;
VirtualArm& VirtualArm::operator=(VirtualArm&&) noexcept = default;

MuscleGeometry VirtualArm::geometry(const Moment& elbow_flexion_rad) const {
  MuscleGeometry result;
  for (std::size_t i = 0; i < kArmMuscles.size(); ++i) {
    const model::MuscleTravel now =
        model::travel(parts_->elbow.muscles[i], elbow_flexion_rad.value);
    result.length_m[i] = now.length_m;
    result.velocity_mps[i] = -now.moment_arm_m * elbow_flexion_rad.first;
    result.moment_arm_m[i] = now.moment_arm_m;
  }
  return result;
}

double VirtualArm::required_torque_nm(const Moment& elbow_flexion_rad,
                                      Plane plane,
                                      double held_mass_kg) const {
  return model::required_torque_nm(parts_->elbow, elbow_flexion_rad.value, elbow_flexion_rad.second,
                                   plane == Plane::vertical ? kStandardGravity : 0.0, held_mass_kg);
}

const std::string& VirtualArm::osim() const { return parts_->osim; }
const HillSet& VirtualArm::literature() const { return parts_->literature; }
const std::vector<std::string>& VirtualArm::marker_names() const { return parts_->marker_names; }
const std::string& VirtualArm::held_body() const {
  static const std::string kBody = "forearm_hand";
  return kBody;
}
Vec3 VirtualArm::held_at_m() const { return parts_->held_at_m; }

Eigen::VectorXd VirtualArm::markers_m(double elbow_flexion_rad, Plane plane) const {
  static_cast<void>(elbow_flexion_rad);
  static_cast<void>(plane);
  return {};
}

PerMuscle full_force_n(const MuscleGeometry& geometry, const HillSet& muscles) {
  PerMuscle result = {};
  for (std::size_t i = 0; i < muscles.size(); ++i) {
    result[i] = muscle::hill_force(1.0, geometry.length_m[i] - muscles[i].tendon_slack_length_m,
                                   geometry.velocity_mps[i], muscles[i]);
  }
  return result;
}

}  // namespace myoid::simulation
