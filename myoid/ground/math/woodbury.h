#pragma once

#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace myoid::inline ground::math {

/// Woodbury's identity for 1 + U U', U of many rows, in blocks U_r one after the other, or of many columns. With
///
///   G = 1 + U' U, columns x columns,   M = 1 + U U', rows x rows,
///   |G| = |M|,   G^-1 U' = U' M^-1,   G^-1 = 1 - U' M^-1 U,
///
/// every answer needs the factor of the smaller of both alone. The blocks must outlive the object.
class Woodbury {
 public:
  using Blocks = std::vector<const Eigen::MatrixXd*>;
  /// `columns` counts those of every block. Works on blocks in parallel and adds in their order.
  Woodbury(Blocks blocks, Eigen::Index columns);

  /// Returns false where G is not finite or not positive definite.
  [[nodiscard]] bool positive() const;
  [[nodiscard]] double log_determinant() const;
  /// Returns U' b, b in blocks as U.
  [[nodiscard]] Eigen::MatrixXd project(const std::vector<Eigen::MatrixXd>& b) const;
  /// Returns G^-1 U' b.
  [[nodiscard]] Eigen::MatrixXd solve(const std::vector<Eigen::MatrixXd>& b) const;
  /// Returns G^-1 U' b where each column of U is multiplied by its factor, in G and in U'; empty: not positive
  /// definite.
  [[nodiscard]] Eigen::MatrixXd solve(const std::vector<Eigen::MatrixXd>& b, const Eigen::VectorXd& factors) const;
  [[nodiscard]] Eigen::MatrixXd inverse() const;

  /// U_r G^-1 of each block, and the diagonal of G^-1.
  struct Left {
    std::vector<Eigen::MatrixXd> blocks;
    Eigen::VectorXd diagonal;
  };
  [[nodiscard]] Left left() const;

 private:
  using Factor = Eigen::LLT<Eigen::MatrixXd>;
  [[nodiscard]] bool by_rows() const { return rows_ < columns_; }
  /// Returns the lower half of U F U'.
  [[nodiscard]] Eigen::MatrixXd over_rows(const Blocks& blocks, const Eigen::VectorXd& f) const;
  [[nodiscard]] Eigen::MatrixXd stacked(const std::vector<Eigen::MatrixXd>& b) const;
  [[nodiscard]] Eigen::MatrixXd whole() const;  ///< U
  /// Returns U' c, c as high as all blocks.
  [[nodiscard]] Eigen::MatrixXd transposed_times(const Eigen::MatrixXd& c) const;

  Blocks blocks_;
  std::vector<Eigen::Index> first_;  ///< First row of each block.
  Eigen::Index rows_ = 0, columns_ = 0;
  Eigen::MatrixXd product_;  ///< U' U, or U U' where this is smaller; the lower half.
  Factor factor_;            ///< Of G or M.
};

}  // namespace myoid::inline ground::math
