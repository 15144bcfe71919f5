#include "myoid/core/fault.h"

#include <fmt/format.h>

namespace myoid {

std::string_view name(FaultKind kind) {
  switch (kind) {
    case FaultKind::marker_unit:
      return "marker_unit";
    case FaultKind::marker_gap:
      return "marker_gap";
    case FaultKind::marker_jump:
      return "marker_jump";
    case FaultKind::marker_swap:
      return "marker_swap";
    case FaultKind::segment_not_rigid:
      return "segment_not_rigid";
    case FaultKind::emg_amplitude:
      return "emg_amplitude";
    case FaultKind::emg_envelope:
      return "emg_envelope";
    case FaultKind::emg_flat:
      return "emg_flat";
    case FaultKind::emg_clipped:
      return "emg_clipped";
    case FaultKind::emg_saturated:
      return "emg_saturated";
    case FaultKind::emg_hum:
      return "emg_hum";
    case FaultKind::emg_low_signal:
      return "emg_low_signal";
    case FaultKind::emg_crosstalk:
      return "emg_crosstalk";
    case FaultKind::emg_drift:
      return "emg_drift";
    case FaultKind::emg_artifact:
      return "emg_artifact";
    case FaultKind::emg_over_reference:
      return "emg_over_reference";
    case FaultKind::clock_uneven:
      return "clock_uneven";
    case FaultKind::clock_offset:
      return "clock_offset";
    case FaultKind::clock_drift:
      return "clock_drift";
    case FaultKind::plate_offset:
      return "plate_offset";
    case FaultKind::plate_sign:
      return "plate_sign";
    case FaultKind::plate_pressure_outside:
      return "plate_pressure_outside";
  }
  return "?";
}

std::string sentence(const Fault& fault) {
  return fault.remedy.empty() ? fault.text : fmt::format("{}; {}", fault.text, fault.remedy);
}

}  // namespace myoid
