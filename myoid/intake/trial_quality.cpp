#include "myoid/intake/trial_quality.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "myoid/signals/clock_offset.h"
#include "myoid/signals/emg_quality.h"

namespace myoid {

TimeSeries movement_of(const TrialInput& input) {
  if (input.motion) return *input.motion;
  if (!input.markers) return {};
  std::vector<Channel> channels;
  Eigen::MatrixXd values(input.markers->frame_count(), 0);
  for (Eigen::Index m = 0; m < input.markers->marker_count(); ++m) {
    const auto path = input.markers->positions_m.middleCols(3 * m, 3);
    if (!path.allFinite()) continue;
    values.conservativeResize(Eigen::NoChange, values.cols() + 3);
    values.rightCols(3) = path;
    for (const char* axis : {"x", "y", "z"}) {
      channels.push_back({fmt::format("{} {}", input.markers->names[static_cast<std::size_t>(m)], axis), Unit::meter});
    }
  }
  if (values.cols() == 0) return {};
  return {input.markers->time_s, std::move(channels), std::move(values)};
}

std::vector<Remark> trial_faults(const Study& study, const TrialInput& input, const TimeSeries& envelope) {
  std::vector<Remark> faults = input.marker_faults;
  const auto append = [&](std::vector<Remark> more) {
    std::move(more.begin(), more.end(), std::back_inserter(faults));
  };
  if (input.emg) {
    if (study.emg.kind == EmgKind::raw) append(signals::check_emg(*input.emg, !study.emg.as_published));
    if (auto uneven = signals::check_clock_evenness(input.emg->time_s(), "EMG")) faults.push_back(std::move(*uneven));
  }
  if (input.markers) {
    if (auto uneven = signals::check_clock_evenness(input.markers->time_s, "markers"))
      faults.push_back(std::move(*uneven));
  }
  if (input.motion) {
    if (auto uneven = signals::check_clock_evenness(input.motion->time_s(), "motion"))
      faults.push_back(std::move(*uneven));
  }
  if (envelope.empty()) return faults;
  const TimeSeries movement = movement_of(input);
  if (!movement.empty()) append(signals::check_clock_offset(envelope, movement));
  return faults;
}

}  // namespace myoid
