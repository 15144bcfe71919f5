#include "myoid/body/simulation/forward_simulation.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "myoid/body/simulation/moving_model.h"
#include "myoid/body/simulation/simulation_run.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/math/ode_events.h"
#include "myoid/ground/math/runge_kutta.h"
#include "myoid/ground/math/stiff_ode.h"

namespace myoid::body {
namespace {

/// One running simulation.
class Run {
 public:
  Run(const SimulationModel& model,
      const SimulationInput& input,
      const SimulationStart& start,
      const SimulationOptions& options)
      : model_(model, input, start, options),
        options_(options),
        times_(output_times(start, options)),
        now_(start.time_s),
        y_(model_.start_state()),
        work_(model_.work_count(), 0.0),
        breaks_(break_times(input, now_, options)),
        record_(model_.make_record(times_.size())) {}

  Simulation go() {
    result_.status = model_.all_rigid() ? go_explicit() : go_implicit();
    if (options_.progress.stop.stop_requested()) throw Interrupted();
    return finish();
  }

 private:
  static constexpr long kMostJumps = 200;

  /// Goes on to the next time up to which inputs are smooth.
  void go_to_next_limit() {
    limit_ = *std::upper_bound(breaks_.begin(), breaks_.end(), now_);
    model_.begin_stretch(limit_);
  }

  /// Records the rows of the result within the last step; `sample(t)` fills y_ and work_.
  template <typename Sample>
  bool emit(double until, Sample&& sample) {
    while (row_ < times_.size() && times_[row_] <= until) {
      sample(times_[row_]);
      model_.record(times_[row_], y_.data(), work_.data(), static_cast<Eigen::Index>(row_), record_);
      ++row_;
    }
    result_.reached_s = until;
    if (++calls_ % 256 == 0)
      options_.progress.tell((until - times_.front()) / (options_.end_s - times_.front()), "simulating");
    return !options_.progress.stop.stop_requested();
  }

  math::OdeStatus go_explicit() {
    const std::size_t states = model_.state_count();
    const std::size_t total = states + model_.work_count();
    math::OdeOptions ode = options_.ode;
    if (!ode.absolute_tolerances.empty()) ode.absolute_tolerances.resize(total, ode.absolute_tolerance);
    math::RungeKutta<double> stepper(total, ode);
    const auto f = [&](double t, const double* y, double* ydot) {
      model_.rate(t, y, ydot);
      if (total > states) model_.powers(t, y, ydot + states);
    };
    std::vector<double> y = y_;
    y.resize(total, 0.0);
    std::vector<double> at = y;
    const auto on_step = [&](const math::RungeKutta<double>& s) {
      return emit(s.time_s(), [&](double t) {
        s.interpolate(t, at);
        std::copy_n(at.begin(), states, y_.begin());
        std::copy(at.begin() + static_cast<std::ptrdiff_t>(states), at.end(), work_.begin());
      });
    };
    return drive(stepper, std::move(y), on_step, f);
  }

  math::OdeStatus go_implicit() {
    math::StiffProblem problem;
    problem.state_count = model_.state_count();
    problem.rate = [this](double t, const double* y, double* ydot) {
      model_.rate(t, y, ydot);
      return true;
    };
    problem.quadrature_count = model_.work_count();
    problem.quadrature = [this](double t, const double* y, double* p) {
      model_.powers(t, y, p);
      return true;
    };
    math::StiffIntegrator stepper(std::move(problem), options_.ode);
    const auto on_step = [&](const math::StiffIntegrator& s) {
      return emit(s.time_s(), [&](double t) {
        const double known = std::max(t, s.previous_time_s());  // t may be within a hop
        s.interpolate(known, y_);
        if (!work_.empty()) s.interpolate_quadrature(known, work_);
      });
    };
    return drive(stepper, y_, on_step);
  }

  template <typename Stepper, typename OnStep, typename... Rate>
  math::OdeStatus drive(Stepper& stepper, std::vector<double> y, const OnStep& on_step, const Rate&... rate) {
    const auto events = [this](double t, const double* at, double* g) { model_.events(t, at, g); };
    math::EventSigns signs(model_.event_count());
    std::vector<double> values(model_.event_count());
    go_to_next_limit();
    math::OdeStatus status = stepper.start(now_, std::span<const double>(y), rate...);
    const auto look = [&] {
      if (signs.size() == 0) return;
      events(now_, y.data(), values.data());
      signs.start(values);
    };
    look();
    if (status == math::OdeStatus::done && !on_step(stepper)) status = math::OdeStatus::stopped;
    while (status == math::OdeStatus::done) {
      status = math::integrate(stepper, limit_, signs, events, on_step, rate...);
      now_ = stepper.time_s();
      if constexpr (sizeof...(Rate) == 0) {
        if (status == math::OdeStatus::step_too_small && result_.jumps_passed < kMostJumps) {
          ++result_.jumps_passed;
          status = stepper.hop(std::min(1e-9, 0.5 * (limit_ - now_)));
          now_ = stepper.time_s();
          std::copy(stepper.state().begin(), stepper.state().end(), y.begin());
          look();
          continue;
        }
      }
      if (status != math::OdeStatus::done || !(now_ < options_.end_s)) break;
      std::copy(stepper.state().begin(), stepper.state().end(), y.begin());
      go_to_next_limit();
      if constexpr (sizeof...(Rate) > 0) {
        status = stepper.renew(rate...);
      } else {
        stepper.renew();
      }
      look();
    }
    result_.statistics = stepper.statistics();
    return status;
  }

  Simulation finish() {
    result_.message = std::string(math::explain(result_.status));
    if (result_.jumps_passed > 0)
      result_.message += fmt::format(", past {} jumps of the equations", result_.jumps_passed);
    if (result_.status != math::OdeStatus::done) result_.message += fmt::format(" (at {:.6g} s)", result_.reached_s);
    record_.write_to(result_, Eigen::Map<const Eigen::VectorXd>(times_.data(), static_cast<Eigen::Index>(row_)));
    return std::move(result_);
  }

  MovingModel model_;
  const SimulationOptions& options_;
  std::vector<double> times_;
  double now_, limit_ = 0.0;
  std::vector<double> y_, work_, breaks_;
  std::size_t row_ = 0;
  long calls_ = 0;
  SimulationRecord record_;
  Simulation result_;
};

}  // namespace

Simulation simulate(const SimulationModel& model,
                    const SimulationInput& input,
                    const SimulationStart& start,
                    const SimulationOptions& options) {
  return Run(model, input, consistent_start(model, start), options).go();
}

}  // namespace myoid::body
