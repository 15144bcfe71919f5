#pragma once

#include "myoid/muscle/de_groote.h"
#include "myoid/muscle/force_length.h"
#include "myoid/muscle/millard.h"
#include "myoid/muscle/musculotendon_parameters.h"
#include "myoid/muscle/soest_curves.h"
#include "myoid/muscle/thelen_curves.h"

namespace myoid::muscle {

/// The numbers that shape the normalized curves; each law reads only some of them.
template <typename T = double>
struct CurveShape {
  T relative_width{};              ///< l_sh / l0 of the Gaussian.
  VelocityHyperbola<T> hyperbola;  ///< For the velocity laws `hill`, `thelen` and, of their shape, `soest`.
  T passive_strain{};              ///< For the passive laws but Millard's.
  T passive_shape{};               ///< For the exponential ones.
  T tendon_strain{};               ///< e0, at F_max.
  MillardShape millard;
  T passive_slack{1.0};  ///< For the passive law `soest`.
};

/// The fiber's activation, length and the active multiplier at this length. Only the velocity law `soest` depends on
/// the length.
template <typename T = double>
struct Activity {
  T activation{};
  T length{1.0};      ///< l_m / l0
  T multiplier{1.0};  ///< f_l
};

/// Returns the shape that the parameters give under these laws. Thelen's hyperbolas follow from A_f and F_len.
template <typename T>
[[nodiscard]] CurveShape<T> curve_shape(const MusculotendonParameters<T>& p,
                                        const MusculotendonLaws& laws,
                                        const MillardShape& millard) {
  const HillParameters<T>& hill = p.hill;
  return {.relative_width = hill.force_length_width_m / hill.optimal_fiber_length_m,
          .hyperbola = laws.velocity == VelocityLaw::thelen
                           ? thelen_hyperbola<T>(hill.concentric_curvature, hill.eccentric_plateau)
                           : hill.velocity_law(),
          .passive_strain = p.passive_strain,
          .passive_shape = p.passive_shape,
          .tendon_strain = p.tendon_strain,
          .millard = millard,
          .passive_slack = p.passive_slack};
}

/// The curves of a musculotendon unit, each under the law chosen for it: forces over F_max, fiber lengths over l0,
/// velocities over v_max, tendon strains over l_t0. Values carry derivatives in T; slopes are plain numbers. Immutable.
template <typename T = double>
class NormalizedCurves {
 public:
  /// Throws InvalidInput if Millard's shape makes no curve.
  NormalizedCurves(const MusculotendonLaws& laws, const CurveShape<T>& shape)
      : laws_(laws),
        shape_(shape),
        thelen_passive_(shape.passive_strain, shape.passive_shape),
        de_groote_passive_(shape.passive_strain, shape.passive_shape),
        soest_passive_(shape.passive_strain, shape.passive_slack),
        millard_(shape.millard) {}

  [[nodiscard]] const MusculotendonLaws& laws() const { return laws_; }
  [[nodiscard]] const VelocityHyperbola<T>& hyperbola() const { return shape_.hyperbola; }

  /// Returns f_l at the fiber length l.
  [[nodiscard]] CurvePoint<T> length(const T& l) const {
    switch (laws_.length) {
      case LengthLaw::gaussian: {
        const T f = force_length(l, T(1.0), shape_.relative_width);
        const double w = value_of(shape_.relative_width);
        return {f, -2.0 * value_of(f) * (value_of(l) - 1.0) / (w * w)};
      }
      case LengthLaw::de_groote:
        return de_groote_force_length<T>(l);
      case LengthLaw::millard:
        return millard_.force_length(l);
      case LengthLaw::soest:
        return soest_force_length<T>(l, shape_.relative_width);
    }
    return {};
  }

  /// Returns f_v at the velocity v. Thelen's law is slower at low activation, van Soest's also at short lengths.
  [[nodiscard]] CurvePoint<T> velocity(const Activity<T>& at, const T& v) const {
    switch (laws_.velocity) {
      case VelocityLaw::hill:
        return force_velocity<T>(shape_.hyperbola, v);
      case VelocityLaw::thelen: {
        const T speed = thelen_speed(at.activation);
        CurvePoint<T> point = force_velocity<T>(shape_.hyperbola, v / speed);
        point.slope /= value_of(speed);
        return point;
      }
      case VelocityLaw::de_groote:
        return de_groote_force_velocity(v);
      case VelocityLaw::millard:
        return millard_.force_velocity(v);
      case VelocityLaw::soest:
        return force_velocity<T>(soest_at(at), v);
    }
    return {};
  }

