#pragma once

#include <functional>
#include <stop_token>
#include <string_view>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground {

/// Reports the progress of a long stage and stops it on request. The library itself prints nothing.
struct Progress {
  /// Called with the finished share in 0..1 and the name of the work; may be empty. Must be thread-safe.
  std::function<void(double share, std::string_view what)> report;
  std::stop_token stop;

  void tell(double share, std::string_view what) const {
    if (report) report(share, what);
  }
  /// Throws Interrupted once a stop has been requested.
  void check() const {
    if (stop.stop_requested()) throw Interrupted();
  }
};

}  // namespace myoid::inline ground
