#include "myoid/ground/core/in_jobs.h"

#include <array>
#include <stdexcept>

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

TEST(InJobs, EveryNumberIsMetOnceByAnyNumberOfJobs) {
  for (const std::size_t jobs : {0U, 1U, 3U, 100U}) {
    std::array<std::atomic<int>, 20> met{};
    in_jobs(met.size(), jobs, [&](std::size_t i) { ++met[i]; });
    for (const std::atomic<int>& times : met) EXPECT_EQ(times, 1) << jobs;
  }
  in_jobs(0, 2, [](std::size_t) { FAIL(); });
}

TEST(InJobs, AnExceptionEndsTheJobsAndReachesTheCaller) {
  std::atomic<int> begun = 0;
  EXPECT_THROW(in_jobs(1000, 1,
                       [&](std::size_t i) {
                         ++begun;
                         if (i == 2) throw std::runtime_error("third");
                       }),
               std::runtime_error);
  EXPECT_EQ(begun, 3);
}

}  // namespace
}  // namespace myoid::inline ground
