#include "myoid/muscle/isolated_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/small_muscle.h"

namespace myoid::muscle {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// The muscle's own force while its length swings by `amplitude_m`.
IsolatedRecording swing(double amplitude_m, const std::string& name) {
  IsolatedRecording r = test::swing(amplitude_m, name);
  r.force_n = isolated_force(test::small_muscle(), r);
  return r;
}

TEST(IsolatedChecks, AForceInAnotherUnitIsSuspiciousOrRefused) {
  const auto of_scale = [](double scale) {
    IsolatedRecording r = swing(0.001, "r");
    r.force_n *= scale * 2.0 / r.force_n.maxCoeff();  // scale times F_max
    return std::vector{r};
  };
  EXPECT_THAT(check_force_size(of_scale(4.9), 2.0), IsEmpty());
  EXPECT_THAT(check_force_size(of_scale(0.021), 2.0), IsEmpty());
  EXPECT_THAT(check_force_size(of_scale(5.1), 2.0), ElementsAre(HasSubstr("another unit")));
  EXPECT_THAT(check_force_size(of_scale(0.019), 2.0), ElementsAre(HasSubstr("another unit")));
  EXPECT_THROW((void)check_force_size(of_scale(51.0), 2.0), InvalidInput);
}

TEST(IsolatedChecks, ExchangedRecordingsAreNamed) {
  std::vector<IsolatedRecording> recordings{swing(0.0002, "small"), swing(0.003, "large")};
  const IsolatedModel muscle = test::small_muscle();
  EXPECT_EQ(mean_force_error(muscle, recordings[1], 1e-9), 0.0);
  EXPECT_THAT(check_recording_order(muscle, recordings, 1e-8), IsEmpty());
  std::swap(recordings[0].force_n, recordings[1].force_n);
  EXPECT_THAT(check_recording_order(muscle, recordings, 1e-8),
              ElementsAre(HasSubstr("small and large fit each other's length")));
  recordings[0].time_s.array() += 0.5;  // beyond the lengths of the other
  EXPECT_THAT(check_recording_order(muscle, recordings, 1e-8), IsEmpty());
}

}  // namespace
}  // namespace myoid::muscle
