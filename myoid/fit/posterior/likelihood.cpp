#include "myoid/fit/posterior/likelihood.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "myoid/fit/intervals/verdict_rules.h"
#include "myoid/fit/measurement/told_by_motion.h"
#include "myoid/fit/posterior/likelihood_block.h"
#include "myoid/ground/core/parallel.h"
#include "myoid/ground/math/toeplitz.h"

namespace myoid::fit {
namespace {

double log_determinant(const Eigen::LLT<Eigen::MatrixXd>& factor) {
  return 2.0 * factor.matrixLLT().diagonal().array().log().sum();
}

constexpr double kLeastFascicleError = 0.1;  // of its standard deviation, behind L
constexpr double kNotMeasured_m2 = 1e6;      // variance of a row without a fiber length
constexpr double kSameReference = 1e-6;      // in the solver's scale, ln or SI

/// Returns the starting values of the unknowns; where a search begins at another fit's answer, that answer.
Eigen::VectorXd start_of(const ParameterMap& map, const EstimatorOptions& options) {
  Eigen::VectorXd z = map.start();
  for (std::size_t j = 0; options.begin_at && j < map.free().size(); ++j) {
    const std::vector<std::string>& unknowns = options.begin_at->free_parameters;
    const auto found = std::find(unknowns.begin(), unknowns.end(), map.free()[j].label);
    if (found != unknowns.end()) z[static_cast<Eigen::Index>(j)] = options.begin_at->solution[found - unknowns.begin()];
  }
  return z;
}

/// Two joints i <= j of a run, by their first rows among the n J samples and among the rows of L y.
struct JointPair {
  Eigen::Index i, j, row_i, row_j;
};

std::vector<JointPair> joint_pairs(const TrialRun& run) {
  const Eigen::Index m = run.reduction.outputs();
  std::vector<JointPair> pairs;
  for (std::size_t j = 0; j < run.joints.size(); ++j) {
    for (std::size_t i = 0; i <= j; ++i)
      pairs.push_back(
          {run.first_row(i), run.first_row(j), static_cast<Eigen::Index>(i) * m, static_cast<Eigen::Index>(j) * m});
  }
  return pairs;
}

/// Adds the covariance that one noise causes in the rows of all joints; `variance`(pair) is the
/// product of the noise's factors in both joints at each sample, n.
template <typename Variance>
void add_noise(const TrialRun& run, const EmgNoise& noise, const Variance& variance, Eigen::MatrixXd& a) {
  const Eigen::Index m = run.reduction.outputs();
  for (const JointPair& pair : joint_pairs(run)) {
    const Eigen::MatrixXd block = noise.covariance(variance(pair));
    a.block(pair.row_i, pair.row_j, m, m) += block;
    if (pair.i != pair.j) a.block(pair.row_j, pair.row_i, m, m) += block;
  }
}

/// Returns the first column of the Toeplitz matrix of an error of measured fiber lengths of unit variance, behind L.
Eigen::VectorXd fascicle_correlation(const TrialRun& run) {
  return torque_error(run.reduction, run.interval_s, std::log(beliefs::kFascicleErrorTime.value)).correlation;
}

}  // namespace

Likelihood::Likelihood(const StudyData& data, const EstimatorOptions& options, Columns columns, const Recorded* session)
    : data_(data),
      options_(options),
      columns_are_(columns),
      map_(data, options),
      runs_(trial_runs(data, options, map_)),
      given_(runs_.size()),
      without_emg_(runs_.size()),
      columns_(runs_.size()),
      by_slope_(runs_.size()),
      recorded_(session != nullptr ? *session : fit::recorded(runs_, map_.held().muscles)) {
  for (const TrialRun& run : runs_) {
    rows_ += run.measured_nm.size();
    if (trial_of_run_.empty() || run.trial != runs_[trial_of_run_.size() - 1].trial) ++trials_;
    trial_of_run_.push_back(trials_ - 1);
    auto& of_channels = envelope_noise_.emplace_back();
    for (const EnvelopeError& error : run.errors)
      of_channels.emplace_back(run.reduction, error.from_white(run.interval_s));
  }
  if (session == nullptr) recorded_.told_by_motion = told_by_motion_alone(data).value_or(0.0);
  weigh_rows();
  refer_to(start_of(map_, options_));
}

void Likelihood::weigh_rows() {
  std::vector<double> rows(static_cast<std::size_t>(trials_));  // of each trial, per joint
  const auto of_trial = [&](std::size_t r) -> double& { return rows[static_cast<std::size_t>(trial_of_run_[r])]; };
  for (std::size_t r = 0; r < runs_.size(); ++r) of_trial(r) += static_cast<double>(runs_[r].reduction.outputs());
  double most = options_.unseen.independent_rows;
  if (recorded_.told_by_motion >= kVerdictRules.motion_alone)
    most = std::min(most, static_cast<double>(kMotionCoefficients));
  for (std::size_t r = 0; r < runs_.size(); ++r)
    row_weight_.push_back(most > 0.0 ? std::min(1.0, most / of_trial(r)) : 1.0);
}

std::optional<Eigen::Index> Likelihood::fascicle_place() const {
  const bool measured =
      std::any_of(runs_.begin(), runs_.end(), [](const TrialRun& run) { return !run.fascicles.empty(); });
  return measured ? std::optional(kNoiseFieldCount + trials_) : std::nullopt;
}

double Likelihood::log_share(std::size_t r, const NoiseValues& noise) const {
  const Eigen::Index at = share_place(r);
  return at < noise.size() ? noise[at] : 0.0;
}

void Likelihood::refer_to(const Eigen::VectorXd& z) {
  if (reference_.size() == z.size() && (z - reference_).cwiseAbs().maxCoeff() <= kSameReference) return;
  reference_ = z;
  const ModelValues values = map_.values(z);
  std::vector<RunEvaluation> at;
  at.reserve(runs_.size());
  for (const TrialRun& run : runs_) at.emplace_back(run, map_, options_.law, values, nullptr);
  const std::vector<Stepped> steps =
      columns_are_ == Columns::follow ? steps_from(z, map_, options_.law, runs_) : std::vector<Stepped>{};
  unseen_ = unseen_quantities(data_, options_, map_, recorded_, runs_, values, at, steps);
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const Reduction& reduction = runs_[r].reduction;
    columns_[r] = reduction.apply(unseen_.columns[r]);
    by_slope_[r] = reduction.apply(unseen_.by_slope[r]);
    const Eigen::Index rows = runs_[r].measured_count(), m = reduction.outputs();
    without_emg_[r] = envelope_covariance(r, at[r].signals(), NoiseValues::Zero(kNoiseFieldCount), true);
    given_[r].setZero(rows, rows);
    for (Eigen::Index i = 0; i < runs_[r].measured_m.size(); ++i)
      given_[r].diagonal()[runs_[r].measured_nm.size() + i] =
          std::isfinite(runs_[r].measured_m[i]) ? std::pow(kLeastFascicleError * options_.unseen.fascicle_error_m, 2)
                                                : kNotMeasured_m2;
    for (std::size_t j = 0; j < runs_[r].joints.size(); ++j)
      given_[r]
          .diagonal()
          .segment(static_cast<Eigen::Index>(j) * m, m)
          .setConstant(std::pow(kLeastTorqueError * recorded_.torque_nm * recorded_.size_share(runs_[r].joints[j]), 2));
    if (options_.angle_sd_rad <= 0.0 && options_.angle_rate_sd_radps <= 0.0) continue;
    add_noise(
        runs_[r], EmgNoise(reduction, Eigen::VectorXd::Ones(1)),
        [&](const JointPair& pair) { return motion_variance(runs_[r], at[r], pair.i, pair.j); }, given_[r]);
  }
}

