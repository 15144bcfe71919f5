#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/postures.h"
#include "myoid/fit/posterior/likelihood.h"
#include "myoid/fit/posterior/trial_run.h"

namespace myoid::fit {

/// Steady states in which one muscle alone pulls with its greatest effort: the postures at rest, then the postures at
/// each speed.
struct VoluntaryStates {
  int joint = 0;           ///< Index in ParameterMap::joints().
  std::size_t muscle = 0;  ///< The muscle that pulls.
  int direction = 1;       ///< Of the muscle's torque about the joint.
  Eigen::VectorXd speeds_radps;
};

/// Returns the greatest effort of each EMG channel as its envelope: 1 where a maximal contraction was recorded, else
/// the largest envelope of the fitted trials.
[[nodiscard]] Eigen::VectorXd greatest_envelopes(const Likelihood& likelihood, bool from_mvc);

/// Returns the states as a run of n (1 + speeds) samples of one joint, n the number of postures. At a speed the joint
/// turns in the direction of the muscle's torque. Every other muscle is without moment arm and nearly without EMG.
[[nodiscard]] TrialRun run_of(const VoluntaryStates& states,
                              const Postures& postures,
                              const ParameterMap& map,
                              const Eigen::VectorXd& greatest_envelope);

/// A torque in those states, to the first order in independent standard normal numbers e: T = mean + by_chance e.
struct NormalTorque {
  Eigen::VectorXd mean_nm;    ///< n (1 + speeds)
  Eigen::MatrixXd by_chance;  ///< n (1 + speeds) x numbers

  NormalTorque& operator+=(const NormalTorque& other);
};

/// One reading of the posterior (Believed) of z and x, to the first order about z: x has the expectation at `noise`,
/// those of the mode, and the covariance at `of_widths` (LearnedSizes). `covariance` is that of z.
class LinearReading {
 public:
  LinearReading(const Likelihood& likelihood,
                const Eigen::VectorXd& z,
                const NoiseValues& noise,
                const NoiseValues& of_widths,
                const Eigen::MatrixXd& covariance);
  [[nodiscard]] const Likelihood& likelihood() const { return likelihood_; }
  /// Returns the torque of the muscles that pull, times `direction`.
  [[nodiscard]] NormalTorque torque(const TrialRun& run, int direction) const;

 private:
  const Likelihood& likelihood_;
  Eigen::VectorXd z_;
  NoiseValues noise_, of_widths_;
  Likelihood::UnseenGiven unseen_;
  Eigen::MatrixXd root_z_, root_unseen_;  ///< Roots of both covariances.
};

/// The greatest of samples at even places, and its place, by the parabola through it and its neighbors.
struct Peak {
  double value = 0.0, place = 0.0;
  bool at_end = false;  ///< Greatest at an end of the range.
};
[[nodiscard]] Peak peak_of(const Eigen::Ref<const Eigen::VectorXd>& values, const Eigen::VectorXd& place);

/// The peaks of draws of a torque.
struct Peaks : Peak {              ///< That of the mean.
  Eigen::VectorXd values, places;  ///< Of each draw.
  double at_ends = 0.0;            ///< Share of the draws that are greatest at an end.
};

/// Returns standard normal numbers, places x draws, the same in every call.
[[nodiscard]] Eigen::MatrixXd voluntary_draws(Eigen::Index places);

/// Returns the peaks of the first n samples of `torque`, over the even places (n). The size of a draw is log-normal
/// about the mean's peak. `draws`: at least n rows of `voluntary_draws`.
[[nodiscard]] Peaks peaks_of(const NormalTorque& torque, const Eigen::VectorXd& place, const Eigen::MatrixXd& draws);

}  // namespace myoid::fit