  /// Returns the velocity at which strength f_v + damping v = force.
  [[nodiscard]] double solve_velocity(const Activity<T>& at, double strength, double damping, double force) const {
    if (strength == 0.0) return force / damping;
    switch (laws_.velocity) {
      case VelocityLaw::hill:
        return muscle::solve_velocity(plain(shape_.hyperbola), strength, damping, force);
      case VelocityLaw::thelen: {
        const double speed = thelen_speed(value_of(at.activation));
        return speed * muscle::solve_velocity(plain(shape_.hyperbola), strength, damping * speed, force);
      }
      case VelocityLaw::de_groote:
        return solve_de_groote_velocity(strength, damping, force);
      case VelocityLaw::millard:
        return millard_.force_velocity.solve(strength, damping, force);
      case VelocityLaw::soest:
        return muscle::solve_velocity(plain(soest_at(at)), strength, damping, force);
    }
    return 0.0;
  }

  /// Returns the shortening speed at which f_v is zero.
  [[nodiscard]] double zero_velocity(const Activity<T>& at) const {
    return laws_.velocity == VelocityLaw::soest ? value_of(soest_at(at).zero) : 1.0;
  }

  /// Returns the passive force of the fiber at the length l.
  [[nodiscard]] CurvePoint<T> passive(const T& l) const {
    switch (laws_.passive) {
      case PassiveLaw::none:
        break;
      case PassiveLaw::thelen:
        return thelen_passive_(l);
      case PassiveLaw::de_groote:
        return de_groote_passive_(l);
      case PassiveLaw::millard:
        return millard_.passive(l);
      case PassiveLaw::soest:
        return soest_passive_(l);
    }
    return {T(0.0), 0.0};
  }
  /// Returns the integral of `passive`: the energy over F_max l0.
  [[nodiscard]] T passive_energy(const T& l) const {
    switch (laws_.passive) {
      case PassiveLaw::none:
        break;
      case PassiveLaw::thelen:
        return thelen_passive_.energy(l);
      case PassiveLaw::de_groote:
        return de_groote_passive_.energy(l);
      case PassiveLaw::millard:
        return millard_.passive.integral(l);
      case PassiveLaw::soest:
        return soest_passive_.energy(l);
    }
    return T(0.0);
  }

  /// Returns the tendon force at a strain; zero when slack.
  [[nodiscard]] CurvePoint<T> tendon(const T& strain) const {
    if (value_of(strain) <= 0.0) return {T(0.0), 0.0};
    switch (laws_.tendon) {
      case TendonLaw::linear:
        return {strain / shape_.tendon_strain, 1.0 / value_of(shape_.tendon_strain)};
      case TendonLaw::thelen:
        return thelen_tendon(strain, shape_.tendon_strain);
      case TendonLaw::de_groote:
        return de_groote_tendon(strain, shape_.tendon_strain);
      case TendonLaw::millard: {
        CurvePoint<T> point = millard_.tendon(T(strain / shape_.tendon_strain));
        point.slope /= value_of(shape_.tendon_strain);
        return point;
      }
      case TendonLaw::soest:
        return soest_tendon(strain, shape_.tendon_strain);
    }
    return {};
  }
  /// Returns the integral of `tendon`: the energy over F_max l_t0.
  [[nodiscard]] T tendon_energy(const T& strain) const {
    if (value_of(strain) <= 0.0) return T(0.0);
    switch (laws_.tendon) {
      case TendonLaw::linear:
        return T(0.5) * strain * strain / shape_.tendon_strain;
      case TendonLaw::thelen:
        return thelen_tendon_energy(strain, shape_.tendon_strain);
      case TendonLaw::de_groote:
        return de_groote_tendon_energy(strain, shape_.tendon_strain);
      case TendonLaw::millard:
        return millard_.tendon.integral(T(strain / shape_.tendon_strain)) * shape_.tendon_strain;
      case TendonLaw::soest:
        return soest_tendon_energy(strain, shape_.tendon_strain);
    }
    return T(0.0);
  }

 private:
  [[nodiscard]] static VelocityHyperbola<double> plain(const VelocityHyperbola<T>& h) {
    return {value_of(h.concentric_curvature),
            value_of(h.eccentric_curvature_product),
            value_of(h.eccentric_plateau),
            value_of(h.tangent_from),
            h.tangent_below,
            value_of(h.zero),
            value_of(h.lengthening_slope)};
  }
  [[nodiscard]] VelocityHyperbola<T> soest_at(const Activity<T>& at) const {
    VelocityHyperbola<T> h =
        soest_hyperbola<T>(shape_.hyperbola.concentric_curvature, shape_.hyperbola.eccentric_plateau, at.activation,
                           at.length, at.multiplier);
    h.tangent_below = shape_.hyperbola.tangent_below;
    return h;
  }

  MusculotendonLaws laws_;
  CurveShape<T> shape_;
  ThelenPassive<T> thelen_passive_;
  DeGrootePassive<T> de_groote_passive_;
  SoestPassive<T> soest_passive_;
  MillardCurves millard_;
};

}  // namespace myoid::muscle
