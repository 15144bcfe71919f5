#include "myoid/ground/core/parallel_in_order.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

using Limit = oneapi::tbb::global_control;

TEST(ParallelInOrder, TakesEveryPieceOnceInOrderFromItsOwnSlot) {
  for (const std::size_t threads : {1, 2, 4}) {
    const Limit limit(Limit::max_allowed_parallelism, threads);
    for (const std::size_t count : {0U, 1U, 5U, 1000U}) {
      std::vector<std::size_t> slots(3, 0), taken;
      parallel_in_order(
          count, slots.size(), [&](std::size_t i, std::size_t slot) { slots[slot] = 7 * i; },
          [&](std::size_t i, std::size_t slot) {
            EXPECT_EQ(slots[slot], 7 * i) << "another piece took the slot";
            taken.push_back(i);
          });
      ASSERT_EQ(taken.size(), count);
      for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(taken[i], i);
    }
  }
}

TEST(ParallelInOrder, ThrowsWhatAPieceThrows) {
  for (const std::size_t threads : {1, 2}) {
    const Limit limit(Limit::max_allowed_parallelism, threads);
    const auto nothing = [](std::size_t, std::size_t) {};
    const auto late = [](std::size_t i, std::size_t) {
      if (i == 40) throw std::runtime_error("full");
    };
    EXPECT_THROW(parallel_in_order(100, 4, nothing, late), std::runtime_error);
    EXPECT_THROW(parallel_in_order(100, 4, late, nothing), std::runtime_error);
  }
}

}  // namespace
}  // namespace myoid::inline ground
