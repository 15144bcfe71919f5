#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/body/arm/arm7.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/lab/twin/voluntary_truth.h"
#include "myoid/lab/twin/write_recording.h"
#include "myoid/lab/virtual_person/effective_truth.h"
#include "myoid/lab/virtual_person/truth_settings.h"
#include "myoid/muscle/force_velocity.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::lab {
namespace {

using ground::toml_text;

void add_trial(const VirtualTrial& trial, const std::string& stem, RecordingFormat format, std::string& text) {
  const TrialProtocol& p = trial.protocol;
  const bool c3d = format == RecordingFormat::c3d;
  text += fmt::format("\n[[trial]]\nname = {}\nmarkers = {}\nemg = {}\nuse = \"{}\"\n", toml_text(p.name),
                      toml_text(stem + (c3d ? ".c3d" : ".trc")), toml_text(stem + (c3d ? ".c3d" : "_emg.sto")), p.use);
  if (trial.external_torque) {
    text += fmt::format("external_torque = {}\n", toml_text(stem + "_torque.sto"));
  }
  if (trial.fascicles) text += fmt::format("fascicles = {}\n", toml_text(stem + "_fascicles.sto"));
  text += fmt::format("held_mass_kg = {}\n", toml_number(p.held_mass_kg));
}

void add_row(
    std::string& csv, std::string_view of, std::string_view quantity, std::string_view unit, const auto& value) {
  csv += fmt::format("{},{},{},{}\n", csv_cell(of), quantity, unit, value);
}

/// Returns the muscles of the model file that make up this one, as a TOML list's content.
std::string modelled_as(std::size_t muscle, bool seven_heads) {
  if (!seven_heads) return fmt::format("\"{}\"", kArmMuscles[muscle]);
  std::string list;
  for (const body::ArmHead& head : body::arm7_heads()) {
    if (static_cast<std::size_t>(head.lump) != muscle) continue;
    list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", head.path.name);
  }
  return list;
}

}  // namespace

std::string study_toml(const VirtualRecording& recording, RecordingFormat format) {
  const Protocol& protocol = recording.protocol;
  const VirtualSubject& subject = protocol.subject;
  const bool exact = protocol.level == Level::noise_free;
  const bool own_brachialis = has_brachialis_electrode(protocol);

  const std::string name = toml_text(protocol.name);  // escaped: no line break ends the comment

  std::string text = fmt::format(
      "# A virtual recording: protocol \"{}\", level {}, seed {}. Nobody was measured.\n"
      "# Analyse it with: myoid run study.toml --out results\n\n",
      name.substr(1, name.size() - 2), choice_name(protocol.level), recording.seed);
  text += fmt::format("[subject]\nname = {}\nmass_kg = {}\nsex = \"{}\"\n\n",
                      toml_text(fmt::format("{}-{}", subject.name, recording.seed)), toml_number(subject.mass_kg),
                      subject.sex);
  text += fmt::format(
      "[model]\n"
      "file = \"model.osim\"              # this subject's segments, the literature's muscles\n"
      "coordinate = \"elbow_flexion\"     # the joint whose torque the muscles share\n"
      "held_mass = {{ body = {}, at_m = [{}, {}, {}] }}  # where held_mass_kg of a trial acts\n\n",
      toml_text(kHeldBody), toml_number(recording.held_at_m.x()), toml_number(recording.held_at_m.y()),
      toml_number(recording.held_at_m.z()));
  text += fmt::format("[motion]\nsmoothing = \"{}\"{}\n\n", exact ? "none" : "auto",
                      exact ? "               # the markers are exact" : "");

  if (exact) {
    text +=
        "[emg]\n"
        "kind = \"activation\"              # exact: nothing to filter or to normalise\n"
        "delay_s = \"estimate\"\n";
  } else {
    text += fmt::format(
        "[emg]\n"
        "kind = \"raw\"\n"
        "unit = \"V\"\n"
        "highpass_hz = 20.0\n"
        "lowpass_hz = {}                  # of the envelope\n"
        "normalise = \"max\"\n"
        "normalise_window_s = {}          # the greatest efforts are kept for longer than this\n"
        "delay_s = \"estimate\"\n",
        toml_number(protocol.lowpass_hz), toml_number(protocol.mvc_window_s));
    if (protocol.emg.effort.lower < 1.0) {
      // The study states the literature of these people, not this person's number.
      text += fmt::format(
          "mvc_effort = {:.3g}                 # what people reach of their greatest activation\n"
          "mvc_effort_sd = {:.3g}\n",
          0.5 * (protocol.emg.effort.lower + protocol.emg.effort.upper),
          (protocol.emg.effort.upper - protocol.emg.effort.lower) / std::sqrt(12.0));
    }
  }

  // A person with the literature's v_max has a known one, which the study must hold.
  const std::vector<std::string>& vary = protocol.truth.vary;
  const bool speed_is_known =
      !recording.truth.arm && std::find(vary.begin(), vary.end(), "max_shortening_speed") == vary.end();
  for (std::size_t i = 0; i < kArmMuscles.size(); ++i) {
    const std::string_view muscle = kArmMuscles[i];
    text += fmt::format("\n[[muscle]]\nname = \"{}\"\nosim = [{}]\n", muscle, modelled_as(i, protocol.seven_heads));
    text += i == kBrachialis && !own_brachialis ? "emg = { same_as = \"BIC\" }         # deep: no electrode on it\n"
                                                : fmt::format("emg = \"{}\"\n", muscle);
    if (recording.protocol.truth.sensors.fascicle_sd_m > 0.0)
      text += speed_is_known ? "fixed = [\"max_shortening_speed\"]    # known; fascicles tell the tendon\n" : "";
    else
      text += speed_is_known ? "fixed = [\"max_shortening_speed\", \"tendon_slack_length\"]    # both are known\n"
                             : "fixed = [\"tendon_slack_length\"]    # the tendon is the model's\n";
  }
  const NameIds stems = file_stems(recording);
  for (const VirtualTrial& trial : recording.trials) add_trial(trial, stems.of(trial.protocol.name), format, text);
  text +=
      "\n[identify]\n"
      "method = [\"paper\", \"torque\"]\n"
      "muscles = \"all\"\n"
      "muscle_law = \"paper\"           # neither pennation nor passive force\n";
  if (!recording.truth.arm && !recording.truth.departures.elastic())
    text += "tendon = \"rigid\"                 # as the truth is\n";
  text +=
      "\n[truth]\n"
      "file = \"truth.csv\"               # the report shows it beside the estimates\n";
  return text;
}

