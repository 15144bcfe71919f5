#include "myoid/identification/error_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "myoid/identification/residual_model.h"
#include "myoid/identification/row_filter.h"

namespace myoid::identification {
namespace {

constexpr Eigen::Index kPerMuscle = 7;
constexpr Eigen::Index kOwnLag = 6;
constexpr Eigen::Index kPerJoint = 2;  // the first two of a muscle's, without its force

/// Whether an unknown is this number of this owner.
bool is_found(const ParameterMap& map, Scope scope, int field, int owner) {
  return std::any_of(map.free().begin(), map.free().end(), [&](const FreeParameter& p) {
    return p.field->scope == scope && p.field->field == field &&
           std::any_of(p.targets.begin(), p.targets.end(),
                       [&](const auto& target) { return target.owner == owner; });
  });
}

/// Which of a muscle's shapes the fit finds as a number of its own: of that the data say nothing
/// that they have not said already, and its prior says how large it may be. A number of an EMG
/// channel that drives other muscles, too, or that is tied to another channel's, is not this
/// muscle's.
std::array<bool, kPerMuscle> found_of_muscle(const ParameterMap& map,
                                             int muscle,
                                             bool measured_is_force) {
  const int channel = map.channel_of_muscle(static_cast<std::size_t>(muscle));
  bool alone = true;
  for (std::size_t other = 0; other < map.held().muscles.size(); ++other)
    alone = alone &&
            (other == static_cast<std::size_t>(muscle) || map.channel_of_muscle(other) != channel);
  const auto own = [&](int field) {
    return alone && std::any_of(map.free().begin(), map.free().end(), [&](const FreeParameter& p) {
             return p.field->scope == Scope::channel && p.field->field == field &&
                    p.targets.size() == 1 && p.targets.front().owner == channel;
           });
  };
  std::array<bool, kPerMuscle> found{};
  const bool strength = measured_is_force && is_found(map, Scope::muscle, kMaxForce, muscle);
  found[0] = own(kGain) || strength;
  found[4] = own(kExponent) || own(kShape);
  found[kOwnLag] = own(kDelay);
  return found;
}

/// The lags of muscles that follow their EMG by one pure delay, which the fit finds, as differences
/// from their mean. Not where they follow by lags: their mean is another in another movement, where
/// more rises or falls and where tendons are stretched.
void center_lags(const ParameterMap& map, Eigen::MatrixXd& contrast) {
  for (const FreeParameter& delay : map.free()) {
    if (delay.field->scope != Scope::channel || delay.field->field != kDelay) continue;
    std::vector<Eigen::Index> rows;
    for (std::size_t k = 0; k < map.held().muscles.size(); ++k) {
      const int channel = map.channel_of_muscle(k);
      if (std::any_of(delay.targets.begin(), delay.targets.end(),
                      [&](const auto& target) { return target.owner == channel; }))
        rows.push_back(kPerMuscle * static_cast<Eigen::Index>(k) + kOwnLag);
    }
    for (const Eigen::Index i : rows) {
      for (const Eigen::Index j : rows) contrast(i, j) -= 1.0 / static_cast<double>(rows.size());
    }
  }
}

}  // namespace

ErrorShapes ResidualModel::error_shapes(const Eigen::VectorXd& z) const {
  constexpr double kLogRange = 2.3;
  constexpr double kLag_s = 0.15;  // 10 % are 15 ms.
  const double muscle_weight[kPerMuscle] = {1.0, 1.0, 1.0, 0.5, 1.0, 1.0, 1.0};
  const Eigen::Index joints = joint_count();
  const ModelValues values = map_.values(z);
  const auto muscles = static_cast<Eigen::Index>(values.muscles.size());
  Eigen::VectorXd shortest = Eigen::VectorXd::Constant(muscles, 1e9);
  Eigen::VectorXd longest = -shortest, fastest = Eigen::VectorXd::Constant(muscles, 1e-9);
  for (const Block& block : blocks_) {
    shortest = shortest.cwiseMin(block.length_m.colwise().minCoeff().transpose());
    longest = longest.cwiseMax(block.length_m.colwise().maxCoeff().transpose());
    fastest = fastest.cwiseMax(block.velocity_mps.cwiseAbs().colwise().maxCoeff().transpose());
  }
  Eigen::VectorXd size_nm = Eigen::VectorXd::Zero(joints), count = Eigen::VectorXd::Zero(joints);
  for (const Piece& piece : pieces_) {
    size_nm[piece.joint] += measured_.segment(piece.first, piece.count).squaredNorm();
    count[piece.joint] += static_cast<double>(piece.count);
  }
  size_nm = size_nm.cwiseQuotient(count.cwiseMax(1.0)).cwiseSqrt();

  ErrorShapes result;
  result.shapes_nm.setZero(kPerMuscle * muscles + kPerJoint * joints, measured_.size());
  result.weight.resize(result.shapes_nm.rows());
  result.channel.assign(static_cast<std::size_t>(result.shapes_nm.rows()), -1);
  result.by_emg.setZero(result.weight.size(), result.weight.size());
  result.contrast.setIdentity(result.weight.size(), result.weight.size());
  if (lag_ == EmgLag::delay) center_lags(map_, result.contrast);
  for (Eigen::Index k = 0; k < muscles; ++k) {
    // Every shape is proportional to the activation, and the logarithm grows with it.
    const double exponent = values.channels[static_cast<std::size_t>(
        map_.channel_of_muscle(static_cast<std::size_t>(k)))][kExponent];
    for (Eigen::Index b = 0; b < kPerMuscle; ++b)
      result.by_emg(kPerMuscle * k + b, kPerMuscle * k + b) = exponent;
    result.by_emg(kPerMuscle * k + 4, kPerMuscle * k) = exponent / kLogRange;
    const auto found = found_of_muscle(map_, static_cast<int>(k), measured_is_force_);
    for (Eigen::Index b = 0; b < kPerMuscle; ++b) {
      result.weight[kPerMuscle * k + b] =
          found[static_cast<std::size_t>(b)] ? 0.0 : muscle_weight[b];
      result.channel[static_cast<std::size_t>(kPerMuscle * k + b)] =
          map_.channel_of_muscle(static_cast<std::size_t>(k));
    }
  }
  for (Eigen::Index j = 0; j < joints; ++j) {
    auto weight = result.weight.segment<kPerJoint>(kPerMuscle * muscles + kPerJoint * j);
    weight << (is_found(map_, Scope::joint, kOffset, static_cast<int>(j)) ? 0.0 : 1.0),
        (is_found(map_, Scope::joint, kStiffness, static_cast<int>(j)) ? 0.0 : 1.0);
  }
  for (const Block& block : blocks_) {
    const Eigen::Index n = block.time_s.size();
    std::vector<std::vector<Activation>> activations;
    for (std::size_t c = 0; c < block.envelopes.size(); ++c)
      activations.push_back(activation(block.envelopes[c], block.time_s, values.channels[c], lag_));
    for (Eigen::Index k = 0; k < muscles; ++k) {
      const auto muscle = static_cast<std::size_t>(k);
      const auto c = static_cast<std::size_t>(map_.channel_of_muscle(muscle));
      const double range = std::max(longest[k] - shortest[k], 1e-9);
      for (Eigen::Index i = 0; i < n; ++i) {
        const Activation& activated = activations[c][static_cast<std::size_t>(i)];
        const double a = activated.value;
        const double force_n =
            tension_n(a, block.length_m(i, k), block.velocity_mps(i, k), values.muscles[muscle]);
        const double x = 2.0 * (block.length_m(i, k) - shortest[k]) / range - 1.0;
        const double factor[kPerMuscle] = {
            1.0,
            x,
            0.5 * (3.0 * x * x - 1.0),
            0.5 * x * (5.0 * x * x - 3.0),
            1.0 + std::log(std::max(a, 0.01)) / kLogRange,
            block.velocity_mps(i, k) / fastest[k],
            -kLag_s * activated.by_field[kDelay] / std::max(a, 0.01)};
        for (const Block::Joint& joint : block.joints) {
          for (Eigen::Index b = 0; b < kPerMuscle; ++b)
            result.shapes_nm(kPerMuscle * k + b, joint.first + i) +=
                joint.arm_m(i, k) * force_n * factor[b];
          if (k > 0) continue;
          const Eigen::Index row = kPerMuscle * muscles + kPerJoint * joint.joint;
          for (Eigen::Index b = 0; b < kPerJoint; ++b)
            result.shapes_nm(row + b, joint.first + i) = size_nm[joint.joint] * factor[b];
        }
      }
    }
  }
  result.unfiltered = result.shapes_nm;
  for (const Block& block : blocks_) {
    for (const Block::Joint& joint : block.joints)
      filter_rows(block.filter, result.shapes_nm.middleCols(joint.first, block.time_s.size()));
  }
  return result;
}

}  // namespace myoid::identification
