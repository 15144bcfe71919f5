#include "myoid/fit/measurement/muscle_rows.h"

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"

namespace myoid::fit {
namespace {

using Chain = ParameterMap::Chain;

/// Three samples of one muscle, with a stretch, a shortening and rest.
struct Samples {
  std::vector<Activation> activation;
  Eigen::Vector3d length_m{0.36, 0.38, 0.37}, velocity_mps{-0.2, 0.15, 0.0};
  MuscleValues values = muscle_values(body::arm4_muscles()[0]);

  Samples() {
    for (const double a : {0.2, 0.5, 0.9}) {
      Activation at{.value = a, .by_log_envelope = 1.3 * a};
      at.by_field[kGain] = 0.7 * a;
      activation.push_back(at);
    }
  }
  [[nodiscard]] MuscleRows rows(const std::vector<Chain>& of_muscle, const std::vector<Chain>& of_channel) const {
    MuscleRows r;
    evaluate_muscle(activation, length_m, velocity_mps, values, of_muscle, of_channel, r);
    return r;
  }
};

TEST(MuscleRows, AreTheTensionsAndWhatTheChainsMakeOfTheirDerivatives) {
  Samples s;
  const Chain width{.scope = Scope::muscle, .field = kWidth, .variable = 4, .slope = 0.5};
  const Chain gain{.scope = Scope::channel, .field = kGain, .variable = 2, .slope = 3.0};
  // With and without what only the general law has: the passive force acts at 1.05 l0 and above.
  for (const double passive : {0.0, 0.4}) {
    s.values[kPassiveForce] = passive;
    const MuscleRows r = s.rows({width}, {gain});
    ASSERT_EQ(r.variables, (std::vector<Eigen::Index>{4, 2}));
    for (Eigen::Index i = 0; i < 3; ++i) {
      const Activation& a = s.activation[static_cast<std::size_t>(i)];
      const Tension t = tension(a.value, s.length_m[i], s.velocity_mps[i], s.values);
      const double about = 1e-12 * t.force_n;
      ASSERT_GT(t.force_n, 1.0);
      EXPECT_NEAR(r.force_n[i], t.force_n, about);
      EXPECT_NEAR(r.by_envelope_n[i], t.by_activation * 1.3 * a.value, about);
      EXPECT_NEAR(r.by_length[i], t.by_length, 1e-9 * t.force_n);
      EXPECT_NEAR(r.by_velocity[i], t.by_velocity, about);
      EXPECT_NEAR(r.by_variable(0, i), 0.5 * t.by_field[kWidth], 1e-9 * t.force_n);
      EXPECT_NEAR(r.by_variable(1, i), 3.0 * t.by_activation * 0.7 * a.value, 1e-11 * t.force_n);
    }
  }
}

TEST(MuscleRows, HoldNoDerivativesOfWhatNoChainTies) {
  const Samples s;
  const MuscleRows r = s.rows({}, {});
  EXPECT_EQ(r.by_variable.rows(), 0);
  EXPECT_EQ(r.force_n.size(), 3);
}

}  // namespace
}  // namespace myoid::fit
