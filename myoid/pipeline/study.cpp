#include "myoid/pipeline/study.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"
#include "myoid/core/units.h"
#include "myoid/identification/parameters.h"
#include "myoid/muscle/hill_parameters.h"
#include "myoid/recording/text_file.h"
#include "myoid/recording/toml_table.h"

namespace myoid::pipeline {
namespace {

using recording::TomlTable;

double within(TomlTable& table,
              std::string_view key,
              double otherwise,
              double lower,
              double upper,
              std::string_view unit) {
  const double value = table.number(key).value_or(otherwise);
  if (!(value >= lower && value <= upper)) {
    table.fail(key,
               fmt::format("found {} {}, expected {} to {} {}", value, unit, lower, upper, unit));
  }
  return value;
}

double positive(TomlTable& table, std::string_view key, double otherwise) {
  const double value = table.number(key).value_or(otherwise);
  if (!(value > 0.0)) table.fail(key, fmt::format("found {}, expected a positive number", value));
  return value;
}

SubjectSpec read_subject(TomlTable table) {
  SubjectSpec subject;
  subject.name = table.text("name").value_or(subject.name);
  if (table.has("mass_kg")) {
    subject.mass_kg = positive(table, "mass_kg", 0.0);
    if (*subject.mass_kg < 10.0 || *subject.mass_kg > 350.0) {
      table.fail("mass_kg", fmt::format("found {} kg, expected a person's mass in kilograms",
                                        *subject.mass_kg));
    }
  }
  subject.sex = table.choice("sex", "", {"", "male", "female"});
  if (auto notes = table.texts("notes")) subject.notes = *notes;
  table.finish();
  return subject;
}

ModelSpec read_model(TomlTable table, const std::filesystem::path& folder) {
  ModelSpec model;
  if (auto file = table.text("file")) model.file = folder / *file;
  model.builtin = table.choice("builtin", model.file ? "" : "arm4", {"", "arm4"});
  if (model.file && !model.builtin.empty()) {
    table.fail("builtin", "give either 'file' or 'builtin', not both");
  }
  if (table.has("upper_arm_length_m"))
    model.upper_arm_length_m = positive(table, "upper_arm_length_m", 0.0);
  if (table.has("forearm_length_m"))
    model.forearm_length_m = positive(table, "forearm_length_m", 0.0);
  model.horizontal = table.choice("plane", "vertical", {"vertical", "horizontal"}) == "horizontal";
  model.forearm_rotations = table.flag("forearm_rotations").value_or(false);
  if (const auto names = table.texts("coordinate")) {
    for (std::size_t i = 0; i < names->size(); ++i) {
      if (std::find(names->begin(), names->begin() + static_cast<std::ptrdiff_t>(i), (*names)[i]) !=
          names->begin() + static_cast<std::ptrdiff_t>(i))
        table.fail("coordinate", fmt::format("'{}' is named twice", (*names)[i]));
    }
    if (names->empty()) table.fail("coordinate", "expected the name of a joint coordinate");
    model.coordinate = names->front();
    model.more_coordinates.assign(names->begin() + 1, names->end());
  }
  if (auto held = table.table("held_mass")) {
    HeldMassSpec spec;
    spec.body = held->require_text("body", "the body that carries the held mass");
    const auto at = held->numbers("at_m");
    if (!at || at->size() != 3)
      held->fail("at_m", "expected the point's three coordinates in the body [m]");
    spec.p_BP_m = Vec3((*at)[0], (*at)[1], (*at)[2]);
    held->finish();
    model.held_mass = spec;
  }
  table.finish();
  return model;
}

MotionSpec read_motion(TomlTable table) {
  MotionSpec motion;
  if (table.has("cutoff_hz")) {
    motion.smoothing = Smoothing::cutoff;
    motion.cutoff_hz = within(table, "cutoff_hz", 6.0, 0.1, 500.0, "Hz");
    (void)table.choice("smoothing", "cutoff", {"cutoff"});
  } else {
    const std::string word = table.choice("smoothing", "auto", {"auto", "none", "cutoff"});
    motion.smoothing = word == "auto"   ? Smoothing::automatic
                       : word == "none" ? Smoothing::none
                                        : Smoothing::cutoff;
  }
  motion.rate_hz = within(table, "rate_hz", motion.rate_hz, 10.0, 2000.0, "Hz");
  table.finish();
  return motion;
}

MarkerSpec read_markers(TomlTable table) {
  MarkerSpec markers;
  markers.up = table.choice("up", "y", {"x", "y", "z"})[0];
  if (auto rename = table.table("rename")) {
    for (const std::string& key : rename->keys()) markers.rename[key] = *rename->text(key);
  }
  if (auto weight = table.table("weight")) {
    for (const std::string& key : weight->keys()) {
      const double value = *weight->number(key);
      if (value < 0.0)
        weight->fail(key, fmt::format("found {}, expected a weight of 0 or more", value));
      markers.weight[key] = value;
    }
  }
  markers.undo_swaps = table.flag("undo_swaps").value_or(markers.undo_swaps);
  markers.fill_gaps = table.flag("fill_gaps").value_or(markers.fill_gaps);
  table.finish();
  return markers;
}

IkSpec read_ik(TomlTable table) {
  IkSpec ik;
  ik.unlock = table.texts("unlock").value_or(ik.unlock);
  ik.lock = table.texts("lock").value_or(ik.lock);
  if (auto calibrate = table.table("calibrate")) {
    CalibrationSpec spec;
    spec.window_s = calibrate->numbers("window_s").value_or(std::vector<double>{});
    if (spec.window_s.size() != 2 || !(spec.window_s[0] < spec.window_s[1])) {
      calibrate->fail("window_s", "expected [start, end] in seconds, start before end");
    }
    spec.free = calibrate->texts("free").value_or(spec.free);
    spec.hold = calibrate->texts("hold").value_or(spec.free);
    if (spec.free.empty())
      calibrate->fail("free", "expected the coordinates to find in the window");
    calibrate->finish();
    ik.calibrate = spec;
  }
  table.finish();
  return ik;
}

EmgSpec read_emg(TomlTable table) {
  EmgSpec emg;
  const std::string kind = table.choice("kind", "raw", {"raw", "envelope", "activation"});
  emg.kind = kind == "raw"        ? EmgKind::raw
             : kind == "envelope" ? EmgKind::envelope
                                  : EmgKind::activation;
  emg.unit = table.text("unit").value_or("");
  emg.rectify = table.flag("rectify").value_or(emg.rectify);
  emg.notch = table.choice("notch", "auto", {"auto", "none"}) == "auto";
  emg.whitening = table.flag("whitening").value_or(emg.whitening);
  emg.highpass_hz = positive(table, "highpass_hz", emg.highpass_hz);
  emg.lowpass_hz = positive(table, "lowpass_hz", emg.lowpass_hz);
  emg.as_published = table.flag("as_published").value_or(emg.as_published);
  (void)table.choice("normalise", "max", {"max"});
  emg.normalise_window_s =
      within(table, "normalise_window_s", emg.normalise_window_s, 0.01, 60.0, "s");
  emg.mvc_effort = within(table, "mvc_effort", emg.mvc_effort, 0.3, 1.0, "");
  emg.mvc_effort_sd = within(table, "mvc_effort_sd", emg.mvc_effort_sd, 0.0, 0.3, "");
  if (table.is_text("delay_s")) {
    (void)table.choice("delay_s", "estimate", {"estimate"});
  } else if (auto delay = table.number("delay_s")) {
    if (*delay < 0.0 || *delay > 0.3) {
      table.fail("delay_s", fmt::format("found {} s, expected 0 to 0.3 s or \"estimate\"", *delay));
    }
    emg.delay_s = delay;
  }
  table.finish();
  return emg;
}

/// The muscle parameter of this name, or an error at the key's line that lists them.
const muscle::HillField& parameter(const TomlTable& table,
                                   std::string_view key,
                                   const std::string& name) {
  std::vector<std::string> names;
  for (const muscle::HillField& field : muscle::kHillFields) {
    if (field.name == name) return field;
    names.emplace_back(field.name);
  }
  const auto near = recording::nearest_word(name, names);
  table.fail(key, fmt::format("no muscle parameter is named '{}'{}; there are {}", name,
                              near ? fmt::format(" (did you mean '{}'?)", *near) : "",
                              fmt::join(names, ", ")));
}

MuscleSpec read_muscle(TomlTable table) {
  MuscleSpec muscle;
  muscle.name = table.require_text("name", "a short name for the results, name = \"BIC\"");
  muscle.osim = table.texts("osim").value_or(std::vector<std::string>{muscle.name});
  if (muscle.osim.empty()) table.fail("osim", "expected at least one muscle of the model");
  if (table.is_table("emg")) {
    TomlTable tie = *table.table("emg");
    muscle.same_as = tie.require_text("same_as", "the muscle whose electrode serves this one too");
    tie.finish();
  } else {
    muscle.emg = table.require_text(
        "emg", "the EMG channel, or { same_as = \"MUSCLE\" } where there is no electrode");
  }
  if (auto start = table.table("start")) {
    for (const std::string& key : start->keys()) {
      const muscle::HillField& field = parameter(*start, key, key);
      muscle.start[key] =
          within(*start, key, 0.0, field.bounds.lower, field.bounds.upper, symbol(field.unit));
    }
  }
  muscle.fixed = table.texts("fixed").value_or(muscle.fixed);
  for (const std::string& name : muscle.fixed) (void)parameter(table, "fixed", name);
  table.finish();
  return muscle;
}

Use parse_use(const std::string& word) {
  if (word == "calibration") return Use::calibration;
  if (word == "validation") return Use::validation;
  if (word == "mvc") return Use::mvc;
  if (word == "static") return Use::static_pose;
  if (word == "passive") return Use::passive;
  return Use::isometric;
}

SyncSpec read_sync(TomlTable table, const std::filesystem::path& folder) {
  SyncSpec sync;
  if (table.is_text("offset_s")) {
    (void)table.choice("offset_s", "estimate", {"estimate"});
    sync.estimate = true;
  } else {
    sync.offset_s = table.number("offset_s");
  }
  if (table.has("offset_sd_s")) sync.offset_sd_s = positive(table, "offset_sd_s", 0.0);
  sync.drift_ppm = within(table, "drift_ppm", 0.0, -1e5, 1e5, "ppm");
  sync.emg_trigger = table.text("emg_trigger").value_or("");
  sync.motion_trigger = table.text("motion_trigger").value_or("");
  if (auto file = table.text("trigger_file")) sync.trigger_file = folder / *file;
  sync.match = table.choice("match", "rising", {"rising", "falling", "shape"});
  sync.search_s = within(table, "search_s", sync.search_s, 0.05, 30.0, "s");
  sync.loads_offset_s = table.number("loads_offset_s").value_or(0.0);
  sync.loads_drift_ppm = within(table, "loads_drift_ppm", 0.0, -1e5, 1e5, "ppm");
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
  if (sync.match == "shape" && sync.motion_trigger == "start")
    table.fail("match",
               "the start of a recording has no shape; expected \"rising\" or \"falling\"");
  table.finish();
  return sync;
}

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
  plates.least_force_n = positive(table, "least_force_n", plates.least_force_n);
  if (table.has("lowpass_hz")) plates.lowpass_hz = positive(table, "lowpass_hz", 0.0);
  table.finish();
  return plates;
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
  trial.use = parse_use(
      table.choice("use", "calibration",
                   {"calibration", "validation", "mvc", "static", "passive", "isometric"}));
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
                           trial.name, name(trial.use)));
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

