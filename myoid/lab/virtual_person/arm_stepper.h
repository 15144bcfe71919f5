#pragma once

#include <array>
#include <memory>

#include "myoid/lab/virtual_person/curve_table.h"
#include "myoid/lab/virtual_person/smooth_motion.h"
#include "myoid/lab/virtual_person/true_arm.h"
#include "myoid/muscle/fatigue.h"

namespace myoid::lab {

/// The plane in which a trial takes place, and the mass in the hand.
struct Surroundings {
  Plane plane = Plane::vertical;
  double held_mass_kg = 0.0;
};

/// The state of a moving arm, and the forces in it.
struct ArmState {
  Moment q;              ///< Elbow flexion.
  PerHead activation{};  ///< a
  PerHead fiber_length_m{};
  PerHead fiber_velocity_mps{};
  PerHead tendon_force_n{};
  double muscle_torque_nm = 0.0;
  double passive_torque_nm = 0.0;  ///< Torque of the joint.
};

/// Forward dynamics of an arm with elastic tendons, in fixed steps: the same numbers on every machine and with every
/// number of threads, and fast enough for thousands of people (about 0.1 s for 100 s of seven heads).
///
/// The joint takes velocity Verlet steps, the fibers the backward differentiation formula of second
/// order: with v = (3 l - 4 l' + l'') / (2 h),
///
///   F_t(l_mt - along(l)) = cos(alpha) F_max (a f_l f_v + f_pe + beta v / v_max)
///
/// is solved for every fiber at every step, so that at the end of a step forces balance to round-off. The method is of
/// second order, and stable for tendons of any stiffness. Activation follows excitation by equation (1), in exact
/// exponentials. Curves are tables of the laws of muscle/ (CurveTable).
class ArmStepper {
 public:
  ArmStepper(const TrueArm& arm, double step_s);

  /// Starts at rest at this angle, after constant excitation, with fibers in balance.
  void start(const Surroundings& surroundings, double elbow_flexion_rad, const PerHead& excitation);

  /// Takes one step of the free arm under the excitations at the step's end.
  void step_free(const PerHead& excitation);
  /// Takes one step of an arm that is moved to `q` at the step's end.
  void step_moved(const PerHead& excitation, const Moment& q);

  [[nodiscard]] const ArmState& state() const { return state_; }
  [[nodiscard]] double step_s() const { return step_s_; }
  /// Sets each head's F_max over that of the fresh muscle.
  void set_strength(const PerHead& share) { strength_ = share; }

  /// Torques that a nervous system may expect of its muscles: the torques about the elbow in a
  /// motion with tendons stretched as at a tenth of F_max and the optimum at an activation of 0.2.
  struct Foresight {
    PerHead capacity_nm{};    ///< Torque of each head at full activation; signed.
    double passive_nm = 0.0;  ///< Torque of the muscles without activation.
    double torque_nm = 0.0;   ///< Torque that activation has to provide: the motion's, without the
                              ///< passive torque of joint and muscles.
  };
  [[nodiscard]] Foresight foresee(const Moment& q) const;

 private:
  /// The laws of one head as tables, in SI.
  struct HeadLaws {
    CurveTable length, velocity, passive, tendon;
    double height_m = 0.0;
    double shortest_m = 0.0;
  };
  struct FiberBalance {
    double mismatch_n = 0.0;  ///< F_t - F_m cos(alpha)
    double slope_npm = 0.0;   ///< Derivative by the fiber's length.
    double tendon_n = 0.0;
  };

  [[nodiscard]] FiberBalance balance(
      std::size_t i, double path_m, double length_m, double velocity_mps, double velocity_slope) const;
  /// Returns the length at which the head is in balance, with velocity = offset + slope * length.
  [[nodiscard]] double balanced_length_m(
      std::size_t i, double path_m, double guess_m, double velocity_offset_mps, double velocity_slope) const;
  void advance_activation(const PerHead& excitation);
  void advance_fibers();

  const TrueArm* arm_;
  double step_s_;
  double lag_;       ///< 1 - exp(-h / tau) of the excitation.
  double lag_up_;    ///< 1 - exp(-h / tau) of the rising activation.
  double lag_down_;  ///< 1 - exp(-h / tau) of the falling activation.
  std::array<HeadLaws, kHeadCount> laws_;
  Surroundings surroundings_;
  ArmState state_;
  PerHead filtered_{};  ///< e
  PerHead before_m_{};  ///< Fiber lengths at the preceding step.
  PerHead strength_{};
};

}  // namespace myoid::lab
