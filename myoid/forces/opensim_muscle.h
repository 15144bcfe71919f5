#pragma once

#include <optional>

#include "myoid/model/body_model.h"
#include "myoid/muscle/millard.h"
#include "myoid/muscle/thelen.h"

namespace myoid::forces {

/// A muscle of a model file under the curves of its own class, as OpenSim's tools use it.
class OpensimMuscle {
 public:
  /// `compat` decides on Millard's pennation (Compat::normalized_pennation).
  OpensimMuscle(const model::Muscle& muscle, const model::Compat& compat);

  /// Force along the tendon [N] at full activation with a rigid tendon, F_max f_l f_v cos(alpha):
  /// what static optimization multiplies by the activation. Lengths of the path [m, m/s]. Zero
  /// where the fiber is at its shortest.
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
  /// OpenSim's equilibrium: tendon and fiber pull alike, while the velocity of the path is shared
  /// between them by their stiffnesses or, with Millard's class, the fiber is at rest. At the
  /// shortest fiber length the force is the tendon's.
  [[nodiscard]] State equilibrium(double activation, double length_m, double velocity_mps) const;
  /// The muscle whose fiber has this length: the velocity is that at which fiber and tendon pull
  /// alike. A fiber at its shortest length that would shorten rests without force. With a rigid
  /// tendon the fiber's length follows from the path's.
  [[nodiscard]] State at_fiber_length(double activation,
                                      double fiber_length_m,
                                      double length_m,
                                      double velocity_mps) const;

  /// Whether the class has curves of its own here; other classes take Thelen's.
  [[nodiscard]] bool has_own_curves() const { return own_curves_; }
  [[nodiscard]] const model::MuscleProperties& properties() const { return p_; }

 private:
  struct Curve {
    double value = 0.0, slope = 0.0;
  };
  [[nodiscard]] Curve active_length(double normalized) const;
  [[nodiscard]] double velocity(double activation, double normalized) const;
  [[nodiscard]] Curve passive(double normalized) const;
  [[nodiscard]] Curve tendon(double normalized) const;
  [[nodiscard]] double cos_pennation(double fiber_length_m) const;
  /// The normalized velocity at which strength times the force-velocity curve and the damping make
  /// `force`, all over F_max.
  [[nodiscard]] double velocity_of(double activation, double strength, double force) const;

  model::MuscleProperties p_;
  muscle::ThelenParameters thelen_;
  std::optional<muscle::MillardCurves> millard_;
  enum class Kind { thelen, millard, de_groote } kind_ = Kind::thelen;
  bool own_curves_ = true;
  bool normalized_pennation_ = false;
  bool rigid_tendon_ = false;
  double damping_ = 0.0;
  double height_m_ = 0.0;
  double least_cosine_ = 0.0;  ///< At the greatest pennation.
  double shortest_m_ = 0.0;    ///< By pennation and, for Millard's, by the active curve.
  double tendon_strain_ = 0.04;
  double width_ = 1.0;
  double passive_rate_ = 0.0, passive_scale_ = 0.0;  ///< Of Thelen's passive curve.
};

}  // namespace myoid::forces
