#include "myoid/study/phases/movement_blocks.h"

#include <algorithm>
#include <cmath>

#include "myoid/ground/core/numbers.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::study {
namespace {

using namespace phase_limits;

double mean_interval(const Eigen::VectorXd& time_s) {
  return (time_s[time_s.size() - 1] - time_s[0]) / static_cast<double>(time_s.size() - 1);
}

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

/// Returns the samples of a stretch at which the joint turns from falling to rising, with at least
/// a third of its usual rate before and after.
std::vector<Eigen::Index> lower_turns(const PhaseSignals& s, const TrialStretch& stretch) {
  const Eigen::Index n = stretch.last - stretch.first;
  const double least =
      std::sqrt(s.velocity_radps.segment(stretch.first, n).squaredNorm() / static_cast<double>(n)) / 3.0;
  std::vector<Eigen::Index> turns;
  bool falling = false;
  Eigen::Index turn = stretch.first;
  for (Eigen::Index i = stretch.first; i < stretch.last; ++i) {
    const double v = s.velocity_radps[i];
    if (v < 0.0) turn = i + 1;
    if (v < -least) falling = true;
    if (v > least && falling) {
      turns.push_back(turn);
      falling = false;
    }
  }
  return turns;
}

}  // namespace

std::vector<TrialStretch> still_and_moving(const PhaseSignals& s) {
  const Eigen::Index n = s.time_s.size();
  const auto half = static_cast<Eigen::Index>(std::lround(0.5 / mean_interval(s.time_s)));
  Eigen::VectorXd squares(n + 1);
  squares[0] = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    squares[i + 1] = squares[i] + s.velocity_radps[i] * s.velocity_radps[i];
  }
  std::vector<TrialStretch> all;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index a = std::max<Eigen::Index>(0, i - half);
    const Eigen::Index b = std::min(n, i + half + 1);
    const double rms = std::sqrt((squares[b] - squares[a]) / static_cast<double>(b - a));
    const bool still = rms < kStill_radps;
    if (all.empty() || all.back().still != still) all.push_back({i, i, still});
    all.back().last = i + 1;
  }
  // A short stop between two movements is a part of them.
  std::vector<TrialStretch> merged;
  for (TrialStretch stretch : all) {
    const double long_s = s.time_s[stretch.last - 1] - s.time_s[stretch.first];
    if (stretch.still && long_s < kShortest_s) stretch.still = false;
    if (!merged.empty() && merged.back().still == stretch.still) {
      merged.back().last = stretch.last;
    } else {
      merged.push_back(stretch);
    }
  }
  return merged;
}

std::vector<Block> blocks_of(const PhaseSignals& s, const TrialStretch& stretch) {
  const double dt = mean_interval(s.time_s);
  const auto shortest = std::max<Eigen::Index>(2, std::lround(kBlock_s / dt));
  const std::vector<Eigen::Index> turns = stretch.still ? std::vector<Eigen::Index>() : lower_turns(s, stretch);
  std::vector<Block> blocks;
  Eigen::Index begin = stretch.first;
  while (begin + shortest <= stretch.last) {
    // The time of a turn is known to about a tenth of a cycle; a block may be shorter by that.
    const auto turn = std::lower_bound(turns.begin(), turns.end(), begin + shortest - shortest / 10);
    const bool turns_in_time = turn != turns.end() && *turn <= begin + 2 * shortest;
    Block block{.first = begin, .last = turns_in_time ? *turn : begin + shortest};
    const Eigen::Index m = block.last - block.first;
    const auto count = static_cast<double>(m);
    const auto predicted = s.predicted_nm.segment(block.first, m);
    const auto measured = s.torque_nm.segment(block.first, m);
    const double gain = measured.dot(predicted) / predicted.squaredNorm();
    if (gain > 0.0) block.gain = std::log(gain);
    block.frequency = mean_log_frequency(s.median_frequency_hz, s.time_s[block.first], s.time_s[block.last - 1]);
    block.speed = std::max(kStill_radps, std::sqrt(s.velocity_radps.segment(block.first, m).squaredNorm() / count));
    block.torque = measured.norm() / std::sqrt(count);
    blocks.push_back(block);
    begin = block.last;
  }
  return blocks;
}

double long_run_sd(const Eigen::VectorXd& x, Eigen::Index batch) {
  const Eigen::Index count = x.size() / batch;
  if (count < 4) return kNan;
  Eigen::VectorXd mean(count);
  for (Eigen::Index j = 0; j < count; ++j) mean[j] = x.segment(j * batch, batch).mean();
  const Eigen::VectorXd second = mean.head(count - 2) - 2.0 * mean.segment(1, count - 2) +
                                 mean.tail(count - 2);  // x[i] - 2 x[i+1] + x[i+2] has six times the variance
  return std::sqrt(second.squaredNorm() / static_cast<double>(count - 2) / 6.0 * static_cast<double>(batch));
}

}  // namespace myoid::study
