#pragma once

#include <string_view>

#include "myoid/ground/core/choice.h"
#include "myoid/ground/core/units.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::muscle {

/// The tendon between fiber and bone, and the states of the unit.
enum class TendonMode {
  rigid,        ///< No state: the fiber follows the path.
  equilibrium,  ///< State l_m: massless, fiber and tendon pull alike at every instant.
  mass,         ///< States l_m, dl_m/dt: the source paper's equation (5).
};
inline constexpr std::string_view kTendonModeNames[] = {"rigid", "equilibrium", "mass"};
constexpr ChoiceNames choice_names(TendonMode) { return kTendonModeNames; }

/// Active force over length: the paper's Gaussian (Thelen's too), a published curve, or a parabola.
enum class LengthLaw { gaussian, de_groote, millard, soest };
inline constexpr std::string_view kLengthLawNames[] = {"gaussian", "de_groote", "millard", "soest"};
constexpr ChoiceNames choice_names(LengthLaw) { return kLengthLawNames; }
/// Active force over velocity: the paper's hyperbolas, Thelen's (whose speed falls with activation), ..., or Hill's
/// with a and b that fall with length and activation.
enum class VelocityLaw { hill, thelen, de_groote, millard, soest };
inline constexpr std::string_view kVelocityLawNames[] = {"hill", "thelen", "de_groote", "millard", "soest"};
constexpr ChoiceNames choice_names(VelocityLaw) { return kVelocityLawNames; }
/// Passive force of the fiber; the paper has none.
enum class PassiveLaw { none, thelen, de_groote, millard, soest };
inline constexpr std::string_view kPassiveLawNames[] = {"none", "thelen", "de_groote", "millard", "soest"};
constexpr ChoiceNames choice_names(PassiveLaw) { return kPassiveLawNames; }
/// Tendon force over strain: the paper's line, a curve with a toe, or a parabola.
enum class TendonLaw { linear, thelen, de_groote, millard, soest };
inline constexpr std::string_view kTendonLawNames[] = {"linear", "thelen", "de_groote", "millard", "soest"};
constexpr ChoiceNames choice_names(TendonLaw) { return kTendonLawNames; }

/// A publication's laws of all elements.
enum class LawSet { paper, thelen, de_groote, millard, soest };
inline constexpr std::string_view kLawSetNames[] = {"paper", "thelen", "de_groote", "millard", "soest"};
constexpr ChoiceNames choice_names(LawSet) { return kLawSetNames; }

/// Which law each element of a musculotendon unit follows.
struct MusculotendonLaws {
  TendonMode mode = TendonMode::equilibrium;
  LengthLaw length = LengthLaw::gaussian;
  VelocityLaw velocity = VelocityLaw::hill;
  PassiveLaw passive = PassiveLaw::none;
  TendonLaw tendon = TendonLaw::linear;

  bool operator==(const MusculotendonLaws&) const = default;
};

/// The numbers of one musculotendon unit. Each law reads only some of them: De Groote's and
/// Millard's length and velocity curves take only l0, v_max and F_max of `hill`; Thelen's A_f is
/// V_sh, his F_len V_ml, his gamma (l_sh / l0)^2, and P follows from A_f and F_len. Under `soest` l_sh is the half
/// width of the parabola, and P follows from V_sh and V_ml.
template <typename T = double>
struct MusculotendonParameters {
  HillParameters<T> hill;
  T tendon_strain{0.033};         ///< e0 [-]: (l_t - l_t0) / l_t0 at F_max; k_t = F_max / (e0 l_t0).
  T damping{0.1};                 ///< beta [-]: B_m = beta F_max / v_max.
  T muscle_mass_kg{0.1};          ///< M_m [kg], at the node between fiber and tendon. Mode `mass`.
  T pennation_at_optimal_rad{0};  ///< alpha0 [rad], at l0.
  T passive_strain{0.6};          ///< (l_m - l0) / l0 at which the passive force is F_max.
  T passive_shape{4.0};           ///< k_pe [-] of the exponential passive laws.
  T optimal_length_shift{0.0};    ///< gamma [-]: l_opt(a) = l0 (1 + gamma (1 - a)); 0.15 published.
  T passive_slack{1.0};           ///< l_m / l0 at which the passive force of `soest` begins.
};

