#include "myoid/study/checks/same_recording.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include <fmt/format.h>

#include "myoid/study/intake/limits.h"
#include "myoid/study/intake/trial_quality.h"

namespace myoid::study {
namespace {

constexpr Eigen::Index kStretch = 32;
constexpr std::uint64_t kOneIn = 4;
constexpr std::size_t kFewestStretches = 8;  ///< fewer stretches allow no comparison
/// Share of the shorter recording that adjacent windows of one file may have in common.
constexpr double kEdges = kLimits.clocks.same_samples;

/// Returns the finalizer of SplitMix64 (Steele, Lea and Flood 2014).
std::uint64_t mixed(std::uint64_t x) {
  x ^= x >> 30U;
  x *= 0xbf58476d1ce4e5b9U;
  x ^= x >> 27U;
  x *= 0x94d049bb133111ebU;
  return x ^ (x >> 31U);
}

std::uint64_t power(std::uint64_t base, Eigen::Index exponent) {
  std::uint64_t result = 1;
  for (Eigen::Index i = 0; i < exponent; ++i) result *= base;
  return result;
}

bool counts(Use use) { return use == Use::calibration || use == Use::validation || use == Use::isometric; }

std::string of(const std::string& file) { return file.empty() ? "" : fmt::format(" ({})", file); }

}  // namespace

Stretches stretches_of(const TimeSeries& series) {
  constexpr std::uint64_t kBase = 0x9e3779b97f4a7c15U;
  const std::uint64_t oldest = power(kBase, kStretch - 1);
  const Eigen::MatrixXd& x = series.values();
  std::vector<std::uint64_t> rows(static_cast<std::size_t>(x.rows()), 0);
  Stretches found;
  std::uint64_t rolling = 0;
  Eigen::Index unchanged = 0;
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    for (Eigen::Index c = 0; c < x.cols(); ++c)
      rows[row] = mixed(rows[row] * kBase + std::bit_cast<std::uint64_t>(x(i, c)));
    unchanged = i > 0 && rows[row] == rows[row - 1] ? unchanged + 1 : 0;
    if (i >= kStretch) rolling -= oldest * rows[row - static_cast<std::size_t>(kStretch)];
    rolling = rolling * kBase + rows[row];
    if (i + 1 < kStretch || unchanged + 1 >= kStretch) continue;
    const std::uint64_t hash = mixed(rolling);
    if (hash % kOneIn == 0) found.push_back(hash);
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

double common_share(const Stretches& a, const Stretches& b) {
  const std::size_t fewer = std::min(a.size(), b.size());
  if (fewer < kFewestStretches) return 0.0;
  Stretches both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return static_cast<double>(both.size()) / static_cast<double>(fewer);
}

TrialPrint print_of(const TrialSpec& spec, const TrialInput& input) {
  TrialPrint print{.trial = spec.name, .use = spec.use, .emg_file = {}, .motion_file = {}, .emg = {}, .movement = {}};
  const TimeSeries movement = input.given.lengths ? *input.given.lengths : movement_of(input);
  if (!movement.empty()) print.movement = stretches_of(movement);
  if (input.emg) {
    // The EMG before the movement, which the delay requires, belongs to the previous trial.
    const double begin_s = movement.empty() ? input.emg->time_s()[0] : movement.time_s()[0];
    print.emg = stretches_of(input.emg->slice(begin_s, 1e300));
  }
  if (spec.emg) print.emg_file = spec.emg->filename().string();
  if (spec.given.lengths) print.motion_file = spec.given.lengths->filename().string();
  if (spec.motion) print.motion_file = spec.motion->filename().string();
  if (spec.markers) print.motion_file = spec.markers->filename().string();
  return print;
}

std::vector<Remark> same_recordings(const std::vector<TrialPrint>& trials) {
  std::vector<Remark> findings;
  for (std::size_t j = 0; j < trials.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const TrialPrint& a = trials[i];
      const TrialPrint& b = trials[j];
      const double emg = common_share(a.emg, b.emg);
      const double movement = common_share(a.movement, b.movement);
      const bool both_count = counts(a.use) && counts(b.use);
      const auto add = [&](Severity severity, std::string text) {
        findings.push_back(
            {.code = RemarkCode::same_recording, .severity = severity, .where = b.trial, .says = std::move(text)});
      };
      if (emg > kEdges && movement > kEdges) {
        if (both_count)
          add(Severity::error,
              fmt::format(
                  "{:.0f} % of its EMG{} and of its motion are those of trial '{}': one effort would count twice; name "
                  "each recording once, or give the two trials windows (start_s, end_s) that do not overlap",
                  100.0 * emg, of(b.emg_file), a.trial));
      } else if (emg > kEdges) {
        if (both_count) {
          add(Severity::error, fmt::format("{:.0f} % of its EMG{} is the EMG of trial '{}'{}, but its motion is "
                                           "another: one of the two names the wrong file; correct its emg",
                                           100.0 * emg, of(b.emg_file), a.trial, of(a.emg_file)));
        } else if (counts(a.use) != counts(b.use)) {
          add(Severity::warning,
              fmt::format("{:.0f} % of its EMG{} is the EMG of trial '{}': is one of the two file names a slip? A "
                          "trial that is its own maximal contraction sets 1 to its own largest effort",
                          100.0 * emg, of(b.emg_file), a.trial));
        }
      } else if (movement > kEdges && both_count && !a.emg.empty() && !b.emg.empty()) {
        add(Severity::warning, fmt::format("{:.0f} % of its motion{} is the motion of trial '{}', but its EMG is "
                                           "another: was one of the two files named by mistake?",
                                           100.0 * movement, of(b.motion_file), a.trial));
      }
    }
  }
  return findings;
}

}  // namespace myoid::study
