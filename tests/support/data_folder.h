#pragma once

#include <filesystem>

#include "tests/support/places.h"

/// Skips the running test when the shared data set lacks `path`.
#define MYOID_REQUIRE_DATA(path)                                                          \
  do {                                                                                    \
    if (!std::filesystem::exists(path)) {                                                 \
      GTEST_SKIP() << "needs " << (path) << "; set MYOID_DATA to the shared data folder"; \
    }                                                                                     \
  } while (false)
