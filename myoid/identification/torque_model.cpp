#include "myoid/identification/torque_model.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/math/zero_phase.h"

namespace myoid::identification {
namespace {

struct FieldKind {
  std::string_view name;
  double muscle::HillForce::*derivative;
  bool logarithmic;
};

/// What the method identifies of each muscle; the rest is held.
constexpr std::array<FieldKind, 6> kIdentified = {
    {{"max_isometric_force", &muscle::HillForce::by_max_isometric_force, true},
     {"optimal_fiber_length", &muscle::HillForce::by_optimal_fiber_length, false},
     {"force_length_width", &muscle::HillForce::by_force_length_width, false},
     {"concentric_curvature", &muscle::HillForce::by_concentric_curvature, true},
     {"eccentric_curvature_product", &muscle::HillForce::by_eccentric_curvature_product, true},
     {"eccentric_plateau", &muscle::HillForce::by_eccentric_plateau, false}}};

}  // namespace

double FreeParameter::to_value(double z) const { return logarithmic ? std::exp(z) : z; }

void TorqueModel::add_parameters(const StudyData& data, const TorqueOptions& options) {
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    const MuscleSetup& setup = data.muscles[k];
    if (!options.muscles.empty() && std::find(options.muscles.begin(), options.muscles.end(),
                                              setup.name) == options.muscles.end())
      continue;
    for (const FieldKind& kind : kIdentified) {
      if (std::find(setup.fixed.begin(), setup.fixed.end(), kind.name) != setup.fixed.end())
        continue;
      FreeParameter p;
      p.muscle = static_cast<int>(k);
      p.field = &muscle::hill_field(kind.name);
      p.derivative = kind.derivative;
      p.logarithmic = kind.logarithmic;
      p.label = setup.name + "." + std::string(kind.name);
      const auto bound = setup.bounds.find(std::string(kind.name));
      const muscle::Range range = bound == setup.bounds.end() ? p.field->bounds : bound->second;
      const auto scale = [&](double value) { return kind.logarithmic ? std::log(value) : value; };
      p.lower = scale(range.lower);
      p.upper = scale(range.upper);
      p.start = std::clamp(scale(setup.start.*p.field->member), p.lower, p.upper);
      const auto prior = setup.priors.find(std::string(kind.name));
      if (options.priors && prior != setup.priors.end()) {
        p.prior_mean = scale(prior->second.mean);
        p.prior_sd = prior->second.logarithmic == kind.logarithmic ? prior->second.sd
                     : kind.logarithmic ? prior->second.sd / prior->second.mean
                                        : prior->second.sd * prior->second.mean;
      }
      free_.push_back(p);
    }
  }
  if (options.delay_s) {
    fixed_delay_s_ = *options.delay_s;
  } else {
    FreeParameter p;
    p.kind = FreeParameter::Kind::delay;
    p.label = "subject.emg_delay";
    p.upper = options.delay_limit_s;
    p.start = std::clamp(options.delay_prior_mean_s, 0.0, options.delay_limit_s);
    if (options.priors) {
      p.prior_mean = options.delay_prior_mean_s;
      p.prior_sd = options.delay_prior_sd_s;
    }
    free_.push_back(p);
  }
  if (options.priors) {
    for (const auto& [channel, sd] : options.gain_prior_sd) {
      if (!(sd > 0.0) || std::find(channels_.begin(), channels_.end(), channel) == channels_.end())
        continue;
      FreeParameter p;
      p.kind = FreeParameter::Kind::gain;
      p.channel = channel;
      p.logarithmic = true;
      p.label = channel + ".emg_gain";
      p.lower = std::log(0.2);
      p.upper = std::log(5.0);
      p.prior_sd = sd;
      free_.push_back(p);
    }
  }
}

