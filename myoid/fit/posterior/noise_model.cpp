#include "myoid/fit/posterior/noise_model.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace myoid::fit {
namespace {

constexpr Eigen::Index kFrequencies = 800;
constexpr double kHighest = 8.0;       // times the corner: the spectrum is below 1e-7 there
constexpr double kReachPeriods = 2.5;  // periods of the cut-off: R is below 1e-5 there

}  // namespace

EnvelopeError::EnvelopeError(double cutoff_hz, const std::array<double, 2>& lag_s) {
  const double corner_hz = cutoff_hz / std::pow(std::numbers::sqrt2 - 1.0, 0.25);
  step_hz_ = kHighest * corner_hz / static_cast<double>(kFrequencies);
  spectrum_.resize(kFrequencies);
  double all = 0.0;
  for (Eigen::Index i = 0; i < kFrequencies; ++i) {
    const double f = (static_cast<double>(i) + 0.5) * step_hz_;
    const double passed = 1.0 / std::pow(1.0 + std::pow(f / corner_hz, 4), 2);
    all += passed;
    spectrum_[i] = passed;
    for (const double lag : lag_s) spectrum_[i] /= 1.0 + std::pow(2.0 * std::numbers::pi * f * lag, 2);
  }
  share_ = spectrum_.sum() / all;
  spectrum_ /= spectrum_.sum();
  reach_s_ = kReachPeriods / cutoff_hz + 3.0 * (lag_s[0] + lag_s[1]);
}

EnvelopeError EnvelopeError::behind(const Eigen::VectorXd& gain) const {
  EnvelopeError left = *this;
  left.spectrum_ = spectrum_.cwiseProduct(gain);
  const double sum = std::max(left.spectrum_.sum(), 1e-12);
  left.share_ = share_ * sum;
  left.spectrum_ /= sum;
  return left;
}

Eigen::VectorXd EnvelopeError::frequencies_hz() const {
  return step_hz_ * Eigen::VectorXd::LinSpaced(kFrequencies, 0.5, static_cast<double>(kFrequencies) - 0.5);
}

Eigen::VectorXd EnvelopeError::correlations(double interval_s, Eigen::Index last) const {
  // cos(w_i j) by turning each wave on from sample to sample.
  const Eigen::ArrayXcd turn =
      (std::complex<double>(0.0, 2.0 * std::numbers::pi * interval_s) * frequencies_hz().array()).exp();
  Eigen::ArrayXcd wave = spectrum_.cast<std::complex<double>>();
  Eigen::VectorXd r = Eigen::VectorXd::Zero(last + 1);
  for (Eigen::Index j = 0; j <= last && static_cast<double>(j) * interval_s < reach_s_; ++j, wave *= turn)
    r[j] = wave.real().sum();
  return r;
}

Eigen::VectorXd EnvelopeError::from_white(double interval_s) const {
  // The square root of R's spectrum, over a circle that is longer than the reach of R.
  const auto reach = static_cast<Eigen::Index>(std::ceil(reach_s_ / interval_s));
  const Eigen::Index size = 2 * reach + 1;
  const Eigen::VectorXd r = correlations(interval_s, reach);
  const Eigen::VectorXd circle = (2.0 * std::numbers::pi / static_cast<double>(size) *
                                  Eigen::ArrayXd::LinSpaced(size, 0.0, static_cast<double>(size - 1)))
                                     .cos();
  const auto cosine = [&](Eigen::Index a, Eigen::Index b) { return circle[(a * b) % size]; };
  Eigen::VectorXd amplitude(reach + 1);
  for (Eigen::Index k = 0; k <= reach; ++k) {
    double power = r[0];
    for (Eigen::Index j = 1; j <= reach; ++j) power += 2.0 * r[j] * cosine(j, k);
    amplitude[k] = std::sqrt(std::max(power, 0.0));
  }
  Eigen::VectorXd h(size);
  for (Eigen::Index j = 0; j <= reach; ++j) {
    double sum = amplitude[0];
    for (Eigen::Index k = 1; k <= reach; ++k) sum += 2.0 * amplitude[k] * cosine(j, k);
    h[reach + j] = h[reach - j] = sum / static_cast<double>(size);
  }
  return h;
}

