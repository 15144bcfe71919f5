#include "myoid/body/forces/opensim_muscle.h"

#include <algorithm>
#include <cmath>

#include "myoid/body/osim/muscle_laws.h"

namespace myoid::body {
namespace {

/// Returns the class's curves with the file's numbers. Thelen's velocity law is invertible everywhere.
muscle::NormalizedCurves<double> class_curves(const body::MuscleProperties& p) {
  const muscle::MusculotendonLaws laws = body::class_laws(p, muscle::TendonMode::equilibrium);
  muscle::CurveShape<double> shape =
      muscle::curve_shape(body::musculotendon_parameters(p, laws), laws, body::millard_shape(p));
  if (laws.velocity == muscle::VelocityLaw::thelen) {
    shape.hyperbola = muscle::thelen_hyperbola(p.concentric_shape, p.eccentric_plateau, p.force_velocity_extrapolation);
    shape.hyperbola.tangent_below = true;
  }
  return {laws, shape};
}

}  // namespace

OpensimMuscle::OpensimMuscle(const body::Muscle& muscle, const body::Compat& compat)
    : p_(muscle.properties),
      curves_(class_curves(p_)),
      own_curves_(!is_thelen() || muscle.class_name.starts_with("Thelen2003")),
      normalized_pennation_(compat.normalized_pennation && is_millard()),
      rigid_tendon_(body::muscle_states(p_).rigid_tendon),
      damping_(body::musculotendon_parameters(p_, curves_.laws()).damping),
      height_m_(p_.optimal_fiber_length_m * std::sin(p_.pennation_at_optimal_rad)),
      least_cosine_(std::max(0.0, std::cos(p_.max_pennation_rad))),
      shortest_m_(height_m_ > 0.0 ? height_m_ / std::sin(p_.max_pennation_rad) : 0.0) {
  if (const auto* millard = std::get_if<body::MillardCurves>(&p_.curves))
    shortest_m_ = std::max(shortest_m_, millard->shape.active.shortest_length * p_.optimal_fiber_length_m);
  if (const auto* de_groote = std::get_if<body::DeGrooteCurves>(&p_.curves)) width_ = de_groote->active_width_scale;
}

double OpensimMuscle::cos_pennation(double fiber_length_m) const {
  if (!(height_m_ > 0.0)) return 1.0;
  const double sine = std::min(1.0, height_m_ / std::max(fiber_length_m, 1e-300));
  return std::max(std::sqrt((1.0 - sine) * (1.0 + sine)), least_cosine_);
}

OpensimMuscle::Curve OpensimMuscle::active_length(double l) const {
  if (width_ == 1.0) return curves_.length(l);
  const Curve point = curves_.length((l - 1.0) / width_ + 1.0);
  return {point.value, point.slope / width_};
}

/// Returns the velocity multiplier. Thelen's muscle pulls with at least zero force, also if it
/// shortens faster than v_max.
double OpensimMuscle::velocity(double activation, double v) const {
  const double f = curves_.velocity({activation}, v).value;
  return is_thelen() ? std::max(0.0, f) : f;
}

double OpensimMuscle::optimal_force(double length_m, double velocity_mps) const {
  const double along = length_m - p_.tendon_slack_length_m;
  if (!(along > 0.0)) return 0.0;
  const double fiber_m = std::hypot(height_m_, along);
  if (fiber_m <= shortest_m_) return 0.0;
  const double l = fiber_m / p_.optimal_fiber_length_m;
  const double cosine = cos_pennation(fiber_m);
  const double v = velocity_mps * cosine / (p_.optimal_fiber_length_m * p_.max_contraction_velocity);
  return p_.max_isometric_force_n * active_length(l).value * std::max(0.0, velocity(1.0, v)) *
         (normalized_pennation_ ? cos_pennation(l) : cosine);
}

/// A musculotendon unit between the ends of its path, whose fiber length the search varies.
class OpensimMuscle::Balance {
 public:
  Balance(const OpensimMuscle& muscle, double activation, double length_m, double velocity_mps)
      : m_(muscle),
        activation_(activation),
        length_m_(length_m),
        velocity_mps_(velocity_mps),
        v_max_mps_(muscle.p_.max_contraction_velocity * muscle.p_.optimal_fiber_length_m) {}

