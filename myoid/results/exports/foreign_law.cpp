#include "myoid/results/exports/foreign_law.h"

#include <cmath>

#include "myoid/muscle/de_groote.h"

namespace myoid::results {

Eigen::VectorXd nmsm_neural_activation(const Eigen::VectorXd& excitation, double interval_s, double time_constant_s) {
  Eigen::VectorXd u = excitation;
  for (Eigen::Index k = 2; k < u.size(); ++k) {
    const double rate = 2.0 * interval_s * (0.75 * excitation[k] + 0.25) / time_constant_s;
    u[k] = (rate * excitation[k] + 4.0 * u[k - 1] - u[k - 2]) / (rate + 3.0);
  }
  return u.cwiseMax(0.0);
}

double nmsm_activation(double neural, double nonlinearity) {
  const double curve =
      -7.623282868703527 /
          (29.280183270562596 * std::pow(neural + 0.884220539986325, 17.227022969058535) + 4.107869238218326) +
      1.000004740962477;
  return (1.0 - nonlinearity) * neural + nonlinearity * curve;
}

double nmsm_force(double activation, double length_m, double velocity_mps, const NmsmMuscle& muscle) {
  constexpr double kGreatestSpeed = 10.0;  // [optimal fiber lengths / s]
  const double cosine = std::cos(muscle.pennation_angle_rad);
  const double length = (length_m - muscle.tendon_slack_length_m) / (muscle.optimal_fiber_length_m * cosine);
  const double velocity = velocity_mps / (kGreatestSpeed * muscle.optimal_fiber_length_m);
  constexpr double kStraight = 30.0;  // above it log(1 + exp(x)) is x to round-off
  const double rise = 12.438535493526128 * (length - 1.329470475731338);
  const double passive = 0.232000797810576 * (rise > kStraight ? rise : std::log1p(std::exp(rise)));
  return muscle.max_isometric_force_n * cosine *
         (activation * muscle::de_groote_force_length(length).value * muscle::de_groote_force_velocity(velocity).value +
          passive);
}

}  // namespace myoid::results
