#include "myoid/intake/limits.h"

#include <cmath>

#include <fmt/format.h>

#include "myoid/core/units.h"

namespace myoid {
namespace {

double percent(double share) { return 100.0 * share; }
double degrees_of(double cosine) { return std::acos(cosine) / kDegree; }

void add_recordings(std::vector<PlausibilityRow>& rows) {
  const PlausibilityLimits& l = kLimits;
  rows.push_back(
      {"one EMG recording in two trials", "error",
       fmt::format(
           "{:g} % of the samples or more are the same, whatever file, clock or window they "
           "come in. Windows of one file that do not overlap are two trials; two maximal "
           "contractions may share one. Of activations (they may be computed) a warning. A "
           "movement that is its own maximal contraction, or one movement with two EMGs, is "
           "a warning",
           percent(l.same_samples))});
  rows.push_back({"a muscle of the model in two `[[muscle]]` tables", "error",
                  "its force would count twice. One EMG channel in two tables is a warning unless "
                  "`same_as` says so"});
  rows.push_back(
      {"EMG that is called raw and is an envelope", "error",
       "every channel that is used is an envelope by the limit of `emg_envelope` above"});
  rows.push_back({"EMG that is called an envelope or an activation and is raw", "error",
                  fmt::format("a channel goes below zero by more than {:g} % of its maximum",
                              percent(l.below_zero))});
  rows.push_back(
      {"EMG that no electrode gives", "error",
       fmt::format("beyond {:g} V: no converter gives that, not even as counts; beyond 10 "
                   "V it is a fault of its channel",
                   l.no_converter_v)});
  rows.push_back(
      {"activations in percent", "error",
       fmt::format(
           "`kind = \"activation\"`, and above {:g} for {:g} s or longer; a shorter spike is "
           "a warning",
           l.largest_activation, l.spike_s)});
  rows.push_back({"activations in volts", "warning",
                  fmt::format("`kind = \"activation\"`, and none of any trial above {:g}",
                              l.flat_activation)});
  rows.push_back({"a clock that is not in seconds", "error",
                  fmt::format("fewer than {:g} samples a second", l.slowest_clock_hz)});
  rows.push_back({"a pause of a clock", "error",
                  fmt::format("longer than {:g} s: the trial is cut there", l.pause_s)});
  rows.push_back(
      {"EMG that does not cover its motion", "error or warning",
       fmt::format(
           "both have less than {:g} % of the motion or {:g} s in common; a warning where more "
           "than 0.1 s is lacking, which is not fitted",
           percent(l.covered), l.shortest_trial_s)});
  rows.push_back(
      {"EMG and motion of unlike length", "error or warning",
       fmt::format(
           "2, 3, 4, 5 or 10 times as long or as short, within {:g} %: a wrong rate. An error "
           "where the EMG is the shorter one, or both end together within {:g} % once the "
           "rate is corrected; else a warning, as where both differ by one and the same "
           "factor in every trial by {:g} s or more, or the EMG of the only trial is {:g} "
           "times as long. Windows and clocks of the study's own are not looked at, nor "
           "maximal contractions",
           percent(l.same_factor), percent(l.ends_together), l.by_hand_s, l.alone_longer)});
}

void add_motion(std::vector<PlausibilityRow>& rows) {
  const PlausibilityLimits& l = kLimits;
  rows.push_back(
      {"external torque that no joint makes", "error",
       "more than 2.5 × 1.5 × what all muscles of the model make together at F_max (the strongest "
       "person that calibrations allow; lengthening) and body weight at the end of the limb, in "
       "one "
       "sample of a hundred: N mm?"});
  rows.push_back(
      {"angles outside the model's range",
       fmt::format("warning; error if more than {:g} % of the samples are, of a clamped coordinate",
                   percent(l.angle_share)),
       fmt::format("{:g} degrees beyond: muscle paths mean nothing there. Sign, zero or another "
                   "coordinate?",
                   l.angle_beyond_deg)});
  rows.push_back(
      {"an angle that jumps", "warning",
       "moves faster than 143 deg/s (a length: 0.5 m/s) and three times as fast as 95 % of the "
       "time, "
       "for less than 0.08 s above half of that peak: joints speed up and slow down over a tenth "
       "of "
       "a second, and the jump's acceleration makes a torque that nobody made. `id`, `so`, `paths` "
       "and `identify` look for it, too"});
  rows.push_back(
      {"a dynamometer that pushes with the active muscles",
       "error if in all trials, warning if in some",
       fmt::format(
           "what the muscles pull (F_max times moment arm times EMG relative to the "
           "channel's largest) against minus `external_torque`, where that is largest: "
           "cosine below {:g} over all, below {:g} in a trial. The sign is reversed: it is "
           "what the surroundings exert. Torques below {:g} % of what the muscles hold or {:g} "
           "times what the limb weighs, and passive trials, tell nothing",
           l.certainly_reversed, l.reversed, percent(l.dynamometer_share), l.dynamometer_weights)});
  rows.push_back(
      {"a held mass that nobody holds", "warning; error if it is more than the person weighs",
       fmt::format("its greatest moment is more than all muscles of the model can hold, or, in a "
                   "movement, than {:g} % of that: four lifts in a row take 90 % of what can be "
                   "lifted once, and the worst angle of a lift has some 80 % of the best",
                   percent(l.lift_share))});
  rows.push_back(
      {"the built-in arm's lengths", "error",
       "`upper_arm_length_m`, `forearm_length_m` outside the range that the [study "
       "file](study.md#model) allows: cm, mm? `at_m` of a held mass 2 m from its body or "
       "more"});
}

void add_markers_and_loads(std::vector<PlausibilityRow>& rows) {
  const PlausibilityLimits& l = kLimits;
  rows.push_back(
      {"left and right exchanged", "error",
       fmt::format(
           "the frame with most markers lies more than {0:g} mm rms from the model as "
           "labelled, and less than {1:g} % of that, and less than {0:g} mm, with the labels "
           "of both sides exchanged ({2} pairs at least: `R.Knee`, `RASI`, `knee_r`, "
           "`RightHeel`)",
           1000.0 * l.sides_m, percent(l.sides_better), l.sides_pairs)});
  rows.push_back(
      {"a center of pressure that is not under its foot", "error or warning",
       fmt::format(
           "of the points of ExternalLoads, the median distance while loaded from the "
           "nearest marker (or point of the model) of the body: an error where two forces "
           "are each more than {:g} m from their own body and less than {:g} % of that from "
           "the other's (feet exchanged), or one is more than {:g} m away (mm, other axes); "
           "a warning where one is so far off and nearer to another body",
           l.off_body_m, percent(l.much_nearer), l.elsewhere_m)});
  rows.push_back(
      {"a foreign foot on a plate", "warning",
       fmt::format(
           "contact by contact ({:g} ms and more above {:g} % of the largest force): the "
           "center of pressure is more than {:g} m from the body of the force and {:g} % as "
           "far from another body, or {:g} m from it while other contacts are under it. "
           "Told with the times, their share of the loaded time and the distances",
           1000.0 * l.contact_s, percent(l.contact_share), l.off_body_m, percent(l.much_nearer),
           l.far_from_foot_m)});
  rows.push_back(
      {"a second foot on a plate", "warning",
       fmt::format(
           "for {:g} ms or more the center of pressure is more than {:g} m from its body, "
           "while another foot without a force of its own stands still, as low, within {:g} "
           "m: one force cannot be shared out between two feet",
           1000.0 * l.contact_s, l.between_feet_m, l.second_foot_m)});
  rows.push_back(
      {"a foot beside the plates", "warning",
       fmt::format(
           "for {:g} s or more the forces on the ground, which elsewhere carry {:g} % of the "
           "weight, are below {:g} % of it, and the body does not fall (by {:g} g or more). `run` "
           "tells it by what the joint to the ground would have to bear (half of the weight), and "
           "does "
           "not fit those times",
           l.unloaded_s, percent(l.bears), percent(l.bears_nothing), l.falls)});
  rows.push_back(
      {"nothing carries the body", "warning",
       "a model of a whole person on a free joint, without any measured force, of which a "
       "leg's joint is studied"});
  rows.push_back(
      {"the vertical lies across the trunk", "warning",
       fmt::format(
           "markers of the body on the ground joint lie more than {:.0f} degrees from upright "
           "by `[markers] up`, and less than {:.0f} by another axis",
           degrees_of(l.trunk_across), degrees_of(l.trunk_upright))});
}

}  // namespace

std::vector<PlausibilityRow> plausibility_rows() {
  std::vector<PlausibilityRow> rows;
  add_recordings(rows);
  add_motion(rows);
  add_markers_and_loads(rows);
  return rows;
}

std::vector<PlausibilityRow> gate_rows() {
  const GateLimits& l = kGateLimits;
  return {
      {"frames without a pose", "warning; fails",
       fmt::format("any; more than {:g} %", percent(l.lost_frames))},
      {"markers' distance from the model", "warning; fails",
       fmt::format("{:g} mm rms in a frame; {:g} mm rms over all", 1000.0 * l.marker_error_m,
                   2000.0 * l.marker_error_m)},
      {"a joint that does not move", "fails",
       fmt::format("less than {:g} degrees in the trial that moves it most", l.least_range_deg)},
      {"muscles of the joint that are not in the study", "warning",
       fmt::format("more than {:g} % of the joint's strength", percent(l.missing_share))},
      {"muscles too weak for the torque", "warning",
       fmt::format("a reserve acts in {:g} % of the frames or more", l.reserve_percent)},
      {"a torque that is not explained", "warning; fails",
       fmt::format("R² below {:g}; below {:g}, or errors larger than the torque", l.explains,
                   l.unrelated)},
      {"a trial left out that stands out", "warning",
       fmt::format("its error is more than {:g} robust deviations from the others', and {:g} times "
                   "their median",
                   l.far_fold, l.larger_fold)},
      {"two electrodes that seem to be exchanged", "warning; fails",
       fmt::format(
           "the sentence of the gate says by how much; where R² as they are named is {:g} or "
           "less",
           l.explains)},
  };
}

std::string markdown(const std::vector<PlausibilityRow>& rows) {
  std::string text = "| what | level | limit, and why |\n| --- | --- | --- |\n";
  for (const PlausibilityRow& row : rows)
    text += fmt::format("| {} | {} | {} |\n", row.what, row.level, row.limit);
  return text;
}

}  // namespace myoid
