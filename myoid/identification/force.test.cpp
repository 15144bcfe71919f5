#include "myoid/identification/force.h"

#include <gtest/gtest.h>

#include "myoid/identification/torque.h"

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

using test::elbow_study;
using test::ElbowStudy;

TEST(IdentifyForce, GivesBothBranchesBackAtOnce) {
  const ElbowStudy study = elbow_study({.trials = 2});
  ForceOptions options;
  options.detect_exact = true;
  const IdentificationResult r = identify_force(study.data, options);
  EXPECT_TRUE(r.exact);
  int seen = 0;
  for (const ParameterEstimate& e : r.estimates) {
    for (std::size_t k = 0; k < 4; ++k) {
      if (study.data.muscles[k].name != e.muscle || e.parameter == "emg_delay") continue;
      const double truth = study.truth[k].*muscle::hill_field(e.parameter).member;
      EXPECT_NEAR(e.estimate, truth, 1e-6 * truth) << e.muscle << " " << e.parameter;
      ++seen;
    }
  }
  EXPECT_EQ(seen, 24);
}

}  // namespace
}  // namespace myoid::identification
