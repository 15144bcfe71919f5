#pragma once

#include <functional>
#include <string>

#include "myoid/ground/core/error.h"

namespace myoid::test {

/// What an action complains of: the text of its error of this type, or "(no error)". Other errors pass.
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
