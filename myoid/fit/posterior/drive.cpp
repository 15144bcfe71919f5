#include "myoid/fit/posterior/drive.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include <Eigen/Cholesky>

#include "myoid/ground/math/spline.h"
#include "myoid/ground/math/toeplitz.h"

namespace myoid::fit {
namespace {

constexpr double kRatePerCutoff = 5.0;
constexpr double kBandHalf_hz = 0.25;      // over which the spectrum is averaged
constexpr double kHighestPerCutoff = 1.2;  // highest frequency of W over the cut-off
constexpr double kMostNoise = 3.3;         // times the expected power: ln kappa at two prior spreads
constexpr double kAtOnce_s = 25.0;         // longest piece that is smoothed at once
constexpr double kMargin_s = 1.0;          // overlap with each neighboring piece
constexpr double kMostLost = 1.25;         // times the drive: the filter takes a few percent
constexpr double kFade = 0.15;             // spread of the fade, over the period of the frequency grid
constexpr double kLeastDrive = 1e-4;       // of the resting level, on which noise acts, too
constexpr double kFloor = 0.01;            // of the resting level, over which the drive fades to zero
constexpr double kJitter = 1e-5;           // of the variance, added to the diagonal
constexpr Eigen::Index kFiner = 6;         // samples of the drive for each smoothed sample
constexpr Eigen::Index kBand = 3;          // frequencies that share one power of the drive's error
constexpr double kRead_hz = 20.0;          // usual rate of the instants at which the drive is read
constexpr int kPasses = 3;                 // repetitions, because the noise depends on the drive

Eigen::ArrayXd hann_window(Eigen::Index n) {
  return 0.5 - 0.5 * (2.0 * std::numbers::pi / static_cast<double>(n) *
                      Eigen::ArrayXd::LinSpaced(n, 0.5, static_cast<double>(n) - 0.5))
                         .cos();
}

/// Returns the one-sided power density of evenly sampled values behind a Hann window.
Eigen::VectorXd power_density(const Eigen::VectorXd& values, double rate_hz, const Eigen::VectorXd& frequency_hz) {
  const Eigen::Index n = values.size();
  const Eigen::ArrayXd window = hann_window(n);
  const double mean = (values.array() * window).sum() / window.sum();
  const Eigen::VectorXd x = (values.array() - mean) * window;
  Eigen::VectorXd power(frequency_hz.size());
  for (Eigen::Index k = 0; k < power.size(); ++k) {
    const std::complex<double> turn = std::polar(1.0, -2.0 * std::numbers::pi * frequency_hz[k] / rate_hz);
    std::complex<double> phase = 1.0, sum = 0.0;
    for (Eigen::Index i = 0; i < n; ++i, phase *= turn) sum += x[i] * phase;
    power[k] = 2.0 * std::norm(sum) / (rate_hz * window.square().sum());
  }
  return power;
}

Eigen::VectorXd moving_mean(const Eigen::VectorXd& x, Eigen::Index half) {
  Eigen::VectorXd mean(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Eigen::Index first = std::max<Eigen::Index>(0, i - half);
    mean[i] = x.segment(first, std::min(x.size(), i + half + 1) - first).mean();
  }
  return mean;
}

/// Returns the falling sequence nearest to x by least squares; pools rising neighbors.
Eigen::VectorXd falling(const Eigen::VectorXd& x) {
  std::vector<std::pair<double, Eigen::Index>> pools;  // mean and number
  for (const double value : x) {
    pools.push_back({value, 1});
    while (pools.size() > 1 && pools[pools.size() - 2].first < pools.back().first) {
      const auto [mean, number] = pools.back();
      pools.pop_back();
      auto& [of_both, count] = pools.back();
      count += number;
      of_both += (mean - of_both) * static_cast<double>(number) / static_cast<double>(count);
    }
  }
  Eigen::VectorXd result(x.size());
  Eigen::Index first = 0;
  for (const auto& [mean, count] : pools) {
    result.segment(first, count).setConstant(mean);
    first += count;
  }
  return result;
}

Eigen::VectorXd evenly(const Envelope& envelope, const Eigen::VectorXd& time_s) {
  return time_s.unaryExpr([&](double t) { return envelope.at(t).value; });
}

/// An envelope on the even clock of its smoothing.
struct EvenEnvelope {
  double rate_hz = 0.0;
  Eigen::VectorXd time_s, values;
};
EvenEnvelope even_envelope(const Envelope& recorded, double cutoff_hz) {
  EvenEnvelope of{.rate_hz = kRatePerCutoff * cutoff_hz};
  const auto n = static_cast<Eigen::Index>((recorded.last_s() - recorded.first_s()) * of.rate_hz) + 1;
  of.time_s =
      Eigen::VectorXd::LinSpaced(n, recorded.first_s(), recorded.first_s() + static_cast<double>(n - 1) / of.rate_hz);
  of.values = evenly(recorded, of.time_s);
  return of;
}

/// Returns true for an envelope without noise, a short one, or one at one level (a dead electrode).
bool is_its_own_drive(const EvenEnvelope& of, double noise_sd) {
  return !(noise_sd > 0.0) || static_cast<double>(of.values.size()) < 2.0 * kMargin_s * of.rate_hz ||
         of.values.maxCoeff() - of.values.minCoeff() <= 1e-9 * of.values.cwiseAbs().maxCoeff();
}

/// One-sided power densities, at the frequencies of an EnvelopeError below the highest.
struct Power {
  Eigen::VectorXd frequency_hz, envelope, noise;  ///< The noise is the expected one.
};
Power power_of(const EvenEnvelope& of, double noise_sd, double rest, const EnvelopeError& error, double cutoff_hz) {
  const Eigen::Index count = std::min<Eigen::Index>(
      error.spectrum().size(), static_cast<Eigen::Index>(kHighestPerCutoff * cutoff_hz / error.step_hz()));
  Power power{.frequency_hz = error.frequencies_hz().head(count)};
  const auto half = static_cast<Eigen::Index>(std::ceil(kBandHalf_hz / error.step_hz()));
  power.envelope = moving_mean(power_density(of.values, of.rate_hz, power.frequency_hz), half);
  double variance = 0.0;
  for (const double u : of.values) variance += std::pow(envelope_sd_at(u, noise_sd, rest), 2);
  power.noise = variance / static_cast<double>(of.values.size()) / error.step_hz() * error.spectrum().head(count);
  return power;
}

/// One-sided power density of the drive in the recording.
struct Spectra {
  Eigen::VectorXd drive;
  double level = 1.0;  ///< Power of the noise over the expected.
};
Spectra spectra_of(
    const EvenEnvelope& recorded, double noise_sd, double rest, const EnvelopeError& error, double cutoff_hz) {
  const Power power = power_of(recorded, noise_sd, rest, error, cutoff_hz);
  std::vector<double> ratio;
  for (Eigen::Index i = 0; i < power.noise.size(); ++i) {
    if (power.frequency_hz[i] > 0.5 * cutoff_hz && power.frequency_hz[i] < cutoff_hz)
      ratio.push_back(power.envelope[i] / power.noise[i]);
  }
  std::nth_element(ratio.begin(), ratio.begin() + static_cast<std::ptrdiff_t>(ratio.size() / 2), ratio.end());
  // Chi-squared's median over its mean; a Hann window makes 1.5 neighboring frequencies one.
  const double freedom =
      std::max(2.0, 2.0 * (2.0 * kBandHalf_hz) * static_cast<double>(recorded.values.size()) / recorded.rate_hz / 1.5);
  const double median = ratio[ratio.size() / 2] / std::pow(1.0 - 2.0 / (9.0 * freedom), 3);
  const double level = std::min(kMostNoise, median);
  return {falling(power.envelope - level * power.noise).cwiseMax(0.0), level};
}

/// Returns exp(i w) for each frequency, where w is the angle of one sample.
Eigen::ArrayXcd turns(const Eigen::VectorXd& frequency_hz, double interval_s) {
  return (std::complex<double>(0.0, 2.0 * std::numbers::pi * interval_s) * frequency_hz.array()).exp();
}

/// Returns sum_f power cos(2 pi f j interval), j = 0 ... last; fades before the sum repeats.
Eigen::VectorXd covariances(const Eigen::VectorXd& power,
                            const EnvelopeError& error,
                            double interval_s,
                            Eigen::Index last) {
  const Eigen::ArrayXcd turn = turns(error.frequencies_hz().head(power.size()), interval_s);
  Eigen::ArrayXcd phase = (power * error.step_hz()).cast<std::complex<double>>();
  const double fade_s = kFade / error.step_hz();
  Eigen::VectorXd c(last + 1);
  for (Eigen::Index j = 0; j <= last; ++j, phase *= turn)
    c[j] = phase.real().sum() * std::exp(-0.5 * std::pow(static_cast<double>(j) * interval_s / fade_s, 2));
  return c;
}

/// Returns T e, e_j = exp(i w j), of the symmetric Toeplitz matrix T with first column c: with the sums
/// A_k = c_0 + ... + c_k exp(i w k) row k is exp(i w k) (A_k* + A_n-1-k - c_0).
Eigen::ArrayXcd product_with_wave(const Eigen::VectorXd& c, double angle) {
  const Eigen::Index n = c.size();
  const std::complex<double> turn = std::polar(1.0, angle);
  Eigen::ArrayXcd wave(n), sum(n);
  std::complex<double> phase = 1.0, so_far = 0.0;
  for (Eigen::Index k = 0; k < n; ++k, phase *= turn) {
    wave[k] = phase;
    sum[k] = so_far += c[k] * phase;
  }
  return wave * (sum.conjugate() + sum.reverse() - c[0]);
}

/// Returns columns T v, v_j = h_j exp(i w j), for each frequency, real part and imaginary part: h is a Hann window,
/// three waves, and T the symmetric Toeplitz matrix with first column c.
Eigen::MatrixXd products_with_windowed_waves(const Eigen::VectorXd& c,
                                             const Eigen::VectorXd& frequency_hz,
                                             double interval_s) {
  const double step = 2.0 * std::numbers::pi / static_cast<double>(c.size());
  const std::complex<double> side = std::polar(0.25, 0.5 * step);
  Eigen::MatrixXd products(c.size(), 2 * frequency_hz.size());
  for (Eigen::Index i = 0; i < frequency_hz.size(); ++i) {
    const double angle = 2.0 * std::numbers::pi * frequency_hz[i] * interval_s;
    const Eigen::ArrayXcd product = 0.5 * product_with_wave(c, angle) - side * product_with_wave(c, angle + step) -
                                    std::conj(side) * product_with_wave(c, angle - step);
    products.col(2 * i) = product.real();
    products.col(2 * i + 1) = product.imag();
  }
  return products;
}

/// Returns v* T v, v_j = h_j exp(i w j), for each frequency: the power of an error whose covariance is the symmetric
/// Toeplitz matrix T with first column c, behind a window h.
Eigen::VectorXd windowed_power(const Eigen::VectorXd& c,
                               const Eigen::VectorXd& window,
                               const Eigen::VectorXd& frequency_hz,
                               double interval_s) {
  const Eigen::ArrayXcd turn = turns(frequency_hz, interval_s);
  Eigen::ArrayXcd phase = Eigen::ArrayXcd::Ones(turn.size());
  Eigen::VectorXd power = Eigen::VectorXd::Constant(turn.size(), c[0] * window.squaredNorm());
  for (Eigen::Index d = 1; d < c.size(); ++d) {
    phase *= turn;
    power += 2.0 * c[d] * window.head(c.size() - d).dot(window.tail(c.size() - d)) * phase.real().matrix();
  }
  return power;
}

/// Returns the number of bands of kBand frequencies each, of which the last is whole.
Eigen::Index bands(Eigen::Index frequencies) { return std::max<Eigen::Index>(1, frequencies / kBand); }

/// The drive of evenly sampled values, and the powers behind a Hann window of the drive's error and
/// of the noise, at the middle of each kBand frequencies of the spectra.
struct Smoothed {
  Eigen::VectorXd drive, error, noise;
  double along = 0.0, size = 0.0;  ///< The numerator and the denominator of b (Drive).
};
Smoothed smooth(const Eigen::VectorXd& values,
                double interval_s,
                const Spectra& spectra,
                double noise_sd,
                double rest,
                const EnvelopeError& error) {
  const Eigen::Index n = values.size();
  const Eigen::VectorXd of_drive = covariances(spectra.drive, error, interval_s, n - 1),
                        of_noise = covariances(error.spectrum() / error.step_hz(), error, interval_s, n - 1);
  const Eigen::MatrixXd prior = math::toeplitz(of_drive), correlation = math::toeplitz(of_noise);
  const double mean = values.mean(), least = 0.001 * values.maxCoeff();
  Smoothed result;
  result.drive = moving_mean(values, static_cast<Eigen::Index>(std::lround(0.25 / interval_s)));
  for (int pass = 0; pass < kPasses; ++pass) {
    const Eigen::VectorXd scale = result.drive.unaryExpr(
        [&](double u) { return std::sqrt(spectra.level) * envelope_sd_at(std::max(u, least), noise_sd, rest); });
    const Eigen::MatrixXd noise = scale.asDiagonal() * correlation * scale.asDiagonal();
    Eigen::MatrixXd all = prior + noise;
    all.diagonal().array() += kJitter * all.diagonal().mean();
    const Eigen::LLT<Eigen::MatrixXd> factor(all);
    const Eigen::VectorXd off = factor.solve((values.array() - mean).matrix());
    result.drive = mean + (prior * off).array();
    if (pass + 1 < kPasses) continue;
    // The drive's error has the covariance P - P (P + N)^-1 P, P the drive's and N the noise's.
    const Eigen::VectorXd frequency =
        error.frequencies_hz()(Eigen::seqN(kBand / 2, bands(spectra.drive.size()), kBand));
    const Eigen::VectorXd window = hann_window(n);
    const Eigen::MatrixXd half = factor.matrixL().solve(products_with_windowed_waves(of_drive, frequency, interval_s));
    const Eigen::VectorXd known = half.colwise().squaredNorm();
    result.error = windowed_power(of_drive, window, frequency, interval_s) -
                   known.reshaped(2, frequency.size()).colwise().sum().transpose();
    result.noise = windowed_power(of_noise, window.cwiseProduct(scale), frequency, interval_s);
    const double passed = 2.0 * static_cast<double>(kBand) * error.step_hz() * interval_s * result.error.sum();
    const Eigen::VectorXd behind = window.cwiseAbs2().cwiseProduct(result.drive);
    result.along = behind.dot(values) - passed;
    result.size = behind.dot(result.drive);
  }
  return result;
}

}  // namespace

double envelope_sd_at(double u, double noise_sd, double rest) {
  const double certain = std::sqrt(u * u + rest * rest * noise_sd);
  return certain > 0.0 ? noise_sd * (certain + rest * rest / certain) : 0.0;
}

NoiseOverEnvelope noise_over_envelope(double u, double noise_sd, double rest) {
  if (!(rest > 0.0)) return {};
  const double certain = std::sqrt(u * u + rest * rest * noise_sd), least = kLeastDrive * rest;
  const double squared = rest * rest / (certain * certain), noise = certain * (1.0 + squared);
  const double drive = std::sqrt(u * u + least * least);  // not the larger: a kink stops a search
  return {noise / drive, u * ((1.0 - squared) / (certain * drive) - noise / (drive * drive * drive))};
}

Drive drive_behind(
    const Envelope& recorded, double noise_sd, double rest, const EnvelopeError& error, double cutoff_hz) {
  const EvenEnvelope even = even_envelope(recorded, cutoff_hz);
  Eigen::VectorXd left = Eigen::VectorXd::Ones(error.spectrum().size());
  if (is_its_own_drive(even, noise_sd)) return {recorded, left};
  const Spectra spectra = spectra_of(even, noise_sd, rest, error, cutoff_hz);
  const Eigen::VectorXd &time = even.time_s, &values = even.values;
  const double rate_hz = even.rate_hz;
  const Eigen::Index n = values.size();
  const auto margin = static_cast<Eigen::Index>(kMargin_s * rate_hz);
  const auto longest = static_cast<Eigen::Index>(kAtOnce_s * rate_hz);
  const Eigen::Index count = bands(spectra.drive.size());
  double along = 0.0, size = 0.0;
  Eigen::VectorXd drive(n), left_power = Eigen::VectorXd::Zero(count), noise_power = left_power;
  for (Eigen::Index first = 0; first < n; first += longest) {
    const Eigen::Index end = std::min(n, first + longest), from = std::max<Eigen::Index>(0, first - margin),
                       to = std::min(n, end + margin);
    const Smoothed part = smooth(values.segment(from, to - from), 1.0 / rate_hz, spectra, noise_sd, rest, error);
    drive.segment(first, end - first) = part.drive.segment(first - from, end - first);
    along += part.along;
    size += part.size;
    left_power += part.error;
    noise_power += part.noise;
  }
  for (Eigen::Index i = 0; i < left.size(); ++i) {
    const Eigen::Index at = std::min(i / kBand, count - 1);
    left[i] = spectra.level * std::clamp(left_power[at] / std::max(noise_power[at], 1e-300), 0.0, 1.0);
  }
  if (size > 0.0) drive *= std::clamp(along / size, 1.0 / kMostLost, kMostLost);
  // The finer samples put the kinks at zero where the drive has them. With kinks at the samples, a
  // search for the delay would see the samples.
  const Eigen::VectorXd fine = Eigen::VectorXd::LinSpaced(kFiner * (n - 1) + 1, time[0], time[n - 1]);
  const Eigen::VectorXd found = math::Spline::interpolate(time, drive).evaluate(fine).value;
  // A corner at zero in place of the fade would give the posterior a kink at each sample there.
  const Eigen::VectorXd faded = found.unaryExpr([&](double u) { return 0.5 * (u + std::hypot(u, kFloor * rest)); });
  const double fine_hz = rate_hz * static_cast<double>(kFiner);
  return {Envelope(fine, faded, std::lround(fine_hz / kRead_hz)), std::move(left)};
}

Drive drive_of_clean(
    const Envelope& clean, double noise_sd, double rest, const EnvelopeError& error, double cutoff_hz, double level) {
  const EvenEnvelope even = even_envelope(clean, cutoff_hz);
  Eigen::VectorXd left = Eigen::VectorXd::Ones(error.spectrum().size());
  if (is_its_own_drive(even, noise_sd)) return {clean, left};
  const Power power = power_of(even, noise_sd, rest, error, cutoff_hz);
  const Eigen::ArrayXd drive = falling(power.envelope).cwiseMax(0.0);
  const Eigen::ArrayXd wiener = drive / (drive + level * power.noise.array()).max(1e-300);
  for (Eigen::Index i = 0; i < left.size(); ++i) left[i] = level * wiener[std::min(i, wiener.size() - 1)];
  return {clean, std::move(left)};
}

std::shared_ptr<const Drive> DriveMemory::known(const Key& key) const {
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = drives_.find(key); found != drives_.end()) return found->second;
  }
  return whole_ ? whole_->known(key) : nullptr;
}

std::shared_ptr<const Drive> DriveMemory::behind(const TimeSeries& recorded,
                                                 const std::string& channel,
                                                 double noise_sd,
                                                 double rest,
                                                 const EnvelopeError& error,
                                                 double cutoff_hz) {
  const Eigen::VectorXd values = recorded.column(channel);
  Key key{noise_sd, rest, cutoff_hz};
  // Trials share times, so that their values differ sooner.
  key.insert(key.end(), values.begin(), values.end());
  key.insert(key.end(), recorded.time_s().begin(), recorded.time_s().end());
  if (std::shared_ptr<const Drive> drive = known(key)) return drive;
  const Envelope envelope(recorded.time_s(), values);
  auto found = std::make_shared<const Drive>(
      level_of_clean_ ? drive_of_clean(envelope, noise_sd, rest, error, cutoff_hz, *level_of_clean_)
                      : drive_behind(envelope, noise_sd, rest, error, cutoff_hz));
  const std::lock_guard lock(mutex_);
  return drives_.emplace(std::move(key), std::move(found)).first->second;
}

}  // namespace myoid::fit
