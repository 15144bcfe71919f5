#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/muscle/fit_isolated.h"

namespace myoid::muscle {

/// Returns the force [N] of the model's unit under its own response to the input, at increasing times; NaN at times to
/// which so many steps do not lead.
[[nodiscard]] Eigen::VectorXd force_of(const IsolatedModel& model,
                                       IsolatedMuscleInput input,
                                       const Eigen::VectorXd& time_s,
                                       double relative_tolerance,
                                       long max_steps);

/// The errors of the forces of all recordings but one, one below the other; then, times `noise_n`, the distances of the
/// common values from the start and of the recordings' own values from the common ones, in their spreads. The unknowns
/// are the logarithms of the common values and, for each recording in turn, those of its own values over them. The
/// arguments of the constructor must outlive the errors.
class ForceErrors {
 public:
  /// Throws InvalidInput where the starting numbers lead to no force.
  ForceErrors(const IsolatedModel& start,
              const std::vector<IsolatedRecording>& recordings,
              const IsolatedFitOptions& options);

  void use_all_but(std::optional<std::size_t> left_out);

  /// Sets the weight of the beliefs: the error of a force, and the spreads of the own values; empty: there are none.
  void believe(double noise_n, const Eigen::VectorXd& scatter) {
    noise_n_ = noise_n;
    scatter_ = scatter;
  }

  [[nodiscard]] const std::vector<Eigen::Index>& lengths() const { return lengths_; }
  [[nodiscard]] Eigen::Index count() const { return count_; }         ///< Number of the forces.
  [[nodiscard]] Eigen::Index common() const { return logs_.size(); }  ///< Number of the common unknowns.
  [[nodiscard]] Eigen::Index uses() const { return static_cast<Eigen::Index>(used_.size()); }
  [[nodiscard]] Eigen::Index unknowns() const { return common() + uses() * scatter_.size(); }
  [[nodiscard]] int evaluations() const { return evaluations_; }
  [[nodiscard]] const Eigen::VectorXd& start_logs() const { return logs_; }
  [[nodiscard]] const std::vector<Eigen::Index>& own() const { return own_; }

  /// Returns the spread of the measured forces [N] times the root of their number.
  [[nodiscard]] double spread() const;

  /// Returns the logarithms of the values of one of the used recordings.
  [[nodiscard]] Eigen::VectorXd logs_of_use(const Eigen::VectorXd& x, Eigen::Index use) const;

  /// Fills the errors [N], and unless `jacobian` is null their derivatives: by central differences, or the held ones.
  void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian);

  /// Computes the derivatives of the used recordings at x, which `evaluate` fills at any x while `use_held_slopes`. A
  /// search near x takes a simulation a step, in place of two for each unknown, and ends where these derivatives are
  /// perpendicular to the errors.
  void hold_slopes(const Eigen::VectorXd& x);
  void use_held_slopes(bool held) { holds_ = held; }

 private:
  struct Samples {
    Eigen::VectorXd time_s, force_n;
  };
  [[nodiscard]] static Samples sparse(const IsolatedRecording& recording);
  /// Returns the forces of the used recordings, one below the other, at x and with each common value moved up and down.
  [[nodiscard]] Eigen::MatrixXd forces_about(const Eigen::VectorXd& x, bool moved);
  [[nodiscard]] Eigen::Block<Eigen::MatrixXd> segment(Eigen::MatrixXd& rows, Eigen::Index use) const;
  [[nodiscard]] Eigen::VectorXd force_within(const Eigen::VectorXd& logs, std::size_t recording, long steps) const;
  [[nodiscard]] long steps_from_start(std::size_t recording) const;
  [[nodiscard]] Eigen::VectorXd force_at(const Eigen::VectorXd& logs, std::size_t recording) const;

  const IsolatedModel& start_;
  const std::vector<IsolatedRecording>& recordings_;
  const IsolatedFitOptions& options_;
  Eigen::VectorXd logs_;
  std::vector<IsolatedMuscleInput> inputs_;
  std::vector<Samples> samples_;
  std::vector<Eigen::Index> own_;
  std::vector<long> most_steps_;  ///< Of the integration, by recording.
  std::vector<std::size_t> used_;
  std::vector<Eigen::Index> first_, lengths_;
  Eigen::Index count_ = 0;
  double noise_n_ = 0.0;
  Eigen::VectorXd scatter_;
  std::vector<Eigen::MatrixXd> held_;  ///< Per recording: derivatives by its logarithms.
  bool holds_ = false;
  int evaluations_ = 0;
};

}  // namespace myoid::muscle
