#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/identification/study_data.h"
#include "myoid/identification/torque.h"
#include "myoid/math/butterworth.h"
#include "myoid/math/spline.h"
#include "myoid/muscle/hill_muscle.h"

namespace myoid::identification {

/// One entry of the solver's vector.
struct FreeParameter {
  enum class Kind { muscle, delay, gain };
  Kind kind = Kind::muscle;
  int muscle = -1;  ///< For `muscle`.
  const muscle::HillField* field = nullptr;
  double muscle::HillForce::*derivative = nullptr;
  std::string channel;       ///< For `gain`.
  bool logarithmic = false;  ///< The solver sees ln(value).
  double start = 0.0;        ///< In the solver's scale, like the next four.
  double lower = 0.0;
  double upper = 0.0;
  double prior_mean = 0.0;
  double prior_sd = 0.0;  ///< 0: no prior.
  std::string label;      ///< "BIC.max_isometric_force"

  [[nodiscard]] double to_value(double z) const;
};

/// The calibration samples, thinned, and the torque they predict with its derivatives.
class TorqueModel {
 public:
  TorqueModel(const StudyData& data, const TorqueOptions& options);

  [[nodiscard]] const std::vector<FreeParameter>& free() const { return free_; }
  [[nodiscard]] Eigen::Index sample_count() const { return torque_.size(); }
  [[nodiscard]] const std::vector<Eigen::Index>& pieces() const {
    return pieces_;
  }  ///< Samples per trial.
  [[nodiscard]] const Eigen::VectorXd& torque() const { return torque_; }
  [[nodiscard]] double rate_hz() const { return rate_hz_; }
  [[nodiscard]] int dropped() const { return dropped_; }

  /// T^ at z, low-passed like `torque()` by TorqueOptions::residual_cutoff_hz; `jacobian` (n x p)
  /// and `channel_power` (n: sum over channels of their torque squared) are filled if not null.
  void evaluate(const Eigen::VectorXd& z,
                Eigen::VectorXd& predicted,
                Eigen::MatrixXd* jacobian,
                Eigen::VectorXd* channel_power) const;

  [[nodiscard]] std::vector<muscle::HillParameters<double>> muscles(const Eigen::VectorXd& z) const;
  [[nodiscard]] double delay_s(const Eigen::VectorXd& z) const;

 private:
  void add_parameters(const StudyData& data, const TorqueOptions& options);
  /// Low-passes every column, trial by trial.
  void smooth(Eigen::Ref<Eigen::MatrixXd> columns) const;

  std::vector<FreeParameter> free_;
  std::vector<muscle::HillParameters<double>> start_;
  std::vector<int> channel_of_muscle_;
  std::vector<std::string> channels_;
  double fixed_delay_s_ = 0.0;
  // One row per sample, all trials one after the other.
  Eigen::VectorXd time_s_, torque_;
  Eigen::MatrixXd length_m_, velocity_mps_, arm_m_;
  std::vector<Eigen::Index> pieces_;
  std::vector<std::vector<math::Spline>> envelope_;            ///< Per trial and channel.
  std::vector<double> first_time_s_, last_time_s_;             ///< Of the EMG, per trial.
  std::vector<std::vector<math::SecondOrderSection>> filter_;  ///< Per trial; empty: none.
  double rate_hz_ = 0.0;
  int dropped_ = 0;
};

}  // namespace myoid::identification
