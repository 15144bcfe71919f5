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
  const double delay_s = options.delay_s.value_or(options.delay_prior_mean_s);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const auto rest = options.emg_rest.find(channels[c]);
    // The noise subtracted from an envelope that another program computed is unknown.
    const auto bandwidth = options.emg_bandwidth_hz.find(channels[c]);
    const bool raw = bandwidth != options.emg_bandwidth_hz.end() && bandwidth->second > 0.0;
    gains[static_cast<Eigen::Index>(c)] = identification::noise_gain(
        block.envelopes[c], block.time_s[0] - delay_s, block.time_s[block.time_s.size() - 1] - delay_s,
        raw && rest != options.emg_rest.end() ? rest->second : 0.0, envelope_spread(options, channels[c]));
  }
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

double envelope_spread(const EstimatorOptions& options, const std::string& channel) {
  const auto known = options.emg_bandwidth_hz.find(channel);
  const double bandwidth_hz =
      known != options.emg_bandwidth_hz.end() && known->second > 0.0 ? known->second : beliefs::kEmgBandwidth.value;
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
  const Eigen::Index all = trial.time_s.size();
  if (trial.torque_nm.size() != all || trial.moment_arm_m.rows() != all) {
    throw InvalidInput(fmt::format("trial '{}' has no torque or no moment arms", trial.name));
  }
  const double span = trial.time_s[all - 1] - trial.time_s[0];
  const double interval = span / static_cast<double>(all - 1);
  const auto stride =
      std::max<Eigen::Index>(1, static_cast<Eigen::Index>(std::lround(1.0 / (interval * options.max_rate_hz))));
  // Leaves out the ends of a trial, where splines and filters are unreliable and the delay reaches
  // beyond the recorded EMG.
  const double edge_s = std::min(0.1, 0.02 * span);
  const Eigen::VectorXd& clock = trial.activation.time_s();
  const double reach_s = std::min(map_.longest_delay_s(), 0.1 * span);
  std::vector<bool> included(static_cast<std::size_t>(all), false);
  for (const Eigen::Index i : included_rows(trial)) included[static_cast<std::size_t>(i)] = true;
  // One block for every gapless run of samples, so that no filter reaches across a gap.
  std::vector<std::vector<Eigen::Index>> runs(1);
  for (Eigen::Index i = 0; i < all; i += stride) {
    const double t = trial.time_s[i];
    const bool inside = included[static_cast<std::size_t>(i)] && t >= trial.time_s[0] + edge_s &&
                        t <= trial.time_s[all - 1] - edge_s && t - reach_s >= clock[0] - 1e-9 &&
                        t <= clock[clock.size() - 1] + 1e-9;
    if (inside) {
      runs.back().push_back(i);
    } else {
      ++dropped_;
      if (!runs.back().empty()) runs.emplace_back();
    }
  }
  for (const std::vector<Eigen::Index>& rows : runs) {
    if (rows.size() >= 2) add_block(data, index, rows, options);
  }
}

/// One joint of a trial as recorded, with all samples.
struct ResidualModel::JointRecording {
  const std::string& name;
  const Eigen::VectorXd& torque_nm;
  const Eigen::MatrixXd& arm_m;
  const Eigen::VectorXd &q, &qdot, &qddot;
  const Eigen::VectorXd& resting_nm;
};

void ResidualModel::add_joint(Block& block, const JointRecording& of, const std::vector<Eigen::Index>& rows) {
  const Eigen::Index all = of.torque_nm.size();
  const auto n = static_cast<Eigen::Index>(rows.size());
  ResidualJoint joint;
  joint.joint =
      static_cast<int>(std::find(map_.joints().begin(), map_.joints().end(), of.name) - map_.joints().begin());
  joint.piece = pieces_.size();
  joint.first = measured_.size();
  joint.arm_m = of.arm_m(rows, Eigen::all);
  if (of.q.size() == all && of.qdot.size() == all && of.qddot.size() == all) {
    joint.motion.resize(n, 3);
    joint.motion.col(0) = of.q(rows);
    joint.motion.col(1) = of.qdot(rows);
    joint.motion.col(2) = of.qddot(rows);
  }
  if (of.resting_nm.size() == all) joint.resting_nm = of.resting_nm(rows);
  Eigen::MatrixXd target = of.torque_nm(rows).transpose();
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

  add_joint(block,
            {trial.joint, trial.torque_nm, trial.moment_arm_m, trial.angle_rad, trial.velocity_radps,
             trial.acceleration_radps2, trial.resting_nm},
            rows);
  for (const JointData& joint : trial.more_joints)
    add_joint(block,
              {joint.name, joint.torque_nm, joint.moment_arm_m, joint.angle_rad, joint.velocity_radps,
               joint.acceleration_radps2, joint.resting_nm},
              rows);
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
