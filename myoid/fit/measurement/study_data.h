#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/muscle_law.h"
#include "myoid/ground/core/choice.h"
#include "myoid/ground/core/prior.h"
#include "myoid/ground/core/stretch.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::fit {

/// The prior of an activation that no electrode measured.
enum class WithoutEmg {
  unseen,     ///< A constant.
  synergies,  ///< The non-negative factors of the measured EMG.
};
inline constexpr std::string_view kWithoutEmgNames[] = {"unseen", "synergies"};
constexpr ChoiceNames choice_names(WithoutEmg) { return kWithoutEmgNames; }

/// The prior of an activation that no electrode measured: a sum of signals, each with an unknown factor of mean 1 that
/// stays the same over a session, and an error about the sum.
struct UnseenActivation {
  WithoutEmg by = WithoutEmg::unseen;
  std::vector<std::string> parts;  ///< Channels of TrialData::activation; MuscleSetup::emg_channel is their sum.
  double part_sd = 0.0;            ///< Of each part's factor.
  double sd = 0.0;                 ///< Of the error, which is that of an activation, 0..1.
  double cutoff_hz = 0.0;          ///< Above it the error has no power.
};

/// One muscle to identify: start of the search, bounds and priors.
struct MuscleSetup {
  std::string name;
  std::string emg_channel;  ///< Channel of TrialData::activation.
  /// From literature or model; also the means of the priors.
  muscle::HillParameters<double> start;
  std::vector<std::string> fixed;               ///< Parameters held at their start.
  std::map<std::string, muscle::Range> bounds;  ///< Replace the physical bounds.
  /// Priors by parameter; absent: no prior. A prior for `eccentric_slope_ratio` makes that ratio
  /// the unknown, from which V_sh V_shl follows.
  std::map<std::string, Prior> priors;
  std::vector<std::string> given_priors;        ///< Names of the `priors` that the study gives.
  MuscleExtras extras;                          ///< Terms beyond the source paper's law.
  std::optional<UnseenActivation> unseen = {};  ///< Of a muscle without EMG; empty: an electrode measured it.
};

[[nodiscard]] bool contains(const std::vector<std::string>& names, std::string_view name);

/// Returns true if the names hold this one, or are none: all are meant.
[[nodiscard]] bool covers(const std::vector<std::string>& names, std::string_view name);

/// A request of the study for a parameter; later rules win.
struct ParameterRule {
  std::string parameter;            ///< A name of `parameter_fields()`.
  std::vector<std::string> owners;  ///< Muscles, EMG channels or joints; empty: all.
  std::optional<bool> free;
  std::optional<double> value;  ///< Start, or the value of a held parameter.
  std::optional<double> lower, upper;
  std::optional<double> prior_mean, prior_sd;  ///< In the parameter's unit.
  bool usual = false;                          ///< Applies to every recording; the study does not ask for it.
  bool tie = false;  ///< One unknown for all owners: their ratios to the starting values are equal.
  bool operator==(const ParameterRule&) const = default;
};

/// One joint of a trial, n samples. Joint viscosity, stiffness and inertia need the motion.
struct JointData {
  std::string joint = "joint";                                     ///< Its name.
  Eigen::VectorXd torque_nm;                                       ///< n: the sum that the muscles must provide.
  Eigen::MatrixXd moment_arm_m;                                    ///< n x m: r = -dl/dq.
  Eigen::VectorXd angle_rad, velocity_radps, acceleration_radps2;  ///< Empty, or n.
  /// Measured passive part of `torque_nm` (RestingTorque): empty for none, or n. The muscles' activity makes the rest.
  Eigen::VectorXd resting_nm;
  Eigen::VectorXd dynamics_nm;  ///< Part of `torque_nm` by weight and inertia, beside a dynamometer's: n, else empty.
};

