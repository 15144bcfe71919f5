#pragma once

#include <span>
#include <string>
#include <vector>

#include "myoid/core/time_series.h"

namespace myoid::simulation {

/// Something over time: linear between its nodes, held before the first and after the last. Two
/// nodes at one time are a jump, to whose right its second value holds. An excitation, or a torque
/// from outside.
struct Signal {
  std::vector<double> time_s;
  std::vector<double> value;
};

/// Throws InvalidInput, naming `what` and the node, unless there is a node, sizes agree, times do
/// not go back nor stand still for more than two nodes, and all is finite.
void validate(const Signal& signal, std::string_view what);
/// The same, and values in 0..1.
void validate_excitation(const Signal& signal, std::string_view what);

[[nodiscard]] double value_at(const Signal& signal, double time_s);

/// Times within (start_s, end_s) at which it jumps.
[[nodiscard]] std::vector<double> jumps(const Signal& signal, double start_s, double end_s);

[[nodiscard]] Signal constant(double value);

/// A stretch of time at another level.
struct Burst {
  double start_s = 0.0;
  double duration_s = 0.1;
  double level = 1.0;
};

/// `rest`, but `level` during the bursts; they must follow one another in time. Throws InvalidInput
/// if they overlap or have no duration.
[[nodiscard]] Signal bursts(std::span<const Burst> bursts, double rest = 0.0);

/// `rest`, and from `start_s` on `level`.
[[nodiscard]] Signal step(double start_s, double level, double rest = 0.0);

/// Channels of a recording as excitations, in the order of `names`. A channel may also be called
/// "<name>.excitation" or ".../<name>", as OpenSim's files of controls do. Throws InvalidInput,
/// naming the muscle and the channels there are, if one is missing, leaves 0..1 or is not finite.
[[nodiscard]] std::vector<Signal> excitations_from(const TimeSeries& series,
                                                   std::span<const std::string> names);

}  // namespace myoid::simulation
