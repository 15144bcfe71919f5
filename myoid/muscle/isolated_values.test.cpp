#include "myoid/muscle/isolated_values.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/small_muscle.h"

namespace myoid::muscle {
namespace {

TEST(IsolatedValues, ANameLeadsToItsFieldWithItsUnit) {
  IsolatedModel model = test::small_muscle();
  const IsolatedField length = field_of(model, "tendon_slack_length");
  EXPECT_EQ(length.value, &model.parameters.hill.tendon_slack_length_m);
  EXPECT_EQ(length.unit, Unit::meter);
  EXPECT_EQ(field_of(model, "excitation_delay").value, &model.response.delay_s);
  EXPECT_THROW((void)field_of(model, "strength"), InvalidInput);
}

TEST(IsolatedValues, StartsAreThoseOfTheCurvesUnderMillardsLaw) {
  IsolatedModel model = test::small_muscle();
  model.millard.velocity.max_eccentric_multiplier = 1.55;
  model.millard.passive.strain_at_one = 0.6;
  EXPECT_EQ(start_of(model, "eccentric_plateau"), 1.55);
  EXPECT_EQ(start_of(model, "passive_strain"), 0.6);
  model.laws = thelen_laws();
  EXPECT_EQ(start_of(model, "eccentric_plateau"), model.parameters.hill.eccentric_plateau);
  EXPECT_EQ(start_of(model, "passive_strain"), model.parameters.passive_strain);
}

TEST(IsolatedValues, TheModelTakesTheValuesOfTheLogarithms) {
  const IsolatedModel start = test::small_muscle();
  const std::vector<std::string> names{"max_isometric_force", "optimal_fiber_length", "passive_strain"};
  const Eigen::Vector3d up(std::log(1.5), std::log(0.8), std::log(1.25));
  const IsolatedModel model = with_values(start, names, logs_of(start, names) + up);
  const HillParameters<double>& hill = model.parameters.hill;
  EXPECT_NEAR(hill.max_isometric_force_n, 1.5 * 2.0, 1e-14);
  EXPECT_NEAR(hill.optimal_fiber_length_m, 0.8 * 0.02, 1e-16);
  // The curve from its slack to its strain keeps its shape: the end's slope is twice the chord's.
  EXPECT_NEAR(model.millard.passive.strain_at_one, 1.25 * start.millard.passive.strain_at_one, 1e-14);
  EXPECT_NEAR(model.millard.passive.stiffness_at_one * model.millard.passive.strain_at_one, 2.0, 1e-14);
  EXPECT_EQ(hill.max_shortening_speed_mps, start.parameters.hill.max_shortening_speed_mps);
}

TEST(IsolatedValues, TheWidthKeepsItsShareOfTheOptimalLengthUnlessItIsNamed) {
  const IsolatedModel start = test::small_muscle();
  const auto width_of = [&](const std::vector<std::string>& names) {
    const Eigen::VectorXd up = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(names.size()), std::log(1.1));
    return with_values(start, names, logs_of(start, names) + up).parameters.hill.force_length_width_m;
  };
  const double width_m = start.parameters.hill.force_length_width_m;
  EXPECT_EQ(width_of({"max_isometric_force"}), width_m);
  EXPECT_NEAR(width_of({"optimal_fiber_length"}), 1.1 * width_m, 1e-15);
  EXPECT_NEAR(width_of({"optimal_fiber_length", "force_length_width"}), 1.1 * width_m, 1e-15);
  EXPECT_NEAR(width_of({"force_length_width"}), 1.1 * width_m, 1e-15);
}

}  // namespace
}  // namespace myoid::muscle
