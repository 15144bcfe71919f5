#pragma once

#include <Eigen/Core>

namespace myoid::results {

/// The law of the NMSM Pipeline; that of CEINMS stands in opensim/projects/ceinms_law.h.

/// Returns the neural activation of the NMSM Pipeline, of second order in the sampling interval [s]:
///   du/dt = (0.75 e + 0.25) (e - u) / tau
/// (Meyer et al. 2017, equations 5 to 7: a deactivation four times as slow as the activation), settled before the first
/// sample.
[[nodiscard]] Eigen::VectorXd nmsm_neural_activation(const Eigen::VectorXd& excitation,
                                                     double interval_s,
                                                     double time_constant_s);

/// Returns the activation from the neural activation, (1 - c) u + c n(u): n is a steep curve from 0 to 1.
[[nodiscard]] double nmsm_activation(double neural, double nonlinearity);

/// The numbers of a muscle in the NMSM Pipeline.
struct NmsmMuscle {
  double max_isometric_force_n = 0.0, optimal_fiber_length_m = 0.0, tendon_slack_length_m = 0.0;
  double pennation_angle_rad = 0.0;  ///< Of the model; constant.
};

/// Returns the force along the tendon [N] with a rigid tendon and the Pipeline's curves: those of De Groote et al.
/// (2016), a passive force without a corner, and 10 optimal fiber lengths per second as the greatest speed.
[[nodiscard]] double nmsm_force(double activation, double length_m, double velocity_mps, const NmsmMuscle& muscle);

}  // namespace myoid::results
