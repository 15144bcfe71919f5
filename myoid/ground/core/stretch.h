#pragma once

namespace myoid::inline ground {

/// A stretch of time, ends included.
struct Stretch {
  double begin_s = 0.0, end_s = 0.0;
};

}  // namespace myoid::inline ground
