#pragma once

#include "myoid/ground/core/progress.h"

namespace myoid::inline ground {

/// Returns the progress of a part of the work, whose shares go from `from` to `to` of the whole.
[[nodiscard]] inline Progress part_of(const Progress& whole, double from, double to) {
  if (!whole.report) return whole;
  return {.report = [report = whole.report, from, to](
                        double share, std::string_view what) { report(from + (to - from) * share, what); },
          .stop = whole.stop};
}

}  // namespace myoid::inline ground
