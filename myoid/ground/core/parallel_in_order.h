#pragma once

#include <cstddef>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_pipeline.h>

namespace myoid::inline ground {

/// Calls `make(i, slot)` for i = 0 .. count - 1 on as many threads as the program may use, and
/// `take(i, slot)` one by one in order. A slot, 0 .. `slots` - 1, is free again once its number is
/// taken, so that at most `slots` pieces exist at a time. On one thread all calls are in order,
/// without the scheduler. Exceptions of make or take are rethrown here.
template <typename Make, typename Take>
void parallel_in_order(std::size_t count, std::size_t slots, const Make& make, const Take& take) {
  namespace tbb = oneapi::tbb;
  using Limit = tbb::global_control;
  if (count <= 1 || Limit::active_value(Limit::max_allowed_parallelism) <= 1) {
    for (std::size_t i = 0; i < count; ++i) {
      make(i, std::size_t{0});
      take(i, std::size_t{0});
    }
    return;
  }
  std::size_t next = 0;
  const auto number = [&](tbb::flow_control& control) {
    if (next == count) control.stop();
    return next++;
  };
  const auto made = [&](std::size_t i) {
    make(i, i % slots);
    return i;
  };
  tbb::parallel_pipeline(slots, tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, number) &
                                    tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel, made) &
                                    tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order,
                                                                        [&](std::size_t i) { take(i, i % slots); }));
}

}  // namespace myoid::inline ground
