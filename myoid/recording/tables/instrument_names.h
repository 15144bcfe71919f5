#pragma once

#include <string_view>

namespace myoid::recording {

/// Returns true for usual names of force plates, triggers, switches and other signals that are no EMG. Recognizes a
/// force, moment or center of pressure with its axis and number ("F1X", "Force.Fz2", "Mx1", "COPy", "Fz3" and "Fx12" of
/// piezoelectric plates), "Sync", "Trigger", "Footswitch", ..., and signals that wireless electrodes record in addition
/// to EMG: motion ("Sensor 1: ACC.X 1", "GYRO Y", "FSR.A") and the heart ("EKG 1", "ECG").
[[nodiscard]] bool named_as_no_emg(std::string_view name);

/// Returns true for a spare input of an amplifier, "Analog 13" or "AUX 2", which holds EMG in one
/// laboratory and a switch in another. "EMG Analog 3" is EMG.
[[nodiscard]] bool named_as_input(std::string_view name);

}  // namespace myoid::recording
