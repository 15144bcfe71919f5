#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/kinematics/path_surrogate.h"
#include "myoid/body/model/path_stations.h"
#include "myoid/fit/measurement/envelope.h"
#include "myoid/fit/measurement/muscle_law.h"
#include "myoid/fit/measurement/parameter_fields.h"
#include "myoid/results/realtime/band_space.h"

namespace myoid::results {

/// An identified person, ready to predict torques and muscle forces while the person moves:
///
///   T_j = sum_m r_jm(q) F_m(a, l(q), dl/dt) - viscosity qdot - stiffness q + offset
///
/// with the muscle law, the EMG's gains and the joint's own torque of the fit. Lengths l and moment
/// arms r are polynomials of the angles (body::PathSurrogate). A value that does not change:
/// several threads may use one predictor, each with a workspace of its own.
struct Predictor {
  /// The derivative of a number of the model by an unknown of the fit.
  struct Chain {
    int field = 0;
    Eigen::Index variable = 0;
    double slope = 1.0;
  };
  struct Head {
    std::size_t path = 0;  ///< Index in `paths`.
    double weight = 1.0;
  };
  struct Muscle {
    std::string name;
    std::size_t channel = 0;
    fit::MuscleValues values{};
    std::vector<Head> heads;
    std::vector<Chain> chains;
  };
  struct Channel {
    std::string name;
    fit::ChannelValues values{};
    std::vector<Chain> chains;
    double pure_delay_s = 0.0;
    bool lags = false;  ///< The time constants of `values` act beside the pure delay.
  };
  struct Joint {
    std::string name;
    int coordinate = 0;  ///< Index in the model.
    fit::JointValues values{};
    std::vector<Chain> chains;
  };

  std::vector<Muscle> muscles;
  std::vector<Channel> channels;
  std::vector<Joint> joints;
  std::vector<body::PathSurrogate> paths;
  Eigen::VectorXd default_q;   ///< Default values of all coordinates of the model.
  Eigen::MatrixXd covariance;  ///< Covariance of the fit's unknowns.
  double torque_sd_nm = 0.0;   ///< Standard deviation of the torque that the fit leaves unexplained.
};

/// Space for `predict`, and its results; one per thread.
struct PredictorWorkspace {
  Eigen::VectorXd torque_nm, torque_sd_nm;  ///< One per joint.
  Eigen::VectorXd force_n, force_sd_n;      ///< One per muscle: tension along the tendon.

  /// A channel's envelope on its way through the lags.
  struct Following {
    bool begun = false;
    double envelope = 0.0, excitation = 0.0, activation = 0.0;
  };
  std::vector<Following> following;

  Eigen::VectorXd q, qdot;
  std::vector<body::SurrogateWorkspace> tables;
  std::vector<body::PathResult> paths;
  std::vector<fit::Activation> activations;
  BandSpace bands;
};
[[nodiscard]] PredictorWorkspace workspace_for(const Predictor& predictor);

enum class Prediction {
  done,
  not_a_number,  ///< An input is not finite, or an envelope is below 0.
  out_of_range,  ///< An angle lies outside the range of the polynomials.
};

/// Passes the next sample of each channel's envelope, `step_s` after the one before, through the
/// two lags of equation (1), as fit::activation does:
///
///   de/dt = (u - e) / tau_ne,   da/dt = (e - a) / (tau_ac if e >= a, tau_deac if e < a)
///
/// The first sample is taken as held for long. A channel without lags gives the sample itself. Allocates nothing.
void follow(const Predictor& predictor,
            std::span<const double> envelope,
            double step_s,
            PredictorWorkspace& workspace,
            std::span<double> acting);

/// Returns the activation a = shape(g u^p) of a channel at its acting envelope u, before the
/// muscle's share, with the derivatives by gain, shape and exponent.
[[nodiscard]] fit::Activation activation_at(double envelope, const fit::ChannelValues& channel);

/// Predicts torques [N m] and forces [N] with their standard deviations, at the envelope of each channel (0..1, as
/// activation.sto holds it, through `follow`, of the pure delay ago), and the angle [rad] and speed [rad/s] of each
/// joint. The standard deviation of a force is that of the parameters; that of a torque also holds `torque_sd_nm`.
/// Without `with_bands` the standard deviations, which take most of the time where muscles are many, stay as they are.
/// Allocates nothing. Results are valid where `done` is returned.
[[nodiscard]] Prediction predict(const Predictor& predictor,
                                 std::span<const double> envelope,
                                 std::span<const double> angle_rad,
                                 std::span<const double> speed_radps,
                                 PredictorWorkspace& workspace,
                                 bool with_bands = true);

}  // namespace myoid::results
