#include "myoid/body/simulation/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/simulation/model_parameters.h"
#include "myoid/body/simulation/moving_model.h"
#include "myoid/body/simulation/simulation_run.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/core/parallel.h"
#include "myoid/ground/math/ode_events.h"
#include "myoid/ground/math/stiff_ode.h"

namespace myoid::body {
namespace {

constexpr std::size_t kChunk = 8;
/// The step of the differences, in scaled parameters. Truncation is 1e-8, activations good to 1e-10 give 1e-6.
constexpr double kStep = 1e-4;

/// Returns the parameter of this name, of the model or of the start.
ModelParameter parameter_of(SimulationModel& model, SimulationStart& start, std::string_view name) {
  for (std::size_t k = 0; k < start.q.size(); ++k) {
    const std::string& coordinate = model.body.coordinates[k].name;
    if (name == coordinate + ".start") return {std::string(name), &start.q[k], true};
    if (name == coordinate + ".start_speed") return {std::string(name), &start.qdot[k], true};
  }
  return model_parameter(model, name);
}

/// Calls f(quantity, value) for every quantity of a row.
template <typename F>
void visit_row(const SimulationRecord& r, F&& f) {
  for (std::size_t k = 0; k < r.coordinates.size(); ++k) {
    const std::string& name = r.coordinates[k].name;
    const auto c = static_cast<Eigen::Index>(k);
    f(name, r.motion(0, SimulationRecord::kMotions * c));
    f(name + "_speed", r.motion(0, SimulationRecord::kMotions * c + 1));
    f(name + "_acceleration", r.motion(0, SimulationRecord::kMotions * c + 2));
    f(name + "_muscles", r.torque(0, SimulationRecord::kTorques * c));
    f(name + "_device", r.torque(0, SimulationRecord::kTorques * c + 4));
  }
  for (std::size_t i = 0; i < r.muscles.size(); ++i) {
    const auto c = static_cast<Eigen::Index>(i);
    f(r.muscles[i] + "_activation", r.activation(0, c));
    f(r.muscles[i] + "_fiber_length", r.fiber_length(0, c));
    f(r.muscles[i] + "_tendon_force", r.tendon_force(0, c));
  }
}

/// The movement whose scaled parameter is larger by `factor`. A parameter of 0 that may not be negative is larger by
/// the step in addition.
struct Shifted {
  Shifted(const SimulationModel& from,
          const SimulationInput& input,
          SimulationStart start,
          const SimulationOptions& options,
          const std::string& name,
          double factor)
      : model(from) {
    start.qdot.resize(start.q.size(), 0.0);
    const ModelParameter parameter = parameter_of(model, start, name);
    double& value = *parameter.value;
    const bool at_end = value == 0.0 && !parameter.may_be_negative;
    if (value != 0.0) scale = std::abs(value);
    value += (at_end ? factor + kStep : factor) * scale;
    moving.emplace(model, input, consistent_start(model, start), options);
    row = moving->make_record(1);
  }

  SimulationModel model;
  double scale = 1.0;  ///< Makes the derivatives as large as the states: the parameter's size.
  std::optional<MovingModel> moving;
  SimulationRecord row;
};

/// The derivatives by one scaled parameter.
class Difference {
 public:
  Difference(const SimulationModel& model,
             const SimulationInput& input,
             const SimulationStart& start,
             const SimulationOptions& options,
             const std::string& name)
      : up_(model, input, start, options, name, kStep), down_(model, input, start, options, name, -kStep) {
    const std::size_t states = up_.moving->state_count();
    for (auto* list : {&y_, &up_rate_, &down_rate_}) list->resize(states);
  }

  [[nodiscard]] double start(std::size_t state) const {
    return (up_.moving->start_state()[state] - down_.moving->start_state()[state]) / (2.0 * kStep);
  }
  void begin_stretch(double end_s) {
    up_.moving->begin_stretch(end_s);
    down_.moving->begin_stretch(end_s);
  }
  void rate(double t, const double* y, const double* s, double* sdot) {
    up_.moving->rate(t, beside(y, s, kStep), up_rate_.data());
    down_.moving->rate(t, beside(y, s, -kStep), down_rate_.data());
    for (std::size_t i = 0; i < y_.size(); ++i) sdot[i] = (up_rate_[i] - down_rate_[i]) / (2.0 * kStep);
  }
  /// Puts the derivatives of every quantity, by the parameter itself, in the place of the result.
  void record(
      double t, const double* y, const double* s, Sensitivities& result, Eigen::Index row, Eigen::Index column) {
    up_.moving->record(t, beside(y, s, kStep), nullptr, 0, up_.row);
    down_.moving->record(t, beside(y, s, -kStep), nullptr, 0, down_.row);
    const double width = 2.0 * kStep * up_.scale;
    std::size_t k = 0;
    visit_row(up_.row, [&](const auto&, double value) { result.of[k++].by_parameter(row, column) = value / width; });
    k = 0;
    visit_row(down_.row, [&](const auto&, double value) { result.of[k++].by_parameter(row, column) -= value / width; });
  }

 private:
  const double* beside(const double* y, const double* s, double step) {
    for (std::size_t i = 0; i < y_.size(); ++i) y_[i] = y[i] + step * s[i];
    return y_.data();
  }

