#include "myoid/intervals/voluntary_curve.h"

namespace myoid::identification {

std::string voluntary_ending(const VoluntaryCurve& curve, bool several_joints) {
  if (curve.of_joint) return curve.direction > 0 ? "_positive" : "_negative";
  return several_joints ? "_at_" + curve.joint : std::string();
}

}  // namespace myoid::identification
