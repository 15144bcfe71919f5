#include "myoid/math/finite_difference.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/core/numbers.h"

namespace myoid::math {
namespace {

/// Options with empty vectors filled in, checked.
DifferenceOptions filled(const DifferenceOptions& options, const Eigen::VectorXd& x) {
  DifferenceOptions full = options;
  const Eigen::Index n = x.size();
  if (full.scale.size() == 0) full.scale = Eigen::VectorXd::Ones(n);
  if (full.lower.size() == 0) full.lower = Eigen::VectorXd::Constant(n, -kInfinity);
  if (full.upper.size() == 0) full.upper = Eigen::VectorXd::Constant(n, kInfinity);
  if (full.scale.size() != n || full.lower.size() != n || full.upper.size() != n)
    throw InvalidInput(fmt::format("finite differences: options for another size than {}", n));
  if (!x.allFinite() ||
      !((x.array() >= full.lower.array()) && (x.array() <= full.upper.array())).all())
    throw InvalidInput("finite differences: the point is not finite or outside its bounds");
  if (!(full.first_step > 0.0) || full.refinements < 1 || !(full.scale.array() > 0.0).all())
    throw InvalidInput("finite differences: first_step, scale and refinements must be positive");
  return full;
}

/// The steps' sides: +-h, or 0, h, 2h to the side that is free.
struct Stencil {
  double first_step = 0.0;  ///< 0: the bounds leave no room.
  int side = 0;             ///< 0 central, +1 or -1 one-sided.
};

Stencil stencil(const DifferenceOptions& options, const Eigen::VectorXd& x, Eigen::Index j) {
  const double wanted = options.first_step * std::max(std::abs(x[j]), options.scale[j]);
  const double below = x[j] - options.lower[j], above = options.upper[j] - x[j];
  const double room = std::min(below, above);
  if (room >= 1e-6 * wanted && room > 0.0) return {std::min(wanted, room), 0};
  const double free = std::max(below, above);
  if (!(free > 0.0)) return {};
  return {std::min(wanted, 0.5 * free), above > below ? 1 : -1};
}

/// One column of the Jacobian: all rows extrapolated together, each keeps its own best entry.
class Extrapolation {
 public:
  Extrapolation(Eigen::Index rows, bool central)
      : central_(central),
        value_(Eigen::VectorXd::Zero(rows)),
        change_(Eigen::VectorXd::Constant(rows, kInfinity)),
        step_(Eigen::VectorXd::Ones(rows)) {}

  /// Adds the difference quotient of `step`, half as long as the one before.
  void add(const Eigen::VectorXd& quotient, double step) {
    std::vector<Eigen::VectorXd> row{quotient};
    // Errors: central h^2, h^4, ...; one-sided second-order quotients h^2, h^3, ...
    for (std::size_t k = 1; k <= last_.size(); ++k) {
      const double power = central_ ? 2.0 * static_cast<double>(k) : static_cast<double>(k) + 1.0;
      const double factor = std::pow(2.0, power);
      const Eigen::VectorXd better = (factor * row[k - 1] - last_[k - 1]) / (factor - 1.0);
      for (Eigen::Index i = 0; i < better.size(); ++i) {
        const double change =
            std::max(std::abs(better[i] - row[k - 1][i]), std::abs(better[i] - last_[k - 1][i]));
        if (change <= change_[i]) {
          change_[i] = change;
          value_[i] = better[i];
          step_[i] = step;
        }
      }
      row.push_back(better);
    }
    if (last_.size() > 1) noise_.push_back((row[1] - last_[1]).cwiseAbs() * step);
    last_ = row;
  }
  void forget() { last_.clear(); }

  [[nodiscard]] const Eigen::VectorXd& value() const { return value_; }
  /// The change, and the noise of f over the step: the shortest steps show it, and a small change
  /// among many noisy ones is luck.
  [[nodiscard]] Eigen::VectorXd error() const {
    Eigen::VectorXd noise = Eigen::VectorXd::Zero(value_.size());
    const std::size_t first = noise_.size() > 4 ? noise_.size() - 4 : 0;
    for (std::size_t k = first; k < noise_.size(); ++k) noise = noise.cwiseMax(noise_[k]).eval();
    return change_ + noise.cwiseQuotient(step_);
  }

