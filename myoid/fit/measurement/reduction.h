#pragma once

#include <optional>

#include <Eigen/Core>

namespace myoid::fit {

/// The linear operator L that turns a run of n even samples into m < n rows: a Gaussian low-pass, amplitude exp(-(2 pi
/// f sigma)^2 / 2) with -3 dB at `cutoff_hz`, read at every third of 1 / cut-off. All rows have the same weights, which
/// add to 1 and stay inside the run, so L keeps a stationary error stationary. A run shorter than the weights gives one
/// row. Without a cut-off L is the identity.
class Reduction {
 public:
  Reduction(Eigen::Index samples, double rate_hz, std::optional<double> cutoff_hz);

  [[nodiscard]] Eigen::Index inputs() const { return inputs_; }
  [[nodiscard]] Eigen::Index outputs() const { return outputs_; }
  /// The weights of a row.
  [[nodiscard]] const Eigen::VectorXd& weights() const { return weights_; }
  /// Returns the sample to which the first weight of row j belongs.
  [[nodiscard]] Eigen::Index first(Eigen::Index j) const { return begin_ + j * stride_; }
  /// Samples from row to row.
  [[nodiscard]] Eigen::Index stride() const { return stride_; }

  /// Returns L X, column by column. The rows of X may belong to several joints, joint after joint.
  [[nodiscard]] Eigen::MatrixXd apply(const Eigen::Ref<const Eigen::MatrixXd>& x) const;
  /// Returns L' Y, likewise.
  [[nodiscard]] Eigen::MatrixXd transposed(const Eigen::Ref<const Eigen::MatrixXd>& y) const;

 private:
  Eigen::Index inputs_ = 0, outputs_ = 0, begin_ = 0, stride_ = 1;
  Eigen::VectorXd weights_;
};

/// Returns the number of samples that two successive runs share so that their rows leave no gap.
[[nodiscard]] Eigen::Index shared_samples(double rate_hz, std::optional<double> cutoff_hz);

}  // namespace myoid::fit
