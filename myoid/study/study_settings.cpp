#include "myoid/study/study_settings.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/core/units.h"
#include "myoid/study/trial_table.h"
#include "myoid/study/trial_up.h"

namespace myoid {
namespace {

using recording::TomlTable;

/// A length of a person, adult or child, in meters; what lies outside is in another unit.
std::optional<double> segment_length(TomlTable& table, const char* key) {
  constexpr double kShortest_m = 0.08, kLongest_m = 0.5;
  if (!table.has(key)) return std::nullopt;
  const double length_m = table.positive_number(key, 0.0);
  if (length_m < kShortest_m || length_m > kLongest_m) {
    const char* unit = length_m > 5.0 && length_m < 60.0      ? "; is it in cm? Divide by 100"
                       : length_m > 60.0 && length_m < 1000.0 ? "; is it in mm? Divide by 1000"
                                                              : "";
    table.fail(key, fmt::format("found {} m, expected {} to {} m, as people's arms have{}",
                                length_m, kShortest_m, kLongest_m, unit));
  }
  return length_m;
}

SubjectSpec read_subject(TomlTable table) {
  SubjectSpec subject;
  subject.name = table.text("name").value_or(subject.name);
  if (table.has("mass_kg")) {
    subject.mass_kg = table.positive_number("mass_kg", 0.0);
    if (*subject.mass_kg < 10.0 || *subject.mass_kg > 350.0) {
      table.fail("mass_kg", fmt::format("found {} kg, expected a person's mass in kilograms",
                                        *subject.mass_kg));
    }
  }
  subject.sex = table.choice("sex", subject.sex);
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
  model.upper_arm_length_m = segment_length(table, "upper_arm_length_m");
  model.forearm_length_m = segment_length(table, "forearm_length_m");
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
    constexpr double kFarthest_m = 2.0;  // what a person may hold at the end of a pole
    if (spec.p_BP_m.norm() > kFarthest_m) {
      held->fail("at_m", fmt::format("found a point {:.3g} m from the body's origin, expected less "
                                     "than {} m; is it in cm or mm?",
                                     spec.p_BP_m.norm(), kFarthest_m));
    }
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
    motion.cutoff_hz = table.number_within("cutoff_hz", 6.0, 0.1, 500.0, "Hz");
    (void)table.choice("smoothing", "cutoff", {"cutoff"});
  } else {
    motion.smoothing = table.choice("smoothing", motion.smoothing);
  }
  motion.rate_hz = table.number_within("rate_hz", motion.rate_hz, 10.0, 2000.0, "Hz");
  table.finish();
  return motion;
}

MarkerSpec read_markers(TomlTable table) {
  MarkerSpec markers;
  markers.up = table.choice("up", "auto", {"auto", "x", "y", "z"})[0];
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
  emg.kind = table.choice("kind", emg.kind);
  emg.unit = table.text("unit").value_or("");
  emg.rectify = table.flag("rectify").value_or(emg.rectify);
  emg.notch = table.choice("notch", "auto", {"auto", "none"}) == "auto";
  emg.whitening = table.flag("whitening").value_or(emg.whitening);
  emg.highpass_hz = table.positive_number("highpass_hz", emg.highpass_hz);
  emg.lowpass_hz = table.positive_number("lowpass_hz", emg.lowpass_hz);
  emg.as_published = table.flag("as_published").value_or(emg.as_published);
  (void)table.choice("normalise", "max", {"max"});
  emg.normalise_window_s =
      table.number_within("normalise_window_s", emg.normalise_window_s, 0.01, 60.0, "s");
  emg.mvc_effort = table.number_within("mvc_effort", emg.mvc_effort, 0.3, 1.0, "");
  emg.mvc_effort_sd = table.number_within("mvc_effort_sd", emg.mvc_effort_sd, 0.0, 0.3, "");
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
  if (table.has("lowpass_hz")) cell.lowpass_hz = table.positive_number("lowpass_hz", 0.0);
  table.finish();
  return cell;
}

SharingSpec read_sharing(TomlTable table) {
  SharingSpec sharing;
  sharing.objective = table.choice("objective", sharing.objective);
  sharing.exponent = table.number("exponent").value_or(sharing.exponent);
  if (!(sharing.exponent > 1.0))
    table.fail("exponent", "expected a number above 1 (2 or 3 is usual)");
  sharing.reserve_nm = table.positive_number("reserve_nm", sharing.reserve_nm);
  table.finish();
  return sharing;
}

PhasesSpec read_phases(TomlTable table) {
  PhasesSpec phases;
  phases.search = table.flag("search").value_or(phases.search);
  if (auto exclude = table.texts("exclude")) {
    phases.exclude.clear();
    for (const std::string& word : *exclude) {
      const auto kind = choice_named<PhaseKind>(word);
      if (!kind || *kind == PhaseKind::regular)
        table.fail("exclude",
                   fmt::format("found \"{}\", expected \"warm_up\", \"fatigued\", \"changed\", "
                               "\"isometric\" or \"rest\"",
                               word));
      phases.exclude.push_back(*kind);
    }
  }
  table.finish();
  return phases;
}

IdentifySpec read_identify(TomlTable table) {
  IdentifySpec identify;
  if (auto methods = table.texts("method")) {
    identify.methods.clear();
    for (const std::string& word : *methods) {
      const auto method = choice_named<identification::Method>(word);
      if (!method)
        table.fail("method",
                   fmt::format("found \"{}\", expected \"paper\", \"force\" or \"torque\"", word));
      identify.methods.push_back(*method);
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
  const auto count = [&](std::string_view key, int otherwise, int least, int most) {
    const double value = table.number_within(key, otherwise, least, most, "");
    if (value != std::floor(value))
      table.fail(key, fmt::format("found {}, expected a whole number", value));
    return static_cast<int>(value);
  };
  identify.next_movements = count("next_movements", identify.next_movements, 0, 50);
  identify.folds = table.choice("folds", identify.folds);
  identify.bootstrap = count("bootstrap", identify.bootstrap, 0, 100000);
  identify.profile = table.flag("profile").value_or(identify.profile);
  identify.starts = count("starts", identify.starts, 1, 1000);
  identify.loss = table.choice("loss", identify.loss);
  identify.eccentric = table.choice("eccentric", identify.eccentric);
  identify.normalised = table.flag("normalised").value_or(identify.normalised);
  identify.lag = table.choice("lag", identify.lag);
  identify.dynamics = table.flag("dynamics").value_or(identify.dynamics);
  if (identify.dynamics && table.has("lag")) {
    table.fail("lag",
               "it stands beside dynamics = true, which is a third way to follow the EMG; leave "
               "one of both out");
  }
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
  identify.max_rate_hz =
      table.number_within("max_rate_hz", identify.max_rate_hz, 5.0, 2000.0, "Hz");
  table.finish();
  return identify;
}

}  // namespace

void read_settings(TomlTable& table, const std::filesystem::path& folder, Study& study) {
  if (auto t = table.table("subject")) study.subject = read_subject(*t);
  if (auto t = table.table("model")) {
    study.model = read_model(*t, folder);
  } else {
    study.model.builtin = "arm4";
  }
  if (auto t = table.table("motion")) study.motion = read_motion(*t);
  study.markers.up = kUpOfTheFile;
  if (auto t = table.table("markers")) study.markers = read_markers(*t);
  if (auto t = table.table("ik")) study.ik = read_ik(*t);
  if (auto t = table.table("emg")) study.emg = read_emg(*t);
  if (auto t = table.table("sync")) study.sync = read_sync(*t, folder);
  if (auto t = table.table("load_cell")) study.load_cell = read_load_cell(*t, folder);
  if (auto t = table.table("sharing")) study.sharing = read_sharing(*t);
  if (auto t = table.table("phases")) study.phases = read_phases(*t);
  if (auto t = table.table("identify")) study.identify = read_identify(*t);
  if (auto t = table.table("truth")) {
    study.truth = folder / t->require_text("file", "the table of true values, truth.csv");
    t->finish();
  }
}

}  // namespace myoid
