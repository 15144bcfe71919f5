#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/identification/parameters.h"
#include "myoid/posterior/noise_model.h"
#include "myoid/posterior/torque_signals.h"
#include "myoid/posterior/trial_run.h"
#include "myoid/posterior/unseen.h"

namespace myoid::identification {

/// What is taken to be exact: nothing, or the geometry and the scales of the sensors.
enum class Believed { nothing_exact, geometry_and_sensors_exact };

/// ln p(y | z, phi) of all calibration trials: y = T^(z; u, q) + e_T + e_u + e_q + S W x, all of it
/// behind the operator L of each run,
///
///   ln p = -1/2 r' Sigma^-1 r - 1/2 ln |Sigma|,   r = L (y - T^),   Sigma = A + L S W^2 S' L',
///   A_ij = [i = j] (L b^2 sigma_i^2 exp(-|dt|/tau_T) L' + (0.002 y_i)^2) + L Q_ij L'
///          + kappa^2 sum_c sd_c^2 K_c D_ic D_jc K_c'
///
/// y holds the torques of all joints of a run; A_ij are the rows of its joints i and j. Torque
/// errors of two joints are independent, sigma_i = sigma_T times the root mean square of the
/// joint's torque over that of all. A torque errs by 0.2 % of its root mean square y_i at the least
/// (kLeastTorqueError): a torque that never changes would be infinitely exact otherwise. One noise
/// of an envelope and one error of an angle act on all joints that the muscle crosses. A is one
/// block per run; S W^2 S', of the unseen quantities, goes through all runs and is taken in by
/// Woodbury's identity. K_c is L behind the filters of the envelope and the drive (EmgNoise). S and
/// Q, the error of angle and rate, independent from sample to sample, belong to reference values of
/// the unknowns. The constant -n/2 ln(2 pi) is left out.
class Likelihood {
 public:
  static constexpr double kLeastTorqueError = 0.002;  ///< Of its root mean square, behind L.

  /// The reference is the start. `session` is what was recorded where the data are a part of it;
  /// null: the data are all.
  Likelihood(const StudyData& data,
             const EstimatorOptions& options,
             const Recorded* session = nullptr);

  /// Takes S and Q at these values of the unknowns.
  void refer_to(const Eigen::VectorXd& z);
  /// Leaves out of S what is taken to be exact; at first nothing is.
  void believe(Believed believed) { believed_ = believed; }

  [[nodiscard]] const ParameterMap& parameters() const { return map_; }
  [[nodiscard]] const std::vector<TrialRun>& runs() const { return runs_; }
  [[nodiscard]] const Unseen& unseen() const { return unseen_; }
  [[nodiscard]] const Recorded& recorded() const { return recorded_; }
  [[nodiscard]] Eigen::Index row_count() const { return rows_; }
  /// The fitted trials, in whose order ln b stands in NoiseValues.
  [[nodiscard]] Eigen::Index trial_count() const { return trials_; }
  /// The place of the run's trial in NoiseValues.
  [[nodiscard]] Eigen::Index share_place(std::size_t run) const {
    return kNoiseFieldCount + trial_of_run_[run];
  }
  /// ln b of the run's trial; 0 where `noise` does not name it.
  [[nodiscard]] double log_share(std::size_t run, const NoiseValues& noise) const;
  /// Root mean square of the measured torques of all joints.
  [[nodiscard]] double torque_size_nm() const { return recorded_.torque_nm; }

  struct Gradient {
    Eigen::VectorXd by_z;
    NoiseValues by_noise;  ///< As long as the NoiseValues that it is taken at.
  };
  /// Runs in parallel, sums in order: the same bits for any number of threads. -infinity where
  /// Sigma is not positive definite in the computer's numbers.
  [[nodiscard]] double value(const Eigen::VectorXd& z,
                             const NoiseValues& noise,
                             Gradient* gradient = nullptr) const;

  /// Fisher's information of z in the mean, J' Sigma^-1 J, and what each source is of it:
  /// `by_source`[s] = J' Sigma^-1 Sigma_s Sigma^-1 J, which add to `information`.
  struct Information {
    Eigen::MatrixXd information;
    std::vector<Eigen::MatrixXd> by_source;  ///< Indexed by Source; that of literature is zero.
  };
  [[nodiscard]] Information information(const Eigen::VectorXd& z, const NoiseValues& noise) const;