Eigen::VectorXd Likelihood::motion_variance(const TrialRun& run,
                                            const RunEvaluation& at,
                                            Eigen::Index first_row,
                                            Eigen::Index other_row) const {
  const Eigen::Index n = run.time_s.size();
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(n);
  for (std::size_t k = 0; k < data_.muscles.size(); ++k) {
    const MuscleRows& rows = at.muscle(k);
    const auto arms = run.arm_m.col(static_cast<Eigen::Index>(k)).array();
    const auto arm = arms.segment(first_row, n), other = arms.segment(other_row, n);
    for (std::size_t j = 0; j < run.joints.size(); ++j) {
      // An angle error dq of any joint changes the muscle's length by -r dq, and each torque by its
      // arm times the change of force.
      const auto moved = arms.segment(run.first_row(j), n);
      const Eigen::ArrayXd here = arm * moved, there = other * moved;
      variance.array() += (here * rows.by_length.array() * options_.angle_sd_rad) *
                              (there * rows.by_length.array() * options_.angle_sd_rad) +
                          (here * rows.by_velocity.array() * options_.angle_rate_sd_radps) *
                              (there * rows.by_velocity.array() * options_.angle_rate_sd_radps);
    }
  }
  return variance;
}

void Likelihood::add_torque_error(const TrialRun& run, double variance, double log_time, Eigen::MatrixXd& a) const {
  const Eigen::VectorXd correlation = torque_error(run.reduction, run.interval_s, log_time).correlation;
  const Eigen::Index m = run.reduction.outputs();
  for (std::size_t j = 0; j < run.joints.size(); ++j) {
    const Eigen::Index row = static_cast<Eigen::Index>(j) * m;
    a.block(row, row, m, m) +=
        math::toeplitz(variance * std::pow(recorded_.size_share(run.joints[j]), 2) * correlation);
  }
}

