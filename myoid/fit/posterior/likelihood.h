#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/parameters.h"
#include "myoid/fit/posterior/noise_model.h"
#include "myoid/fit/posterior/torque_signals.h"
#include "myoid/fit/posterior/trial_run.h"
#include "myoid/fit/posterior/unseen.h"

namespace myoid::fit {

/// The columns of S follow the unknowns, or are read at the reference only, which saves their slopes.
enum class Columns { follow, at_reference };

/// Quantities that are taken to be exact: none, or the geometry and the sensors' scales.
enum class Believed { nothing_exact, geometry_and_sensors_exact };

/// ln p(y | z, phi) of all calibration trials. The torque is y = T^(z; u, q) + e_T + e_u + e_q + S
/// W x, and the operator L of each run acts on all of these terms,
///
///   ln p = -1/2 r' Sigma^-1 r - 1/2 ln |Sigma|,   r = L (y - T^),   Sigma = A + L S W^2 S' L',
///   S = S_z exp(growth (z - z_ref)) in the first term, S_z in the second,
///   S_z = S_ref + dS/dz a tanh((z - z_ref) / a)  (Unseen::slopes),
///   A_ij = [i = j] (L b^2 sigma_i^2 exp(-|dt|/tau_T) L' + (0.002 y_i)^2) + L Q_ij L'
///          + kappa^2 sum_c sd_c^2 K_c D_ic D_jc K_c'
///
/// Behind the torques y holds the measured fiber lengths of a run, and T^ the model's. Their errors have the covariance
/// lambda^2 sd^2 exp(-|dt| / 1 s) behind L, sd the study's, and a tenth of sd at the least; lambda is unknown. A row
/// without a measurement has a residual of 0 and an error of 1 km.
///
/// y holds the torques of all joints of a run; A_ij are the rows of its joints i and j. Torque errors of two joints are
/// independent. sigma_i is sigma_T times the joint's root mean square torque over that of all joints. A torque errs by
/// 0.2 % of its root mean square y_i at the least (kLeastTorqueError): a torque that never changes would be infinitely
/// exact otherwise. The noise of an envelope and the error of an angle act on all joints that the muscle crosses. A is
/// one block per run. S W^2 S', of the unseen quantities, couples all runs; Woodbury's identity includes it. K_c is L
/// behind the filters of the envelope and the drive (EmgNoise). An activation without EMG is a channel with an error of
/// its own, without kappa (UnseenActivation). Q and the size of S belong to reference values of the
/// unknowns, and so do the errors of activations without EMG: a determinant that followed would take their muscles
/// out of action. In the quadratic form alone the columns that multiply F_max grow with it (Unseen::growth), because a
/// determinant that followed would prefer muscles whose errors are small. The errors of angle and rate in Q are
/// independent from sample to sample. The constant -n/2 ln(2 pi) is left out.
///
/// Errors are not independent where a movement is repeated: the drive repeats with the movement, and so does the error
/// of the model. Of a trial's n rows per joint at most a count: the density of the trial, given x, has the power min(1,
/// a/n), a = UnseenSpreads::independent_rows; 0 leaves every row its weight. Where motion alone tells the torque, a is
/// at most the number of the motion's coefficients (told_by_motion_alone). This is a coarsened posterior (Miller and
/// Dunson, J. Am. Stat. Assoc. 114, 1113, 2019).
class Likelihood {
 public:
  static constexpr double kLeastTorqueError = 0.002;  ///< Of its root mean square, behind L.

  /// Takes the start as the reference, or the answer at which a search begins (EstimatorOptions::begin_at). `session`
  /// is the recording of which the data are a part; null: the data are the whole recording.
  Likelihood(const StudyData& data,
             const EstimatorOptions& options,
             Columns columns = Columns::follow,
             const Recorded* session = nullptr);

  /// Computes S, its slopes and Q at the reference values z.
  void refer_to(const Eigen::VectorXd& z);
  /// Leaves the quantities that are taken to be exact out of S; none is by default.
  void believe(Believed believed) { believed_ = believed; }

