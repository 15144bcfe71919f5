#pragma once

#include <array>
#include <string_view>

#include "myoid/ground/core/units.h"
#include "myoid/muscle/force_velocity.h"

namespace myoid::muscle {

/// The parameters of one muscle in the source paper, which identifies some of them and takes the
/// others from the literature.
template <typename T = double>
struct HillParameters {
  T max_isometric_force_n{};        ///< F_max [N]
  T optimal_fiber_length_m{};       ///< l_m^0 [m]
  T force_length_width_m{};         ///< l_m^sh [m]
  T concentric_curvature{};         ///< V_sh [-]
  T eccentric_curvature_product{};  ///< P = V_sh V_shl [-]
  T eccentric_plateau{};            ///< V_ml [-]
  T max_shortening_speed_mps{};     ///< v_max [m/s]
  T tendon_slack_length_m{};        ///< l_t0 [m]: fiber length = musculotendon length - l_t0 when the
                                    ///< tendon is rigid.

  [[nodiscard]] VelocityHyperbola<T> velocity_law() const {
    return {.concentric_curvature = concentric_curvature,
            .eccentric_curvature_product = eccentric_curvature_product,
            .eccentric_plateau = eccentric_plateau};
  }
};

struct Range {
  double lower = 0.0;
  double upper = 0.0;
};

/// One row per field: the single source of names, symbols, units and physical bounds.
struct HillField {
  std::string_view name;
  std::string_view symbol;
  Unit unit;
  double HillParameters<double>::*member;
  Range bounds;  ///< Physical: no muscle lies outside.
};

inline constexpr std::array kHillFields = [] {
  using Hill = HillParameters<double>;
  constexpr Unit kNone = Unit::dimensionless;
  return std::array<HillField, 8>{{
      {"max_isometric_force", "F_max", Unit::newton, &Hill::max_isometric_force_n, {5.0, 20000.0}},
      {"optimal_fiber_length", "l_m0", Unit::meter, &Hill::optimal_fiber_length_m, {0.01, 0.60}},
      {"force_length_width", "l_msh", Unit::meter, &Hill::force_length_width_m, {0.005, 0.60}},
      {"concentric_curvature", "V_sh", kNone, &Hill::concentric_curvature, {0.05, 1.0}},
      {"eccentric_curvature_product", "V_sh V_shl", kNone, &Hill::eccentric_curvature_product, {0.005, 1.0}},
      {"eccentric_plateau", "V_ml", kNone, &Hill::eccentric_plateau, {1.0, 2.0}},
      {"max_shortening_speed", "v_max", Unit::meter_per_second, &Hill::max_shortening_speed_mps, {0.05, 10.0}},
      {"tendon_slack_length", "l_t0", Unit::meter, &Hill::tendon_slack_length_m, {0.0, 1.0}},
  }};
}();

/// Returns the row of this name; throws InvalidInput with the list of names.
[[nodiscard]] const HillField& hill_field(std::string_view name);

/// Throws InvalidInput with the field's name and value, unless all are positive and finite (tendon_slack_length may be
/// 0). Values outside the physical bounds are allowed: a verdict, not an error, reports them.
void validate(const HillParameters<double>& parameters);

}  // namespace myoid::muscle
