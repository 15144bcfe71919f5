#include "myoid/fit/measurement/muscle_rows.h"

#include <algorithm>

namespace myoid::fit {

void evaluate_muscle(const std::vector<Activation>& activation,
                     const Eigen::Ref<const Eigen::VectorXd>& length_m,
                     const Eigen::Ref<const Eigen::VectorXd>& velocity_mps,
                     const MuscleValues& values,
                     const std::vector<ParameterMap::Chain>& of_muscle,
                     const std::vector<ParameterMap::Chain>& of_channel,
                     MuscleRows& rows) {
  const Eigen::Index n = length_m.size();
  rows.force_n.resize(n);
  rows.by_envelope_n.resize(n);
  rows.by_length.resize(n);
  rows.by_velocity.resize(n);
  rows.variables.clear();
  for (const auto* chains : {&of_muscle, &of_channel})
    for (const ParameterMap::Chain& chain : *chains) rows.variables.push_back(chain.variable);
  const auto count = static_cast<Eigen::Index>(rows.variables.size());
  rows.by_variable.resize(count, n);
  const bool plain =
      is_plain(values) && std::all_of(of_muscle.begin(), of_muscle.end(),
                                      [](const ParameterMap::Chain& chain) { return is_plain_field(chain.field); });
  Tension t;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Activation& a = activation[static_cast<std::size_t>(i)];
    if (plain) {
      plain_tension(a.value, length_m[i], velocity_mps[i], values, t);
    } else {
      t = tension(a.value, length_m[i], velocity_mps[i], values);
    }
    rows.force_n[i] = t.force_n;
    rows.by_envelope_n[i] = t.by_activation * a.by_log_envelope;
    rows.by_length[i] = t.by_length;
    rows.by_velocity[i] = t.by_velocity;
    double* out = rows.by_variable.data() + i * count;
    for (const ParameterMap::Chain& chain : of_muscle)
      *out++ = t.by_field[static_cast<std::size_t>(chain.field)] * chain.slope;
    for (const ParameterMap::Chain& chain : of_channel)
      *out++ = t.by_activation * a.by_field[static_cast<std::size_t>(chain.field)] * chain.slope;
  }
}

}  // namespace myoid::fit
