#include "myoid/muscle/fatigue.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::muscle {

void validate(const FatigueRates<double>& rates) {
  const auto require = [](bool good, std::string_view name, double value, std::string_view what) {
    if (!good || !std::isfinite(value)) {
      throw InvalidInput(fmt::format("{} rate of fatigue is {:g}, expected {}", name, value, what));
    }
  };
  constexpr std::string_view kNotNegative = "zero or a positive number";
  require(rates.fatigue_per_s >= 0.0, "fatigue", rates.fatigue_per_s, kNotNegative);
  require(rates.recovery_per_s >= 0.0, "recovery", rates.recovery_per_s, kNotNegative);
  require(rates.rest_recovery_factor >= 0.0, "rest_recovery", rates.rest_recovery_factor, kNotNegative);
  require(rates.development_per_s > 0.0, "development", rates.development_per_s, "a positive number");
  require(rates.relaxation_per_s > 0.0, "relaxation", rates.relaxation_per_s, "a positive number");
}

FatigueState<double> step_fatigue(const FatigueRates<double>& rates,
                                  double target_load,
                                  const FatigueState<double>& state,
                                  double interval_s) {
  const double fastest = std::max({rates.development_per_s, rates.relaxation_per_s, rates.fatigue_per_s,
                                   rates.recovery_per_s * std::max(1.0, rates.rest_recovery_factor)});
  const double steps = std::max(1.0, std::ceil(interval_s * fastest * 20.0));
  const double h = interval_s / steps;
  const auto moved = [](const FatigueState<double>& s, const FatigueState<double>& r, double by) {
    return FatigueState<double>{s.active + by * r.active, s.resting + by * r.resting, s.fatigued + by * r.fatigued};
  };
  FatigueState<double> s = state;
  for (double k = 0.0; k < steps; ++k) {
    const auto k1 = fatigue_rate(rates, target_load, s);
    const auto k2 = fatigue_rate(rates, target_load, moved(s, k1, 0.5 * h));
    const auto k3 = fatigue_rate(rates, target_load, moved(s, k2, 0.5 * h));
    const auto k4 = fatigue_rate(rates, target_load, moved(s, k3, h));
    s = moved(moved(moved(moved(s, k1, h / 6.0), k2, h / 3.0), k3, h / 3.0), k4, h / 6.0);
  }
  return s;
}

FatigueRates<double> published_fatigue_rates(std::string_view name) {
  if (name == "elbow") return {.fatigue_per_s = 0.00912, .recovery_per_s = 0.00094};
  if (name == "elbow_rest") {
    return {.fatigue_per_s = 0.00912, .recovery_per_s = 0.00094, .rest_recovery_factor = 15.0};
  }
  if (name == "elbow_flexor") {
    return {.fatigue_per_s = 0.01703, .recovery_per_s = 0.00494, .rest_recovery_factor = 4.68};
  }
  if (name == "elbow_extensor") {
    return {.fatigue_per_s = 0.01559, .recovery_per_s = 0.00125, .rest_recovery_factor = 25.52};
  }
  throw InvalidInput(fmt::format(
      "no published fatigue rates named '{}'; there are elbow, elbow_rest, elbow_flexor, elbow_extensor", name));
}

}  // namespace myoid::muscle
