#include "myoid/results/realtime/predictor.h"

#include <algorithm>
#include <cmath>

namespace myoid::results {
namespace {

using fit::Tension;

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

bool in_range(const body::PathSurrogate& path, const Eigen::VectorXd& q) {
  for (std::size_t i = 0; i < path.coordinates.size(); ++i) {
    const double x = q[path.coordinates[i]];
    const auto k = static_cast<Eigen::Index>(i);
    if (x < path.lower[k] || x > path.upper[k]) return false;
  }
  return true;
}

/// Computes the force of a muscle at the workspace's paths and activations, and its slopes by the
/// muscle's and the channel's chains.
void predict_muscle(const Predictor& p, std::size_t m, PredictorWorkspace& w) {
  const Predictor::Muscle& muscle = p.muscles[m];
  double length_m = 0.0, velocity_mps = 0.0;
  for (const Predictor::Head& head : muscle.heads) {
    length_m += head.weight * w.paths[head.path].length_m;
    velocity_mps += head.weight * w.paths[head.path].speed_mps;
  }
  const fit::Activation& a = w.activations[muscle.channel];
  const Tension t = fit::tension(a.value, length_m, velocity_mps, muscle.values);
  double* slope = w.bands.slopes_of(m);
  for (const Predictor::Chain& c : muscle.chains) *slope++ = t.by_field[static_cast<std::size_t>(c.field)] * c.slope;
  for (const Predictor::Chain& c : p.channels[muscle.channel].chains)
    *slope++ = t.by_activation * a.by_field[static_cast<std::size_t>(c.field)] * c.slope;
  w.force_n[static_cast<Eigen::Index>(m)] = t.force_n;
}

/// Computes the torque of a joint, with the moment arms and the joint's own slopes for the bands.
void predict_joint(const Predictor& p, std::size_t j, PredictorWorkspace& w) {
  using namespace fit;
  const Predictor::Joint& joint = p.joints[j];
  const auto column = static_cast<Eigen::Index>(j);
  double torque = 0.0;
  for (std::size_t m = 0; m < p.muscles.size(); ++m) {
    const auto row = static_cast<Eigen::Index>(m);
    double arm_m = 0.0;
    for (const Predictor::Head& head : p.muscles[m].heads)
      arm_m += head.weight * w.paths[head.path].moment_arm_m[joint.coordinate];
    torque += arm_m * w.force_n[row];
    w.bands.arms(row, column) = arm_m;
  }
  const double angle = w.q[joint.coordinate], speed = w.qdot[joint.coordinate];
  // T = sum r F - viscosity qdot - inertia qddot - stiffness q + offset, without the acceleration
  const JointValues by{-speed, 0.0, -angle, 1.0};
  for (std::size_t f = 0; f < by.size(); ++f) torque += by[f] * joint.values[f];
  w.torque_nm[column] = torque;
  double* slope = w.bands.slopes_of(p.muscles.size() + j);
  for (const Predictor::Chain& c : joint.chains) *slope++ = by[static_cast<std::size_t>(c.field)] * c.slope;
}

/// Returns the unknowns of the chains of each muscle with its channel's, then of each joint.
BandSpace band_space(const Predictor& p) {
  std::vector<std::vector<Eigen::Index>> variables;
  const auto add = [&](const std::vector<Predictor::Chain>& chains) {
    for (const Predictor::Chain& c : chains) variables.back().push_back(c.variable);
  };
  for (const Predictor::Muscle& muscle : p.muscles) {
    variables.emplace_back();
    add(muscle.chains);
    add(p.channels[muscle.channel].chains);
  }
  for (const Predictor::Joint& joint : p.joints) {
    variables.emplace_back();
    add(joint.chains);
  }
  return {p.covariance, variables, p.joints.size()};
}

}  // namespace

PredictorWorkspace workspace_for(const Predictor& p) {
  PredictorWorkspace w;
  const auto joints = static_cast<Eigen::Index>(p.joints.size());
  const auto muscles = static_cast<Eigen::Index>(p.muscles.size());
  w.torque_nm.setZero(joints);
  w.torque_sd_nm.setZero(joints);
  w.force_n.setZero(muscles);
  w.force_sd_n.setZero(muscles);
  w.q = p.default_q;
  w.qdot.setZero(p.default_q.size());
  w.tables.resize(p.paths.size());
  w.paths.resize(p.paths.size());
  w.activations.resize(p.channels.size());
  w.following.resize(p.channels.size());
  w.bands = band_space(p);
  // The tables get their sizes here.
  for (std::size_t i = 0; i < p.paths.size(); ++i) body::evaluate(p.paths[i], w.q, w.qdot, w.tables[i], w.paths[i]);
  return w;
}

void follow(const Predictor& p,
            std::span<const double> envelope,
            double step_s,
            PredictorWorkspace& w,
            std::span<double> acting) {
  using namespace fit;
  for (std::size_t c = 0; c < p.channels.size(); ++c) {
    const Predictor::Channel& channel = p.channels[c];
    const double u = envelope[c];
    if (!channel.lags) {
      acting[c] = u;
      continue;
    }
    PredictorWorkspace::Following& f = w.following[c];
    if (!f.begun) f = {true, u, u, u};
    const double input = 0.5 * (f.envelope + u);
    const double before = f.excitation;
    f.excitation = input + std::exp(-step_s / channel.values[kExcitationTime]) * (before - input);
    const double middle = 0.5 * (before + f.excitation);  // drives the activation in this step
    const double time_s = channel.values[middle >= f.activation ? kActivationTime : kDeactivationTime];
    f.activation = middle + std::exp(-step_s / time_s) * (f.activation - middle);
    f.envelope = u;
    acting[c] = f.activation;
  }
}

fit::Activation activation_at(double envelope, const fit::ChannelValues& channel) {
  using namespace fit;
  constexpr double kLeast = 1e-4;  // below it u^p is a straight line, as in the fit
  constexpr double kFlat = 1e-4;   // shapes below it are parabolas
  Activation a;
  const double p = channel[kExponent], g = channel[kGain], A = channel[kShape];
  const double log_u = std::log(std::max(envelope, kLeast));
  const double raised = envelope * std::exp((p - 1.0) * log_u);
  const double v = g * raised;
  double by_v = 1.0 + A * (v - 0.5), by_shape = 0.5 * v * (v - 1.0);
  a.value = v + A * by_shape;
  if (std::abs(A) >= kFlat) {
    const double below = std::expm1(A), above = std::expm1(A * v);
    a.value = above / below;
    by_v = A * (above + 1.0) / below;
    by_shape = (v * (above + 1.0) * below - above * (below + 1.0)) / (below * below);
  }
  a.by_field[kGain] = by_v * raised;
  a.by_field[kExponent] = by_v * v * log_u;
  a.by_field[kShape] = by_shape;
  return a;
}

Prediction predict(const Predictor& p,
                   std::span<const double> envelope,
                   std::span<const double> angle_rad,
                   std::span<const double> speed_radps,
                   PredictorWorkspace& w,
                   bool with_bands) {
  if (!all_finite(envelope) || !all_finite(angle_rad) || !all_finite(speed_radps) ||
      std::any_of(envelope.begin(), envelope.end(), [](double u) { return u < 0.0; }))
    return Prediction::not_a_number;
  for (std::size_t j = 0; j < p.joints.size(); ++j) {
    w.q[p.joints[j].coordinate] = angle_rad[j];
    w.qdot[p.joints[j].coordinate] = speed_radps[j];
  }
  for (std::size_t i = 0; i < p.paths.size(); ++i) {
    if (!in_range(p.paths[i], w.q)) return Prediction::out_of_range;
    body::evaluate(p.paths[i], w.q, w.qdot, w.tables[i], w.paths[i]);
  }
  for (std::size_t c = 0; c < p.channels.size(); ++c)
    w.activations[c] = activation_at(envelope[c], p.channels[c].values);
  for (std::size_t m = 0; m < p.muscles.size(); ++m) predict_muscle(p, m, w);
  for (std::size_t j = 0; j < p.joints.size(); ++j) predict_joint(p, j, w);
  if (!with_bands) return Prediction::done;
  w.bands.compute(p.covariance);
  w.force_sd_n = w.bands.force_variance.cwiseMax(0.0).cwiseSqrt();
  w.torque_sd_nm = (w.bands.torque_variance.array().max(0.0) + p.torque_sd_nm * p.torque_sd_nm).sqrt();
  return Prediction::done;
}

}  // namespace myoid::results
