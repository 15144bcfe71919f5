#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/recording/force_plate.h"

namespace myoid::recording {

/// Returns the channels that may be EMG: in volts, not in a column that FORCE_PLATFORM:CHANNEL
/// names (`plates`), and not named like another instrument's.
[[nodiscard]] std::vector<std::string> emg_channels(const std::vector<Channel>& channels,
                                                    const std::vector<PlateSetup>& plates);

}  // namespace myoid::recording
