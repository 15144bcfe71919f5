#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/fiber.h"
#include "myoid/fit/measurement/muscle_rows.h"
#include "myoid/fit/measurement/parameters.h"
#include "myoid/fit/posterior/trial_run.h"

namespace myoid::fit {

/// The model's torque signals of one run at all n samples of its J joints; also the gradient of a
/// function by these signals.
struct TorqueSignals {
  Eigen::VectorXd torque_nm;  ///< n J: T^_j = sum_k r_jk F_k + the joint's own torque.
  /// n J x channels: D_c, the change of torque by one standard deviation of rectified EMG, relative to the envelope
  /// (TrialRun::envelope_sd): d T^ / d ln u_c n(u) / (sd u), with n(u) / (sd u) from noise_over_envelope; of an
  /// activation without EMG d T^ / d ln u / u, the change by an activation of 1.
  Eigen::MatrixXd by_noise;
  /// n K: lengths of the fibers of TrialRun::fascicles. The noise of an envelope, which moves a fiber by some 0.5 mm,
  /// is left out.
  Eigen::VectorXd fiber_m{};

  /// Returns all n (J + K) rows.
  [[nodiscard]] Eigen::VectorXd all() const;
};

/// The torque signals of one run at one point, and all quantities that carry a gradient from the
/// signals back to the unknowns.
///
/// dT^/d ln u is a secant, between the activations a and a (1 + 0.02 p), p the exponent of the
/// channel. Its gradient needs only first derivatives of the muscles' law, and is exact. A muscle
/// whose force is proportional to activation has the secant p F.
class RunEvaluation {
 public:
  /// Evaluates a run. Without `chains` (null) the gradients cannot be asked for.
  RunEvaluation(
      const TrialRun& run, const ParameterMap& map, EmgLag lag, const ModelValues& values, const ChainsByOwner* chains);

  [[nodiscard]] const TorqueSignals& signals() const { return signals_; }
  /// The channels' activations at the n samples.
  [[nodiscard]] const std::vector<std::vector<Activation>>& activations() const { return activations_; }
  /// Returns a muscle's tension, with its derivatives by length and rate.
  [[nodiscard]] const MuscleRows& muscle(std::size_t k) const { return muscles_[k].at; }
  /// Returns the fibers of the k-th of TrialRun::fascicles.
  [[nodiscard]] const FiberRows& fibers(std::size_t k) const { return fibers_[k]; }
  /// Adds to `by_z` the gradient of a function whose gradient by the signals is `by`.
  void pull_back(const TorqueSignals& by, Eigen::VectorXd& by_z) const;
  /// Returns d T^ / d z and behind it that of the fibers' lengths, n (J + K) x unknowns.
  [[nodiscard]] Eigen::MatrixXd jacobian(Eigen::Index unknowns) const;

 private:
  struct Muscle {
    Eigen::Index channel = 0;
    bool proportional = false;  ///< Force is proportional to activation; `more_active` is empty.
    MuscleRows at, more_active;
  };

  /// Evaluates the k-th muscle and adds its torque to the signals.
  void add_muscle(std::size_t k, const MuscleValues& values);
  /// Returns the chains of the numbers of the run's j-th joint.
  [[nodiscard]] const std::vector<ParameterMap::Chain>& own_chains(std::size_t j) const;

  const TrialRun& run_;
  const ChainsByOwner* chains_ = nullptr;
  std::vector<std::vector<Activation>> activations_;
  std::vector<Muscle> muscles_;
  std::vector<FiberRows> fibers_;  ///< Of TrialRun::fascicles.
  TorqueSignals signals_;
  Eigen::VectorXd exponent_;              ///< Of each channel.
  Eigen::MatrixXd gain_, gain_by_delay_;  ///< n x channels: n(u) / (sd u), and its slope.
};

}  // namespace myoid::fit
