#include "myoid/run/design/human_range.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/body/kinematics/people_range.h"
#include "myoid/ground/core/units.h"

namespace myoid::run {

ProposedRange human_range(const std::string& coordinate, double lower_rad, double upper_rad) {
  const ProposedRange whole{lower_rad, upper_rad, ""};
  const auto people = body::people_range(coordinate, lower_rad, upper_rad);
  if (!people || (people->low_rad <= lower_rad && upper_rad <= people->high_rad)) return whole;
  const double low = std::max(people->low_rad, lower_rad), high = std::min(people->high_rad, upper_rad);
  if (!(low < high)) return whole;
  return {low, high,
          fmt::format("{} from {:.0f} to {:.0f} deg: the model's range, {:.0f} to {:.0f} deg, goes beyond people's",
                      coordinate, low / kDegree, high / kDegree, lower_rad / kDegree, upper_rad / kDegree)};
}

}  // namespace myoid::run
