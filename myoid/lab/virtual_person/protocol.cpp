#include "myoid/lab/virtual_person/protocol.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/name_ids.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/ground/files/toml_table.h"
#include "myoid/lab/virtual_person/truth_settings.h"
#include "myoid/muscle/hill_parameters.h"
#include "myoid/study/setting_reader.h"

namespace myoid::lab {
namespace {

using ground::TomlTable;

/// A part of a trial (a rise, a rest) and a whole trial. Recordings of a session are shorter.
constexpr double kLongestPart_s = 600.0, kLongestTrial_s = 3600.0;

/// Overwrites `value` if the key exists; throws unless lower <= value <= upper.
void number_into(
    TomlTable& table, std::string_view key, double& value, double lower, double upper, double scale = 1.0) {
  const std::optional<double> found = table.number(key);
  if (!found) return;
  if (*found < lower || *found > upper) {
    table.fail(key, fmt::format("found {:g}, expected a number from {:g} to {:g}", *found, lower, upper));
  }
  value = *found * scale;
}

void count_into(TomlTable& table, std::string_view key, int& value, int lower, int upper) {
  double number = value;
  number_into(table, key, number, lower, upper);
  if (number != std::floor(number)) {
    table.fail(key, fmt::format("found {:g}, expected a whole number", number));
  }
  value = static_cast<int>(number);
}

/// Reads a range [low, high].
void range_into(TomlTable& table, std::string_view key, Range& range, double lower, double upper) {
  if (!table.has(key)) return;
  const std::vector<double> found = table.numbers(key).value_or(std::vector<double>{});
  if (found.size() != 2 || found.front() > found.back() || found.front() < lower || found.back() > upper) {
    table.fail(key, fmt::format("found [{:g}], expected a range [low, high] between {:g} and {:g}",
                                fmt::join(found, ", "), lower, upper));
  }
  range = {found.front(), found.back()};
}

void read_subject(TomlTable table, VirtualSubject& subject) {
  subject.name = table.text("name").value_or(subject.name);
  number_into(table, "mass_kg", subject.mass_kg, 20.0, 250.0);
  subject.sex = table.choice("sex", subject.sex, {"male", "female"});
  number_into(table, "upper_arm_length_m", subject.upper_arm_length_m, 0.1, 0.6);
  number_into(table, "forearm_length_m", subject.forearm_length_m, 0.1, 0.5);
  table.finish();
}

/// Throws if a key of [truth] has no meaning at the level.
void check_level(const TomlTable& table, Level level, const TruthSpec& truth) {
  if (level == Level::different && truth.curves == "paper")
    table.fail(
        "curves",
        "found \"paper\", which persons of levels L0 and L1 have; a person at L2 has \"de_groote\" or \"millard\"");
  for (const char* key : {"emg_exponent", "crosstalk", "emg_gain_drift", "emg_noise", "torque_scale",
                          "torque_offset_nm", "fascicle_sd_m"}) {
    if (level == Level::noise_free && table.has(key))
      table.fail(key, "the sensors of level L0 are exact; remove the key, or choose level L1");
  }
}

void read_truth(TomlTable table, Level level, TruthSpec& truth) {
  study::SettingReader reader(table, {});
  visit(truth, reader);
  check_level(table, level, truth);
  std::vector<std::string> known;
  for (const muscle::HillField& field : muscle::kHillFields) known.emplace_back(field.name);
  const auto check = [&table, &known](const std::string& parameter, std::string_view key) {
    if (std::find(known.begin(), known.end(), parameter) != known.end()) return;
    const auto near = nearest_word(parameter, known);
    table.fail(key, near ? fmt::format("found \"{}\", which is no parameter of a muscle; did you mean \"{}\"?",
                                       parameter, *near)
                         : fmt::format("found \"{}\", which is no parameter of a muscle; they are {}", parameter,
                                       fmt::join(known, ", ")));
  };
  for (const std::string_view muscle : {"BIC", "BRA", "BRD", "TRI"}) {
    auto values = table.table(muscle);
    if (!values) continue;
    if (level == Level::different)
      table.fail(muscle,
                 "values of single muscles are for levels L0 and L1: at L2 a person has seven heads with other laws; "
                 "remove them, or choose another level");
    for (const std::string& parameter : values->keys()) {
      check(parameter, muscle);
      const double value = values->number(parameter).value_or(0.0);
      if (!(value > 0.0)) {
        values->fail(parameter, fmt::format("found {:g}, expected a positive number (SI)", value));
      }
      truth.values[std::string(muscle)][parameter] = value;
    }
  }
  table.finish();
}

void read_emg(TomlTable table, EmgNoise& emg, Protocol& protocol) {
  number_into(table, "rate_hz", emg.rate_hz, 500.0, 20000.0);
  range_into(table, "mvc_v", emg.mvc_v, 1e-6, 0.1);
  number_into(table, "baseline", emg.baseline, 0.0, 0.5);
  number_into(table, "hum", emg.hum, 0.0, 0.5);
  number_into(table, "hum_hz", emg.hum_hz, 10.0, 100.0);
  number_into(table, "artefact", emg.artefact, 0.0, 0.5);
  range_into(table, "crosstalk", emg.crosstalk, 0.0, 0.5);
  range_into(table, "mvc_effort", emg.effort, 0.3, 1.0);
  range_into(table, "exponent", emg.exponent, 0.5, 3.0);
  range_into(table, "spectrum", emg.spectrum, 0.3, 1.5);
  number_into(table, "motor_units", emg.motor_units, 0.0, 10000.0);
  number_into(table, "bandwidth_hz", emg.bandwidth_hz, 0.0, 5000.0);
  number_into(table, "mvc_window_s", protocol.mvc_window_s, 0.05, 20.0);
  number_into(table, "lowpass_hz", protocol.lowpass_hz, 1.0, 50.0);
  table.finish();
}

/// Reads angle_deg = 70, or angles_deg = [30, 70] for one trial each.
std::vector<double> read_angles_deg(TomlTable& table) {
  std::vector<double> angles = {table.number("angle_deg").value_or(70.0)};
  if (auto several = table.numbers("angles_deg")) {
    if (table.has("angle_deg")) table.fail("angles_deg", "angle_deg is there too; keep one of them");
    if (several->empty()) table.fail("angles_deg", "expected at least one angle");
    angles = *std::move(several);
  }
  for (const double angle : angles) {
    if (angle < 0.0 || angle > 150.0) {
      table.fail(table.has("angles_deg") ? "angles_deg" : "angle_deg",
                 fmt::format("found {:g}, expected an angle from 0 (straight) to 150", angle));
    }
  }
  return angles;
}

void read_isokinetic(TomlTable& table, TrialProtocol& trial) {
  trial.hold_s = 0.3;
  trial.rise_s = 0.5;
  number_into(table, "peak", trial.peak, 0.0, 0.95);
  trial.direction = table.choice("direction", Direction::both);
  const std::string mode = table.choice("mode", "both", {"concentric", "eccentric", "both"});
  trial.concentric = mode != "eccentric";
  trial.eccentric = mode != "concentric";
  number_into(table, "speed_deg_per_s", trial.speed_radps, 1.0, 600.0, kDegree);
  number_into(table, "from_deg", trial.lift.from_rad, 0.0, 150.0, kDegree);
  number_into(table, "to_deg", trial.lift.to_rad, 0.0, 150.0, kDegree);
  number_into(table, "rise_s", trial.rise_s, 0.3, kLongestPart_s);
  number_into(table, "rest_s", trial.rest_s, 0.2, kLongestPart_s);
  count_into(table, "repetitions", trial.repetitions, 1, 100);
  if (!(trial.lift.from_rad + 5.0 * kDegree < trial.lift.to_rad)) {
    table.fail("to_deg", fmt::format("found {:g}, expected at least 5 more than from_deg = {:g}",
                                     trial.lift.to_rad / kDegree, trial.lift.from_rad / kDegree));
  }
}

/// Reads the name of a trial, its kind, and the keys of every kind.
TrialProtocol read_kind(TomlTable& table) {
  TrialProtocol trial;
  trial.name = table.require_text("name", "a name; the names of the files are made from it");
  if (const std::string reason = name_refusal(trial.name); !reason.empty()) table.fail("name", reason);
  static_cast<void>(table.require_text("kind", fmt::format("one of {}", fmt::join(kTrialKindNames, ", "))));
  trial.kind = table.choice("kind", trial.kind);
  const bool isometric = trial.kind == TrialKind::isometric_ramp || trial.kind == TrialKind::isokinetic;
  const std::string usual = isometric                          ? "isometric"
                            : trial.kind == TrialKind::mvc     ? "mvc"
                            : trial.kind == TrialKind::passive ? "passive"
                                                               : "calibration";
  trial.use = table.choice("use", usual, {"calibration", "validation", "mvc", "isometric", "passive"});
  trial.plane = table.choice("plane", trial.plane);
  if (table.has("co_contraction")) range_into(table, "co_contraction", trial.co_contraction.emplace(), 0.0, 0.5);
  return trial;
}

/// Reads an effort at rest; one trial for each of its angles.
std::vector<TrialProtocol> read_held_still(TomlTable& table, TrialProtocol trial) {
  if (trial.kind == TrialKind::mvc) {
    trial.peak = 1.0;
    trial.rise_s = 1.0;
    trial.hold_s = 3.0;
  } else {
    number_into(table, "peak", trial.peak, 0.0, 0.95);
  }
  trial.direction = table.choice("direction", Direction::both);
  number_into(table, "rise_s", trial.rise_s, 0.3, kLongestPart_s);
  number_into(table, "hold_s", trial.hold_s, 0.0, kLongestPart_s);
  number_into(table, "rest_s", trial.rest_s, 0.2, kLongestPart_s);
  count_into(table, "repetitions", trial.repetitions, 1, 100);
  const bool several = table.has("angles_deg");
  std::vector<TrialProtocol> result;
  for (const double angle_deg : read_angles_deg(table)) {
    TrialProtocol one = trial;
    one.angle_rad = angle_deg * kDegree;
    if (several) one.name = fmt::format("{}_{:g}", trial.name, angle_deg);
    result.push_back(one);
  }
  return result;
}

void read_flexion(TomlTable& table, TrialProtocol& trial) {
  number_into(table, "frequency_hz", trial.cycles.frequency_hz, 0.02, 3.0);
  number_into(table, "centre_deg", trial.cycles.centre_rad, 0.0, 150.0, kDegree);
  number_into(table, "amplitude_deg", trial.cycles.amplitude_rad, 0.0, 75.0, kDegree);
  number_into(table, "variation", trial.cycles.variation, 0.0, 0.5);
  number_into(table, "warm_up_s", trial.warm_up_s, 0.0, 600.0);
  number_into(table, "duration_s", trial.cycles.duration_s, 3.0, 600.0);
  const double reach_rad = trial.cycles.amplitude_rad * (1.0 + 2.0 * trial.cycles.variation);
  if (trial.cycles.centre_rad - trial.cycles.amplitude_rad < -1e-9 ||
      trial.cycles.centre_rad - trial.cycles.amplitude_rad + 2.0 * reach_rad > 150.0 * kDegree) {
    table.fail("amplitude_deg",
               fmt::format("the elbow would move from {:.0f} to {:.0f} degrees; expected within 0 to "
                           "150: choose another centre_deg or a smaller amplitude",
                           (trial.cycles.centre_rad - trial.cycles.amplitude_rad) / kDegree,
                           (trial.cycles.centre_rad - trial.cycles.amplitude_rad + 2.0 * reach_rad) / kDegree));
  }
}

/// Reads a movement from one angle to another and back.
void read_raising(TomlTable& table, TrialProtocol& trial) {
  number_into(table, "from_deg", trial.lift.from_rad, 0.0, 150.0, kDegree);
  number_into(table, "to_deg", trial.lift.to_rad, 0.0, 150.0, kDegree);
  number_into(table, "raise_s", trial.lift.raise_s, 0.3, kLongestPart_s);
  number_into(table, "lower_s", trial.lift.lower_s, 0.3, kLongestPart_s);
  number_into(table, "rest_s", trial.rest_s, 0.2, kLongestPart_s);
  count_into(table, "repetitions", trial.repetitions, 1, 100);
  if (!(trial.lift.from_rad < trial.lift.to_rad)) {
    table.fail("to_deg", fmt::format("found {:g}, expected more than from_deg = {:g}", trial.lift.to_rad / kDegree,
                                     trial.lift.from_rad / kDegree));
  }
}

/// Returns the time that a trial of repetitions takes at most [s], without what the movement itself needs.
double most_length_s(const TrialProtocol& trial) {
  if (trial.kind == TrialKind::flexion) return trial.cycles.duration_s;
  const bool raises = trial.kind == TrialKind::eccentric || trial.kind == TrialKind::passive;
  const double once_s = raises ? trial.lift.raise_s + trial.lift.lower_s : 2.0 * trial.rise_s + trial.hold_s;
  const int directions = !raises && trial.direction == Direction::both ? 2 : 1;
  return trial.repetitions * directions * (once_s + trial.rest_s);
}

/// Reads one [[trial]]; several if it names several angles. Every kind has its own keys; a key of
/// another kind is an unknown key.
std::vector<TrialProtocol> read_trial(TomlTable table) {
  const TrialProtocol common = read_kind(table);
  std::vector<TrialProtocol> result{common};
  TrialProtocol& trial = result.front();
  switch (common.kind) {
    case TrialKind::isokinetic:
      read_isokinetic(table, trial);
      break;
    case TrialKind::isometric_ramp:
    case TrialKind::mvc:
      result = read_held_still(table, common);
      break;
    case TrialKind::flexion:
      number_into(table, "held_mass_kg", trial.held_mass_kg, 0.0, 50.0);
      read_flexion(table, trial);
      break;
    default:
      number_into(table, "held_mass_kg", trial.held_mass_kg, 0.0, 50.0);
      read_raising(table, trial);
  }
  if (const double length_s = most_length_s(result.front()); length_s > kLongestTrial_s)
    table.fail("repetitions", fmt::format("the trial would take {:.4g} s, expected at most {:g} s: choose fewer "
                                          "repetitions or shorter ones",
                                          length_s, kLongestTrial_s));
  table.finish();
  return result;
}

}  // namespace

Protocol default_protocol(Level level) {
  Protocol protocol;
  protocol.level = level;
  if (level != Level::different) {
    protocol.truth.curves = "paper";
    protocol.truth.tendon_strain = {0.0, 0.0};
    protocol.truth.moment_arm_sd = 0.0;
    return protocol;
  }
  protocol.motion.soft_tissue = 1.0;
  protocol.motion.misplacement_m = 0.005;
  protocol.motion.dropouts_per_min = 2.0;
  protocol.motion.frame_jitter_sd_s = 0.0002;
  protocol.emg.crosstalk = {0.05, 0.10};
  protocol.emg.effort = {0.8, 1.0};
  protocol.emg.exponent = {1.0, 1.5};
  protocol.emg.spectrum = {0.6, 1.2};
  protocol.emg.motor_units = 250.0;
  protocol.emg.bandwidth_hz = 450.0;
  protocol.control.irregularity = 1.0;
  protocol.sync = {.offset_sd_s = 0.008, .drift_ppm = 50.0};
  protocol.fatigue.on = true;
  return protocol;
}

Protocol parse_protocol(std::string_view text, const std::filesystem::path& file, std::optional<Level> level) {
  const toml::table document = parse_toml(text, file);
  TomlTable root(document, file, "protocol");
  const Level stated = root.choice("level", Level::noisy);
  Protocol protocol = default_protocol(level.value_or(stated));
  protocol.file = file;
  protocol.name = root.text("name").value_or(protocol.name);

  if (auto table = root.table("subject")) read_subject(*std::move(table), protocol.subject);
  if (auto table = root.table("truth")) read_truth(*std::move(table), protocol.level, protocol.truth);
  if (auto table = root.table("control")) {
    range_into(*table, "co_contraction", protocol.control.co_contraction, 0.0, 0.5);
    number_into(*table, "synergy", protocol.control.synergy, 0.0, 1.0);
    number_into(*table, "brachialis_synergy", protocol.control.brachialis_synergy, 0.0, 1.0);
    number_into(*table, "motor_noise", protocol.control.motor_noise, 0.0, 0.3);
    number_into(*table, "irregularity", protocol.control.irregularity, 0.0, 2.0);
    table->finish();
  }
  if (auto table = root.table("motion")) {
    number_into(*table, "rate_hz", protocol.motion.rate_hz, 20.0, 1000.0);
    number_into(*table, "marker_sd_m", protocol.motion.marker_sd_m, 0.0, 0.05);
    number_into(*table, "soft_tissue", protocol.motion.soft_tissue, 0.0, 5.0);
    number_into(*table, "misplacement_m", protocol.motion.misplacement_m, 0.0, 0.05);
    number_into(*table, "dropouts_per_min", protocol.motion.dropouts_per_min, 0.0, 60.0);
    number_into(*table, "frame_jitter_sd_s", protocol.motion.frame_jitter_sd_s, 0.0, 0.01);
    table->finish();
  }
  if (auto table = root.table("emg")) read_emg(*std::move(table), protocol.emg, protocol);
  if (auto table = root.table("torque")) {
    number_into(*table, "sd_nm", protocol.torque.sd_nm, 0.0, 20.0);
    number_into(*table, "bandwidth_hz", protocol.torque.bandwidth_hz, 0.1, 10.0);
    table->finish();
  }

  if (auto table = root.table("sync")) {
    number_into(*table, "offset_sd_s", protocol.sync.offset_sd_s, 0.0, 0.1);
    number_into(*table, "drift_ppm", protocol.sync.drift_ppm, 0.0, 1000.0);
    table->finish();
  }
  if (auto table = root.table("fatigue")) {
    protocol.fatigue.on = table->flag("on").value_or(true);
    protocol.fatigue.rates =
        table->choice("rates", protocol.fatigue.rates, {"elbow", "elbow_rest", "elbow_flexor", "elbow_extensor"});
    number_into(*table, "rest_s", protocol.fatigue.rest_s, 0.0, 3600.0);
    table->finish();
  }

  std::set<std::string> names;
  for (const TomlTable& table : root.tables("trial")) {
    for (TrialProtocol& trial : read_trial(table)) {
      if (!names.insert(trial.name).second) {
        table.fail("name", fmt::format("found \"{}\" a second time; every trial needs its own name", trial.name));
      }
      protocol.trials.push_back(std::move(trial));
    }
  }
  root.finish();
  if (protocol.trials.empty()) {
    throw ReadError(file, 0, "no trial; describe at least one as [[trial]] with name and kind");
  }
  return protocol;
}

void set_truth(Protocol& protocol, const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) {
    // A word needs no quotes.
    const std::size_t value = setting.find('=') + 1;
    const std::string_view word = std::string_view(setting).substr(value);
    const bool quote = value > 0 && !word.empty() && std::isalpha(static_cast<unsigned char>(word[0])) != 0 &&
                       word != "true" && word != "false";
    const toml::table table =
        parse_toml(quote ? fmt::format("{}\"{}\"", setting.substr(0, value), word) : setting, "--truth");
    read_truth(TomlTable(table, "--truth", "[truth]"), protocol.level, protocol.truth);
  }
}

Protocol read_protocol(const std::filesystem::path& file, std::optional<Level> level) {
  return parse_protocol(read_text_file(file), file, level);
}

}  // namespace myoid::lab
