#include "myoid/body/dynamics/passive_forces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "myoid/body/dynamics/contact_force.h"
#include "myoid/body/kinematics/angular_speeds.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

double smooth_step(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
}

/// Adds a bushing's force by virtual work on the body-fixed X-Y-Z angles and the translation of frame 2 in frame 1.
void append(const body::Bushing& b, const body::BodyState& state, std::vector<body::BodyWrench>& wrenches) {
  const Pose X_GF1 = state.X_GB[at(b.body1)] * b.X_BF1;
  const Pose X_GF2 = state.X_GB[at(b.body2)] * b.X_BF2;
  const Mat3 R = X_GF1.R.transpose() * X_GF2.R;
  const Vec3 angle(std::atan2(-R(1, 2), R(2, 2)), std::asin(std::clamp(R(0, 2), -1.0, 1.0)),
                   std::atan2(-R(0, 1), R(0, 0)));
  const Vec3 shift = X_GF1.R.transpose() * (X_GF2.p - X_GF1.p);
  // Angular velocity in frame 1 = axes * angle rates.
  Mat3 axes;
  axes << 1.0, 0.0, std::sin(angle[1]),                                   //
      0.0, std::cos(angle[0]), -std::sin(angle[0]) * std::cos(angle[1]),  //
      0.0, std::sin(angle[0]), std::cos(angle[0]) * std::cos(angle[1]);
  const Mat3 inverse = axes.inverse();
  const Vec3 w_F1 = X_GF1.R.transpose() * (state.w_GB[at(b.body2)] - state.w_GB[at(b.body1)]);
  const Vec3 angle_rate = inverse * w_F1;
  const Vec3 shift_rate =
      X_GF1.R.transpose() * (point_velocity(state, b.body2, X_GF2.p) - point_velocity(state, b.body1, X_GF2.p));
  Vec3 moment = -(b.rotational_stiffness.cwiseProduct(angle) + b.rotational_damping.cwiseProduct(angle_rate));
  Vec3 force = -(b.translational_stiffness.cwiseProduct(shift) + b.translational_damping.cwiseProduct(shift_rate));
  const std::array<double, 6> deflection{angle[0], angle[1], angle[2], shift[0], shift[1], shift[2]};
  for (std::size_t k = 0; k < 6; ++k) {
    double back = 0.0;
    if (!b.functions.empty()) back += evaluate(b.functions[k], deflection[k]).value;
    if (!b.formulas.empty()) back += b.formulas[k](deflection);
    (k < 3 ? moment : force)[static_cast<Eigen::Index>(k % 3)] -= back;
  }
  const Vec3 m_G = X_GF1.R * (inverse.transpose() * moment);
  const Vec3 f_G = X_GF1.R * force;
  body::BodyWrench second = wrench_at(state, b.body2, X_GF2.p, f_G);
  body::BodyWrench first = wrench_at(state, b.body1, X_GF2.p, -f_G);
  second.m_G += m_G;
  first.m_G -= m_G;
  wrenches.push_back(first);
  wrenches.push_back(second);
}

/// Adds the forces of two points that `pull(distance, its rate)` draws together.
void append_pull(const body::BodyState& state,
                 body::BodyIndex body1,
                 const Vec3& p_B1,
                 body::BodyIndex body2,
                 const Vec3& p_B2,
                 const auto& pull,
                 std::vector<body::BodyWrench>& wrenches) {
  const Vec3 p1 = state.X_GB[at(body1)] * p_B1;
  const Vec3 p2 = state.X_GB[at(body2)] * p_B2;
  const double length = (p2 - p1).norm();
  if (length == 0.0) return;  // no direction
  const Vec3 u = (p2 - p1) / length;
  const double rate = (point_velocity(state, body2, p2) - point_velocity(state, body1, p1)).dot(u);
  const Vec3 force = pull(length, rate) * u;
  wrenches.push_back(wrench_at(state, body1, p1, force));
  wrenches.push_back(wrench_at(state, body2, p2, -force));
}