void Likelihood::add_fascicle_error(const TrialRun& run, double variance, Eigen::MatrixXd& a) const {
  const Eigen::Index m = run.reduction.outputs();
  for (Eigen::Index row = run.measured_nm.size(); row < run.measured_count(); row += m)
    a.block(row, row, m, m) += math::toeplitz(variance * fascicle_correlation(run));
}

double Likelihood::fascicle_variance(const NoiseValues& noise) const {
  const std::optional<Eigen::Index> at = fascicle_place();
  const double sd_m = options_.unseen.fascicle_error_m;
  return sd_m * sd_m * (at && *at < noise.size() ? std::exp(2.0 * noise[*at]) : 1.0);
}

Eigen::VectorXd Likelihood::residual(std::size_t r, const TorqueSignals& signals) const {
  const TrialRun& run = runs_[r];
  Eigen::VectorXd left(run.measured_count());
  left << run.measured_nm, run.measured_m;
  left -= run.reduction.apply(signals.all());
  for (Eigen::Index i = 0; i < left.size(); ++i)
    if (std::isnan(left[i])) left[i] = 0.0;
  return left;
}

Eigen::VectorXd Likelihood::weights(const NoiseValues& noise) const {
  Eigen::VectorXd w(static_cast<Eigen::Index>(unseen_.quantities.size()));
  for (std::size_t i = 0; i < unseen_.quantities.size(); ++i) {
    const UnseenQuantity& of = unseen_.quantities[i];
    const bool exact = believed_ == Believed::geometry_and_sensors_exact && of.lasts();
    w[static_cast<Eigen::Index>(i)] = exact ? 0.0 : of.weight * (of.size ? std::exp(noise[*of.size]) : 1.0);
  }
  return w;
}

Eigen::VectorXd Likelihood::grown(const Eigen::VectorXd& z) const {
  return (unseen_.growth * (z - reference_)).array().exp();
}

Eigen::VectorXd Likelihood::envelope_scale(const TrialRun& run, const NoiseValues& noise) {
  Eigen::VectorXd scale = std::exp(2.0 * noise[kEmgFactor]) * run.envelope_sd.cwiseAbs2();
  for (std::size_t c = 0; c < run.errors.size(); ++c) {
    const auto column = static_cast<Eigen::Index>(c);
    scale[column] *= run.errors[c].share();
    if (!run.parts[c].empty()) scale[column] = run.envelope_sd[column] * run.envelope_sd[column];
  }
  return scale;
}

