#include "myoid/muscle/emg_activation.h"

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

double shaped_activation(double normalized_emg, double shape) {
  const double u = normalized_emg;
  if (std::abs(shape) < 1e-4) return u + 0.5 * shape * u * (u - 1.0);
  return std::expm1(shape * u) / std::expm1(shape);
}

LogLinearActivation::LogLinearActivation(double shape) {
  if (!(shape >= 0.0 && shape <= 0.12)) {
    throw InvalidInput(fmt::format(
        "the shape of Manal and Buchanan's activation is {}, expected 0 (linear) to 0.12", shape));
  }
  if (shape < 1e-9) return;
  node_ = 0.3085 - 0.7071 * shape;
  const double level = 0.3085 + 0.7071 * shape;
  slope_ = (1.0 - level) / (1.0 - node_);
  // One slope on both sides: level beta / ((beta u0 + 1) ln(beta u0 + 1)) = slope. With x = beta u0
  // the left side falls from level / u0 > slope to 0: bisection in ln x.
  const auto excess = [&](double x) {
    return level * x / (node_ * (x + 1.0) * std::log1p(x)) - slope_;
  };
  double low = 1e-12;
  double high = 1e12;
  for (int k = 0; k < 200; ++k) {
    const double x = std::sqrt(low * high);
    (excess(x) > 0.0 ? low : high) = x;
  }
  beta_ = std::sqrt(low * high) / node_;
  alpha_ = level / std::log1p(beta_ * node_);
}

double LogLinearActivation::operator()(double normalized_emg) const {
  if (normalized_emg < node_) return alpha_ * std::log1p(beta_ * normalized_emg);
  return 1.0 - slope_ * (1.0 - normalized_emg);
}

double fregly_activation(double neural_activation, double nonlinearity) {
  constexpr double g1 = 29.280183270562596;
  constexpr double g2 = 4.107869238218326;
  constexpr double g3 = 1.000004740962477;
  constexpr double g4 = -7.623282868703527;
  constexpr double g5 = 17.227022969058535;
  constexpr double g6 = 0.884220539986325;
  const double n = neural_activation;
  return (1.0 - nonlinearity) * n + nonlinearity * (g4 / (g1 * std::pow(n + g6, g5) + g2) + g3);
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
