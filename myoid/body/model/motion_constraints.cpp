#include "myoid/body/model/motion_constraints.h"

#include <algorithm>
#include <variant>

#include "myoid/body/model/body_accelerations.h"
#include "myoid/body/model/constraints.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

/// The acceleration of each row of the constraints other than couplers, for qddot = 0.
class LoopRows {
 public:
  LoopRows(const BodyModel& model, const BodyState& state) : state_(state) {
    compute_accelerations(model, Eigen::VectorXd::Zero(state.q.size()), state, without_qddot_);
  }

  [[nodiscard]] Eigen::VectorXd bias(const FrameConstraint& f) const {
    Eigen::VectorXd rows(f.rotation_too ? 6 : 3);
    rows.head<3>() = point(f.body2, f.X_BF2.p).a - point(f.body1, f.X_BF1.p).a;
    if (f.rotation_too) {
      rows.tail<3>() = without_qddot_.alpha_GB[at(f.body2)] - without_qddot_.alpha_GB[at(f.body1)];
    }
    return rows;
  }
  [[nodiscard]] Eigen::VectorXd bias(const DistanceConstraint& d) const {
    const PointMotion one = point(d.body1, d.p_B1), two = point(d.body2, d.p_B2);
    const double length = (two.p - one.p).norm();
    const Vec3 along = (two.p - one.p) / length;
    const Vec3 v = two.v - one.v;
    const Vec3 turning = v - v.dot(along) * along;
    return Eigen::VectorXd::Constant(1, along.dot(two.a - one.a) + turning.squaredNorm() / length);
  }
  [[nodiscard]] Eigen::VectorXd bias(const LineConstraint& line) const {
    const PointMotion two = point(line.body2, line.p_B2);
    const Pose& X_GB1 = state_.X_GB[at(line.body1)];
    // The point of body 1 at the same place; the remaining motion is relative to body 1.
    const PointMotion here = point(line.body1, X_GB1.inverse() * two.p);
    const Vec3 a = two.a - here.a - 2.0 * state_.w_GB[at(line.body1)].cross(Vec3(two.v - here.v));
    Eigen::VectorXd rows(2);
    const auto directions = directions_across(line.direction);
    for (std::size_t k = 0; k < 2; ++k) rows[static_cast<Eigen::Index>(k)] = (X_GB1.R * directions[k]).dot(a);
    return rows;
  }
  [[nodiscard]] Eigen::VectorXd bias(const FunctionConstraint& f) const {
    const auto count = static_cast<Eigen::Index>(f.independent.size());
    Eigen::VectorXd x(count), rate(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      x[k] = state_.q[f.independent[at(k)]];
      rate[k] = state_.qdot[f.independent[at(k)]];
    }
    // The second derivative along the rates, by differences of the exact gradient.
    const double step = 1e-5 / std::max(1.0, rate.cwiseAbs().maxCoeff());
    const Eigen::VectorXd change =
        evaluate(f.function, x + step * rate).gradient - evaluate(f.function, x - step * rate).gradient;
    return Eigen::VectorXd::Constant(1, -change.dot(rate) / (2.0 * step));
  }
  [[nodiscard]] Eigen::VectorXd bias(const SecondCoupler& second) const {
    const CoordinateCoupler& c = second.coupler;
    const double rate = state_.qdot[c.independent];
    return Eigen::VectorXd::Constant(1, -evaluate(c.function, state_.q[c.independent]).second * rate * rate);
  }

 private:
  [[nodiscard]] PointMotion point(BodyIndex body, const Vec3& p_B) const {
    return without_qddot_.of_station(state_, body, p_B);
  }

  const BodyState& state_;
  BodyAccelerations without_qddot_;
};

void push(std::vector<BodyWrench>& wrenches,
          const BodyState& state,
          BodyIndex body,
          const Vec3& p_G,
          const Vec3& f_G,
          const Vec3& m_G = Vec3::Zero()) {
  const Vec3 arm = p_G - state.X_GB[at(body)].p;
  wrenches.push_back({body, f_G, m_G + arm.cross(f_G)});
}

}  // namespace

