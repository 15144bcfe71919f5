#pragma once

#include <cmath>
#include <optional>
#include <string_view>

#include "myoid/ground/core/units.h"
#include "myoid/muscle/activation.h"

namespace myoid::muscle {

/// The share of troponin that binds calcium, by the concentration g of calcium between the filaments (over its
/// greatest) and the fiber's length l over l0: Hatze (1981) as Kistemaker, van Soest & Bobbert (2005), Biol Cybern
/// 93:208-219, wrote it. A long fiber needs less calcium.
///
///   a = rest + (1 - rest) / (1 + (g_half(l) / g)^n),   log10 g_half(l) = log10 half - length (l - 1)
struct CalciumBinding {
  double half = 0.214;         ///< g at which half is bound, at l0.
  double cooperativity = 3.2;  ///< n
  double length = 0.596;       ///< Decades of g_half per l0.
  double rest = 0.005;         ///< Share without calcium.
};

/// Returns the active state of a fiber, from 0 to 1.
[[nodiscard]] inline double active_state(const CalciumBinding& b, double concentration, double relative_length) {
  if (!(concentration > 0.0)) return b.rest;
  const double half = b.half * std::pow(10.0, -b.length * (relative_length - 1.0));
  return b.rest + (1.0 - b.rest) / (1.0 + std::pow(half / concentration, b.cooperativity));
}

/// The way from the excitation of a muscle to its active state.
struct ExcitationResponse {
  ActivationDynamics<double> activation{
      .law = ActivationLaw::thelen, .activation_time_s = 0.010, .deactivation_time_s = 0.040};
  double delay_s = 0.0;  ///< The excitation acts so much later; until then the muscle stays as it begins.
  /// The state of the activation's law is the concentration of calcium; empty: it is the active state.
  std::optional<CalciumBinding> calcium;
};

/// Calls f(name, unit, field) for the numbers that the response uses.
template <typename Response, typename F>
void visit_response(Response& r, F&& f) {
  f(std::string_view("excitation_delay"), Unit::second, r.delay_s);
  f(std::string_view("excitation_time"), Unit::second, r.activation.excitation_time_s);
  f(std::string_view("activation_time"), Unit::second, r.activation.activation_time_s);
  f(std::string_view("deactivation_time"), Unit::second, r.activation.deactivation_time_s);
  if (!r.calcium) return;
  f(std::string_view("calcium_half"), Unit::dimensionless, r.calcium->half);
  f(std::string_view("calcium_cooperativity"), Unit::dimensionless, r.calcium->cooperativity);
  f(std::string_view("calcium_length"), Unit::dimensionless, r.calcium->length);
  f(std::string_view("calcium_rest"), Unit::dimensionless, r.calcium->rest);
}

/// Throws InvalidInput for times and shares that no muscle can have.
void validate(const ExcitationResponse& response);

}  // namespace myoid::muscle