EmgNoise::EmgNoise(const Reduction& reduction, const Eigen::VectorXd& from_white)
    : inputs_(reduction.inputs()),
      outputs_(reduction.outputs()),
      begin_(reduction.first(0) - from_white.size() / 2),
      stride_(reduction.stride()),
      kernel_(Eigen::VectorXd::Zero(reduction.weights().size() + from_white.size() - 1)) {
  for (Eigen::Index w = 0; w < reduction.weights().size(); ++w)
    kernel_.segment(w, from_white.size()) += reduction.weights()[w] * from_white;
}

Eigen::MatrixXd EmgNoise::covariance(const Eigen::VectorXd& variance) const {
  const Eigen::Index width = kernel_.size();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(outputs_, outputs_);
  Eigen::VectorXd weighted(width);
  for (Eigen::Index j = 0; j < outputs_; ++j) {
    const Eigen::Index first = begin_ + j * stride_;
    for (Eigen::Index w = 0; w < width; ++w)
      weighted[w] = kernel_[w] * variance[std::clamp<Eigen::Index>(first + w, 0, inputs_ - 1)];
    // Row i > j begins (i - j) strides after row j.
    for (Eigen::Index i = j; i < outputs_ && (i - j) * stride_ < width; ++i) {
      const Eigen::Index both = width - (i - j) * stride_;
      a(i, j) = a(j, i) = kernel_.head(both).dot(weighted.tail(both));
    }
  }
  return a;
}

Eigen::VectorXd EmgNoise::pull_back(const Eigen::MatrixXd& by) const {
  const Eigen::Index width = kernel_.size();
  Eigen::VectorXd by_variance = Eigen::VectorXd::Zero(inputs_);
  for (Eigen::Index j = 0; j < outputs_; ++j) {
    Eigen::VectorXd sum = by(j, j) * kernel_;
    for (Eigen::Index i = j + 1; i < outputs_ && (i - j) * stride_ < width; ++i) {
      const Eigen::Index both = width - (i - j) * stride_;
      sum.tail(both) += 2.0 * by(i, j) * kernel_.head(both);
    }
    const Eigen::Index first = begin_ + j * stride_;
    for (Eigen::Index w = 0; w < width; ++w)
      by_variance[std::clamp<Eigen::Index>(first + w, 0, inputs_ - 1)] += kernel_[w] * sum[w];
  }
  return by_variance;
}

TorqueError torque_error(const Reduction& reduction, double interval_s, double log_time) {
  const Eigen::VectorXd& weights = reduction.weights();
  const Eigen::Index width = weights.size(), rows = reduction.outputs(), stride = reduction.stride();
  Eigen::VectorXd both(width);  // sum_w weight_w weight_{w + d}
  for (Eigen::Index d = 0; d < width; ++d) both[d] = weights.head(width - d).dot(weights.tail(width - d));
  const double over_time = interval_s * std::exp(-log_time);
  const Eigen::ArrayXd apart =
      over_time *
      Eigen::ArrayXd::LinSpaced((rows - 1) * stride + width, 0.0, static_cast<double>((rows - 1) * stride + width - 1));
  const Eigen::ArrayXd rho = (-apart).exp(), by_log = apart * rho;
  TorqueError result{Eigen::VectorXd(rows), Eigen::VectorXd(rows)};
  for (Eigen::Index j = 0; j < rows; ++j) {
    const Eigen::Index at = j * stride;
    double value = both[0] * rho[at], slope = both[0] * by_log[at];
    for (Eigen::Index d = 1; d < width; ++d) {
      const Eigen::Index before = std::abs(at - d), after = at + d;
      value += both[d] * (rho[before] + rho[after]);
      slope += both[d] * (by_log[before] + by_log[after]);
    }
    result.correlation[j] = value;
    result.by_log_time[j] = slope;
  }
  return result;
}

}  // namespace myoid::fit
