#include "myoid/math/variable_projection.h"

#include <cmath>
#include <limits>

#include <Eigen/SVD>
#include <fmt/format.h>

#include "myoid/core/error.h"

namespace myoid::math {
namespace {

constexpr double kLeastNorm = 1e-290;

/// Pseudoinverse of the chosen columns of Phi, columns scaled to unit length first.
class Pseudoinverse {
 public:
  Pseudoinverse(const Eigen::MatrixXd& basis,
                const std::vector<Eigen::Index>& columns,
                double tolerance)
      : columns_(columns), scale_(static_cast<Eigen::Index>(columns.size())) {
    Eigen::MatrixXd scaled(basis.rows(), scale_.size());
    for (Eigen::Index k = 0; k < scale_.size(); ++k) {
      const Eigen::VectorXd column = basis.col(columns[static_cast<std::size_t>(k)]);
      const double norm = column.norm();
      // A column that underflows is none: its coefficient would overflow.
      scale_[k] = norm > kLeastNorm ? 1.0 / norm : 0.0;
      scaled.col(k) = column * scale_[k];
    }
    if (scale_.size() == 0) return;
    svd_.compute(scaled, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const double floor = tolerance * svd_.singularValues()[0];
    while (rank_ < svd_.singularValues().size() && svd_.singularValues()[rank_] > floor) ++rank_;
    range_ = svd_.matrixU().leftCols(rank_);
  }

  [[nodiscard]] Eigen::Index rank() const { return rank_; }
  /// c = Phi^+ y, one per chosen column.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& y) const {
    if (rank_ == 0) return Eigen::VectorXd::Zero(scale_.size());
    const Eigen::VectorXd along =
        (range_.transpose() * y).cwiseQuotient(svd_.singularValues().head(rank_));
    return scale_.cwiseProduct(svd_.matrixV().leftCols(rank_) * along);
  }
  /// (Phi^+)' w for w with one entry per chosen column.
  [[nodiscard]] Eigen::VectorXd transposed(const Eigen::VectorXd& w) const {
    if (rank_ == 0) return Eigen::VectorXd::Zero(range_.rows());
    const Eigen::VectorXd along =
        (svd_.matrixV().leftCols(rank_).transpose() * scale_.cwiseProduct(w))
            .cwiseQuotient(svd_.singularValues().head(rank_));
    return range_ * along;
  }
  /// v without its part in the range of Phi.
  [[nodiscard]] Eigen::VectorXd beside(const Eigen::VectorXd& v) const {
    if (rank_ == 0) return v;
    return v - range_ * (range_.transpose() * v);
  }
  [[nodiscard]] const std::vector<Eigen::Index>& columns() const { return columns_; }

