#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/recording/force_plate.h"

namespace myoid::recording {

/// The channels that may be EMG: in volts, none of a force plate's (`plates`, with the columns that
/// FORCE_PLATFORM:CHANNEL names), and not called like another instrument's.
[[nodiscard]] std::vector<std::string> emg_channels(const std::vector<Channel>& channels,
                                                    const std::vector<PlateSetup>& plates);

}  // namespace myoid::recording