std::string truth_csv(const VirtualRecording& recording) {
  const Truth& truth = recording.truth;
  std::string text = "muscle,parameter,unit,value\n";
  for (std::size_t i = 0; i < kArmMuscles.size(); ++i) {
    for (const muscle::HillField& field : muscle::kHillFields) {
      if (truth.departures.has(field))
        add_row(text, kArmMuscles[i], field.name, symbol(field.unit), truth.muscles[i].*(field.member));
    }
  }
  add_row(text, "subject", "emg_delay", "s", truth.emg_delay_s);
  for (const VoluntaryTruth& of : voluntary_truth(recording))
    add_row(text, of.owner, of.parameter, symbol(of.unit), of.value);
  for (std::size_t i = 0; truth.departures.paper_curves() && i < kArmMuscles.size(); ++i)
    add_row(text, kArmMuscles[i], "eccentric_slope_ratio", "1", muscle::slope_ratio(truth.muscles[i].velocity_law()));
  if (truth.arm) {
    const PerMuscle strength_n = anatomical_strength_n(*truth.arm);
    for (std::size_t i = 0; i < kArmMuscles.size(); ++i) {
      add_row(text, kArmMuscles[i], "anatomical_strength", "N", strength_n[i]);
      add_row(text, kArmMuscles[i], "misfit_of_the_fitted_model", "1", truth.misfit[i]);
    }
    return text;
  }
  // The numbers beside the muscles' parameters, because the fitted model is the person's. Exact
  // activations are the muscles' own, without an electrode's exponent.
  const bool exact = recording.protocol.level == Level::noise_free;
  for (std::size_t i = 0; i < kArmMuscles.size(); ++i) {
    const double exponent = exact ? 1.0 : truth.instruments.exponent[i];
    add_row(text, kArmMuscles[i], "length_activation", "1", truth.beside.length_activation);
    add_row(text, kArmMuscles[i], "emg_exponent", "1", exponent > 0.0 ? exponent : 1.0);
  }
  add_row(text, "elbow_flexion", "joint_viscosity", "N m s", truth.beside.joint_viscosity_nms_per_rad);
  add_row(text, "elbow_flexion", "joint_stiffness", "N m", truth.beside.joint_stiffness_nm_per_rad);
  add_row(text, "elbow_flexion", "joint_torque_offset", "N m", truth.beside.joint_torque_nm);
  const auto departure = [&text](std::string_view name, std::string_view unit, const PerMuscle& values, double usual) {
    if (std::all_of(values.begin(), values.end(), [&](double v) { return v == usual; })) return;
    for (std::size_t i = 0; i < kArmMuscles.size(); ++i) add_row(text, kArmMuscles[i], name, unit, values[i]);
  };
  departure("moment_arm_scale", "1", truth.departures.moment_arm_scale, 1.0);
  departure("moment_arm_slope", "1/rad", truth.departures.moment_arm_slope_per_rad, 0.0);
  departure("tendon_strain", "1", truth.departures.tendon_strain, 0.0);
  return text;
}

