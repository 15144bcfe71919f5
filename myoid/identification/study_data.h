#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/parameter_set.h"
#include "myoid/core/time_series.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::identification {

/// One muscle to identify: where the search begins and what is known beforehand.
struct MuscleSetup {
  std::string name;
  std::string emg_channel;               ///< Channel of TrialData::activation.
  muscle::HillParameters<double> start;  ///< Literature or model; also the means of the priors.
  std::vector<std::string> fixed;        ///< Parameters held at their start.
  std::map<std::string, muscle::Range> bounds;  ///< Instead of the physical ones.
  std::map<std::string, Prior> priors;          ///< Absent: no prior for that parameter.
};

/// One trial on the clock of the motion: n samples, m muscles.
struct TrialData {
  std::string name;
  bool calibration = true;   ///< False: only predicted (validation).
  Eigen::VectorXd time_s;    ///< n
  Eigen::MatrixXd length_m;  ///< n x m: musculotendon length; fiber length = this - tendon slack
                             ///< length (rigid tendon).
  Eigen::MatrixXd velocity_mps;  ///< n x m
  Eigen::MatrixXd moment_arm_m;  ///< n x m: r = -dl/dq.
  Eigen::VectorXd torque_nm;     ///< n: what the muscles together must provide.
  Eigen::MatrixXd force_n;       ///< n x m: from force sharing, for method `paper`; may be empty.
  TimeSeries activation;         ///< Envelope of each EMG channel, 0..1, on its own clock.
};

struct StudyData {
  std::vector<MuscleSetup> muscles;
  std::vector<TrialData> trials;
};

/// Throws InvalidInput, naming trial and muscle, unless sizes agree, values are finite and every
/// EMG channel is there.
void validate(const StudyData& data);

/// Activation of every muscle of a trial at `time_s - delay_s`, n x m; beyond the recording its end
/// value. `slope`, if not null, receives d activation / dt.
[[nodiscard]] Eigen::MatrixXd muscle_activation(const StudyData& data,
                                                const TrialData& trial,
                                                const Eigen::VectorXd& time_s,
                                                double delay_s,
                                                Eigen::MatrixXd* slope = nullptr);

}  // namespace myoid::identification
