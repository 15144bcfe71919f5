#include "myoid/ground/math/ode_events.h"

#include <array>

#include <gtest/gtest.h>

namespace myoid::inline ground::math {
namespace {

TEST(EventSigns, AChangeOfSignIsSeenOnce) {
  EventSigns signs(2);
  signs.start(std::array{1.0, -1.0});
  EXPECT_FALSE(signs.crossed(std::array{0.5, -0.5}));
  EXPECT_TRUE(signs.crossed(std::array{-1e-6, -0.5}));
  signs.pass(std::array{-1e-6, -0.5});
  EXPECT_FALSE(signs.crossed(std::array{-0.5, -0.5}));
  EXPECT_TRUE(signs.crossed(std::array{0.5, -0.5}));
}

TEST(EventSigns, WhatRestsAtZeroHasNoSign) {
  EventSigns signs(1);
  signs.start(std::array{0.0});
  EXPECT_FALSE(signs.crossed(std::array{-1.0}));
  signs.learn(std::array{-1.0});
  signs.learn(std::array{1e-12});  // round-off about zero is no crossing and sets no sign
  EXPECT_FALSE(signs.crossed(std::array{1e-12}));
  EXPECT_TRUE(signs.crossed(std::array{1.0}));
}

}  // namespace
}  // namespace myoid::inline ground::math