  /// Stiffness of the fiber along the tendon and of the tendon [N/m].
  struct Stiffness {
    double fiber_by_length = 0.0, fiber_along = 0.0, tendon = 0.0, tendon_by_fiber = 0.0;
    /// Returns the derivative of the mismatch by the fiber's length.
    [[nodiscard]] double slope() const { return fiber_by_length - tendon_by_fiber; }
  };

  /// Sets the fiber's length; its velocity stays.
  void place(double fiber_length_m) {
    l_ = fiber_length_m;
    cosine_ = m_.cos_pennation(l_);
    tendon_length_m_ = length_m_ - l_ * cosine_;
    const double normalized = l_ / m_.p_.optimal_fiber_length_m;
    active_ = m_.active_length(normalized);
    passive_ = m_.curves_.passive(normalized);
    tendon_ = m_.curves_.tendon(tendon_length_m_ / m_.p_.tendon_slack_length_m - 1.0);
  }

  /// Returns the fiber's pull along the tendon minus the tendon's [N].
  double mismatch_n() {
    const double f_max = m_.p_.max_isometric_force_n;
    fiber_force_n_ = f_max * activation_ * active_.value * f_v_ + f_max * (passive_.value + m_.damping_ * speed_);
    return fiber_force_n_ * cosine_ - f_max * tendon_.value;
  }

  /// Returns the stiffnesses at the forces of the last mismatch.
  [[nodiscard]] Stiffness stiffness() const {
    const double f_max = m_.p_.max_isometric_force_n;
    Stiffness k;
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine_ * cosine_));
    // Without pennation the fiber's length may become zero.
    const double angle_by_length = sine > 0.0 && cosine_ > 0.0 ? -sine / (l_ * cosine_) : 0.0;
    const double fiber = f_max * (activation_ * active_.slope * f_v_ + passive_.slope) / m_.p_.optimal_fiber_length_m;
    k.fiber_by_length = fiber * cosine_ - fiber_force_n_ * sine * angle_by_length;
    // d(l cos a)/dl = cos a - l sin a da/dl
    const double along_by_length = cosine_ - l_ * sine * angle_by_length;
    k.fiber_along = k.fiber_by_length / along_by_length;
    k.tendon = f_max * tendon_.slope / m_.p_.tendon_slack_length_m;
    k.tendon_by_fiber = -k.tendon * along_by_length;
    return k;
  }

  /// Divides the path's velocity between fiber and tendon. Millard's muscle is balanced at rest.
  void share_velocity(const Stiffness& k) {
    if (m_.is_millard() || std::abs(velocity_mps_) < 1e-15) return;
    double tendon_speed = velocity_mps_;
    const double sum = k.fiber_along + k.tendon;
    if (std::abs(sum) > 1e-15 && tendon_length_m_ > m_.p_.tendon_slack_length_m)
      tendon_speed = k.fiber_along / sum * velocity_mps_;
    speed_ = (velocity_mps_ - tendon_speed) * cosine_ / v_max_mps_;
    f_v_ = m_.velocity(activation_, speed_);
  }

 private:
  const OpensimMuscle& m_;
  double activation_, length_m_, velocity_mps_, v_max_mps_;
  double l_ = 0.0, cosine_ = 1.0, tendon_length_m_ = 0.0;
  double speed_ = 0.0, f_v_ = 1.0;  ///< Speed of the fiber, relative to v_max.
  double fiber_force_n_ = 0.0;
  Curve active_, passive_, tendon_;
};

