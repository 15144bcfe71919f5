#include "myoid/lab/twin/voluntary_truth.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/muscle/hill_muscle.h"

namespace myoid::lab {
namespace {

double value_of(const std::vector<VoluntaryTruth>& truth, const std::string& owner, const std::string& parameter) {
  for (const VoluntaryTruth& of : truth)
    if (of.owner == owner && of.parameter == parameter) return of.value;
  throw InvalidInput("no truth " + owner + "." + parameter);
}

/// A person at this level with the effort 0.9 in every maximal contraction.
VirtualRecording person(Level level) {
  VirtualRecording recording = make_virtual_person(default_protocol(level), 4);
  recording.truth.effort.fill(0.9);
  return recording;
}

TEST(VoluntaryTruth, OfTheModelsOwnMusclesIsMomentArmTimesForce) {
  const VirtualRecording made = person(Level::noisy);
  const muscle::Range range{30.0 * kDegree, 120.0 * kDegree};
  const std::vector<VoluntaryTruth> truth = voluntary_truth(made, range);
  const VirtualArm arm(made.protocol.subject);
  double flexion_nm = 0.0;
  for (const std::size_t m : {kBiceps, kBrachialis, kBrachioradialis, kTriceps}) {
    double greatest_nm = 0.0, at_rad = 0.0;
    for (double q = range.lower; q <= range.upper; q += 0.1 * kDegree) {
      const body::MuscleTravel path = body::travel(arm.elbow.muscles[m], q);
      const muscle::HillParameters<double>& hill = made.truth.muscles[m];
      const double torque_nm =
          std::abs(path.moment_arm_m) * muscle::hill_force(0.9, path.length_m - hill.tendon_slack_length_m, 0.0, hill);
      if (torque_nm > greatest_nm) at_rad = q;
      greatest_nm = std::max(greatest_nm, torque_nm);
    }
    const std::string name(kArmMuscles[m]);
    EXPECT_NEAR(value_of(truth, name, "voluntary_torque"), greatest_nm, 1e-3 * greatest_nm) << name;
    EXPECT_NEAR(value_of(truth, name, "voluntary_torque_angle"), at_rad, 0.5 * kDegree) << name;
    EXPECT_LT(value_of(truth, name, "voluntary_power_60"), 60.0 * kDegree * greatest_nm) << name;
    if (m != kTriceps) flexion_nm += greatest_nm;
  }
  // The flexors are strongest at different angles.
  EXPECT_LE(value_of(truth, "elbow_flexion", "voluntary_torque_positive"), 1.001 * flexion_nm);
  EXPECT_GT(value_of(truth, "elbow_flexion", "voluntary_torque_positive"), 0.8 * flexion_nm);
  EXPECT_NEAR(value_of(truth, "elbow_flexion", "voluntary_torque_negative"), value_of(truth, "TRI", "voluntary_torque"),
              1e-9);
}

TEST(VoluntaryTruth, OfSevenHeadsGrowsWithTheEffort) {
  VirtualRecording made = person(Level::different);
  const muscle::Range range{30.0 * kDegree, 120.0 * kDegree};
  const double most = value_of(voluntary_truth(made, range), "BIC", "voluntary_torque");
  made.truth.effort.fill(0.5);
  const double half = value_of(voluntary_truth(made, range), "BIC", "voluntary_torque");
  EXPECT_GT(half, 0.4 * most);
  EXPECT_LT(half, 0.7 * most);
}

}  // namespace
}  // namespace myoid::lab
