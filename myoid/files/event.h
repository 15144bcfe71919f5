#pragma once

#include <string>

namespace myoid::recording {

/// An instant that somebody marked.
struct Event {
  double time_s = 0.0;  ///< On the clock of the file, whose frame 1 is at 0 s.
  std::string label;
  std::string context;  ///< "Left", "Right", "General"; empty where there is none.
  std::string subject;

  friend bool operator==(const Event&, const Event&) = default;
};

}  // namespace myoid::recording
