#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "myoid/body/simulation/excitation.h"
#include "myoid/ground/math/ode_events.h"
#include "myoid/ground/math/runge_kutta.h"
#include "myoid/muscle/activation.h"

namespace myoid::body {

/// The activation that follows an excitation, as a piecewise polynomial of time. Activation does not depend on the
/// motion, so that its equations can be solved beforehand. The excitation u is linear between its nodes; steps end at
/// the nodes and at the law's kinks; the local error is below `kActivationTolerance`. The signal is continuous, and so
/// is its first derivative where u does not jump.
class ActivationSignal {
 public:
  /// Begins at `start_s` with this state; `extend` continues it.
  ActivationSignal(const muscle::ActivationDynamics<double>& dynamics,
                   double start_s,
                   const muscle::ActivationPoint<double>& state)
      : dynamics_(dynamics), stepper_(2, options()), signs_(1), end_(start_s), state_(state) {}

  /// Solves all times of `excitation`; begins in the steady state of its first value unless a state is given.
  ActivationSignal(const muscle::ActivationDynamics<double>& dynamics,
                   const Signal& excitation,
                   double start_s,
                   double end_s)
      : ActivationSignal(dynamics, start_s, muscle::settled_activation(value_at(excitation, start_s))) {
    extend(excitation, end_s);
  }

  /// Continues to `end_s` under the excitation's part of that time.
  void extend(const Signal& excitation, double end_s) {
    const auto& t = excitation.time_s;
    std::size_t next = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), end_) - t.begin());
    double from = value_at(excitation, end_);
    while (end_ < end_s) {
      const bool inside = next < t.size() && t[next] < end_s;
      const double until = inside ? t[next] : end_s;
      // The value to the left of a jump.
      const double to = inside ? excitation.value[next] : value_left_of(excitation, until);
      extend(until, from, to);
      if (inside) {
        while (next + 1 < t.size() && t[next + 1] == t[next]) ++next;
        from = excitation.value[next];
        ++next;
      }
    }
  }

  /// Continues to `end_s` under an excitation that goes linearly from `from` to `to`.
  void extend(double end_s, double from, double to) {
    if (!(end_s > end_)) return;
    const double begin = end_;
    if (end_s - begin < 1e-12) {  // the nodes differ by round-off
      end_ = end_s;
      return;
    }
    const double slope = (to - from) / (end_s - begin);
    if (dynamics_.law == muscle::ActivationLaw::envelope) {
      start_.push_back(begin);
      piece_.push_back({from, slope, 0.0, 0.0, 0.0});
      state_ = {to, to};
      end_ = end_s;
      return;
    }
    const auto excitation = [&](double t) { return from + slope * (t - begin); };
    const auto rate = [&](double t, const double* y, double* ydot) {
      const auto d = muscle::activation_rate(dynamics_, excitation(t), {y[0], y[1]});
      ydot[0] = d.filtered_excitation;
      ydot[1] = d.activation;
    };
    const auto events = [&](double t, const double* y, double* g) {
      g[0] = muscle::activation_event(dynamics_, excitation(t), {y[0], y[1]});
    };
    const std::array<double, 2> y{state_.filtered_excitation, state_.activation};
    double g = 0.0;
    events(begin, y.data(), &g);
    signs_.start({&g, 1});
    status_ = stepper_.start(begin, y, rate);
    if (status_ == math::OdeStatus::done) {
      const auto keep = [&](const auto& s) {
        start_.push_back(s.previous_time_s());
        piece_.push_back(s.polynomial(1));
        return true;
      };
      status_ = math::integrate(stepper_, end_s, signs_, events, keep, rate);
    }
    state_ = {stepper_.state()[0], stepper_.state()[1]};
    end_ = end_s;
  }

  /// Returns the activation at this time; constant before the beginning and after the end. `hint`
  /// remembers the piece for increasing times; each user has its own, 0 at first.
  [[nodiscard]] double at(double time_s, std::size_t& hint) const {
    if (piece_.empty() || time_s >= end_) return state_.activation;
    if (time_s <= start_.front()) return piece_.front()[0];
    if (hint >= piece_.size()) hint = 0;
    const bool here = start_[hint] <= time_s && (hint + 1 == start_.size() || time_s < start_[hint + 1]);
    if (!here) {
      if (hint + 2 < start_.size() && start_[hint + 1] <= time_s && time_s < start_[hint + 2]) {
        ++hint;
      } else {
        hint = static_cast<std::size_t>(std::upper_bound(start_.begin(), start_.end(), time_s) - start_.begin()) - 1;
      }
    }
    const double s = time_s - start_[hint];
    const std::array<double, 5>& c = piece_[hint];
    return c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * c[4])));
  }

  [[nodiscard]] double end_s() const { return end_; }
  [[nodiscard]] const muscle::ActivationPoint<double>& state() const { return state_; }  ///< The state at the end.
  /// Returns the status. Unless it is `done`, the times contradict the law and the signal is unusable.
  [[nodiscard]] math::OdeStatus status() const { return status_; }

 private:
  static double value_left_of(const Signal& excitation, double time_s) {
    const auto& t = excitation.time_s;
    const auto at = static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), time_s) - t.begin());
    return at < t.size() && t[at] == time_s ? excitation.value[at] : value_at(excitation, time_s);
  }
  static math::OdeOptions options() {
    math::OdeOptions o;
    o.relative_tolerance = kActivationTolerance;
    o.absolute_tolerance = kActivationTolerance;
    return o;
  }

  static constexpr double kActivationTolerance = 1e-10;

  muscle::ActivationDynamics<double> dynamics_;
  math::RungeKutta<double> stepper_;
  math::EventSigns signs_;
  double end_ = 0.0;
  muscle::ActivationPoint<double> state_;
  math::OdeStatus status_ = math::OdeStatus::done;
  std::vector<double> start_;
  std::vector<std::array<double, 5>> piece_;
};

}  // namespace myoid::body