  /// Of each calibration trial, Fisher's information of z and of the unseen quantities x, each over
  /// its standard deviation: [L J, L S W]' A^-1 [L J, L S W]. Trials add, and x has a precision of
  /// 1 beforehand; with x integrated over, the sum is `information`.
  [[nodiscard]] std::vector<Eigen::MatrixXd> information_by_trial(const Eigen::VectorXd& z,
                                                                  const NoiseValues& noise) const;

  /// The unseen quantities given the torque and z, each over its standard deviation.
  struct UnseenGiven {
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
    Eigen::MatrixXd by_z;  ///< d mean / d z with Sigma held, quantities x unknowns.
  };
  [[nodiscard]] UnseenGiven unseen_given(const Eigen::VectorXd& z, const NoiseValues& noise) const;

  /// The torque of a run, fitted or not, and its parts that are uncertain.
  struct RunForecast {
    Eigen::VectorXd mean_nm;                  ///< n J: T^ and the unseen quantities' expectation.
    Eigen::MatrixXd by_z;                     ///< d mean / d z, n J x unknowns.
    Eigen::VectorXd variance_nm2;             ///< n J: of what is measured about it, z apart.
    Eigen::MatrixXd force_n;                  ///< n x muscles
    std::vector<Eigen::MatrixXd> force_by_z;  ///< Per muscle, n x unknowns.
  };
  /// `unseen` is `unseen_given` at these values, which are also the reference.
  [[nodiscard]] RunForecast forecast(const TrialRun& run,
                                     const Eigen::VectorXd& z,
                                     const NoiseValues& noise,
                                     const UnseenGiven& unseen) const;

  struct Residuals {
    Eigen::VectorXd measured_nm;                           ///< L y, all runs one after the other.
    Eigen::VectorXd predicted_nm;                          ///< L T^.
    std::vector<std::vector<Eigen::Index>> rows_of_joint;  ///< As ParameterMap::joints().
  };
  [[nodiscard]] Residuals residuals(const Eigen::VectorXd& z) const;

 private:
  struct Block;
  [[nodiscard]] Eigen::VectorXd weights(const NoiseValues& noise) const;
  /// b^2 sigma_T^2 of the run.
  [[nodiscard]] double torque_variance(std::size_t run, const NoiseValues& noise) const;
  /// kappa^2 sd_c^2 of each channel.
  [[nodiscard]] Eigen::VectorXd envelope_scale(std::size_t run, const NoiseValues& noise) const;
  [[nodiscard]] Eigen::MatrixXd envelope_covariance(std::size_t run,
                                                    const TorqueSignals& signals,
                                                    const NoiseValues& noise) const;
  /// Fills the block of a run up to what needs no other run; false: not positive definite.
  [[nodiscard]] bool fill(std::size_t run,
                          const Eigen::VectorXd& weights,
                          const NoiseValues& noise,
                          Block& block) const;
  void pull_back(std::size_t run,
                 const NoiseValues& noise,
                 const Eigen::VectorXd& shared,
                 const Eigen::MatrixXd& inverse,
                 const Block& block,
                 Gradient& gradient) const;
  /// Q_ij by sample, n; of the joints whose first rows these are.
  [[nodiscard]] Eigen::VectorXd motion_variance(const TrialRun& run,
                                                const RunEvaluation& at,
                                                Eigen::Index first_row,
                                                Eigen::Index other_row) const;
  /// Adds the torque's error at this sigma_T^2 to the rows of each joint.
  void add_torque_error(const TrialRun& run,
                        double variance,
                        double log_time,
                        Eigen::MatrixXd& a) const;

  const StudyData& data_;
  EstimatorOptions options_;
  ParameterMap map_;
  std::vector<TrialRun> runs_;
  std::vector<std::vector<EmgNoise>> envelope_noise_;  ///< Per run, per channel.
  /// Per run: L Q L' and the least error of the torque, which no unknown changes.
  std::vector<Eigen::MatrixXd> given_;
  std::vector<Eigen::Index> trial_of_run_;  ///< Among the fitted trials.
  Eigen::Index trials_ = 0;
  Unseen unseen_;
  Believed believed_ = Believed::nothing_exact;
  std::vector<Eigen::MatrixXd> columns_;  ///< Per run: L S.
  Eigen::Index rows_ = 0;
  Recorded recorded_;
};

}  // namespace myoid::identification
