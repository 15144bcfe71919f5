#include "myoid/muscle/excitation_response.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::muscle {
namespace {

TEST(ExcitationResponse, HalfOfTheTroponinBindsCalciumAtTheHalfConcentration) {
  const CalciumBinding b{.half = 0.2, .cooperativity = 3.0, .length = 0.6, .rest = 0.01};
  EXPECT_NEAR(active_state(b, 0.2, 1.0), 0.01 + 0.99 / 2.0, 1e-15);
  // At 1 + 0.5 l0 the half concentration is 0.3 decades lower.
  EXPECT_NEAR(active_state(b, 0.2 * std::pow(10.0, -0.3), 1.5), 0.01 + 0.99 / 2.0, 1e-15);
  EXPECT_EQ(active_state(b, 0.0, 1.0), 0.01);
}

TEST(ExcitationResponse, TheActiveStateIsHatzesFormula) {
  // Hatze (1981) with the constants of Reuvers & Kistemaker: q0, kCa, a_act, b_act.
  constexpr double kCa = 8e-6, kA = -7.369163055099003, kB0 = 5.170927028993413, kB1 = 0.5955111970420514;
  const CalciumBinding b{.half = std::pow(10.0, -std::log10(kCa) - kB0 - kB1),
                         .cooperativity = -kA * std::log10(std::exp(1.0)),
                         .length = kB1};
  for (const double l : {0.7, 1.0, 1.3}) {
    for (const double g : {0.05, 0.2, 1.0}) {
      const double hatze =
          0.005 + 0.995 / (1.0 + std::pow(kCa * g, std::log10(std::exp(kA))) * std::exp(kA * (kB0 + kB1 * l)));
      EXPECT_NEAR(active_state(b, g, l), hatze, 1e-12);
    }
  }
  // The defaults are these constants, rounded.
  EXPECT_NEAR(CalciumBinding{}.half, b.half, 5e-4);
  EXPECT_NEAR(CalciumBinding{}.cooperativity, b.cooperativity, 5e-3);
  EXPECT_NEAR(CalciumBinding{}.length, b.length, 5e-4);
}

TEST(ExcitationResponse, NamesItsNumbersOnceAndCalciumsOnlyWhereItBinds) {
  ExcitationResponse response;
  std::set<std::string> names;
  const auto count = [&] {
    names.clear();
    visit_response(response, [&](std::string_view name, Unit, double&) { names.insert(std::string(name)); });
    return names.size();
  };
  EXPECT_EQ(count(), 4U);
  response.calcium.emplace();
  EXPECT_EQ(count(), 8U);
}

TEST(ExcitationResponse, RefusesWhatNoMuscleHas) {
  EXPECT_THROW(validate(ExcitationResponse{.delay_s = -0.1}), InvalidInput);
  ExcitationResponse response;
  response.calcium = CalciumBinding{.half = 1.5};
  EXPECT_THROW(validate(response), InvalidInput);
}

}  // namespace
}  // namespace myoid::muscle
