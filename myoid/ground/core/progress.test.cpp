#include "myoid/ground/core/progress.h"

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

TEST(Progress, ThrowsInterruptedOnceAStopIsRequested) {
  std::stop_source source;
  const Progress progress{.report = {}, .stop = source.get_token()};
  EXPECT_NO_THROW(progress.check());
  source.request_stop();
  EXPECT_THROW(progress.check(), Interrupted);
}

}  // namespace
}  // namespace myoid::inline ground
