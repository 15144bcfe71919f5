#pragma once

#include <algorithm>
#include <cstddef>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_group.h>

namespace myoid::inline ground {

/// Runs oneTBB's parallel_for with these arguments. The loop has a context of its own: where another part of a loop
/// around it throws, it runs to its end. In the context of that loop it would end without a word and without its work,
/// and the body would go on with numbers that nobody computed. Exceptions of body are rethrown here.
template <typename... Arguments>
void parallel_loop(const Arguments&... arguments) {
  oneapi::tbb::task_group_context own(oneapi::tbb::task_group_context::isolated);
  oneapi::tbb::parallel_for(arguments..., own);
}

/// Calls `body(i)` for 0 .. count - 1 in parallel, each index as a task.
template <typename Body>
void parallel_each(std::size_t count, const Body& body) {
  parallel_loop(std::size_t{0}, count, body);
}

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
  parallel_loop(Range(0, count, static_cast<std::size_t>(grain)), body);
}

}  // namespace myoid::inline ground
