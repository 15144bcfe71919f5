#pragma once

#include <Eigen/Core>

#include "myoid/ground/math/random.h"

namespace myoid::lab {

/// Corner frequencies of the spectrum of surface EMG: power [1/Hz] ~ f^2 f_h^4 / ((f^2 + f_l^2)
/// (f^2 + f_h^2)^2) (Shwedyk, Balasubramanian & Scott 1977).
struct EmgSpectrum {
  double low_hz = 60.0;    ///< f_l
  double high_hz = 120.0;  ///< f_h
};

/// Returns noise of unit variance with this spectrum from white innovations of unit variance: the samples of H(s) = s
/// f_h^2 / ((s + f_l) (s + f_h)^2), driven by white noise, with frequencies above half the rate folded back as by a
/// converter. Each sample takes one innovation, through the recursion of third order that has these samples'
/// autocovariance (its moving average by Bauer's factorization). The first `lead` innovations settle the filter and
/// give no sample; `emg_lead` returns a sufficient number. Throws InvalidInput if the rate is not above 4 f_h.
[[nodiscard]] Eigen::VectorXd emg_from(const EmgSpectrum& spectrum,
                                       double rate_hz,
                                       const Eigen::VectorXd& innovations,
                                       Eigen::Index lead);
[[nodiscard]] Eigen::Index emg_lead(const EmgSpectrum& spectrum, double rate_hz);

/// Returns the discharges per second of the motor units near an electrode, at an excitation of 0 to
/// 1: their number times their rate. Recruitment ends at 0.6, with thresholds such that half of the
/// units are active at a tenth; rates go from 8 to 30 1/s (after Fuglevand, Winter & Patla 1993).
[[nodiscard]] double discharges_hz(double motor_units, double excitation);

/// Returns white noise of unit variance made of discharges: in every sample a Poisson number of discharges, each of
/// normal size, over the square root of their mean number. Few discharges make spikes (excess kurtosis 3 / number),
/// many make Gaussian noise; the spectrum stays white. `per_second`: mean number, one value for each sample.
[[nodiscard]] Eigen::VectorXd discharge_noise(const Eigen::VectorXd& per_second, double rate_hz, math::Random& random);

/// Returns `count` samples of Gaussian noise of unit variance whose power falls with the fourth
/// power of frequency above `cutoff_hz` (two equal first-order lags).
[[nodiscard]] Eigen::VectorXd lowpass_noise(double cutoff_hz, double rate_hz, Eigen::Index count, math::Random& random);

}  // namespace myoid::lab
