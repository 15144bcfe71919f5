#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/ground/files/analog_channels.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/force_plate.h"

namespace myoid::recording {

/// Returns the channels that a person names, in that order and each once. A name may differ from the file's in
/// capitals, blanks, '_', '-' and '.', if only one channel fits. Without names, returns all channels of the first
/// clock. Throws ReadError if there is no such channel, with the nearest name and the available ones, or if two of them
/// have different clocks, with the channels of each clock.
[[nodiscard]] TimeSeries choose_channels(const std::vector<const AnalogChannels*>& clocks,
                                         const std::vector<std::string>& wanted,
                                         const std::filesystem::path& path);

/// Returns the sentence that names the channels left out because they are not on the first clock:
/// "only the channels of the first clock are taken, without ACC X, ACC Y; ...".
[[nodiscard]] std::string first_clock_alone(const std::vector<std::string>& left_out);

/// Returns where a channel has samples that are no numbers: "is not a number at 1.25 s (3
/// samples)". Empty for a channel without gaps.
[[nodiscard]] std::string gaps_of(const TimeSeries& series, Eigen::Index column);

/// Returns the channels without gaps; each other channel is left out, with a note. Filters and .sto
/// files can neither hold nor bridge a gap.
[[nodiscard]] TimeSeries without_gaps(const TimeSeries& series, std::vector<Repair>& repairs);

/// Returns the channels that may be EMG: in volts, not in a column that FORCE_PLATFORM:CHANNEL
/// names (`plates`), and not named like another instrument's.
[[nodiscard]] std::vector<std::string> emg_channels(const std::vector<Channel>& channels,
                                                    const std::vector<PlateSetup>& plates);

}  // namespace myoid::recording
