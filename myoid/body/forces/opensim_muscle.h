#pragma once

#include "myoid/body/model/body_model.h"
#include "myoid/muscle/normalized_curves.h"

namespace myoid::body {

/// A muscle of a model file under the curves of its own class, in the geometry and the equilibrium
/// of OpenSim's tools. Lengths and velocities of the path [m, m/s], lengthening positive.
class OpensimMuscle {
 public:
  /// Prepares the curves. `compat` decides on Millard's pennation (Compat::normalized_pennation).
  OpensimMuscle(const body::Muscle& muscle, const body::Compat& compat);

  /// Returns the force along the tendon [N] at full activation with a rigid tendon, F_max f_l f_v cos(alpha), by which
  /// static optimization multiplies the activation. Zero at the fiber's shortest length.
  [[nodiscard]] double optimal_force(double length_m, double velocity_mps) const;

  /// Fiber and tendon in balance at an activation.
  struct State {
    double fiber_length_m = 0.0, fiber_velocity_mps = 0.0;
    double pennation_rad = 0.0, pennation_rate_radps = 0.0;
    double tendon_length_m = 0.0, tendon_velocity_mps = 0.0;
    double active_force_n = 0.0, passive_force_n = 0.0;  ///< Along the fiber; damping is passive.
    double elastic_force_n = 0.0;                        ///< The passive force without damping.
    double fiber_force_n = 0.0, tendon_force_n = 0.0;
    bool converged = true;
  };
  /// Returns OpenSim's equilibrium to 1e-8 F_max: tendon and fiber pull equally, while their
  /// stiffnesses divide the velocity of the path or, with Millard's class, the fiber is at rest. At
  /// the shortest fiber length the force is the tendon's.
  [[nodiscard]] State equilibrium(double activation, double length_m, double velocity_mps) const;
  /// Returns the state for this fiber length, at the velocity at which fiber and tendon pull
  /// equally. A fiber at its shortest length that would shorten rests without force. With a rigid
  /// tendon the fiber's length follows from the path's.
  [[nodiscard]] State at_fiber_length(double activation,
                                      double fiber_length_m,
                                      double length_m,
                                      double velocity_mps) const;

  /// Returns true if this program has the curves of the muscle's class; other classes take Thelen's.
  [[nodiscard]] bool has_own_curves() const { return own_curves_; }
  [[nodiscard]] const body::MuscleProperties& properties() const { return p_; }

 private:
  using Curve = muscle::CurvePoint<double>;
  class Balance;

  [[nodiscard]] bool is_millard() const { return curves_.laws().length == muscle::LengthLaw::millard; }
  [[nodiscard]] bool is_thelen() const { return curves_.laws().velocity == muscle::VelocityLaw::thelen; }
  [[nodiscard]] Curve active_length(double normalized) const;
  [[nodiscard]] double velocity(double activation, double normalized) const;
  [[nodiscard]] double cos_pennation(double fiber_length_m) const;

  body::MuscleProperties p_;
  muscle::NormalizedCurves<double> curves_;
  bool own_curves_;
  bool normalized_pennation_;
  bool rigid_tendon_;
  double damping_ = 0.0;
  double width_ = 1.0;  ///< Width of De Groote's active curve, over the published one.
  double height_m_ = 0.0;
  double least_cosine_ = 0.0;  ///< Cosine at the greatest pennation.
  double shortest_m_ = 0.0;    ///< Limit by pennation and, for Millard's, by the active curve.
};

}  // namespace myoid::body
