#include "myoid/muscle/activation.h"

#include <cmath>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::muscle {
void validate(const ActivationDynamics<double>& d) {
  const auto require = [](double value, const char* name) {
    if (!(value > 0.0) || !std::isfinite(value)) {
      throw InvalidInput(fmt::format("{} is {}, expected a positive number", name, value));
    }
  };
  require(d.excitation_time_s, "excitation_time_s");
  require(d.activation_time_s, "activation_time_s");
  require(d.deactivation_time_s, "deactivation_time_s");
  require(d.steepness, "steepness");
}

double activation_event(const ActivationDynamics<double>& d, double excitation, const ActivationPoint<double>& state) {
  if (d.law == ActivationLaw::two_lags) return state.filtered_excitation - state.activation;
  if (d.law == ActivationLaw::thelen || d.law == ActivationLaw::one_lag) return excitation - state.activation;
  return 1.0;
}

}  // namespace myoid::muscle
