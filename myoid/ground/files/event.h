#pragma once

#include <string>

namespace myoid::inline ground {

/// An instant that a person marked.
struct Event {
  double time_s = 0.0;  ///< On the file's clock, whose frame 1 is at 0 s.
  std::string label;
  std::string context;  ///< "Left", "Right", "General", or empty.
  std::string subject;

  friend bool operator==(const Event&, const Event&) = default;
};

}  // namespace myoid::inline ground
