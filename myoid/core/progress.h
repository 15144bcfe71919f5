#pragma once

#include <functional>
#include <stop_token>
#include <string_view>

#include "myoid/core/error.h"

namespace myoid {

/// How a long stage reports and how it is stopped. The library itself prints nothing.
struct Progress {
  /// Called with the done share in 0..1 and what is being done; may be empty. Must be thread-safe.
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

}  // namespace myoid
