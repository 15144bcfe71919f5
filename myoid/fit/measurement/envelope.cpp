#include "myoid/fit/measurement/envelope.h"

#include <algorithm>
#include <cmath>

#include "myoid/ground/math/spline.h"

namespace myoid::fit {
namespace {

/// The lags' output at the samples of the envelope, and its derivatives along D directions in the
/// space of the three time constants.
template <int D>
struct Lagged {
  Eigen::VectorXd value, slope;
  Eigen::Matrix<double, D, Eigen::Dynamic> by, slope_by;
};

/// Runs the envelope through the lags. `directions` is D x 3, by excitation, activation and deactivation time.
template <int D>
Lagged<D> lagged(const Envelope& envelope, const ChannelValues& c, const Eigen::Matrix<double, D, 3>& directions) {
  using Slopes = Eigen::Matrix<double, D, 1>;
  const Eigen::VectorXd& t = envelope.time_s();
  const Eigen::VectorXd& u = envelope.samples();
  Lagged<D> r{Eigen::VectorXd(t.size()), Eigen::VectorXd(t.size()),
              Eigen::Matrix<double, D, Eigen::Dynamic>(D, t.size()),
              Eigen::Matrix<double, D, Eigen::Dynamic>(D, t.size())};
  double e = u[0], a = u[0];
  double e_ne = 0.0;
  const Slopes by_excitation = directions.col(0);
  Slopes a_by = Slopes::Zero();
  // Keeps the factor of a step of h, because most clocks have one h.
  double h = 0.0, keep_e = 0.0, by_keep_e = 0.0;
  struct Branch {
    double per_tau = 0.0, keep = 0.0;
    Slopes direction = Slopes::Zero();
  };
  Branch rise{.per_tau = 1.0 / c[kActivationTime], .direction = directions.col(1)};
  Branch fall{.per_tau = 1.0 / c[kDeactivationTime], .direction = directions.col(2)};
  const double per_tau_ne = 1.0 / c[kExcitationTime];
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    if (i > 0) {
      const double step = t[i] - t[i - 1];
      if (std::abs(step - h) > 1e-9 * step) {
        h = step;
        keep_e = std::exp(-h * per_tau_ne);
        by_keep_e = h * per_tau_ne * per_tau_ne;
        rise.keep = std::exp(-h * rise.per_tau);
        fall.keep = std::exp(-h * fall.per_tau);
      }
      const double input = 0.5 * (u[i - 1] + u[i]);
      // The mean of e over the interval drives a.
      const double e_before = e, e_ne_before = e_ne;
      e = input + keep_e * (e_before - input);
      e_ne = keep_e * (e_ne_before + (e_before - input) * by_keep_e);
      const double middle = 0.5 * (e + e_before);
      const double middle_ne = 0.5 * (e_ne + e_ne_before);
      const Branch& branch = middle >= a ? rise : fall;
      const double gap = a - middle;
      a = middle + branch.keep * gap;
      a_by = branch.keep * a_by + ((1.0 - branch.keep) * middle_ne) * by_excitation +
             (branch.keep * gap * h * branch.per_tau * branch.per_tau) * branch.direction;
    }
    r.value[i] = a;
    const Branch& branch = e >= a ? rise : fall;
    r.slope[i] = (e - a) * branch.per_tau;
    r.by.col(i) = a_by;
    r.slope_by.col(i) = (e_ne * by_excitation - a_by - r.slope[i] * branch.direction) * branch.per_tau;
  }
  return r;
}

/// Cubic through values and slopes at both ends of an interval of length h, at its share x.
struct Cubic {
  double value = 0.0, slope = 0.0;
};
Cubic between(double y0, double y1, double slope0, double slope1, double h, double x) {
  const double d0 = h * slope0, d1 = h * slope1;
  const double c2 = 3.0 * (y1 - y0) - 2.0 * d0 - d1;
  const double c3 = d0 + d1 - 2.0 * (y1 - y0);
  return {y0 + x * (d0 + x * (c2 + x * c3)), (d0 + x * (2.0 * c2 + x * 3.0 * c3)) / h};
}

/// The envelope at one instant for activation(), with D directions as in Lagged.
template <int D>
struct Read {
  double value = 0.0, slope = 0.0;
  Eigen::Matrix<double, D, 1> by = Eigen::Matrix<double, D, 1>::Zero();
};

/// Reads the output of the lags at rising times; beyond the ends it returns the end values.
template <int D>
class LaggedReader {
 public:
  LaggedReader(const Envelope& envelope, const ChannelValues& channel, const Eigen::Matrix<double, D, 3>& directions)
      : time_s_(envelope.time_s()), lagged_(lagged<D>(envelope, channel, directions)) {}

