#include "myoid/intake/limits.h"

#include <cmath>

#include <fmt/format.h>

#include "myoid/core/units.h"
#include "myoid/dynamics/ground_support.h"
#include "myoid/forces/sharing_plausibility.h"
#include "myoid/kinematics/motion_plausibility.h"
#include "myoid/model/model_plausibility.h"
#include "myoid/osim/osim_reader.h"
#include "myoid/signals/motion_jumps.h"

namespace myoid {
namespace {

double percent(double share) { return 100.0 * share; }
double degrees_of(double cosine) { return std::acos(cosine) / kDegree; }

void add_recordings(const PlausibilityLimits& l, std::vector<PlausibilityRow>& rows) {
  rows.push_back(
      {"one EMG recording in two trials", "error",
       fmt::format(
           "{:g} % of the samples or more are equal, in any file, clock or window. Windows of one file that do not "
           "overlap count as two trials; two maximal contractions may share a recording. A warning: equal activations, "
           "which may be computed; a movement that repeats as a maximal contraction; one movement with two EMGs",
           percent(l.same_samples))});
  rows.push_back({"a muscle of the model in two `[[muscle]]` tables", "error",
                  "its force would count twice. One EMG channel in two tables is a warning unless `same_as` says so"});
  rows.push_back({"a muscle that moves none of the study's joints", "error",
                  fmt::format("its moment arms about all coordinates of the study are below {:g} mm over their whole "
                              "range: the other side's? A warning if only some of the `osim` list are such muscles",
                              1000.0 * l.least_arm_m)});
  rows.push_back({"a tendon as long as its muscle with it", "error",
                  fmt::format("at no angle in the range of the study's coordinates is the path longer than "
                              "`tendon_slack_length`: the muscle makes no force. A warning if the fibers are nowhere "
                              "{:g} to {:g} times their optimal length",
                              l.shortest_fiber, l.longest_fiber)});
  rows.push_back({"masses of the model", "error or warning",
                  fmt::format("an error above {:g} kg (grams?); a warning below {:g} kg, and above {:g} times "
                              "`[subject] mass_kg`; so below, of a model that stands (pounds?). A model of a part of "
                              "the body is lighter than the person",
                              model::kModelLimits.heaviest_kg, model::kModelLimits.lightest_kg, l.heavier_than)});
  rows.push_back({"gravity of the model", "error or warning",
                  fmt::format("an error above {:g} m/s², a warning below {:g} m/s² unless it is 0",
                              model::kModelLimits.strongest_mps2, model::kModelLimits.weakest_mps2)});
  rows.push_back({"numbers of the model's muscles", "warning",
                  fmt::format("an optimal fiber length outside {:g} to {:g} m, a tendon slack length below 0 or above "
                              "{:g} m, a force above {:g} N, a point of a path more than {:g} m from the origin of its "
                              "frame: mm, cm?",
                              model::kModelLimits.shortest_fiber_m, model::kModelLimits.longest_fiber_m,
                              model::kModelLimits.longest_tendon_m, model::kModelLimits.strongest_muscle_n,
                              model::kModelLimits.farthest_point_m)});
  rows.push_back({"body mass or height that a C3D file states", "warning or note",
                  fmt::format("a warning if `PROCESSING:BODYMASS` differs by more than {:g} % from `[subject] mass_kg` "
                              "or between two files, or `PROCESSING:HEIGHT` by more than {:g} % between two files: two "
                              "persons? A note if the study gives no mass",
                              percent(l.other_mass), percent(l.other_height))});
  rows.push_back({"lengths of the model", "error",
                  fmt::format("two neighboring segments have their origins more than {:g} m apart: mm, cm? No command "
                              "that computes takes such a model",
                              model::kLongestSegment_m)});
  rows.push_back({"markers in another unit", "error",
                  "the limit of `marker_unit` above, and a power of ten tells the unit; nothing else of the trial is "
                  "checked"});
  rows.push_back({"envelopes that are called raw EMG", "error",
                  "every used channel is an envelope by the limit of `emg_envelope` above"});
  rows.push_back({"raw EMG that is called an envelope or an activation", "error",
                  fmt::format("a channel goes below zero by more than {:g} % of its maximum", percent(l.below_zero))});
  rows.push_back({"slow raw EMG", "warning", fmt::format("fewer than {:g} samples a second", l.slowest_raw_emg_hz)});
  rows.push_back(
      {"EMG beyond any electrode", "error",
       fmt::format(
           "beyond {:g} V, which is too large even for a converter's counts; beyond 10 V a fault of its channel",
           l.no_converter_v)});
  rows.push_back(
      {"activations in percent", "error",
       fmt::format("`kind = \"activation\"`, and above {:g} for {:g} s or longer; a shorter spike is a warning",
                   l.largest_activation, l.spike_s)});
  rows.push_back(
      {"activations in volts", "warning",
       fmt::format("`kind = \"activation\"`, and no activation of any trial above {:g}", l.flat_activation)});
}

void add_clocks(const PlausibilityLimits& l, std::vector<PlausibilityRow>& rows) {
  rows.push_back({"a clock that is not in seconds", "error",
                  fmt::format("fewer than {:g} samples a second; of a motion also more than {:g}",
                              kinematics::kMotionLimits.slowest_hz, kinematics::kMotionLimits.fastest_hz)});
  rows.push_back({"a pause of a clock", "warning; error if no part lasts a second",
                  fmt::format("longer than {:g} s: the trial is cut there. With `[ik] calibrate` an error. A spline "
                              "bridges shorter pauses, with a warning",
                              l.pause_s)});
  rows.push_back({"EMG, `external_torque` or `external_loads` that do not cover their motion", "error or warning",
                  fmt::format("less than {:g} % of the motion, or {:g} s; a warning if more than {:g} s lack: not "
                              "fitted without EMG, left out without loads",
                              percent(l.covered), l.shortest_trial_s, l.uncovered_s)});
  rows.push_back(
      {"EMG and motion of unlike length", "error or warning",
       fmt::format(
           "the ratio of the lengths is 2, 3, 4, 5 or 10, within {:g} %: a wrong rate. An error if the EMG is "
           "the shorter one, or if both end within {:g} % of each other at the corrected rate; else a warning. "
           "Also a warning: one ratio in every trial, with differences of {:g} s or more; in a single trial, "
           "EMG that is {:g} times as long; the only two trials of unlike length, where each EMG is as long as "
           "the other's motion: exchanged files; such a ratio of `external_loads` and motion. Maximal contractions, "
           "trials with their own window or clock, and "
           "beginnings more than {:g} s apart are not checked",
           percent(l.same_factor), percent(l.ends_together), l.by_hand_s, l.alone_longer, l.same_begin_s)});
}

void add_motion(const PlausibilityLimits& l, std::vector<PlausibilityRow>& rows) {
  constexpr const auto& kJump = signals::kJumpLimits;
  rows.push_back(
      {"external torque beyond any joint", "error",
       "more than 2.5 × 1.5 × the torque of all muscles of the model at F_max (the strongest persons of calibrations; "
       "lengthening) plus body weight at the end of the limb, in one sample of a hundred: N mm?"});
  rows.push_back(
      {"angles outside the model's range",
       fmt::format("warning; error if more than {:g} % of a clamped coordinate's samples are", percent(l.angle_share)),
       fmt::format("{:g} degrees beyond, where muscle paths mean nothing. Sign, zero or another coordinate?",
                   l.angle_beyond_deg)});
  constexpr const auto& kMotion = kinematics::kMotionLimits;
  rows.push_back({"a motion that is too fast", "error",
                  fmt::format("an angle is faster than {:.0f} deg/s (a length: {:g} m/s) in {:g} % of the time: the "
                              "clock or the unit is another. Only a pitcher's shoulder is faster, for some hundredths "
                              "of a second",
                              kMotion.fastest_radps / kDegree, kMotion.fastest_mps, percent(kMotion.share))});
  rows.push_back(
      {"coordinates that the motion lacks", "warning", "they rest at their default; locked ones are left out"});
  rows.push_back(
      {"markers that do not determine a joint of the study", "error",
       "in three frames that show most markers, the study's coordinate is open: the markers of the file that "
       "the model has would be as near at another angle"});
  rows.push_back({"windows of `exclude`", "note; warning",
                  "the times that are left out of fit, scores and activation 1; a warning if one lies outside of the "
                  "trial"});
  rows.push_back({"an angle that jumps", "warning",
                  fmt::format("moves faster than {:.0f} deg/s (a length: {:g} m/s) and {:g} times as fast as 95 % of "
                              "the time, for less than {:g} s above half of that peak. Joints speed up and slow down "
                              "over a tenth of a second; the jump's acceleration would mean a torque that does not "
                              "exist",
                              kJump.radps / kDegree, kJump.mps, kJump.ratio, kJump.for_s)});
}

void add_efforts(const PlausibilityLimits& l, std::vector<PlausibilityRow>& rows) {
  rows.push_back(
      {"a dynamometer that pushes with the active muscles", "error if in all trials, warning if in some",
       fmt::format("the muscles' torque (F_max times moment arm times EMG relative to the channel's largest) is "
                   "compared with minus `external_torque` where that is largest: cosine below {:g} over all, below "
                   "{:g} in a trial. Then the sign is reversed: the torque must be that of the surroundings on the "
                   "body. Not checked: torques below {:g} % of the trial's largest, {:g} % of the muscles' strength or "
                   "{:g} times the limb's weight; EMG below {:g} % of its largest; passive trials",
                   l.certainly_reversed, l.reversed, percent(l.dynamometer_torque), percent(l.dynamometer_share),
                   l.dynamometer_weights, percent(l.active))});
  rows.push_back({"a passive trial that is not at rest", "warning: not taken for the resting torque",
                  fmt::format("a channel is above {:g} % of its maximal contraction on average (without maximal "
                              "contractions {:g} % of its largest value), or the torque is above {:g} % of the "
                              "muscles' strength, beside the weight of limb and instrument",
                              percent(l.relaxed), percent(l.relaxed_without_mvc), percent(l.resting_share))});
  rows.push_back({"a passive trial without a measured torque", "warning",
                  "neither `external_torque` nor `load_cell`: it tells no resting torque"});
  rows.push_back({"a held mass beyond the muscles", "warning; error if it is more than the person weighs",
                  fmt::format("its greatest moment is more than all muscles of the model can hold or, in a movement, "
                              "more than {:g} % of that: four lifts in a row take 90 % of a single lift's maximum, and "
                              "the worst angle of a lift allows some 80 % of the best",
                              percent(l.lift_share))});
  rows.push_back({"the built-in arm's lengths", "error",
                  "`upper_arm_length_m`, `forearm_length_m` outside the range that the [study file](study.md#model) "
                  "allows: cm, mm? `at_m` of a held mass 2 m from its body or more"});
}

void add_markers(const PlausibilityLimits& l, std::vector<PlausibilityRow>& rows) {
  rows.push_back({"left and right exchanged", "error",
                  fmt::format("in the frame with most markers, the distance from the model is more than {0:g} mm rms "
                              "as labelled, and with the labels of both sides exchanged less than {1:g} % of that and "
                              "less than {0:g} mm (at least {2} pairs: `R.Knee`, `RASI`, `knee_r`, `RightHeel`)",
                              1000.0 * l.sides_m, percent(l.sides_better), l.sides_pairs)});
  rows.push_back(
      {"another axis up, or a mirror image", "error",
       fmt::format("that frame is more than {0:g} mm rms from the model as read, and less than {1:g} % of "
                   "that and less than {0:g} mm with another axis up, or mirrored (markers of the other "
                   "side). Needs two segments with three markers or more. A model with a free base fits with any "
                   "axis up: the next row",
                   1000.0 * l.sides_m, percent(l.sides_better))});
  rows.push_back(
      {"trials of two persons", "warning",
       fmt::format("lengths of segments differ between two trials by more than {0:g} % at the median: between any two "
                   "markers of a body, and of the forearm between epicondyles and styloids. Lengths below {1:g} m and "
                   "lengths that change by more than {0:g} % within the trial (5th to 95th percentile) do not count, "
                   "because skin moves markers",
                   percent(l.other_size), l.shortest_segment_m)});
  rows.push_back({"the vertical lies across the trunk", "warning",
                  fmt::format("markers of the body on the ground joint are more than {:.0f} degrees from upright by "
                              "`[markers] up`, and less than {:.0f} by another axis, up or down",
                              degrees_of(l.trunk_across), degrees_of(l.trunk_upright))});
}

void add_loads(const PlausibilityLimits& l, std::vector<PlausibilityRow>& rows) {
  rows.push_back(
      {"a center of pressure that is not under its foot", "error or warning",
       fmt::format("the median distance under load of a point of ExternalLoads from the nearest marker (or point of "
                   "the model) of its body. An error if two forces are each more than {:g} m from their own body and "
                   "less than {:g} % of that from the other's (feet exchanged), if a force is more than {:g} m away "
                   "(mm, other axes), or if a turn by 90, 180 or 270 degrees about the vertical brings all forces "
                   "within {:g} m and one is more than {:g} m away. A warning if a force is {:g} m off and nearer to "
                   "another body, or {:g} m from a foot (a body at most so high above the lowest)",
                   l.off_body_m, percent(l.much_nearer), l.elsewhere_m, l.off_body_m, l.far_off_m, l.off_body_m,
                   l.far_off_m)});
  rows.push_back(
      {"a force plate under nobody", "error",
       fmt::format(
           "no marker is within {:g} m of the center of pressure of a contact, and `force_plates` names no body",
           l.plate_far_m)});
  rows.push_back(
      {"a foreign foot on a plate", "warning",
       fmt::format("in a contact ({:g} ms and more above {:g} % of the largest force and {:g} N; pauses up to {:g} ms "
                   "belong to it), the center of pressure is more than {:g} m from the body of the force and {:g} % as "
                   "far from another body, or {:g} m from the body while it is under the body in other contacts. The "
                   "message has the times, their share of the loaded time and the distances",
                   1000.0 * l.contact_s, percent(l.contact_share), l.contact_n, 1000.0 * l.contact_pause_s,
                   l.off_body_m, percent(l.much_nearer), l.far_from_foot_m)});
  rows.push_back(
      {"a second foot on a plate", "warning",
       fmt::format("for {:g} ms or more, the center of pressure is more than {:g} m from its body, while another foot "
                   "without a force of its own stands (slower than {:g} m/s) at the same height (to {:g} m) within "
                   "{:g} m. One force cannot be divided between two feet. Only plates in the floor: the mean force is "
                   "within {:.0f} degrees of the vertical, and the lowest body is at most {:g} m below",
                   1000.0 * l.contact_s, l.between_feet_m, l.still_mps, l.level_m, l.second_foot_m,
                   degrees_of(l.floor_cosine), l.two_steps_m)});
  rows.push_back(
      {"a foot beside the plates", "warning",
       fmt::format(
           "for {:g} s or more, the forces on the ground are below {:g} % of the weight, although they "
           "otherwise carry {:g} % of it and the body does not fall (by {:g} g or more); the times told reach to where "
           "they carry three quarters of it. `run` detects this by the load that the joint to the ground would bear "
           "(half of the weight) and does not fit those times",
           l.unloaded_s, percent(l.bears_nothing), percent(l.bears), l.falls)});
  rows.push_back(
      {"nothing carries the body", "warning",
       "the model is a whole person on a free joint, the study concerns a leg's joint, and no force is measured"});
  rows.push_back(
      {"measured forces that do not carry the body", "error or warning",
       fmt::format(
           "of such a model, the sum of the forces with a point in ground, mean while it is a fifth of its "
           "largest size or more, pushes up with less than {0:g} % of the weight. An error if it points down or "
           "sideways with {0:g} % or more (sign, axes); else a warning, with the unit (kgf, lbf, kN) that would "
           "make 70 to 140 %. `id` and `so` warn, too",
           percent(dynamics::kCarriedWeight))});
}

}  // namespace

std::vector<PlausibilityRow> plausibility_rows(const PlausibilityLimits& limits) {
  std::vector<PlausibilityRow> rows;
  add_recordings(limits, rows);
  add_clocks(limits, rows);
  add_motion(limits, rows);
  add_efforts(limits, rows);
  add_markers(limits, rows);
  add_loads(limits, rows);
  return rows;
}

std::vector<PlausibilityRow> gate_rows(const GateLimits& l) {
  return {
      {"frames without a pose", "warning; fails", fmt::format("any; more than {:g} %", percent(l.lost_frames))},
      {"markers' distance from the model", "warning; fails",
       fmt::format("{:g} mm rms in a frame; {:g} mm rms over all", 1000.0 * l.marker_error_m,
                   2000.0 * l.marker_error_m)},
      {"a joint that does not move", "fails",
       fmt::format("less than {:g} degrees in the trial that moves it most", l.least_range_deg)},
      {"muscles of the joint that are not in the study", "warning",
       fmt::format("more than {:g} % of the joint's strength", percent(l.missing_share))},
      {"muscles too weak for the torque", "warning",
       fmt::format("a reserve acts in {:g} % of the frames or more", percent(forces::kReserveShare))},
      {"external loads that are not stated", "warning",
       "a trial that is fitted or predicted has no `external_loads`, `force_plates`, `load_cell` or `external_torque`, "
       "and does not say by `held_mass_kg` what the person held (0: nothing). `check` warns, too"},
      {"a torque that is not explained", "warning; fails",
       fmt::format("R² below {:g}; errors larger than the torque, or larger than {:g} % of it at an R² below {:g}; of "
                   "the fitted samples an R² below {:g}",
                   l.explains, percent(l.unrelated_share), l.unrelated, l.mean)},
      {"a reservation of the fit", "warning",
       "any: several minima, a wrong model, or motion that tells the torque without EMG"},
      {"an outlier among the trials left out", "warning",
       fmt::format("its error, in N m or as a share of its torque's spread, is more than {:g} robust deviations "
                   "(of logarithms) above the others', {:g} times their median in N m, and its R² is below theirs",
                   l.far_fold, l.larger_fold)},
      {"two electrodes that seem to be exchanged", "warning; fails",
       fmt::format("the gate's message has the figures; fails if R² with the given names is {:g} or less. "
                   "Of a single trial a warning",
                   l.explains)},
      {"EMG on another clock than the torque", "warning",
       "the error of the literature's muscles by the delay of their EMG, -1.5 to 1.5 s, has one minimum, outside of "
       "the "
       "usual leads (`clock_offset`), in three of four trials and 5 % lower than inside; in a single trial 25 % lower, "
       "and as low as in the other trials. Told of all movements whose torque and effort do not repeat themselves, "
       "gait "
       "and slow lifts too"},
  };
}

std::string markdown(const std::vector<PlausibilityRow>& rows) {
  std::string text = "| what | level | limit and reason |\n| --- | --- | --- |\n";
  for (const PlausibilityRow& row : rows) text += fmt::format("| {} | {} | {} |\n", row.what, row.level, row.limit);
  return text;
}

}  // namespace myoid
