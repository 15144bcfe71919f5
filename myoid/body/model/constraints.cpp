#include "myoid/body/model/constraints.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "myoid/body/model/motion_constraints.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/math/decompositions.h"

namespace myoid::body {
namespace {

Eigen::Index rows_of(const LoopConstraint& constraint) {
  if (const auto* frame = std::get_if<FrameConstraint>(&constraint.law)) return frame->rotation_too ? 6 : 3;
  return std::holds_alternative<LineConstraint>(constraint.law) ? 2 : 1;
}

Eigen::Index loop_rows(const BodyModel& model) {
  Eigen::Index rows = 0;
  for (const LoopConstraint& constraint : model.constraints) rows += rows_of(constraint);
  return rows;
}

MultiPolynomialValue function_value(const FunctionConstraint& f, const Eigen::VectorXd& q) {
  Eigen::VectorXd x(static_cast<Eigen::Index>(f.independent.size()));
  for (std::size_t k = 0; k < f.independent.size(); ++k) x[static_cast<Eigen::Index>(k)] = q[f.independent[k]];
  return evaluate(f.function, x);
}

}  // namespace

LoopEquations loop_equations(const BodyModel& model, const BodyState& state) {
  const Eigen::Index rows = loop_rows(model);
  LoopEquations result{Eigen::VectorXd(rows), Eigen::MatrixXd(rows, std::ssize(model.coordinates))};
  auto& [errors, jacobian] = result;
  Eigen::Index row = 0;
  const auto relative = [&](BodyIndex b1, const Vec3& p1, BodyIndex b2, const Vec3& p2) {
    return Eigen::Matrix3Xd(station_jacobian(model, state, b2, p2) - station_jacobian(model, state, b1, p1));
  };
  for (const LoopConstraint& constraint : model.constraints) {
    if (const auto* f = std::get_if<FrameConstraint>(&constraint.law)) {
      const Pose X_GF1 = state.X_GB[at(f->body1)] * f->X_BF1;
      const Pose X_GF2 = state.X_GB[at(f->body2)] * f->X_BF2;
      errors.segment<3>(row) = X_GF2.p - X_GF1.p;
      jacobian.middleRows<3>(row) = relative(f->body1, f->X_BF1.p, f->body2, f->X_BF2.p);
      if (f->rotation_too) {
        // Half the sum of the cross products of the axes: the sine of the angle, about its axis.
        Vec3 sine = Vec3::Zero();
        for (int k = 0; k < 3; ++k) sine += 0.5 * X_GF1.R.col(k).cross(X_GF2.R.col(k));
        errors.segment<3>(row + 3) = sine;
        jacobian.middleRows<3>(row + 3) =
            angular_jacobian(model, state, f->body2) - angular_jacobian(model, state, f->body1);
      }
    } else if (const auto* d = std::get_if<DistanceConstraint>(&constraint.law)) {
      const Vec3 between = state.X_GB[at(d->body2)] * d->p_B2 - state.X_GB[at(d->body1)] * d->p_B1;
      errors[row] = between.norm() - d->distance_m;
      jacobian.row(row) = between.normalized().transpose() * relative(d->body1, d->p_B1, d->body2, d->p_B2);
    } else if (const auto* second = std::get_if<SecondCoupler>(&constraint.law)) {
      const CoordinateCoupler& c = second->coupler;
      const FunctionValue v = evaluate(c.function, state.q[c.independent]);
      errors[row] = state.q[c.dependent] - v.value;
      jacobian.row(row).setZero();
      jacobian(row, c.dependent) = 1.0;
      jacobian(row, c.independent) -= v.first;
    } else if (const auto* coupled = std::get_if<FunctionConstraint>(&constraint.law)) {
      const MultiPolynomialValue v = function_value(*coupled, state.q);
      errors[row] = state.q[coupled->dependent] - v.value;
      jacobian.row(row).setZero();
      jacobian(row, coupled->dependent) = 1.0;
      for (std::size_t k = 0; k < coupled->independent.size(); ++k)
        jacobian(row, coupled->independent[k]) -= v.gradient[static_cast<Eigen::Index>(k)];
    } else {
      const auto& line = std::get<LineConstraint>(constraint.law);
      const Pose& X_GB1 = state.X_GB[at(line.body1)];
      const Vec3 p_G = state.X_GB[at(line.body2)] * line.p_B2;
      // The follower as a point that moves with body 1.
      const Vec3 p_B1 = X_GB1.inverse() * p_G;
      const auto directions = directions_across(line.direction);
      for (int k = 0; k < 2; ++k) {
        const Vec3 u_G = X_GB1.R * directions[at(k)];
        errors[row + k] = directions[at(k)].dot(p_B1 - line.p_B1);
        jacobian.row(row + k) = u_G.transpose() * relative(line.body1, p_B1, line.body2, line.p_B2);
      }
    }
    row += rows_of(constraint);
  }
  return result;
}

void apply_couplers(const BodyModel& model, Eigen::VectorXd& q) {
  for (std::size_t round = 0; round <= model.couplers.size(); ++round) {
    bool changed = false;
    for (const CoordinateCoupler& c : model.couplers) {
      const double value = evaluate(c.function, q[c.independent]).value;
      changed = changed || value != q[c.dependent];
      q[c.dependent] = value;
    }
    if (!changed || !q.allFinite()) return;
  }
  throw ModelError("coordinate couplers depend on each other in a circle");
}

Eigen::MatrixXd constraint_jacobian(const BodyModel& model, const BodyState& state) {
  const auto couplers = static_cast<Eigen::Index>(model.couplers.size());
  const auto count = static_cast<Eigen::Index>(model.coordinates.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(couplers + loop_rows(model), count);
  for (Eigen::Index k = 0; k < couplers; ++k) {
    const CoordinateCoupler& c = model.couplers[at(k)];
    A(k, c.dependent) = 1.0;
    A(k, c.independent) -= evaluate(c.function, state.q[c.independent]).first;
  }
  if (!model.constraints.empty()) A.bottomRows(A.rows() - couplers) = loop_equations(model, state).jacobian;
  return A;
}

Eigen::MatrixXd coupling_matrix(const BodyModel& model, const BodyState& state) {
  const auto count = static_cast<Eigen::Index>(model.coordinates.size());
  Eigen::MatrixXd C = Eigen::MatrixXd::Identity(count, count);
  if (model.couplers.empty() && model.constraints.empty()) return C;
  const Eigen::MatrixXd A = constraint_jacobian(model, state);
  std::vector<Eigen::Index> involved;
  for (Eigen::Index c = 0; c < count; ++c) {
    if (A.col(c).cwiseAbs().maxCoeff() > 0.0) involved.push_back(c);
  }
  const auto n = static_cast<Eigen::Index>(involved.size());
  Eigen::MatrixXd reduced(A.rows(), n);
  for (Eigen::Index k = 0; k < n; ++k) reduced.col(k) = A.col(involved[at(k)]);
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::MatrixXd rows = reduced;
    for (Eigen::Index j = 0; j < n; ++j) {
      const int c = static_cast<int>(involved[at(j)]);
      if (j == k || !model.coordinates[at(c)].locked) continue;
      rows.conservativeResize(rows.rows() + 1, n);
      rows.bottomRows<1>().setZero();
      rows(rows.rows() - 1, j) = 1.0;
    }
    // The rates nearest to the unit rate that obey all rows.
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(n, k);
    const Eigen::VectorXd rates = unit - math::shortest_solution(rows, rows * unit);
    const Eigen::Index c = involved[at(k)];
    C.col(c).setZero();
    if (!(std::abs(rates[k]) > 1e-12)) continue;
    for (Eigen::Index j = 0; j < n; ++j) C(involved[at(j)], c) = rates[j] / rates[k];
  }
  return C;
}

namespace {

/// The coordinates that assembly may move, each with the inverse root of its weight.
struct Movable {
  std::vector<Eigen::Index> coordinate;
  Eigen::VectorXd loose;
};

Movable movable(const BodyModel& model) {
  Movable free;
  for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
    const Coordinate& k = model.coordinates[c];
    if (k.locked || k.prescribed) continue;
    if (std::ranges::find(model.couplers, static_cast<int>(c), &CoordinateCoupler::dependent) != model.couplers.end())
      continue;
    free.coordinate.push_back(static_cast<Eigen::Index>(c));
    free.loose.conservativeResize(free.loose.size() + 1);
    free.loose[free.loose.size() - 1] = k.is_free_to_satisfy_constraints ? 1e3 : 1.0;
  }
  return free;
}

/// Returns the step from q to the desired posture, in scaled coordinates.
Eigen::VectorXd way_to(const Movable& free, const Eigen::VectorXd& wished, const Eigen::VectorXd& q) {
  Eigen::VectorXd way(free.loose.size());
  for (Eigen::Index k = 0; k < way.size(); ++k) {
    const Eigen::Index c = free.coordinate[at(k)];
    way[k] = (wished[c] - q[c]) / free.loose[k];
  }
  return way;
}

/// Returns a posture that meets the constraints and is locally nearest to the desired one.
AssemblyResult approach(const BodyModel& model,
                        const Movable& free,
                        const Eigen::VectorXd& wished,
                        const Eigen::VectorXd& start,
                        double accuracy) {
  const Eigen::Index n = free.loose.size();
  AssemblyResult result{start, 0.0, false};
  BodyState state = make_state(model);
  for (int iteration = 0; iteration < 100; ++iteration) {
    compute_poses(model, result.q, state);
    const auto [errors, J] = loop_equations(model, state);
    result.error = errors.cwiseAbs().maxCoeff();
    if (n == 0) break;
    // Dependent coordinates follow: dq = T dq_free.
    Eigen::MatrixXd T = Eigen::MatrixXd::Zero(result.q.size(), n);
    for (Eigen::Index k = 0; k < n; ++k) T(free.coordinate[at(k)], k) = free.loose[k];
    for (std::size_t round = 0; round < model.couplers.size(); ++round) {
      for (const CoordinateCoupler& c : model.couplers)
        T.row(c.dependent) = evaluate(c.function, result.q[c.independent]).first * T.row(c.independent);
    }
    const Eigen::MatrixXd A = J * T;
    const Eigen::VectorXd back = way_to(free, wished, result.q);
    // The point nearest to the desired posture on the linearized constraints.
    const Eigen::VectorXd step = back - math::shortest_solution(A, A * back + errors);
    const double longest = step.cwiseAbs().maxCoeff();
    if (result.error < accuracy && longest < 1e-10) break;
    const double share = longest > 0.5 ? 0.5 / longest : 1.0;
    for (Eigen::Index k = 0; k < n; ++k) result.q[free.coordinate[at(k)]] += share * free.loose[k] * step[k];
    apply_couplers(model, result.q);
  }
  result.converged = result.error < accuracy;
  return result;
}

}  // namespace