 private:
  std::vector<Eigen::Index> columns_;
  Eigen::VectorXd scale_;
  Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::HouseholderQRPreconditioner> svd_;
  Eigen::MatrixXd range_;
  Eigen::Index rank_ = 0;
};

/// Nonnegative least squares by the active set of Lawson and Hanson: the columns with c > 0.
std::vector<Eigen::Index> positive_columns(const Eigen::MatrixXd& basis,
                                           const Eigen::VectorXd& y,
                                           double tolerance) {
  const Eigen::Index n = basis.cols();
  std::vector<bool> in(static_cast<std::size_t>(n), false);
  Eigen::VectorXd c = Eigen::VectorXd::Zero(n);
  const auto chosen = [&] {
    std::vector<Eigen::Index> columns;
    for (Eigen::Index k = 0; k < n; ++k) {
      if (in[static_cast<std::size_t>(k)]) columns.push_back(k);
    }
    return columns;
  };
  const double small = 1e-14 * y.norm();
  for (Eigen::Index round = 0; round < 3 * n; ++round) {
    // The column that would lower the cost fastest, in units of its own length.
    const Eigen::VectorXd r = y - basis * c;
    Eigen::Index best = -1;
    double steepest = small;
    for (Eigen::Index k = 0; k < n; ++k) {
      const double norm = basis.col(k).norm();
      if (in[static_cast<std::size_t>(k)] || norm <= kLeastNorm) continue;
      const double slope = basis.col(k).dot(r) / norm;
      if (slope > steepest) {
        steepest = slope;
        best = k;
      }
    }
    if (best < 0) break;
    in[static_cast<std::size_t>(best)] = true;
    for (;;) {
      const std::vector<Eigen::Index> columns = chosen();
      const Eigen::VectorXd next = Pseudoinverse(basis, columns, tolerance).solve(y);
      // As far toward the unbounded solution as all stay positive.
      double share = 1.0;
      for (std::size_t k = 0; k < columns.size(); ++k) {
        const double from = c[columns[k]], to = next[static_cast<Eigen::Index>(k)];
        if (to <= 0.0) share = std::min(share, from > to ? from / (from - to) : 0.0);
      }
      for (std::size_t k = 0; k < columns.size(); ++k) {
        double& value = c[columns[k]];
        value += share * (next[static_cast<Eigen::Index>(k)] - value);
      }
      if (share >= 1.0) break;
      for (std::size_t k = 0; k < columns.size(); ++k) {
        if (next[static_cast<Eigen::Index>(k)] <= 0.0 && c[columns[k]] <= 1e-15 * c.maxCoeff()) {
          c[columns[k]] = 0.0;
          in[static_cast<std::size_t>(columns[k])] = false;
        }
      }
    }
  }
  return chosen();
}

Pseudoinverse inverse_of(const Eigen::MatrixXd& basis,
                         const Eigen::VectorXd& y,
                         bool nonnegative,
                         double tolerance) {
  std::vector<Eigen::Index> columns;
  if (nonnegative) {
    columns = positive_columns(basis, y, tolerance);
  } else {
    for (Eigen::Index k = 0; k < basis.cols(); ++k) columns.push_back(k);
  }
  return {basis, columns, tolerance};
}

Projection projection_by(const Pseudoinverse& inverse,
                         const Eigen::MatrixXd& basis,
                         const Eigen::VectorXd& y) {
  Projection result;
  result.linear = Eigen::VectorXd::Zero(basis.cols());
  const Eigen::VectorXd c = inverse.solve(y);
  for (std::size_t k = 0; k < inverse.columns().size(); ++k)
    result.linear[inverse.columns()[k]] = c[static_cast<Eigen::Index>(k)];
  result.residual = basis * result.linear - y;
  result.rank = static_cast<int>(inverse.rank());
  return result;
}

struct Evaluated {
  Eigen::MatrixXd basis;
  std::vector<Eigen::MatrixXd> derivatives;
};

Evaluated evaluate(const SeparableProblem& problem, const Eigen::VectorXd& a, bool derivatives) {
  Evaluated result;
  const Eigen::Index n = problem.response.size(), m = problem.linear_count;
  result.basis = Eigen::MatrixXd::Zero(n, m);
  if (derivatives)
    result.derivatives.assign(static_cast<std::size_t>(a.size()), Eigen::MatrixXd::Zero(n, m));
  problem.basis(a, result.basis, derivatives ? &result.derivatives : nullptr);
  if (result.basis.rows() != n || result.basis.cols() != m) {
    throw InvalidInput(fmt::format("variable projection: the basis is {} x {}, {} x {} was asked",
                                   result.basis.rows(), result.basis.cols(), n, m));
  }
  return result;
}

}  // namespace

Projection project(const Eigen::MatrixXd& basis,
                   const Eigen::VectorXd& response,
                   bool nonnegative,
                   double rank_tolerance) {
  if (basis.rows() != response.size() || basis.cols() == 0) {
    throw InvalidInput(fmt::format("variable projection: a basis of {} x {} for {} responses",
                                   basis.rows(), basis.cols(), response.size()));
  }
  if (!basis.allFinite() || !response.allFinite())
    throw InvalidInput("variable projection: the basis or the response is not finite");
  return projection_by(inverse_of(basis, response, nonnegative, rank_tolerance), basis, response);
}

LeastSquaresProblem reduced_problem(const SeparableProblem& problem,
                                    Eigen::Index nonlinear_count,
                                    const VariableProjectionOptions& options) {
  if (problem.linear_count < 1)
    throw InvalidInput("variable projection: there is no linear parameter");
  if (problem.response.size() == 0 || !problem.response.allFinite())
    throw InvalidInput("variable projection: the response is empty or not finite");
  LeastSquaresProblem reduced;
  reduced.residual_count = problem.response.size();
  reduced.lower = problem.lower;
  reduced.upper = problem.upper;
  reduced.evaluate = [problem, nonlinear_count, kind = options.jacobian,
                      tolerance = options.rank_tolerance](
                         const Eigen::VectorXd& a, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    const Evaluated phi = evaluate(problem, a, jacobian != nullptr);
    if (!phi.basis.allFinite()) {  // outside the domain: the solver steps back
      r.setConstant(std::numeric_limits<double>::quiet_NaN());
      if (jacobian != nullptr) jacobian->setConstant(std::numeric_limits<double>::quiet_NaN());
      return;
    }
    const Pseudoinverse inverse =
        inverse_of(phi.basis, problem.response, problem.nonnegative, tolerance);
    const Projection projection = projection_by(inverse, phi.basis, problem.response);
    r = projection.residual;
    if (jacobian == nullptr) return;
    for (Eigen::Index j = 0; j < nonlinear_count; ++j) {
      const Eigen::MatrixXd& slope = phi.derivatives[static_cast<std::size_t>(j)];
      Eigen::VectorXd column = inverse.beside(slope * projection.linear);
      if (kind == ProjectionJacobian::golub_pereyra) {
        const Eigen::VectorXd all = slope.transpose() * r;
        Eigen::VectorXd w(static_cast<Eigen::Index>(inverse.columns().size()));
        for (Eigen::Index k = 0; k < w.size(); ++k)
          w[k] = all[inverse.columns()[static_cast<std::size_t>(k)]];
        if (w.size() > 0) column -= inverse.transposed(w);
      }
      jacobian->col(j) = column;
    }
  };
  return reduced;
}

VariableProjectionResult variable_projection(const SeparableProblem& problem,
                                             const Eigen::VectorXd& nonlinear_start,
                                             const VariableProjectionOptions& options) {
  VariableProjectionResult result;
  result.search = minimize(reduced_problem(problem, nonlinear_start.size(), options),
                           nonlinear_start, options.search);
  const Evaluated phi = evaluate(problem, result.search.x, true);
  const Projection projection =
      project(phi.basis, problem.response, problem.nonnegative, options.rank_tolerance);
  result.linear = projection.linear;
  result.linear_rank = projection.rank;
  const Eigen::Index linear = problem.linear_count, nonlinear = result.search.x.size();
  result.jacobian.resize(problem.response.size(), linear + nonlinear);
  result.jacobian.leftCols(linear) = phi.basis;
  for (Eigen::Index j = 0; j < nonlinear; ++j) {
    result.jacobian.col(linear + j) =
        phi.derivatives[static_cast<std::size_t>(j)] * projection.linear;
  }
  return result;
}

}  // namespace myoid::math