LoadCellSpec read_load_cell(TomlTable table, const std::filesystem::path& folder) {
  LoadCellSpec cell;
  cell.channels = table.texts("channels").value_or(cell.channels);
  if (cell.channels.size() != 6) {
    table.fail("channels",
               fmt::format("found {} names, expected six: those of the matrix's columns",
                           cell.channels.size()));
  }
  cell.calibration =
      folder / table.require_text("calibration", "the file of the 6 x 6 matrix [N/V] and [N m/V]");
  cell.sign = table.number("sign").value_or(cell.sign);
  if (cell.sign != 1.0 && cell.sign != -1.0) table.fail("sign", "expected 1 or -1");
  cell.zero_s = table.numbers("zero_s").value_or(cell.zero_s);
  if (cell.zero_s.size() != 2 || !(cell.zero_s[0] < cell.zero_s[1]))
    table.fail("zero_s", "expected [start, end] in seconds, start before end");
  if (auto file = table.text("instrument")) cell.instrument = folder / *file;
  cell.frame = table.require_text("frame", "the body of the instrument that is the cell");
  cell.body = table.require_text("body", "the body of the person that feels the load");
  if (table.has("lowpass_hz")) cell.lowpass_hz = positive(table, "lowpass_hz", 0.0);
  table.finish();
  return cell;
}

