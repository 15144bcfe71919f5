#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/parameters.h"

namespace myoid::fit {

/// The envelope of one EMG channel of one trial, which can be read at any delay: quintic polynomials between the
/// samples, twice continuously differentiable. An even clock finds its interval by a division. For an envelope below 6
/// Hz at 100 Hz or more the error is below 1e-7 of its amplitude.
class Envelope {
 public:
  /// Builds the polynomials. `apart` is the number of samples between successive reads. Intervals that are read one
  /// after the other lie next to each other in memory, whose access takes most of the time.
  Envelope(const Eigen::VectorXd& time_s, const Eigen::VectorXd& values, Eigen::Index apart = 1);

  struct Value {
    double value = 0.0;
    double slope = 0.0;  ///< d/dt
  };
  /// Returns value and slope at `time_s`: never negative, and the end value beyond the ends.
  [[nodiscard]] Value at(double time_s) const;
  /// Returns the values at time_s - delay_s, n.
  [[nodiscard]] std::vector<Value> at(const Eigen::Ref<const Eigen::VectorXd>& time_s, double delay_s) const;

  /// Returns the envelope of the samples from `first_s` to `last_s` alone, four of them at least.
  [[nodiscard]] Envelope within(double first_s, double last_s) const;

  [[nodiscard]] double first_s() const { return time_s_[0]; }
  [[nodiscard]] double last_s() const { return time_s_[time_s_.size() - 1]; }
  [[nodiscard]] const Eigen::VectorXd& time_s() const { return time_s_; }
  [[nodiscard]] const Eigen::VectorXd& samples() const { return samples_; }

 private:
  /// One interval between samples: the polynomial in powers of (t - left_s).
  struct Piece {
    std::array<double, 6> power{};
    double left_s = 0.0, right_s = 0.0;
  };
  [[nodiscard]] std::size_t place(Eigen::Index interval) const {
    const auto i = static_cast<std::uint32_t>(interval);
    return std::size_t{i % apart_} * row_ + i / apart_;
  }
  [[nodiscard]] const Piece& piece_at(double time_s) const;

  Eigen::VectorXd time_s_, samples_;
  std::uint32_t apart_ = 1;
  std::size_t row_ = 0;        ///< Length of a row: number of intervals that are `apart` from the next.
  std::vector<Piece> pieces_;  ///< Row by row.
  double rate_hz_ = 0.0;       ///< Rate of an even clock; 0: uneven.
};

/// Returns the time constants of the two lags that a channel's envelope passes (0: no lag); the
/// activation's is the mean of rise and fall.
[[nodiscard]] std::array<double, 2> lag_times_s(const ChannelValues& channel, EmgLag lag);

/// Activation at one instant, before the factor activation_share of the muscle, with derivatives.
struct Activation {
  double value = 0.0;
  double by_log_envelope = 0.0;  ///< Change by a relative error of the envelope.
  std::array<double, kChannelFieldCount> by_field{};
};

/// Returns the activation of a channel at `time_s` (n): a(t) = shape(g env(t - d)^p). With `EmgLag::shared` and
/// `EmgLag::equation_1` the envelope first passes the two lags of equation (1),
///
///   de/dt = (u - e) / tau_ne,   da/dt = (e - a) / (tau_ac if e >= a, tau_deac if e < a),
///
/// integrated exactly for an input that is constant between the samples of the envelope. With
/// `EmgLag::shared` the time constants and the remaining delay are shares of the channel's d.
[[nodiscard]] std::vector<Activation> activation(const Envelope& envelope,
                                                 const Eigen::Ref<const Eigen::VectorXd>& time_s,
                                                 const ChannelValues& channel,
                                                 EmgLag lag);

/// Returns the activation without lags, from the envelope env(t - d) at the instants.
[[nodiscard]] std::vector<Activation> activation(const std::vector<Envelope::Value>& delayed,
                                                 const ChannelValues& channel);

}  // namespace myoid::fit
