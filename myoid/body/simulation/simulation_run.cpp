#include "myoid/body/simulation/simulation_run.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "myoid/body/simulation/tree_dynamics.h"
#include "myoid/ground/core/error.h"

namespace myoid::body {

void check_simulation(const SimulationModel& model,
                      const SimulationInput& input,
                      const SimulationStart& start,
                      const SimulationOptions& o) {
  const std::size_t n = model.muscles.size();
  const std::size_t coordinate_count = model.body.coordinates.size();
  const auto fits = [](std::size_t found, std::size_t expected, bool may_be_empty, std::string_view what,
                       std::string_view of) {
    if (found != expected && !(may_be_empty && found == 0))
      throw InvalidInput(fmt::format("{} {} for {} {}", found, what, expected, of));
  };
  fits(input.excitation.size(), n, false, "excitations", "muscles");
  for (std::size_t i = 0; i < n; ++i)
    validate_excitation(input.excitation[i], "excitation of " + model.muscles[i].name);
  fits(input.external.size(), coordinate_count, true, "external forces", "coordinates");
  for (const Signal& signal : input.external) validate(signal, "external force");
  fits(input.device.size(), coordinate_count, true, "devices", "coordinates");
  fits(start.q.size(), coordinate_count, false, "starting values", "coordinates");
  fits(start.qdot.size(), coordinate_count, true, "starting speeds", "coordinates");
  fits(start.activation.size(), n, true, "starting activations", "muscles");
  fits(start.fiber.size(), n, true, "starting fiber states", "muscles");
  for (const auto* values : {&start.q, &start.qdot}) {
    for (const double value : *values) {
      if (!std::isfinite(value)) throw InvalidInput(fmt::format("the start holds {}, expected finite numbers", value));
    }
  }
  if (!std::isfinite(start.time_s) || !std::isfinite(o.end_s) || !(o.end_s > start.time_s)) {
    throw InvalidInput(fmt::format("the simulation goes from {} to {} s, expected a later end", start.time_s, o.end_s));
  }
  for (const body::CoordinateCoupler& c : model.body.couplers) {
    const auto k = static_cast<std::size_t>(c.dependent);
    if (k < input.device.size() && input.device[k].acceleration) {
      const std::string& leader = model.body.coordinates[static_cast<std::size_t>(c.independent)].name;
      throw InvalidInput(
          fmt::format("coordinate '{}' follows '{}' (coupler '{}'): it cannot be held or moved by itself; hold '{}'",
                      model.body.coordinates[k].name, leader, c.name, leader));
    }
  }
}

SimulationStart consistent_start(const SimulationModel& model, const SimulationStart& start) {
  if (model.body.couplers.empty() || start.q.size() != model.body.coordinates.size()) return start;
  SimulationStart consistent = start;
  consistent.qdot.resize(start.q.size(), 0.0);
  TreeDynamics dynamics(model.body);
  const auto n = static_cast<Eigen::Index>(start.q.size());
  dynamics.set(Eigen::Map<const Eigen::VectorXd>(start.q.data(), n),
               Eigen::Map<const Eigen::VectorXd>(consistent.qdot.data(), n));
  consistent.q.assign(dynamics.q().begin(), dynamics.q().end());
  consistent.qdot.assign(dynamics.qdot().begin(), dynamics.qdot().end());
  return consistent;
}

std::vector<double> output_times(const SimulationStart& start, const SimulationOptions& o) {
  if (!o.output_times_s.empty()) {
    for (std::size_t k = 0; k < o.output_times_s.size(); ++k) {
      const double t = o.output_times_s[k];
      if (!(t >= start.time_s && t <= o.end_s) || (k > 0 && t <= o.output_times_s[k - 1])) {
        throw InvalidInput(
            fmt::format("output time {} is {} s, expected rising times in {} .. {} s", k, t, start.time_s, o.end_s));
      }
    }
    return o.output_times_s;
  }
  if (!(o.output_rate_hz > 0.0) || !(o.output_rate_hz <= 1e6)) {
    throw InvalidInput(fmt::format("output rate {} Hz, expected more than 0 and at most 1e6", o.output_rate_hz));
  }
  const double duration = o.end_s - start.time_s;
  if (duration * o.output_rate_hz > 5e7) {
    throw InvalidInput(
        fmt::format("{} s at {} Hz are more samples than 50 million; lower the rate", duration, o.output_rate_hz));
  }
  const auto count = static_cast<std::size_t>(std::floor(duration * o.output_rate_hz + 1e-9)) + 1;
  std::vector<double> times(count);
  for (std::size_t k = 0; k < count; ++k)
    times[k] = std::min(start.time_s + static_cast<double>(k) / o.output_rate_hz, o.end_s);
  return times;
}

std::vector<double> break_times(const SimulationInput& input, double start_s, const SimulationOptions& options) {
  std::set<double> breaks{options.end_s};
  const auto append = [&](const std::vector<double>& times) {
    std::copy_if(times.begin(), times.end(), std::inserter(breaks, breaks.end()),
                 [&](double t) { return t > start_s && t < options.end_s; });
  };
  for (const Signal& excitation : input.excitation) append(jumps(excitation));
  for (const Signal& force : input.external) append(jumps(force));
  for (const Device& device : input.device) append(device.jumps_s);
  return {breaks.begin(), breaks.end()};
}

}  // namespace myoid::body
