#include "myoid/study/intake/trial_quality.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "myoid/recording/signals/clock_offset.h"
#include "myoid/recording/signals/emg_quality.h"

namespace myoid::study {

TimeSeries movement_of(const TrialInput& input) {
  if (input.motion) return input.motion->channel_count() > 0 ? *input.motion : TimeSeries();
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
  const auto append = [&](std::vector<Remark> more) { std::ranges::move(more, std::back_inserter(faults)); };
  const auto check_clock_of = [&](const Eigen::VectorXd& time_s, const char* what) {
    if (auto uneven = recording::check_clock_evenness(time_s, what)) faults.push_back(std::move(*uneven));
  };
  if (input.emg && study.emg.kind == EmgKind::raw)
    append(recording::check_emg(*input.emg, {.high_passed = !study.emg.chain.as_published,
                                             .notched = study.emg.chain.notch && !study.emg.chain.as_published}));
  if (input.emg) check_clock_of(input.emg->time_s(), "EMG");
  if (input.markers) check_clock_of(input.markers->time_s, "markers");
  if (input.motion) check_clock_of(input.motion->time_s(), "motion");
  if (envelope.empty()) return faults;
  const TimeSeries movement = movement_of(input);
  if (!movement.empty()) append(recording::check_clock_offset(envelope, movement));
  return faults;
}

}  // namespace myoid::study
