#include <algorithm>

#include <oneapi/tbb/parallel_for.h>

#include "myoid/identification/residual_model.h"
#include "myoid/identification/row_filter.h"

namespace myoid::identification {
namespace {

/// Samples times muscles below which other threads cost more time than they save.
constexpr Eigen::Index kWorthSharing = 8000;

}  // namespace

void ResidualModel::for_each_block(const std::function<void(std::size_t)>& one) const {
  const auto muscles = static_cast<Eigen::Index>(map_.held().muscles.size());
  if (measured_.size() * muscles < kWorthSharing) {
    for (std::size_t b = 0; b < blocks_.size(); ++b) one(b);
  } else {
    oneapi::tbb::parallel_for(std::size_t{0}, blocks_.size(), one);
  }
}

const std::vector<MuscleRows>& ResidualModel::evaluate_muscles(const Block& block,
                                                               const ModelValues& values,
                                                               const ChainsByOwner& chains) const {
  // Keeps the rows: a new allocation costs more than filling them.
  thread_local std::vector<MuscleRows> rows;
  rows.resize(values.muscles.size());
  std::vector<std::vector<Activation>> activations;
  for (std::size_t c = 0; c < block.envelopes.size(); ++c) {
    const bool with_exponent = std::any_of(chains.of_channel[c].begin(), chains.of_channel[c].end(),
                                           [](const ParameterMap::Chain& chain) { return chain.field == kExponent; });
    activations.push_back(activation(block.envelopes[c], block.time_s, values.channels[c], lag_, with_exponent));
  }
  for (std::size_t k = 0; k < values.muscles.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const auto c = static_cast<std::size_t>(map_.channel_of_muscle(k));
    evaluate_muscle(activations[c], block.length_m.col(column), block.velocity_mps.col(column), values.muscles[k],
                    chains.of_muscle[k], chains.of_channel[c], rows[k]);
  }
  return rows;
}

void ResidualModel::add_torques(const Block& block,
                                const ModelValues& values,
                                const std::vector<MuscleRows>& muscles,
                                Eigen::VectorXd& predicted,
                                Eigen::MatrixXd& channel_torque) const {
  const Eigen::Index n = block.time_s.size();
  for (const ResidualJoint& joint : block.joints) {
    auto torque = predicted.segment(joint.first, n);
    for (std::size_t k = 0; k < muscles.size(); ++k) {
      const auto arm = joint.arm_m.col(static_cast<Eigen::Index>(k));
      const Eigen::Index c = map_.channel_of_muscle(k);
      torque += arm.cwiseProduct(muscles[k].force_n);
      // The change of torque by a relative error of the envelope. For a force proportional to the
      // activation, this change is the torque itself.
      channel_torque.row(c).segment(joint.first, n) +=
          block.noise_gain[c] * arm.cwiseProduct(muscles[k].by_envelope_n).transpose();
    }
    const JointValues& p = values.joints[static_cast<std::size_t>(joint.joint)];
    if (joint.motion.size() > 0) {
      torque -=
          p[kViscosity] * joint.motion.col(1) + p[kInertia] * joint.motion.col(2) + p[kStiffness] * joint.motion.col(0);
    }
    torque.array() += p[kOffset];
    if (joint.resting_nm.size() > 0) torque += joint.resting_nm;
  }
}

void ResidualModel::add_gradient(const Block& block,
                                 const std::vector<MuscleRows>& muscles,
                                 const ChainsByOwner& chains,
                                 Evaluation& out) const {
  const Eigen::Index n = block.time_s.size();
  for (const ResidualJoint& joint : block.joints) {
    for (std::size_t k = 0; k < muscles.size(); ++k) {
      const MuscleRows& m = muscles[k];
      for (Eigen::Index i = 0; i < n; ++i) {
        const double arm = joint.arm_m(i, static_cast<Eigen::Index>(k));
        double* column = out.gradient.data() + (joint.first + i) * out.gradient.rows();
        const double* by = m.by_variable.data() + i * m.by_variable.rows();
        for (const Eigen::Index variable : m.variables) column[variable] += arm * *by++;
      }
    }
    for (const ParameterMap::Chain& chain : chains.of_joint[static_cast<std::size_t>(joint.joint)])
      out.gradient.row(chain.variable).segment(joint.first, n) +=
          chain.slope * by_joint_field(chain.field, n, joint.motion).transpose();
    out.unfiltered.middleCols(joint.first, n) = out.gradient.middleCols(joint.first, n);
  }
}

void ResidualModel::add_motion_variance(const Block& block,
                                        const std::vector<MuscleRows>& muscles,
                                        Evaluation& out) const {
  const Eigen::Index n = block.time_s.size();
  for (const ResidualJoint& joint : block.joints) {
    for (std::size_t k = 0; k < muscles.size(); ++k) {
      // An angle error dq changes every length by -r dq.
      const Eigen::ArrayXd squared = joint.arm_m.col(static_cast<Eigen::Index>(k)).array().square();
      out.motion_variance.segment(joint.first, n).array() +=
          (squared * muscles[k].by_length.array() * angle_sd_rad_).square() +
          (squared * muscles[k].by_velocity.array() * angle_rate_sd_radps_).square();
    }
  }
}

void ResidualModel::evaluate(const Eigen::VectorXd& z, Depth depth, Evaluation& out) const {
  std::vector<ParameterMap::Chain> all;
  const bool gradient = depth != Depth::value;
  const ModelValues values = map_.values(z, gradient ? &all : nullptr);
  const ChainsByOwner chains(map_, all);
  out.predicted.setZero(measured_.size());
  if (gradient) {
    out.gradient.setZero(map_.size(), measured_.size());
    out.unfiltered.resize(map_.size(), measured_.size());
  }
  out.channel_torque.setZero(static_cast<Eigen::Index>(map_.channels().size()), measured_.size());
  if (depth == Depth::noise) out.motion_variance.setZero(measured_.size());
  // Every block writes its own rows, so the result does not depend on the number of threads.
  for_each_block([&](std::size_t b) {
    const Block& block = blocks_[b];
    const std::vector<MuscleRows>& muscles = evaluate_muscles(block, values, chains);
    add_torques(block, values, muscles, out.predicted, out.channel_torque);
    if (gradient) add_gradient(block, muscles, chains, out);
    if (depth == Depth::noise) add_motion_variance(block, muscles, out);
    if (block.filter.empty()) return;
    for (const ResidualJoint& joint : block.joints) {
      std::vector<SignalRow> rows{{out.predicted.data() + joint.first, 1}};
      for (Eigen::Index r = 0; gradient && r < out.gradient.rows(); ++r)
        rows.push_back({out.gradient.data() + joint.first * out.gradient.rows() + r, out.gradient.rows()});
      filter_rows(block.filter, rows, block.time_s.size());
    }
  });
}

void ResidualModel::pull_back(const Eigen::VectorXd& z,
                              const std::function<void(std::size_t piece, PullBack& rows)>& weigh,
                              Eigen::VectorXd& by_prediction,
                              Eigen::VectorXd& by_channel) const {
  std::vector<ParameterMap::Chain> all;
  const ModelValues values = map_.values(z, &all);
  const ChainsByOwner chains(map_, all);
  PullBack rows{
      .predicted = Eigen::VectorXd::Zero(measured_.size()),
      .channel_torque = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(map_.channels().size()), measured_.size()),
      .by_predicted = Eigen::VectorXd::Zero(measured_.size())};
  const auto count = static_cast<Eigen::Index>(blocks_.size());
  Eigen::MatrixXd by_block_prediction = Eigen::MatrixXd::Zero(map_.size(), count);
  Eigen::MatrixXd by_block_channel = Eigen::MatrixXd::Zero(map_.size(), count);
  for_each_block([&](std::size_t b) {
    const Block& block = blocks_[b];
    const Eigen::Index n = block.time_s.size();
    auto prediction = by_block_prediction.col(static_cast<Eigen::Index>(b));
    auto channel = by_block_channel.col(static_cast<Eigen::Index>(b));
    const std::vector<MuscleRows>& muscles = evaluate_muscles(block, values, chains);
    add_torques(block, values, muscles, rows.predicted, rows.channel_torque);
    std::vector<Eigen::VectorXd> by_torque;
    for (const ResidualJoint& joint : block.joints) {
      filter_rows(block.filter, {{rows.predicted.data() + joint.first, 1}}, n);
      weigh(joint.piece, rows);
      by_torque.push_back(transposed_filter(block.filter, rows.by_predicted.segment(joint.first, n)));
      for (const ParameterMap::Chain& chain : chains.of_joint[static_cast<std::size_t>(joint.joint)])
        prediction[chain.variable] += chain.slope * by_joint_field(chain.field, n, joint.motion).dot(by_torque.back());
    }
    Eigen::MatrixXd by_force(n, 2);
    for (std::size_t k = 0; k < muscles.size(); ++k) {
      const Eigen::Index c = map_.channel_of_muscle(k);
      by_force.setZero();
      for (std::size_t j = 0; j < block.joints.size(); ++j) {
        const ResidualJoint& joint = block.joints[j];
        const auto arm = joint.arm_m.col(static_cast<Eigen::Index>(k));
        by_force.col(0) += arm.cwiseProduct(by_torque[j]);
        by_force.col(1) += arm.cwiseProduct(rows.channel_torque.row(c).segment(joint.first, n).transpose());
      }
      const MuscleRows& m = muscles[k];
      const Eigen::MatrixXd sums = m.by_variable * by_force;
      for (std::size_t v = 0; v < m.variables.size(); ++v) {
        prediction[m.variables[v]] += sums(static_cast<Eigen::Index>(v), 0);
        if (channel_of_variable(m.variables[v]) == c) channel[m.variables[v]] += sums(static_cast<Eigen::Index>(v), 1);
      }
    }
  });
  by_prediction = by_block_prediction.rowwise().sum();
  by_channel = by_block_channel.rowwise().sum();
}

}  // namespace myoid::identification
