#pragma once

#include <span>
#include <string>
#include <vector>

#include "myoid/ground/core/time_series.h"

namespace myoid::body {

/// An excitation or an external torque over time: linear between its nodes, constant before the
/// first and after the last. Two nodes at one time are a jump; its second value holds to the right.
struct Signal {
  std::vector<double> time_s;
  std::vector<double> value;
};

/// Throws InvalidInput, naming `what` and the node, unless there is a node, sizes agree, times do
/// not go back nor stand still for more than two nodes, and all is finite.
void validate(const Signal& signal, std::string_view what);
/// Validates as above, and also that values are in 0..1.
void validate_excitation(const Signal& signal, std::string_view what);

[[nodiscard]] double value_at(const Signal& signal, double time_s);

/// Returns the times at which the signal jumps.
[[nodiscard]] std::vector<double> jumps(const Signal& signal);

[[nodiscard]] Signal constant(double value);

/// A stretch of time at another level.
struct Burst {
  double start_s = 0.0;
  double duration_s = 0.1;
  double level = 1.0;
};

/// Returns a signal of `rest`, but `level` during the bursts, which must be in order of time.
/// Throws InvalidInput if they overlap or have no duration.
[[nodiscard]] Signal bursts(std::span<const Burst> bursts, double rest = 0.0);

/// Returns a signal of `rest` and, from `start_s` on, `level`.
[[nodiscard]] Signal step(double start_s, double level, double rest = 0.0);

/// Returns channels of a recording as excitations, in the order of `names`. A channel may also be called
/// "<name>.excitation" or ".../<name>", as in OpenSim's files of controls. Throws InvalidInput, naming the muscle and
/// the available channels, if one is missing, leaves 0..1 or is not finite.
[[nodiscard]] std::vector<Signal> excitations_from(const TimeSeries& series, std::span<const std::string> names);

/// Reads the excitation of each muscle from the texts of `simulate --excite`: MUSCLE=LEVEL (all the
/// time), MUSCLE=LEVEL@START (a step) or MUSCLE=LEVEL@START+DURATION (a burst), with a level of 0
/// to 1 and times in seconds. "all" means every muscle; muscles without a text have `rest`. Throws
/// InvalidInput for a text of another form and an unknown muscle.
[[nodiscard]] std::vector<Signal> described_excitations(const std::vector<std::string>& texts,
                                                        double rest,
                                                        const std::vector<std::string>& muscles);

}  // namespace myoid::body