 private:
  bool central_;
  std::vector<Eigen::VectorXd> last_, noise_;
  Eigen::VectorXd value_, change_, step_;
};

}  // namespace

JacobianEstimate jacobian_by_differences(const VectorFunction& r,
                                         const Eigen::VectorXd& x,
                                         const DifferenceOptions& options) {
  const DifferenceOptions full = filled(options, x);
  JacobianEstimate result;
  const Eigen::VectorXd here = r(x);
  const Eigen::Index rows = here.size();
  result.evaluations = 1;
  result.value = Eigen::MatrixXd::Zero(rows, x.size());
  result.error = Eigen::MatrixXd::Constant(rows, x.size(), kInfinity);
  const auto at = [&](Eigen::Index j, double offset) {
    Eigen::VectorXd moved = x;
    moved[j] = std::clamp(x[j] + offset, full.lower[j], full.upper[j]);
    ++result.evaluations;
    Eigen::VectorXd value = r(moved);
    if (value.size() != rows) {
      throw InvalidInput(fmt::format("finite differences: the function has {} entries, then {}",
                                     rows, value.size()));
    }
    return value;
  };
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const Stencil shape = stencil(full, x, j);
    if (shape.first_step == 0.0) continue;
    Extrapolation table(rows, shape.side == 0);
    double h = shape.first_step;
    for (int k = 0; k <= full.refinements; ++k, h *= 0.5) {
      Eigen::VectorXd quotient;
      if (shape.side == 0) {
        // Divided by the steps as rounded, not as meant.
        const double up = (x[j] + h) - x[j], down = x[j] - (x[j] - h);
        quotient = (at(j, h) - at(j, -h)) / (up + down);
      } else {
        const double s = shape.side;
        quotient = s * (4.0 * at(j, s * h) - at(j, 2.0 * s * h) - 3.0 * here) / (2.0 * h);
      }
      if (!quotient.allFinite()) {
        table.forget();
        continue;
      }
      table.add(quotient, h);
    }
    result.value.col(j) = table.value();
    result.error.col(j) = table.error();
  }
  return result;
}

GradientEstimate gradient_by_differences(const ScalarFunction& f,
                                         const Eigen::VectorXd& x,
                                         const DifferenceOptions& options) {
  const JacobianEstimate row = jacobian_by_differences(
      [&](const Eigen::VectorXd& at) {
        return Eigen::VectorXd(Eigen::VectorXd::Constant(1, f(at)));
      },
      x, options);
  return {.value = row.value.row(0).transpose(),
          .error = row.error.row(0).transpose(),
          .evaluations = row.evaluations};
}

double jacobian_discrepancy(const Eigen::MatrixXd& analytic, const JacobianEstimate& differences) {
  if (analytic.rows() != differences.value.rows() || analytic.cols() != differences.value.cols()) {
    throw InvalidInput(fmt::format("finite differences: a Jacobian of {} x {} against {} x {}",
                                   analytic.rows(), analytic.cols(), differences.value.rows(),
                                   differences.value.cols()));
  }
  double largest = 0.0;
  for (Eigen::Index j = 0; j < analytic.cols(); ++j) {
    const double size = std::max(differences.value.col(j).cwiseAbs().maxCoeff(),
                                 analytic.col(j).cwiseAbs().maxCoeff());
    for (Eigen::Index i = 0; i < analytic.rows(); ++i) {
      const double error = differences.error(i, j);
      if (!std::isfinite(error)) continue;
      const double off = std::abs(analytic(i, j) - differences.value(i, j));
      if (off > 0.0) largest = std::max(largest, off / (size + 10.0 * error));
      if (!std::isfinite(off)) largest = kInfinity;
    }
  }
  return largest;
}

}  // namespace myoid::math
