#pragma once

#include <Eigen/Core>

#include "myoid/simulation/random.h"

namespace myoid::twin {

/// The bends of the spectrum of surface EMG: power [1/Hz] ~ f^2 f_h^4 / ((f^2 + f_l^2) (f^2 +
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
                                        simulation::Random& random);

/// The same noise from given white innovations of unit variance, of which the first `lead` settle
/// the filter and give no sample. `emg_lead` are enough.
[[nodiscard]] Eigen::VectorXd emg_from(const EmgSpectrum& spectrum,
                                       double rate_hz,
                                       const Eigen::VectorXd& innovations,
                                       Eigen::Index lead);
[[nodiscard]] Eigen::Index emg_lead(const EmgSpectrum& spectrum, double rate_hz);

/// Discharges per second of the motor units near an electrode, at an excitation of 0 to 1: their
/// number times their rate. Recruitment ends at 0.6, with thresholds spread so that half of the
/// units are at work at a tenth; rates go from 8 to 30 1/s (after Fuglevand, Winter & Patla 1993).
[[nodiscard]] double discharges_hz(double motor_units, double excitation);

/// White noise of unit variance that is made of discharges: in every sample a Poisson number of
/// them, each of normal size, over the square root of their mean number. Few discharges make
/// spikes (excess kurtosis 3 / number), many make Gaussian noise; the spectrum stays white.
/// `per_second`: mean number, one value for each sample.
[[nodiscard]] Eigen::VectorXd discharge_noise(const Eigen::VectorXd& per_second,
                                              double rate_hz,
                                              simulation::Random& random);

/// `count` samples of Gaussian noise of unit variance whose power falls with the fourth power of
/// frequency above `cutoff_hz` (two equal first-order lags).
[[nodiscard]] Eigen::VectorXd lowpass_noise(double cutoff_hz,
                                            double rate_hz,
                                            Eigen::Index count,
                                            simulation::Random& random);

}  // namespace myoid::twin
