#include "myoid/pipeline/phases.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/math/change_points.h"
#include "myoid/math/statistics.h"

namespace myoid::pipeline {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Eigen::Index kFewestBlocks = 8;

/// Samples first .. last-1.
struct Stretch {
  Eigen::Index first = 0, last = 0;
  bool still = false;
};

double mean_interval(const Eigen::VectorXd& time_s) {
  return (time_s[time_s.size() - 1] - time_s[0]) / static_cast<double>(time_s.size() - 1);
}

/// Stretches of standing still and of movement, in turn.
std::vector<Stretch> still_and_moving(const PhaseSignals& s, const PhaseOptions& options) {
  const Eigen::Index n = s.time_s.size();
  const auto half = static_cast<Eigen::Index>(std::lround(0.5 / mean_interval(s.time_s)));
  Eigen::VectorXd squares(n + 1);
  squares[0] = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    squares[i + 1] = squares[i] + s.velocity_radps[i] * s.velocity_radps[i];
  }
  std::vector<Stretch> all;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index a = std::max<Eigen::Index>(0, i - half);
    const Eigen::Index b = std::min(n, i + half + 1);
    const double rms = std::sqrt((squares[b] - squares[a]) / static_cast<double>(b - a));
    const bool still = rms < options.still_radps;
    if (all.empty() || all.back().still != still) all.push_back({i, i, still});
    all.back().last = i + 1;
  }
  // A short stop between two movements is a part of them.
  std::vector<Stretch> merged;
  for (Stretch stretch : all) {
    const double long_s = s.time_s[stretch.last - 1] - s.time_s[stretch.first];
    if (stretch.still && long_s < options.shortest_s) stretch.still = false;
    if (!merged.empty() && merged.back().still == stretch.still) {
      merged.back().last = stretch.last;
    } else {
      merged.push_back(stretch);
    }
  }
  return merged;
}

/// A block of movement, long enough to tell how much torque the EMG is worth.
struct Block {
  Eigen::Index first = 0, last = 0;
  double gain = kNan;       ///< Regression of measured on predicted torque through the origin.
  double frequency = kNan;  ///< Mean over channels of the logarithm of the median frequency.
  double speed = 0.0, torque = 0.0;  ///< Root mean squares.
};

double mean_log_frequency(const TimeSeries& median, double begin_s, double end_s) {
  double sum = 0.0;
  int count = 0;
  for (Eigen::Index c = 0; c < median.channel_count(); ++c) {
    std::vector<double> known;
    for (const double f : median.values().col(c)) {
      if (std::isfinite(f)) known.push_back(std::log(f));
    }
    const double whole = math::median(std::move(known));
    for (Eigen::Index w = 0; w < median.sample_count(); ++w) {
      const double f = median.values()(w, c);
      const double t = median.time_s()[w];
      if (!std::isfinite(f) || t < begin_s || t > end_s) continue;
      sum += std::log(f) - whole;  // channels that are known in different blocks are comparable
      ++count;
    }
  }
  return count > 0 ? sum / count : kNan;
}

std::vector<Block> blocks_of(const PhaseSignals& s,
                             const std::vector<Stretch>& stretches,
                             const PhaseOptions& options) {
  std::vector<Block> blocks;
  for (const Stretch& stretch : stretches) {
    if (stretch.still) continue;
    const double span = s.time_s[stretch.last - 1] - s.time_s[stretch.first];
    const auto count = static_cast<Eigen::Index>(std::floor(span / options.block_s + 1e-9));
    for (Eigen::Index k = 0; k < count; ++k) {
      const Eigen::Index length = stretch.last - stretch.first;
      Block block{.first = stretch.first + k * length / count,
                  .last = stretch.first + (k + 1) * length / count};
      const Eigen::Index m = block.last - block.first;
      const auto predicted = s.predicted_nm.segment(block.first, m);
      const auto measured = s.torque_nm.segment(block.first, m);
      if (predicted.squaredNorm() > 0.0)
        block.gain = measured.dot(predicted) / predicted.squaredNorm();
      block.frequency = mean_log_frequency(s.median_frequency_hz, s.time_s[block.first],
                                           s.time_s[block.last - 1]);
      block.speed = std::sqrt(s.velocity_radps.segment(block.first, m).squaredNorm() /
                              static_cast<double>(m));
      block.torque = std::sqrt(measured.squaredNorm() / static_cast<double>(m));
      blocks.push_back(block);
    }
  }
  return blocks;
}

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

struct Changes {
  std::vector<Segment> segments;
  double gain_sd = 0.0, frequency_sd = 0.0;  ///< Of one block.
};

