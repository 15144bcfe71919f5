#pragma once

#include <algorithm>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

namespace myoid {

/// Calls `body(range)` with ranges that together are 0 .. count - 1, `grain` numbers or more each,
/// on as many threads as there may be: body must not care which numbers share a range. On one
/// thread in order, without the scheduler, whose start takes longer than a small trial. What a
/// body throws is thrown here.
template <typename Index, typename Body>
void parallel_ranges(Index count, Index grain, const Body& body) {
  using Range = oneapi::tbb::blocked_range<Index>;
  using Limit = oneapi::tbb::global_control;
  if (count <= grain || Limit::active_value(Limit::max_allowed_parallelism) <= 1) {
    for (Index begin = 0; begin < count; begin += grain)
      body(Range(begin, std::min<Index>(count, begin + grain)));
    return;
  }
  oneapi::tbb::parallel_for(Range(0, count, static_cast<std::size_t>(grain)), body);
}

}  // namespace myoid
