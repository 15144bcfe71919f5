#include "myoid/lab/virtual_person/effective_truth.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/muscle/hill_parameters.h"

namespace myoid::lab {
namespace {

TrueArm spread_arm(double spread, std::uint64_t seed) {
  TruthSpec spec;
  spec.spread = spread;
  math::Random random(seed);
  return draw_true_arm(spec, VirtualSubject{}, random);
}

TEST(EffectiveTruth, TwiceAsStrongIsTwiceTheStrengthAndNothingElse) {
  // All forces of a person scale with F_max (tendon and passive force too), so that the fit of the
  // torques scales exactly; the search ends at relative steps of 1e-8.
  const VirtualArm modelled{VirtualSubject{}};
  TrueArm person = spread_arm(1.0, 7);
  PerMuscle misfit = {};
  const HillSet once = effective_muscles(person, modelled, &misfit);
  for (TrueHead& head : person.heads) head.parameters.hill.max_isometric_force_n *= 2.0;
  PerMuscle misfit_of_twice = {};
  const HillSet twice = effective_muscles(person, modelled, &misfit_of_twice);
  for (std::size_t m = 0; m < once.size(); ++m) {
    EXPECT_NEAR(misfit_of_twice[m], misfit[m], 1e-4);
    for (const muscle::HillField& field : muscle::kHillFields) {
      const bool strength = field.name == "max_isometric_force";
      EXPECT_NEAR(twice[m].*(field.member) / (once[m].*(field.member)), strength ? 2.0 : 1.0, 2e-3)
          << kArmMuscles[m] << " " << field.name;
    }
  }
}

TEST(EffectiveTruth, OfThePublishedArmItIsNearThePublishedMuscles) {
  // What remains is what the levels differ in: curves, elastic tendons, passive force, pennation.
  const VirtualArm modelled{VirtualSubject{}};
  PerMuscle misfit = {};
  const HillSet effective = effective_muscles(spread_arm(0.0, 1), modelled, &misfit);
  for (std::size_t m = 0; m < effective.size(); ++m) {
    const muscle::HillParameters<double>& literature = modelled.literature[m];
    EXPECT_NEAR(effective[m].max_isometric_force_n / literature.max_isometric_force_n, 1.0, 0.25) << kArmMuscles[m];
    EXPECT_NEAR(effective[m].optimal_fiber_length_m / literature.optimal_fiber_length_m, 1.0, 0.25) << kArmMuscles[m];
    EXPECT_LT(misfit[m], 0.15) << kArmMuscles[m];
    EXPECT_GT(misfit[m], 0.001) << "the truth is to be harder than the model";
  }
}

TEST(EffectiveTruth, AnatomicalStrengthAddsTheHeadsAlongTheTendon) {
  const TrueArm person = spread_arm(0.0, 1);
  const PerMuscle strength_n = anatomical_strength_n(person);
  EXPECT_NEAR(strength_n[kBiceps], 624.30 + 435.56, 1e-9);
  EXPECT_NEAR(strength_n[kTriceps], 798.52 * std::cos(0.2094) + 2.0 * 624.30 * std::cos(0.1571), 1e-9);
}

}  // namespace
}  // namespace myoid::lab