AssemblyResult assemble(const BodyModel& model, const Eigen::Ref<const Eigen::VectorXd>& q, double accuracy) {
  AssemblyResult result{q, 0.0, true};
  apply_couplers(model, result.q);
  if (model.constraints.empty()) return result;
  // A coordinate that depends on several others has no desired value of its own.
  for (std::size_t round = 0; round < model.constraints.size(); ++round) {
    for (const LoopConstraint& constraint : model.constraints) {
      if (const auto* f = std::get_if<FunctionConstraint>(&constraint.law))
        result.q[f->dependent] = function_value(*f, result.q).value;
    }
  }
  apply_couplers(model, result.q);
  const Eigen::VectorXd wished = result.q;
  const Movable free = movable(model);
  if (free.coordinate.empty()) return approach(model, free, wished, wished, accuracy);
  result = approach(model, free, wished, wished, accuracy);
  // A distant solution may be only locally nearest: try again from the default posture.
  constexpr double kFar = 0.1;
  const double distance = way_to(free, wished, result.q).norm();
  if (result.converged && distance < kFar) return result;
  Eigen::VectorXd start = model.default_q();
  for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
    if (model.coordinates[c].locked || model.coordinates[c].prescribed)
      start[static_cast<Eigen::Index>(c)] = wished[static_cast<Eigen::Index>(c)];
  }
  apply_couplers(model, start);
  AssemblyResult other = approach(model, free, wished, start, accuracy);
  const bool nearer = way_to(free, wished, other.q).norm() < distance;
  return other.converged && (nearer || !result.converged) ? other : result;
}

}  // namespace myoid::body
