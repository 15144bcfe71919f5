#include "myoid/intake/trial_quality.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

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
      channels.push_back(
          {fmt::format("{} {}", input.markers->names[static_cast<std::size_t>(m)], axis),
           Unit::meter});
    }
  }
  if (values.cols() == 0) return {};
  return {input.markers->time_s, std::move(channels), std::move(values)};
}

std::vector<Fault> trial_faults(const Study& study,
                                const TrialInput& input,
                                const TimeSeries& envelope) {
  std::vector<Fault> faults = input.marker_faults;
  const auto append = [&](std::vector<Fault> more) {
    std::move(more.begin(), more.end(), std::back_inserter(faults));
  };
  if (input.emg) {
    if (study.emg.kind == EmgKind::raw)
      append(signals::check_emg(*input.emg, !study.emg.as_published));
    if (auto uneven = signals::check_clock_evenness(input.emg->time_s(), "EMG"))
      faults.push_back(std::move(*uneven));
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

std::vector<std::string> fault_summary(const std::vector<NamedFault>& faults, std::size_t most) {
  std::vector<std::string> lines;
  std::set<std::pair<FaultKind, std::string>> said;
  std::size_t more = 0;
  for (const NamedFault& f : faults) {
    if (!f.fault.grave || !said.insert({f.fault.kind, f.fault.channel}).second) continue;
    if (lines.size() == most) {
      ++more;
      continue;
    }
    std::vector<std::string> others;
    for (const NamedFault& g : faults) {
      if (g.fault.grave && g.fault.kind == f.fault.kind && g.fault.channel == f.fault.channel &&
          g.trial != f.trial)
        others.push_back(g.trial);
    }
    std::string line = f.trial.empty() ? "" : fmt::format("trial {}: ", f.trial);
    line += sentence(f.fault);
    if (!others.empty()) line += fmt::format(" (likewise in {})", fmt::join(others, ", "));
    lines.push_back(std::move(line));
  }
  if (more > 0) lines.push_back(fmt::format("{} more faults: see `myoid check`", more));
  return lines;
}

}  // namespace myoid
