#include "myoid/muscle/excitation_response.h"

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::muscle {

void validate(const ExcitationResponse& response) {
  validate(response.activation);
  const auto require = [](bool good, std::string_view name, double value, std::string_view expected) {
    if (!good || !std::isfinite(value))
      throw InvalidInput(fmt::format("{} = {:g}: expected {}", name, value, expected));
  };
  require(response.delay_s >= 0.0 && response.delay_s < 1.0, "excitation_delay", response.delay_s, "0 to 1 s");
  if (!response.calcium) return;
  const CalciumBinding& b = *response.calcium;
  require(b.half > 0.0 && b.half < 1.0, "calcium_half", b.half, "a share between 0 and 1");
  require(b.cooperativity > 0.0, "calcium_cooperativity", b.cooperativity, "a positive number");
  require(b.length >= 0.0, "calcium_length", b.length, "zero or a positive number");
  require(b.rest > 0.0 && b.rest < 1.0, "calcium_rest", b.rest, "a share between 0 and 1");
}

}  // namespace myoid::muscle
