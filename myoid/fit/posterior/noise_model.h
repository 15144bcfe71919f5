#pragma once

#include <array>

#include <Eigen/Core>

#include "myoid/fit/measurement/reduction.h"

namespace myoid::fit {

/// Indices in NoiseValues of the hyperparameters phi of the errors, each on an unbounded scale. The sizes, from
/// kModelErrorSize on, are those of quantities that residuals can tell (UnseenQuantity::size).
/// After them stands ln b of each fitted trial, the trial's own factor of sigma_T: a dynamometer
/// errs by more than the inverse dynamics of the same session.
enum NoiseField : int {
  kTorqueSd,        ///< ln sigma_T [N m]: size of the torque's error e_T.
  kTorqueTime,      ///< ln tau_T [s]: e_T has the covariance sigma_T^2 exp(-|dt| / tau_T).
  kEmgFactor,       ///< ln kappa: noise of the envelopes over the noise that their bandwidth predicts.
  kModelErrorSize,  ///< ln s: relative size of the model's error e_m.
  // ln of the spread of a kind of unseen quantities, over the spread that is believed.
  kArmSlopeSize,
  kCrosstalkSize,
  kGainDriftSize,
  kRiseAndFallSize,
  kNoiseFieldCount
};
using NoiseValues = Eigen::VectorXd;

/// The autocorrelation R of an envelope's relative error, and the share of its variance that passes
/// the lags behind which it acts. Rectified EMG is white up to the low-pass of a few hertz. Behind
/// two passes of a Butterworth filter of second order its spectrum is 1 / (1 + (f/f_0)^4)^2, f_0
/// the corner of one pass, and each lag of time constant tau divides it by 1 + (2 pi f tau)^2.
class EnvelopeError {
 public:
  EnvelopeError(double cutoff_hz, const std::array<double, 2>& lag_s);
  /// Returns the error behind Wiener's filter of this gain at each of `frequencies_hz`.
  [[nodiscard]] EnvelopeError behind(const Eigen::VectorXd& gain) const;

  [[nodiscard]] double step_hz() const { return step_hz_; }
  [[nodiscard]] Eigen::VectorXd frequencies_hz() const;
  /// Share of the variance at each of `frequencies_hz`; the shares add to 1.
  [[nodiscard]] const Eigen::VectorXd& spectrum() const { return spectrum_; }
  /// Returns R at the time differences 0, interval, ... last x interval [s]; R is 0 from `reach_s` on.
  [[nodiscard]] Eigen::VectorXd correlations(double interval_s, Eigen::Index last) const;
  [[nodiscard]] double reach_s() const { return reach_s_; }
  [[nodiscard]] double share() const { return share_; }
  /// Returns weights h, an odd number about the middle one, that turn white noise of unit variance
  /// into samples with the autocorrelation R.
  [[nodiscard]] Eigen::VectorXd from_white(double interval_s) const;

 private:
  double step_hz_ = 0.0, reach_s_ = 0.0, share_ = 1.0;
  Eigen::VectorXd spectrum_;  ///< Adds to 1.
};

/// The torque error that the noise of envelopes causes, behind L: white noise times the torque's
/// sensitivity D at each sample, then the envelope's filter h and L. The error has the covariance
///
///   A(i, j) = sum_t k(t - first_i) k(t - first_j) v(t),
///   k = weights of L * h,  v = sum_c D_c^2
///
/// At the ends of a run v continues with its first and last value.
class EmgNoise {
 public:
  EmgNoise(const Reduction& reduction, const Eigen::VectorXd& from_white);
  /// Returns A; `variance` is v, n.
  [[nodiscard]] Eigen::MatrixXd covariance(const Eigen::VectorXd& variance) const;
  /// Returns the gradient by v of a function whose gradient by A is `by` (symmetric).
  [[nodiscard]] Eigen::VectorXd pull_back(const Eigen::MatrixXd& by) const;

 private:
  Eigen::Index inputs_, outputs_, begin_, stride_;
  Eigen::VectorXd kernel_;
};

/// First columns of the Toeplitz matrices of the torque's error behind L: its covariance at sigma_T
/// = 1, and the covariance's derivative by ln tau_T.
struct TorqueError {
  Eigen::VectorXd correlation, by_log_time;
};
[[nodiscard]] TorqueError torque_error(const Reduction& reduction, double interval_s, double log_time);

}  // namespace myoid::fit
