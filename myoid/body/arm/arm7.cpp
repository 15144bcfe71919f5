#include "myoid/body/arm/arm7.h"

#include <cmath>
#include <vector>

#include "myoid/muscle/literature.h"

namespace myoid::body {
namespace {

struct PublishedHead {
  int lump;
  double max_isometric_force_n;
  double optimal_fiber_length_m;
  double tendon_slack_length_m;
  double pennation_rad;
};

/// In the order of kArm7Heads.
constexpr std::array<PublishedHead, 7> kPublished = {{{0, 624.30, 0.1157, 0.2723, 0.0},
                                                      {0, 435.56, 0.1321, 0.1923, 0.0},
                                                      {1, 987.26, 0.0858, 0.0535, 0.0},
                                                      {2, 261.33, 0.1726, 0.1330, 0.0},
                                                      {3, 798.52, 0.1340, 0.1430, 0.2094},
                                                      {3, 624.30, 0.1138, 0.0980, 0.1571},
                                                      {3, 624.30, 0.1138, 0.0908, 0.1571}}};

}  // namespace

std::array<ArmHead, 7> arm7_heads(const ArmOptions& options) {
  const PlanarElbow elbow = planar_elbow(options);
  std::array<ArmHead, 7> heads;
  for (std::size_t i = 0; i < heads.size(); ++i) {
    const PublishedHead& published = kPublished[i];
    const auto lump = static_cast<std::size_t>(published.lump);
    ArmHead& head = heads[i];
    head.lump = published.lump;
    head.pennation_at_optimal_rad = published.pennation_rad;
    head.hill =
        muscle::literature_parameters({kArm7Heads[i], published.max_isometric_force_n, published.optimal_fiber_length_m,
                                       published.tendon_slack_length_m, published.pennation_rad});
    head.hill.tendon_slack_length_m = published.tendon_slack_length_m;
    head.path = elbow.muscles[lump];
    head.path.name = kArm7Heads[i];
    const double reach_m = published.optimal_fiber_length_m * std::cos(published.pennation_rad);
    head.path.constant_m +=
        published.tendon_slack_length_m + reach_m - travel(head.path, kArmOptimalAt_rad[lump]).length_m;
  }
  return heads;
}

std::string arm7_osim(const Arm4Options& options) {
  const std::array<ArmHead, 7> heads = arm7_heads(options.person);
  return arm_osim(options, "arm7", std::vector<ArmMuscle>(heads.begin(), heads.end()));
}

}  // namespace myoid::body
