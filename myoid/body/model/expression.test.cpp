#include "myoid/body/model/expression.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/message_of.h"

namespace myoid::body {
namespace {

double value(std::string_view text, std::vector<double> at = {}) {
  static const std::vector<std::string> names{"q", "qdot"};
  at.resize(2);
  return Expression(text, names)(at);
}

TEST(Expression, PowersBindFirstFromTheRightThenTheSignThenProductsThenSums) {
  EXPECT_EQ(value("1+2*3-4/8"), 6.5);
  EXPECT_EQ(value("-2^2"), -4.0);
  EXPECT_EQ(value("2^3^2"), 512.0);
  EXPECT_EQ(value("2^-1*4"), 2.0);
  EXPECT_EQ(value("2*-3"), -6.0);
  EXPECT_EQ(value("8-3-2"), 3.0);
  EXPECT_EQ(value("16/4/2"), 2.0);
  EXPECT_EQ(value(" ( 1 + 2 ) * 3e-1 "), 3.0 * 0.3);
}

TEST(Expression, VariablesAndFunctionsHaveTheirValues) {
  EXPECT_EQ(value("q*qdot", {3.0, -2.0}), -6.0);
  // The stiff stop of a knee that users write.
  const double q = 0.3, u = -1.2;
  EXPECT_DOUBLE_EQ(value("-2*exp(4*(q-0.1))+0.5*exp(-3*(q+1.9))-0.1*qdot", {q, u}),
                   -2.0 * std::exp(4.0 * (q - 0.1)) + 0.5 * std::exp(-3.0 * (q + 1.9)) - 0.1 * u);
  EXPECT_DOUBLE_EQ(value("sqrt(q)+log(q)+sin(q)+cos(q)+tan(q)+abs(-q)+tanh(q)", {q, 0.0}),
                   std::sqrt(q) + std::log(q) + std::sin(q) + std::cos(q) + std::tan(q) + q + std::tanh(q));
  EXPECT_EQ(value("min(q, 2) + 10*max(q, 2)", {3.0}), 32.0);
  EXPECT_EQ(value("step(q)", {0.0}), 1.0);
  EXPECT_EQ(value("step(q)", {-1e-9}), 0.0);
  EXPECT_EQ(value("select(step(q-1), 5, 7)", {2.0}), 5.0);
  EXPECT_EQ(value("select(step(q-1), 5, 7)", {0.0}), 7.0);
  EXPECT_EQ(value("square(q)-cube(q)+recip(q)", {2.0}), 4.0 - 8.0 + 0.5);
  EXPECT_TRUE(std::isnan(value("sqrt(q)", {-1.0})));
}

TEST(Expression, DefinitionsMayFollow) {
  EXPECT_EQ(value("k*y^2; y=q-1; k = 50", {3.0}), 200.0);
  EXPECT_EQ(value("a;a=b;b=7;"), 7.0);
}

TEST(Expression, WhatIsNotUnderstoodIsNamed) {
  const auto message = [](std::string_view text) -> std::string {
    return test::message_of([&] { (void)value(text); });
  };
  EXPECT_NE(message("2*knee").find("'knee' is neither defined nor one of q, qdot"), std::string::npos);
  EXPECT_NE(message("foo(q)").find("no function 'foo'"), std::string::npos);
  EXPECT_NE(message("(1+2").find("expected )"), std::string::npos);
  EXPECT_NE(message("1+").find("it ends"), std::string::npos);
  EXPECT_NE(message("").find("it ends"), std::string::npos);
  EXPECT_NE(message("1 2").find("'2' is not expected, at character 3"), std::string::npos);
  EXPECT_NE(message("min(1)").find("takes 2 values"), std::string::npos);
  EXPECT_NE(message("a;a=a+1").find("refers to itself"), std::string::npos);
  EXPECT_NE(message("q;=3").find("name=formula"), std::string::npos);
}

TEST(Expression, NeitherDepthNorLengthBringsItDown) {
  EXPECT_THROW((void)value(std::string(100000, '(')), InvalidInput);
  EXPECT_THROW((void)value(std::string(100000, '-') + "1"), InvalidInput);
  std::string doubling = "a0";
  for (int i = 0; i < 40; ++i)
    doubling += ";a" + std::to_string(i) + "=a" + std::to_string(i + 1) + "+a" + std::to_string(i + 1);
  EXPECT_THROW((void)value(doubling + ";a40=1"), InvalidInput);
  std::string sum = "1";
  for (int i = 0; i < 5000; ++i) sum += "+1";
  EXPECT_EQ(value(sum), 5001.0);
}

}  // namespace
}  // namespace myoid::body
