#include <algorithm>

#include <fmt/format.h>

#include "myoid/core/units.h"
#include "myoid/muscle/hill_parameters.h"
#include "myoid/simulation/write_recording.h"

namespace myoid::simulation {
namespace {

/// A TOML basic string. Protocols come from files, so names may hold anything.
std::string toml_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + '"';
}

/// A TOML float: always with a point or an exponent, and read back to the same bits.
std::string number(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

void add_trial(const VirtualTrial& trial, std::string& text) {
  const TrialProtocol& p = trial.protocol;
  text += fmt::format("\n[[trial]]\nname = {}\nmarkers = {}\nemg = {}\nuse = \"{}\"\n",
                      toml_text(p.name), toml_text(p.name + ".trc"), toml_text(p.name + "_emg.sto"),
                      p.use);
  if (trial.external_torque) {
    text += fmt::format("external_torque = {}\n", toml_text(p.name + "_torque.sto"));
  }
  text += fmt::format("held_mass_kg = {}\n", number(p.held_mass_kg));
}

}  // namespace

std::string study_toml(const VirtualRecording& recording) {
  const Protocol& protocol = recording.protocol;
  const VirtualSubject& subject = protocol.subject;
  const bool exact = protocol.level == Level::noise_free;
  const bool own_brachialis = protocol.control.brachialis_synergy > 0.0;

  const std::string name = toml_text(protocol.name);  // escaped: no line break ends the comment

  std::string text = fmt::format(
      "# A virtual recording: protocol \"{}\", level {}, seed {}. Nobody was measured.\n"
      "# Analyse it with: myoid run study.toml --out results\n\n",
      name.substr(1, name.size() - 2), exact ? "L0" : "L1", recording.seed);
  text += fmt::format("[subject]\nname = {}\nmass_kg = {}\nsex = \"{}\"\n\n",
                      toml_text(subject.name), number(subject.mass_kg), subject.sex);
  text += fmt::format(
      "[model]\n"
      "file = \"model.osim\"              # this subject's segments, the literature's muscles\n"
      "coordinate = \"elbow_flexion\"     # the joint whose torque the muscles share\n"
      "held_mass = {{ body = {}, at_m = [{}, {}, {}] }}  # where held_mass_kg of a trial acts\n\n",
      toml_text(recording.held_body), number(recording.held_at_m.x()),
      number(recording.held_at_m.y()), number(recording.held_at_m.z()));
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
        number(protocol.lowpass_hz), number(protocol.mvc_window_s));
  }

  for (std::size_t i = 0; i < kArmMuscles.size(); ++i) {
    const std::string_view muscle = kArmMuscles[i];
    text += fmt::format("\n[[muscle]]\nname = \"{0}\"\nosim = [\"{0}\"]\n", muscle);
    text += i == kBrachialis && !own_brachialis
                ? "emg = { same_as = \"BIC\" }         # deep: no electrode on it\n"
                : fmt::format("emg = \"{}\"\n", muscle);
  }
  for (const VirtualTrial& trial : recording.trials) add_trial(trial, text);
  text +=
      "\n[identify]\n"
      "method = [\"paper\", \"torque\"]\n"
      "muscles = \"all\"\n";
  if (exact) text += "priors = false                   # exact data need no prior knowledge\n";
  text +=
      "\n[truth]\n"
      "file = \"truth.csv\"               # the report shows it beside the estimates\n";
  return text;
}

std::string truth_csv(const VirtualRecording& recording) {
  std::string text = "muscle,parameter,unit,value\n";
  for (std::size_t i = 0; i < kArmMuscles.size(); ++i) {
    for (const muscle::HillField& field : muscle::kHillFields) {
      text += fmt::format("{},{},{},{}\n", kArmMuscles[i], field.name, symbol(field.unit),
                          recording.truth.muscles[i].*(field.member));
    }
  }
  text += fmt::format("subject,emg_delay,s,{}\n", recording.truth.emg_delay_s);
  return text;
}

}  // namespace myoid::simulation
