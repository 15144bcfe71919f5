#include "myoid/study/trial_table.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "myoid/ground/files/file_format.h"
#include "myoid/study/study_ids.h"

namespace myoid::study {

void visit(SyncSpec& sync, SettingVisitor& v) {
  constexpr SettingLimits kDrift = within(-1e5, 1e5, "ppm");
  v.number(
      "offset_s", sync.offset_s, sync.estimate,
      {.says = "Seconds to add to the EMG's times. `estimate`: [found from the motion](#sync), as far as that goes.",
       .limits = any_number("s"),
       .word = "estimate"});
  v.number("offset_sd_s", sync.offset_sd_s,
           {.says = "Its standard deviation, if you know it.", .limits = above_zero("s"), .otherwise = "not stated"});
  v.number("drift_ppm", sync.drift_ppm,
           {.says = "How much too slowly the EMG's clock counts, in microseconds per second from its time 0 on (50: a "
                    "minute of it lasts 60.003 s).",
            .limits = kDrift});
  v.text("emg_trigger", sync.emg_trigger,
         {.says = "Record of the same instants, or of the same signal, in the EMG's recording: a channel, or the label "
                  "of events (C3D, EDF+)."});
  v.text("motion_trigger", sync.motion_trigger,
         {.says = "The same of the motion's recording: a channel, `NAME.x`, `.y`, `.z` of a marker, the label of "
                  "events, or `start`, its first frame."});
  v.path("trigger_file", sync.trigger_file,
         {.says = "File that holds `motion_trigger`, on the motion's clock.", .otherwise = "the motion's"});
  v.choice("match", sync.match,
           {.says = "Of channels: their `rising` or `falling` edges, or the `shape` of the whole signal."});
  v.number("search_s", sync.search_s,
           {.says = "How far `estimate` and `shape` look, either way.", .limits = within(0.05, 30.0, "s")});
  v.number("loads_offset_s", sync.loads_offset_s,
           {.says = "Seconds to add to the times of the trial's loads, if they are in another file.",
            .limits = any_number("s")});
  v.number("loads_drift_ppm", sync.loads_drift_ppm,
           {.says = "How much too slowly the clock of that file counts.", .limits = kDrift});
  const bool emg = !sync.emg_trigger.empty(), motion = !sync.motion_trigger.empty();
  v.must(emg == motion, emg ? "motion_trigger" : "emg_trigger",
         "give both emg_trigger and motion_trigger: the record of the same instants in each file");
  const bool by_number = sync.offset_s || sync.estimate || sync.drift_ppm != 0.0;
  v.must(!(emg && motion && by_number), sync.drift_ppm != 0.0 ? "drift_ppm" : "offset_s",
         "the triggers tell offset and drift; give one or the other");
  v.must(!(sync.match == SyncMatch::shape && sync.motion_trigger == "start"), "match",
         "the start of a recording has no shape; expected \"rising\" or \"falling\"");
}

void visit(PlateSpec& plates, SettingVisitor& v) {
  v.path("file", plates.file, {.says = "The `.c3d` with the force plates.", .otherwise = "that of the markers"});
  const bool given = v.texts("bodies", plates.bodies,
                             {.says = "The body that stands on plate 1, 2, … (`\"\"`: none). `auto`: of each contact "
                                      "the body whose marker is nearest, which a note names.",
                              .word = "auto"});
  const auto empty = [](const std::string& body) { return body.empty(); };
  v.must(!given || plates.bodies.empty() || !std::ranges::all_of(plates.bodies, empty), "bodies",
         "no body is named; name one for each plate (\"\" for none), or \"auto\"");
  v.number("least_force_n", plates.least_force_n,
           {.says = "Below this force a plate bears nothing.", .limits = above_zero("N")});
  v.number("lowpass_hz", plates.lowpass_hz,
           {.says = "Smoothing, −3 dB of both passes together.",
            .limits = above_zero("Hz"),
            .otherwise = "as the motion is smoothed"});
}

namespace {

void visit_name(TrialSpec& trial, SettingVisitor& v) {
  v.text("name", trial.name,
         {.says = "Unique, any text. The trial's [folder of results](run.md#what-comes-out) has an id made from it.",
          .required = "a name that is unique in the study"});
  must_be_name(v, "name", trial.name);
}

/// Visits the recordings of a trial.
void visit_files(TrialSpec& trial, SettingVisitor& v) {
  static const std::string kEmgFiles = emg_endings_text() + ". A C3D file may be that of the markers.";
  v.path("markers", trial.markers,
         {.says = "`.trc`, `.c3d`, a [table of another program](file-formats.md) or BIDS `_motion.tsv`.",
          .otherwise = "this or `motion`, but for `mvc`"});
  v.path("motion", trial.motion,
         {.says = "Joint angles, to start later than at markers; in a table `elbow_flexion [deg]`."});
  v.must(!trial.markers || !trial.motion, "motion",
         "give either 'markers' or 'motion', not both: the motion is computed from the markers");
  v.path("emg", trial.emg, {.says = kEmgFiles, .otherwise = "required, but for `static` and `passive`"});
  v.path("external_torque", trial.external_torque,
         {.says = "File (`.sto`, `.mot`, a table) with `<coordinate>_moment` [N m]: the [torque of the "
                  "surroundings](#measured-torques) on the body, as of a dynamometer."});
  v.path("external_loads", trial.external_loads,
         {.says = "Measured forces on bodies: OpenSim's ExternalLoads file (`.xml`), as [`convert`](convert.md) writes "
                  "it for force plates."});
  v.path("load_cell", trial.load_cell,
         {.says = "Recording with the channels of the load cell that [load_cell] describes (may be the `.c3d` of the "
                  "markers)."});
  v.must(!trial.external_loads || !trial.load_cell, "load_cell",
         "give either 'external_loads' or 'load_cell', not both");
  v.path("fascicles", trial.fascicles,
         {.says = "Measured lengths of [fascicles](#fascicles), in columns named as the muscles: `TA [mm]`."});
  v.table("force_plates", trial.plates, {.says = "Force plates under the person."});
  if (trial.plates && trial.plates->file.empty()) {
    v.must(trial.markers.has_value(), "force_plates",
           "'file' is missing; expected the .c3d file that holds the force plates");
    if (trial.markers) trial.plates->file = *trial.markers;
  }
}

/// Visits the files of stages that another program computed.
void visit_given(TrialSpec& trial, SettingVisitor& v) {
  GivenSpec& given = trial.given;
  v.path(
      "lengths", given.lengths,
      {.says = "[Given](#given-stages): lengths of the muscles with their tendons [m], in columns named by `osim`."});
  v.path("velocities", given.velocities,
         {.says = "Given rates of these lengths [m/s], lengthening positive.", .otherwise = "by a spline"});
  v.paths("moment_arms", given.moment_arms,
          {.says = "Given moment arms −dl/dq [m]: a file for each coordinate of [model], in its order."});
  v.path("torques", given.torques,
         {.says = "Given torques of the muscles [N m], in columns `<coordinate>` or `<coordinate>_moment`."});
  v.path("forces", given.forces, {.says = "Given muscle forces [N], for methods `force` and `paper`."});
  v.must(!given.velocities || given.lengths, "velocities", "they are the rates of 'lengths', which are not given");
}

/// Visits the held mass; torques of the muscles exclude what they would be computed from.
void visit_held_mass(TrialSpec& trial, SettingVisitor& v) {
  v.number("held_mass_kg", trial.held_mass_kg,
           {.says = "Mass in the hand; 0: the person held nothing. Without it and without measured forces [a "
                    "gate](check.md#quality-gates-of-run) stays at caution.",
            .limits = within(0.0, 100.0, "kg"),
            .otherwise = "not stated; nothing is computed to be held"});
  const bool loads = trial.external_torque || trial.external_loads || trial.load_cell || trial.plates ||
                     trial.held_mass_kg.value_or(0.0) > 0.0;
  v.must(!trial.given.torques || !loads, "torques",
         "they are the muscles' own: leave out external_torque, external_loads, load_cell, force_plates and "
         "held_mass_kg, from which they would be computed");
}

void visit_use(TrialSpec& trial, SettingVisitor& v) {
  v.choice("use", trial.use,
           {.says = "`calibration` and `isometric` are fitted; `validation` is only predicted; `mvc` sets activation "
                    "1, and is [fitted too](#measured-torques) where its torque is measured; [`passive` and "
                    "`static`](#trials-that-are-not-fitted) are not fitted."});
  const bool passive = trial.use == Use::passive;
  v.must(trial.use == Use::mvc || trial.markers || trial.motion || (trial.given.needs_no_body() && !passive), "name",
         fmt::format("trial '{}' has neither 'markers' (.trc) nor 'motion' (.mot); add one{}", trial.name,
                     passive ? "" : ", or give lengths with moment_arms and torques, or with forces"));
  v.must(trial.use == Use::static_pose || trial.use == Use::passive || trial.emg, "name",
         fmt::format("trial '{}' has no 'emg'; a {} trial needs one, or set use = \"static\"", trial.name,
                     choice_name(trial.use)));
}

void visit_clock(TrialSpec& trial, SettingVisitor& v) {
  v.table("sync", trial.sync,
          {.says = "How the EMG's clock stands to that of the motion, where [sync] does not hold: `sync = { offset_s = "
                   "0.012 }`.",
           .otherwise = "[sync]"});
  if (!trial.sync) return;
  const auto& motion_file = trial.markers ? trial.markers : trial.motion;
  v.must(trial.emg && motion_file, "sync", "it joins the clocks of an 'emg' file and of 'markers' or 'motion'");
  v.must(trial.emg != motion_file || trial.sync->loads_offset_s != 0.0 || trial.sync->loads_drift_ppm != 0.0, "sync",
         "EMG and motion are in one file, and so on one clock");
}

}  // namespace

void visit(TrialSpec& trial, SettingVisitor& v) {
  visit_name(trial, v);
  visit_files(trial, v);
  visit_given(trial, v);
  visit_use(trial, v);
  visit_held_mass(trial, v);
  v.stretches("exclude", trial.exclude.windows, trial.exclude.foreign_contacts,
              {.says = "Times, in seconds of the motion, that are [predicted only](#trials-that-are-not-fitted): "
                       "`[[0.66, 0.78], [2.1, 2.4]]`. `foreign_contacts`: also those of another foot on a plate.",
               .otherwise = "none",
               .word = "foreign_contacts"});
  v.text(
      "condition", trial.condition,
      {.says = "Trials of one name are left out together by `folds = \"condition\"`.", .otherwise = "the trial alone"});
  v.number("start_s", trial.start_s,
           {.says = "Begin of the part that is used, in seconds of the motion.",
            .limits = any_number("s"),
            .otherwise = "all"});
  v.number("end_s", trial.end_s,
           {.says = "End of that part. A trial with a pause of more than 0.5 s is [cut there](check.md#what-is-mended) "
                    "by itself.",
            .limits = any_number("s"),
            .otherwise = "all"});
  v.must(!trial.start_s || !trial.end_s || *trial.start_s < *trial.end_s, "end_s",
         fmt::format("found {} s, expected a time after start_s = {} s", trial.end_s.value_or(0.0),
                     trial.start_s.value_or(0.0)));
  v.path("video", trial.video,
         {.says = "Film of the trial, which the [report](report.md#the-workbench) shows beside the model: a format "
                  "that browsers play (`.mp4`, `.webm`). No number depends on it."});
  v.number("video_offset_s", trial.video_offset_s,
           {.says = "When the film begins, in seconds of the motion.", .limits = any_number("s")});
  visit_clock(trial, v);
}

}  // namespace myoid::study