TorqueModel::TorqueModel(const StudyData& data, const TorqueOptions& options) {
  const auto m = static_cast<Eigen::Index>(data.muscles.size());
  for (const MuscleSetup& setup : data.muscles) {
    start_.push_back(setup.start);
    const auto it = std::find(channels_.begin(), channels_.end(), setup.emg_channel);
    channel_of_muscle_.push_back(static_cast<int>(it - channels_.begin()));
    if (it == channels_.end()) channels_.push_back(setup.emg_channel);
  }
  add_parameters(data, options);
  const double longest_delay_s = options.delay_s ? *options.delay_s : options.delay_limit_s;
  std::vector<std::pair<const TrialData*, std::vector<Eigen::Index>>> chosen;
  Eigen::Index total = 0;
  for (const TrialData& trial : data.trials) {
    if (!trial.calibration) continue;
    if (trial.torque_nm.size() != trial.time_s.size() ||
        trial.moment_arm_m.rows() != trial.time_s.size()) {
      throw InvalidInput(
          fmt::format("method torque: trial '{}' has no torque or no moment arms", trial.name));
    }
    const double interval = (trial.time_s[trial.time_s.size() - 1] - trial.time_s[0]) /
                            static_cast<double>(trial.time_s.size() - 1);
    const auto stride = std::max<Eigen::Index>(
        1, static_cast<Eigen::Index>(std::lround(1.0 / (interval * options.max_rate_hz))));
    rate_hz_ = 1.0 / (interval * static_cast<double>(stride));
    // The ends of a trial are left out: splines and filters are unreliable there, and EMG must
    // reach back by the delay.
    const double edge_s = 0.1;
    const Eigen::VectorXd& clock = trial.activation.time_s();
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < trial.time_s.size(); i += stride) {
      const double t = trial.time_s[i];
      const bool inside = t >= trial.time_s[0] + edge_s &&
                          t <= trial.time_s[trial.time_s.size() - 1] - edge_s &&
                          t - longest_delay_s >= clock[0] && t <= clock[clock.size() - 1];
      if (inside) {
        rows.push_back(i);
      } else {
        ++dropped_;
      }
    }
    if (rows.empty()) continue;
    total += static_cast<Eigen::Index>(rows.size());
    chosen.emplace_back(&trial, std::move(rows));
  }
  if (total == 0) {
    throw InvalidInput(
        "method torque: no calibration sample is left; EMG and motion must overlap in time");
  }
  time_s_.resize(total);
  torque_.resize(total);
  length_m_.resize(total, m);
  velocity_mps_.resize(total, m);
  arm_m_.resize(total, m);
  Eigen::Index row = 0;
  for (const auto& [trial, rows] : chosen) {
    for (const Eigen::Index i : rows) {
      time_s_[row] = trial->time_s[i];
      torque_[row] = trial->torque_nm[i];
      length_m_.row(row) = trial->length_m.row(i);
      velocity_mps_.row(row) = trial->velocity_mps.row(i);
      arm_m_.row(row++) = trial->moment_arm_m.row(i);
    }
    pieces_.push_back(static_cast<Eigen::Index>(rows.size()));
    const double rate = static_cast<double>(rows.size() - 1) /
                        (trial->time_s[rows.back()] - trial->time_s[rows.front()]);
    const bool filtered =
        options.residual_cutoff_hz && rows.size() >= 4 && *options.residual_cutoff_hz < 0.45 * rate;
    filter_.push_back(filtered ? math::design_butterworth(
                                     math::FilterBand::low_pass, 2,
                                     math::two_pass_cutoff_hz(math::FilterBand::low_pass, 2,
                                                              *options.residual_cutoff_hz, rate),
                                     rate)
                               : std::vector<math::SecondOrderSection>{});
    const Eigen::VectorXd& clock = trial->activation.time_s();
    std::vector<math::Spline> splines;
    for (const std::string& channel : channels_) {
      splines.push_back(math::Spline::interpolate(clock, trial->activation.column(channel), 5));
    }
    envelope_.push_back(std::move(splines));
    first_time_s_.push_back(clock[0]);
    last_time_s_.push_back(clock[clock.size() - 1]);
  }
  smooth(torque_);
}

void TorqueModel::smooth(Eigen::Ref<Eigen::MatrixXd> columns) const {
  Eigen::Index first = 0;
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    if (!filter_[piece].empty()) {
      for (Eigen::Index c = 0; c < columns.cols(); ++c) {
        columns.col(c).segment(first, pieces_[piece]) =
            math::zero_phase(filter_[piece], columns.col(c).segment(first, pieces_[piece]));
      }
    }
    first += pieces_[piece];
  }
}

std::vector<muscle::HillParameters<double>> TorqueModel::muscles(const Eigen::VectorXd& z) const {
  std::vector<muscle::HillParameters<double>> result = start_;
  for (std::size_t j = 0; j < free_.size(); ++j) {
    if (free_[j].kind == FreeParameter::Kind::muscle) {
      result[static_cast<std::size_t>(free_[j].muscle)].*free_[j].field->member =
          free_[j].to_value(z[static_cast<Eigen::Index>(j)]);
    }
  }
  return result;
}