double Likelihood::torque_variance(std::size_t r, const NoiseValues& noise) const {
  return std::exp(2.0 * (noise[kTorqueSd] + log_share(r, noise)));
}

Eigen::MatrixXd Likelihood::envelope_covariance(std::size_t r,
                                                const TorqueSignals& signals,
                                                const NoiseValues& noise,
                                                bool without_emg) const {
  const Eigen::VectorXd scale = envelope_scale(runs_[r], noise);
  const Eigen::Index rows = runs_[r].measured_count(), n = runs_[r].time_s.size();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows, rows);
  for (Eigen::Index c = 0; c < scale.size(); ++c) {
    const auto channel = static_cast<std::size_t>(c);
    if (runs_[r].parts[channel].empty() == without_emg) continue;
    const auto d = signals.by_noise.col(c);
    add_noise(
        runs_[r], envelope_noise_[r][channel],
        [&](const JointPair& pair) {
          return Eigen::VectorXd(scale[c] * d.segment(pair.i, n).cwiseProduct(d.segment(pair.j, n)));
        },
        a);
  }
  return a;
}

Likelihood::AllRuns Likelihood::all_runs(const Eigen::VectorXd& z, const NoiseValues& noise) const {
  AllRuns all{.weights = weights(noise),
              .turned = Eigen::VectorXd(static_cast<Eigen::Index>(unseen_.slopes.size())),
              .shared = {}};
  for (std::size_t s = 0; s < unseen_.slopes.size(); ++s) {
    const auto& [quantity, unknown, reach] = unseen_.slopes[s];
    all.turned[static_cast<Eigen::Index>(s)] = reach * std::tanh((z[unknown] - reference_[unknown]) / reach);
  }
  return all;
}

math::Woodbury Likelihood::AllRuns::joined(const std::vector<Block>& blocks) const {
  math::Woodbury::Blocks halves;
  for (const Block& block : blocks) halves.push_back(&block.unseen_half);
  return {std::move(halves), weights.size()};
}

Eigen::MatrixXd Likelihood::turned_columns(std::size_t r, const AllRuns& all) const {
  Eigen::MatrixXd columns = columns_[r];
  for (Eigen::Index s = 0; s < all.turned.size(); ++s)
    columns.col(unseen_.slopes[static_cast<std::size_t>(s)].quantity) += all.turned[s] * by_slope_[r].col(s);
  return columns;
}

bool Likelihood::fill(std::size_t r, const AllRuns& all, const NoiseValues& noise, Block& block) const {
  const TrialRun& run = runs_[r];
  const TorqueSignals& signals = block.evaluation->signals();
  Eigen::MatrixXd a = envelope_covariance(r, signals, noise, false);
  add_torque_error(run, torque_variance(r, noise), noise[kTorqueTime], a);
  add_fascicle_error(run, fascicle_variance(noise), a);
  a += given_[r] + without_emg_[r];
  block.factor.compute(a);
  if (block.factor.info() != Eigen::Success) return false;
  const double weight = row_weight_[r], log_of_a = log_determinant(block.factor);
  if (weight < 1.0) block.factor.compute(a / weight);
  block.whitening = block.factor.matrixL().solve(Eigen::MatrixXd::Identity(a.rows(), a.rows()));
  block.white = block.whitening * residual(r, signals);
  block.solved = block.whitening.transpose() * block.white;
  block.unseen = turned_columns(r, all) * all.weights.asDiagonal();
  block.unseen_half.noalias() = block.whitening * block.unseen;
  block.own = -0.5 * (block.white.squaredNorm() + weight * log_of_a);
  return std::isfinite(block.own);
}

