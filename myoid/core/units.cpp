#include "myoid/core/units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <utility>

namespace myoid {
namespace {

struct UnitWord {
  std::string_view word;
  ScaledUnit unit;
};

constexpr std::array kExactWords = {
    UnitWord{"1", {Unit::dimensionless, 1.0}},
    UnitWord{"-", {Unit::dimensionless, 1.0}},
    UnitWord{"%", {Unit::dimensionless, 0.01}},
    UnitWord{"s", {Unit::second, 1.0}},
    UnitWord{"sec", {Unit::second, 1.0}},
    UnitWord{"ms", {Unit::second, 1e-3}},
    UnitWord{"Hz", {Unit::hertz, 1.0}},
    UnitWord{"m", {Unit::meter, 1.0}},
    UnitWord{"dm", {Unit::meter, 0.1}},
    UnitWord{"cm", {Unit::meter, 1e-2}},
    UnitWord{"mm", {Unit::meter, 1e-3}},
    UnitWord{"m/s", {Unit::meter_per_second, 1.0}},
    UnitWord{"m/s^2", {Unit::meter_per_second2, 1.0}},
    UnitWord{"deg", {Unit::radian, kDegree}},
    UnitWord{"°", {Unit::radian, kDegree}},
    UnitWord{"rad", {Unit::radian, 1.0}},
    UnitWord{"rad/s", {Unit::radian_per_second, 1.0}},
    UnitWord{"deg/s", {Unit::radian_per_second, kDegree}},
    UnitWord{"N", {Unit::newton, 1.0}},
    UnitWord{"kN", {Unit::newton, 1e3}},
    UnitWord{"kgf", {Unit::newton, 9.80665}},  // standard gravity, exactly
    UnitWord{"kp", {Unit::newton, 9.80665}},
    UnitWord{"lbf", {Unit::newton, 4.4482216152605}},  // 0.45359237 kg times standard gravity
    UnitWord{"Nm", {Unit::newton_meter, 1.0}},
    UnitWord{"N m", {Unit::newton_meter, 1.0}},
    UnitWord{"N*m", {Unit::newton_meter, 1.0}},
    UnitWord{"N.m", {Unit::newton_meter, 1.0}},
    UnitWord{"N·m", {Unit::newton_meter, 1.0}},
    UnitWord{"Nmm", {Unit::newton_meter, 1e-3}},
    UnitWord{"N mm", {Unit::newton_meter, 1e-3}},
    UnitWord{"N.mm", {Unit::newton_meter, 1e-3}},
    UnitWord{"kg", {Unit::kilogram, 1.0}},
    UnitWord{"g", {Unit::kilogram, 1e-3}},
    UnitWord{"V", {Unit::volt, 1.0}},
    UnitWord{"mV", {Unit::volt, 1e-3}},
    UnitWord{"uV", {Unit::volt, 1e-6}},
    UnitWord{"µV", {Unit::volt, 1e-6}},  // micro sign
    UnitWord{"μV", {Unit::volt, 1e-6}},  // Greek mu
    UnitWord{"nV", {Unit::volt, 1e-9}},
};

// Spelled out, in any case.
constexpr std::array kLongWords = {
    UnitWord{"mm", {Unit::meter, 1e-3}},          UnitWord{"cm", {Unit::meter, 1e-2}},
    UnitWord{"meters", {Unit::meter, 1.0}},       UnitWord{"meter", {Unit::meter, 1.0}},
    UnitWord{"metres", {Unit::meter, 1.0}},       UnitWord{"millimeters", {Unit::meter, 1e-3}},
    UnitWord{"millimetres", {Unit::meter, 1e-3}}, UnitWord{"centimeters", {Unit::meter, 1e-2}},
    UnitWord{"degrees", {Unit::radian, kDegree}}, UnitWord{"degree", {Unit::radian, kDegree}},
    UnitWord{"radians", {Unit::radian, 1.0}},     UnitWord{"volts", {Unit::volt, 1.0}},
    UnitWord{"volt", {Unit::volt, 1.0}},          UnitWord{"millivolts", {Unit::volt, 1e-3}},
    UnitWord{"millivolt", {Unit::volt, 1e-3}},    UnitWord{"microvolts", {Unit::volt, 1e-6}},
    UnitWord{"microvolt", {Unit::volt, 1e-6}},    UnitWord{"newtons", {Unit::newton, 1.0}},
    UnitWord{"seconds", {Unit::second, 1.0}},     UnitWord{"hz", {Unit::hertz, 1.0}},
};

}  // namespace

std::string_view symbol(Unit unit) {
  switch (unit) {
    case Unit::dimensionless:
      return "1";
    case Unit::second:
      return "s";
    case Unit::hertz:
      return "Hz";
    case Unit::meter:
      return "m";
    case Unit::meter_per_second:
      return "m/s";
    case Unit::meter_per_second2:
      return "m/s^2";
    case Unit::radian:
      return "rad";
    case Unit::radian_per_second:
      return "rad/s";
    case Unit::radian_per_second2:
      return "rad/s^2";
    case Unit::newton:
      return "N";
    case Unit::newton_meter:
      return "N m";
    case Unit::newton_per_meter:
      return "N/m";
    case Unit::newton_second_per_meter:
      return "N s/m";
    case Unit::newton_meter_second:
      return "N m s";
    case Unit::kilogram:
      return "kg";
    case Unit::kilogram_meter2:
      return "kg m^2";
    case Unit::volt:
      return "V";
  }
  return "?";
}

std::optional<ScaledUnit> parse_unit(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0) {
    text.remove_prefix(1);
  }
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) {
    text.remove_suffix(1);
  }
  const auto matches = [&](const UnitWord& entry) { return entry.word == text; };
  if (const auto* it = std::find_if(kExactWords.begin(), kExactWords.end(), matches); it != kExactWords.end()) {
    return it->unit;
  }
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto matches_lower = [&](const UnitWord& entry) { return entry.word == lower; };
  if (const auto* it = std::find_if(kLongWords.begin(), kLongWords.end(), matches_lower); it != kLongWords.end()) {
    return it->unit;
  }
  return std::nullopt;
}

}  // namespace myoid
