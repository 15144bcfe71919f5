#include "myoid/study/phases/warm_up.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/QR>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/decompositions.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::study {
namespace {

constexpr Eigen::Index kFewestWarmUpBlocks = 24;
constexpr Eigen::Index kMostOrder = 8;
/// Widens the critical value: Student's t ignores that the autoregression is estimated.
constexpr double kCaution = 1.25;

/// Returns the powers 0..3 of the time, -1..1.
Eigen::MatrixXd slow_columns(Eigen::Index n) {
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(n, -1.0, 1.0);
  Eigen::MatrixXd columns(n, 4);
  columns << Eigen::ArrayXd::Ones(n), t, t.square(), t.cube();
  return columns;
}

/// Coefficients phi of x_k = slow + sum_i phi_i x_(k+i) + innovation.
Eigen::VectorXd autoregression(const Eigen::VectorXd& x) {
  const Eigen::Index n = x.size();
  const Eigen::Index most = std::min(kMostOrder, n / 8);
  const Eigen::Index rows = n - most;  // the same for every order
  Eigen::VectorXd best;
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index order = 0; order <= most; ++order) {
    Eigen::MatrixXd regressors(rows, 4 + order);
    regressors.leftCols(4) = slow_columns(n).topRows(rows);
    for (Eigen::Index i = 1; i <= order; ++i) regressors.col(3 + i) = x.segment(i, rows);
    const Eigen::VectorXd solution = math::nearest_solution(regressors, x.head(rows));
    const double squares = (x.head(rows) - regressors * solution).squaredNorm();
    const double schwarz = static_cast<double>(rows) * std::log(std::max(squares, 1e-300)) +
                           std::log(static_cast<double>(rows)) * static_cast<double>(order);
    if (schwarz < least) {
      least = schwarz;
      best = solution.tail(order);
    }
  }
  return best;
}

Eigen::MatrixXd filtered(const Eigen::MatrixXd& x, const Eigen::VectorXd& phi) {
  const Eigen::Index rows = x.rows() - phi.size();
  Eigen::MatrixXd result = x.topRows(rows);
  for (Eigen::Index i = 1; i <= phi.size(); ++i) result -= phi[i - 1] * x.middleRows(i, rows);
  return result;
}

}  // namespace

std::optional<WarmUp> find_warm_up(const Eigen::VectorXd& x, double least, double false_alarm) {
  if (!x.allFinite()) throw InvalidInput("warm-up: values must be finite");
  const Eigen::Index n = x.size();
  if (n < kFewestWarmUpBlocks) return std::nullopt;
  const Eigen::VectorXd phi = autoregression(x.tail(n - n / 4));
  const Eigen::VectorXd y = filtered(x, phi);
  Eigen::MatrixXd regressors(n, 5);
  regressors.leftCols(4) = slow_columns(n);
  const Eigen::ArrayXd k = Eigen::ArrayXd::LinSpaced(n, 0.0, static_cast<double>(n - 1));

  WarmUp best;
  int tried = 0;
  for (double fading = 1.5; fading <= static_cast<double>(n) / 6.0; fading *= 2.0) {
    ++tried;
    regressors.col(4) = (-k / fading).exp().matrix();
    const Eigen::MatrixXd z = filtered(regressors, phi);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(z);
    const Eigen::VectorXd solution = qr.solve(y);
    const auto freedom = static_cast<double>(y.size() - 5 - phi.size());
    const double variance = (y - z * solution).squaredNorm() / freedom;
    // (Z'Z)^-1 of the last column: 1 / R_55^2.
    const double sd = std::sqrt(variance) / std::abs(qr.matrixQR()(4, 4));
    const double t = std::abs(solution[4]) / sd;
    if (!(t > best.t)) continue;
    best = {.change = solution[4], .fading = fading, .blocks = 0, .t = t, .critical = freedom};
  }
  best.critical = kCaution * math::student_quantile(1.0 - 0.5 * false_alarm / std::max(1, tried), best.critical);
  const double mean = std::abs(best.change) * (1.0 - std::exp(-1.0));
  if (tried == 0 || !(best.t > best.critical) || mean < least) return std::nullopt;
  best.blocks =
      std::min(n / 2, static_cast<Eigen::Index>(std::ceil(best.fading * std::log(std::abs(best.change) / least))));
  return best;
}

}  // namespace myoid::study
