#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

namespace myoid::inline ground {

/// Calls `body(i)` for 0 .. count - 1 on `jobs` threads, each with its share of the program's
/// threads, and on at most `most_jobs`; after the first exception no further number begins, and the exception is
/// rethrown.
template <typename Body>
void in_jobs(std::size_t count, std::size_t jobs, const Body& body, std::size_t most_jobs = SIZE_MAX) {
  using Limit = oneapi::tbb::global_control;
  const std::size_t threads = Limit::active_value(Limit::max_allowed_parallelism);
  jobs = std::min({jobs == 0 ? threads : jobs, std::max<std::size_t>(count, 1), most_jobs});
  const int share = static_cast<int>(std::max<std::size_t>(threads / jobs, 1));
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr error;
  const auto work = [&] {
    try {
      oneapi::tbb::task_arena arena(share);
      for (std::size_t i = next++; i < count; i = next++) arena.execute([&] { body(i); });
    } catch (...) {
      const std::scoped_lock lock(mutex);
      if (!error) error = std::current_exception();
      next = count;
    }
  };
  std::vector<std::jthread> others;
  for (std::size_t k = 1; k < jobs; ++k) others.emplace_back(work);
  work();
  others.clear();
  if (error) std::rethrow_exception(error);
}

}  // namespace myoid::inline ground