  [[nodiscard]] Read<D> at(double time_s) {
    const Eigen::Index n = time_s_.size();
    const double inside = std::clamp(time_s, time_s_[0], time_s_[n - 1]);
    if (inside < time_s_[at_]) at_ = 0;
    while (at_ + 2 < n && time_s_[at_ + 1] <= inside) ++at_;
    const double h = time_s_[at_ + 1] - time_s_[at_];
    const double x = (inside - time_s_[at_]) / h;
    const Cubic cubic =
        between(lagged_.value[at_], lagged_.value[at_ + 1], lagged_.slope[at_], lagged_.slope[at_ + 1], h, x);
    Read<D> r{.value = std::max(0.0, cubic.value), .slope = inside == time_s ? cubic.slope : 0.0};
    const double rise = x * x * (3.0 - 2.0 * x);
    r.by = (1.0 - rise) * lagged_.by.col(at_) + rise * lagged_.by.col(at_ + 1) +
           h * x * (1.0 - x) * ((1.0 - x) * lagged_.slope_by.col(at_) - x * lagged_.slope_by.col(at_ + 1));
    return r;
  }

 private:
  const Eigen::VectorXd& time_s_;
  Lagged<D> lagged_;
  Eigen::Index at_ = 0;
};

/// Returns the channel with the remaining delay and the time constants into which d is divided. A
/// time constant is at least 0.1 ms, because the lags divide by it.
ChannelValues shared(const ChannelValues& c) {
  constexpr LagShares kShare;
  constexpr double kLeast_s = 1e-4;
  ChannelValues result = c;
  result[kDelay] = kShare.pure * c[kDelay];
  result[kExcitationTime] = std::max(kLeast_s, kShare.excitation * c[kDelay]);
  result[kActivationTime] = std::max(kLeast_s, kShare.activation * c[kDelay]);
  result[kDeactivationTime] = std::max(kLeast_s, kShare.deactivation * c[kDelay]);
  return result;
}

/// Computes (exp(A u) - 1) / (exp(A) - 1) and its slopes in u and in A.
void shape(double u, double A, double& value, double& by_u, double& by_a) {
  if (std::abs(A) < 1e-4) {
    value = u + 0.5 * A * u * (u - 1.0);
    by_u = 1.0 + A * (u - 0.5);
    by_a = 0.5 * u * (u - 1.0);
    return;
  }
  const double below = std::expm1(A);
  const double above = std::expm1(A * u);
  value = above / below;
  by_u = A * (above + 1.0) / below;
  by_a = (u * (above + 1.0) * below - above * (below + 1.0)) / (below * below);
}

/// Computes u^p and its slopes in u and in p. Below 1e-4 of the maximum a
/// straight line replaces u^p, whose slope is unbounded where p < 1.
void power(double u, double p, double& value, double& by_u, double& by_p) {
  constexpr double kLeast = 1e-4;
  const double log_u = std::log(std::max(u, kLeast));
  const double ratio = p == 1.0 ? 1.0 : std::exp((p - 1.0) * log_u);
  value = u * ratio;
  by_u = u > kLeast ? p * ratio : ratio;
  by_p = value * log_u;
}

/// Returns slopes and curvatures at the samples, n x 2. An even clock takes them from nine samples
/// each (exact for polynomials of degree 8), an uneven clock and the ends from the quintic spline.
Eigen::MatrixXd rates(const Eigen::VectorXd& time_s, const Eigen::VectorXd& y, bool even) {
  const Eigen::Index n = time_s.size();
  constexpr Eigen::Index kEnd = 12;   // samples at each end that a spline gives
  constexpr Eigen::Index kLong = 40;  // samples of the spline at each end
  Eigen::MatrixXd result(n, 2);
  const auto by_spline = [&](Eigen::Index first, Eigen::Index count, Eigen::Index from, Eigen::Index to) {
    const auto knots = time_s.segment(first, count);
    const math::SplineValues v = math::Spline::interpolate(knots, y.segment(first, count), count >= 4 ? 5 : 1)
                                     .evaluate(time_s.segment(from, to - from));
    result.col(0).segment(from, to - from) = v.first;
    result.col(1).segment(from, to - from) = v.second;
  };
  if (!even || n < 2 * kLong) {
    by_spline(0, n, 0, n);
    return result;
  }
  by_spline(0, kLong, 0, kEnd);
  by_spline(n - kLong, kLong, n - kEnd, n);
  const double rate = static_cast<double>(n - 1) / (time_s[n - 1] - time_s[0]);
  for (Eigen::Index i = kEnd; i < n - kEnd; ++i) {
    const double* x = y.data() + i;
    result(i, 0) = rate * (4.0 / 5.0 * (x[1] - x[-1]) - 1.0 / 5.0 * (x[2] - x[-2]) + 4.0 / 105.0 * (x[3] - x[-3]) -
                           1.0 / 280.0 * (x[4] - x[-4]));
    result(i, 1) = rate * rate *
                   (-205.0 / 72.0 * x[0] + 8.0 / 5.0 * (x[1] + x[-1]) - 1.0 / 5.0 * (x[2] + x[-2]) +
                    8.0 / 315.0 * (x[3] + x[-3]) - 1.0 / 560.0 * (x[4] + x[-4]));
  }
  return result;
}

}  // namespace

