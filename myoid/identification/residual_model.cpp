#include "myoid/identification/residual_model.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/beliefs/beliefs.h"
#include "myoid/core/error.h"
#include "myoid/core/normal.h"
#include "myoid/identification/row_filter.h"

namespace myoid::identification {
namespace {

/// Returns noise_gain of every channel over the block, with the usual delay.
Eigen::VectorXd noise_gains(const ResidualBlock& block,
                            const std::vector<std::string>& channels,
                            const EstimatorOptions& options) {
  Eigen::VectorXd gains(static_cast<Eigen::Index>(channels.size()));
  const double delay_s = options.usual_delay_s();
  for (std::size_t c = 0; c < channels.size(); ++c)
    gains[static_cast<Eigen::Index>(c)] = identification::noise_gain(
        block.envelopes[c], block.time_s[0] - delay_s, block.time_s[block.time_s.size() - 1] - delay_s,
        options.rest_level(channels[c]), envelope_spread(options, channels[c]));
  return gains;
}

/// Throws InvalidInput if a joint's own viscosity, inertia or stiffness is an unknown and its motion is not given.
void check_motion(const ResidualBlock& block, const ParameterMap& map, const std::string& trial) {
  for (const Unknown& p : map.free()) {
    if (p.field->scope != Scope::joint || p.field->field == kOffset) continue;
    for (const ResidualJoint& joint : block.joints) {
      if (joint.motion.size() == 0) {
        throw InvalidInput(fmt::format("{}: the motion of joint '{}' is not given for trial '{}'", p.label,
                                       map.joints()[static_cast<std::size_t>(joint.joint)], trial));
      }
    }
  }
}

}  // namespace

double EstimatorOptions::bandwidth_hz(const std::string& channel) const {
  const auto known = emg_bandwidth_hz.find(channel);
  return known != emg_bandwidth_hz.end() && known->second > 0.0 ? known->second : 0.0;
}

double EstimatorOptions::rest_level(const std::string& channel) const {
  const auto rest = emg_rest.find(channel);
  return rest != emg_rest.end() && bandwidth_hz(channel) > 0.0 ? rest->second : 0.0;
}

double envelope_spread(const EstimatorOptions& options, const std::string& channel) {
  const double known_hz = options.bandwidth_hz(channel);
  const double bandwidth_hz = known_hz > 0.0 ? known_hz : beliefs::kEmgBandwidth.value;
  return kRectifiedSpread / std::sqrt(2.0 * bandwidth_hz * 0.4815 / options.envelope_cutoff_hz);
}

ResidualModel::ResidualModel(const StudyData& data, const EstimatorOptions& options)
    : map_(data, options),
      lag_(options.lag),
      measured_is_force_(options.measured_is_force),
      angle_sd_rad_(options.angle_sd_rad),
      angle_rate_sd_radps_(options.angle_rate_sd_radps) {
  for (std::size_t i = 0; i < data.trials.size(); ++i) {
    if (data.trials[i].calibration) add_trial(data, static_cast<int>(i), options);
  }
  for (const Unknown& p : map_.free()) {
    int channel = -1;
    for (const Unknown::Target& target : p.targets) {
      const int here = p.field->scope == Scope::muscle ? map_.channel_of_muscle(static_cast<std::size_t>(target.owner))
                       : p.field->scope == Scope::channel ? target.owner
                                                          : -1;
      channel = &target == &p.targets.front() || here == channel ? here : -1;
      if (channel < 0) break;
    }
    channel_of_variable_.push_back(channel);
  }
  if (pieces_.empty()) {
    throw InvalidInput("identification: no calibration sample is left; EMG and motion must overlap in time");
  }
}

void ResidualModel::add_trial(const StudyData& data, int index, const EstimatorOptions& options) {
  const TrialData& trial = data.trials[static_cast<std::size_t>(index)];
  // One block for every gapless run of samples, so that no filter reaches across a gap.
  for (const auto& rows : fitted_stretches(trial, options.max_rate_hz, map_.longest_delay_s(), &dropped_)) {
    if (rows.size() >= 2) add_block(data, index, rows, options);
  }
}

void ResidualModel::add_joint(Block& block, const TrialData& view, const std::vector<Eigen::Index>& rows) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  ResidualJoint joint;
  joint.joint =
      static_cast<int>(std::find(map_.joints().begin(), map_.joints().end(), view.joint) - map_.joints().begin());
  joint.piece = pieces_.size();
  joint.first = measured_.size();
  joint.arm_m = view.moment_arm_m(rows, Eigen::all);
  if (const Eigen::MatrixXd motion = motion_of(view); motion.size() > 0) joint.motion = motion(rows, Eigen::all);
  if (view.resting_nm.size() == view.torque_nm.size()) joint.resting_nm = view.resting_nm(rows);
  Eigen::MatrixXd target = view.torque_nm(rows).transpose();
  filter_rows(block.filter, target);
  measured_.conservativeResize(joint.first + n);
  measured_.tail(n) = target.row(0).transpose();
  noise_gain_.conservativeResize(block.noise_gain.size(), joint.first + n);
  noise_gain_.rightCols(n) = block.noise_gain.replicate(1, n);
  pieces_.push_back({block.trial, joint.joint, joint.first, n});
  block.joints.push_back(std::move(joint));
}

void ResidualModel::add_block(const StudyData& data,
                              int index,
                              const std::vector<Eigen::Index>& rows,
                              const EstimatorOptions& options) {
  const TrialData& trial = data.trials[static_cast<std::size_t>(index)];
  const Eigen::VectorXd& clock = trial.activation.time_s();
  const auto n = static_cast<Eigen::Index>(rows.size());
  Block block;
  block.trial = index;
  block.time_s = trial.time_s(rows);
  block.length_m = trial.length_m(rows, Eigen::all);
  block.velocity_mps = trial.velocity_mps(rows, Eigen::all);
  const double rate = static_cast<double>(n - 1) / (trial.time_s[rows.back()] - trial.time_s[rows.front()]);
  rate_hz_ = std::max(rate_hz_, rate);
  if (options.residual_cutoff_hz && n >= 4 && *options.residual_cutoff_hz < 0.45 * rate) {
    block.filter = math::design_butterworth(
        math::FilterBand::low_pass, 2,
        math::two_pass_cutoff_hz(math::FilterBand::low_pass, 2, *options.residual_cutoff_hz, rate), rate);
  }
  const double emg_rate = static_cast<double>(clock.size() - 1) / (clock[clock.size() - 1] - clock[0]);
  const auto apart = static_cast<Eigen::Index>(std::lround(n > 1 ? emg_rate / rate : 1.0));
  for (const std::string& channel : map_.channels())
    block.envelopes.emplace_back(clock, trial.activation.column(channel), apart);
  block.noise_gain = noise_gains(block, map_.channels(), options);

  for (std::size_t j = 0; j < identification::joint_count(trial); ++j) add_joint(block, of_joint(trial, j), rows);
  check_motion(block, map_, trial.name);
  blocks_.push_back(std::move(block));
}

std::vector<Eigen::Index> ResidualModel::rows_of_joint(int joint) const {
  std::vector<Eigen::Index> rows;
  for (const Piece& piece : pieces_) {
    for (Eigen::Index i = 0; piece.joint == joint && i < piece.count; ++i) rows.push_back(piece.first + i);
  }
  return rows;
}

std::vector<Eigen::Index> ResidualModel::piece_lengths() const {
  std::vector<Eigen::Index> lengths;
  for (const Piece& piece : pieces_) lengths.push_back(piece.count);
  return lengths;
}

}  // namespace myoid::identification
