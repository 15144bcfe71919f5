#include "myoid/muscle/hill_parameters.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/core/nearest_word.h"

namespace myoid::muscle {

const HillField& hill_field(std::string_view name) {
  for (const HillField& field : kHillFields) {
    if (field.name == name) return field;
  }
  throw InvalidInput(
      fmt::format("no muscle parameter is named '{}'{}", name, not_among(name, kHillFields, &HillField::name)));
}

void validate(const HillParameters<double>& parameters) {
  for (const HillField& field : kHillFields) {
    const double value = parameters.*field.member;
    const bool may_be_zero = field.name == "tendon_slack_length";
    if (!std::isfinite(value) || value < 0.0 || (value == 0.0 && !may_be_zero)) {
      throw InvalidInput(fmt::format("{} = {} {}: expected a {} number", field.name, value, symbol(field.unit),
                                     may_be_zero ? "finite, not negative" : "finite, positive"));
    }
  }
}

}  // namespace myoid::muscle
