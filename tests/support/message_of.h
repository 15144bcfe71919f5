#pragma once

#include <functional>
#include <string>

#include "myoid/ground/core/error.h"

namespace myoid::test {

/// Returns the text of the error of this type that an action throws, or "(no error)". Other errors pass through.
template <typename Error = InvalidInput>
std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "(no error)";
}

}  // namespace myoid::test
