#include "myoid/body/forces/muscle_sweep.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

/// The built-in arm from 10 to 120 degrees.
std::vector<SweptMuscle> swept_elbow(const body::BodyModel& arm) {
  return sweep_muscles(arm, {0, 1, 2, 3}, arm.coordinate_index("elbow_flexion"), {10.0 * kDegree, 120.0 * kDegree}, 50);
}

TEST(MuscleSweep, ForcesLieBetweenNothingAndWhatAMuscleCanBear) {
  const body::BodyModel arm = body::parse_osim(body::arm4_osim(), "arm4.osim");
  for (const SweptMuscle& muscle : swept_elbow(arm)) {
    const auto found = std::ranges::find(arm.muscles, muscle.name, &body::Muscle::name);
    ASSERT_NE(found, arm.muscles.end());
    const double most_n = found->properties.max_isometric_force_n;
    EXPECT_GT(muscle.full_force_n.minCoeff(), 0.0);
    EXPECT_TRUE((muscle.full_force_n.array() >= muscle.passive_force_n.array()).all());
    EXPECT_LE((muscle.full_force_n - muscle.passive_force_n).maxCoeff(), 1.05 * most_n) << muscle.name;
    EXPECT_GT(muscle.full_force_n.maxCoeff(), 0.5 * most_n) << muscle.name;  // near its optimal length somewhere
  }
}

TEST(MuscleSweep, AtRestTheWorkOfATendonForceIsThatOfItsTorque) {
  // Virtual work: over the sweep the integral of force times change of length is minus that of force times moment arm.
  const body::BodyModel arm = body::parse_osim(body::arm4_osim(), "arm4.osim");
  for (const SweptMuscle& muscle : swept_elbow(arm)) {
    double along_path = 0.0, at_joint = 0.0;
    for (Eigen::Index i = 0; i + 1 < muscle.path.values.size(); ++i) {
      const double force = 0.5 * (muscle.full_force_n[i] + muscle.full_force_n[i + 1]);
      along_path += force * (muscle.path.lengths_m[i + 1] - muscle.path.lengths_m[i]);
      at_joint += force * 0.5 * (muscle.path.arms_m[i] + muscle.path.arms_m[i + 1]) *
                  (muscle.path.values[i + 1] - muscle.path.values[i]);
    }
    EXPECT_NEAR(along_path, -at_joint, 1e-3 * std::abs(at_joint)) << muscle.name;  // the trapezoid's error
    EXPECT_TRUE(muscle.has_moment_arm());
    EXPECT_TRUE(muscle.has_own_curves);
  }
}

}  // namespace
}  // namespace myoid::body