/// One trial on the clock of the motion, with its first joint: n samples, m muscles.
struct TrialData : JointData {
  std::string name;
  bool calibration = true;             ///< False: only predicted (validation).
  bool reference = false;              ///< A maximal contraction: its greatest effort is activation 1.
  std::string condition;               ///< Name shared by trials of one condition (load, speed); may be empty.
  Eigen::VectorXd time_s;              ///< n
  Eigen::MatrixXd length_m;            ///< n x m: musculotendon length; fiber length = this - tendon slack
                                       ///< length (rigid tendon).
  Eigen::MatrixXd velocity_mps;        ///< n x m
  Eigen::MatrixXd force_n;             ///< n x m: from force sharing, for `paper` and `force`; may be empty.
  Eigen::MatrixXd fascicle_m;          ///< n x m: measured fiber lengths, NaN where there are none; may be empty.
  TimeSeries activation;               ///< Envelope of each EMG channel, 0..1, on its own clock.
  std::vector<JointData> more_joints;  ///< Further joints, which method `torque` fits too.
  /// Stretches that are predicted, but neither fitted nor scored: fatigue, exclusions of the study.
  std::vector<Stretch> excluded;
};

struct StudyData {
  std::vector<MuscleSetup> muscles;
  std::vector<TrialData> trials;
  std::vector<ParameterRule> rules;
};

/// Returns the literature's priors (beliefs.h) of a muscle with this start. Where V_ml > 1 the
/// spread of the slope ratio (ln S 0.5) replaces that of V_sh V_shl. The spread of V_sh is for a
/// known or a free v_max; `free_speeds` treats a v_max that is only held.
[[nodiscard]] std::map<std::string, Prior> literature_priors(const muscle::HillParameters<double>& start);

/// Returns the muscles of `wanted` (empty: all) with an unstated v_max: not in MuscleSetup::fixed.
[[nodiscard]] std::vector<std::string> unstated_speeds(const StudyData& data,
                                                       const std::vector<std::string>& wanted = {});

/// Frees the v_max of these muscles, ahead of `StudyData::rules`, which may hold it again. At small speeds only the
/// slope (1 + 1/V_sh) / v_max of f_v acts: if v_max is held at a wrong value, V_sh compensates and leaves its own
/// interval. A free v_max with the literature's spread (ln 0.2) widens V_sh's interval accordingly.
void free_speeds(StudyData& data, const std::vector<std::string>& muscles);

/// Returns true if a fitted trial has measured fiber lengths of the muscle.
[[nodiscard]] bool measures_fascicles(const StudyData& data, std::size_t muscle);

/// Returns the number of a trial's joints: its own and `more_joints`.
[[nodiscard]] std::size_t joint_count(const TrialData& trial);

/// Returns a joint of the trial: 0 is the trial's own, then follow `more_joints` in order.
[[nodiscard]] const JointData& joint_at(const TrialData& trial, std::size_t joint);

/// Returns the trial with one joint alone.
[[nodiscard]] TrialData of_joint(const TrialData& trial, std::size_t joint);

/// Returns these samples of a trial, in rising order, as a trial of their own with the whole EMG.
[[nodiscard]] TrialData at_rows(const TrialData& trial, const std::vector<Eigen::Index>& rows);

/// Returns samples [first, first + count) of a trial as a trial of their own, with the whole EMG.
[[nodiscard]] TrialData part(const TrialData& trial, Eigen::Index first, Eigen::Index count);

/// Returns the resting torque of the trial's own joint, n: zeros if none was measured.
[[nodiscard]] Eigen::VectorXd resting_torque_nm(const TrialData& trial);

/// Returns the names of all joints of all trials, in order of appearance.
[[nodiscard]] std::vector<std::string> joint_names(const StudyData& data);

/// Returns angle, rate and acceleration of a joint at its n samples, n x 3; empty: not all are known.
[[nodiscard]] Eigen::MatrixXd motion_of(const JointData& joint, Eigen::Index n);

/// Returns the samples of a trial outside all excluded stretches, in order.
[[nodiscard]] std::vector<Eigen::Index> included_rows(const TrialData& trial);

/// Returns every stride-th sample that may be fitted, at most `max_rate_hz`, in stretches without a gap. Leaves out
/// what the study excludes and the ends of a trial, where splines and filters are unreliable and the delay reaches
/// beyond the recorded EMG. Throws InvalidInput if the trial has no torque or no moment arms.
[[nodiscard]] std::vector<std::vector<Eigen::Index>> fitted_stretches(const TrialData& trial,
                                                                      double max_rate_hz,
                                                                      double longest_delay_s);

/// Throws InvalidInput, with trial and muscle, unless sizes agree, values are finite and every EMG channel exists.
void validate(const StudyData& data);

}  // namespace myoid::fit
