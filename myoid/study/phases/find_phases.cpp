#include "myoid/study/phases/find_phases.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/study/phases/block_segments.h"
#include "myoid/study/phases/movement_blocks.h"
#include "myoid/study/phases/moving_phases.h"

namespace myoid::study {
namespace {

using namespace phase_limits;

/// Divides a contraction without movement into isometric and fatigued phases: fatigue lowers torque
/// per EMG and frequency. A contraction with a varying torque stays one phase.
std::vector<Phase> isometric_phases(const PhaseSignals& signals, const TrialStretch& stretch, const Phase& whole) {
  const std::vector<Block> blocks = blocks_of(signals, stretch);
  std::vector<double> torques;
  for (const Block& b : blocks) torques.push_back(b.torque);
  const double middle = math::median(torques);
  const bool even = std::all_of(blocks.begin(), blocks.end(),
                                [&](const Block& b) { return alike(b.speed, b.torque, b.speed, middle, kAlike); });
  std::vector<Phase> phases{whole};
  if (!even) return phases;
  for (const BlockPhase& found : moving_phases(blocks)) {
    const bool tired = found.phase.kind == PhaseKind::fatigued && found.phase.frequency;
    if (tired == (phases.back().kind == PhaseKind::fatigued)) continue;
    Phase next = tired ? found.phase : whole;
    next.begin_s = phases.back().end_s = signals.time_s[blocks[found.first].first];
    next.end_s = whole.end_s;
    phases.push_back(std::move(next));
  }
  return phases;
}

/// Returns the phases of movement within one stretch.
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
  if (phases.empty()) phases.push_back({.kind = PhaseKind::regular, .reason = "too short to search for changes"});
  return phases;
}

void require_valid(const PhaseSignals& s) {
  const Eigen::Index n = s.time_s.size();
  if (n < 2 || s.velocity_radps.size() != n || s.torque_nm.size() != n || s.predicted_nm.size() != n ||
      s.activation.rows() != n || (s.effort_nm.size() != 0 && (s.effort_nm.size() != n || !s.effort_nm.allFinite())) ||
      !s.velocity_radps.allFinite() || !s.torque_nm.allFinite() || !s.predicted_nm.allFinite() ||
      !s.activation.allFinite()) {
    throw InvalidInput("phases of {} samples: rate, torques and activations must be as many and finite", n);
  }
}

/// Returns rest, or an isometric contraction with its parts.
std::vector<Phase> still_phases(const PhaseSignals& signals,
                                const TrialStretch& stretch,
                                double begin_s,
                                double end_s) {
  const double activation =
      signals.activation.middleRows(stretch.first, stretch.last - stretch.first).colwise().mean().maxCoeff();
  const bool rest = activation < kRestActivation;
  const Phase whole{.kind = rest ? PhaseKind::rest : PhaseKind::isometric,
                    .begin_s = begin_s,
                    .end_s = end_s,
                    .reason = fmt::format("the joint stands still, mean activation {:.3f}", activation)};
  return rest ? std::vector{whole} : isometric_phases(signals, stretch, whole);
}

/// Joins two phases; the means of gain and frequency are weighted by duration.
Phase joined(Phase first, const Phase& second) {
  const double a = first.end_s - first.begin_s;
  const double b = second.end_s - second.begin_s;
  const auto mean = [&](const std::optional<double>& x, const std::optional<double>& y) {
    return x && y ? std::optional((a * *x + b * *y) / (a + b)) : x ? x : y;
  };
  first.gain = mean(first.gain, second.gain);
  first.frequency = mean(first.frequency, second.frequency);
  if (b > a) first.reason = second.reason;
  first.end_s = second.end_s;
  return first;
}

/// Joins neighbors that are both regular or both fatigued.
std::vector<Phase> merge_alike(std::vector<Phase> phases) {
  std::vector<Phase> result;
  for (Phase& phase : phases) {
    const bool joins = !result.empty() && result.back().kind == phase.kind &&
                       (phase.kind == PhaseKind::regular || phase.kind == PhaseKind::fatigued);
    if (joins) {
      result.back() = joined(std::move(result.back()), phase);
    } else {
      result.push_back(std::move(phase));
    }
  }
  return result;
}

}  // namespace

std::vector<Phase> find_phases(const PhaseSignals& signals) {
  require_valid(signals);
  const std::vector<TrialStretch> stretches = still_and_moving(signals);
  std::vector<Block> blocks;
  for (const TrialStretch& stretch : stretches) {
    if (stretch.still) continue;
    const std::vector<Block> some = blocks_of(signals, stretch);
    blocks.insert(blocks.end(), some.begin(), some.end());
  }
  const std::vector<BlockPhase> moving = moving_phases(blocks);
  const Eigen::VectorXd& t = signals.time_s;

  std::vector<Phase> phases;
  for (const TrialStretch& stretch : stretches) {
    const double begin_s = t[stretch.first];
    const double end_s = stretch.last < t.size() ? t[stretch.last] : t[t.size() - 1];
    std::vector<Phase> parts =
        stretch.still ? still_phases(signals, stretch, begin_s, end_s) : phases_within(stretch, blocks, moving, t);
    if (!stretch.still) {
      parts.front().begin_s = begin_s;
      for (std::size_t i = 0; i < parts.size(); ++i)
        parts[i].end_s = i + 1 < parts.size() ? parts[i + 1].begin_s : end_s;
    }
    phases.insert(phases.end(), parts.begin(), parts.end());
  }
  return merge_alike(std::move(phases));
}

}  // namespace myoid::study
