#pragma once

#include <algorithm>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

namespace myoid::inline ground {

/// Calls `body(range)` with ranges that together are 0 .. count - 1, each of at least `grain` numbers, on as many
/// threads as the program may use; body must not depend on the ranges. On one thread the ranges come in order and
/// without the scheduler, whose start takes longer than a small trial. Exceptions of body are rethrown here.
template <typename Index, typename Body>
void parallel_ranges(Index count, Index grain, const Body& body) {
  using Range = oneapi::tbb::blocked_range<Index>;
  using Limit = oneapi::tbb::global_control;
  if (count <= grain || Limit::active_value(Limit::max_allowed_parallelism) <= 1) {
    for (Index begin = 0; begin < count; begin += grain) body(Range(begin, std::min<Index>(count, begin + grain)));
    return;
  }
  oneapi::tbb::parallel_for(Range(0, count, static_cast<std::size_t>(grain)), body);
}

}  // namespace myoid::inline ground
