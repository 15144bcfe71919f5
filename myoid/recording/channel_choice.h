#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/files/analog_channels.h"
#include "myoid/files/text_file.h"

namespace myoid::recording {

/// The channels that a person asks for by name, in that order and each once, of a file whose
/// channels have one clock or several. A name may differ from the file's in capitals, blanks, '_',
/// '-' and '.', if only one fits. Without names, all channels of the first clock. Throws ReadError,
/// which names the file, if there is no such channel, with the nearest name and those there are, or
/// if two of them have different clocks, with the channels of each clock.
[[nodiscard]] TimeSeries choose_channels(const std::vector<const AnalogChannels*>& clocks,
                                         const std::vector<std::string>& wanted,
                                         const std::filesystem::path& path);

/// The sentence that only the channels of the first clock are taken, with the names of the others:
/// "only the channels of the first clock are taken, without ACC X, ACC Y; ...".
[[nodiscard]] std::string first_clock_alone(const std::vector<std::string>& left_out);

/// Where a channel has samples that are no numbers: "is not a number at 1.25 s (3 samples)". Empty
/// for a channel without gaps.
[[nodiscard]] std::string gaps_of(const TimeSeries& series, Eigen::Index column);

/// The channels that have no gaps; each other one is left out, with a note that names it. What
/// cannot hold or bridge a gap, a filter or a .sto file, is given these.
[[nodiscard]] TimeSeries without_gaps(const TimeSeries& series, std::vector<Repair>& repairs);

}  // namespace myoid::recording
