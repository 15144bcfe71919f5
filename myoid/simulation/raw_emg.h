#pragma once

#include <Eigen/Core>

#include "myoid/simulation/random.h"

namespace myoid::simulation {

/// Where the spectrum of surface EMG bends: power [1/Hz] ~ f^2 f_h^4 / ((f^2 + f_l^2) (f^2 +
/// f_h^2)^2) (Shwedyk, Balasubramanian & Scott 1977).
struct EmgSpectrum {
  double low_hz = 60.0;    ///< f_l
  double high_hz = 120.0;  ///< f_h
};

/// The spectrum at a frequency, not normalized.
[[nodiscard]] double power(const EmgSpectrum& spectrum, double frequency_hz);

/// `count` samples of Gaussian noise of unit variance with that spectrum: what sampling
/// H(s) = s f_h^2 / ((s + f_l) (s + f_h)^2), driven by white noise, gives, with what lies above
/// half the rate folded back as a converter would. One normal number per sample, through the
/// recursion of third order that has these samples' autocovariance (its moving average by Bauer's
/// factorization). Throws InvalidInput if the rate is not above 4 f_h.
[[nodiscard]] Eigen::VectorXd emg_noise(const EmgSpectrum& spectrum,
                                        double rate_hz,
                                        Eigen::Index count,
                                        Random& random);

/// `count` samples of Gaussian noise of unit variance whose power falls with the fourth power of
/// frequency above `cutoff_hz` (two equal first-order lags).
[[nodiscard]] Eigen::VectorXd lowpass_noise(double cutoff_hz,
                                            double rate_hz,
                                            Eigen::Index count,
                                            Random& random);

}  // namespace myoid::simulation
