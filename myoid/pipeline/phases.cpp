#include "myoid/pipeline/phases.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/math/change_points.h"
#include "myoid/math/statistics.h"
#include "myoid/pipeline/movement_blocks.h"
#include "myoid/pipeline/warm_up.h"

namespace myoid::pipeline {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Eigen::Index kFewestBlocks = 8;
/// Of the means from which the noise is measured: some 8 s, longer than what people vary by from
/// cycle to cycle hangs together.
constexpr Eigen::Index kBatch = 4;

/// Blocks first .. last-1 between two changes, and how they compare with others.
struct Segment {
  std::size_t first = 0, last = 0;
  double gain = 0.0, frequency = kNan;  ///< Means of logarithms.
  double speed = 0.0, torque = 0.0;
  [[nodiscard]] double count() const { return static_cast<double>(last - first); }
};

/// Spread of one block about its neighbors: robust, and never below a percent, which no recording
/// of a person keeps.
double block_sd(const Eigen::VectorXd& x) {
  std::vector<double> differences;
  for (Eigen::Index i = 1; i < x.size(); ++i) differences.push_back(std::abs(x[i] - x[i - 1]));
  return std::max(0.01, 1.4826 * math::median(differences) / std::sqrt(2.0));
}

/// The blocks' frequencies; a block in which no channel was loud enough takes its neighbor's. Empty
/// if more than a fifth of them are such.
Eigen::VectorXd known_frequencies(const std::vector<Block>& blocks) {
  const auto n = static_cast<Eigen::Index>(blocks.size());
  Eigen::VectorXd frequency(n);
  double last = kNan;
  Eigen::Index unknown = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double f = blocks[static_cast<std::size_t>(i)].frequency;
    if (std::isfinite(f)) last = f;
    unknown += std::isfinite(f) ? 0 : 1;
    frequency[i] = last;
  }
  for (Eigen::Index i = n - 2; i >= 0; --i) {
    if (!std::isfinite(frequency[i])) frequency[i] = frequency[i + 1];
  }
  return 5 * unknown > n ? Eigen::VectorXd() : frequency;
}

/// What one block spreads by, alone or as it counts in a mean, whichever is more.
double noise_sd(const Eigen::VectorXd& x) {
  const double long_run = long_run_sd(x, kBatch);
  return std::isfinite(long_run) ? std::max(block_sd(x), long_run) : block_sd(x);
}

struct Changes {
  Eigen::VectorXd gain, frequency;  ///< Per block; the latter empty if not known.
  std::vector<Segment> segments;
  double gain_sd = 0.0, frequency_sd = 0.0;  ///< Of one block.
};

Changes find_changes(const std::vector<Block>& blocks) {
  const auto n = static_cast<Eigen::Index>(blocks.size());
  Changes changes{.gain = Eigen::VectorXd(n), .frequency = known_frequencies(blocks)};
  for (Eigen::Index i = 0; i < n; ++i) changes.gain[i] = blocks[static_cast<std::size_t>(i)].gain;
  const bool frequency_known = changes.frequency.size() > 0;
  Eigen::MatrixXd x(n, frequency_known ? 2 : 1);
  Eigen::VectorXd sd(x.cols());
  x.col(0) = changes.gain;
  sd[0] = changes.gain_sd = noise_sd(changes.gain);
  if (frequency_known) {
    x.col(1) = changes.frequency;
    sd[1] = changes.frequency_sd = noise_sd(changes.frequency);
  }
  const math::ChangePoints found =
      math::change_points(x, {.cost = math::SegmentCost::mean, .min_length = 2, .noise_sd = sd});
  for (const math::Segment& part : found.segments) {
    Segment segment{.first = static_cast<std::size_t>(part.begin),
                    .last = static_cast<std::size_t>(part.end),
                    .gain = part.mean[0],
                    .frequency = frequency_known ? part.mean[1] : kNan};
    for (std::size_t b = segment.first; b < segment.last; ++b) {
      segment.speed += blocks[b].speed / segment.count();
      segment.torque += blocks[b].torque / segment.count();
    }
    changes.segments.push_back(segment);
  }
  return changes;
}