SharingSpec read_sharing(TomlTable table) {
  SharingSpec sharing;
  sharing.objective = table.choice("objective", "activation", {"activation", "force", "stress"});
  sharing.exponent = table.number("exponent").value_or(sharing.exponent);
  if (!(sharing.exponent > 1.0))
    table.fail("exponent", "expected a number above 1 (2 or 3 is usual)");
  sharing.reserve_nm = positive(table, "reserve_nm", sharing.reserve_nm);
  table.finish();
  return sharing;
}

PhasesSpec read_phases(TomlTable table) {
  PhasesSpec phases;
  phases.search = table.flag("search").value_or(phases.search);
  if (auto exclude = table.texts("exclude")) phases.exclude = *exclude;
  for (const std::string& word : phases.exclude) {
    if (word != "warm_up" && word != "fatigued" && word != "changed" && word != "isometric" &&
        word != "rest") {
      table.fail("exclude",
                 fmt::format("found \"{}\", expected \"warm_up\", \"fatigued\", \"changed\", "
                             "\"isometric\" or \"rest\"",
                             word));
    }
  }
  table.finish();
  return phases;
}

IdentifySpec read_identify(TomlTable table) {
  IdentifySpec identify;
  if (auto methods = table.texts("method")) identify.methods = *methods;
  for (const std::string& method : identify.methods) {
    if (method != "paper" && method != "force" && method != "torque") {
      table.fail("method",
                 fmt::format("found \"{}\", expected \"paper\", \"force\" or \"torque\"", method));
    }
  }
  if (auto muscles = table.texts("muscles");
      muscles && *muscles != std::vector<std::string>{"all"}) {
    identify.muscles = *muscles;
  }
  identify.force_loop = table.flag("force_loop").value_or(identify.force_loop);
  identify.priors = table.flag("priors").value_or(identify.priors);
  identify.gain = table.flag("gain").value_or(identify.gain);
  identify.cross_validate = table.flag("cross_validate").value_or(identify.cross_validate);
  identify.next_movements =
      static_cast<int>(within(table, "next_movements", identify.next_movements, 0.0, 50.0, ""));
  identify.folds = table.choice("folds", "trial", {"trial", "condition", "block"});
  const double replicates = table.number("bootstrap").value_or(identify.bootstrap);
  if (!(replicates >= 0.0 && replicates <= 100000.0))
    table.fail("bootstrap", fmt::format("found {}, expected 0 to 100000 replicates", replicates));
  identify.bootstrap = static_cast<int>(replicates);
  identify.profile = table.flag("profile").value_or(identify.profile);
  identify.loss = table.choice("loss", "square", {"square", "huber", "cauchy"});
  identify.eccentric =
      table.choice("eccentric", "automatic", {"automatic", "product", "slope_ratio", "smooth"});
  identify.normalised = table.flag("normalised").value_or(identify.normalised);
  identify.dynamics = table.flag("dynamics").value_or(identify.dynamics);
  identify.model_muscles = table.choice("muscle_law", "paper", {"paper", "model"}) == "model";
  identify.elastic_tendon = table.choice("tendon", "rigid", {"rigid", "elastic"}) == "elastic";
  identify.delay_per_channel = table.flag("delay_per_channel").value_or(identify.delay_per_channel);
  const auto not_negative = [&](std::string_view key) {
    const double value = table.number(key).value_or(0.0);
    if (value < 0.0) table.fail(key, fmt::format("found {}, expected 0 or more", value));
    return value;
  };
  identify.angle_sd_rad = not_negative("angle_sd_deg") * kDegree;
  identify.angle_rate_sd_radps = not_negative("angle_rate_sd_degps") * kDegree;
  identify.max_rate_hz = within(table, "max_rate_hz", identify.max_rate_hz, 5.0, 2000.0, "Hz");
  table.finish();
  return identify;
}