Changes find_changes(const std::vector<Block>& blocks) {
  const auto n = static_cast<Eigen::Index>(blocks.size());
  Eigen::VectorXd gain(n), frequency(n);
  bool frequency_known = true;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Block& block = blocks[static_cast<std::size_t>(i)];
    gain[i] = std::log(std::clamp(block.gain, 0.05, 20.0));
    frequency[i] = block.frequency;
    frequency_known = frequency_known && std::isfinite(block.frequency);
  }
  Changes changes{.segments = {}, .gain_sd = block_sd(gain), .frequency_sd = 0.0};
  Eigen::MatrixXd x(n, frequency_known ? 2 : 1);
  Eigen::VectorXd sd(x.cols());
  x.col(0) = gain;
  sd[0] = changes.gain_sd;
  if (frequency_known) {
    x.col(1) = frequency;
    sd[1] = changes.frequency_sd = block_sd(frequency);
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
  const double least = before ? options.warm_up_change : options.gain_change;
  const bool gain_differs = std::abs(gain) > -std::log1p(-least) &&
                            std::abs(gain) > options.significance * changes.gain_sd * share;
  const bool frequency_fell = frequency_known &&
                              -frequency > -std::log1p(-options.frequency_fall) &&
                              -frequency > options.significance * changes.frequency_sd * share;
  const auto factor = [](double a, double b) {
    return std::max(a, b) / std::max(1e-9, std::min(a, b));
  };
  const bool alike = factor(segment.speed, regular.speed) < options.alike &&
                     factor(segment.torque, regular.torque) < options.alike;
  const std::string numbers = fmt::format(
      "torque per EMG {:+.0f} %{}", 100.0 * std::expm1(gain),
      frequency_known ? fmt::format(", median frequency {:+.0f} %", 100.0 * std::expm1(frequency))
                      : std::string());
  if (!before && gain < 0.0 && gain_differs && alike && (frequency_fell || !frequency_known)) {
    phase.kind = PhaseKind::fatigued;
    phase.reason =
        numbers + (frequency_known ? ": the muscles tire"
                                   : ": the muscles tire, by the torque alone (no raw EMG)");
  } else if (before && gain_differs && alike) {
    phase.kind = PhaseKind::warm_up;
    phase.reason = numbers + " against the regular phase that follows";
  } else if (gain_differs) {
    phase.kind = PhaseKind::changed;
    phase.reason =
        numbers + (alike ? ", and the frequency of the EMG does not show fatigue"
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

std::vector<BlockPhase> moving_phases(const std::vector<Block>& blocks,
                                      const PhaseOptions& options) {
  const bool known = std::all_of(blocks.begin(), blocks.end(),
                                 [](const Block& b) { return std::isfinite(b.gain); });
  if (static_cast<Eigen::Index>(blocks.size()) < kFewestBlocks || !known) return {};
  const Changes changes = find_changes(blocks);
  const Segment& regular =
      *std::max_element(changes.segments.begin(), changes.segments.end(),
                        [](const Segment& a, const Segment& b) { return a.count() < b.count(); });
  std::vector<BlockPhase> phases;
  bool tired = false;
  for (const Segment& segment : changes.segments) {
    Phase phase = &segment == &regular ? Phase{.kind = PhaseKind::regular,
                                               .gain = 1.0,
                                               .reason = "the longest phase without a change"}
                                       : judge(segment, regular, changes, options);
    // Tired muscles stay tired until their torque is back.
    if (tired && phase.kind != PhaseKind::fatigued &&
        *phase.gain < 1.0 - 0.5 * options.gain_change) {
      phase.kind = PhaseKind::fatigued;
      phase.reason = "after the muscles have tired, before their torque is back";
    }
    tired = phase.kind == PhaseKind::fatigued;
    phases.push_back({segment.first, segment.last, std::move(phase)});
  }
  return phases;
}

/// The phases of movement within one stretch.
std::vector<Phase> phases_within(const Stretch& stretch,
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
      s.predicted_nm.size() != n || s.activation.rows() != n || !s.velocity_radps.allFinite() ||
      !s.torque_nm.allFinite() || !s.predicted_nm.allFinite() || !s.activation.allFinite()) {
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
  const std::vector<Stretch> stretches = still_and_moving(signals, options);
  const std::vector<Block> blocks = blocks_of(signals, stretches, options);
  const std::vector<BlockPhase> moving = moving_phases(blocks, options);
  const Eigen::VectorXd& t = signals.time_s;

  std::vector<Phase> phases;
  for (const Stretch& stretch : stretches) {
    const double begin_s = t[stretch.first];
    const double end_s = stretch.last < t.size() ? t[stretch.last] : t[t.size() - 1];
    if (stretch.still) {
      const double activation =
          signals.activation.middleRows(stretch.first, stretch.last - stretch.first)
              .colwise()
              .mean()
              .maxCoeff();
      const bool rest = activation < options.rest_activation;
      phases.push_back(
          {.kind = rest ? PhaseKind::rest : PhaseKind::isometric,
           .begin_s = begin_s,
           .end_s = end_s,
           .reason = fmt::format("the joint stands still, mean activation {:.3f}", activation)});
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
