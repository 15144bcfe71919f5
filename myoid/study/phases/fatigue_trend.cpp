#include "myoid/study/phases/fatigue_trend.h"

#include <algorithm>
#include <cmath>

#include "myoid/ground/core/numbers.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::study {
namespace {

using namespace phase_limits;

/// Blocks in a mean by which the noise is measured: some 8 s, longer than the correlation of a person's variation from
/// cycle to cycle. As many blocks are fresh, and as many tired.
constexpr Eigen::Index kBatch = 4;

/// Returns the robust spread of one block about its neighbors, at least one percent, because people vary more.
double block_sd(const Eigen::VectorXd& x) {
  std::vector<double> differences;
  for (Eigen::Index i = 1; i < x.size(); ++i) differences.push_back(std::abs(x[i] - x[i - 1]));
  return std::max(0.01, 1.4826 * math::median(differences) / std::sqrt(2.0));
}

/// Returns the frequencies of these blocks. A block without a channel of sufficient amplitude takes the value of its
/// neighbor. Empty if more than a fifth of the blocks have no such channel.
Eigen::VectorXd known_frequencies(const std::vector<Block>& blocks, const std::vector<std::size_t>& usual) {
  const auto n = static_cast<Eigen::Index>(usual.size());
  Eigen::VectorXd frequency(n);
  double last = kNan;
  Eigen::Index unknown = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double f = blocks[usual[static_cast<std::size_t>(i)]].frequency;
    if (std::isfinite(f)) last = f;
    unknown += std::isfinite(f) ? 0 : 1;
    frequency[i] = last;
  }
  for (Eigen::Index i = n - 2; i >= 0; --i) {
    if (!std::isfinite(frequency[i])) frequency[i] = frequency[i + 1];
  }
  return 5 * unknown > n ? Eigen::VectorXd() : frequency;
}

/// The least-squares line y = fresh - b s over a shape s of n blocks.
struct Line {
  double fresh = 0.0, fall = 0.0;  ///< At s = 0, and from there to the last block.
  double per_shape_sd = 0.0;       ///< Standard error of `fall` for a noise of 1.
  Eigen::VectorXd rest;

  Line(const Eigen::VectorXd& y, const Eigen::VectorXd& shape) {
    const double last = shape[shape.size() - 1];
    const Eigen::VectorXd centred = shape.array() - shape.mean();
    const double squares = centred.squaredNorm(), slope = -centred.dot(y) / squares;
    fresh = y.mean() + slope * shape.mean();
    fall = slope * last;
    per_shape_sd = last / std::sqrt(squares);
    rest = y.array() - fresh + slope * shape.array();
  }
  /// Returns true for a fall of at least this share, and of kSignificance standard errors.
  [[nodiscard]] bool falls_by(double share, double neighbors_sd) const {
    const double about_trend = std::sqrt(rest.squaredNorm() / static_cast<double>(rest.size() - 2));
    const double long_run = long_run_sd(rest, kBatch);
    const double sd = std::max({neighbors_sd, about_trend, std::isfinite(long_run) ? long_run : 0.0});
    return fall > -std::log1p(-share) && fall > kSignificance * sd * per_shape_sd;
  }
};

/// Returns s(k - c) of n blocks: from 0 to `width`.
Eigen::VectorXd shape_of(Eigen::Index n, Eigen::Index c, Eigen::Index width) {
  const Eigen::ArrayXd k = Eigen::ArrayXd::LinSpaced(n, 0.0, static_cast<double>(n - 1)) - static_cast<double>(c);
  return k.max(0.0).min(static_cast<double>(width));
}

/// Returns the shape with the least sum of squares of torque per EMG and frequency, each over its noise.
Eigen::VectorXd nearest_shape(const Eigen::VectorXd& gain,
                              double gain_sd,
                              const Eigen::VectorXd& frequency,
                              double frequency_sd) {
  const Eigen::Index n = gain.size();
  Eigen::VectorXd nearest;
  double least = kInfinity;
  for (Eigen::Index width = 1; width < 2 * n; width *= 2) {
    for (Eigen::Index c = width < kBatch ? kBatch - 1 : 0; c < n - kBatch; ++c) {
      const Eigen::VectorXd shape = shape_of(n, c, width);
      double squares = Line(gain, shape).rest.squaredNorm() / (gain_sd * gain_sd);
      if (frequency.size() > 0) squares += Line(frequency, shape).rest.squaredNorm() / (frequency_sd * frequency_sd);
      if (!(squares < least)) continue;
      least = squares;
      nearest = shape;
    }
  }
  return nearest;
}

}  // namespace

std::vector<std::size_t> usual_blocks(const std::vector<Block>& blocks) {
  std::vector<double> speeds, torques;
  for (const Block& b : blocks) {
    speeds.push_back(b.speed);
    torques.push_back(b.torque);
  }
  const double speed = math::median(std::move(speeds)), torque = math::median(std::move(torques));
  const auto within = [](double a, double b) { return std::max(a, b) < kAlike * std::max(1e-9, std::min(a, b)); };
  std::vector<std::size_t> usual;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    if (within(blocks[b].speed, speed) && within(blocks[b].torque, torque)) usual.push_back(b);
  return usual;
}

std::optional<FatigueTrend> find_fatigue(const std::vector<Block>& blocks) {
  const std::vector<std::size_t> usual = usual_blocks(blocks);
  if (usual.size() < kFewestBlocks) return std::nullopt;
  const auto n = static_cast<Eigen::Index>(usual.size());
  Eigen::VectorXd gain(n);
  for (Eigen::Index i = 0; i < n; ++i) gain[i] = blocks[usual[static_cast<std::size_t>(i)]].gain;
  if (!gain.allFinite()) return std::nullopt;
  const Eigen::VectorXd frequency = known_frequencies(blocks, usual);
  const bool known = frequency.size() > 0;
  const double gain_sd = block_sd(gain), frequency_sd = known ? block_sd(frequency) : 1.0;
  const Eigen::VectorXd shape = nearest_shape(gain, gain_sd, frequency, frequency_sd);
  const Line torque(gain, shape);
  if (!torque.falls_by(kGainChange, gain_sd)) return std::nullopt;
  if (known && !Line(frequency, shape).falls_by(kFrequencyFall, frequency_sd)) return std::nullopt;
  const Eigen::ArrayXd fallen = shape.array() * (torque.fall / shape[n - 1]);
  const auto fresh = (fallen < -std::log1p(-kGainChange)).count();  // the trend never rises
  FatigueTrend found{.first = usual[static_cast<std::size_t>(fresh)],
                     .gain = std::exp(gain.tail(n - fresh).mean() - torque.fresh)};
  if (known) found.frequency = std::exp(frequency.tail(n - fresh).mean() - Line(frequency, shape).fresh);
  return found;
}

}  // namespace myoid::study