Envelope Envelope::within(double first_s, double last_s) const {
  constexpr std::ptrdiff_t kFewest = 4;
  const auto begin = std::max(time_s_.begin(), std::lower_bound(time_s_.begin(), time_s_.end(), first_s) - 1);
  const auto end = std::min(time_s_.end(), std::upper_bound(begin, time_s_.end(), last_s) + 1);
  if (end - begin == time_s_.size() || end - begin < kFewest) return *this;
  const auto rows = Eigen::seqN(begin - time_s_.begin(), end - begin);
  return {time_s_(rows), samples_(rows), apart_};
}

Envelope::Envelope(const Eigen::VectorXd& time_s, const Eigen::VectorXd& values, Eigen::Index apart)
    : time_s_(time_s),
      samples_(values),
      apart_(static_cast<std::uint32_t>(std::clamp<Eigen::Index>(apart, 1, time_s.size()))) {
  const Eigen::Index n = time_s.size();
  const double step = (time_s[n - 1] - time_s[0]) / static_cast<double>(n - 1);
  bool even = true;
  for (Eigen::Index i = 1; i < n && even; ++i)
    even = std::abs(time_s[i] - time_s[0] - step * static_cast<double>(i)) < 1e-4 * step;
  rate_hz_ = even ? 1.0 / step : 0.0;
  const Eigen::MatrixXd rate = rates(time_s, values, even);
  row_ = (static_cast<std::size_t>(n) + apart_ - 1) / apart_;
  pieces_.resize(row_ * apart_);
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    // The quintic with these values, slopes and curvatures at both ends.
    const double h = time_s[i + 1] - time_s[i];
    const double y0 = values[i], y1 = values[i + 1];
    const double d0 = h * rate(i, 0), d1 = h * rate(i + 1, 0);
    const double c0 = 0.5 * h * h * rate(i, 1), c1 = 0.5 * h * h * rate(i + 1, 1);
    const double dy = y1 - y0 - d0 - c0;
    const double dd = d1 - d0 - 2.0 * c0;
    const double dc = c1 - c0;
    const double b3 = 10.0 * dy - 4.0 * dd + dc;
    const double b4 = -15.0 * dy + 7.0 * dd - 2.0 * dc;
    const double b5 = 6.0 * dy - 3.0 * dd + dc;
    const double r = 1.0 / h;
    pieces_[place(i)] = {.power = {y0, d0 * r, c0 * r * r, b3 * r * r * r, b4 * r * r * r * r, b5 * r * r * r * r * r},
                         .left_s = time_s[i],
                         .right_s = time_s[i + 1]};
  }
}

const Envelope::Piece& Envelope::piece_at(double time_s) const {
  const Eigen::Index n = time_s_.size();
  if (!(rate_hz_ > 0.0)) {
    const double* after = std::upper_bound(time_s_.data(), time_s_.data() + n, time_s);
    return pieces_[place(after - time_s_.data() - 1)];
  }
  const auto i = std::clamp<Eigen::Index>(static_cast<Eigen::Index>((time_s - time_s_[0]) * rate_hz_), 0, n - 2);
  // Round-off, and a clock that is even only to 1e-4, may put time_s into the next interval.
  const Piece& piece = pieces_[place(i)];
  if (time_s < piece.left_s && i > 0) return pieces_[place(i - 1)];
  if (time_s >= piece.right_s && i + 2 < n) return pieces_[place(i + 1)];
  return piece;
}

