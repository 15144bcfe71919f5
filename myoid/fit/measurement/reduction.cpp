#include "myoid/fit/measurement/reduction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace myoid::fit {
namespace {

constexpr double kReach = 3.0;          // kernel widths to either side
constexpr double kRowsPerPeriod = 3.0;  // rows per period of the cut-off

double width_s(double cutoff_hz) { return std::sqrt(std::numbers::ln2) / (2.0 * std::numbers::pi * cutoff_hz); }

Eigen::Index stride_of(double rate_hz, double cutoff_hz) {
  return std::max<Eigen::Index>(1, std::lround(rate_hz / (kRowsPerPeriod * cutoff_hz)));
}

}  // namespace

Eigen::Index shared_samples(double rate_hz, std::optional<double> cutoff_hz) {
  if (!cutoff_hz || *cutoff_hz >= 0.45 * rate_hz) return 0;
  const auto reach = static_cast<Eigen::Index>(std::ceil(kReach * width_s(*cutoff_hz) * rate_hz));
  return std::max<Eigen::Index>(0, 2 * reach + 1 - stride_of(rate_hz, *cutoff_hz));
}

Reduction::Reduction(Eigen::Index samples, double rate_hz, std::optional<double> cutoff_hz)
    : inputs_(samples), outputs_(samples), weights_(Eigen::VectorXd::Ones(1)) {
  if (!cutoff_hz || *cutoff_hz >= 0.45 * rate_hz) return;
  const double width = width_s(*cutoff_hz);
  const auto reach =
      std::min<Eigen::Index>(static_cast<Eigen::Index>(std::ceil(kReach * width * rate_hz)), (samples - 1) / 2);
  stride_ = stride_of(rate_hz, *cutoff_hz);
  const Eigen::Index free = samples - 1 - 2 * reach;
  outputs_ = free / stride_ + 1;
  begin_ = (free % stride_) / 2;
  weights_.resize(2 * reach + 1);
  for (Eigen::Index w = 0; w < weights_.size(); ++w) {
    const double apart = static_cast<double>(w - reach) / (width * rate_hz);
    weights_[w] = std::exp(-0.5 * apart * apart);
  }
  weights_ /= weights_.sum();
}

Eigen::MatrixXd Reduction::apply(const Eigen::Ref<const Eigen::MatrixXd>& x) const {
  Eigen::MatrixXd y(x.rows() / inputs_ * outputs_, x.cols());
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    for (Eigen::Index j = 0; j < y.rows(); ++j)
      y(j, c) = weights_.dot(x.col(c).segment(j / outputs_ * inputs_ + first(j % outputs_), weights_.size()));
  }
  return y;
}

Eigen::MatrixXd Reduction::transposed(const Eigen::Ref<const Eigen::MatrixXd>& y) const {
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(y.rows() / outputs_ * inputs_, y.cols());
  for (Eigen::Index c = 0; c < y.cols(); ++c) {
    for (Eigen::Index j = 0; j < y.rows(); ++j)
      x.col(c).segment(j / outputs_ * inputs_ + first(j % outputs_), weights_.size()) += y(j, c) * weights_;
  }
  return x;
}

}  // namespace myoid::fit
