#pragma once

namespace myoid::muscle {

/// Tendon force [N]:  F_t = k_t max(0, l_t - l_t0). Slack below l_t0: a tendon does not push.
/// Equation (6) of the source paper prints F_t = k_t l_t, which at k_t = 1e5 N/m would be 20 kN at
/// rest; the slack length was lost.
template <typename T>
[[nodiscard]] T tendon_force(const T& tendon_length_m,
                             const T& tendon_slack_length_m,
                             const T& tendon_stiffness_npm) {
  const T stretch = tendon_length_m - tendon_slack_length_m;
  return stretch > T(0.0) ? tendon_stiffness_npm * stretch : T(0.0);
}

/// Secant stiffness of a tendon that stretches by `strain` of its slack length under F_max: k_t =
/// F_max / (strain l_t0) [N/m].
[[nodiscard]] inline double tendon_stiffness_npm(double max_isometric_force_n,
                                                 double tendon_slack_length_m,
                                                 double strain = 0.033) {
  return max_isometric_force_n / (strain * tendon_slack_length_m);
}

}  // namespace myoid::muscle