  [[nodiscard]] const ParameterMap& parameters() const { return map_; }
  [[nodiscard]] const std::vector<TrialRun>& runs() const { return runs_; }
  [[nodiscard]] const Unseen& unseen() const { return unseen_; }
  /// The values of the unknowns to which S and Q belong.
  [[nodiscard]] const Eigen::VectorXd& reference() const { return reference_; }
  [[nodiscard]] const Recorded& recorded() const { return recorded_; }
  [[nodiscard]] Eigen::Index row_count() const { return rows_; }
  /// Number of fitted trials, in whose order ln b stands in NoiseValues.
  [[nodiscard]] Eigen::Index trial_count() const { return trials_; }
  /// Returns the index of the run's trial in NoiseValues.
  [[nodiscard]] Eigen::Index share_place(std::size_t run) const { return kNoiseFieldCount + trial_of_run_[run]; }
  /// Returns ln b of the run's trial, or 0 where `noise` has no entry for this trial.
  [[nodiscard]] double log_share(std::size_t run, const NoiseValues& noise) const;
  /// Index of ln lambda in NoiseValues; none where no fiber length was measured.
  [[nodiscard]] std::optional<Eigen::Index> fascicle_place() const;
  /// Returns the weight of a row of the run, min(1, a/n).
  [[nodiscard]] double row_weight(std::size_t run) const { return row_weight_[run]; }
  /// Root mean square of the measured torques of all joints.
  [[nodiscard]] double torque_size_nm() const { return recorded_.torque_nm; }

  struct Gradient {
    Eigen::VectorXd by_z;
    NoiseValues by_noise;  ///< As long as the NoiseValues at which it is taken.
  };
  /// Returns ln p. Evaluates runs in parallel and sums them in order, so the bits do not depend on
  /// the number of threads. Returns -infinity where Sigma is not numerically positive definite.
  [[nodiscard]] double value(const Eigen::VectorXd& z, const NoiseValues& noise, Gradient* gradient = nullptr) const;

  /// Fisher's information about z in the mean, J' Sigma^-1 J, and each source's part of it,
  /// `by_source`[s] = J' Sigma^-1 Sigma_s Sigma^-1 J. The parts add to `information`.
  struct Information {
    Eigen::MatrixXd information;
    std::vector<Eigen::MatrixXd> by_source;  ///< Indexed by Source; zero for the literature.
  };
  [[nodiscard]] Information information(const Eigen::VectorXd& z, const NoiseValues& noise) const;

  /// Returns for each calibration trial Fisher's information of z and of the unseen quantities x,
  /// each over its standard deviation: [L J, L S W]' A^-1 [L J, L S W]. Trials add. The prior
  /// precision of x is 1; integrated over x, the sum is `information`.
  [[nodiscard]] std::vector<Eigen::MatrixXd> information_by_trial(const Eigen::VectorXd& z,
                                                                  const NoiseValues& noise) const;

  /// The unseen quantities, given the torque and z, each over its standard deviation.
  struct UnseenGiven {
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
    Eigen::MatrixXd by_z;  ///< d mean / d z with Sigma held, quantities x unknowns.
  };
  [[nodiscard]] UnseenGiven unseen_given(const Eigen::VectorXd& z, const NoiseValues& noise) const;

  /// The forecast torque of a run, fitted or not, and its uncertain parts.
  struct RunForecast {
    Eigen::VectorXd fiber_m;                  ///< n K: the same of TrialRun::fascicles.
    Eigen::VectorXd mean_nm;                  ///< n J: T^ and the unseen quantities' expectation.
    Eigen::MatrixXd by_z;                     ///< d mean / d z, n J x unknowns.
    Eigen::VectorXd variance_nm2;             ///< n J: of measurements about the mean, at fixed z.
    Eigen::MatrixXd force_n;                  ///< n x muscles
    std::vector<Eigen::MatrixXd> force_by_z;  ///< Per muscle, n x unknowns.
  };
  /// Forecasts a run. `unseen` is `unseen_given` at these values, which are also the reference.
  [[nodiscard]] RunForecast forecast(const TrialRun& run,
                                     const Eigen::VectorXd& z,
                                     const NoiseValues& noise,
                                     const UnseenGiven& unseen) const;

  /// The torque of the muscles alone and how it changes, n J rows.
  struct ActiveTorque {
    Eigen::VectorXd torque_nm;  ///< At z, without the joint's own torque.
    Eigen::MatrixXd by_z;       ///< n J x unknowns.
    /// n J x quantities: change by each unseen quantity over its standard deviation. The scale of the torque changes
    /// the measurement and not the muscles: 0.
    Eigen::MatrixXd by_unseen;
  };
  /// Returns the muscles' torque in a run. The columns of S are those of the reference, as in `unseen_given`.
  [[nodiscard]] ActiveTorque active_torque(const TrialRun& run,
                                           const Eigen::VectorXd& z,
                                           const NoiseValues& noise) const;

  struct Residuals {
    Eigen::VectorXd measured_nm;                           ///< L y, all runs one after the other.
    Eigen::VectorXd predicted_nm;                          ///< L (T^ + S W x^), without the model's error.
    std::vector<std::vector<Eigen::Index>> rows_of_joint;  ///< As ParameterMap::joints().
  };
  /// Returns the measured torques and those of the law with geometry and sensors as the torque tells them. An error of
  /// a moment arm is part of the explanation: where muscles work against each other, T^ alone may be off by several
  /// times the torque that is left. The error of the model is no explanation.
  [[nodiscard]] Residuals residuals(const Eigen::VectorXd& z, const NoiseValues& noise) const;

