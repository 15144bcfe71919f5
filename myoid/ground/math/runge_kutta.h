#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "myoid/ground/math/ode.h"

namespace myoid::inline ground::math {

/// Returns the value of a scalar that carries derivatives in a member `v` (ceres::Jet).
inline double plain(double x) { return x; }
template <typename T>
requires requires(const T& x) { x.a; }
double plain(const T& x) { return plain(x.a); }

/// The explicit method of Dormand and Prince (1980), order 5 with an embedded order 4, for problems that are not stiff.
/// Within a step a continuously differentiable polynomial of order 4 interpolates. `T` is double or ceres::Jet; a Jet
/// carries derivatives exactly through the steps, whose sizes follow the values alone.
///
/// `rate(t, y, ydot)` writes dy/dt. It returns void, or a bool that is false where it cannot be
/// evaluated. Nothing is allocated after `start`.
template <typename T>
class RungeKutta {
 public:
  /// Throws InvalidInput if the options are not usable.
  RungeKutta(std::size_t state_count, OdeOptions options) : n_(state_count), options_(std::move(options)) {
    validate(options_, static_cast<long>(n_));
    for (auto* v : {&y_, &next_, &stage_}) v->assign(n_, T(0.0));
    for (auto& k : k_) k.assign(n_, T(0.0));
    for (auto& c : dense_) c.assign(n_, T(0.0));
  }

  /// Begins at y(t). Chooses the first step's size unless an earlier integration gives one.
  template <typename Rate>
  OdeStatus start(double time_s, std::span<const T> y, Rate&& rate) {
    time_ = previous_ = time_s;
    std::copy(y.begin(), y.end(), y_.begin());
    for (auto& c : dense_) std::fill(c.begin(), c.end(), T(0.0));
    dense_[0] = y_;
    error_before_ = 1e-4;
    if (!evaluate(rate, time_, y_, k_[0])) return OdeStatus::rate_failed;
    if (step_ == 0.0) step_ = options_.first_step_s > 0.0 ? options_.first_step_s : first_step();
    return OdeStatus::done;
  }

  /// Makes one accepted step, at most to `limit_s` (exactly to it, if it gets near).
  template <typename Rate>
  OdeStatus step(double limit_s, Rate&& rate) {
    bool rejected = false;
    while (true) {
      if (statistics_.steps + statistics_.rejected >= options_.max_steps) return OdeStatus::too_many_steps;
      double h = std::min(step_, options_.max_step_s);
      bool at_limit = false;
      if (time_ + 1.01 * h >= limit_s) {
        h = limit_s - time_;
        at_limit = true;
      }
      if (!(h > 1e-14 * std::max(1.0, std::abs(time_))) && !at_limit) return OdeStatus::step_too_small;
      const bool evaluated = stages(h, rate);
      const double error = evaluated ? error_norm(h) : std::numeric_limits<double>::infinity();
      if (!(error < 1.0)) {
        ++statistics_.rejected;
        step_ = h * (std::isfinite(error) ? std::max(0.2, 0.9 * std::pow(error, -0.2)) : 0.1);
        if (step_ < 1e-14 * std::max(1.0, std::abs(time_))) {
          return !evaluated             ? OdeStatus::rate_failed
                 : std::isfinite(error) ? OdeStatus::step_too_small
                                        : OdeStatus::not_finite;
        }
        rejected = true;
        continue;
      }
      const double least = std::max(error, 1e-8);
      double grow = 0.9 * std::pow(least, -0.17) * std::pow(error_before_, 0.04);
      grow = std::clamp(grow, 0.2, rejected ? 1.0 : 5.0);
      error_before_ = std::max(error, 1e-4);
      // A step cut short by the limit is no reason for shorter steps later.
      step_ = at_limit ? std::max(step_, h * grow) : h * grow;
      accept(h);
      if (at_limit) time_ = limit_s;
      ++statistics_.steps;
      return OdeStatus::done;
    }
  }

  /// Repeats the last step so that it ends at `time_s` within it: an event.
  template <typename Rate>
  OdeStatus shorten(double time_s, Rate&& rate) {
    const double h = time_s - previous_;
    y_ = dense_[0];
    time_ = previous_;
    if (!evaluate(rate, time_, y_, k_[0]) || !stages(h, rate)) return OdeStatus::rate_failed;
    accept(h);
    time_ = time_s;
    ++statistics_.events;
    return OdeStatus::done;
  }

  /// Restarts after a jump of the right-hand side at the present time.
  template <typename Rate>
  OdeStatus renew(Rate&& rate) {
    return evaluate(rate, time_, y_, k_[0]) ? OdeStatus::done : OdeStatus::rate_failed;
  }

  [[nodiscard]] double time_s() const { return time_; }
  [[nodiscard]] double previous_time_s() const { return previous_; }
  [[nodiscard]] std::span<const T> state() const { return y_; }
  [[nodiscard]] const OdeStatistics& statistics() const { return statistics_; }
  [[nodiscard]] std::size_t size() const { return n_; }