bool alike(double speed, double torque, double other_speed, double other_torque, double factor) {
  const auto within = [&](double a, double b) {
    return std::max(a, b) < factor * std::max(1e-9, std::min(a, b));
  };
  return within(speed, other_speed) && within(torque, other_torque);
}

/// The longest segment; but if torque per EMG and frequency were both higher in earlier ones, the
/// muscles were fresh in those, and the longest is one of tiring: then that with the most torque.
std::size_t regular_segment(const Changes& changes, const PhaseOptions& options) {
  constexpr double kSurely = 3.0;  // standard errors, of either
  const std::vector<Segment>& all = changes.segments;
  const auto longest =
      std::max_element(all.begin(), all.end(),
                       [](const Segment& a, const Segment& b) { return a.count() < b.count(); });
  auto regular = static_cast<std::size_t>(longest - all.begin());
  if (changes.frequency.size() == 0) return regular;
  for (auto segment = all.begin(); segment != longest; ++segment) {
    const double share = std::sqrt(1.0 / segment->count() + 1.0 / longest->count());
    const double gain = segment->gain - longest->gain;
    const double frequency = segment->frequency - longest->frequency;
    if (segment->count() >= static_cast<double>(kBatch) &&
        gain > kSurely * changes.gain_sd * share &&
        frequency > kSurely * changes.frequency_sd * share &&
        alike(segment->speed, segment->torque, longest->speed, longest->torque, options.alike) &&
        segment->gain > all[regular].gain) {
      regular = static_cast<std::size_t>(segment - all.begin());
    }
  }
  return regular;
}

/// A segment against the regular one.
Phase judge(const Segment& segment,
            const Segment& regular,
            const Changes& changes,
            const PhaseOptions& options) {
  Phase phase;
  const double gain = segment.gain - regular.gain;
  const double frequency = segment.frequency - regular.frequency;
  const double share = std::sqrt(1.0 / segment.count() + 1.0 / regular.count());
  phase.gain = std::exp(gain);
  const bool frequency_known = std::isfinite(frequency);
  if (frequency_known) phase.frequency = std::exp(frequency);
  const bool before = segment.first < regular.first;
  const double least = before && gain < 0.0 ? options.warm_up_change : options.gain_change;
  const bool gain_differs = std::abs(gain) > -std::log1p(-least) &&
                            std::abs(gain) > options.significance * changes.gain_sd * share;
  const bool frequency_fell = frequency_known &&
                              -frequency > -std::log1p(-options.frequency_fall) &&
                              -frequency > options.significance * changes.frequency_sd * share;
  const bool same_movement =
      alike(segment.speed, segment.torque, regular.speed, regular.torque, options.alike);
  const std::string numbers = fmt::format(
      "torque per EMG {:+.0f} %{}", 100.0 * std::expm1(gain),
      frequency_known ? fmt::format(", median frequency {:+.0f} %", 100.0 * std::expm1(frequency))
                      : std::string());
  if (!before && gain < 0.0 && gain_differs && same_movement &&
      (frequency_fell || !frequency_known)) {
    phase.kind = PhaseKind::fatigued;
    phase.reason =
        numbers + (frequency_known ? ": the muscles tire"
                                   : ": the muscles tire, by the torque alone (no raw EMG)");
  } else if (before && gain_differs && same_movement && gain > 0.0 && frequency_known &&
             frequency > 2.0 * changes.frequency_sd * share) {
    phase.kind = PhaseKind::regular;
    phase.reason = numbers + ": fresher than in the phase that the others are compared with";
  } else if (before && gain_differs && same_movement &&
             segment.count() >= static_cast<double>(kBatch)) {
    phase.kind = PhaseKind::warm_up;
    phase.reason = numbers + " against the regular phase that follows";
  } else if (gain_differs) {
    phase.kind = PhaseKind::changed;
    phase.reason =
        numbers + (before && same_movement ? ", for too few cycles to be called a warm-up"
                   : same_movement
                       ? ", and the frequency of the EMG does not show fatigue"
                       : ": another movement or load; the law of the muscle may explain it");
  } else {
    phase.kind = PhaseKind::regular;
    phase.reason = frequency_fell ? numbers + ": the frequency fell, the torque did not" : numbers;
  }
  return phase;
}

