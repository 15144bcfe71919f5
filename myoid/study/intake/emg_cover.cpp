#include "myoid/study/intake/emg_cover.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/study/intake/limits.h"

namespace myoid::study {
namespace {

double length_s(const Eigen::VectorXd& time_s) { return time_s[time_s.size() - 1] - time_s[0]; }

const Eigen::VectorXd* motion_clock(const TrialInput& input) {
  return input.markers ? &input.markers->time_s : input.motion ? &input.motion->time_s() : nullptr;
}

std::string lasts(const TrialLengths& t) {
  return fmt::format("the {} {:.4g} s and the motion {:.4g} s, {:.3g} times as long",
                     t.of_loads ? "loads last" : "EMG lasts", t.emg_s, t.motion_s, t.emg_s / t.motion_s);
}

std::string which_rate(const TrialLengths& t) {
  return fmt::format(
      "{} at {:.4g} Hz instead of {:.4g} Hz, or a motion at {:.4g} Hz instead of {:.4g} Hz, would end together with "
      "the other: correct the rate or the times in the file that is wrong",
      t.of_loads ? "Loads" : "EMG", t.emg_rate_hz * t.emg_s / t.motion_s, t.emg_rate_hz,
      t.motion_rate_hz * t.motion_s / t.emg_s, t.motion_rate_hz);
}

/// Finds the only two trials whose EMG and motion differ in length, if the EMG of each is as long as the other's
/// motion.
std::optional<Remark> exchanged_emg(const std::vector<TrialLengths>& trials) {
  const auto unlike = [](double a_s, double b_s) { return std::abs(a_s - b_s) > kLimits.clocks.uncovered_s; };
  std::vector<const TrialLengths*> apart;
  for (const TrialLengths& t : trials) {
    if (unlike(t.emg_s, t.motion_s)) apart.push_back(&t);
  }
  if (apart.size() != 2) return std::nullopt;
  const TrialLengths &a = *apart[0], &b = *apart[1];
  if (unlike(a.emg_s, b.motion_s) || unlike(b.emg_s, a.motion_s)) return std::nullopt;
  return Remark{
      .code = RemarkCode::emg_length,
      .severity = Severity::warning,
      .where = a.trial,
      .says = fmt::format("{}; the EMG of '{}' lasts {:.4g} s, and its motion {:.4g} s: each EMG is as long as the "
                          "other trial's motion",
                          lasts(a), b.trial, b.emg_s, b.motion_s),
      .remedy = "exchange emg of the two trials if the files are mixed up"};
}

/// Finds one ratio of the durations in trials of unlike length: a clock that runs fast. EMG that goes on for a while
/// after each motion is longer by a time instead.
std::optional<Remark> one_ratio(const std::vector<TrialLengths>& trials) {
  constexpr std::size_t kFewest = 3;
  constexpr double kMuchBetter = 0.2;
  if (trials.size() < kFewest) return std::nullopt;
  double product = 0.0, square = 0.0, longer_s = 0.0, shortest_s = 1e300, longest_s = 0.0;
  for (const TrialLengths& t : trials) {
    product += t.emg_s * t.motion_s;
    square += t.motion_s * t.motion_s;
    longer_s += (t.emg_s - t.motion_s) / static_cast<double>(trials.size());
    shortest_s = std::min(shortest_s, t.motion_s);
    longest_s = std::max(longest_s, t.motion_s);
  }
  const double ratio = product / square;
  double by_ratio = 0.0, by_time = 0.0;
  for (const TrialLengths& t : trials) {
    by_ratio = std::max(by_ratio, std::abs(t.emg_s - ratio * t.motion_s));
    by_time = std::max(by_time, std::abs(t.emg_s - t.motion_s - longer_s));
  }
  if (longest_s < kLimits.clocks.unlike_length * shortest_s ||
      std::abs(ratio - 1.0) * longest_s < kLimits.clocks.apart_s || by_ratio > kMuchBetter * by_time)
    return std::nullopt;
  const TrialLengths& t = *std::ranges::max_element(trials, {}, &TrialLengths::motion_s);
  return Remark{
      .code = RemarkCode::emg_length,
      .severity = Severity::warning,
      .where = "study",
      .value = ratio,
      .says = fmt::format("in every trial the EMG lasts {:.4g} times as long as the motion, so that at the end "
                          "of '{}' they are {:.2g} s apart: a rate is wrong. {}",
                          ratio, t.trial, std::abs(t.emg_s - t.motion_s), which_rate(t))};
}

}  // namespace

std::optional<double> whole_factor(double ratio, double tolerance) {
  for (const double factor : {2.0, 3.0, 4.0, 5.0, 10.0, 100.0, 1000.0}) {
    for (const double f : {factor, 1.0 / factor}) {
      if (std::abs(ratio / f - 1.0) < tolerance) return f;
    }
  }
  return std::nullopt;
}

std::optional<Cover> check_cover(const std::filesystem::path& file,
                                 std::string_view recorded,
                                 const Eigen::VectorXd& time_s,
                                 const TrialSpec& trial,
                                 const TrialInput& input) {
  const Eigen::VectorXd* motion_s = motion_clock(input);
  if (motion_s == nullptr) return std::nullopt;
  // A motion beside given lengths is whole here.
  const double begin_s = std::max((*motion_s)[0], trial.start_s.value_or(-1e300));
  const double end_s = std::min((*motion_s)[motion_s->size() - 1], trial.end_s.value_or(1e300));
  const double first_s = time_s[0], last_s = time_s[time_s.size() - 1];
  const Cover both{.begin_s = std::max(first_s, begin_s), .end_s = std::min(last_s, end_s), .lacks = {}};
  const double overlap = both.end_s - both.begin_s;
  if (end_s - begin_s < kLimits.clocks.shortest_trial_s) {
    throw ReadError(file, 0,
                    fmt::format("the trial lasts {:.3g} s ({:.5g} to {:.5g} s); at least {} s are needed: give start_s "
                                "and end_s that are farther apart",
                                end_s - begin_s, begin_s, end_s, kLimits.clocks.shortest_trial_s));
  }
  if (overlap < std::max(kLimits.clocks.shortest_trial_s, kLimits.clocks.covered * (end_s - begin_s))) {
    throw ReadError(file, 0,
                    fmt::format("the {} ({:.5g} to {:.5g} s) covers less than half of the motion ({:.5g} to {:.5g} s); "
                                "are both in seconds, at the rate they were recorded with, on one clock? If so, give "
                                "the trial the start_s and end_s that both have",
                                recorded, first_s, last_s, begin_s, end_s));
  }
  if (!(overlap < end_s - begin_s - kLimits.clocks.uncovered_s)) return std::nullopt;
  return Cover{.begin_s = both.begin_s,
               .end_s = both.end_s,
               .lacks = fmt::format("{}: the {} ({:.5g} to {:.5g} s) lacks {:.3g} s of the motion ({:.5g} to {:.5g} s)",
                                    file.filename().string(), recorded, first_s, last_s, end_s - begin_s - overlap,
                                    begin_s, end_s),
               .as_long = last_s - first_s > end_s - begin_s - kLimits.clocks.uncovered_s};
}

Rows rows_with_emg(const Eigen::VectorXd& motion_s, const Eigen::VectorXd& emg_s) {
  if (motion_s.size() < 2 || emg_s.size() == 0) return {};
  const double spare_s = 0.5 * length_s(motion_s) / static_cast<double>(motion_s.size() - 1);
  Rows rows{.first = 0, .last = motion_s.size() - 1};
  while (rows.first <= rows.last && motion_s[rows.first] < emg_s[0] - spare_s) ++rows.first;
  while (rows.last >= rows.first && motion_s[rows.last] > emg_s[emg_s.size() - 1] + spare_s) --rows.last;
  return rows;
}

std::vector<TrialLengths> lengths_of(const TrialSpec& trial, const TrialInput& input) {
  const Eigen::VectorXd* clock = motion_clock(input);
  if (!input.lengths.empty()) return input.lengths;
  if (trial.given.lengths) return {};  // join_given_clocks compares them
  if (clock == nullptr || trial.start_s || trial.end_s) return {};
  if (trial.use == Use::mvc || trial.use == Use::static_pose) return {};
  const double begin_s = (*clock)[0];
  std::vector<TrialLengths> found;
  const auto add = [&](double first_s, double last_s, double rate_hz, bool of_loads) {
    if (std::abs(first_s - begin_s) > kLimits.clocks.same_begin_s) return;
    found.push_back({.trial = trial.name,
                     .emg_s = last_s - begin_s,
                     .motion_s = length_s(*clock),
                     .motion_rate_hz = static_cast<double>(clock->size() - 1) / length_s(*clock),
                     .emg_rate_hz = rate_hz,
                     .of_loads = of_loads});
  };
  if (input.emg && !input.emg_clock && trial.emg != trial.markers && trial.emg != trial.motion) {
    const Eigen::VectorXd& emg = input.emg->time_s();
    add(emg[0], emg[emg.size() - 1], input.emg->mean_rate_hz(), false);
  }
  if (input.external_torque) {
    const Eigen::VectorXd& torque = input.external_torque->time_s();
    add(torque[0], torque[torque.size() - 1], input.external_torque->mean_rate_hz(), true);
  }
  if (input.loads && trial.external_loads && input.loads->offset_s == 0.0 && input.loads->drift_ppm == 0.0)
    add(input.loads->start_s, input.loads->end_s, input.loads->rate_hz, true);
  return found;
}

std::vector<Remark> unlike_lengths(const std::vector<TrialLengths>& trials) {
  std::vector<Remark> found;
  double least = 1e300;
  double most = 0.0;
  bool all = true;
  std::vector<TrialLengths> of_emg;
  std::ranges::copy_if(trials, std::back_inserter(of_emg), [](const TrialLengths& t) { return !t.of_loads; });
  for (const TrialLengths& t : of_emg) {
    const double ratio = t.emg_s / t.motion_s;
    least = std::min(least, ratio);
    most = std::max(most, ratio);
    if (std::abs(t.emg_s - t.motion_s) < kLimits.clocks.by_hand_s) {
      all = false;
      continue;
    }
    const auto factor = whole_factor(ratio, kLimits.clocks.same_factor);
    if (!factor) continue;
    const bool sure = *factor < 1.0 || std::abs(ratio / *factor - 1.0) < kLimits.clocks.ends_together;
    found.push_back(
        {.code = RemarkCode::emg_length,
         .severity = sure ? Severity::error : Severity::warning,
         .where = t.trial,
         .about = "EMG and motion",
         .says = fmt::format("{}: {} the rate of one of them{} wrong{} {}. If both did last so, give the trial the "
                             "start_s and end_s that both have",
                             lasts(t), sure ? "so" : "is", sure ? " is" : "", sure ? "." : "?", which_rate(t))});
  }
  for (const TrialLengths& t : trials) {
    if (!t.of_loads || std::abs(t.emg_s - t.motion_s) < kLimits.clocks.by_hand_s ||
        !whole_factor(t.emg_s / t.motion_s, kLimits.clocks.same_factor) ||
        std::ranges::any_of(found, [&](const Remark& of_emg_too) { return of_emg_too.where == t.trial; }))
      continue;
    found.push_back(
        {.code = RemarkCode::emg_length,
         .severity = Severity::warning,
         .where = t.trial,
         .about = "loads and motion",
         .says = fmt::format("{}: is the rate of one of them wrong? {}. If both did last so, give the trial "
                             "the start_s and end_s that both have",
                             lasts(t), which_rate(t))});
  }
  if (auto exchanged = exchanged_emg(of_emg); exchanged && found.empty()) found.push_back(std::move(*exchanged));
  if (auto ratio = one_ratio(of_emg); ratio && found.empty()) return {std::move(*ratio)};
  // Recordings stopped by hand differ by some seconds, not by one factor.
  if (of_emg.empty() || !found.empty() || !all || most > (1.0 + kLimits.clocks.same_factor) * least) return found;
  const TrialLengths& first = of_emg.front();
  if (of_emg.size() == 1) {
    // A single trial must be longer by more than a late stop explains.
    if (most < kLimits.clocks.alone_longer) return found;
    found.push_back(
        {.code = RemarkCode::emg_length,
         .severity = Severity::warning,
         .where = first.trial,
         .says = fmt::format("{}: is the rate of one of them wrong? {}. If the EMG did go on, end_s leaves it out",
                             lasts(first), which_rate(first))});
    return found;
  }
  found.push_back({.code = RemarkCode::emg_length,
                   .severity = Severity::warning,
                   .where = "study",
                   .says = fmt::format("in every trial {} (so in '{}'): is a rate wrong? {}", lasts(first), first.trial,
                                       which_rate(first))});
  return found;
}

bool is_rate_wrong(const std::vector<TrialLengths>& of_one_trial) {
  return std::ranges::any_of(unlike_lengths(of_one_trial), [](const Remark& found) {
    return found.severity == Severity::error || found.about == "loads and motion";
  });
}

}  // namespace myoid::study