  Shifted up_, down_;
  std::vector<double> y_, up_rate_, down_rate_;
};

/// One integration with the derivatives by at most kChunk parameters.
class Chunk {
 public:
  Chunk(const SimulationModel& model,
        const SimulationInput& input,
        const SimulationStart& start,
        const SimulationOptions& options,
        std::span<const std::string> parameters,
        const std::vector<double>& times)
      : plain_(model, input, start, options),
        options_(options),
        times_(times),
        now_(start.time_s),
        breaks_(break_times(input, start.time_s, options)),
        y_(plain_.start_state()) {
    for (const std::string& name : parameters) differences_.emplace_back(model, input, start, options, name);
    for (const Difference& difference : differences_) {
      for (std::size_t i = 0; i < y_.size(); ++i) s_.push_back(difference.start(i));
    }
  }

  math::OdeStatus run(Sensitivities& result, Eigen::Index first_column) {
    math::StiffIntegrator stepper(problem(), options_.ode);
    math::EventSigns signs(plain_.event_count());
    std::vector<double> g(signs.size());
    const auto events = [this](double t, const double* y, double* out) { plain_.events(t, y, out); };
    const auto on_step = [&](const math::StiffIntegrator& stepped) {
      for (; row_ < times_.size() && times_[row_] <= stepped.time_s(); ++row_) {
        stepped.interpolate(times_[row_], y_);
        stepped.interpolate_sensitivity(times_[row_], s_);
        for (std::size_t k = 0; k < differences_.size(); ++k)
          differences_[k].record(times_[row_], y_.data(), s_.data() + k * y_.size(), result,
                                 static_cast<Eigen::Index>(row_), first_column + static_cast<Eigen::Index>(k));
      }
      return !options_.progress.stop.stop_requested();
    };
    stepper.start(now_, y_, s_);
    math::OdeStatus status = math::OdeStatus::done;
    bool first = true;
    for (const double limit : breaks_) {
      plain_.begin_stretch(limit);
      for (Difference& difference : differences_) difference.begin_stretch(limit);
      if (signs.size() > 0) {
        events(now_, stepper.state().data(), g.data());
        signs.start(g);
      }
      if (first && !on_step(stepper)) return math::OdeStatus::stopped;
      if (!first) stepper.renew();
      first = false;
      status = math::integrate(stepper, limit, signs, events, on_step);
      now_ = stepper.time_s();
      if (status != math::OdeStatus::done) break;
    }
    return status;
  }

 private:
  math::StiffProblem problem() {
    math::StiffProblem problem;
    problem.state_count = y_.size();
    problem.rate = [this](double t, const double* y, double* ydot) {
      plain_.rate(t, y, ydot);
      return true;
    };
    problem.sensitivity_count = differences_.size();
    problem.sensitivity = [this](double t, const double* y, const double* const* s, double* const* sdot) {
      for (std::size_t k = 0; k < differences_.size(); ++k) differences_[k].rate(t, y, s[k], sdot[k]);
      return true;
    };
    return problem;
  }

  MovingModel plain_;
  const SimulationOptions& options_;
  const std::vector<double>& times_;
  double now_;
  std::vector<double> breaks_, y_, s_;
  std::deque<Difference> differences_;
  std::size_t row_ = 0;
};

}  // namespace

const Eigen::MatrixXd& Sensitivities::operator[](std::string_view quantity) const {
  const auto found = std::ranges::find(of, quantity, &Sensitivity::quantity);
  if (found != of.end()) return found->by_parameter;
  throw InvalidInput(
      fmt::format("there are no derivatives of '{}', only of {}", quantity, name_list(of, &Sensitivity::quantity)));
}

std::vector<std::string> sensitivity_names(SimulationModel model) {
  std::vector<std::string> names;
  for (ModelParameter& parameter : model_parameters(model)) names.push_back(std::move(parameter.name));
  for (const body::Coordinate& c : model.body.coordinates) {
    names.push_back(c.name + ".start");
    names.push_back(c.name + ".start_speed");
  }
  return names;
}

Sensitivities simulate_sensitivities(const SimulationModel& model,
                                     const SimulationInput& input,
                                     const SimulationStart& start,
                                     const SimulationOptions& given,
                                     std::span<const std::string> parameters) {
  SimulationOptions options = given;
  options.energy = false;
  const SimulationStart consistent = consistent_start(model, start);
  check_simulation(model, input, consistent, options);
  const std::vector<double> times = output_times(consistent, options);
  Sensitivities result;
  result.parameters.assign(parameters.begin(), parameters.end());
  const auto rows = static_cast<Eigen::Index>(times.size());
  result.time_s = Eigen::Map<const Eigen::VectorXd>(times.data(), rows);
  const MovingModel plain(model, input, consistent, options);
  visit_row(plain.make_record(1), [&](const std::string& quantity, double) {
    result.of.push_back({quantity, Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(parameters.size()))});
  });

  const std::size_t chunks = (parameters.size() + kChunk - 1) / kChunk;
  std::vector<math::OdeStatus> status(chunks, math::OdeStatus::done);
  parallel_each(chunks, [&](std::size_t c) {
    const std::size_t begin = c * kChunk;
    Chunk chunk(model, input, consistent, options,
                parameters.subspan(begin, std::min(kChunk, parameters.size() - begin)), times);
    status[c] = chunk.run(result, static_cast<Eigen::Index>(begin));
  });
  if (options.progress.stop.stop_requested()) throw Interrupted();
  for (const math::OdeStatus of_chunk : status) {
    if (of_chunk != math::OdeStatus::done) result.status = of_chunk;
  }
  result.message = std::string(math::explain(result.status));
  return result;
}

}  // namespace myoid::body