OpensimMuscle::State OpensimMuscle::equilibrium(double activation, double length_m, double velocity_mps) const {
  if (rigid_tendon_) return at_fiber_length(activation, shortest_m_, length_m, velocity_mps);
  Balance balance(*this, activation, length_m, velocity_mps);
  const double along = length_m - 1.01 * p_.tendon_slack_length_m;
  double l = std::max(along > 0.0 ? std::hypot(height_m_, along) : shortest_m_, shortest_m_);
  balance.place(l);
  (void)balance.mismatch_n();
  balance.share_velocity(balance.stiffness());
  double error = balance.mismatch_n();
  Balance::Stiffness k = balance.stiffness();
  const double tolerance = 1e-8 * p_.max_isometric_force_n;
  for (int i = 0; std::abs(error) > tolerance && i < 200; ++i) {
    const double before = error;
    const double from = l;
    if (from <= shortest_m_ && before / k.slope() > 0.0)
      break;  // the fiber is at its shortest, and the balance asks for less
    for (double part = 1.0;; part *= 0.5) {
      const double step = -part * before / k.slope();
      l = std::max(std::abs(step) > 1e-15 ? from + step : from - std::copysign(1.5e-8, step), shortest_m_);
      balance.place(l);
      error = balance.mismatch_n();
      if (std::abs(error) < std::abs(before) || part <= 1.5e-8 || std::abs(step) <= 1e-15) break;
    }
    k = balance.stiffness();
    balance.share_velocity(k);
  }
  State s = at_fiber_length(activation, l, length_m, velocity_mps);
  s.converged = std::abs(error) <= tolerance || l <= shortest_m_;
  return s;
}

OpensimMuscle::State OpensimMuscle::at_fiber_length(double activation,
                                                    double fiber_length_m,
                                                    double length_m,
                                                    double velocity_mps) const {
  const double fmax = p_.max_isometric_force_n;
  const double vmax = p_.max_contraction_velocity * p_.optimal_fiber_length_m;
  const double a = std::clamp(activation, p_.minimum_activation, 1.0);
  State s;
  if (rigid_tendon_) {
    const double along = length_m - p_.tendon_slack_length_m;
    fiber_length_m = along > 0.0 ? std::hypot(height_m_, along) : shortest_m_;
  }
  s.fiber_length_m = std::max(fiber_length_m, shortest_m_);
  const double l = s.fiber_length_m / p_.optimal_fiber_length_m;
  const double cosine = cos_pennation(s.fiber_length_m);
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  s.pennation_rad = std::atan2(sine, cosine);
  s.tendon_length_m = length_m - s.fiber_length_m * cosine;
  const double strength = a * active_length(l).value;
  const double rest = curves_.passive(l).value;
  const double series = rigid_tendon_ ? 0.0 : curves_.tendon(s.tendon_length_m / p_.tendon_slack_length_m - 1.0).value;
  double v = 0.0;
  if (rigid_tendon_) {
    v = velocity_mps * cosine / vmax;
  } else if (strength > 0.0) {
    v = curves_.solve_velocity({a}, strength, damping_, series / cosine - rest);
  }
  s.tendon_force_n = fmax * series;
  s.elastic_force_n = fmax * rest;
  if (s.fiber_length_m <= shortest_m_ && v <= 0.0) {
    s.passive_force_n = is_thelen() ? s.elastic_force_n : 0.0;
    s.tendon_velocity_mps = velocity_mps;
    return s;
  }
  s.fiber_velocity_mps = v * vmax;
  if (sine > 0.0) s.pennation_rate_radps = -s.fiber_velocity_mps / s.fiber_length_m * sine / cosine;
  s.tendon_velocity_mps = rigid_tendon_ ? 0.0 : velocity_mps - s.fiber_velocity_mps / cosine;
  s.active_force_n = rigid_tendon_ || !(strength > 0.0) ? fmax * strength * velocity(a, v)
                                                        : fmax * (series / cosine - rest - damping_ * v);
  s.passive_force_n = s.elastic_force_n + fmax * damping_ * v;
  s.fiber_force_n = s.active_force_n + s.passive_force_n;
  if (rigid_tendon_) {
    if (s.fiber_force_n < 0.0) {
      // The damper does not push the tendon.
      s.passive_force_n = -s.active_force_n;
      s.fiber_force_n = 0.0;
    }
    s.tendon_force_n = s.fiber_force_n * cosine;
  }
  return s;
}

}  // namespace myoid::body
