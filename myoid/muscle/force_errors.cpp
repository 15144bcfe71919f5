#include "myoid/muscle/force_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/parallel.h"
#include "myoid/muscle/isolated_values.h"

namespace myoid::muscle {
namespace {

/// Step h of the logarithms in central differences. Relative to the derivative the truncation is h^2 = 2e-5, and the
/// integrator's noise is tolerance / h = 2e-5.
constexpr double kStep = 5e-3;

/// Returns the derivatives of one recording's forces from those of `forces_about`.
Eigen::MatrixXd slopes_of(const Eigen::MatrixXd& forces) {
  const Eigen::Index unknowns = (forces.cols() - 1) / 2;
  Eigen::MatrixXd slopes(forces.rows(), unknowns);
  for (Eigen::Index j = 0; j < unknowns; ++j)
    slopes.col(j) = (forces.col(2 * j + 1) - forces.col(2 * j + 2)) / (2.0 * kStep);
  return slopes;
}

}  // namespace

Eigen::VectorXd force_of(const IsolatedModel& model,
                         IsolatedMuscleInput input,
                         const Eigen::VectorXd& time_s,
                         double relative_tolerance,
                         long max_steps) {
  input.response = model.response;
  return isolated_tendon_force(Musculotendon<double>(model.parameters, model.laws, model.millard), input,
                               {.output_time_s = time_s,
                                .relative_tolerance = relative_tolerance,
                                .absolute_tolerance = 1e-3 * relative_tolerance,
                                .max_steps = max_steps,
                                .progress = {}});
}

ForceErrors::ForceErrors(const IsolatedModel& start,
                         const std::vector<IsolatedRecording>& recordings,
                         const IsolatedFitOptions& options)
    : start_(start), recordings_(recordings), options_(options), logs_(logs_of(start, options.parameters)) {
  const double tolerance_m = 5e-5 * start.parameters.hill.optimal_fiber_length_m;
  for (const IsolatedRecording& recording : recordings) {
    inputs_.push_back(thinned(recording.input, tolerance_m));
    samples_.push_back(sparse(recording));
  }
  for (const std::string& name : options.own)
    own_.push_back(std::ranges::find(options.parameters, name) - options.parameters.begin());
  for (std::size_t i = 0; i < recordings.size(); ++i) most_steps_.push_back(steps_from_start(i));
  use_all_but({});
}

void ForceErrors::use_all_but(std::optional<std::size_t> left_out) {
  used_.clear();
  first_.clear();
  lengths_.clear();
  count_ = 0;
  for (std::size_t i = 0; i < recordings_.size(); ++i) {
    if (left_out == i) continue;
    used_.push_back(i);
    first_.push_back(count_);
    lengths_.push_back(samples_[i].force_n.size());
    count_ += lengths_.back();
  }
}

double ForceErrors::spread() const {
  Eigen::VectorXd all(count_);
  for (std::size_t k = 0; k < used_.size(); ++k) all.segment(first_[k], lengths_[k]) = samples_[used_[k]].force_n;
  return (all.array() - all.mean()).matrix().norm();
}

Eigen::VectorXd ForceErrors::logs_of_use(const Eigen::VectorXd& x, Eigen::Index use) const {
  Eigen::VectorXd logs = x.head(common());
  for (Eigen::Index q = 0; q < scatter_.size(); ++q)
    logs[own_[static_cast<std::size_t>(q)]] += x[common() + use * scatter_.size() + q];
  return logs;
}

Eigen::MatrixXd ForceErrors::forces_about(const Eigen::VectorXd& x, bool moved) {
  // Its own values move as the common ones do.
  const Eigen::Index moves = moved ? 1 + 2 * common() : 1;
  Eigen::MatrixXd forces(count_, moves);
  parallel_ranges<Eigen::Index>(uses() * moves, 1, [&](const auto& range) {
    for (Eigen::Index k = range.begin(); k != range.end(); ++k) {
      const Eigen::Index use = k % uses();
      Eigen::VectorXd logs = logs_of_use(x, use);
      if (const Eigen::Index move = k / uses(); move > 0) logs[(move - 1) / 2] += move % 2 == 1 ? kStep : -kStep;
      segment(forces, use).col(k / uses()) = force_at(logs, used_[static_cast<std::size_t>(use)]);
    }
  });
  options_.progress.check();
  evaluations_ += static_cast<int>(uses() * moves);
  return forces;
}

void ForceErrors::hold_slopes(const Eigen::VectorXd& x) {
  Eigen::MatrixXd forces = forces_about(x, true);
  held_.assign(recordings_.size(), {});
  for (Eigen::Index use = 0; use < uses(); ++use)
    held_[used_[static_cast<std::size_t>(use)]] = slopes_of(segment(forces, use));
}

void ForceErrors::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
  Eigen::MatrixXd forces = forces_about(x, jacobian != nullptr && !holds_);
  const double weight = noise_n_ * 1.96 / std::log(options_.reach);
  r.segment(count_, common()) = weight * (x.head(common()) - logs_);
  for (Eigen::Index use = 0; use < uses(); ++use) {
    const auto i = static_cast<std::size_t>(use);
    r.segment(first_[i], lengths_[i]) = segment(forces, use).col(0) - samples_[used_[i]].force_n;
    for (Eigen::Index q = 0; q < scatter_.size(); ++q) {
      const Eigen::Index at = common() + use * scatter_.size() + q;
      r[count_ + at] = noise_n_ / scatter_[q] * x[at];
    }
  }
  if (jacobian == nullptr) return;
  jacobian->setZero();
  jacobian->block(count_, 0, common(), common()).diagonal().setConstant(weight);
  for (Eigen::Index use = 0; use < uses(); ++use) {
    auto block = segment(*jacobian, use);
    block.leftCols(common()) = holds_ ? held_[used_[static_cast<std::size_t>(use)]] : slopes_of(segment(forces, use));
    for (Eigen::Index q = 0; q < scatter_.size(); ++q) {
      const Eigen::Index at = common() + use * scatter_.size() + q;
      block.col(at) = block.col(own_[static_cast<std::size_t>(q)]);
      (*jacobian)(count_ + at, at) = noise_n_ / scatter_[q];
    }
  }
}

