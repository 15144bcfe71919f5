#include "myoid/study/phases/moving_phases.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/study/phases/block_segments.h"
#include "myoid/study/phases/warm_up.h"

namespace myoid::study {
namespace {

using namespace phase_limits;

constexpr std::size_t kFewestBlocks = 8;

/// Compares a segment with the regular one.
Phase judge(const Segment& segment, const Segment& regular, const BlockChanges& changes) {
  Phase phase;
  const double gain = segment.gain - regular.gain;
  const double frequency = segment.frequency - regular.frequency;
  const double share = std::sqrt(1.0 / segment.count() + 1.0 / regular.count());
  phase.gain = std::exp(gain);
  const bool frequency_known = std::isfinite(frequency);
  if (frequency_known) phase.frequency = std::exp(frequency);
  const bool before = segment.first < regular.first;
  const double least = before && gain < 0.0 ? kWarmUpChange : kGainChange;
  const bool gain_differs =
      std::abs(gain) > -std::log1p(-least) && std::abs(gain) > kSignificance * changes.gain_sd * share;
  const bool frequency_fell = frequency_known && -frequency > -std::log1p(-kFrequencyFall) &&
                              -frequency > kSignificance * changes.frequency_sd * share;
  const bool same_movement = alike(segment.speed, segment.torque, regular.speed, regular.torque, kAlike);
  const std::string numbers = fmt::format(
      "torque per EMG {:+.0f} %{}", 100.0 * std::expm1(gain),
      frequency_known ? fmt::format(", median frequency {:+.0f} %", 100.0 * std::expm1(frequency)) : std::string());
  if (!before && gain < 0.0 && gain_differs && same_movement && (frequency_fell || !frequency_known)) {
    phase.kind = PhaseKind::fatigued;
    phase.reason =
        numbers + (frequency_known ? ": the muscles tire" : ": the muscles tire, by the torque alone (no raw EMG)");
  } else if (before && gain_differs && same_movement && gain > 0.0 && frequency_known &&
             frequency > 2.0 * changes.frequency_sd * share) {
    phase.kind = PhaseKind::regular;
    phase.reason = numbers + ": fresher than in the phase that the others are compared with";
  } else if (before && gain_differs && same_movement && segment.count() >= static_cast<double>(kBatch)) {
    phase.kind = PhaseKind::warm_up;
    phase.reason = numbers + " against the regular phase that follows";
  } else if (gain_differs) {
    phase.kind = PhaseKind::changed;
    phase.reason = numbers + (before && same_movement ? ", for too few cycles to be called a warm-up"
                              : same_movement         ? ", and the frequency of the EMG does not show fatigue"
                                              : ": another movement or load; the law of the muscle may explain it");
  } else {
    phase.kind = PhaseKind::regular;
    phase.reason = frequency_fell ? numbers + ": the frequency fell, the torque did not" : numbers;
  }
  return phase;
}

/// Returns the first block after a warm-up; 0: there is none. In a warm-up the EMG or the effort of
/// the muscles against each other differs from the later one at the same torque. Blocks of another
/// movement, such as a start from rest, do not count.
std::size_t end_of_warm_up(const std::vector<Block>& blocks, const Segment& regular, Phase& phase) {
  std::vector<std::size_t> comparable;
  std::vector<double> economy;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (!std::isfinite(blocks[b].economy)) return 0;
    if (!alike(blocks[b].speed, blocks[b].torque, regular.speed, regular.torque, 1.25)) continue;
    comparable.push_back(b);
    economy.push_back(blocks[b].economy);
  }
  const auto found =
      find_warm_up(Eigen::Map<const Eigen::VectorXd>(economy.data(), static_cast<Eigen::Index>(economy.size())),
                   -std::log1p(-kWarmUpChange), kFalseAlarm);
  if (!found || found->blocks == 0) return 0;
  phase.kind = PhaseKind::warm_up;
  phase.reason = fmt::format(
      "at first {:+.0f} % effort of the muscles for the same torque, by the EMG or against each other, fading (t = "
      "{:.1f}; chance reaches {:.1f} in {:.2g} of trials)",
      100.0 * std::expm1(-found->change), found->t, found->critical, kFalseAlarm);
  return comparable[static_cast<std::size_t>(found->blocks)];
}

/// Returns the first block of fatigue. Where a line through both segments fits torque per EMG
/// better than a step, fatigue begins where the line is `kGainChange` below the regular phase.
std::size_t begin_of_fatigue(const Segment& before,
                             const Segment& after,
                             const Segment& regular,
                             const BlockChanges& changes) {
  const auto first = static_cast<Eigen::Index>(before.first);
  const auto n = static_cast<Eigen::Index>(after.last) - first;
  const Eigen::VectorXd y = changes.gain.segment(first, n);
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1));
  const Eigen::VectorXd centred = (t.array() - t.mean()).matrix();
  const double slope = centred.dot(y) / centred.squaredNorm();
  const double line = (y.array() - y.mean() - slope * centred.array()).square().sum();
  const auto split = static_cast<Eigen::Index>(after.first) - first;
  const double step =
      (y.head(split).array() - before.gain).square().sum() + (y.tail(n - split).array() - after.gain).square().sum();
  if (line >= step || slope >= 0.0) return after.first;
  const double fallen = regular.gain + std::log1p(-kGainChange);
  const double place = t.mean() + (fallen - y.mean()) / slope;
  return static_cast<std::size_t>(std::clamp(std::lround(place), 1L, static_cast<long>(n) - 1) + first);
}

}  // namespace

