#include "myoid/study/phases/find_phases.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/study/phases/fatigue_trend.h"

namespace myoid::study {
namespace {

using namespace phase_limits;

/// Returns the sentence of a fatigued phase.
std::string reason_of(const FatigueTrend& fatigue) {
  const std::string torque = fmt::format("torque per EMG {:+.0f} %", 100.0 * (fatigue.gain - 1.0));
  return fatigue.frequency ? fmt::format("{}, median frequency {:+.0f} %: the muscles tire", torque,
                                         100.0 * (*fatigue.frequency - 1.0))
                           : torque + ": the muscles tire, by the torque alone (no raw EMG)";
}

/// Returns `whole`, or its part before the tired blocks and the fatigued phase after it.
std::vector<Phase> divided(Phase whole, const FatigueTrend& fatigue, double begin_s) {
  Phase tired{.kind = PhaseKind::fatigued,
              .begin_s = std::max(begin_s, whole.begin_s),
              .end_s = whole.end_s,
              .gain = fatigue.gain,
              .frequency = fatigue.frequency,
              .reason = reason_of(fatigue)};
  if (tired.begin_s >= whole.end_s) return {std::move(whole)};
  if (tired.begin_s <= whole.begin_s) return {std::move(tired)};
  whole.end_s = tired.begin_s;
  return {std::move(whole), std::move(tired)};
}

void require_valid(const PhaseSignals& s) {
  const Eigen::Index n = s.time_s.size();
  if (n < 2 || s.velocity_radps.size() != n || s.torque_nm.size() != n || s.predicted_nm.size() != n ||
      s.activation.rows() != n || !s.velocity_radps.allFinite() || !s.torque_nm.allFinite() ||
      !s.predicted_nm.allFinite() || !s.activation.allFinite()) {
    throw InvalidInput("phases of {} samples: rate, torques and activations must be as many and finite", n);
  }
}

/// Returns rest, or an isometric contraction, of which muscles may tire: torque per EMG and frequency fall. A
/// contraction with a varying torque stays one phase.
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
  const std::vector<Block> blocks = rest ? std::vector<Block>() : blocks_of(signals, stretch);
  if (usual_blocks(blocks).size() < blocks.size()) return {whole};
  const std::optional<FatigueTrend> fatigue = find_fatigue(blocks);
  if (!fatigue || !fatigue->frequency) return {whole};
  return divided(whole, *fatigue, signals.time_s[blocks[fatigue->first].first]);
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
  const std::optional<FatigueTrend> fatigue = find_fatigue(blocks);
  const Eigen::VectorXd& t = signals.time_s;

  std::vector<Phase> phases;
  for (const TrialStretch& stretch : stretches) {
    const double begin_s = t[stretch.first];
    const double end_s = stretch.last < t.size() ? t[stretch.last] : t[t.size() - 1];
    std::vector<Phase> parts;
    if (stretch.still) {
      parts = still_phases(signals, stretch, begin_s, end_s);
    } else {
      Phase regular{.kind = PhaseKind::regular, .begin_s = begin_s, .end_s = end_s};
      regular.reason = fatigue                         ? "before the muscles tire"
                       : blocks.size() < kFewestBlocks ? "too short to search for changes"
                                                       : "the muscles do not tire";
      parts = fatigue ? divided(regular, *fatigue, t[blocks[fatigue->first].first]) : std::vector{regular};
    }
    phases.insert(phases.end(), parts.begin(), parts.end());
  }
  return phases;
}

}  // namespace myoid::study