double TorqueModel::delay_s(const Eigen::VectorXd& z) const {
  for (std::size_t j = 0; j < free_.size(); ++j) {
    if (free_[j].kind == FreeParameter::Kind::delay) return z[static_cast<Eigen::Index>(j)];
  }
  return fixed_delay_s_;
}

void TorqueModel::evaluate(const Eigen::VectorXd& z,
                           Eigen::VectorXd& predicted,
                           Eigen::MatrixXd* jacobian,
                           Eigen::VectorXd* channel_power) const {
  const std::vector<muscle::HillParameters<double>> parameters = muscles(z);
  const double delay = delay_s(z);
  std::vector<double> gain(channels_.size(), 1.0);
  std::vector<Eigen::Index> gain_column(channels_.size(), -1);
  Eigen::Index delay_column = -1;
  std::vector<std::vector<std::pair<Eigen::Index, const FreeParameter*>>> by_muscle(start_.size());
  for (std::size_t j = 0; j < free_.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    const FreeParameter& p = free_[j];
    if (p.kind == FreeParameter::Kind::delay) delay_column = column;
    if (p.kind == FreeParameter::Kind::muscle)
      by_muscle[static_cast<std::size_t>(p.muscle)].emplace_back(column, &p);
    if (p.kind == FreeParameter::Kind::gain) {
      const auto c = static_cast<std::size_t>(
          std::find(channels_.begin(), channels_.end(), p.channel) - channels_.begin());
      gain[c] = p.to_value(z[column]);
      gain_column[c] = column;
    }
  }
  predicted.setZero(torque_.size());
  if (jacobian != nullptr)
    jacobian->setZero(torque_.size(), static_cast<Eigen::Index>(free_.size()));
  Eigen::MatrixXd by_channel;
  if (channel_power != nullptr)
    by_channel.setZero(torque_.size(), static_cast<Eigen::Index>(channels_.size()));
  std::vector<math::SplineValue> envelope(channels_.size());
  std::vector<double> channel_torque(channels_.size());
  Eigen::Index row = 0;
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) {
    for (Eigen::Index i = 0; i < pieces_[piece]; ++i, ++row) {
      const double when =
          std::clamp(time_s_[row] - delay, first_time_s_[piece], last_time_s_[piece]);
      for (std::size_t c = 0; c < channels_.size(); ++c) {
        envelope[c] = envelope_[piece][c].at(when);
        if (envelope[c].value < 0.0) envelope[c] = {};
        channel_torque[c] = 0.0;
      }
      for (std::size_t k = 0; k < parameters.size(); ++k) {
        const auto column = static_cast<Eigen::Index>(k);
        const auto c = static_cast<std::size_t>(channel_of_muscle_[k]);
        const double activation = gain[c] * envelope[c].value;
        const double arm = arm_m_(row, column);
        const muscle::HillForce f = muscle::hill_force_derivatives(
            activation, length_m_(row, column) - parameters[k].tendon_slack_length_m,
            velocity_mps_(row, column), parameters[k]);
        channel_torque[c] += arm * f.force_n;
        if (jacobian == nullptr) continue;
        for (const auto& [target, p] : by_muscle[k]) {
          const double chain = p->logarithmic ? parameters[k].*p->field->member : 1.0;
          (*jacobian)(row, target) += arm * f.*(p->derivative) * chain;
        }
        if (delay_column >= 0)
          (*jacobian)(row, delay_column) -= arm * f.by_activation * gain[c] * envelope[c].first;
        if (gain_column[c] >= 0)
          (*jacobian)(row, gain_column[c]) += arm * f.force_n;  // force is proportional to the gain
      }
      for (std::size_t c = 0; c < channels_.size(); ++c) {
        predicted[row] += channel_torque[c];
        if (channel_power != nullptr)
          by_channel(row, static_cast<Eigen::Index>(c)) = channel_torque[c];
      }
    }
  }
  smooth(predicted);
  if (jacobian != nullptr) smooth(*jacobian);
  if (channel_power != nullptr) {
    smooth(by_channel);
    *channel_power = by_channel.rowwise().squaredNorm();
  }
}

}  // namespace myoid::identification
