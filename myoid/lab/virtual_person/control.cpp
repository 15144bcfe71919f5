#include "myoid/lab/virtual_person/control.h"

#include <algorithm>
#include <cmath>

namespace myoid::lab {

PerMuscle weights(const Coordination& coordination) {
  return {1.0, std::exp(coordination.brachialis), std::exp(coordination.brachioradialis), 1.0};
}

PerMuscle activations_for(double torque_nm, const PerMuscle& capacity_nm, const Coordination& coordination) {
  constexpr double kSoftness_nm = 1.0;
  const double extension_nm = 0.5 * (std::hypot(torque_nm, kSoftness_nm) - torque_nm);
  double stiffened_nm = -coordination.co_contraction * capacity_nm[kTriceps];  // capacity < 0
  if (coordination.eased) {
    constexpr double kLoad_nm = 3.0;
    const double both_nm = std::min(-capacity_nm[kTriceps],
                                    capacity_nm[kBiceps] + capacity_nm[kBrachialis] + capacity_nm[kBrachioradialis]);
    const double load2 = torque_nm * torque_nm;
    stiffened_nm = coordination.co_contraction * both_nm * (0.3 + 0.7 * load2 / (load2 + kLoad_nm * kLoad_nm));
  }
  const double triceps_nm = extension_nm + stiffened_nm;

  const PerMuscle weight = weights(coordination);
  double flexors_nm = 0.0;
  for (const std::size_t i : {kBiceps, kBrachialis, kBrachioradialis}) {
    flexors_nm += weight[i] * capacity_nm[i];
  }
  const double effort = (torque_nm + triceps_nm) / flexors_nm;
  return {effort * weight[kBiceps], effort * weight[kBrachialis], effort * weight[kBrachioradialis],
          -triceps_nm / capacity_nm[kTriceps]};
}

}  // namespace myoid::lab
