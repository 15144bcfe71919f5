#include "myoid/simulation/simulation_run.h"

#include <algorithm>
#include <iterator>
#include <set>

namespace myoid::simulation {

void check_simulation(std::span<const std::string> muscles,
                      std::size_t coordinate_count,
                      const SimulationInput& input,
                      const SimulationStart& start,
                      const SimulationOptions& o) {
  const std::size_t n = muscles.size();
  const auto fits = [](std::size_t found, std::size_t expected, bool may_be_empty, std::string_view what,
                       std::string_view of) {
    if (found != expected && !(may_be_empty && found == 0))
      throw InvalidInput(fmt::format("{} {} for {} {}", found, what, expected, of));
  };
  if (!o.controller.excite) fits(input.excitation.size(), n, false, "excitations", "muscles");
  for (std::size_t i = 0; i < std::min(n, input.excitation.size()); ++i)
    validate_excitation(input.excitation[i], "excitation of " + muscles[i]);
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
  if (o.controller.excite && !(o.controller.interval_s > 0.0)) {
    throw InvalidInput(fmt::format("the controller's interval is {} s, expected more than 0", o.controller.interval_s));
  }
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
  if (!options.controller.excite) {
    for (const Signal& excitation : input.excitation) append(jumps(excitation));
  }
  for (const Signal& force : input.external) append(jumps(force));
  for (const Device& device : input.device) append(device.jumps_s);
  return {breaks.begin(), breaks.end()};
}

}  // namespace myoid::simulation
