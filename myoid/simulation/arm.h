#pragma once

#include <string>
#include <vector>

#include "myoid/arm/arm4.h"
#include "myoid/arm/planar_elbow.h"
#include "myoid/muscle/activation.h"
#include "myoid/muscle/joint_passive.h"
#include "myoid/muscle/musculotendon_parameters.h"

namespace myoid::simulation {

/// Path of a muscle across a hinge: model::PlanarMuscle in any scalar.
///
///   l(q) = constant + sqrt(L1^2 + L2^2 - 2 L1 L2 cos(psi0 - q)) + pulley q,   r = -dl/dq
template <typename T = double>
struct HingePath {
  T constant_m{};
  T above_m{};       ///< L1; 0: pulley only.
  T below_m{};       ///< L2
  T straight_rad{};  ///< psi0
  T pulley_m{};
};

/// One muscle of the arm: its path, properties and excitation.
template <typename T = double>
struct ArmMuscle {
  std::string name;
  HingePath<T> path;
  muscle::MusculotendonParameters<T> parameters;
  muscle::MusculotendonLaws laws;
  muscle::ActivationDynamics<T> activation;
};

/// An upper arm at rest, a forearm with hand and held object on a hinge, and any number of muscles:
/// equation (8) of the source paper, as corrected,
///
///   (J + m d^2) qddot = sum_i r_i(q) F_t,i - (S + m d) g sin q + T_joint(q, qdot) + T_ext
template <typename T = double>
struct Arm {
  std::vector<ArmMuscle<T>> muscles;
  muscle::JointPassive<T> joint;  ///< Viscosity B_l, stiffness, stops.
  T inertia_kgm2{};               ///< J, of forearm and hand about the elbow.
  T static_moment_kgm{};          ///< S, mass times distance of its center.
  T held_mass_kg{0.0};            ///< m
  T held_at_m{};                  ///< d
  T gravity_mps2{};               ///< g in the plane of movement, along the upper arm; 0: horizontal.
};

struct ArmSetup {
  model::ArmOptions person;
  bool horizontal = false;  ///< The axis of the elbow is vertical: gravity does not act.
  double held_mass_kg = 0.0;
  muscle::MusculotendonLaws laws = muscle::paper_laws(muscle::TendonMode::rigid);
  muscle::ActivationDynamics<double> activation;
  muscle::JointPassive<double> joint = muscle::elbow_passive();
};

/// Returns the built-in arm: paths, inertia and Hill parameters of `model::planar_elbow` and
/// `model::arm4_muscles`, the rest from `muscle::published_defaults`.
[[nodiscard]] Arm<double> make_arm(const ArmSetup& setup = {});

/// Returns the arm with every muscle in another tendon mode.
[[nodiscard]] Arm<double> with_tendon_mode(Arm<double> arm, muscle::TendonMode mode);

/// Throws InvalidInput, naming muscle or field, unless the arm can move.
void validate(const Arm<double>& arm);

}  // namespace myoid::simulation
