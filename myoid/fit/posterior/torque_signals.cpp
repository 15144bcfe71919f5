#include "myoid/fit/posterior/torque_signals.h"

#include <algorithm>

#include "myoid/fit/measurement/muscle_law.h"
#include "myoid/fit/posterior/drive.h"

namespace myoid::fit {
namespace {

constexpr double kActivationStep = 0.02;
constexpr double kLeastUnseen = 1e-4;  // without EMG
const std::vector<ParameterMap::Chain> kNoChains;

/// Returns the activations at an envelope larger by kActivationStep: a (1 + h p).
std::vector<Activation> more_active(std::vector<Activation> activation, double exponent) {
  const double grown = 1.0 + kActivationStep * exponent;
  for (Activation& a : activation) {
    const double before = a.value;
    a.value *= grown;
    for (double& by : a.by_field) by *= grown;
    a.by_field[kExponent] += kActivationStep * before;
  }
  return activation;
}

/// Returns true where force is proportional to activation, also for other values of the unknowns.
bool is_proportional(const MuscleValues& values, const std::vector<ParameterMap::Chain>& chains) {
  return is_plain(values) && values[kLengthActivation] == 0.0 &&
         std::all_of(chains.begin(), chains.end(), [](const ParameterMap::Chain& chain) {
           return is_plain_field(chain.field) && chain.field != kLengthActivation;
         });
}

/// Adds the gradient by `variables` of a function whose gradient is `by`, n, given their derivatives, v x n.
void add_gradient(const std::vector<Eigen::Index>& variables,
                  const Eigen::MatrixXd& by_variable,
                  const Eigen::VectorXd& by,
                  Eigen::VectorXd& by_z) {
  const Eigen::VectorXd gradient = by_variable * by;
  for (std::size_t v = 0; v < variables.size(); ++v) by_z[variables[v]] += gradient[static_cast<Eigen::Index>(v)];
}
void add_gradient(const MuscleRows& rows, const Eigen::VectorXd& by_force, Eigen::VectorXd& by_z) {
  add_gradient(rows.variables, rows.by_variable, by_force, by_z);
}

}  // namespace

Eigen::VectorXd TorqueSignals::all() const {
  Eigen::VectorXd rows(torque_nm.size() + fiber_m.size());
  rows << torque_nm, fiber_m;
  return rows;
}

RunEvaluation::RunEvaluation(
    const TrialRun& run, const ParameterMap& map, EmgLag lag, const ModelValues& values, const ChainsByOwner* chains)
    : run_(run), chains_(chains), muscles_(values.muscles.size()) {
  const Eigen::Index n = run.time_s.size();
  const auto channels = static_cast<Eigen::Index>(run.envelopes.size());
  signals_.torque_nm = run.resting_nm;
  signals_.by_noise.setZero(run.row_count(), channels);
  for (std::size_t j = 0; j < run.joints.size(); ++j) {
    const JointValues& joint = values.joints[static_cast<std::size_t>(run.joints[j])];
    const auto motion = run.motion.middleRows(run.first_row(j), n);
    for (int field = 0; field < kJointFieldCount; ++field) {
      const double value = joint[static_cast<std::size_t>(field)];
      if (value != 0.0) signals_.torque_nm.segment(run.first_row(j), n) += value * by_joint_field(field, n, motion);
    }
  }
  exponent_.resize(channels);
  gain_.setOnes(n, channels);
  gain_by_delay_.setZero(n, channels);
  for (std::size_t c = 0; c < run.envelopes.size(); ++c) {
    const auto column = static_cast<Eigen::Index>(c);
    const std::vector<Envelope::Value> delayed = run.envelopes[c].at(run.time_s, values.channels[c][kDelay]);
    const bool unseen = !run.parts[c].empty();
    for (Eigen::Index i = 0; i < n && (unseen || run.rest[column] > 0.0); ++i) {
      const Envelope::Value& u = delayed[static_cast<std::size_t>(i)];
      if (unseen) {  // The error of an activation does not grow with it, and belongs to the reference.
        gain_(i, column) = 1.0 / std::max(u.value, kLeastUnseen);
        continue;
      }
      const NoiseOverEnvelope noise = noise_over_envelope(u.value, run.envelope_sd[column], run.rest[column]);
      gain_(i, column) = noise.value;
      gain_by_delay_(i, column) = -noise.slope * u.slope;
    }
    activations_.push_back(lag == EmgLag::delay ? activation(delayed, values.channels[c])
                                                : activation(run.envelopes[c], run.time_s, values.channels[c], lag));
    exponent_[column] = values.channels[c][kExponent];
  }
  for (std::size_t k = 0; k < muscles_.size(); ++k) {
    muscles_[k].channel = map.channel_of_muscle(k);
    add_muscle(k, values.muscles[k]);
  }
  signals_.fiber_m.resize(run.all_rows() - run.row_count());
  for (std::size_t i = 0; i < run.fascicles.size(); ++i) {
    const std::size_t k = run.fascicles[i];
    fibers_.push_back(fiber_rows(muscles_[k].at, run.length_m.col(static_cast<Eigen::Index>(k)), values.muscles[k],
                                 chains == nullptr ? kNoChains : chains->of_muscle[k]));
    signals_.fiber_m.segment(static_cast<Eigen::Index>(i) * n, n) = fibers_.back().length_m;
  }
}

void RunEvaluation::add_muscle(std::size_t k, const MuscleValues& values) {
  Muscle& m = muscles_[k];
  const auto column = static_cast<Eigen::Index>(k);
  const auto c = static_cast<std::size_t>(m.channel);
  const auto& of_muscle = chains_ == nullptr ? kNoChains : chains_->of_muscle[k];
  const auto evaluate = [&](const std::vector<Activation>& a, MuscleRows& rows) {
    evaluate_muscle(a, run_.length_m.col(column), run_.velocity_mps.col(column), values, of_muscle,
                    chains_ == nullptr ? kNoChains : chains_->of_channel[c], rows);
  };
  evaluate(activations_[c], m.at);
  m.proportional = is_proportional(values, of_muscle);
  if (!m.proportional) evaluate(more_active(activations_[c], exponent_[m.channel]), m.more_active);
  const Eigen::ArrayXd by_log_envelope = m.proportional
                                             ? Eigen::ArrayXd(exponent_[m.channel] * m.at.force_n.array())
                                             : (m.more_active.force_n - m.at.force_n).array() / kActivationStep;
  const Eigen::Index n = run_.time_s.size();
  for (std::size_t j = 0; j < run_.joints.size(); ++j) {
    const Eigen::Index first = run_.first_row(j);
    const auto arm = run_.arm_m.col(column).segment(first, n).array();
    signals_.torque_nm.segment(first, n).array() += arm * m.at.force_n.array();
    signals_.by_noise.col(m.channel).segment(first, n).array() += gain_.col(m.channel).array() * arm * by_log_envelope;
  }
}

void RunEvaluation::pull_back(const TorqueSignals& by, Eigen::VectorXd& by_z) const {
  const Eigen::Index n = run_.time_s.size();
  for (std::size_t j = 0; j < run_.joints.size(); ++j) {
    const Eigen::Index first = run_.first_row(j);
    const auto motion = run_.motion.middleRows(first, n);
    for (const ParameterMap::Chain& chain : own_chains(j))
      by_z[chain.variable] += chain.slope * by.torque_nm.segment(first, n).dot(by_joint_field(chain.field, n, motion));
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(muscles_.size()); ++k) {
      const Muscle& m = muscles_[static_cast<std::size_t>(k)];
      const auto arm = run_.arm_m.col(k).segment(first, n).array();
      const Eigen::ArrayXd more =
          arm * by.by_noise.col(m.channel).segment(first, n).array() * gain_.col(m.channel).array();
      const Eigen::ArrayXd of_force = arm * by.torque_nm.segment(first, n).array();
      if (!m.proportional) {
        add_gradient(m.at, of_force - more / kActivationStep, by_z);
        add_gradient(m.more_active, more / kActivationStep, by_z);
        continue;
      }
      add_gradient(m.at, of_force + exponent_[m.channel] * more, by_z);
      for (const ParameterMap::Chain& chain : chains_->of_channel[static_cast<std::size_t>(m.channel)]) {
        if (chain.field == kExponent) by_z[chain.variable] += chain.slope * (more * m.at.force_n.array()).sum();
      }
    }
  }
  for (std::size_t i = 0; i < fibers_.size() && by.fiber_m.size() > 0; ++i) {
    add_gradient(muscles_[run_.fascicles[i]].at.variables, fibers_[i].by_variable,
                 by.fiber_m.segment(static_cast<Eigen::Index>(i) * n, n), by_z);
  }
  // The noise moves with the envelope when the delay changes.
  for (std::size_t c = 0; c < chains_->of_channel.size(); ++c) {
    const auto column = static_cast<Eigen::Index>(c);
    double by_delay = 0.0;
    for (std::size_t j = 0; j < run_.joints.size(); ++j) {
      const Eigen::Index first = run_.first_row(j);
      by_delay +=
          (by.by_noise.col(column).segment(first, n).array() * signals_.by_noise.col(column).segment(first, n).array() *
           gain_by_delay_.col(column).array() / gain_.col(column).array())
              .sum();
    }
    for (const ParameterMap::Chain& chain : chains_->of_channel[c])
      if (chain.field == kDelay) by_z[chain.variable] += chain.slope * by_delay;
  }
}