/// Calls f(name, unit, field) for every parameter, the Hill parameters first, in one fixed order:
/// the order of sensitivities, tables and files.
template <typename Parameters, typename F>
void visit_parameters(Parameters& p, F&& f) {
  f(std::string_view("max_isometric_force"), Unit::newton, p.hill.max_isometric_force_n);
  f(std::string_view("optimal_fiber_length"), Unit::meter, p.hill.optimal_fiber_length_m);
  f(std::string_view("force_length_width"), Unit::meter, p.hill.force_length_width_m);
  f(std::string_view("concentric_curvature"), Unit::dimensionless, p.hill.concentric_curvature);
  f(std::string_view("eccentric_curvature_product"), Unit::dimensionless, p.hill.eccentric_curvature_product);
  f(std::string_view("eccentric_plateau"), Unit::dimensionless, p.hill.eccentric_plateau);
  f(std::string_view("max_shortening_speed"), Unit::meter_per_second, p.hill.max_shortening_speed_mps);
  f(std::string_view("tendon_slack_length"), Unit::meter, p.hill.tendon_slack_length_m);
  f(std::string_view("tendon_strain"), Unit::dimensionless, p.tendon_strain);
  f(std::string_view("damping"), Unit::dimensionless, p.damping);
  f(std::string_view("muscle_mass"), Unit::kilogram, p.muscle_mass_kg);
  f(std::string_view("pennation_at_optimal"), Unit::radian, p.pennation_at_optimal_rad);
  f(std::string_view("passive_strain"), Unit::dimensionless, p.passive_strain);
  f(std::string_view("passive_shape"), Unit::dimensionless, p.passive_shape);
  f(std::string_view("optimal_length_shift"), Unit::dimensionless, p.optimal_length_shift);
  f(std::string_view("passive_slack"), Unit::dimensionless, p.passive_slack);
}
inline constexpr int kMusculotendonParameterCount = 16;

/// Returns the numbers in another scalar, without derivatives: seed them afterwards.
template <typename T, typename From>
[[nodiscard]] MusculotendonParameters<T> lifted(const MusculotendonParameters<From>& p) {
  MusculotendonParameters<T> result;
  T* fields[kMusculotendonParameterCount];
  int k = 0;
  visit_parameters(result, [&](std::string_view, Unit, T& field) { fields[k++] = &field; });
  k = 0;
  visit_parameters(p, [&](std::string_view, Unit, const From& value) { *fields[k++] = T(value_of(value)); });
  return result;
}

/// Mass of a muscle of this strength and length [kg]: density 1060 kg/m^3, cross-section F_max / (0.5 MPa), length l0.
/// The whole mass moves with the node; of a uniform bar held at its origin the node would have a third.
[[nodiscard]] inline double muscle_mass_kg(double max_isometric_force_n, double optimal_fiber_length_m) {
  return 1060.0 * max_isometric_force_n / 0.5e6 * optimal_fiber_length_m;
}

/// Returns the laws of the source paper (Gaussian, hyperbolas, linear tendon, no passive force) and
/// the sets of the publications. `soest_laws` is van Soest & Bobbert (1993) as Kistemaker et al. (2006) continued them.
[[nodiscard]] MusculotendonLaws paper_laws(TendonMode mode = TendonMode::mass);
[[nodiscard]] MusculotendonLaws thelen_laws(TendonMode mode = TendonMode::equilibrium);
[[nodiscard]] MusculotendonLaws de_groote_laws(TendonMode mode = TendonMode::equilibrium);
[[nodiscard]] MusculotendonLaws millard_laws(TendonMode mode = TendonMode::equilibrium);
[[nodiscard]] MusculotendonLaws soest_laws(TendonMode mode = TendonMode::equilibrium);
[[nodiscard]] MusculotendonLaws laws_of(LawSet set, TendonMode mode = TendonMode::equilibrium);

/// Returns the Hill parameters with the published values of these laws for the rest: tendon strain
/// 0.033 (linear), 0.04 (Thelen, van Soest), 0.049 (De Groote, Millard); passive strain 0.6 and shape 5
/// (Thelen) or 4; damping 0.1, or 1e-4 (van Soest); the mass of `muscle_mass_kg`; no pennation, no shift of the
/// optimum.
[[nodiscard]] MusculotendonParameters<double> published_defaults(const HillParameters<double>& hill,
                                                                 const MusculotendonLaws& laws);

/// Throws InvalidInput with the field, its value and the laws' requirement, unless the numbers make
/// a musculotendon unit.
void validate(const MusculotendonParameters<double>& parameters, const MusculotendonLaws& laws);

}  // namespace myoid::muscle
