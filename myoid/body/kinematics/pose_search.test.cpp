#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include <gtest/gtest.h>

#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/body/kinematics/joint_angles.h"
#include "myoid/body/kinematics/pose_fit.h"
#include "myoid/body/model/path_survey.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/recording/trc_reader.h"

#include "tests/support/data_folder.h"
#include "tests/support/marker_pairs.h"

namespace myoid::body {
namespace {

int number_from(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);  // a larger number by hand
  return text != nullptr ? std::max(1, std::atoi(text)) : otherwise;
}

/// Returns J of the best of so many searches from random postures, every other one with the root of q.
double best_of_random(const body::BodyModel& m, PoseFit& fit, const Eigen::VectorXd& q, int starts) {
  double best = 0.5 * fit.place(q);
  for (int k = 0; k < starts; ++k) {
    Eigen::VectorXd start = body::random_posture(m, 11, static_cast<std::uint64_t>(k));
    for (const body::Joint& joint : m.joints)
      if (joint.parent == 0 && k % 2 == 0)
        for (const int c : joint.coordinates) start[c] = q[c];
    const PoseFit::Pose pose = fit.solve(start);
    if (!strays(m, pose.q, q)) best = std::min(best, 0.5 * pose.cost);
  }
  return best;
}

TEST(PoseSequence, IsNeverAboveRandomStartsOnTheSharedMotions) {
  const auto folder = test::data_folder() / "opensim";
  MYOID_REQUIRE_DATA(folder);
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".trc") files.insert(entry.path());
  EXPECT_FALSE(files.empty());
  for (const std::filesystem::path& file : files) {
    const body::BodyModel m = body::read_osim(file.parent_path() / "model.osim");
    const MarkerSeries markers = recording::read_trc(file).markers;
    const IkResult result = inverse_kinematics(m, markers);
    const IkOptions options;
    PoseFit fit(m, options, test::marker_pairs(m, markers));
    const int frames = number_from("MYOID_IK_JUDGE", 2);
    for (int k = 0; k < frames; ++k) {
      const Eigen::Index i = (2 * k + 1) * markers.frame_count() / (2 * frames);
      fit.set_targets(markers, i);
      const Eigen::VectorXd found = result.q.values().row(i).transpose();
      const double best = best_of_random(m, fit, found, number_from("MYOID_IK_STARTS", 20));
      EXPECT_LE(result.objective[static_cast<std::size_t>(i)], best + 1e-6) << file << ", frame " << i;
    }
  }
}

}  // namespace
}  // namespace myoid::body
