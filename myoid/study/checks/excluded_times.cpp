#include "myoid/study/checks/excluded_times.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace myoid::study {

std::vector<Stretch> margined(std::vector<Stretch> times) {
  constexpr double kReach_s = 0.1;  // half a period of the usual 6 Hz
  for (Stretch& time : times) time = {time.begin_s - kReach_s, time.end_s + kReach_s};
  return times;
}

std::vector<Remark> excluded_times(const TrialSpec& trial,
                                   const TrialInput& input,
                                   const std::vector<Stretch>& foreign) {
  std::vector<Stretch> times = trial.exclude.windows;
  if (trial.exclude.foreign_contacts) std::ranges::copy(margined(foreign), std::back_inserter(times));
  const Eigen::VectorXd* clock = input.markers  ? &input.markers->time_s
                                 : input.motion ? &input.motion->time_s()
                                 : input.emg    ? &input.emg->time_s()
                                                : nullptr;
  if (times.empty() || clock == nullptr || clock->size() < 2) return {};
  const double first_s = (*clock)[0], last_s = (*clock)[clock->size() - 1];
  // A window may lie in another part of a trial that is cut at pauses.
  const bool is_part = std::ranges::find(input.remarks, RemarkCode::clock_pause, &Remark::code) != input.remarks.end();
  std::vector<Remark> found;
  std::vector<std::string> said;
  for (const Stretch& time : times) {
    if (time.end_s >= first_s && time.begin_s <= last_s) {
      said.push_back(fmt::format("{:.4g} to {:.4g} s", time.begin_s, time.end_s));
      continue;
    }
    if (is_part) continue;
    found.push_back({.code = RemarkCode::general,
                     .where = trial.name,
                     .says = fmt::format("exclude = [{:g}, {:g}] lies outside of the trial, which lasts from {:.4g} to "
                                         "{:.4g} s",
                                         time.begin_s, time.end_s, first_s, last_s),
                     .remedy = "write its times in seconds of the motion"});
  }
  if (said.empty()) return found;
  const auto out = std::ranges::count_if(*clock, [&](double t) {
    return std::ranges::any_of(times, [&](const Stretch& time) { return t >= time.begin_s && t <= time.end_s; });
  });
  found.push_back({.code = RemarkCode::general,
                   .severity = Severity::note,
                   .where = trial.name,
                   .says = fmt::format(
                       "left out of fit, scores and activation 1, as the study says: {} ({:.0f} % of the "
                       "trial)",
                       fmt::join(said, ", "), 100.0 * static_cast<double>(out) / static_cast<double>(clock->size()))});
  return found;
}

}  // namespace myoid::study
