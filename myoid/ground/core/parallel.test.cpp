#include "myoid/ground/core/parallel.h"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
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

// A study that is interrupted: one fold throws while another computes with loops of its own.
TEST(ParallelEach, RunsWholeInsideALoopThatAnotherPartHasEndedByAnError) {
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, 2);
  std::atomic<bool> begun = false;
  std::atomic<int> met = 0, in_ranges = 0;
  const auto wait_for = [](const auto& condition) {
    for (int i = 0; i < 2000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  EXPECT_THROW(parallel_each(2,
                             [&](std::size_t part) {
                               if (part == 0) {
                                 wait_for([&] { return begun.load(); });
                                 throw std::runtime_error("interrupted");
                               }
                               begun = true;
                               wait_for([] { return oneapi::tbb::is_current_task_group_canceling(); });
                               parallel_each(100, [&](std::size_t) { ++met; });
                               parallel_ranges(100, 7,
                                               [&](const auto& range) { in_ranges += static_cast<int>(range.size()); });
                             }),
               std::runtime_error);
  EXPECT_EQ(met, begun ? 100 : 0);
  EXPECT_EQ(in_ranges, begun ? 100 : 0);
}

}  // namespace
}  // namespace myoid::inline ground
