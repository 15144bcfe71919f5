#pragma once

#include <cmath>
#include <string_view>

#include "myoid/muscle/millard.h"
#include "myoid/muscle/musculotendon_parameters.h"
#include "myoid/muscle/scalar.h"
#include "myoid/muscle/thelen_curves.h"
#include "myoid/muscle/velocity_hyperbola.h"

namespace myoid::muscle {

/// Cosine of the greatest pennation.
inline constexpr double kLeastPennationCosine = 0.1;

/// A fiber in series with a tendon, between two points of the skeleton: parameters, laws and what
/// follows from them, immutable. `T` is double, or ceres::Jet for exact derivatives by states,
/// inputs and parameters: lift the parameters with `lifted`, seed them, and build a
/// Musculotendon<Jet>.
///
///   along(l_m) = sqrt(l_m^2 - h^2),  h = l0 sin(alpha0),  cos(alpha) = along / l_m
///   l_t = l_mt - along(l_m),         F_t = F_max f_t((l_t - l_t0) / l_t0),  never negative
///   F_m = F_max (a f_l f_v + f_pe) + B_m v,   B_m = beta F_max / v_max
///
///   mass:         M_m dv/dt = F_t / cos(alpha) - F_m          (equation (5) of the source paper)
///   equilibrium:  F_t = F_m cos(alpha), solved for v = dl_m/dt
///   rigid:        l_t = l_t0, F_t = F_m cos(alpha); a tendon does not push: where B_m v would make
///   F_m
///                 negative, the damper gives way to F_m = 0
///
/// Below its shortest length (a hundredth of l0, or cos(alpha) = 0.1) the fiber is held by a stiff
/// spring, and its line of pull keeps its angle. With zero damping the equilibrium needs a f_l f_v
/// to be invertible: the velocity law goes on as its tangents (below -v_max, above 95 % of the
/// plateau) and a f_l is at least `kLeastStrength`. docs/theory/muscle.md derives all this.
template <typename T = double>
class Musculotendon {
 public:
  /// Throws InvalidInput if the parameters make no unit under these laws.
  explicit Musculotendon(const MusculotendonParameters<T>& parameters,
                         const MusculotendonLaws& laws = {},
                         const MillardShape& millard = {});

  [[nodiscard]] const MusculotendonParameters<T>& parameters() const { return p_; }
  [[nodiscard]] const MusculotendonLaws& laws() const { return laws_; }
  [[nodiscard]] const MillardCurves& millard() const { return millard_; }
  [[nodiscard]] const VelocityHyperbola<T>& hyperbola() const { return hyperbola_; }
  [[nodiscard]] const T& height_m() const { return height_; }  ///< h
  [[nodiscard]] const T& shortest_fiber_m() const { return shortest_; }
  [[nodiscard]] const T& damping_nspm() const { return damping_; }  ///< B_m
  [[nodiscard]] bool undamped_equilibrium() const { return undamped_equilibrium_; }

 private:
  MusculotendonParameters<T> p_;
  MusculotendonLaws laws_;
  MillardCurves millard_;
  VelocityHyperbola<T> hyperbola_;
  T height_{};
  T shortest_{};
  T damping_{};
  bool undamped_equilibrium_ = false;
};

template <typename T>
Musculotendon<T>::Musculotendon(const MusculotendonParameters<T>& parameters,
                                const MusculotendonLaws& laws,
                                const MillardShape& millard)
    : p_(parameters), laws_(laws), millard_(millard) {
  using std::sin;
  MusculotendonParameters<double> numbers;
  double* fields[kMusculotendonParameterCount];
  int k = 0;
  visit_parameters(numbers, [&](std::string_view, Unit, double& field) { fields[k++] = &field; });
  k = 0;
  visit_parameters(p_, [&](std::string_view, Unit, const T& v) { *fields[k++] = value_of(v); });
  validate(numbers, laws_);

  const HillParameters<T>& hill = p_.hill;
  undamped_equilibrium_ = laws_.mode == TendonMode::equilibrium && numbers.damping == 0.0;
  if (laws_.velocity == VelocityLaw::thelen) {
    hyperbola_ = thelen_hyperbola<T>(hill.concentric_curvature, hill.eccentric_plateau);
  } else {
    hyperbola_ = {hill.concentric_curvature, hill.eccentric_curvature_product,
                  hill.eccentric_plateau, T(undamped_equilibrium_ ? 0.95 : 1.0), false};
  }
  hyperbola_.tangent_below = undamped_equilibrium_;
  shortest_ = T(0.01) * hill.optimal_fiber_length_m;
  if (numbers.pennation_at_optimal_rad > 0.0) {
    height_ = hill.optimal_fiber_length_m * sin(p_.pennation_at_optimal_rad);
    const double least = kLeastPennationCosine;
    const T most_pennate = height_ / T(std::sqrt(1.0 - least * least));
    if (value_of(most_pennate) > value_of(shortest_)) shortest_ = most_pennate;
  } else {
    height_ = T(0.0);
  }
  damping_ = p_.damping * hill.max_isometric_force_n / hill.max_shortening_speed_mps;
}

}  // namespace myoid::muscle
