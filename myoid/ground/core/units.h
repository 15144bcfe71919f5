#pragma once

#include <optional>
#include <string_view>

namespace myoid::inline ground {

/// SI units of quantities inside the library. Readers convert to these; only the report and the writers convert back.
enum class Unit {
  dimensionless,
  second,
  hertz,
  meter,
  meter_per_second,
  meter_per_second2,
  radian,
  radian_per_second,
  radian_per_second2,
  newton,
  newton_meter,
  newton_per_meter,
  newton_second_per_meter,
  newton_meter_second,
  kilogram,
  kilogram_meter2,
  volt,
  watt,
};

/// Returns the printed symbol: "m", "m/s", "N m", "1" for a dimensionless quantity.
[[nodiscard]] std::string_view symbol(Unit unit);

/// A unit as written in a file, and the factor that brings its numbers to SI.
struct ScaledUnit {
  Unit unit = Unit::dimensionless;
  double to_si = 1.0;

  friend bool operator==(const ScaledUnit&, const ScaledUnit&) = default;
};

/// Recognizes the unit words of laboratory files ("mm", "cm", "m", "uV", "mV", "V", "deg", "rad", "N", "Nmm", "N m",
/// "ms", "s", "kg", "1", ...). Blanks around the word are ignored. Empty: not a known unit. Case matters only where it
/// changes the meaning ("mV" and "MV"); "MM" and "METERS" are accepted.
[[nodiscard]] std::optional<ScaledUnit> parse_unit(std::string_view text);

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kDegree = kPi / 180.0;       ///< One degree [rad].
inline constexpr double kStandardGravity = 9.80665;  ///< [m/s^2]

}  // namespace myoid::inline ground
