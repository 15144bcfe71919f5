#pragma once

#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "myoid/body/model/kinematic_tree.h"

namespace myoid::body {

/// The equations of motion of a tree of bodies at one state: M(q) qddot + C(q, qdot) = tau +
/// gravity. Composite bodies about the ground's origin, from the tips inward:
///
///   M_cd = w_d . L_c + v_d . P_c,   P_c = m v_c + w_c x h,   L_c = h x v_c + I w_c
///
/// with m, h, I mass, first moment and inertia of all bodies that coordinate c carries, and w, v the angular velocity
/// and the velocity of the point at the ground's origin per unit of a coordinate's speed. C from the recursive
/// Newton-Euler method (kinematic_tree.h). Not to be shared by threads.
class TreeDynamics {
 public:
  explicit TreeDynamics(const body::BodyModel& model);

  /// Sets the state for the functions below. Dependent coordinates of couplers follow their
  /// couplers, whatever is given.
  void set(const Eigen::Ref<const Eigen::VectorXd>& q, const Eigen::Ref<const Eigen::VectorXd>& qdot);

  [[nodiscard]] const Eigen::VectorXd& q() const { return q_; }
  [[nodiscard]] const Eigen::VectorXd& qdot() const { return qdot_; }
  [[nodiscard]] const body::BodyState& state() const { return state_; }
  [[nodiscard]] const Eigen::MatrixXd& mass_matrix() const { return mass_; }
  [[nodiscard]] const Eigen::VectorXd& gravity() const { return gravity_; }
  [[nodiscard]] double kinetic_energy_j() const { return kinetic_; }
  [[nodiscard]] double gravity_energy_j() const { return potential_; }

  /// Adds to `tau` the generalized forces of a force and moment on a body.
  void add(const body::BodyWrench& wrench, Eigen::VectorXd& tau) const;

  /// Computes the accelerations under generalized forces `tau` and gravity. Where `prescribed` is not 0, qddot is given
  /// and `device` receives the necessary force; elsewhere device is 0. With couplers qddot = J x + b, where x are the
  /// accelerations of the free independent coordinates, and
  ///   J' M J x = J' (tau + gravity - C - M b).
  /// Returns false if J' M J is not positive definite.
  [[nodiscard]] bool accelerate(const double* tau, const char* prescribed, double* qddot, double* device);

 private:
  /// A body with all that it carries, about the ground's origin.
  struct Composite {
    double mass_kg = 0.0;
    Vec3 moment_kgm = Vec3::Zero();
    Mat3 inertia_kgm2 = Mat3::Zero();
  };

  /// The equations of the free independent coordinates, (J' M J) x = J' balance.
  struct Reduced {
    std::vector<int> free;
    Eigen::MatrixXd jacobian, mass_jacobian, mass;
    Eigen::VectorXd bias, balance, rhs;
    Eigen::LLT<Eigen::MatrixXd> factor{Eigen::MatrixXd::Identity(1, 1)};  ///< Factored: a copy reads its state.
  };

  /// Mass, moment and inertia of each body about the ground's origin, and the potential energy.
  void take_bodies();
  /// Computes the mass matrix and gravity's torques, from the bodies inwards.
  void take_mass_matrix();

  const body::BodyModel* model_;
  body::BodyState state_;
  Eigen::MatrixXd mass_;
  Eigen::VectorXd gravity_, coriolis_, rest_, q_, qdot_;
  /// Couplers, each after the one that determines its independent coordinate.
  std::vector<std::size_t> couplers_;
  std::vector<body::FunctionValue> coupled_;  ///< Value of each coupler's function.
  std::vector<char> dependent_;
  std::vector<Composite> composites_;  ///< Per body.
  std::vector<Vec3> v_origin_;         ///< Per coordinate.
  Reduced reduced_;
  double kinetic_ = 0.0, potential_ = 0.0;
};

}  // namespace myoid::body
