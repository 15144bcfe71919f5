#include "myoid/arm/arm7.h"

#include <cmath>
#include <vector>

#include "myoid/arm/arm_osim.h"
#include "myoid/muscle/literature.h"

namespace myoid::model {
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
    heads[i].name = kArm7Heads[i];
    heads[i].lump = published.lump;
    heads[i].pennation_at_optimal_rad = published.pennation_rad;
    heads[i].hill =
        muscle::literature_parameters({kArm7Heads[i], published.max_isometric_force_n, published.optimal_fiber_length_m,
                                       published.tendon_slack_length_m, published.pennation_rad});
    heads[i].hill.tendon_slack_length_m = published.tendon_slack_length_m;
    heads[i].path = elbow.muscles[lump];
    heads[i].path.name = kArm7Heads[i];
    const double reach_m = published.optimal_fiber_length_m * std::cos(published.pennation_rad);
    heads[i].path.constant_m +=
        published.tendon_slack_length_m + reach_m - travel(heads[i].path, kArmOptimalAt_rad[lump]).length_m;
  }
  return heads;
}

std::string arm7_osim(const Arm4Options& options) {
  std::vector<MuscleText> muscles;
  for (const ArmHead& head : arm7_heads(options.person))
    muscles.push_back({head.path, head.hill, head.pennation_at_optimal_rad});
  return arm_osim(options, "arm7", muscles);
}

}  // namespace myoid::model
