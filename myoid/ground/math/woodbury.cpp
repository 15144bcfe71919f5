#include "myoid/ground/math/woodbury.h"

#include <cmath>
#include <utility>

#include "myoid/ground/core/parallel.h"

namespace myoid::inline ground::math {
namespace {

template <typename Body>
void for_each_block(std::size_t count, const Body& body) {
  parallel_ranges(count, std::size_t{1}, [&](const auto& range) {
    for (std::size_t r = range.begin(); r < range.end(); ++r) body(r);
  });
}

}  // namespace

Woodbury::Woodbury(Blocks blocks, Eigen::Index columns) : blocks_(std::move(blocks)), columns_(columns) {
  for (const Eigen::MatrixXd* block : blocks_) {
    first_.push_back(rows_);
    rows_ += block->rows();
  }
  if (by_rows()) {
    product_ = over_rows(blocks_, Eigen::VectorXd::Ones(columns_));
    factor_.compute(Eigen::MatrixXd::Identity(rows_, rows_) + product_);
    return;
  }
  std::vector<Eigen::MatrixXd> parts(blocks_.size());
  for_each_block(blocks_.size(), [&](std::size_t r) {
    parts[r].setZero(columns_, columns_);
    parts[r].selfadjointView<Eigen::Lower>().rankUpdate(blocks_[r]->transpose());
  });
  product_.setZero(columns_, columns_);
  for (const Eigen::MatrixXd& part : parts) product_ += part;
  factor_.compute(Eigen::MatrixXd::Identity(columns_, columns_) + product_);
}

bool Woodbury::positive() const { return factor_.info() == Eigen::Success && std::isfinite(log_determinant()); }

double Woodbury::log_determinant() const { return 2.0 * factor_.matrixLLT().diagonal().array().log().sum(); }

Eigen::MatrixXd Woodbury::over_rows(const Blocks& blocks, const Eigen::VectorXd& f) const {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(rows_, rows_);
  for_each_block(blocks.size(), [&](std::size_t r) {
    const Eigen::MatrixXd scaled = *blocks[r] * f.asDiagonal();
    for (std::size_t s = 0; s <= r; ++s)
      m.block(first_[r], first_[s], scaled.rows(), blocks[s]->rows()).noalias() = scaled * blocks[s]->transpose();
  });
  return m;
}

Eigen::MatrixXd Woodbury::stacked(const std::vector<Eigen::MatrixXd>& b) const {
  Eigen::MatrixXd all(rows_, b.empty() ? 0 : b.front().cols());
  for (std::size_t r = 0; r < b.size(); ++r) all.middleRows(first_[r], b[r].rows()) = b[r];
  return all;
}

Eigen::MatrixXd Woodbury::transposed_times(const Eigen::MatrixXd& c) const {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(columns_, c.cols());
  for (std::size_t r = 0; r < blocks_.size(); ++r)
    sum.noalias() += blocks_[r]->transpose() * c.middleRows(first_[r], blocks_[r]->rows());
  return sum;
}

Eigen::MatrixXd Woodbury::whole() const {
  Eigen::MatrixXd all(rows_, columns_);
  for (std::size_t r = 0; r < blocks_.size(); ++r) all.middleRows(first_[r], blocks_[r]->rows()) = *blocks_[r];
  return all;
}

Eigen::MatrixXd Woodbury::project(const std::vector<Eigen::MatrixXd>& b) const { return transposed_times(stacked(b)); }

Eigen::MatrixXd Woodbury::solve(const std::vector<Eigen::MatrixXd>& b) const {
  return by_rows() ? transposed_times(factor_.solve(stacked(b))) : Eigen::MatrixXd(factor_.solve(project(b)));
}

Eigen::MatrixXd Woodbury::solve(const std::vector<Eigen::MatrixXd>& b, const Eigen::VectorXd& factors) const {
  Factor scaled;
  if (by_rows()) {
    std::vector<Eigen::Index> changed;
    for (Eigen::Index j = 0; j < columns_; ++j)
      if (factors[j] != 1.0) changed.push_back(j);
    std::vector<Eigen::MatrixXd> parts;
    for (const Eigen::MatrixXd* block : blocks_) parts.emplace_back((*block)(Eigen::all, changed));
    Blocks of_parts;
    for (const Eigen::MatrixXd& part : parts) of_parts.push_back(&part);
    const Eigen::VectorXd more = factors(changed).cwiseAbs2().array() - 1.0;
    scaled.compute(Eigen::MatrixXd::Identity(rows_, rows_) + product_ + over_rows(of_parts, more));
    if (scaled.info() != Eigen::Success) return {};
    return factors.asDiagonal() * transposed_times(scaled.solve(stacked(b)));
  }
  scaled.compute(Eigen::MatrixXd::Identity(columns_, columns_) +
                 factors.asDiagonal() * product_ * factors.asDiagonal());
  if (scaled.info() != Eigen::Success) return {};
  return scaled.solve(factors.asDiagonal() * project(b));
}

Eigen::MatrixXd Woodbury::inverse() const {
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(columns_, columns_);
  if (!by_rows()) return factor_.solve(identity);
  Eigen::MatrixXd half = whole();
  factor_.matrixL().solveInPlace(half);
  return identity - half.transpose() * half;
}

Woodbury::Left Woodbury::left() const {
  Left found{std::vector<Eigen::MatrixXd>(blocks_.size()), {}};
  if (!by_rows()) {
    const Eigen::MatrixXd covariance = inverse();
    for_each_block(blocks_.size(), [&](std::size_t r) { found.blocks[r].noalias() = *blocks_[r] * covariance; });
    found.diagonal = covariance.diagonal();
    return found;
  }
  const Eigen::MatrixXd all = factor_.solve(whole());
  found.diagonal.setOnes(columns_);
  for (std::size_t r = 0; r < blocks_.size(); ++r) {
    found.blocks[r] = all.middleRows(first_[r], blocks_[r]->rows());
    found.diagonal -= found.blocks[r].cwiseProduct(*blocks_[r]).colwise().sum().transpose();
  }
  return found;
}

}  // namespace myoid::inline ground::math
