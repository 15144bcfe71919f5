#include "myoid/ground/math/ode.h"

#include <cmath>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground::math {

std::string_view explain(OdeStatus status) {
  switch (status) {
    case OdeStatus::done:
      return "integrated to the end";
    case OdeStatus::too_many_steps:
      return "the largest number of steps was not enough: the problem is stiff for this method, or the tolerance too "
             "small";
    case OdeStatus::step_too_small:
      return "no step was short enough for the tolerance: the right-hand side jumps, or the tolerance is below "
             "round-off";
    case OdeStatus::not_finite:
      return "the right-hand side is not finite";
    case OdeStatus::rate_failed:
      return "the right-hand side cannot be evaluated";
    case OdeStatus::stopped:
      return "stopped on request";
    case OdeStatus::solver_failed:
      return "the implicit solver did not converge";
  }
  return "";
}

void validate(const OdeOptions& options, long state_count) {
  const auto positive = [](double value, const char* what) {
    if (!(value > 0.0)) {
      throw InvalidInput(fmt::format("{} is {}, expected a positive number", what, value));
    }
  };
  positive(options.relative_tolerance, "relative_tolerance");
  positive(options.absolute_tolerance, "absolute_tolerance");
  positive(options.max_step_s, "max_step_s");
  if (!(options.first_step_s >= 0.0) || !std::isfinite(options.first_step_s)) {
    throw InvalidInput(fmt::format("first_step_s is {}, expected 0 (chosen) or more", options.first_step_s));
  }
  if (!options.absolute_tolerances.empty() && static_cast<long>(options.absolute_tolerances.size()) != state_count) {
    throw InvalidInput(
        fmt::format("{} absolute tolerances for {} states", options.absolute_tolerances.size(), state_count));
  }
  for (const double value : options.absolute_tolerances) positive(value, "absolute tolerance");
}

}  // namespace myoid::inline ground::math
