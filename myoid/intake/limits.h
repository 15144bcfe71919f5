#pragma once

#include <string>
#include <vector>

namespace myoid {

/// The thresholds by which `check` and `run` call an input or a result doubtful or wrong, beside
/// those of single channels (signals/quality_limits.h). docs/guide/check.md prints them.
struct PlausibilityLimits {
  // One recording and its copies.
  double same_samples = 0.1;  ///< Share of equal samples from which two recordings are one.
  // EMG.
  double no_converter_v = 1e8;      ///< More than the counts of a converter of 24 bits.
  double below_zero = 0.2;          ///< Of the maximum: so far a filter may swing.
  double largest_activation = 2.0;  ///< An activation above it is in percent ...
  double spike_s = 0.1;             ///< ... unless it is a spike, shorter than this.
  double flat_activation = 0.02;    ///< No muscle is active below it.
  // Clocks and lengths.
  double pause_s = 0.5;  ///< A longer pause of a clock is not bridged.
  double slowest_clock_hz = 5.0;
  double shortest_trial_s = 0.5;
  double covered = 0.5;          ///< Share of the motion that the EMG covers at least.
  double same_factor = 0.02;     ///< Relative distance from a factor 2, 3, 4, 5 or 10 ...
  double ends_together = 0.005;  ///< ... and for certain, with a corrected rate.
  double by_hand_s = 1.0;        ///< Recordings that are stopped by hand end so far apart.
  double alone_longer = 1.5;     ///< EMG of the only trial over its motion.
  // Angles, torques, masses.
  double angle_beyond_deg = 10.0;  ///< Joints go some degrees beyond an author's range.
  double angle_share = 0.5;        ///< Of the samples outside: another convention, no posture.
  /// Four lifts in a row are done with 90 % of the load that can be lifted once (Brzycki 1993), and
  /// that with the muscles' force at the worst angle of the lift, some 80 % of the best.
  double lift_share = 0.75;
  // Dynamometers: cosine of the muscles' pull and the torque of the surroundings.
  double reversed = -0.5, certainly_reversed = -0.8;
  double dynamometer_share = 0.1;  ///< A torque below this share of the muscles' tells nothing ...
  double dynamometer_weights = 4.0;  ///< ... nor one below as many times the limb's weight.
  // Markers.
  double trunk_across = 0.5;   ///< Cosine between trunk and vertical, 60 degrees.
  double trunk_upright = 0.8;  ///< 37 degrees.
  double sides_m = 0.04;       ///< Rms distance of a frame's markers from the model.
  double sides_better = 0.5;   ///< With left and right exchanged, of that.
  int sides_pairs = 3;
  // Loads.
  double plate_far_m = 0.3;      ///< A marker farther from a contact does not stand on it.
  double off_body_m = 0.2;       ///< A foot is 0.27 m long: half of it, and the error of markers.
  double elsewhere_m = 2.0;      ///< Beyond any body.
  double much_nearer = 0.5;      ///< Of the distance to the own body.
  double contact_share = 0.05;   ///< Of the largest force.
  double contact_s = 0.05;       ///< A shorter contact is a knock.
  double far_from_foot_m = 0.3;  ///< Beyond the foot, whoever is near.
  double between_feet_m = 0.1;   ///< The center of pressure leaves the foot's outline.
  double second_foot_m = 0.4;    ///< Reach of a plate from its center of pressure.
  double bears = 0.5;            ///< Of the weight: forces that the body stands on.
  double bears_nothing = 0.05;   ///< Of the weight.
  double unloaded_s = 0.1;
  double falls = 0.5;  ///< Of gravity: a body that sinks faster flies.
};
inline constexpr PlausibilityLimits kLimits;

/// The thresholds of the quality gates of `run`.
struct GateLimits {
  double lost_frames = 0.05;      ///< Share of frames without a pose that is a failure.
  double marker_error_m = 0.020;  ///< Rms over the markers of a frame; twice it fails.
  double missing_share = 0.05;    ///< Of a joint's strength without an identified muscle.
  double least_range_deg = 5.0;   ///< A joint that moves less was not moved.
  double reserve_percent = 5.0;   ///< Of the frames with a reserve.
  double explains = 0.5;          ///< R2 of a good prediction.
  double unrelated = -1.0;        ///< R2 of a prediction that has nothing to do with the torque.
  double far_fold = 3.0;          ///< Robust deviations of an error from the other folds' ...
  double larger_fold = 1.5;       ///< ... and its ratio to their median.
};
inline constexpr GateLimits kGateLimits;

/// A row of the tables in docs/guide/check.md.
struct PlausibilityRow {
  std::string what, level, limit;
};
[[nodiscard]] std::vector<PlausibilityRow> plausibility_rows();
[[nodiscard]] std::vector<PlausibilityRow> gate_rows();

/// The rows as Markdown.
[[nodiscard]] std::string markdown(const std::vector<PlausibilityRow>& rows);

}  // namespace myoid
