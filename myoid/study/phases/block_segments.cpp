#include "myoid/study/phases/block_segments.h"

#include <algorithm>
#include <cmath>

#include "myoid/ground/core/numbers.h"
#include "myoid/ground/math/change_points.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::study {
namespace {

using namespace phase_limits;

/// Returns the robust spread of one block about its neighbors, at least one percent, because people vary more.
double block_sd(const Eigen::VectorXd& x) {
  std::vector<double> differences;
  for (Eigen::Index i = 1; i < x.size(); ++i) differences.push_back(std::abs(x[i] - x[i - 1]));
  return std::max(0.01, 1.4826 * math::median(differences) / std::sqrt(2.0));
}

/// Returns the frequencies of the blocks. A block without a channel of sufficient amplitude takes
/// the value of its neighbor. Empty if more than a fifth of the blocks have no such channel.
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

/// Returns the standard deviation of one block: the block's own, or that of means times the root of
/// their size, whichever is larger.
double noise_sd(const Eigen::VectorXd& x) {
  const double long_run = long_run_sd(x, kBatch);
  return std::isfinite(long_run) ? std::max(block_sd(x), long_run) : block_sd(x);
}

/// Returns the noise of each column.
Eigen::VectorXd noise_sds(const Eigen::MatrixXd& x) {
  Eigen::VectorXd sd(x.cols());
  for (Eigen::Index c = 0; c < x.cols(); ++c) sd[c] = noise_sd(x.col(c));
  return sd;
}

/// Returns x less the mean of its segment.
Eigen::MatrixXd about_means(Eigen::MatrixXd x, const math::ChangePoints& changes) {
  for (const math::Segment& part : changes.segments) {
    auto rows = x.middleRows(part.begin, part.end - part.begin);
    rows.rowwise() -= rows.colwise().mean().eval();
  }
  return x;
}

}  // namespace

BlockChanges find_changes(const std::vector<Block>& blocks) {
  const auto n = static_cast<Eigen::Index>(blocks.size());
  BlockChanges changes{.gain = Eigen::VectorXd(n), .frequency = known_frequencies(blocks)};
  for (Eigen::Index i = 0; i < n; ++i) changes.gain[i] = blocks[static_cast<std::size_t>(i)].gain;
  const bool frequency_known = changes.frequency.size() > 0;
  Eigen::MatrixXd x(n, frequency_known ? 2 : 1);
  x.col(0) = changes.gain;
  if (frequency_known) x.col(1) = changes.frequency;
  Eigen::VectorXd sd = noise_sds(x);
  const auto segments = [&] {
    return math::change_points(x, {.cost = math::SegmentCost::mean, .min_length = 2, .noise_sd = sd});
  };
  math::ChangePoints found = segments();
  // Large steps count as noise until they are known, and hide smaller ones.
  if (found.segments.size() > 1) {
    sd = sd.cwiseMin(noise_sds(about_means(x, found)));
    found = segments();
  }
  changes.gain_sd = sd[0];
  if (frequency_known) changes.frequency_sd = sd[1];
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
  const auto within = [&](double a, double b) { return std::max(a, b) < factor * std::max(1e-9, std::min(a, b)); };
  return within(speed, other_speed) && within(torque, other_torque);
}

std::size_t regular_segment(const BlockChanges& changes) {
  constexpr double kSurely = 3.0;  // standard errors, of either
  const std::vector<Segment>& all = changes.segments;
  const auto longest = std::max_element(all.begin(), all.end(),
                                        [](const Segment& a, const Segment& b) { return a.count() < b.count(); });
  auto regular = static_cast<std::size_t>(longest - all.begin());
  if (changes.frequency.size() == 0) return regular;
  for (auto segment = all.begin(); segment != longest; ++segment) {
    const double share = std::sqrt(1.0 / segment->count() + 1.0 / longest->count());
    const double gain = segment->gain - longest->gain;
    const double frequency = segment->frequency - longest->frequency;
    if (segment->count() >= static_cast<double>(kBatch) && gain > kSurely * changes.gain_sd * share &&
        frequency > kSurely * changes.frequency_sd * share &&
        alike(segment->speed, segment->torque, longest->speed, longest->torque, kAlike) &&
        segment->gain > all[regular].gain) {
      regular = static_cast<std::size_t>(segment - all.begin());
    }
  }
  return regular;
}

}  // namespace myoid::study