/// A phase of movement, in blocks.
struct BlockPhase {
  std::size_t first = 0, last = 0;
  Phase phase;
};

/// The first block behind a warm-up, in which the muscles work harder, or less hard, for the same
/// torque than later on, by the EMG or against each other; 0: none. Blocks of another movement,
/// such as one of starting from rest, are passed over.
std::size_t end_of_warm_up(const std::vector<Block>& blocks,
                           const Segment& regular,
                           const PhaseOptions& options,
                           Phase& phase) {
  std::vector<std::size_t> comparable;
  std::vector<double> economy;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (!std::isfinite(blocks[b].economy)) return 0;
    if (!alike(blocks[b].speed, blocks[b].torque, regular.speed, regular.torque, 1.25)) continue;
    comparable.push_back(b);
    economy.push_back(blocks[b].economy);
  }
  const auto found = find_warm_up(
      Eigen::Map<const Eigen::VectorXd>(economy.data(), static_cast<Eigen::Index>(economy.size())),
      -std::log1p(-options.warm_up_change), options.false_alarm);
  if (!found || found->blocks == 0) return 0;
  phase.kind = PhaseKind::warm_up;
  phase.reason = fmt::format(
      "at first {:+.0f} % effort of the muscles for the same torque, by the EMG or against each "
      "other, fading (t = {:.1f}; chance reaches {:.1f} in {:.2g} of trials)",
      100.0 * std::expm1(-found->change), found->t, found->critical, options.false_alarm);
  return comparable[static_cast<std::size_t>(found->blocks)];
}

/// Where tiring goes on through the change, the change has no place of its own: the block from
/// which on torque per EMG is `gain_change` below the regular phase's, on a line through both
/// segments, if that describes them better than the step.
std::size_t begin_of_fatigue(const Segment& before,
                             const Segment& after,
                             const Segment& regular,
                             const Changes& changes,
                             const PhaseOptions& options) {
  const auto first = static_cast<Eigen::Index>(before.first);
  const auto n = static_cast<Eigen::Index>(after.last) - first;
  const Eigen::VectorXd y = changes.gain.segment(first, n);
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1));
  const Eigen::VectorXd centred = (t.array() - t.mean()).matrix();
  const double slope = centred.dot(y) / centred.squaredNorm();
  const double line = (y.array() - y.mean() - slope * centred.array()).square().sum();
  const auto split = static_cast<Eigen::Index>(after.first) - first;
  const double step = (y.head(split).array() - before.gain).square().sum() +
                      (y.tail(n - split).array() - after.gain).square().sum();
  if (line >= step || slope >= 0.0) return after.first;
  const double fallen = regular.gain + std::log1p(-options.gain_change);
  const double place = t.mean() + (fallen - y.mean()) / slope;
  return static_cast<std::size_t>(std::clamp(std::lround(place), 1L, static_cast<long>(n) - 1) +
                                  first);
}

