#include "myoid/study/trial_table.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

namespace myoid {

using recording::TomlTable;

namespace {

PlateSpec read_plates(TomlTable table,
                      const std::filesystem::path& folder,
                      const std::optional<std::filesystem::path>& markers) {
  PlateSpec plates;
  if (auto file = table.text("file")) {
    plates.file = folder / *file;
  } else if (markers) {
    plates.file = *markers;
  } else {
    table.fail("file", "expected the .c3d file that holds the force plates");
  }
  if (table.is_text("bodies")) {
    (void)table.choice("bodies", "auto", {"auto"});
  } else if (auto bodies = table.texts("bodies")) {
    plates.bodies = *bodies;
    if (std::all_of(bodies->begin(), bodies->end(), [](const auto& b) { return b.empty(); }))
      table.fail("bodies",
                 "no body is named; name one for each plate (\"\" for none), or \"auto\"");
  }
  plates.least_force_n = table.positive_number("least_force_n", plates.least_force_n);
  if (table.has("lowpass_hz")) plates.lowpass_hz = table.positive_number("lowpass_hz", 0.0);
  table.finish();
  return plates;
}

}  // namespace

SyncSpec read_sync(TomlTable table, const std::filesystem::path& folder) {
  SyncSpec sync;
  if (table.is_text("offset_s")) {
    (void)table.choice("offset_s", "estimate", {"estimate"});
    sync.estimate = true;
  } else {
    sync.offset_s = table.number("offset_s");
  }
  if (table.has("offset_sd_s")) sync.offset_sd_s = table.positive_number("offset_sd_s", 0.0);
  sync.drift_ppm = table.number_within("drift_ppm", 0.0, -1e5, 1e5, "ppm");
  sync.emg_trigger = table.text("emg_trigger").value_or("");
  sync.motion_trigger = table.text("motion_trigger").value_or("");
  if (auto file = table.text("trigger_file")) sync.trigger_file = folder / *file;
  sync.match = table.choice("match", sync.match);
  sync.search_s = table.number_within("search_s", sync.search_s, 0.05, 30.0, "s");
  sync.loads_offset_s = table.number("loads_offset_s").value_or(0.0);
  sync.loads_drift_ppm = table.number_within("loads_drift_ppm", 0.0, -1e5, 1e5, "ppm");
  const bool triggered = !sync.emg_trigger.empty() || !sync.motion_trigger.empty();
  if (triggered && (sync.emg_trigger.empty() || sync.motion_trigger.empty())) {
    table.fail(sync.emg_trigger.empty() ? "motion_trigger" : "emg_trigger",
               "give both emg_trigger and motion_trigger: what each recording saw of the same "
               "instants");
  }
  if (triggered && (sync.offset_s || sync.estimate || sync.drift_ppm != 0.0)) {
    table.fail(sync.drift_ppm != 0.0 ? "drift_ppm" : "offset_s",
               "the triggers tell offset and drift; give one or the other");
  }
  if (sync.match == SyncMatch::shape && sync.motion_trigger == "start")
    table.fail("match",
               "the start of a recording has no shape; expected \"rising\" or \"falling\"");
  table.finish();
  return sync;
}

TrialSpec read_trial(TomlTable table, const std::filesystem::path& folder) {
  TrialSpec trial;
  trial.name = table.require_text("name", "a name that is unique in the study");
  if (trial.name.empty() || trial.name.find_first_of("/\\") != std::string::npos ||
      trial.name.starts_with(".") || trial.name == "figures" || trial.name == "tables") {
    table.fail(
        "name",
        fmt::format("found \"{}\"; a trial's name becomes a folder: use letters, digits, _ and -",
                    trial.name));
  }
  const auto path = [&](std::string_view key) -> std::optional<std::filesystem::path> {
    const auto text = table.text(key);
    if (!text) return std::nullopt;
    if (text->empty()) table.fail(key, "the path is empty");
    return folder / *text;
  };
  trial.markers = path("markers");
  trial.motion = path("motion");
  trial.emg = path("emg");
  trial.external_torque = path("external_torque");
  trial.external_loads = path("external_loads");
  trial.load_cell = path("load_cell");
  if (trial.external_loads && trial.load_cell)
    table.fail("load_cell", "give either 'external_loads' or 'load_cell', not both");
  if (auto plates = table.table("force_plates"))
    trial.plates = read_plates(*plates, folder, trial.markers);
  if (trial.markers && trial.motion) {
    table.fail(
        "motion",
        "give either 'markers' or 'motion', not both: the motion is computed from the markers");
  }
  trial.use = table.choice("use", trial.use);
  if (trial.use != Use::mvc && !trial.markers && !trial.motion) {
    table.fail("name",
               fmt::format("trial '{}' has neither 'markers' (.trc) nor 'motion' (.mot); add one",
                           trial.name));
  }
  const bool needs_emg = trial.use == Use::calibration || trial.use == Use::validation ||
                         trial.use == Use::isometric || trial.use == Use::mvc;
  if (needs_emg && !trial.emg) {
    table.fail("name",
               fmt::format("trial '{}' has no 'emg'; a {} trial needs one, or set use = \"static\"",
                           trial.name, choice_name(trial.use)));
  }
  trial.held_mass_kg = table.number("held_mass_kg").value_or(0.0);
  if (trial.held_mass_kg < 0.0 || trial.held_mass_kg > 100.0) {
    table.fail("held_mass_kg",
               fmt::format("found {} kg, expected 0 to 100 kg", trial.held_mass_kg));
  }
  trial.condition = table.text("condition").value_or("");
  trial.start_s = table.number("start_s");
  trial.end_s = table.number("end_s");
  if (trial.start_s && trial.end_s && !(*trial.start_s < *trial.end_s)) {
    table.fail("end_s", fmt::format("found {} s, expected a time after start_s = {} s",
                                    *trial.end_s, *trial.start_s));
  }
  if (auto sync = table.table("sync")) {
    const auto& motion_file = trial.markers ? trial.markers : trial.motion;
    if (!trial.emg || !motion_file)
      table.fail("sync", "it joins the clocks of an 'emg' file and of 'markers' or 'motion'");
    if (trial.emg == motion_file && !sync->has("loads_offset_s") && !sync->has("loads_drift_ppm"))
      table.fail("sync", "EMG and motion are in one file, and so on one clock");
    trial.sync = read_sync(*sync, folder);
  }
  table.finish();
  return trial;
}

}  // namespace myoid