  /// Returns y at a time within the last step.
  void interpolate(double time_s, std::span<T> y) const {
    const double h = time_ - previous_;
    const double s = h > 0.0 ? (time_s - previous_) / h : 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      y[i] = dense_[0][i] +
             s * (dense_[1][i] + (1.0 - s) * (dense_[2][i] + s * (dense_[3][i] + (1.0 - s) * dense_[4][i])));
    }
  }

  /// Returns the same as a polynomial of s = time - previous_time_s(), increasing powers up to the fourth.
  [[nodiscard]] std::array<T, 5> polynomial(std::size_t i) const {
    const double h = time_ - previous_;
    const T& b = dense_[1][i];
    const T& c = dense_[2][i];
    const T& d = dense_[3][i];
    const T& e = dense_[4][i];
    const double h2 = h * h;
    return {dense_[0][i], (b + c) / h, (d - c + e) / h2, (-2.0 * e - d) / (h2 * h), e / (h2 * h2)};
  }

 private:
  template <typename Rate>
  bool evaluate(Rate& rate, double t, const std::vector<T>& y, std::vector<T>& ydot) {
    ++statistics_.rate_evaluations;
    if constexpr (std::is_same_v<decltype(rate(t, y.data(), ydot.data())), bool>) {
      return rate(t, y.data(), ydot.data());
    } else {
      rate(t, y.data(), ydot.data());
      return true;
    }
  }

  template <typename Rate>
  bool stages(double h, Rate& rate) {
    static constexpr double kNode[] = {0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0};
    static constexpr double kWeight[7][6] = {
        {},
        {1.0 / 5.0},
        {3.0 / 40.0, 9.0 / 40.0},
        {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0},
        {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
        {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0},
        {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0}};
    for (std::size_t s = 1; s < 7; ++s) {
      std::vector<T>& target = s == 6 ? next_ : stage_;
      for (std::size_t i = 0; i < n_; ++i) {
        T sum = k_[0][i] * kWeight[s][0];
        for (std::size_t j = 1; j < s; ++j) sum += k_[j][i] * kWeight[s][j];
        target[i] = y_[i] + h * sum;
      }
      if (!evaluate(rate, time_ + kNode[s] * h, target, k_[s])) return false;
    }
    return true;
  }

  double error_norm(double h) const {
    static constexpr double kError[] = {71.0 / 57600.0,      0.0,          -71.0 / 16695.0, 71.0 / 1920.0,
                                        -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0};
    double sum = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      double e = 0.0;
      for (std::size_t s = 0; s < 7; ++s) e += kError[s] * plain(k_[s][i]);
      const double scale =
          tolerance(i) + options_.relative_tolerance * std::max(std::abs(plain(y_[i])), std::abs(plain(next_[i])));
      sum += (h * e / scale) * (h * e / scale);
    }
    return std::sqrt(sum / static_cast<double>(n_));
  }

  double tolerance(std::size_t i) const {
    return options_.absolute_tolerances.empty() ? options_.absolute_tolerance : options_.absolute_tolerances[i];
  }

  void accept(double h) {
    static constexpr double kDense[] = {-12715105075.0 / 11282082432.0,  0.0,
                                        87487479700.0 / 32700410799.0,   -10690763975.0 / 1880347072.0,
                                        701980252875.0 / 199316789632.0, -1453857185.0 / 822651844.0,
                                        69997945.0 / 29380423.0};
    for (std::size_t i = 0; i < n_; ++i) {
      const T difference = next_[i] - y_[i];
      const T bend = h * k_[0][i] - difference;
      T last = k_[0][i] * kDense[0];
      for (std::size_t s = 2; s < 7; ++s) last += k_[s][i] * kDense[s];
      dense_[0][i] = y_[i];
      dense_[1][i] = difference;
      dense_[2][i] = bend;
      dense_[3][i] = difference - h * k_[6][i] - bend;
      dense_[4][i] = h * last;
    }
    std::swap(y_, next_);
    std::swap(k_[0], k_[6]);
    previous_ = time_;
    time_ += h;
  }

  /// Returns a first step after Hairer, Norsett & Wanner: so small that the first two terms of the series agree.
  double first_step() const {
    double y_norm = 0.0;
    double rate_norm = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      const double scale = tolerance(i) + options_.relative_tolerance * std::abs(plain(y_[i]));
      y_norm += std::pow(plain(y_[i]) / scale, 2);
      rate_norm += std::pow(plain(k_[0][i]) / scale, 2);
    }
    const double h = y_norm > 1e-10 && rate_norm > 1e-10 ? 0.01 * std::sqrt(y_norm / rate_norm) : 1e-6;
    return std::min(h, 1e-3);
  }

  std::size_t n_;
  OdeOptions options_;
  OdeStatistics statistics_;
  double time_ = 0.0, previous_ = 0.0, step_ = 0.0, error_before_ = 1e-4;
  std::vector<T> y_, next_, stage_;
  std::array<std::vector<T>, 7> k_;
  std::array<std::vector<T>, 5> dense_;
};

}  // namespace myoid::inline ground::math