identification::ParameterRule read_rule(TomlTable table) {
  identification::ParameterRule rule;
  rule.parameter = table.require_text("name", "a parameter, such as \"tendon_slack_length\"");
  try {
    (void)identification::parameter_field(rule.parameter);
  } catch (const InvalidInput& error) {
    table.fail("name", error.what());
  }
  rule.owners = table.texts("of").value_or(rule.owners);
  rule.free = table.flag("free");
  rule.value = table.number("value");
  rule.lower = table.number("lower");
  rule.upper = table.number("upper");
  rule.prior_mean = table.number("prior_mean");
  rule.prior_sd = table.number("prior_sd");
  if (rule.prior_sd && !(*rule.prior_sd > 0.0))
    table.fail("prior_sd", fmt::format("found {}, expected a positive number", *rule.prior_sd));
  if (rule.lower && rule.upper && !(*rule.lower < *rule.upper))
    table.fail("lower", fmt::format("found {}, not below upper = {}", *rule.lower, *rule.upper));
  rule.tie = table.flag("tie").value_or(false);
  table.finish();
  return rule;
}

void check_references(const Study& study) {
  const auto refuse = [&](const std::string& message) { throw ReadError(study.file, 0, message); };
  if (study.muscles.empty()) {
    refuse("no [[muscle]]; add one table per muscle to identify, with name, osim and emg");
  }
  if (study.trials.empty())
    refuse("no [[trial]]; add one table per recording, with name, markers or motion, and emg");
  std::set<std::string> muscles;
  for (const MuscleSpec& muscle : study.muscles) {
    if (!muscles.insert(muscle.name).second)
      refuse(fmt::format("two [[muscle]] are named '{}'", muscle.name));
  }
  for (const MuscleSpec& muscle : study.muscles) {
    if (!muscle.same_as) continue;
    const auto other = std::find_if(study.muscles.begin(), study.muscles.end(),
                                    [&](const MuscleSpec& m) { return m.name == *muscle.same_as; });
    if (other == study.muscles.end() || other->same_as) {
      refuse(fmt::format(
          "[[muscle]] {}: emg same_as \"{}\" names no muscle with an electrode; there are {}",
          muscle.name, *muscle.same_as, fmt::join(muscles, ", ")));
    }
  }
  for (const std::string& wanted : study.identify.muscles) {
    if (!muscles.contains(wanted)) {
      refuse(fmt::format("[identify] muscles: '{}' is no [[muscle]]; there are {}", wanted,
                         fmt::join(muscles, ", ")));
    }
  }
  for (const identification::ParameterRule& rule : study.parameters) {
    if (identification::parameter_field(rule.parameter).scope != identification::Scope::muscle)
      continue;
    for (const std::string& owner : rule.owners) {
      if (!muscles.contains(owner)) {
        refuse(fmt::format("[[parameter]] {}: '{}' is no [[muscle]]; there are {}", rule.parameter,
                           owner, fmt::join(muscles, ", ")));
      }
    }
  }
  const bool any_to_learn_from = std::any_of(
      study.trials.begin(), study.trials.end(),
      [](const TrialSpec& t) { return t.use == Use::calibration || t.use == Use::isometric; });
  if (!any_to_learn_from && !study.identify.methods.empty()) {
    refuse(
        "no [[trial]] has use = \"calibration\" or \"isometric\", from which parameters are "
        "found; the others only test or scale them");
  }
  std::set<std::string> trials;
  for (const TrialSpec& trial : study.trials) {
    if (!trials.insert(trial.name).second)
      refuse(fmt::format("two [[trial]] are named '{}'", trial.name));
    if (trial.load_cell && !study.load_cell) {
      refuse(fmt::format("trial '{}' has a load_cell; a table [load_cell] must say what it is",
                         trial.name));
    }
  }
}

}  // namespace

