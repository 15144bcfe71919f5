#include "myoid/lab/virtual_person/departures.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/ground/core/units.h"
#include "myoid/lab/twin/synthetic_recording.h"
#include "myoid/lab/virtual_person/performance.h"
#include "myoid/lab/virtual_person/true_arm.h"
#include "myoid/muscle/de_groote.h"
#include "myoid/muscle/hill_muscle.h"
#include "myoid/muscle/millard.h"

namespace myoid::lab {
namespace {

const PerMuscle kOnes = {1.0, 1.0, 1.0, 1.0};

TruthSpec wrong_arms() {
  TruthSpec spec = default_protocol(Level::noisy).truth;
  spec.moment_arm_sd = 0.15;
  spec.moment_arm_slope_sd = 0.2;
  return spec;
}

TrialScript loaded_swing() {
  TrialProtocol trial;
  trial.name = "swing";
  trial.held_mass_kg = 1.5;
  trial.cycles.duration_s = 6.0;
  return make_script(trial, {}, 4);
}

TEST(Departures, FullForceAtTheOptimumAndAtRestIsTheGreatest) {
  const VirtualArm arm(VirtualSubject{});
  const DepartedMuscles muscles({}, arm, arm.literature);
  // BIC is optimal at 85 degrees.
  const PerMuscle force_n = muscles.full_force_n(muscles.geometry({85.0 * kDegree, 0.0, 0.0}), kOnes, {});
  EXPECT_NEAR(force_n[kBiceps], arm.literature[kBiceps].max_isometric_force_n, 1e-9);
}

TEST(Departures, AbsentKeysMakeTheModelsBody) {
  const VirtualArm arm(VirtualSubject{});
  const Departures none = draw_departures(default_protocol(Level::noisy).truth, math::Random(3));
  EXPECT_FALSE(none.elastic());
  EXPECT_TRUE(none.paper_curves());
  const Moment q{1.1, 0.7, 0.0};
  const MuscleGeometry same = DepartedMuscles(none, arm, arm.literature).geometry(q);
  EXPECT_EQ(same.length_m, arm.geometry(q).length_m);
  EXPECT_EQ(same.moment_arm_m, arm.geometry(q).moment_arm_m);
}

TEST(Departures, MomentArmsAreScaledAndTaperedAndTheLengthsDerivative) {
  const VirtualArm arm(VirtualSubject{});
  const Departures wrong = draw_departures(wrong_arms(), math::Random(3));
  const DepartedMuscles muscles(wrong, arm, arm.literature);
  const double h = 1e-5;
  for (std::size_t m = 0; m < 4; ++m) {
    const double q0 = body::kArmOptimalAt_rad[m];
    const double at_optimum_m = arm.geometry({q0, 0.0, 0.0}).moment_arm_m[m];
    EXPECT_NEAR(muscles.geometry({q0, 0.0, 0.0}).length_m[m], arm.geometry({q0, 0.0, 0.0}).length_m[m], 1e-15);
    EXPECT_NE(wrong.moment_arm_scale[m], 1.0);
    for (const double q : {0.3, 1.0, 1.7, 2.2}) {
      const double r = muscles.geometry({q, 0.0, 0.0}).moment_arm_m[m];
      const double longer = muscles.geometry({q + h, 0.0, 0.0}).length_m[m];
      const double shorter = muscles.geometry({q - h, 0.0, 0.0}).length_m[m];
      EXPECT_NEAR(r, -(longer - shorter) / (2.0 * h), 1e-9);
      EXPECT_NEAR(r,
                  wrong.moment_arm_scale[m] * (arm.geometry({q, 0.0, 0.0}).moment_arm_m[m] +
                                               wrong.moment_arm_slope_per_rad[m] * at_optimum_m * (q - q0)),
                  1e-14);
    }
  }
}

TEST(Departures, ScalesAndSlopesHaveTheirStandardDeviations) {
  double scale2 = 0.0, slope2 = 0.0;
  constexpr int kPersons = 1000;
  for (std::uint64_t seed = 0; seed < kPersons; ++seed) {
    const Departures drawn = draw_departures(wrong_arms(), math::Random(seed));
    for (std::size_t m = 0; m < 4; ++m) {
      scale2 += std::pow(drawn.moment_arm_scale[m] - 1.0, 2) / (4.0 * kPersons);
      slope2 += std::pow(drawn.moment_arm_slope_per_rad[m], 2) / (4.0 * kPersons);
    }
  }
  // The normal law without what lies beyond 2.5 sd has 0.955 of the standard deviation; of 4000
  // draws it is known to 1 %.
  EXPECT_NEAR(std::sqrt(scale2), 0.955 * 0.15, 0.006);
  EXPECT_NEAR(std::sqrt(slope2), 0.955 * 0.2, 0.008);
}

TEST(Departures, AnElasticTendonPullsAsItsFiberDoes) {
  const VirtualArm arm(VirtualSubject{});
  Departures wrong;
  wrong.tendon_strain = {0.08, 0.08, 0.06, 0.05};
  Tiredness<4> tireless;
  const ExactPerformance performance(arm, arm.literature, loaded_swing(), 0.05, tireless, {}, wrong);
  double most_strain = 0.0;
  for (const double t : {0.5, 1.7, 2.4, 3.1}) {
    const Instant now = performance.at(t);
    const MuscleGeometry geometry = arm.geometry(now.q);
    double torque_nm = 0.0;
    for (std::size_t m = 0; m < 4; ++m) {
      const muscle::HillParameters<double>& hill = arm.literature[m];
      const double strain = (geometry.length_m[m] - now.fiber_length_m[m]) / hill.tendon_slack_length_m - 1.0;
      most_strain = std::max(most_strain, strain);
      const double fiber_n =
          muscle::hill_force(now.activation[m], now.fiber_length_m[m], geometry.velocity_mps[m], hill);
      const double tendon_n =
          hill.max_isometric_force_n * muscle::de_groote_tendon(strain, wrong.tendon_strain[m]).value;
      EXPECT_NEAR(now.force_n[m], fiber_n, 1e-6);
      EXPECT_NEAR(now.force_n[m], tendon_n, 1e-6);
      torque_nm += geometry.moment_arm_m[m] * now.force_n[m];
    }
    EXPECT_NEAR(torque_nm, required_torque_nm(arm.elbow, now.q.value, now.q.second, Plane::vertical, 1.5), 1e-6);
  }
  EXPECT_GT(most_strain, 0.005);
}

TEST(Departures, MillardsCurvesTakeThePlaceOfThePapers) {
  const VirtualArm arm(VirtualSubject{});
  Departures wrong;
  wrong.laws = muscle::millard_laws();
  Tiredness<4> tireless;
  const ExactPerformance performance(arm, arm.literature, loaded_swing(), 0.05, tireless, {}, wrong);
  const muscle::MillardCurves curves;
  for (const double t : {0.5, 1.7, 3.1}) {
    const Instant now = performance.at(t);
    const MuscleGeometry geometry = arm.geometry(now.q);
    for (std::size_t m = 0; m < 4; ++m) {
      const muscle::HillParameters<double>& hill = arm.literature[m];
      const double l = now.fiber_length_m[m] / hill.optimal_fiber_length_m;
      const double v = geometry.velocity_mps[m] / hill.max_shortening_speed_mps;
      EXPECT_NEAR(now.force_n[m],
                  now.activation[m] * hill.max_isometric_force_n * curves.force_length(l).value *
                      curves.force_velocity(v).value,
                  1e-9);
    }
  }
  for (const muscle::HillField& field : muscle::kHillFields)
    EXPECT_EQ(wrong.has(field), field.name == "max_isometric_force" || field.name == "optimal_fiber_length" ||
                                    field.name == "max_shortening_speed" || field.name == "tendon_slack_length");
}

TEST(Departures, APersonOfL2HasTaperedMomentArmsWithTheSameNumbersBeside) {
  TruthSpec spec;
  math::Random random(5), again(5);
  const TrueArm plain = draw_true_arm(spec, VirtualSubject{}, random);
  spec.moment_arm_slope_sd = 0.2;
  const TrueArm tapered = draw_true_arm(spec, VirtualSubject{}, again);
  EXPECT_EQ(plain.held_at_m, tapered.held_at_m);
  for (std::size_t i = 0; i < kHeadCount; ++i) {
    const body::PlanarMuscle& path = tapered.heads[i].path;
    const double q0 = body::kArmOptimalAt_rad[tapered.heads[i].muscle];
    EXPECT_EQ(body::travel(path, q0).length_m, body::travel(plain.heads[i].path, q0).length_m);
    EXPECT_NE(body::travel(path, 2.0).moment_arm_m, body::travel(plain.heads[i].path, 2.0).moment_arm_m);
    const double h = 1e-5;
    EXPECT_NEAR(body::travel(path, 2.0).moment_arm_slope_mprad,
                (body::travel(path, 2.0 + h).moment_arm_m - body::travel(path, 2.0 - h).moment_arm_m) / (2.0 * h),
                1e-9);
  }
}

TEST(Departures, TheMuscleParametersOfAPersonAreTheSameInEveryWorld) {
  Protocol protocol = parse_protocol("[[trial]]\nname = \"a\"\nkind = \"isometric_ramp\"\n", "p.toml", Level::noisy);
  const VirtualRecording plain = make_virtual_person(protocol, 9);
  set_truth(protocol, {"tendon_strain=[0.08, 0.08]", "moment_arm_sd=0.15", "crosstalk=0.1"});
  const VirtualRecording wrong = make_virtual_person(protocol, 9);
  for (std::size_t m = 0; m < 4; ++m) {
    EXPECT_EQ(plain.truth.muscles[m].max_isometric_force_n, wrong.truth.muscles[m].max_isometric_force_n);
    EXPECT_EQ(wrong.truth.departures.tendon_strain[m], 0.08);
  }
  EXPECT_EQ(plain.model_osim, wrong.model_osim);
}

}  // namespace
}  // namespace myoid::lab
