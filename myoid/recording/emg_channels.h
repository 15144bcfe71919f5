#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "myoid/core/time_series.h"
#include "myoid/recording/force_plate.h"

namespace myoid::recording {

/// True for what the channels of force plates, triggers, switches and the like are usually called:
/// a force, moment or center of pressure with its axis and number ("F1X", "Force.Fz2", "Mx1",
/// "COPy", "Fz3" and "Fx12" of piezoelectric plates), "Sync", "Trigger", "Footswitch", ...
/// and the motion that wireless electrodes record too ("Sensor 1: ACC.X 1", "GYRO Y", "FSR.A").
[[nodiscard]] bool named_as_no_emg(std::string_view name);

/// The channels that may be EMG: in volts, none of a force plate's (`plates`, with the columns that
/// FORCE_PLATFORM:CHANNEL names), and not called like another instrument's.
[[nodiscard]] std::vector<std::string> emg_channels(const std::vector<Channel>& channels,
                                                    const std::vector<PlateSetup>& plates);

}  // namespace myoid::recording