Envelope::Value Envelope::at(double time_s) const {
  const Eigen::Index n = time_s_.size();
  if (time_s <= time_s_[0]) return {std::max(0.0, samples_[0]), 0.0};
  if (time_s >= time_s_[n - 1]) return {std::max(0.0, samples_[n - 1]), 0.0};
  const Piece& piece = piece_at(time_s);
  const double x = time_s - piece.left_s;
  const std::array<double, 6>& c = piece.power;
  const double value = c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5]))));
  if (value < 0.0) return {};
  return {value, c[1] + x * (2.0 * c[2] + x * (3.0 * c[3] + x * (4.0 * c[4] + x * 5.0 * c[5])))};
}

std::vector<Envelope::Value> Envelope::at(const Eigen::Ref<const Eigen::VectorXd>& time_s, double delay_s) const {
  std::vector<Value> values;
  values.reserve(static_cast<std::size_t>(time_s.size()));
  for (const double t : time_s) values.push_back(at(t - delay_s));
  return values;
}

std::array<double, 2> lag_times_s(const ChannelValues& channel, EmgLag lag) {
  if (lag == EmgLag::delay) return {};
  const ChannelValues c = lag == EmgLag::shared ? shared(channel) : channel;
  return {c[kExcitationTime], 0.5 * (c[kActivationTime] + c[kDeactivationTime])};
}

namespace {

/// Fills the activation and all derivatives except by the lags from the delayed and lagged
/// envelope; returns d activation / d envelope.
inline double fill(Activation& a, double value, double slope, const ChannelValues& c) {
  double raised = value, by_value = 1.0, by_exponent = 0.0;
  power(value, c[kExponent], raised, by_value, by_exponent);
  const double u = c[kGain] * raised;
  double by_u = 1.0, by_shape = 0.5 * u * (u - 1.0);
  a.value = u;
  if (c[kShape] != 0.0) shape(u, c[kShape], a.value, by_u, by_shape);
  const double by_envelope = by_u * c[kGain] * by_value;
  a.by_log_envelope = by_envelope * value;
  a.by_field[kDelay] = -by_envelope * slope;
  a.by_field[kGain] = by_u * raised;
  a.by_field[kExponent] = by_u * c[kGain] * by_exponent;
  a.by_field[kShape] = by_shape;
  return by_envelope;
}

}  // namespace

std::vector<Activation> activation(const Envelope& envelope,
                                   const Eigen::Ref<const Eigen::VectorXd>& time_s,
                                   const ChannelValues& channel,
                                   EmgLag lag) {
  if (lag == EmgLag::delay) return activation(envelope.at(time_s, channel[kDelay]), channel);
  std::vector<Activation> result(static_cast<std::size_t>(time_s.size()));
  std::size_t i = 0;
  if (lag == EmgLag::shared) {
    constexpr LagShares kShare;
    const ChannelValues c = shared(channel);
    LaggedReader<1> reader(envelope, c, Eigen::RowVector3d(kShare.excitation, kShare.activation, kShare.deactivation));
    for (const double t : time_s) {
      const Read<1> r = reader.at(t - c[kDelay]);
      Activation& a = result[i++];
      const double by_envelope = fill(a, r.value, r.slope, c);
      a.by_field[kDelay] = kShare.pure * a.by_field[kDelay] + by_envelope * r.by[0];
    }
  } else {
    LaggedReader<3> reader(envelope, channel, Eigen::Matrix3d::Identity());
    for (const double t : time_s) {
      const Read<3> r = reader.at(t - channel[kDelay]);
      Activation& a = result[i++];
      const double by_envelope = fill(a, r.value, r.slope, channel);
      for (int k = 0; k < 3; ++k) a.by_field[static_cast<std::size_t>(kExcitationTime + k)] = by_envelope * r.by[k];
    }
  }
  return result;
}

std::vector<Activation> activation(const std::vector<Envelope::Value>& delayed, const ChannelValues& channel) {
  std::vector<Activation> result(delayed.size());
  for (std::size_t i = 0; i < delayed.size(); ++i) fill(result[i], delayed[i].value, delayed[i].slope, channel);
  return result;
}

}  // namespace myoid::fit
