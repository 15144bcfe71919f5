#include "myoid/results/realtime/band_space.h"

#include <algorithm>

namespace myoid::results {

using Eigen::Index;
namespace {

constexpr Index kRows = 8;
/// kRows numbers side by side: one register of AVX, two of SSE.
using Side = float __attribute__((vector_size(kRows * sizeof(float)), aligned(alignof(float))));

/// The rows of C below a block, kRows rows side by side.
struct Panel {
  const float* numbers;
  Index groups, width;
};

/// Computes l_j' C s of the levers l_j of `kJoints` joints. C is read once, in single precision: 80
/// muscles with 8 unknowns each take 0.8 MB, which fits a processor's own cache. Products and sums
/// stay in registers. Every processor adds in the same order.
template <int kJoints>
[[gnu::always_inline]] inline void shared_of(
    const Panel& panel, const float* slopes, const float* levers, Index stride, double* shared) {
  const auto* numbers = reinterpret_cast<const Side*>(panel.numbers);
  Side sum[kJoints] = {};
  for (Index i = 0; i < panel.groups; ++i) {
    Side products{};
    for (Index c = 0; c < panel.width; ++c) products += *numbers++ * slopes[c];
    for (int j = 0; j < kJoints; ++j)
      sum[j] += products * *reinterpret_cast<const Side*>(levers + j * stride + kRows * i);
  }
  for (int j = 0; j < kJoints; ++j) {
    float total = 0.0F;
    for (Index r = 0; r < kRows; ++r) total += sum[j][r];
    shared[j] = static_cast<double>(total);
  }
}

using SharedWithLater = void (*)(const Panel&, const float*, const float*, Index, double*);

template <int kJoints>
void shared_by_any(const Panel& p, const float* s, const float* l, Index stride, double* shared) {
  shared_of<kJoints>(p, s, l, stride, shared);
}

#if defined(__x86_64__)
template <int kJoints>
[[gnu::target("avx2")]] void shared_by_avx2(
    const Panel& p, const float* s, const float* l, Index stride, double* shared) {
  shared_of<kJoints>(p, s, l, stride, shared);
}
const bool kHasAvx2 = __builtin_cpu_supports("avx2") != 0;
template <int kJoints>
const SharedWithLater kBest = kHasAvx2 ? &shared_by_avx2<kJoints> : &shared_by_any<kJoints>;
#else
template <int kJoints>
constexpr SharedWithLater kBest = &shared_by_any<kJoints>;
#endif

constexpr Index kJointsAtOnce = 6;

/// Returns the way for 1 to kJointsAtOnce joints.
SharedWithLater shared_with_later(Index joints) {
  static const SharedWithLater ways[] = {kBest<1>, kBest<2>, kBest<3>, kBest<4>, kBest<5>, kBest<kJointsAtOnce>};
  return ways[joints - 1];
}

}  // namespace

BandSpace::BandSpace(const Eigen::MatrixXd& covariance,
                     const std::vector<std::vector<Index>>& variables,
                     std::size_t joints) {
  const auto blocks = static_cast<Index>(variables.size());
  const auto count = static_cast<Index>(joints);
  first_.push_back(0);
  for (const std::vector<Index>& block : variables) {
    variable_.insert(variable_.end(), block.begin(), block.end());
    first_.push_back(static_cast<Index>(variable_.size()));
  }
  const Index slopes = first_.back(), unknowns = covariance.rows();
  slopes_.setZero(slopes);
  levers_.setZero(slopes + kRows, count);  // rows go in groups: the last one may be short
  shared_.setZero(count);
  arms.setZero(blocks, count);
  arms.bottomRows(count).setIdentity();
  force_variance.setZero(blocks - count);
  torque_variance.setZero(count);
  Index products = count * unknowns * unknowns;  // of the way by unknowns
  for (Index b = 0; b < blocks - count; ++b) products += width(b) * width(b);
  by_block_ = slopes * slopes / 2 <= products;
  if (!by_block_) {
    by_unknown_.setZero(unknowns, count);
    moved_.setZero(unknowns);
    return;
  }
  single_slopes_ = slopes_.cast<float>();
  single_levers_ = levers_.cast<float>();
  for (Index n = 0; n < blocks; ++n) {
    const Index begin = first_[static_cast<std::size_t>(n)], end = begin + width(n);
    const auto at = [&](Index row, Index column) {
      return row < slopes
                 ? covariance(variable_[static_cast<std::size_t>(row)], variable_[static_cast<std::size_t>(column)])
                 : 0.0;
    };
    for (Index column = begin; column < end; ++column) {
      for (Index row = begin; row < end; ++row) diagonals_.push_back(at(row, column));
    }
    for (Index row = end; row < slopes; row += kRows) {
      for (Index column = begin; column < end; ++column) {
        for (Index r = row; r < row + kRows; ++r) panels_.push_back(static_cast<float>(at(r, column)));
      }
    }
  }
}

void BandSpace::compute(const Eigen::MatrixXd& covariance) {
  for (Index b = 0; b < arms.rows(); ++b) {
    const Index begin = first_[static_cast<std::size_t>(b)];
    for (Index j = 0; j < arms.cols(); ++j)
      levers_.col(j).segment(begin, width(b)) = arms(b, j) * slopes_.segment(begin, width(b));
  }
  if (by_block_)
    compute_by_block();
  else
    compute_by_unknown(covariance);
}

void BandSpace::compute_by_block() {
  torque_variance.setZero();
  const Index joints = arms.cols();
  const double* diagonal = diagonals_.data();
  const float* panel = panels_.data();
  single_slopes_ = slopes_.cast<float>();
  single_levers_ = levers_.cast<float>();
  for (Index n = 0; n < arms.rows(); ++n) {
    const Index begin = first_[static_cast<std::size_t>(n)], own = width(n);
    const double* const slopes = slopes_.data() + begin;
    double variance = 0.0;
    for (Index a = 0; a < own; ++a) {
      double moved = 0.0;  // sums of their own, which the processor adds side by side
      for (Index b = 0; b < own; ++b) moved += *diagonal++ * slopes[b];
      variance += slopes[a] * moved;
    }
    if (n < force_variance.size()) force_variance[n] = variance;
    const Index groups = (slopes_.size() - begin - own + kRows - 1) / kRows;
    for (Index j = 0; j < joints; j += kJointsAtOnce) {
      const Index count = std::min(kJointsAtOnce, joints - j);
      shared_with_later(count)({panel, groups, own}, single_slopes_.data() + begin,
                               single_levers_.col(j).data() + begin + own, levers_.rows(), shared_.data() + j);
    }
    // The blocks that come after count twice: C has them on both sides of its diagonal.
    for (Index j = 0; j < joints; ++j) torque_variance[j] += arms(n, j) * (arms(n, j) * variance + 2.0 * shared_[j]);
    panel += kRows * groups * own;
  }
}

void BandSpace::compute_by_unknown(const Eigen::MatrixXd& covariance) {
  by_unknown_.setZero();
  for (Index m = 0; m < force_variance.size(); ++m) {
    double variance = 0.0;
    const auto begin = static_cast<std::size_t>(first_[static_cast<std::size_t>(m)]);
    const std::size_t end = begin + static_cast<std::size_t>(width(m));
    for (std::size_t a = begin; a < end; ++a) {
      for (std::size_t b = begin; b < end; ++b)
        variance +=
            slopes_[static_cast<Index>(a)] * covariance(variable_[a], variable_[b]) * slopes_[static_cast<Index>(b)];
    }
    force_variance[m] = variance;
  }
  for (std::size_t s = 0; s < variable_.size(); ++s)
    by_unknown_.row(variable_[s]) += levers_.row(static_cast<Index>(s));
  for (Index j = 0; j < arms.cols(); ++j) {
    moved_.noalias() = covariance * by_unknown_.col(j);
    torque_variance[j] = by_unknown_.col(j).dot(moved_);
  }
}

}  // namespace myoid::results
