#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/geometry.h"
#include "myoid/muscle/hill_parameters.h"
#include "myoid/simulation/control.h"
#include "myoid/simulation/protocol.h"
#include "myoid/simulation/smooth_motion.h"

namespace myoid::simulation {

using HillSet = std::array<muscle::HillParameters<double>, 4>;  ///< In the order of kArmMuscles.

/// The muscles at one angle and speed of the elbow.
struct MuscleGeometry {
  PerMuscle length_m = {};      ///< Of muscle and tendon.
  PerMuscle velocity_mps = {};  ///< Of both, positive when lengthening.
  PerMuscle moment_arm_m = {};
};

/// The skeleton of one virtual subject: the built-in arm with the subject's segments. Muscle
/// parameters are separate, since they are what is drawn.
class VirtualArm {
 public:
  explicit VirtualArm(const VirtualSubject& subject);
  ~VirtualArm();
  VirtualArm(VirtualArm&&) noexcept;
  VirtualArm& operator=(VirtualArm&&) noexcept;

  [[nodiscard]] MuscleGeometry geometry(const Moment& elbow_flexion_rad) const;

  /// Torque about the elbow that the motion requires of muscles and dynamometer together [N m].
  [[nodiscard]] double required_torque_nm(const Moment& elbow_flexion_rad,
                                          Plane plane,
                                          double held_mass_kg) const;

  /// Model file of this subject with the literature's muscle parameters.
  [[nodiscard]] const std::string& osim() const;
  [[nodiscard]] const HillSet& literature() const;

  [[nodiscard]] const std::vector<std::string>& marker_names() const;
  /// Positions in ground: a row per angle, x y z of one marker after the other [m].
  [[nodiscard]] Eigen::MatrixXd markers_m(
      const Eigen::Ref<const Eigen::VectorXd>& elbow_flexion_rad, Plane plane) const;

  [[nodiscard]] const std::string& held_body() const;
  [[nodiscard]] Vec3 held_at_m() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Force of each muscle at full activation [N], f_l f_v F_max, with a rigid tendon:
/// l_m = l_mt - l_ts.
[[nodiscard]] PerMuscle full_force_n(const MuscleGeometry& geometry, const HillSet& muscles);

}  // namespace myoid::simulation