std::string_view name(Use use) {
  switch (use) {
    case Use::calibration:
      return "calibration";
    case Use::validation:
      return "validation";
    case Use::mvc:
      return "mvc";
    case Use::static_pose:
      return "static";
    case Use::passive:
      return "passive";
    case Use::isometric:
      return "isometric";
  }
  return "?";
}

Study parse_study(std::string_view text, const std::filesystem::path& file) {
  const toml::table root = recording::parse_toml(text, file);
  const std::filesystem::path folder = file.parent_path();
  TomlTable table(root, file, "study");
  Study study;
  study.file = file;
  if (auto t = table.table("subject")) study.subject = read_subject(*t);
  if (auto t = table.table("model")) {
    study.model = read_model(*t, folder);
  } else {
    study.model.builtin = "arm4";
  }
  if (auto t = table.table("motion")) study.motion = read_motion(*t);
  if (auto t = table.table("markers")) study.markers = read_markers(*t);
  if (auto t = table.table("ik")) study.ik = read_ik(*t);
  if (auto t = table.table("emg")) study.emg = read_emg(*t);
  if (auto t = table.table("sync")) study.sync = read_sync(*t, folder);
  if (auto t = table.table("load_cell")) study.load_cell = read_load_cell(*t, folder);
  if (auto t = table.table("sharing")) study.sharing = read_sharing(*t);
  if (auto t = table.table("phases")) study.phases = read_phases(*t);
  if (auto t = table.table("identify")) study.identify = read_identify(*t);
  for (TomlTable& t : table.tables("muscle")) study.muscles.push_back(read_muscle(t));
  for (TomlTable& t : table.tables("trial")) study.trials.push_back(read_trial(t, folder));
  for (TomlTable& t : table.tables("parameter")) study.parameters.push_back(read_rule(t));
  if (auto t = table.table("truth")) {
    study.truth = folder / t->require_text("file", "the table of true values, truth.csv");
    t->finish();
  }
  table.finish();
  for (MuscleSpec& muscle : study.muscles) {
    if (!muscle.same_as) continue;
    for (const MuscleSpec& other : study.muscles) {
      if (other.name == *muscle.same_as) muscle.emg = other.emg;
    }
  }
  study.emg.has_mvc = std::any_of(study.trials.begin(), study.trials.end(),
                                  [](const TrialSpec& t) { return t.use == Use::mvc; });
  check_references(study);
  return study;
}

