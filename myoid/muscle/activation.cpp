#include "myoid/muscle/activation.h"

#include <cmath>

#include <fmt/format.h>

#include "myoid/core/error.h"

namespace myoid::muscle {
namespace {

void require_positive(double value, const char* what) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw InvalidInput(fmt::format("{} is {}, expected a positive number", what, value));
  }
}

/// The share of the way to its input that a lag goes in `interval_s`.
double lag_share(double interval_s, double time_s) { return -std::expm1(-interval_s / time_s); }

}  // namespace

void validate(const ActivationTimes& times) {
  require_positive(times.excitation_time_s, "excitation_time_s");
  require_positive(times.activation_time_s, "activation_time_s");
  require_positive(times.deactivation_time_s, "deactivation_time_s");
}

ActivationState step_activation(const ActivationState& state,
                                double excitation,
                                double interval_s,
                                const ActivationTimes& times) {
  ActivationState next = state;
  next.filtered_excitation +=
      lag_share(interval_s, times.excitation_time_s) * (excitation - state.filtered_excitation);
  const double time_s = next.filtered_excitation >= state.activation ? times.activation_time_s
                                                                     : times.deactivation_time_s;
  next.activation += lag_share(interval_s, time_s) * (next.filtered_excitation - state.activation);
  return next;
}

Eigen::VectorXd activation_from_excitation(const Eigen::Ref<const Eigen::VectorXd>& excitation,
                                           double rate_hz,
                                           const ActivationTimes& times) {
  validate(times);
  require_positive(rate_hz, "the rate of the excitation [Hz]");
  Eigen::VectorXd activation(excitation.size());
  if (excitation.size() == 0) return activation;
  ActivationState state{excitation(0), excitation(0)};
  activation(0) = state.activation;
  for (Eigen::Index k = 1; k < excitation.size(); ++k) {
    state = step_activation(state, excitation(k - 1), 1.0 / rate_hz, times);
    activation(k) = state.activation;
  }
  return activation;
}

double thelen_activation_rate(double excitation, double activation, const ActivationTimes& times) {
  const double z = 0.5 + 1.5 * activation;
  const double time_s =
      excitation > activation ? times.activation_time_s * z : times.deactivation_time_s / z;
  return (excitation - activation) / time_s;
}

double smooth_activation_rate(double excitation,
                              double activation,
                              const ActivationTimes& times,
                              double steepness) {
  const double f = 0.5 * std::tanh(steepness * (excitation - activation));
  const double z = 0.5 + 1.5 * activation;
  return ((f + 0.5) / (times.activation_time_s * z) + (0.5 - f) * z / times.deactivation_time_s) *
         (excitation - activation);
}

double shaped_activation(double normalized_emg, double shape) {
  const double u = normalized_emg;
  if (std::abs(shape) < 1e-4) return u + 0.5 * shape * u * (u - 1.0);
  return std::expm1(shape * u) / std::expm1(shape);
}

Eigen::VectorXd two_lag_activation(const Eigen::Ref<const Eigen::VectorXd>& envelope,
                                   double rate_hz,
                                   double first_time_s,
                                   double second_time_s) {
  require_positive(rate_hz, "the rate of the envelope [Hz]");
  require_positive(first_time_s, "first_time_s");
  require_positive(second_time_s, "second_time_s");
  const double first_share = lag_share(1.0 / rate_hz, first_time_s);
  const double second_share = lag_share(1.0 / rate_hz, second_time_s);
  Eigen::VectorXd result(envelope.size());
  if (envelope.size() == 0) return result;
  double first = envelope(0);
  double second = envelope(0);
  result(0) = second;
  for (Eigen::Index k = 1; k < envelope.size(); ++k) {
    first += first_share * (envelope(k) - first);
    second += second_share * (first - second);
    result(k) = second;
  }
  return result;
}

}  // namespace myoid::muscle
