#include "myoid/muscle/isolated_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/core/error.h"

namespace myoid::muscle {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

IsolatedModel muscle_of_two_newtons() {
  const double l0 = 0.02;
  const MusculotendonLaws laws = millard_laws();
  IsolatedModel model{.laws = laws};
  model.parameters = published_defaults({.max_isometric_force_n = 2.0,
                                         .optimal_fiber_length_m = l0,
                                         .force_length_width_m = 0.45 * l0,
                                         .concentric_curvature = 0.25,
                                         .eccentric_curvature_product = 0.04,
                                         .eccentric_plateau = 1.4,
                                         .max_shortening_speed_mps = 6.0 * l0,
                                         .tendon_slack_length_m = l0},
                                        laws);
  return model;
}

/// The muscle's own force while its length swings by `amplitude_m`.
IsolatedRecording swing(double amplitude_m, const std::string& name) {
  IsolatedRecording r{.name = name};
  r.input.time_s = Eigen::VectorXd::LinSpaced(41, 0.0, 1.0);
  r.input.length_m = (0.0405 + amplitude_m * (14.0 * r.input.time_s.array()).sin()).matrix();
  r.input.drive = Eigen::VectorXd::Ones(1);
  r.time_s = Eigen::VectorXd::LinSpaced(60, 0.0, 0.98);
  r.force_n = isolated_force(muscle_of_two_newtons(), r);
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
  const IsolatedModel muscle = muscle_of_two_newtons();
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
