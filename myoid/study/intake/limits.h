#pragma once

namespace myoid::study {

/// Limits hold for the model, its muscles and the weight of a person.
struct ModelLimits {
  double least_arm_m = 1e-4;  ///< A muscle with smaller moment arms does not cross the joint.
  double shortest_fiber = 0.1, longest_fiber = 3.0;
  double heavier_than = 1.2;   ///< Ratio of the model's mass to the person's; clothes and shoes weigh less.
  double other_mass = 0.1;     ///< Share by which two statements of a body mass differ: clothes, shoes, months.
  double other_height = 0.05;  ///< Likewise of a body height.
};

/// Limits hold for EMG.
struct EmgLimits {
  double no_converter_v = 1e8;        ///< More than the counts of a converter of 24 bits.
  double slowest_raw_emg_hz = 800.0;  ///< Raw EMG reaches 400 Hz.
  double below_zero = 0.2;            ///< Share of the maximum by which a filter may swing below zero.
  double largest_activation = 2.0;    ///< A larger activation is in percent, unless it is a spike.
  double spike_s = 0.1;               ///< A spike is shorter than this.
  double flat_activation = 0.02;      ///< No muscle is active below this activation.
};

/// Limits hold for the clocks and lengths of recordings.
struct ClockLimits {
  double same_samples = 0.1;  ///< Share of equal samples from which two recordings are one.
  double pause_s = 0.5;       ///< A longer pause of a clock is not bridged.
  double shortest_trial_s = 0.5;
  double covered = 0.5;          ///< Least share of the motion that EMG or loads cover.
  double uncovered_s = 0.1;      ///< The motion may last so much longer, without a word.
  double same_factor = 0.02;     ///< Relative distance from a factor of emg_cover.h.
  double same_begin_s = 0.5;     ///< Recordings that begin farther apart are not compared.
  double ends_together = 0.005;  ///< Relative difference of durations at the corrected rate that
                                 ///< makes a wrong rate certain.
  double by_hand_s = 1.0;        ///< Recordings stopped by hand differ by this in duration.
  double alone_longer = 1.5;     ///< Ratio of durations of EMG and motion in a single trial.
  double apart_s = 0.05;         ///< Clocks that drift apart by more shift the EMG by as much as its delay.
  /// Trials are of unlike length above this ratio of their durations.
  double unlike_length = 1.2;
};

/// Limits hold for angles and torques, dynamometers and passive trials.
struct JointLimits {
  /// Joints of a study bend farther than this in some trial, unless they hold still within the range.
  double least_angle_deg = 3.5, least_angle_range_deg = 0.2;
  /// People do four lifts in a row with 90 % of the load of a single lift (Brzycki 1993), and a
  /// single lift with the muscles' force at its worst angle, some 80 % of the best.
  double lift_share = 0.75;
  /// Dynamometers: cosine of the muscles' pull and the torque of the surroundings.
  double reversed = -0.5, certainly_reversed = -0.8;
  double certain_log_odds = 6.907755;  ///< Odds of a thousand.
  double follows_at_rest = 0.8;        ///< Correlation of torque and angle of a relaxed joint.
  /// A torque below this share of the strength of the study's weaker muscles is not checked.
  double dynamometer_share = 0.1;
  /// A torque below this multiple of the limb's weight is not checked.
  double dynamometer_weights = 4.0;
  /// A torque that stays below this share of the joint's strength in every effort is in another unit.
  double least_torque_share = 0.004;
  double dynamometer_torque = 0.5;  ///< Share of a trial's largest torque.
  double active = 0.1;              ///< Share of a channel's largest value.
  /// Passive trials: share of the maximal contraction or, without one, of the largest value.
  double relaxed = 0.02, relaxed_without_mvc = 0.05;
  double resting_share = 0.25;  ///< Share of the muscles' strength that no relaxed joint resists.
};

/// Limits hold for a trial beside the others of its study.
struct LikenessLimits {
  /// A dynamometer's torque over the active muscles': factors from the others' median. A muscle at its shortest pulls
  /// an eighth of its strength, and none pulls more than some times its strength.
  double torque_more = 6.0, torque_less = 12.0;
  /// Beyond this factor the torque is in another unit: radians over degrees are 57, N mm over N m 1000.
  double torque_unit = 25.0;
  double unopposed = 0.5;  ///< Share of the muscles' torque that antagonists leave.
  double angle = 15.0;     ///< Factor by which the ranges of angles differ: degrees over radians is 57.
  int fewest_others = 3;   ///< Trials with a dynamometer.
  int fewest_alike = 2;    ///< Trials with angles.
};

/// Limits hold for markers.
struct MarkerLimits {
  double trunk_across = 0.5;   ///< Cosine between trunk and vertical, 60 degrees.
  double trunk_upright = 0.8;  ///< Cosine of 37 degrees.
  double sides_m = 0.04;       ///< Rms distance of a frame's markers from the model.
  double sides_better = 0.5;   ///< Ratio of this distance with left and right exchanged.
  int sides_pairs = 3;
  double other_size = 0.06;          ///< Markers set anew land within a centimeter, 4 % of a forearm.
  double shortest_segment_m = 0.10;  ///< Skin moves markers by 1 to 2 cm: shorter lengths tell no person.
};

/// Limits hold for contacts with the ground.
struct ContactLimits {
  double plate_far_m = 0.3;      ///< A marker farther from a contact does not stand on it.
  double off_body_m = 0.2;       ///< A foot is 0.27 m long: half of it, and the error of markers.
  double far_off_m = 0.4;        ///< A foot's length and the error of markers.
  double elsewhere_m = 2.0;      ///< Distance beyond any body.
  double much_nearer = 0.5;      ///< Ratio to the distance from the own body.
  double least_share = 0.05;     ///< Share of the largest force.
  double least_n = 20.0;         ///< A smaller force is no contact.
  double least_s = 0.05;         ///< A shorter contact is a knock.
  double pause_s = 0.025;        ///< A longer pause ends a contact.
  double far_from_foot_m = 0.3;  ///< Distance from the foot that is too far in any case.
  double between_feet_m = 0.1;   ///< The center of pressure leaves the foot's outline.
  double second_foot_m = 0.4;    ///< Reach of a plate from its center of pressure.
  double level_m = 0.04;         ///< Feet on one floor differ by less in height.
  double still_mps = 0.25;       ///< A foot that stands moves slower.
  double floor_cosine = 0.5;     ///< A floor pushes within 60 degrees of the vertical.
  double two_steps_m = 0.5;      ///< The lower foot is two steps of stairs below the plate.
};

/// Limits hold for the weight that forces on the ground carry.
struct WeightLimits {
  double bears = 0.5;           ///< Share of the weight that the forces under the body carry.
  double bears_nothing = 0.05;  ///< Share of the weight below which the forces carry nothing.
  double unloaded_s = 0.1;
  /// Share of gravity: a body that accelerates faster downwards is in the air.
  double falls = 0.5;
};

/// The thresholds of `check` and `run` for doubtful and wrong inputs and results.
/// recording/signals/quality_limits.h has the thresholds of single channels. docs/guide/check.md prints both
/// (limits.test.cpp).
struct PlausibilityLimits {
  ModelLimits model;
  EmgLimits emg;
  ClockLimits clocks;
  JointLimits joints;
  LikenessLimits likeness;
  MarkerLimits markers;
  ContactLimits contacts;
  WeightLimits weight;
};
inline constexpr PlausibilityLimits kLimits;

/// The thresholds of the quality gates of `run`.
struct GateLimits {
  double lost_frames = 0.05;      ///< Share of frames without a pose from which the gate fails.
  double marker_error_m = 0.020;  ///< Rms over the markers of a frame; twice it fails.
  double missing_share = 0.05;    ///< Share of a joint's strength.
  double least_range_deg = 5.0;   ///< A joint that moves less was not moved.
  double explains = 0.5;          ///< R2 of a good prediction.
  double mean = 0.0;              ///< R2 of the torque's mean; a fit below describes nothing.
  double unrelated_share = 0.5;   ///< Share of the torque that the errors of a prediction below must exceed, too.
  double far_fold = 3.0;          ///< Robust deviations of an error from the other folds' errors.
  double larger_fold = 1.5;       ///< Ratio of an error to the other folds' median.
};
inline constexpr GateLimits kGateLimits;

}  // namespace myoid::study