std::vector<std::string> study_coordinates(const ModelSpec& model) {
  std::vector<std::string> names{model.coordinate};
  names.insert(names.end(), model.more_coordinates.begin(), model.more_coordinates.end());
  return names;
}

std::optional<double> motion_cutoff_hz(const Study& study) {
  switch (study.motion.smoothing) {
    case Smoothing::none:
      return std::nullopt;
    case Smoothing::cutoff:
      return study.motion.cutoff_hz;
    case Smoothing::automatic:
      break;
  }
  return study.emg.lowpass_hz;
}

void restrict_trials(Study& study, std::optional<double> start_s, std::optional<double> end_s) {
  for (TrialSpec& trial : study.trials) {
    if (start_s) trial.start_s = std::max(*start_s, trial.start_s.value_or(*start_s));
    if (end_s) trial.end_s = std::min(*end_s, trial.end_s.value_or(*end_s));
    if (trial.start_s && trial.end_s && *trial.start_s >= *trial.end_s) {
      throw InvalidInput(
          fmt::format("trial '{}': it would begin at {} s and end at {} s; --start "
                      "must be before --end, and both within the trial's own times",
                      trial.name, *trial.start_s, *trial.end_s));
    }
  }
}

Study read_study(const std::filesystem::path& file) {
  return parse_study(recording::read_text_file(file), file);
}

}  // namespace myoid::pipeline
