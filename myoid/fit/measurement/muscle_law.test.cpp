#include "myoid/fit/measurement/muscle_law.h"

#include <cmath>

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/muscle/hill_muscle.h"
#include "myoid/muscle/musculotendon.h"

namespace myoid::fit {
namespace {

MuscleValues everything_on() {
  return muscle_values(body::arm4_muscles()[3], {.pennation_angle_rad = 0.2,
                                                 .passive_force = 0.8,
                                                 .passive_strain = 0.5,
                                                 .passive_shape = 3.5,
                                                 .length_activation = 0.12,
                                                 .tendon_strain = 0.04,
                                                 .activation_share = 0.9});
}

TEST(Tension, IsThePapersLawWhenNothingElseIsOn) {
  const auto hill = body::arm4_muscles()[0];
  const MuscleValues values = muscle_values(hill);
  for (const double v : {-2.0, -0.4, -0.01, 0.0, 0.02, 0.5}) {
    for (const double l : {0.30, 0.36, 0.42}) {
      const double expected = muscle::hill_force(0.35, l - hill.tendon_slack_length_m, v, hill);
      EXPECT_NEAR(tension(0.35, l, v, values).force_n, expected, 1e-12 * (1.0 + expected));
    }
  }
}

TEST(PlainTension, IsTheGeneralOneWhereNothingElseIsOn) {
  for (const auto& [length_activation, tendon_strain] :
       {std::pair(0.0, 0.0), std::pair(0.15, 0.0), std::pair(0.0, 0.05), std::pair(0.15, 0.08)}) {
    MuscleValues p = muscle_values(
        body::arm4_muscles()[2],
        {.length_activation = length_activation, .tendon_strain = tendon_strain, .activation_share = 0.8});
    ASSERT_TRUE(is_plain(p));
    for (const double v : {-3.0, -0.4, 0.0, 0.3}) {
      const double l_mt = p[kSlack] + 0.9 * p[kFiberLength];
      const Tension general = tension(0.5, l_mt, v, p);
      // Wherever the search for the strain begins, also at the strain of a sample without a number.
      Tension plain;
      for (const double start : {std::nan(""), 0.2, 0.0}) {
        plain.strain = start;
        plain_tension(0.5, l_mt, v, p, plain);
        EXPECT_NEAR(plain.force_n, general.force_n, 1e-12 * general.force_n) << start;
        EXPECT_NEAR(plain.strain, general.strain, 1e-14);
      }
      const auto same = [](double x, double y) { EXPECT_NEAR(x, y, 1e-12 * (1.0 + std::abs(y))); };
      same(plain.force_n, general.force_n);
      same(tension_n(0.5, l_mt, v, p), general.force_n);
      same(plain.by_activation, general.by_activation);
      same(plain.by_length, general.by_length);
      same(plain.by_velocity, general.by_velocity);
      for (int f = 0; f < kMuscleFieldCount; ++f) {
        if (is_plain_field(f))
          same(plain.by_field[static_cast<std::size_t>(f)], general.by_field[static_cast<std::size_t>(f)]);
      }
    }
    p[kPassiveForce] = 0.1;
    EXPECT_FALSE(is_plain(p));
    EXPECT_EQ(tension_n(0.5, p[kSlack] + p[kFiberLength], 0.1, p),
              tension(0.5, p[kSlack] + p[kFiberLength], 0.1, p).force_n);
  }
}

/// Stretch of the fibers over the optimal length by which the passive force grows, written once more.
double passive_stretch(double stretch) {
  constexpr double kOnset = 0.05;
  if (std::abs(stretch) >= kOnset) return std::max(stretch, 0.0);
  return std::pow(stretch + kOnset, 2) / (4.0 * kOnset);
}

TEST(Tension, PassiveForceBeginsWithoutACorner) {
  MuscleValues p = everything_on();
  p[kPennation] = p[kTendonStrain] = 0.0;
  const double l0 = p[kFiberLength], step = 1e-6 * l0;
  // At rest only the passive force acts. A corner would change its slope by a tenth of F_max / l0 within any step.
  const auto force_n = [&](double stretch) { return tension_n(0.0, p[kSlack] + l0 * (1.0 + stretch), 0.0, p); };
  const auto slope = [&](double stretch) { return (force_n(stretch + 1e-6) - force_n(stretch - 1e-6)) / (2.0 * step); };
  const double bend =
      0.8 * 3.5 / 0.5 / std::expm1(3.5) / 0.1 * p[kMaxForce] / l0;  // greatest change of slope per stretch
  for (double stretch = -0.08; stretch < 0.08; stretch += 1e-4)
    EXPECT_LE(std::abs(slope(stretch + 1e-4) - slope(stretch)), 3.0 * bend * 1e-4) << stretch;
  EXPECT_EQ(force_n(-0.051), 0.0);
  const double of_thelen = 0.8 * std::expm1(3.5 * 0.06 / 0.5) / std::expm1(3.5);
  EXPECT_NEAR(force_n(0.06) / p[kMaxForce], of_thelen, 1e-12);
  EXPECT_LT(force_n(0.0), 0.003 * p[kMaxForce]);
}

TEST(Tension, OfAnElasticTendonIsThatOfTheMuscleBehindIt) {
  const MuscleValues p = everything_on();
  const double l_mt = p[kSlack] * 1.02 + p[kFiberLength] * 1.1;
  const double force = tension(0.5, l_mt, 0.0, p).force_n;
  ASSERT_GT(force, 10.0);
  // Strain from the tendon's own law, then the fiber from geometry: an independent way round.
  const double strain = p[kTendonStrain] * std::log1p(force / p[kMaxForce] / 0.2) / std::log(6.0);
  const double along = l_mt - p[kSlack] * (1.0 + strain);
  const double h = p[kFiberLength] * std::sin(p[kPennation]);
  const double l = std::sqrt(along * along + h * h);
  const double a = 0.9 * 0.5;
  const double l0 = p[kFiberLength] * (1.0 + p[kLengthActivation] * (1.0 - a));
  const double active = a * std::exp(-std::pow((l - l0) / p[kWidth], 2));
  const double stretch = l / p[kFiberLength] - 1.0;
  const double passive = 0.8 * std::expm1(3.5 * passive_stretch(stretch) / 0.5) / std::expm1(3.5);
  EXPECT_NEAR(force, p[kMaxForce] * (active + passive) * along / l, 1e-9 * force);
}

/// Pull of the muscle over F_max at a strain of its tendon, written once more.
double pull(double a, double strain, double l_mt, double v_mt, const MuscleValues& p) {
  const double along = l_mt - p[kSlack] * (1.0 + strain);
  const double h = p[kFiberLength] * std::sin(p[kPennation]);
  const double l = h > 0.0 ? std::sqrt(along * along + h * h) : along;
  const double cosine = h > 0.0 ? along / l : 1.0;
  if (h > 0.0 && along <= 0.0) return 0.0;
  const double v = v_mt * cosine;
  const double vm = p[kSpeed];
  const double f_v = v <= -vm   ? 0.0
                     : v <= 0.0 ? p[kCurvature] * (vm + v) / (p[kCurvature] * vm - v)
                                : (p[kProduct] * vm + p[kPlateau] * v) / (p[kProduct] * vm + v);
  const double l0 = p[kFiberLength] * (1.0 + p[kLengthActivation] * (1.0 - a));
  const double stretch = l / p[kFiberLength] - 1.0;
  const double passive = p[kPassiveForce] *
                         std::expm1(p[kPassiveShape] * passive_stretch(stretch) / p[kPassiveStrain]) /
                         std::expm1(p[kPassiveShape]);
  return (a * std::exp(-std::pow((l - l0) / p[kWidth], 2)) * f_v + passive) * cosine;
}

TEST(Tension, OfAnElasticTendonIsWhereBisectionEnds) {
  // From slack to far beyond the optimal length, at rest and at full effort, fast and slow, soft
  // tendons and hard ones. Bisection of pull - tendon halves to the last digit.
  for (const bool everything : {false, true}) {
    MuscleValues p = everything_on();
    if (!everything) p[kPennation] = p[kPassiveForce] = p[kLengthActivation] = 0.0;
    for (const double e0 : {0.01, 0.033, 0.1}) {
      p[kTendonStrain] = e0;
      for (const double reach : {-0.2, 0.2, 0.5, 0.8, 1.0, 1.3, 1.7}) {
        for (const double activation : {0.0, 1e-9, 0.02, 0.3, 1.0}) {
          for (const double v : {-3.0, -0.5, 0.0, 0.4, 2.0}) {
            const double l_mt = p[kSlack] + reach * p[kFiberLength];
            const double a = p[kShare] * activation;
            const auto tendon = [&](double s) { return 0.2 * std::expm1(std::log(6.0) * s / e0); };
            double low = 0.0, high = 5.0 * e0;
            for (int i = 0; i < 200; ++i) {
              const double middle = 0.5 * (low + high);
              (pull(a, middle, l_mt, v, p) > tendon(middle) ? low : high) = middle;
            }
            // The tendon's stiffness makes 1e-16 of strain some 1e-14 of F_max.
            EXPECT_NEAR(tension(activation, l_mt, v, p).force_n / p[kMaxForce], tendon(low), 1e-12)
                << everything << " " << e0 << " " << reach << " " << activation << " " << v;
          }
        }
      }
    }
  }
}

TEST(Tension, OfAnActivationBelowNothingIsNoPush) {
  MuscleValues p = everything_on();
  p[kPassiveForce] = 0.0;
  const double l_mt = p[kSlack] + p[kFiberLength];
  EXPECT_EQ(tension(-0.01, l_mt, 0.0, p).force_n, 0.0);
}

TEST(Tension, OfAVeryStiffTendonIsThatOfARigidOne) {
  MuscleValues rigid = everything_on();
  rigid[kTendonStrain] = 0.0;
  MuscleValues stiff = rigid;
  stiff[kTendonStrain] = 1e-9;
  const double l_mt = rigid[kSlack] + 0.95 * rigid[kFiberLength];
  EXPECT_NEAR(tension(0.4, l_mt, -0.2, stiff).force_n, tension(0.4, l_mt, -0.2, rigid).force_n,
              1e-5 * tension(0.4, l_mt, -0.2, rigid).force_n);
}

using Jet = ceres::Jet<double, kMuscleFieldCount + 3>;  // the fields, then a, l and v

/// The tension by the templates of muscle/: a unit under the paper's laws, with Thelen's passive
/// force where the amount is 1. An elastic tendon is De Groote's, and the unit steady.
Jet template_tension(double activation, double length_m, double velocity_mps, const MuscleValues& p) {
  std::array<Jet, kMuscleFieldCount> x;
  for (int f = 0; f < kMuscleFieldCount; ++f) {
    const auto i = static_cast<std::size_t>(f);
    x[i] = Jet(p[i], f);
  }
  const Jet a = x[kShare] * Jet(activation, kMuscleFieldCount);
  muscle::MusculotendonParameters<Jet> unit;
  unit.hill = {x[kMaxForce], x[kFiberLength], x[kWidth], x[kCurvature], x[kProduct], x[kPlateau], x[kSpeed], x[kSlack]};
  // The unit's width grows with its optimal length; that of the fit does not.
  unit.hill.force_length_width_m /= Jet(1.0) + x[kLengthActivation] * (Jet(1.0) - a);
  unit.optimal_length_shift = x[kLengthActivation];
  unit.pennation_at_optimal_rad = x[kPennation];
  unit.passive_strain = x[kPassiveStrain];
  unit.passive_shape = x[kPassiveShape];
  unit.damping = Jet(0.0);
  const bool elastic = p[kTendonStrain] > 0.0;
  if (elastic) unit.tendon_strain = x[kTendonStrain];
  muscle::MusculotendonLaws laws = muscle::paper_laws(elastic ? muscle::TendonMode::mass : muscle::TendonMode::rigid);
  if (p[kPassiveForce] == 1.0) laws.passive = muscle::PassiveLaw::thelen;
  if (elastic) laws.tendon = muscle::TendonLaw::de_groote;
  const muscle::Musculotendon<Jet> muscle(unit, laws);
  const muscle::MusculotendonInput<Jet> input{a, Jet(length_m, kMuscleFieldCount + 1),
                                              Jet(velocity_mps, kMuscleFieldCount + 2)};
  return musculotendon_rate(muscle, input, equilibrium_state(muscle, input)).tendon_force_n;
}

TEST(Tension, IsTheTemplateOfMuscleWithAllItsDerivatives) {
  for (const bool pennate : {false, true}) {
    for (const bool passive : {false, true}) {
      for (const bool elastic : {false, true}) {
        MuscleValues p = everything_on();
        p[kPassiveForce] = passive ? 1.0 : 0.0;
        if (!pennate) p[kPennation] = 0.0;
        if (!elastic) p[kTendonStrain] = 0.0;
        for (const double reach : {0.8, 1.0, 1.2}) {
          for (const double v : {-2.0 * p[kSpeed], -0.5, 0.0, 0.4}) {
            SCOPED_TRACE(testing::Message() << pennate << passive << elastic << ' ' << reach << ' ' << v);
            if (passive && reach == 1.0) continue;  // Thelen's corner
            const double l_mt = p[kSlack] * (elastic ? 1.02 : 1.0) + reach * p[kFiberLength];
            const Tension t = tension(0.4, l_mt, v, p);
            const Jet expected = template_tension(0.4, l_mt, v, p);
            // Round-off of a sum of exponentials; with a tendon, the slope in the template's
            // equilibrium is a central difference, good to some 1e-8.
            const double tolerance = elastic ? 1e-7 : 1e-12;
            const auto near = [&](double derivative, double exact, double scale) {
              EXPECT_NEAR(derivative, exact, tolerance * (std::abs(exact) + scale));
            };
            const double f_max = p[kMaxForce];
            near(t.force_n, expected.a, 1e-3 * f_max);
            for (int f = 0; f < kMuscleFieldCount; ++f) {
              const auto i = static_cast<std::size_t>(f);
              if (f == kPassiveForce || (f == kTendonStrain && !elastic)) continue;
              if (f == kPennation && !pennate) continue;  // a double zero
              if ((f == kPassiveStrain || f == kPassiveShape) && !passive) continue;
              SCOPED_TRACE(f);
              near(t.by_field[i], expected.v[f], f_max / std::abs(p[i]));
            }
            near(t.by_activation, expected.v[kMuscleFieldCount], f_max);
            near(t.by_length, expected.v[kMuscleFieldCount + 1], f_max / p[kFiberLength]);
            near(t.by_velocity, expected.v[kMuscleFieldCount + 2], f_max / p[kSpeed]);
          }
        }
      }
    }
  }
}

TEST(Tension, DerivativesAreThoseOfDifferences) {
  for (const bool elastic : {false, true}) {
    MuscleValues p = everything_on();
    if (!elastic) p[kTendonStrain] = 0.0;
    for (const double v : {-0.3, 0.25}) {
      const double l_mt = p[kSlack] * 1.02 + p[kFiberLength] * 1.15;
      const Tension t = tension(0.4, l_mt, v, p);
      // Central differences: truncation h^2 and round-off 1e-13 / h, both about 1e-8 relative.
      const auto near = [&](double derivative, double plus, double minus, double h) {
        EXPECT_NEAR(derivative, (plus - minus) / (2.0 * h), 1e-5 * (std::abs(derivative) + 1e-2 * t.force_n));
      };
      for (int f = 0; f < kMuscleFieldCount; ++f) {
        if (!elastic && f == kTendonStrain) continue;
        SCOPED_TRACE(f);
        const auto i = static_cast<std::size_t>(f);
        const double h = 1e-5 * p[i];
        MuscleValues up = p, down = p;
        up[i] += h;
        down[i] -= h;
        near(t.by_field[i], tension(0.4, l_mt, v, up).force_n, tension(0.4, l_mt, v, down).force_n, h);
      }
      near(t.by_activation, tension(0.40001, l_mt, v, p).force_n, tension(0.39999, l_mt, v, p).force_n, 1e-5);
      near(t.by_length, tension(0.4, l_mt + 1e-6, v, p).force_n, tension(0.4, l_mt - 1e-6, v, p).force_n, 1e-6);
      near(t.by_velocity, tension(0.4, l_mt, v + 1e-5, p).force_n, tension(0.4, l_mt, v - 1e-5, p).force_n, 1e-5);
    }
  }
}

}  // namespace
}  // namespace myoid::fit