void Likelihood::pull_back(std::size_t r,
                           const NoiseValues& noise,
                           const AllRuns& all,
                           const Block& block,
                           const Eigen::MatrixXd& half_left,
                           Gradient& gradient) const {
  const TrialRun& run = runs_[r];
  const TorqueSignals& signals = block.evaluation->signals();
  const Eigen::Index rows = run.measured_count(), m = run.reduction.outputs();
  const Eigen::Index n = run.time_s.size();
  // Sigma^-1 r; the gradient by A is 1/2 (w w' - Sigma^-1), and with A = C C', U = C^-1 L S W and G
  // of all runs Sigma^-1 is C'^-1 (1 - U G^-1 U') C^-1. A block's A is that of the measurement over
  // the rows' weight, by which the determinant's A^-1 is multiplied.
  const Eigen::VectorXd w = block.solved - block.whitening.transpose() * (block.unseen_half * all.shared);
  Eigen::MatrixXd half = row_weight_[r] * Eigen::MatrixXd::Identity(rows, rows);
  half.noalias() -= half_left * block.unseen_half.transpose();
  const Eigen::MatrixXd half_right = half * block.whitening;
  Eigen::MatrixXd by_a = w * w.transpose();
  by_a.noalias() -= block.whitening.transpose() * half_right;
  by_a *= 0.5 / row_weight_[r];

  const double variance = torque_variance(r, noise);
  const TorqueError torque = torque_error(run.reduction, run.interval_s, noise[kTorqueTime]);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(m);
  for (std::size_t j = 0; j < run.joints.size(); ++j) {
    const Eigen::Index row = static_cast<Eigen::Index>(j) * m;
    sums += std::pow(recorded_.size_share(run.joints[j]), 2) * math::by_first_column(by_a.block(row, row, m, m));
  }
  gradient.by_noise.setZero(noise.size());
  gradient.by_noise[kTorqueSd] = 2.0 * variance * sums.dot(torque.correlation);
  const Eigen::Index share = share_place(r);
  if (share < noise.size()) gradient.by_noise[share] = gradient.by_noise[kTorqueSd];
  gradient.by_noise[kTorqueTime] = variance * sums.dot(torque.by_log_time);

  if (const std::optional<Eigen::Index> place = fascicle_place(); place && *place < noise.size()) {
    const Eigen::VectorXd correlation = fascicle_correlation(run);
    for (Eigen::Index row = run.measured_nm.size(); row < rows; row += m)
      gradient.by_noise[*place] +=
          2.0 * fascicle_variance(noise) * math::by_first_column(by_a.block(row, row, m, m)).dot(correlation);
  }

  const Eigen::VectorXd scale = envelope_scale(runs_[r], noise);
  const Eigen::VectorXd of_rows = run.reduction.transposed(w);
  TorqueSignals by{of_rows.head(run.row_count()),
                   Eigen::MatrixXd::Zero(signals.by_noise.rows(), signals.by_noise.cols()),
                   of_rows.tail(run.all_rows() - run.row_count())};
  for (Eigen::Index c = 0; c < scale.size(); ++c) {
    const auto channel = static_cast<std::size_t>(c);
    if (!run.parts[channel].empty()) continue;
    const auto d = signals.by_noise.col(c);
    auto by_d = by.by_noise.col(c);
    for (const JointPair& pair : joint_pairs(run)) {
      // A_ij and its transpose A_ji share the factor D_i D_j; A_ii occurs once.
      const auto of_pair = by_a.block(pair.row_i, pair.row_j, m, m);
      const Eigen::VectorXd by_product = envelope_noise_[r][channel].pull_back(
          pair.i == pair.j ? Eigen::MatrixXd(of_pair) : Eigen::MatrixXd(0.5 * (of_pair + of_pair.transpose())));
      by_d.segment(pair.i, n) += 2.0 * scale[c] * by_product.cwiseProduct(d.segment(pair.j, n));
      if (pair.i != pair.j) by_d.segment(pair.j, n) += 2.0 * scale[c] * by_product.cwiseProduct(d.segment(pair.i, n));
    }
    gradient.by_noise[kEmgFactor] += by_d.dot(d);
  }

  gradient.by_z.setZero(map_.size());
  block.evaluation->pull_back(by, gradient.by_z);
  add_gradient_of_columns(r, all, w, half_left, block, gradient.by_z);
}

