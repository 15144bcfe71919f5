#include "myoid/ground/core/units.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <utility>

namespace myoid::inline ground {
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
    UnitWord{"mN", {Unit::newton, 1e-3}},
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
    UnitWord{"W", {Unit::watt, 1.0}},
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
  // In the order of Unit.
  constexpr std::array<std::string_view, 18> kSymbols{"1",     "s",     "Hz",      "m",      "m/s", "m/s^2",
                                                      "rad",   "rad/s", "rad/s^2", "N",      "N m", "N/m",
                                                      "N s/m", "N m s", "kg",      "kg m^2", "V",   "W"};
  static_assert(kSymbols.size() == static_cast<std::size_t>(Unit::watt) + 1);
  return kSymbols.at(static_cast<std::size_t>(unit));
}

std::optional<ScaledUnit> parse_unit(std::string_view text) {
  const auto is_blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  const auto found = [](const auto& words, std::string_view word) -> std::optional<ScaledUnit> {
    const auto it = std::ranges::find(words, word, &UnitWord::word);
    return it == words.end() ? std::nullopt : std::optional(it->unit);
  };
  if (const auto unit = found(kExactWords, text)) return unit;
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return found(kLongWords, lower);
}

}  // namespace myoid::inline ground