std::vector<BlockPhase> moving_phases(const std::vector<Block>& blocks,
                                      const PhaseOptions& options) {
  const bool known = std::all_of(blocks.begin(), blocks.end(),
                                 [](const Block& b) { return std::isfinite(b.gain); });
  if (static_cast<Eigen::Index>(blocks.size()) < kFewestBlocks || !known) return {};
  const Changes changes = find_changes(blocks);
  const std::size_t regular = regular_segment(changes, options);
  const Segment& reference = changes.segments[regular];
  std::vector<BlockPhase> phases;
  bool tired = false;
  for (std::size_t i = 0; i < changes.segments.size(); ++i) {
    const Segment& segment = changes.segments[i];
    Phase phase = i == regular ? Phase{.kind = PhaseKind::regular,
                                       .gain = 1.0,
                                       .reason = "what the others are compared with"}
                               : judge(segment, reference, changes, options);
    // Tired muscles stay tired until their torque is back.
    if (tired && phase.kind != PhaseKind::fatigued &&
        *phase.gain < 1.0 - 0.5 * options.gain_change) {
      phase.kind = PhaseKind::fatigued;
      phase.reason = "after the muscles have tired, before their torque is back";
    }
    tired = phase.kind == PhaseKind::fatigued;
    phases.push_back({segment.first, segment.last, std::move(phase)});
  }
  for (std::size_t i = phases.size() - 1; i-- > regular;) {
    // Less torque before fatigue is its beginning, even if the frequency had not fallen enough yet.
    const Phase& next = phases[i + 1].phase;
    Phase& here = phases[i].phase;
    if (next.kind == PhaseKind::fatigued && here.kind == PhaseKind::changed && *here.gain < 1.0 &&
        here.frequency && *here.frequency < 1.0) {
      here.kind = PhaseKind::fatigued;
      here.reason = next.reason;
    }
    if (next.kind == PhaseKind::fatigued && here.kind == PhaseKind::regular) {
      phases[i].last = phases[i + 1].first = begin_of_fatigue(
          changes.segments[i], changes.segments[i + 1], reference, changes, options);
    }
  }
  Phase warm_up;
  const std::size_t warm = end_of_warm_up(blocks, reference, options, warm_up);
  const bool known_already =
      phases.front().phase.kind == PhaseKind::warm_up && phases.front().last >= warm;
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

/// A contraction without movement: isometric, and fatigued where torque per EMG and frequency fall
/// within it. Only one whose torque stays much the same is searched, in windows.
std::vector<Phase> isometric_phases(const PhaseSignals& signals,
                                    const TrialStretch& stretch,
                                    const PhaseOptions& options,
                                    const Phase& whole) {
  const std::vector<Block> blocks = blocks_of(signals, stretch, options);
  std::vector<double> torques;
  for (const Block& b : blocks) torques.push_back(b.torque);
  const double middle = math::median(torques);
  const bool even = std::all_of(blocks.begin(), blocks.end(), [&](const Block& b) {
    return alike(b.speed, b.torque, b.speed, middle, options.alike);
  });
  std::vector<Phase> phases{whole};
  if (!even) return phases;
  for (const BlockPhase& found : moving_phases(blocks, options)) {
    const bool tired = found.phase.kind == PhaseKind::fatigued && found.phase.frequency;
    if (tired == (phases.back().kind == PhaseKind::fatigued)) continue;
    Phase next = tired ? found.phase : whole;
    next.begin_s = phases.back().end_s = signals.time_s[blocks[found.first].first];
    next.end_s = whole.end_s;
    phases.push_back(std::move(next));
  }
  return phases;
}

/// The phases of movement within one stretch.
std::vector<Phase> phases_within(const TrialStretch& stretch,
                                 const std::vector<Block>& blocks,
                                 const std::vector<BlockPhase>& moving,
                                 const Eigen::VectorXd& time_s) {
  std::vector<Phase> phases;
  for (const BlockPhase& found : moving) {
    for (std::size_t b = found.first; b < found.last; ++b) {
      if (blocks[b].first < stretch.first || blocks[b].first >= stretch.last) continue;
      phases.push_back(found.phase);
      phases.back().begin_s = time_s[blocks[b].first];
      break;
    }
  }
  if (phases.empty())
    phases.push_back({.kind = PhaseKind::regular, .reason = "too short to search for changes"});
  return phases;
}

void require_valid(const PhaseSignals& s) {
  const Eigen::Index n = s.time_s.size();
  if (n < 2 || s.velocity_radps.size() != n || s.torque_nm.size() != n ||
      s.predicted_nm.size() != n || s.activation.rows() != n ||
      (s.effort_nm.size() != 0 && (s.effort_nm.size() != n || !s.effort_nm.allFinite())) ||
      !s.velocity_radps.allFinite() || !s.torque_nm.allFinite() || !s.predicted_nm.allFinite() ||
      !s.activation.allFinite()) {
    throw InvalidInput(fmt::format(
        "phases of {} samples: rate, torques and activations must be as many and finite", n));
  }
}

}  // namespace