std::array<Vec3, 2> directions_across(const Vec3& u) {
  Eigen::Index least = 0;
  u.cwiseAbs().minCoeff(&least);
  const Vec3 v = u.cross(Vec3::Unit(least)).normalized();
  return {v, u.cross(v)};
}

AccelerationConstraints acceleration_constraints(const BodyModel& model, const BodyState& state, double time_s) {
  const Eigen::MatrixXd rows = constraint_jacobian(model, state);
  const Eigen::Index n = state.q.size();
  std::vector<Eigen::Index> held;
  for (Eigen::Index c = 0; c < n; ++c) {
    const Coordinate& k = model.coordinates[at(c)];
    if (k.locked || k.prescribed) held.push_back(c);
  }
  AccelerationConstraints result;
  const Eigen::Index all = rows.rows() + static_cast<Eigen::Index>(held.size());
  result.A = Eigen::MatrixXd::Zero(all, n);
  result.b = Eigen::VectorXd::Zero(all);
  result.A.topRows(rows.rows()) = rows;
  Eigen::Index row = 0;
  for (const CoordinateCoupler& c : model.couplers) {
    const double rate = state.qdot[c.independent];
    result.b[row++] = evaluate(c.function, state.q[c.independent]).second * rate * rate;
  }
  if (!model.constraints.empty()) {
    const LoopRows loops(model, state);
    for (const LoopConstraint& constraint : model.constraints) {
      const Eigen::VectorXd bias = std::visit([&](const auto& law) { return loops.bias(law); }, constraint.law);
      result.b.segment(row, bias.size()) = -bias;
      row += bias.size();
    }
  }
  for (const Eigen::Index c : held) {
    const Coordinate& k = model.coordinates[at(c)];
    result.A(row, c) = 1.0;
    if (k.prescribed && !k.locked) result.b[row] = evaluate(*k.prescribed, time_s).second;
    ++row;
  }
  return result;
}

void append_constraint_wrenches(const BodyModel& model,
                                const BodyState& state,
                                const Eigen::VectorXd& multipliers,
                                std::vector<BodyWrench>& wrenches) {
  auto row = static_cast<Eigen::Index>(model.couplers.size());
  for (const LoopConstraint& constraint : model.constraints) {
    if (const auto* f = std::get_if<FrameConstraint>(&constraint.law)) {
      const Vec3 force = multipliers.segment<3>(row);
      const Vec3 moment = f->rotation_too ? Vec3(multipliers.segment<3>(row + 3)) : Vec3::Zero();
      push(wrenches, state, f->body1, state.X_GB[at(f->body1)] * f->X_BF1.p, -force, -moment);
      push(wrenches, state, f->body2, state.X_GB[at(f->body2)] * f->X_BF2.p, force, moment);
      row += f->rotation_too ? 6 : 3;
    } else if (const auto* d = std::get_if<DistanceConstraint>(&constraint.law)) {
      const Vec3 one = state.X_GB[at(d->body1)] * d->p_B1, two = state.X_GB[at(d->body2)] * d->p_B2;
      const Vec3 force = multipliers[row] * (two - one).normalized();
      push(wrenches, state, d->body1, one, -force);
      push(wrenches, state, d->body2, two, force);
      row += 1;
    } else if (const auto* line = std::get_if<LineConstraint>(&constraint.law)) {
      const Vec3 place = state.X_GB[at(line->body2)] * line->p_B2;
      const auto directions = directions_across(line->direction);
      const Vec3 force =
          state.X_GB[at(line->body1)].R * (multipliers[row] * directions[0] + multipliers[row + 1] * directions[1]);
      push(wrenches, state, line->body1, place, -force);
      push(wrenches, state, line->body2, place, force);
      row += 2;
    } else {
      row += 1;
    }
  }
}

}  // namespace myoid::body