/// Returns samples of the force at least 2 ms apart, evenly: denser ones cost time and tell nothing more.
ForceErrors::Samples ForceErrors::sparse(const IsolatedRecording& recording) {
  constexpr double kApart_s = 0.002;
  const Eigen::Index n = recording.time_s.size();
  if (n < 2) return {recording.time_s, recording.force_n};
  const double step_s = (recording.time_s[n - 1] - recording.time_s[0]) / static_cast<double>(n - 1);
  const auto stride = std::max<Eigen::Index>(1, std::llround(kApart_s / step_s));
  const auto kept = Eigen::seq(0, n - 1, stride);
  return {recording.time_s(kept), recording.force_n(kept)};
}

/// Returns the rows of a used recording.
Eigen::Block<Eigen::MatrixXd> ForceErrors::segment(Eigen::MatrixXd& rows, Eigen::Index use) const {
  const auto i = static_cast<std::size_t>(use);
  return rows.middleRows(first_[i], lengths_[i]);
}

Eigen::VectorXd ForceErrors::force_within(const Eigen::VectorXd& logs, std::size_t recording, long steps) const {
  return force_of(with_values(start_, options_.parameters, logs), inputs_[recording], samples_[recording].time_s,
                  options_.relative_tolerance, steps);
}

/// Returns the limit of steps of the integration: 20,000, or four times those that lead through the recording at the
/// starting numbers, to a factor of four.
long ForceErrors::steps_from_start(std::size_t recording) const {
  constexpr long kUsual = 20'000, kMost = 5'000'000;
  for (long steps = kUsual; steps < kMost; steps *= 4)
    if (force_within(logs_, recording, steps).allFinite()) return steps == kUsual ? steps : 4 * steps;
  throw InvalidInput(
      "{}: the starting numbers lead to no force in {} steps of the integration; start from another "
      "tendon_slack_length, or give the muscle a damping",
      recordings_[recording].name, kMost);
}

/// Returns the forces; NaN for values of which no curve or muscle can be made, and where the balance of fiber and
/// tendon is far stiffer than at the start, as of a muscle without strength: such values are no answer.
Eigen::VectorXd ForceErrors::force_at(const Eigen::VectorXd& logs, std::size_t recording) const {
  try {
    return force_within(logs, recording, most_steps_[recording]);
  } catch (const InvalidInput&) {
    return Eigen::VectorXd::Constant(samples_[recording].time_s.size(), std::numeric_limits<double>::quiet_NaN());
  }
}

}  // namespace myoid::muscle