 private:
  struct AllRuns;
  struct Block;
  struct Point;
  /// Computes the weight of each run's rows.
  void weigh_rows();
  [[nodiscard]] Eigen::VectorXd weights(const NoiseValues& noise) const;
  /// Returns the quantities of all runs that need no run's block.
  [[nodiscard]] AllRuns all_runs(const Eigen::VectorXd& z, const NoiseValues& noise) const;
  /// Returns the columns' factors exp(growth (z - z_ref)).
  [[nodiscard]] Eigen::VectorXd grown(const Eigen::VectorXd& z) const;
  /// Returns b^2 sigma_T^2 of the run.
  [[nodiscard]] double torque_variance(std::size_t run, const NoiseValues& noise) const;
  /// Returns kappa^2 sd_c^2 of each channel, sd_c^2 of an activation without EMG.
  [[nodiscard]] static Eigen::VectorXd envelope_scale(const TrialRun& run, const NoiseValues& noise);
  /// Returns the covariance by the channels with EMG, or by those without.
  [[nodiscard]] Eigen::MatrixXd envelope_covariance(std::size_t run,
                                                    const TorqueSignals& signals,
                                                    const NoiseValues& noise,
                                                    bool without_emg) const;
  /// Returns the measured rows of the run without the model's; 0 where a fiber length is absent.
  [[nodiscard]] Eigen::VectorXd residual(std::size_t run, const TorqueSignals& signals) const;
  /// Returns lambda^2 sd^2 of measured fiber lengths.
  [[nodiscard]] double fascicle_variance(const NoiseValues& noise) const;
  /// Returns L S of the run at the unknowns of `all`.
  [[nodiscard]] Eigen::MatrixXd turned_columns(std::size_t run, const AllRuns& all) const;
  /// Returns the blocks of all runs, in parallel.
  [[nodiscard]] std::vector<Block> filled(const ModelValues& values,
                                          const ChainsByOwner* chains,
                                          const AllRuns& all,
                                          const NoiseValues& noise) const;
  /// Fills the parts of a run's block that need no other run; false: not positive definite.
  [[nodiscard]] bool fill(std::size_t run, const AllRuns& all, const NoiseValues& noise, Block& block) const;
  /// `half_left` is C^-1 L S W G^-1.
  void pull_back(std::size_t run,
                 const NoiseValues& noise,
                 const AllRuns& all,
                 const Block& block,
                 const Eigen::MatrixXd& half_left,
                 Gradient& gradient) const;
  /// Adds the gradient by which the columns of S turn (Unseen::slopes). `w` is Sigma^-1 r,
  /// `half_left` is C^-1 L S W G^-1.
  void add_gradient_of_columns(std::size_t run,
                               const AllRuns& all,
                               const Eigen::VectorXd& w,
                               const Eigen::MatrixXd& half_left,
                               const Block& block,
                               Eigen::VectorXd& by_z) const;
  /// Returns Q_ij of the joints with these first rows, one entry per sample, n.
  [[nodiscard]] Eigen::VectorXd motion_variance(const TrialRun& run,
                                                const RunEvaluation& at,
                                                Eigen::Index first_row,
                                                Eigen::Index other_row) const;
  /// Adds the torque error's covariance at this sigma_T^2 to the rows of each joint.
  void add_torque_error(const TrialRun& run, double variance, double log_time, Eigen::MatrixXd& a) const;
  /// Adds the covariance of errors of this variance to the rows of each fascicle.
  void add_fascicle_error(const TrialRun& run, double variance, Eigen::MatrixXd& a) const;

  const StudyData& data_;
  EstimatorOptions options_;
  Columns columns_are_;
  ParameterMap map_;
  std::vector<TrialRun> runs_;
  std::vector<std::vector<EmgNoise>> envelope_noise_;  ///< Per run, per channel.
  /// Per run: L Q L' and the least errors of torque and fiber lengths, which no unknown changes, and the errors of
  /// activations without EMG.
  std::vector<Eigen::MatrixXd> given_, without_emg_;
  std::vector<Eigen::Index> trial_of_run_;  ///< Per run: its trial among the fitted trials.
  Eigen::Index trials_ = 0;
  std::vector<double> row_weight_;  ///< Per run.
  Eigen::VectorXd reference_;       ///< z_ref
  Unseen unseen_;
  Believed believed_ = Believed::nothing_exact;
  std::vector<Eigen::MatrixXd> columns_;   ///< Per run: L S_ref.
  std::vector<Eigen::MatrixXd> by_slope_;  ///< Per run: L dS/dz, by Unseen::slopes.
  Eigen::Index rows_ = 0;
  Recorded recorded_;
};

}  // namespace myoid::fit
