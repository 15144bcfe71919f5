#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <type_traits>
#include <vector>

#include "myoid/ground/math/ode.h"

namespace myoid::inline ground::math {

/// Finds sign changes of `events`, so that no step crosses a kink of the right-hand side. A quantity has changed once
/// it is beyond zero by more than `kEventDeadband`; it has no sign until it first leaves zero.
inline constexpr double kEventDeadband = 1e-10;
class EventSigns {
 public:
  explicit EventSigns(std::size_t count) : sign_(count, 0) {}
  [[nodiscard]] std::size_t size() const { return sign_.size(); }

  void start(std::span<const double> g) {
    std::fill(sign_.begin(), sign_.end(), 0);
    learn(g);
  }
  /// Returns true if a quantity is on the other side of zero.
  [[nodiscard]] bool crossed(std::span<const double> g) const {
    for (std::size_t i = 0; i < sign_.size(); ++i) {
      if (g[i] * sign_[i] < -kEventDeadband) return true;
    }
    return false;
  }
  /// Takes the signs of all quantities clearly off zero.
  void learn(std::span<const double> g) {
    for (std::size_t i = 0; i < sign_.size(); ++i) {
      if (std::abs(g[i]) > kEventDeadband) sign_[i] = g[i] > 0.0 ? 1 : -1;
    }
  }
  /// Passes a crossing: the quantity gets its new sign, and quantities at zero have none until they leave it.
  void pass(std::span<const double> g) {
    for (std::size_t i = 0; i < sign_.size(); ++i) {
      if (g[i] * sign_[i] < -kEventDeadband) {
        sign_[i] = -sign_[i];
      } else if (std::abs(g[i]) < 1e3 * kEventDeadband) {
        sign_[i] = 0;
      }
    }
  }

 private:
  std::vector<int> sign_;
};

/// Integrates to `end_s`, through located events. `events(t, y, g)` writes the quantities that
/// change sign at kinks; `on_step(stepper)` receives every step and ends the integration by
/// returning false. `rate` is passed on to steppers that need it: `integrate(stepper, ..., rate)`.
template <typename Stepper, typename Events, typename OnStep, typename... Rate>
OdeStatus integrate(
    Stepper& stepper, double end_s, EventSigns& signs, Events&& events, OnStep&& on_step, Rate&... rate) {
  using T = std::remove_cvref_t<decltype(stepper.state()[0])>;
  std::vector<double> g(signs.size());
  std::vector<T> y(signs.size() > 0 ? stepper.size() : 0);
  while (stepper.time_s() < end_s) {
    if (const OdeStatus status = stepper.step(end_s, rate...); status != OdeStatus::done) return status;
    if (signs.size() > 0) {
      events(stepper.time_s(), stepper.state().data(), g.data());
      if (signs.crossed(g)) {
        double low = stepper.previous_time_s();
        double high = stepper.time_s();
        for (int i = 0; i < 60 && high - low > 1e-13 * std::max(1.0, high); ++i) {
          const double middle = 0.5 * (low + high);
          stepper.interpolate(middle, y);
          events(middle, y.data(), g.data());
          (signs.crossed(g) ? high : low) = middle;
        }
        // A repeated step ends slightly before or after the kink; either is accepted.
        stepper.interpolate(high, y);
        events(high, y.data(), g.data());
        signs.pass(g);
        if (high < stepper.time_s()) {
          if (const OdeStatus status = stepper.shorten(high, rate...); status != OdeStatus::done) return status;
        }
      } else {
        signs.learn(g);
      }
    }
    if (!on_step(stepper)) return OdeStatus::stopped;
  }
  return OdeStatus::done;
}

}  // namespace myoid::inline ground::math
