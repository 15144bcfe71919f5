#pragma once

#include <string_view>

#include "myoid/ground/core/units.h"

namespace myoid::page {

/// A unit in which people say a quantity, and the factor from SI to it. For display only: files are in SI units.
struct PlainUnit {
  std::string_view symbol;  ///< "cm"; empty: dimensionless.
  double per_si = 1.0;
};

/// Returns cm for lengths, ms for times, ° for angles, else the SI unit.
[[nodiscard]] PlainUnit plain_unit(Unit unit);

}  // namespace myoid::page
