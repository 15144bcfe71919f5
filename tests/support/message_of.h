#pragma once

#include <functional>
#include <string>

#include "myoid/ground/core/error.h"

namespace myoid::test {

/// What an action complains of: the text of its InvalidInput, or "(no error)".
inline std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "(no error)";
}

}  // namespace myoid::test