std::string_view name(PhaseKind kind) {
  switch (kind) {
    case PhaseKind::rest:
      return "rest";
    case PhaseKind::isometric:
      return "isometric";
    case PhaseKind::warm_up:
      return "warm_up";
    case PhaseKind::regular:
      return "regular";
    case PhaseKind::fatigued:
      return "fatigued";
    case PhaseKind::changed:
      return "changed";
  }
  return "?";
}

std::vector<Phase> find_phases(const PhaseSignals& signals, const PhaseOptions& options) {
  require_valid(signals);
  const std::vector<TrialStretch> stretches = still_and_moving(signals, options);
  std::vector<Block> blocks;
  for (const TrialStretch& stretch : stretches) {
    if (stretch.still) continue;
    const std::vector<Block> some = blocks_of(signals, stretch, options);
    blocks.insert(blocks.end(), some.begin(), some.end());
  }
  const std::vector<BlockPhase> moving = moving_phases(blocks, options);
  const Eigen::VectorXd& t = signals.time_s;

  std::vector<Phase> phases;
  for (const TrialStretch& stretch : stretches) {
    const double begin_s = t[stretch.first];
    const double end_s = stretch.last < t.size() ? t[stretch.last] : t[t.size() - 1];
    if (stretch.still) {
      const double activation =
          signals.activation.middleRows(stretch.first, stretch.last - stretch.first)
              .colwise()
              .mean()
              .maxCoeff();
      const bool rest = activation < options.rest_activation;
      const Phase whole{
          .kind = rest ? PhaseKind::rest : PhaseKind::isometric,
          .begin_s = begin_s,
          .end_s = end_s,
          .reason = fmt::format("the joint stands still, mean activation {:.3f}", activation)};
      const std::vector<Phase> parts =
          rest ? std::vector{whole} : isometric_phases(signals, stretch, options, whole);
      phases.insert(phases.end(), parts.begin(), parts.end());
      continue;
    }
    std::vector<Phase> parts = phases_within(stretch, blocks, moving, t);
    parts.front().begin_s = begin_s;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      parts[i].end_s = i + 1 < parts.size() ? parts[i + 1].begin_s : end_s;
    }
    phases.insert(phases.end(), parts.begin(), parts.end());
  }
  // Neighbors of one kind that no change worth the name parts are one phase.
  std::vector<Phase> merged;
  for (Phase& phase : phases) {
    const bool joins = !merged.empty() && merged.back().kind == phase.kind &&
                       (phase.kind == PhaseKind::regular || phase.kind == PhaseKind::fatigued);
    if (!joins) {
      merged.push_back(std::move(phase));
      continue;
    }
    Phase& before = merged.back();
    const double a = before.end_s - before.begin_s;
    const double b = phase.end_s - phase.begin_s;
    const auto mean = [&](const std::optional<double>& x, const std::optional<double>& y) {
      return x && y ? std::optional((a * *x + b * *y) / (a + b)) : x ? x : y;
    };
    before.gain = mean(before.gain, phase.gain);
    before.frequency = mean(before.frequency, phase.frequency);
    if (b > a) before.reason = std::move(phase.reason);
    before.end_s = phase.end_s;
  }
  return merged;
}

}  // namespace myoid::pipeline