Eigen::MatrixXd RunEvaluation::jacobian(Eigen::Index unknowns) const {
  const Eigen::Index n = run_.time_s.size();
  Eigen::MatrixXd by_z = Eigen::MatrixXd::Zero(run_.all_rows(), unknowns);
  for (std::size_t j = 0; j < run_.joints.size(); ++j) {
    const auto motion = run_.motion.middleRows(run_.first_row(j), n);
    auto of_joint = by_z.middleRows(run_.first_row(j), n);
    for (const ParameterMap::Chain& chain : own_chains(j))
      of_joint.col(chain.variable) += chain.slope * by_joint_field(chain.field, n, motion);
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(muscles_.size()); ++k) {
      const MuscleRows& rows = muscles_[static_cast<std::size_t>(k)].at;
      for (std::size_t v = 0; v < rows.variables.size(); ++v)
        of_joint.col(rows.variables[v]).array() +=
            run_.arm_m.col(k).segment(run_.first_row(j), n).array() *
            rows.by_variable.row(static_cast<Eigen::Index>(v)).transpose().array();
    }
  }
  for (std::size_t i = 0; i < fibers_.size(); ++i) {
    const std::vector<Eigen::Index>& variables = muscles_[run_.fascicles[i]].at.variables;
    for (std::size_t v = 0; v < variables.size(); ++v)
      by_z.col(variables[v]).segment(run_.first_row_of_fascicle(i), n) +=
          fibers_[i].by_variable.row(static_cast<Eigen::Index>(v)).transpose();
  }
  return by_z;
}

const std::vector<ParameterMap::Chain>& RunEvaluation::own_chains(std::size_t j) const {
  return chains_->of_joint[static_cast<std::size_t>(run_.joints[j])];
}

}  // namespace myoid::fit