std::vector<BlockPhase> moving_phases(const std::vector<Block>& blocks) {
  const bool known = std::all_of(blocks.begin(), blocks.end(), [](const Block& b) { return std::isfinite(b.gain); });
  if (blocks.size() < kFewestBlocks || !known) return {};
  const BlockChanges changes = find_changes(blocks);
  const std::size_t regular = regular_segment(changes);
  const Segment& reference = changes.segments[regular];
  std::vector<BlockPhase> phases;
  bool tired = false;
  for (std::size_t i = 0; i < changes.segments.size(); ++i) {
    const Segment& segment = changes.segments[i];
    Phase phase =
        i == regular
            ? Phase{.kind = PhaseKind::regular, .gain = 1.0, .reason = "the phase that the others are compared with"}
            : judge(segment, reference, changes);
    // Fatigue lasts until torque per EMG has recovered.
    if (tired && phase.kind != PhaseKind::fatigued && *phase.gain < 1.0 - 0.5 * kGainChange) {
      phase.kind = PhaseKind::fatigued;
      phase.reason = "after the muscles have tired, before their torque is back";
    }
    tired = phase.kind == PhaseKind::fatigued;
    phases.push_back({segment.first, segment.last, std::move(phase)});
  }
  for (std::size_t i = phases.size() - 1; i-- > regular;) {
    // Fatigue lowers the torque earlier than the frequency.
    const Phase& next = phases[i + 1].phase;
    Phase& here = phases[i].phase;
    if (next.kind == PhaseKind::fatigued && here.kind == PhaseKind::changed && *here.gain < 1.0 && here.frequency &&
        *here.frequency < 1.0) {
      here.kind = PhaseKind::fatigued;
      here.reason = next.reason;
    }
    if (next.kind == PhaseKind::fatigued && here.kind == PhaseKind::regular) {
      phases[i].last = phases[i + 1].first =
          begin_of_fatigue(changes.segments[i], changes.segments[i + 1], reference, changes);
    }
  }
  Phase warm_up;
  const std::size_t warm = end_of_warm_up(blocks, reference, warm_up);
  const bool known_already = phases.front().phase.kind == PhaseKind::warm_up && phases.front().last >= warm;
  if (warm > 0 && warm < reference.last && !known_already) {
    const auto count = static_cast<Eigen::Index>(warm);
    warm_up.gain = std::exp(changes.gain.head(count).mean() - reference.gain);
    if (changes.frequency.size() > 0)
      warm_up.frequency = std::exp(changes.frequency.head(count).mean() - reference.frequency);
    while (phases.front().last <= warm) phases.erase(phases.begin());
    phases.front().first = warm;
    phases.insert(phases.begin(), {0, warm, std::move(warm_up)});
  }
  return phases;
}

}  // namespace myoid::study
