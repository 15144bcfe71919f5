#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/prior.h"
#include "myoid/core/stretch.h"
#include "myoid/core/time_series.h"
#include "myoid/identification/muscle_law.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::identification {

/// One muscle to identify: start of the search, bounds and priors.
struct MuscleSetup {
  std::string name;
  std::string emg_channel;               ///< Channel of TrialData::activation.
  muscle::HillParameters<double> start;  ///< Literature or model; also the means of the priors.
  std::vector<std::string> fixed;        ///< Parameters held at their start.
  std::map<std::string, muscle::Range> bounds;  ///< Instead of the physical ones.
  /// Absent: no prior for that parameter. With one for `eccentric_slope_ratio` that ratio is the
  /// unknown and V_sh V_shl follows from it.
  std::map<std::string, Prior> priors;
  std::vector<std::string> given_priors;  ///< Names of `priors` that the study gave.
  MuscleExtras extras;                    ///< Terms beyond the source paper's law.
};

/// A wish of the study for a parameter; later rules win.
struct ParameterRule {
  std::string parameter;            ///< A name of `parameter_fields()`.
  std::vector<std::string> owners;  ///< Muscles, EMG channels or joints; empty: all.
  std::optional<bool> free;
  std::optional<double> value;  ///< Start, or the value at which it is held.
  std::optional<double> lower, upper;
  std::optional<double> prior_mean, prior_sd;  ///< In the parameter's unit.
  bool usual = false;  ///< Applied to every recording, not asked for by the study.
  bool tie = false;  ///< One unknown for all owners: their ratios to the starting values are equal.
  bool operator==(const ParameterRule&) const = default;
};

/// A further joint of a trial, n samples. Motion is needed for joint viscosity, stiffness and
/// inertia.
struct JointData {
  std::string name;
  Eigen::VectorXd torque_nm;
  Eigen::MatrixXd moment_arm_m;                                    ///< n x m
  Eigen::VectorXd angle_rad, velocity_radps, acceleration_radps2;  ///< Empty, or n.
  Eigen::VectorXd resting_nm;                                      ///< As TrialData's.
};

/// One trial on the clock of the motion: n samples, m muscles.
struct TrialData {
  std::string name;
  bool calibration = true;   ///< False: only predicted (validation).
  std::string condition;     ///< Trials of one condition (load, speed) have one name; may be empty.
  Eigen::VectorXd time_s;    ///< n
  Eigen::MatrixXd length_m;  ///< n x m: musculotendon length; fiber length = this - tendon slack
                             ///< length (rigid tendon).
  Eigen::MatrixXd velocity_mps;  ///< n x m
  Eigen::MatrixXd moment_arm_m;  ///< n x m: r = -dl/dq.
  Eigen::VectorXd torque_nm;     ///< n: the sum that the muscles must provide.
  Eigen::MatrixXd force_n;  ///< n x m: from force sharing, for `paper` and `force`; may be empty.
  TimeSeries activation;    ///< Envelope of each EMG channel, 0..1, on its own clock.
  std::string joint = "joint";  ///< Name of the joint of `torque_nm`.
  Eigen::VectorXd angle_rad, velocity_radps, acceleration_radps2;  ///< Of it: empty, or n.
  /// Share of `torque_nm` that the joint was measured to make by itself (RestingTorque): empty for
  /// none, or n. The muscles' activity has to make the rest.
  Eigen::VectorXd resting_nm;
  std::vector<JointData> more_joints;  ///< Method `torque` fits them too.
  /// Predicted, but neither fitted nor scored: warm-up, fatigue, stretches that the study excludes.
  std::vector<Stretch> excluded;
};

struct StudyData {
  std::vector<MuscleSetup> muscles;
  std::vector<TrialData> trials;
  std::vector<ParameterRule> rules;
};

/// The literature's priors of a muscle that starts here (beliefs.h), with
/// the spread of the slope ratio (ln S 0.5) in place of that of V_sh V_shl where V_ml > 1. That of
/// V_sh is for a v_max that is known, or free: one that is only held belongs to `free_speeds`.
[[nodiscard]] std::map<std::string, Prior> literature_priors(
    const muscle::HillParameters<double>& start);

/// Muscles of `wanted` (empty: all) whose v_max nobody states: it is not in MuscleSetup::fixed.
[[nodiscard]] std::vector<std::string> unstated_speeds(const StudyData& data,
                                                       const std::vector<std::string>& wanted = {});

/// Frees the v_max of these muscles, ahead of `StudyData::rules`, which may hold it again. At small
/// speeds only the slope (1 + 1/V_sh) / v_max of f_v acts, so that d ln V_sh = -(1 + V_sh) d ln
/// v_max along it: with v_max held at a value that is not the muscle's own, V_sh makes up for it
/// outside of its interval. Free, with the literature's spread (ln 0.2), its interval carries that.
void free_speeds(StudyData& data, const std::vector<std::string>& muscles);

/// Joints of a trial: its own and `more_joints`.
[[nodiscard]] std::size_t joint_count(const TrialData& trial);

/// The trial as one joint's alone: that joint's torque, moment arms and motion, 0 its own, then
/// `more_joints` in order.
[[nodiscard]] TrialData of_joint(const TrialData& trial, std::size_t joint);

/// Samples [first, first + count) of a trial, as a trial of their own with the whole EMG.
[[nodiscard]] TrialData part(const TrialData& trial, Eigen::Index first, Eigen::Index count);

/// The resting torque of the trial's own joint, n: zeros where none was measured.
[[nodiscard]] Eigen::VectorXd resting_torque_nm(const TrialData& trial);

/// Names of all joints of all trials, in order of appearance.
[[nodiscard]] std::vector<std::string> joint_names(const StudyData& data);

/// Samples of a trial that no excluded stretch holds, in order.
[[nodiscard]] std::vector<Eigen::Index> included_rows(const TrialData& trial);

/// Throws InvalidInput, naming trial and muscle, unless sizes agree, values are finite and every
/// EMG channel is there.
void validate(const StudyData& data);

}  // namespace myoid::identification
