#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "myoid/body/model/path_stations.h"
#include "myoid/body/model/path_survey.h"
#include "myoid/body/osim/osim_reader.h"

#include "tests/support/data_folder.h"

namespace myoid::body {
namespace {

struct Found {
  int checked = 0;
  int at_a_kink = 0;     ///< One of the two one-sided derivatives is met, the other not.
  int unsettled = 0;     ///< The path itself says that its tangent points do not rest.
  double worst_m = 0.0;  ///< Elsewhere.
  std::string where;
};

/// Moment arms by every coordinate against differences of the length, at random postures.
Found against_differences(const BodyModel& m, int postures) {
  Found found;
  BodyState state = make_state(m);
  PathWorkspace workspace;
  PathResult here, ahead, behind;
  const double h = 1e-6;
  for (int k = 0; k < postures; ++k) {
    const Eigen::VectorXd q = random_posture(m, 11, static_cast<std::uint64_t>(k));
    for (Eigen::Index c = 0; c < q.size(); ++c) {
      for (const Muscle& muscle : m.muscles) {
        const auto path_at = [&](double step, PathResult& result) {
          compute_poses(m, q + step * Eigen::VectorXd::Unit(q.size(), c), state);
          compute_exact_path({m, muscle.path, state}, workspace, result);
        };
        here.moment_arm_m = ahead.moment_arm_m = behind.moment_arm_m = Eigen::VectorXd::Zero(q.size());
        path_at(2.0 * h, ahead);
        path_at(-2.0 * h, behind);
        const double wide = (ahead.length_m - behind.length_m) / (4.0 * h);
        path_at(0.0, here);
        path_at(h, ahead);
        path_at(-h, behind);
        ++found.checked;
        if (!here.settled || !ahead.settled || !behind.settled) {
          ++found.unsettled;
          continue;
        }
        const double r = here.moment_arm_m[c];
        // Two widths take the error of the third derivative away: it is large near grazing.
        const double narrow = (ahead.length_m - behind.length_m) / (2.0 * h);
        const double difference = -(4.0 * narrow - wide) / 3.0;
        const double error = std::abs(r - difference);
        if (!(error < 1e-6)) {
          // Where contact begins within the step, the derivative of one side holds.
          const double forward = -(ahead.length_m - here.length_m) / h;
          const double backward = -(here.length_m - behind.length_m) / h;
          if (std::min(std::abs(r - forward), std::abs(r - backward)) < 1e-5) {
            ++found.at_a_kink;
            continue;
          }
        }
        if (!(error <= found.worst_m)) {
          found.worst_m = error;
          found.where = muscle.name + " by " + m.coordinates[static_cast<std::size_t>(c)].name + " in posture " +
                        std::to_string(k);
        }
      }
    }
  }
  return found;
}

TEST(ExactPath, TheMomentArmIsMinusTheDerivativeOfTheLengthInEveryPublicModel) {
  const auto folder = test::data_folder() / "opensim";
  MYOID_REQUIRE_DATA(folder);
  for (const char* name : {"arm26", "gait2354", "pathzoo", "rajagopal2016", "wrapzoo"}) {
    const BodyModel m = read_osim(folder / name / "model.osim");
    const Found found = against_differences(m, std::string(name) == "arm26" ? 60 : 3);
    EXPECT_LT(found.worst_m, 1e-6) << name << ": " << found.where;
    // Only the invented wraps of the last one push paths off each other.
    EXPECT_LE(found.unsettled, std::string(name) == "wrapzoo" ? found.checked / 100 : 0) << name;
    EXPECT_LT(found.at_a_kink, 1 + found.checked / 1000) << name;
  }
}

}  // namespace
}  // namespace myoid::body
