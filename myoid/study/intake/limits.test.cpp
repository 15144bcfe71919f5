#include "myoid/study/intake/limits.h"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/body/dynamics/ground_support.h"
#include "myoid/body/forces/sharing_plausibility.h"
#include "myoid/body/kinematics/motion_plausibility.h"
#include "myoid/body/model/model_plausibility.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/units.h"
#include "myoid/recording/amplifier_range.h"
#include "myoid/recording/signals/motion_jumps.h"

#include "tests/support/printed_page.h"

namespace myoid::study {
namespace {

/// A row of the tables in docs/guide/check.md.
struct PlausibilityRow {
  std::string what, level, limit;
};

double percent(double share) { return 100.0 * share; }
double degrees_of(double cosine) { return std::acos(cosine) / kDegree; }

void add_recordings(const PlausibilityLimits& l, std::vector<PlausibilityRow>& rows) {
  rows.push_back({"one EMG recording in two trials", "error",
                  fmt::format("{:g} % of the samples or more are equal, in any file, clock or window",
                              percent(l.clocks.same_samples))});
  rows.push_back({"", "warning",
                  "equal activations, which may be computed; a movement that repeats as a maximal contraction; one "
                  "movement with two EMGs"});
  rows.push_back(
      {"", "not counted", "windows of one file that do not overlap; two maximal contractions that share a recording"});
  rows.push_back({"a muscle of the model in two `[[muscle]]` tables", "error", "its force would count twice"});
  rows.push_back({"one EMG channel in two `[[muscle]]` tables", "warning", "unless `same_as` says so"});
  rows.push_back({"a muscle that moves none of the study's joints", "error",
                  fmt::format("its moment arms about all coordinates of the study stay below {:g} mm; a warning if "
                              "some of the `osim` list do: the other side's?",
                              1000.0 * l.model.least_arm_m)});
  rows.push_back({"a tendon as long as its muscle with it", "error",
                  "at no angle of the study's coordinates is the path longer than `tendon_slack_length`: the muscle "
                  "makes no force"});
  rows.push_back({"", "warning",
                  fmt::format("the fibers are nowhere {:g} to {:g} times their optimal length", l.model.shortest_fiber,
                              l.model.longest_fiber)});
  rows.push_back(
      {"masses of the model", "error", fmt::format("above {:g} kg (grams?)", body::kModelLimits.heaviest_kg)});
  rows.push_back({"", "warning",
                  fmt::format("below {:g} kg; above {:g} times `[subject] mass_kg`; of a model that stands also below "
                              "it by that factor (pounds?)",
                              body::kModelLimits.lightest_kg, l.model.heavier_than)});
  rows.push_back({"gravity of the model", "error or warning",
                  fmt::format("an error above {:g} m/s², a warning below {:g} m/s² unless it is 0",
                              body::kModelLimits.strongest_mps2, body::kModelLimits.weakest_mps2)});
  rows.push_back({"numbers of the model's muscles", "warning",
                  fmt::format("fiber outside {:g} to {:g} m, slack length below 0 or above {:g} m, force above {:g} N, "
                              "path point beyond {:g} m: mm, cm?",
                              body::kModelLimits.shortest_fiber_m, body::kModelLimits.longest_fiber_m,
                              body::kModelLimits.longest_tendon_m, body::kModelLimits.strongest_muscle_n,
                              body::kModelLimits.farthest_point_m)});
  rows.push_back({"body mass or height that a C3D file states", "warning",
                  fmt::format("`PROCESSING:BODYMASS` is {:g} % off `[subject] mass_kg` or another file's, or "
                              "`PROCESSING:HEIGHT` {:g} % off another file's: two persons?",
                              percent(l.model.other_mass), percent(l.model.other_height))});
  rows.push_back({"", "note", "the study gives no mass"});
  rows.push_back({"lengths of the model", "error",
                  fmt::format("two neighboring segments have their origins more than {:g} m apart: mm, cm?",
                              body::kLongestSegment_m)});
  rows.push_back(
      {"markers in another unit", "error",
       "the limit of `marker_unit` above, and a power of ten names the unit; nothing else of the trial is checked"});
  rows.push_back({"envelopes that are called raw EMG", "error",
                  "every used channel is an envelope by the limit of `emg_envelope` above"});
  rows.push_back(
      {"raw EMG that is called an envelope or an activation", "error",
       fmt::format("a channel goes below zero by more than {:g} % of its maximum", percent(l.emg.below_zero))});
  rows.push_back(
      {"slow raw EMG", "warning", fmt::format("fewer than {:g} samples a second", l.emg.slowest_raw_emg_hz)});
  rows.push_back(
      {"EMG beyond any electrode", "error",
       fmt::format("{:g} % of the samples beyond {:g} V, or one beyond {:g} V; `[emg] unit` corrects a wrong V",
                   100.0 * recording::kShareBeyond, recording::kMostVolts, l.emg.no_converter_v)});
  rows.push_back(
      {"activations in percent", "error",
       fmt::format("`kind = \"activation\"`, and above {:g} for {:g} s or longer; a shorter spike is a warning",
                   l.emg.largest_activation, l.emg.spike_s)});
  rows.push_back(
      {"activations in volts", "warning",
       fmt::format("`kind = \"activation\"`, and no activation of any trial above {:g}", l.emg.flat_activation)});
}

void add_clocks(const PlausibilityLimits& l, std::vector<PlausibilityRow>& rows) {
  rows.push_back({"a clock that is not in seconds", "error",
                  fmt::format("fewer than {:g} samples a second, of loads too; of a motion also more than {:g}",
                              body::kMotionLimits.slowest_hz, body::kMotionLimits.fastest_hz)});
  rows.push_back({"a pause of a clock", "warning; error if no part lasts a second",
                  fmt::format("longer than {:g} s: the trial is cut there. With `[ik] calibrate` an error. A spline "
                              "bridges shorter pauses, with a warning",
                              l.clocks.pause_s)});
  rows.push_back(
      {"EMG, `external_torque` or `external_loads` that do not cover their motion", "error",
       fmt::format("less than {:g} % of the motion, or {:g} s", percent(l.clocks.covered), l.clocks.shortest_trial_s)});
  rows.push_back(
      {"", "warning",
       fmt::format("more than {:g} s lack: not fitted without EMG, left out without loads", l.clocks.uncovered_s)});
  rows.push_back({"EMG and motion whose lengths have the ratio 2, 3, 4, 5, 10, 100 or 1000", "error",
                  fmt::format("within {:g} %, and the EMG is shorter, or both end within {:g} % of each other at the "
                              "corrected rate: a wrong rate",
                              percent(l.clocks.same_factor), percent(l.clocks.ends_together))});
  rows.push_back({"", "warning", "other such ratios; such a ratio of loads and motion"});
  rows.push_back(
      {"EMG and motion of unlike length", "warning",
       fmt::format(
           "one ratio in every trial, with differences of {:g} s or more; EMG {:g} times as long in a single trial",
           l.clocks.by_hand_s, l.clocks.alone_longer)});
  rows.push_back(
      {"", "warning",
       fmt::format("one ratio in trials of which one is {:g} times as long as another, {:g} ms apart at its end",
                   l.clocks.unlike_length, 1000.0 * l.clocks.apart_s)});
  rows.push_back(
      {"", "warning",
       "the only two trials of unlike length, and each EMG is as long as the other's motion: exchanged files"});
  rows.push_back(
      {"", "not checked",
       fmt::format("maximal contractions, trials with their own window or clock, beginnings more than {:g} s apart",
                   l.clocks.same_begin_s)});
  rows.push_back({"fewer rows or frames than the file states", "warning", "its end is absent"});
  rows.push_back({"a stated rate beside the times", "warning",
                  fmt::format("{:g} ms apart at the recording's end", 1000.0 * l.clocks.apart_s)});
}

void add_motion(std::vector<PlausibilityRow>& rows) {
  constexpr const auto& kJump = recording::kJumpLimits;
  constexpr const auto& kMotion = body::kMotionLimits;
  rows.push_back(
      {"external torque beyond any joint", "error",
       "2.5 × 1.5 × all muscles' torque at F_max plus body weight at the limb's end, in 1 % of the samples: N mm?"});
  rows.push_back(
      {"angles outside the model's range",
       fmt::format("warning; error if more than {:g} % of a clamped coordinate's samples are",
                   percent(kMotion.outside_share)),
       fmt::format("{:g} degrees beyond, where muscle paths mean nothing. Sign, zero or another coordinate? Of "
                   "other elbows, hips, knees and ankles a warning",
                   kMotion.beyond_rad / kDegree)});
  rows.push_back(
      {"angles beyond people's", "warning",
       fmt::format("{:g} degrees beyond the joint's published range (AAOS 1965) in {:g} % of the samples, where "
                   "the model's range is wider at both ends",
                   kMotion.beyond_rad / kDegree, percent(kMotion.beyond_people_share))});
  rows.push_back({"a motion that is too fast", "error",
                  fmt::format("an angle is faster than {:.0f} deg/s (a length: {:g} m/s) in {:g} % of the time: the "
                              "clock or the unit is another",
                              kMotion.fastest_radps / kDegree, kMotion.fastest_mps, percent(kMotion.share))});
  rows.push_back({"coordinates that the motion lacks", "warning",
                  "on which the trial depends: they rest at their default; locked ones are left out"});
  rows.push_back({"markers that do not determine a joint of the study", "error",
                  "in three frames that show most markers, the model's markers would be as near at another angle"});
  rows.push_back({"windows of `exclude`", "note; warning",
                  "times left out of fit, scores and activation 1; a warning outside of the trial"});
  rows.push_back({"an angle that jumps", "warning",
                  fmt::format("faster than {:.0f} deg/s (a length: {:g} m/s) and {:g} times its 95th percentile, for "
                              "less than {:g} s above half of that peak",
                              kJump.radps / kDegree, kJump.mps, kJump.ratio, kJump.for_s)});
}

void add_efforts(const PlausibilityLimits& l, std::vector<PlausibilityRow>& rows) {
  rows.push_back(
      {"a dynamometer that pushes with the active muscles", "error if no trial contradicts, else warning",
       fmt::format(
           "cosine between the muscles' torque and the opposite of `external_torque`: mean below {:g}, or odds of "
           "{:.0f}, over all trials; below {:g} in one",
           l.joints.certainly_reversed, std::exp(l.joints.certain_log_odds), l.joints.reversed)});
  rows.push_back({"", "", "muscles' torque: F_max times moment arm times EMG over its largest"});
  rows.push_back({"", "not checked",
                  fmt::format("torques below {:g} % of the trial's largest, {:g} % of weaker muscles or {:g} "
                              "times the limb's weight; EMG below {:g} %; passive trials",
                              percent(l.joints.dynamometer_torque), percent(l.joints.dynamometer_share),
                              l.joints.dynamometer_weights, percent(l.joints.active))});
  rows.push_back(
      {"a relaxed joint that yields", "warning",
       fmt::format(
           "`external_torque` falls as the angle rises: correlation below {:g}, by {:g} times the limb's weight",
           -l.joints.follows_at_rest, l.joints.dynamometer_weights)});
  rows.push_back({"radians called degrees", "warning",
                  fmt::format("an angle below {:g} degrees in all trials that changes by more than {:g}",
                              l.joints.least_angle_deg, l.joints.least_angle_range_deg)});
  rows.push_back(
      {"a torque of another unit", "warning",
       fmt::format("in every effort below {:g} % of the joint's strength", percent(l.joints.least_torque_share))});
  rows.push_back(
      {"a torque in another unit than the other trials'", "warning",
       fmt::format("over that of the active muscles it is {:g} times the others' median, or {:g} times less; "
                   "an error beyond {:g} times either way",
                   l.likeness.torque_more, l.likeness.torque_less, l.likeness.torque_unit)});
  rows.push_back({"", "not checked",
                  fmt::format("fewer than {} other trials; muscles of which antagonists leave less than {:g} %",
                              l.likeness.fewest_others, percent(l.likeness.unopposed))});
  rows.push_back({"radians of one trial called degrees", "warning",
                  fmt::format("among the other trials' angles as radians; range {:g} times as small as {} others'",
                              l.likeness.angle, l.likeness.fewest_alike)});
  rows.push_back(
      {"a passive trial that is not at rest", "warning: not taken for the resting torque",
       fmt::format(
           "a channel's mean is above {:g} % of its maximal contraction (without one {:g} % of its largest value)",
           percent(l.joints.relaxed), percent(l.joints.relaxed_without_mvc))});
  rows.push_back(
      {"", "warning: not taken for the resting torque",
       fmt::format("the torque is above {:g} % of the muscles' strength, beside the weight of limb and instrument",
                   percent(l.joints.resting_share))});
  rows.push_back({"a passive trial without a measured torque", "warning",
                  "neither `external_torque` nor `load_cell`: it gives no resting torque"});
  rows.push_back({"a held mass beyond the muscles", "warning; error if it is more than the person weighs",
                  fmt::format("its greatest moment is more than all muscles of the model can hold or, in a movement, "
                              "more than {:g} % of that",
                              percent(l.joints.lift_share))});
  rows.push_back({"the built-in arm's lengths", "error",
                  "`upper_arm_length_m`, `forearm_length_m` outside the range of the [study file](study.md#model); "
                  "`at_m` 2 m from its body or more: cm, mm?"});
}

void add_markers(const PlausibilityLimits& l, std::vector<PlausibilityRow>& rows) {
  rows.push_back({"left and right exchanged", "error",
                  fmt::format("more than {0:g} mm rms from the model; with both sides' labels exchanged less than "
                              "{0:g} mm, and less than {1:g} % of it",
                              1000.0 * l.markers.sides_m, percent(l.markers.sides_better))});
  rows.push_back(
      {"", "",
       fmt::format(
           "of the frame with most markers; at least {} pairs are needed: `R.Knee`, `RASI`, `knee_r`, `RightHeel`",
           l.markers.sides_pairs)});
  rows.push_back({"another axis up, or a mirror image", "error",
                  "the same distances of that frame, with another axis up or mirrored. Needs two segments with three "
                  "markers or more"});
  rows.push_back(
      {"", "not checked", "a model with a free base, which fits with any axis up: the row of the trunk below"});
  rows.push_back({"trials of two persons", "warning",
                  fmt::format("lengths of segments differ between two trials by more than {:g} % at the median",
                              percent(l.markers.other_size))});
  rows.push_back(
      {"", "", "lengths between any two markers of a body, and of the forearm between epicondyles and styloids"});
  rows.push_back({"", "not counted",
                  fmt::format("lengths below {:g} m, and lengths that change by as much within the trial (5th to 95th "
                              "percentile): skin moves",
                              l.markers.shortest_segment_m)});
  rows.push_back({"the vertical lies across the trunk", "warning",
                  fmt::format("markers of the body on the ground joint are {:.0f} degrees from upright by `[markers] "
                              "up`, and less than {:.0f} by another axis",
                              degrees_of(l.markers.trunk_across), degrees_of(l.markers.trunk_upright))});
}

void add_loads(const PlausibilityLimits& l, std::vector<PlausibilityRow>& rows) {
  rows.push_back({"a center of pressure that is not under its foot", "",
                  "taken is the median distance under load of a point of ExternalLoads from the nearest marker, or "
                  "point, of its body"});
  rows.push_back({"", "error",
                  fmt::format("two forces are each more than {:g} m from their own body, and less than {:g} % of that "
                              "from the other's: feet exchanged",
                              l.contacts.off_body_m, percent(l.contacts.much_nearer))});
  rows.push_back(
      {"", "error", fmt::format("a force is more than {:g} m away: mm, other axes", l.contacts.elsewhere_m)});
  rows.push_back({"", "error",
                  fmt::format("one is more than {:g} m away, and a turn by 90, 180 or 270 degrees about the vertical "
                              "brings all within {:g} m",
                              l.contacts.far_off_m, l.contacts.off_body_m)});
  rows.push_back({"", "warning",
                  fmt::format("a force is {:g} m off and nearer to another body, or {:g} m from a foot",
                              l.contacts.off_body_m, l.contacts.far_off_m)});
  rows.push_back(
      {"a force plate under nobody", "error",
       fmt::format(
           "no marker is within {:g} m of the center of pressure of a contact, and `force_plates` names no body",
           l.contacts.plate_far_m)});
  rows.push_back(
      {"a contact with a plate", "",
       fmt::format("{:g} ms and more above {:g} % of the largest force and {:g} N; pauses up to {:g} ms belong to it",
                   1000.0 * l.contacts.least_s, percent(l.contacts.least_share), l.contacts.least_n,
                   1000.0 * l.contacts.pause_s)});
  rows.push_back(
      {"a foreign foot on a plate", "warning",
       fmt::format("in a contact the pressure is more than {:g} m from its body and {:g} % as far from another",
                   l.contacts.off_body_m, percent(l.contacts.much_nearer))});
  rows.push_back({"", "warning",
                  fmt::format("or {:g} m from its body, while it is under the body in other contacts",
                              l.contacts.far_from_foot_m)});
  rows.push_back({"a second foot on a plate", "warning",
                  fmt::format("for {:g} ms the pressure is more than {:g} m from its body, and another foot without a "
                              "force stands within {:g} m",
                              1000.0 * l.contacts.least_s, l.contacts.between_feet_m, l.contacts.second_foot_m)});
  rows.push_back(
      {"", "",
       fmt::format(
           "standing: slower than {:g} m/s, at the same height to {:g} m. One force cannot be divided between two feet",
           l.contacts.still_mps, l.contacts.level_m)});
  rows.push_back({"", "",
                  fmt::format("plates in the floor only: the mean force is within {:.0f} degrees of the vertical, the "
                              "lowest body at most {:g} m below",
                              degrees_of(l.contacts.floor_cosine), l.contacts.two_steps_m)});
  rows.push_back({"a foot beside the plates", "warning: these times are not fitted",
                  fmt::format("for {:g} s the forces on the ground are below {:g} % of the weight, although they "
                              "otherwise carry {:g} % of it",
                              l.weight.unloaded_s, percent(l.weight.bears_nothing), percent(l.weight.bears))});
  rows.push_back({"", "",
                  fmt::format("and the body does not fall (by {:g} g or more). The times reach to where three quarters "
                              "of the weight are carried",
                              l.weight.falls)});
  rows.push_back(
      {"", "", "`run` detects this by the load that the joint to the ground would bear: half of the weight"});
  rows.push_back(
      {"nothing carries the body", "warning",
       "the model is a whole person on a free joint, the study concerns a leg's joint, and no force is measured"});
  rows.push_back({"measured forces that do not carry the body", "error",
                  fmt::format("of such a model: their mean sum under load points down or sideways with {:g} % of the "
                              "weight or more: sign, axes",
                              percent(body::kCarriedWeight))});
  rows.push_back(
      {"", "warning",
       fmt::format("it pushes up with less than {:g} %; the unit (kgf, lbf, kN) that would make 70 to 140 % is named",
                   percent(body::kCarriedWeight))});
}

std::vector<PlausibilityRow> plausibility_rows(const PlausibilityLimits& limits) {
  std::vector<PlausibilityRow> rows;
  add_recordings(limits, rows);
  add_clocks(limits, rows);
  add_motion(rows);
  add_efforts(limits, rows);
  add_markers(limits, rows);
  add_loads(limits, rows);
  return rows;
}

std::vector<PlausibilityRow> gate_rows(const GateLimits& l) {
  return {
      {"frames without a pose", "warning; fails", fmt::format("any; more than {:g} %", percent(l.lost_frames))},
      {"markers' distance from the model", "warning; fails",
       fmt::format("{:g} mm rms in a frame; {:g} mm rms over all. `check` takes six frames of a trial",
                   1000.0 * l.marker_error_m, 2000.0 * l.marker_error_m)},
      {"a joint that does not move", "fails",
       fmt::format("less than {:g} degrees in the trial that moves it most", l.least_range_deg)},
      {"muscles of the joint that are not in the study", "warning",
       fmt::format("more than {:g} % of the joint's strength", percent(l.missing_share))},
      {"muscles too weak for the torque", "warning",
       fmt::format("a reserve acts in {:g} % of the frames or more", percent(body::kReserveShare))},
      {"external loads that are not stated", "warning",
       "a fitted or predicted trial names none, and no `held_mass_kg` says what the person held (0: nothing). `check` "
       "warns, too"},
      {"a torque that is not explained", "warning", fmt::format("R² below {:g}", l.explains)},
      {"", "fails",
       fmt::format("errors larger than the torque, or than {:g} % of it at an R² below {:g}; of the fitted samples an "
                   "R² below {:g}",
                   percent(l.unrelated_share), l.mean, l.mean)},
      {"a reservation of the fit", "warning",
       "any: several minima, a wrong model, or motion that determines the torque without EMG"},
      {"an outlier among the trials left out", "warning",
       fmt::format("its error is {:g} robust deviations above the others', {:g} times their median in N m, and its R² "
                   "is below theirs",
                   l.far_fold, l.larger_fold)},
      {"lines with TODO", "warning", "any"},
      {"a unit of an angle or torque in doubt", "warning; fails", "fails if the joint hardly moves"},
      {"electrodes exchanged, or another gain or clock in a trial", "warning; fails",
       fmt::format("the fit is 150 times as probable [without](verdicts.md#mistaken); fails at R² {:g} or less, or a "
                   "gain or clock at 10^10",
                   l.explains)},
      {"dynamometer and masses that disagree", "warning",
       "the interval of their scales' ratio is farther from 1 than `torque_scale_sd`"},
      {"EMG on another clock than the torque", "warning",
       "the literature's muscles err least at one delay outside the usual leads (`clock_offset`), 5 % less than "
       "inside, in three of four trials"},
      {"", "", "delays of -1.5 to 1.5 s are tried"},
      {"", "", "of all movements whose torque and effort do not repeat themselves; gait and slow lifts too"},
  };
}

std::string markdown(const std::vector<PlausibilityRow>& rows) {
  std::string text = "| what | level | limit and reason |\n| --- | --- | --- |\n";
  for (const PlausibilityRow& row : rows) text += fmt::format("| {} | {} | {} |\n", row.what, row.level, row.limit);
  return text;
}

TEST(Limits, EveryOneIsPrinted) {
  test::expect_all_printed<PlausibilityLimits>(
      [](const PlausibilityLimits& limits) { return markdown(plausibility_rows(limits)); });
  test::expect_all_printed<GateLimits>([](const GateLimits& limits) { return markdown(gate_rows(limits)); });
}

TEST(Limits, AreTheOnesThatTheGuidePrints) {
  test::expect_printed("docs/guide/check.md", "what cannot be", markdown(plausibility_rows({})));
  test::expect_printed("docs/guide/check.md", "gates", markdown(gate_rows({})));
}

}  // namespace
}  // namespace myoid::study
