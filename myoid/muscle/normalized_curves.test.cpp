#include "myoid/muscle/normalized_curves.h"

#include <cmath>

#include <ceres/jet.h>
#include <gtest/gtest.h>

namespace myoid::muscle {
namespace {

template <typename T>
NormalizedCurves<T> curves_of(const MusculotendonLaws& laws) {
  CurveShape<T> shape{.relative_width = T(0.6),
                      .hyperbola = {T(0.3), T(0.12), T(1.4)},
                      .passive_strain = T(0.6),
                      .passive_shape = T(4.0),
                      .tendon_strain = T(0.04),
                      .millard = {}};
  if (laws.velocity == VelocityLaw::thelen) shape.hyperbola = thelen_hyperbola(T(0.3), T(1.8));
  shape.hyperbola.tangent_below = true;
  return {laws, shape};
}

const MusculotendonLaws kSets[] = {paper_laws(), thelen_laws(), de_groote_laws(), millard_laws(), soest_laws()};

TEST(NormalizedCurves, TheVelocityThatIsSolvedForMakesTheForce) {
  for (const MusculotendonLaws& laws : kSets) {
    const NormalizedCurves<double> curves = curves_of<double>(laws);
    for (const double a : {0.05, 0.5, 1.0}) {
      for (const double v : {-1.3, -0.9, -0.2, 0.0, 0.1, 0.6, 1.4}) {
        const double force = 0.7 * curves.velocity({a}, v).value + 0.1 * v;
        EXPECT_NEAR(curves.solve_velocity({a}, 0.7, 0.1, force), v, 1e-11);
      }
    }
  }
}

TEST(NormalizedCurves, ThelensLawIsUndoneWithoutDamping) {
  const NormalizedCurves<double> curves = curves_of<double>(thelen_laws());
  for (const double a : {0.05, 0.5, 1.0}) {
    // Published: v = (1/4 + 3/4 a) (f - 1) / b,  b = 1 + f / A_f below 1.
    EXPECT_NEAR(curves.solve_velocity({a}, 1.0, 0.0, 0.4), (0.25 + 0.75 * a) * (0.4 - 1.0) / (1.0 + 0.4 / 0.3), 1e-14);
    // Below zero force the velocity goes on as the line that touches the curve there.
    EXPECT_NEAR(curves.solve_velocity({a}, 1.0, 0.0, -0.1) - curves.solve_velocity({a}, 1.0, 0.0, 0.0),
                -0.1 * (0.25 + 0.75 * a) * (1.0 + 1.0 / 0.3), 1e-14);
  }
}

TEST(NormalizedCurves, SlopesAndEnergiesBelongToTheValues) {
  using Jet = ceres::Jet<double, 1>;
  for (const MusculotendonLaws& laws : kSets) {
    const NormalizedCurves<Jet> curves = curves_of<Jet>(laws);
    for (const double x : {0.6, 0.95, 1.2, 1.5}) {
      const Jet l(x, 0);
      EXPECT_NEAR(curves.length(l).value.v[0], curves.length(l).slope, 1e-12);
      EXPECT_NEAR(curves.passive(l).value.v[0], curves.passive(l).slope, 1e-11);
      EXPECT_NEAR(curves.passive_energy(l).v[0], curves.passive(l).value.a, 1e-13);
      const Jet v(x - 1.0, 0);
      EXPECT_NEAR(curves.velocity({Jet(0.5)}, v).value.v[0], curves.velocity({Jet(0.5)}, v).slope, 1e-11);
      const Jet strain(0.04 * x, 0);
      EXPECT_NEAR(curves.tendon(strain).value.v[0], curves.tendon(strain).slope, 1e-10);
      EXPECT_NEAR(curves.tendon_energy(strain).v[0], curves.tendon(strain).value.a, 1e-13);
    }
    EXPECT_EQ(curves.tendon(Jet(-0.01, 0)).value.a, 0.0);
  }
}

}  // namespace
}  // namespace myoid::muscle