void append(const body::PrescribedForce& f,
            const body::BodyState& state,
            double time_s,
            std::vector<body::BodyWrench>& wrenches) {
  const Pose X_GF = state.X_GB[at(f.body)] * f.X_BF;
  const auto vector = [&](const std::vector<body::Function>& functions) {
    Vec3 v;
    for (std::size_t k = 0; k < 3; ++k) v[static_cast<Eigen::Index>(k)] = evaluate(functions[k], time_s).value;
    return v;
  };
  const auto in_ground = [&](const Vec3& v) -> Vec3 { return f.force_is_global ? v : X_GF.R * v; };
  if (!f.force.empty()) {
    Vec3 point = X_GF.p;
    if (!f.point.empty()) point = f.point_is_global ? vector(f.point) : Vec3(X_GF * vector(f.point));
    wrenches.push_back(wrench_at(state, f.body, point, in_ground(vector(f.force))));
  }
  if (!f.torque.empty()) wrenches.push_back({f.body, Vec3::Zero(), in_ground(vector(f.torque))});
}

}  // namespace

double limit_force(const body::CoordinateLimitForce& f, double q, double qdot) {
  const double up = smooth_step((q - f.upper_limit) / f.transition);
  const double low = smooth_step((f.lower_limit - q) / f.transition);
  return -up * f.upper_stiffness * (q - f.upper_limit) + low * f.lower_stiffness * (f.lower_limit - q) -
         f.damping * (up + low) * qdot;
}

void append_passive_forces(const body::BodyModel& model,
                           const body::BodyState& state,
                           Eigen::VectorXd& generalized,
                           std::vector<body::BodyWrench>& wrenches,
                           double time_s) {
  body::PathWorkspace workspace;
  body::PathResult path;
  const Eigen::VectorXd speed = body::speeds_of_rates(model, state.q, state.qdot);
  Eigen::VectorXd on_speeds = Eigen::VectorXd::Zero(state.q.size());
  for (const body::PassiveForce& force : model.passive_forces) {
    if (const auto* limit = std::get_if<body::CoordinateLimitForce>(&force.law)) {
      on_speeds[limit->coordinate] += limit_force(*limit, state.q[limit->coordinate], speed[limit->coordinate]);
    } else if (const auto* spring = std::get_if<body::CoordinateSpring>(&force.law)) {
      on_speeds[spring->coordinate] -= spring->stiffness * (state.q[spring->coordinate] - spring->rest) +
                                       spring->viscosity * speed[spring->coordinate];
    } else if (const auto* formula = std::get_if<body::CoordinateFormula>(&force.law)) {
      const std::array<double, 2> at_state{state.q[formula->coordinate], speed[formula->coordinate]};
      on_speeds[formula->coordinate] += formula->force(at_state);
    } else if (const auto* bushing = std::get_if<body::Bushing>(&force.law)) {
      append(*bushing, state, wrenches);
    } else if (const auto* point = std::get_if<body::PointSpring>(&force.law)) {
      append_pull(
          state, point->body1, point->p_B1, point->body2, point->p_B2,
          [&](double d, double) { return point->stiffness_npm * (d - point->rest_length_m); }, wrenches);
    } else if (const auto* pair = std::get_if<body::PointFormula>(&force.law)) {
      append_pull(
          state, pair->body1, pair->p_B1, pair->body2, pair->p_B2,
          [&](double d, double rate) {
            return pair->force(std::array<double, 2>{d, rate});
          },
          wrenches);
    } else if (const auto* prescribed = std::get_if<body::PrescribedForce>(&force.law)) {
      append(*prescribed, state, time_s, wrenches);
    } else if (const auto* contact = std::get_if<body::Contact>(&force.law)) {
      append_contact(*contact, state, wrenches);
    } else if (const auto* line = std::get_if<body::PathSpring>(&force.law)) {
      body::compute_path(model, line->path, state, workspace, path);
      const double stretch = path.length_m - line->rest_length_m;
      if (stretch <= 0.0) continue;
      generalized += path.moment_arm_m * (line->stiffness_npm * stretch * (1.0 + line->dissipation * path.speed_mps));
    } else if (const auto* ligament = std::get_if<body::Ligament>(&force.law)) {
      body::compute_path(model, ligament->path, state, workspace, path);
      if (path.length_m <= ligament->rest_length_m) continue;
      generalized += path.moment_arm_m * ligament->scale_n *
                     evaluate(ligament->force_length, path.length_m / ligament->rest_length_m).value;
    }
  }
  generalized += body::on_rates(model, state.q, std::move(on_speeds));
}

}  // namespace myoid::body
