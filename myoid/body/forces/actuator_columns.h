#pragma once

#include <string>
#include <vector>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"

namespace myoid::body {

/// A muscle or an actuator of a model that applies its force.
struct Actuator {
  enum class Kind { muscle, coordinate, point, torque, path } kind = Kind::muscle;
  std::size_t index = 0;  ///< Index in the model's list of its kind.
  std::string name;
  double lower = 0.0, upper = 1.0;  ///< Limits of the control.
  double strength = 0.0;            ///< Force at control 1: greatest isometric, or optimal force.
};

/// Returns all actuators of a model, in the order of the file's force set.
[[nodiscard]] std::vector<Actuator> actuators_of(const body::BodyModel& model);

/// The forces of actuators at a posture; one per thread. `compute_poses` (for path().speed_mps also
/// `compute_velocities`) must have been called on the states given.
class ActuatorColumns {
 public:
  explicit ActuatorColumns(const body::BodyModel& model) : model_(&model) {}

  /// Returns the generalized forces at a force of 1 N (1 N m), by every coordinate alone. Valid until the next call.
  [[nodiscard]] const Eigen::VectorXd& of_unit_force(const Actuator& actuator, const body::BodyState& state);
  /// Returns the path of the last muscle or path actuator.
  [[nodiscard]] const body::PathResult& path() const { return path_; }
  /// Adds its wrenches on bodies at this force; a force along a coordinate acts on none. Paths
  /// pull along their straight pieces, at their points and where they leave wrap objects.
  void append_wrenches(const Actuator& actuator,
                       double force,
                       const body::BodyState& state,
                       std::vector<body::BodyWrench>& wrenches);

 private:
  const body::BodyModel* model_;
  Eigen::VectorXd column_;
  body::PathWorkspace workspace_;
  body::PathResult path_;
};

}  // namespace myoid::body