void Likelihood::add_gradient_of_columns(std::size_t r,
                                         const AllRuns& all,
                                         const Eigen::VectorXd& w,
                                         const Eigen::MatrixXd& half_left,
                                         const Block& block,
                                         Eigen::VectorXd& by_z) const {
  // The derivative by L S W is Sigma^-1 r x' from the quadratic form and -A^-1 L S W G^-1 from
  // ln |G|.
  Eigen::MatrixXd by_unseen = w * all.shared.transpose();
  by_unseen.noalias() -= block.whitening.transpose() * half_left;
  for (std::size_t s = 0; s < unseen_.slopes.size(); ++s) {
    const auto& [quantity, unknown, reach] = unseen_.slopes[s];
    const auto column = static_cast<Eigen::Index>(s);
    const double near = 1.0 - std::pow(all.turned[column] / reach, 2);  // of tanh
    by_z[unknown] += near * all.weights[quantity] * by_slope_[r].col(column).dot(by_unseen.col(quantity));
  }
}

std::vector<Likelihood::Block> Likelihood::filled(const ModelValues& values,
                                                  const ChainsByOwner* chains,
                                                  const AllRuns& all,
                                                  const NoiseValues& noise) const {
  std::vector<Block> blocks(runs_.size());
  parallel_ranges(runs_.size(), std::size_t{1}, [&](const auto& range) {
    for (std::size_t r = range.begin(); r < range.end(); ++r) {
      blocks[r].evaluation = std::make_unique<RunEvaluation>(runs_[r], map_, options_.law, values, chains);
      blocks[r].positive = fill(r, all, noise, blocks[r]);
    }
  });
  return blocks;
}

double Likelihood::value(const Eigen::VectorXd& z, const NoiseValues& noise, Gradient* gradient) const {
  std::vector<ParameterMap::Chain> chains;
  const ModelValues values = map_.values(z, gradient != nullptr ? &chains : nullptr);
  const ChainsByOwner by_owner(map_, chains);
  AllRuns all = all_runs(z, noise);
  const std::vector<Block> blocks = filled(values, gradient != nullptr ? &by_owner : nullptr, all, noise);
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  double result = 0.0;
  std::vector<Eigen::MatrixXd> white;
  for (const Block& block : blocks) {
    if (!block.positive) return kNever;
    white.emplace_back(block.white);
    result += block.own;
  }
  const math::Woodbury joined = all.joined(blocks);
  const Eigen::VectorXd factors = grown(z);
  const Eigen::MatrixXd solved = joined.positive() ? joined.solve(white, factors) : Eigen::MatrixXd();
  if (solved.size() == 0 && factors.size() > 0) return kNever;
  const Eigen::VectorXd expected = solved.col(0);
  all.shared = factors.cwiseProduct(expected);
  result += 0.5 * (joined.project(white).col(0).dot(all.shared) - joined.log_determinant());
  if (gradient == nullptr || !std::isfinite(result)) return result;
  const math::Woodbury::Left left = joined.left();
  std::vector<Gradient> parts(runs_.size());
  parallel_ranges(runs_.size(), std::size_t{1}, [&](const auto& range) {
    for (std::size_t r = range.begin(); r < range.end(); ++r) {
      pull_back(r, noise, all, blocks[r], left.blocks[r], parts[r]);
    }
  });
  gradient->by_z = unseen_.growth.transpose() * expected.cwiseAbs2();
  gradient->by_noise.setZero(noise.size());
  for (Eigen::Index i = 0; i < expected.size(); ++i) {
    if (const std::optional<NoiseField> size = unseen_.quantities[static_cast<std::size_t>(i)].size)
      gradient->by_noise[*size] += expected[i] * expected[i] - (1.0 - left.diagonal[i]);
  }
  for (const Gradient& part : parts) {
    gradient->by_z += part.by_z;
    gradient->by_noise += part.by_noise;
  }
  return result;
}

}  // namespace myoid::fit
