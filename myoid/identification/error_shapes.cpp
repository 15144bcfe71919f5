#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "myoid/identification/residual_model.h"
#include "myoid/identification/row_filter.h"

namespace myoid::identification {
namespace {

constexpr Eigen::Index kPerMuscle = 7;
constexpr Eigen::Index kLogActivation = 4;
constexpr Eigen::Index kOwnLag = 6;
constexpr double kLogRange = 2.3;
constexpr Eigen::Index kPerJoint = 2;  // the first two of a muscle's shapes, without its force

/// Marks the shapes of a muscle that are unknowns of the fit: the data determine these, and a prior
/// bounds them. A number of an EMG channel that drives other muscles too, or that is tied to
/// another channel's, belongs to no single muscle.
std::array<bool, kPerMuscle> found_of_muscle(const ParameterMap& map, int muscle, bool measured_is_force) {
  const int channel = map.channel_of_muscle(static_cast<std::size_t>(muscle));
  int driven = 0;  // muscles of this EMG channel
  for (std::size_t k = 0; k < map.held().muscles.size(); ++k) driven += map.channel_of_muscle(k) == channel ? 1 : 0;
  const auto own = [&](int field) {
    return driven == 1 && std::any_of(map.free().begin(), map.free().end(), [&](const Unknown& p) {
             return p.is(Scope::channel, field) && p.targets.size() == 1 && p.acts_on(channel);
           });
  };
  std::array<bool, kPerMuscle> found{};
  const bool strength = measured_is_force && map.find(Scope::muscle, kMaxForce, muscle) >= 0;
  found[0] = own(kGain) || strength;
  found[kLogActivation] = own(kExponent) || own(kShape);
  found[kOwnLag] = own(kDelay);
  return found;
}

/// Replaces the lags of muscles that follow their EMG by one unknown delay by their differences
/// from the mean, which is the delay. Muscles that follow by lags keep their own, because the mean
/// lag depends on the movement, on rises and falls of the EMG and on stretched tendons.
void center_lags(const ParameterMap& map, Eigen::MatrixXd& contrast) {
  for (const Unknown& delay : map.free()) {
    if (!delay.is(Scope::channel, kDelay)) continue;
    std::vector<Eigen::Index> rows;
    for (std::size_t k = 0; k < map.held().muscles.size(); ++k) {
      if (delay.acts_on(map.channel_of_muscle(k))) rows.push_back(kPerMuscle * static_cast<Eigen::Index>(k) + kOwnLag);
    }
    for (const Eigen::Index i : rows) {
      for (const Eigen::Index j : rows) contrast(i, j) -= 1.0 / static_cast<double>(rows.size());
    }
  }
}

/// Ranges of the recorded motion, one entry per muscle.
struct MotionRange {
  Eigen::VectorXd shortest, longest;  ///< [m]
  Eigen::VectorXd fastest;            ///< [m/s]
};

MotionRange range_of(const std::vector<ResidualBlock>& blocks, Eigen::Index muscles) {
  MotionRange range;
  range.shortest = Eigen::VectorXd::Constant(muscles, 1e9);
  range.longest = -range.shortest;
  range.fastest = Eigen::VectorXd::Constant(muscles, 1e-9);
  for (const ResidualBlock& block : blocks) {
    range.shortest = range.shortest.cwiseMin(block.length_m.colwise().minCoeff().transpose());
    range.longest = range.longest.cwiseMax(block.length_m.colwise().maxCoeff().transpose());
    range.fastest = range.fastest.cwiseMax(block.velocity_mps.cwiseAbs().colwise().maxCoeff().transpose());
  }
  return range;
}

/// Returns the root mean square of the measured torque of each joint [N m].
Eigen::VectorXd torque_sizes(const ResidualModel& model) {
  Eigen::VectorXd size_nm = Eigen::VectorXd::Zero(model.joint_count());
  Eigen::VectorXd count = size_nm;
  for (const Piece& piece : model.pieces()) {
    size_nm[piece.joint] += model.measured().segment(piece.first, piece.count).squaredNorm();
    count[piece.joint] += static_cast<double>(piece.count);
  }
  return size_nm.cwiseQuotient(count.cwiseMax(1.0)).cwiseSqrt();
}

/// Returns shapes of value 0, with their weights, contrast and channels.
ErrorShapes shapes_without_values(
    const ParameterMap& map, const ModelValues& values, Eigen::Index samples, bool one_delay, bool measured_is_force) {
  constexpr double kWeight[kPerMuscle] = {1.0, 1.0, 1.0, 0.5, 1.0, 1.0, 1.0};
  const auto muscles = static_cast<Eigen::Index>(values.muscles.size());
  const auto joints = static_cast<Eigen::Index>(map.joints().size());
  ErrorShapes result;
  result.shapes_nm.setZero(kPerMuscle * muscles + kPerJoint * joints, samples);
  result.weight.resize(result.shapes_nm.rows());
  result.channel.assign(static_cast<std::size_t>(result.shapes_nm.rows()), -1);
  result.by_emg.setZero(result.weight.size(), result.weight.size());
  result.contrast.setIdentity(result.weight.size(), result.weight.size());
  if (one_delay) center_lags(map, result.contrast);
  for (Eigen::Index k = 0; k < muscles; ++k) {
    const int channel = map.channel_of_muscle(static_cast<std::size_t>(k));
    // Every shape is proportional to the activation, and the logarithm grows with it.
    const double exponent = values.channels[static_cast<std::size_t>(channel)][kExponent];
    const Eigen::Index first = kPerMuscle * k;
    result.by_emg(first + kLogActivation, first) = exponent / kLogRange;
    const auto found = found_of_muscle(map, static_cast<int>(k), measured_is_force);
    for (Eigen::Index b = 0; b < kPerMuscle; ++b) {
      result.by_emg(first + b, first + b) = exponent;
      result.weight[first + b] = found[static_cast<std::size_t>(b)] ? 0.0 : kWeight[b];
      result.channel[static_cast<std::size_t>(first + b)] = channel;
    }
  }
  for (Eigen::Index j = 0; j < joints; ++j) {
    auto weight = result.weight.segment<kPerJoint>(kPerMuscle * muscles + kPerJoint * j);
    weight << (map.find(Scope::joint, kOffset, static_cast<int>(j)) >= 0 ? 0.0 : 1.0),
        (map.find(Scope::joint, kStiffness, static_cast<int>(j)) >= 0 ? 0.0 : 1.0);
  }
  return result;
}

/// Returns the factors on a muscle's torque in its shapes, at sample i of a block.
std::array<double, kPerMuscle> factors_of(
    const ResidualBlock& block, const MotionRange& range, const Activation& activated, Eigen::Index k, Eigen::Index i) {
  constexpr double kLag_s = 0.15;  // 10 % are 15 ms.
  const double a = std::max(activated.value, 0.01);
  const double span = std::max(range.longest[k] - range.shortest[k], 1e-9);
  const double x = 2.0 * (block.length_m(i, k) - range.shortest[k]) / span - 1.0;
  return {1.0,
          x,
          0.5 * (3.0 * x * x - 1.0),
          0.5 * x * (5.0 * x * x - 3.0),
          1.0 + std::log(a) / kLogRange,
          block.velocity_mps(i, k) / range.fastest[k],
          -kLag_s * activated.by_field[kDelay] / a};
}

}  // namespace

ErrorShapes ResidualModel::error_shapes(const Eigen::VectorXd& z) const {
  const ModelValues values = map_.values(z);
  const auto muscles = static_cast<Eigen::Index>(values.muscles.size());
  const MotionRange range = range_of(blocks_, muscles);
  const Eigen::VectorXd size_nm = torque_sizes(*this);
  ErrorShapes result = shapes_without_values(map_, values, measured_.size(), lag_ == EmgLag::delay, measured_is_force_);
  for (const Block& block : blocks_) {
    const Eigen::Index n = block.time_s.size();
    std::vector<std::vector<Activation>> activations;
    for (std::size_t c = 0; c < block.envelopes.size(); ++c)
      activations.push_back(activation(block.envelopes[c], block.time_s, values.channels[c], lag_));
    for (Eigen::Index k = 0; k < muscles; ++k) {
      const auto muscle = static_cast<std::size_t>(k);
      const auto c = static_cast<std::size_t>(map_.channel_of_muscle(muscle));
      for (Eigen::Index i = 0; i < n; ++i) {
        const Activation& activated = activations[c][static_cast<std::size_t>(i)];
        const double force_n =
            tension_n(activated.value, block.length_m(i, k), block.velocity_mps(i, k), values.muscles[muscle]);
        const std::array<double, kPerMuscle> factor = factors_of(block, range, activated, k, i);
        for (const ResidualJoint& joint : block.joints) {
          for (Eigen::Index b = 0; b < kPerMuscle; ++b)
            result.shapes_nm(kPerMuscle * k + b, joint.first + i) +=
                joint.arm_m(i, k) * force_n * factor[static_cast<std::size_t>(b)];
          if (k > 0) continue;
          const Eigen::Index row = kPerMuscle * muscles + kPerJoint * joint.joint;
          for (Eigen::Index b = 0; b < kPerJoint; ++b)
            result.shapes_nm(row + b, joint.first + i) = size_nm[joint.joint] * factor[static_cast<std::size_t>(b)];
        }
      }
    }
  }
  result.unfiltered = result.shapes_nm;
  for (const Block& block : blocks_) {
    for (const ResidualJoint& joint : block.joints)
      filter_rows(block.filter, result.shapes_nm.middleCols(joint.first, block.time_s.size()));
  }
  return result;
}

}  // namespace myoid::identification
