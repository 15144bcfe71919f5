#include "myoid/ground/core/parallel.h"

#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

TEST(ParallelRanges, MeetEveryNumberOnceForEveryNumberOfThreads) {
  for (const std::size_t threads : {1, 2, 4}) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    for (const long count : {0L, 1L, 7L, 64L, 1000L}) {
      std::vector<int> met(static_cast<std::size_t>(count), 0);
      parallel_ranges(count, 7L, [&](const auto& range) {
        for (long i = range.begin(); i != range.end(); ++i) ++met[static_cast<std::size_t>(i)];
      });
      EXPECT_EQ(met, std::vector<int>(met.size(), 1)) << count << " on " << threads;
    }
  }
}

TEST(ParallelRanges, ThrowWhatTheBodyThrows) {
  for (const std::size_t threads : {1, 2}) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_THROW(parallel_ranges(100, 3,
                                 [](const auto& range) {
                                   if (range.end() > 50) throw std::runtime_error("half way");
                                 }),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace myoid::inline ground