std::string truth_header() {
  std::string text = "seed,draws,emg_delay";
  for (const std::string_view muscle : kArmMuscles) {
    for (const muscle::HillField& field : muscle::kHillFields) text += fmt::format(",{}_{}", muscle, field.name);
  }
  return text;
}

std::string truth_row(const VirtualRecording& recording) {
  const Truth& truth = recording.truth;
  std::string text = fmt::format("{},{},{}", recording.seed, truth.draws, truth.emg_delay_s);
  for (std::size_t i = 0; i < kArmMuscles.size(); ++i) {
    for (const muscle::HillField& field : muscle::kHillFields)
      text += truth.departures.has(field) ? fmt::format(",{}", truth.muscles[i].*(field.member)) : ",";
  }
  return text;
}

std::string person_csv(const VirtualRecording& recording) {
  const Truth& truth = recording.truth;
  std::string text = "of,quantity,unit,value\n";
  const auto add = [&text](std::string_view of, std::string_view quantity, std::string_view unit, const auto& value) {
    add_row(text, of, quantity, unit, value);
  };
  for (std::size_t m = 0; m < kArmMuscles.size(); ++m) {
    const std::string_view name = kArmMuscles[m];
    add(name, "greatest_emg_rms", "V", truth.instruments.greatest_v[m]);
    add(name, "emg_exponent", "1", truth.instruments.exponent[m]);
    add(name, "crosstalk", "1", truth.instruments.crosstalk[m]);
    add(name, "baseline", "1", truth.instruments.baseline[m]);
    add(name, "spectrum", "1", truth.instruments.spectrum[m]);
    add(name, "mvc_effort", "1", truth.effort[m]);
  }
  add("emg_clock", "drift", "1", truth.instruments.clock_drift);
  for (const VirtualTrial& trial : recording.trials) {
    add(trial.protocol.name, "emg_offset", "s", trial.truth.emg_clock.offset_s);
    for (std::size_t m = 0; m < kArmMuscles.size(); ++m)
      add(trial.protocol.name, fmt::format("fatigued_{}", kArmMuscles[m]), "1", trial.truth.fatigued[m]);
  }
  for (const WorldSetting& setting : stated_world(recording.protocol))
    add("world", setting.key, setting.unit, setting.value);
  if (!truth.arm) return text;
  const TrueArm& arm = *truth.arm;
  add("person", "millard_curves", "1", arm.laws.length == muscle::LengthLaw::millard ? 1.0 : 0.0);
  add("person", "excitation_time", "s", arm.activation.excitation_time_s);
  add("person", "activation_time", "s", arm.activation.activation_time_s);
  add("person", "deactivation_time", "s", arm.activation.deactivation_time_s);
  add("person", "pure_delay", "s", arm.delay_s);
  add("person", "joint_stiffness", "N m/rad", arm.joint.stiffness_nm_per_rad);
  add("person", "joint_viscosity", "N m s/rad", arm.joint.viscosity_nms_per_rad);
  add("person", "inertia", "kg m^2", arm.inertia_kgm2);
  add("person", "static_moment", "kg m", arm.static_moment_kgm);
  add("person", "held_at", "m", arm.held_at_m);
  for (const TrueHead& head : arm.heads) {
    muscle::visit_parameters(head.parameters, [&](std::string_view parameter, Unit unit, double value) {
      add(head.name, parameter, symbol(unit), value);
    });
    add(head.name, "drive", "1", head.drive);
    add(head.name, "moment_arm_at_90_degrees", "m", body::travel(head.path, 0.5 * kPi).moment_arm_m);
  }
  return text;
}

}  // namespace myoid::lab
