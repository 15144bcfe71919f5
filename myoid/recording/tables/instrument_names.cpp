#include "myoid/recording/tables/instrument_names.h"

#include <algorithm>
#include <array>
#include <regex>
#include <string>
#include <vector>

#include "myoid/ground/files/label_match.h"

namespace myoid::recording {

namespace {

/// Splits a name into words of letters or of digits, in small letters.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  int last = 0;
  for (const char c : name) {
    const char small = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    const int kind = small >= 'a' && small <= 'z' ? 1 : small >= '0' && small <= '9' ? 2 : 0;
    if (kind != 0 && kind != last) words.emplace_back();
    if (kind != 0) words.back() += small;
    last = kind;
  }
  return words;
}

/// Returns true for signals that electrodes record in addition to EMG: motion and pressure ("Sensor
/// 1: ACC.X 1", "GYRO Y", "FSR.A"), the heart ("EKG 1").
bool named_as_other_sensor(std::string_view name) {
  const std::vector<std::string> words = words_of(name);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "gyro" || words[i] == "fsr" || words[i] == "ekg" || words[i] == "ecg") return true;
    const bool axis = i + 1 < words.size() && words[i + 1].size() == 1 && words[i + 1] >= "x" && words[i + 1] <= "z";
    if (axis && (words[i] == "acc" || words[i] == "mag")) return true;
  }
  return false;
}

}  // namespace

bool named_as_no_emg(std::string_view name) {
  if (named_as_other_sensor(name)) return true;
  // Matches the letters and digits of a name: instrument, then quantity, axis and number in either order.
  static const std::regex kForce(
      "(force|moment|torque|grf|amti|bertec|kistler|forceplate|plate|fp|[0-9])*"
      "(f|m|cop|p)[0-9]*[xyz][0-9]*");
  static constexpr std::array<std::string_view, 9> kInstruments{"sync",  "trig", "footsw",   "heelsw",   "gonio",
                                                                "accel", "gyro", "loadcell", "timestamp"};
  const std::string plain = plain_label(name);
  std::string_view without_side = plain;
  for (const std::string_view side : {"left", "right"}) {
    if (plain.starts_with(side)) without_side.remove_prefix(side.size());
  }
  return std::regex_match(plain, kForce) ||
         std::ranges::any_of(kInstruments, [&](std::string_view word) { return without_side.starts_with(word); });
}

bool named_as_input(std::string_view name) {
  const std::vector<std::string> words = words_of(name);
  const auto has = [&](std::string_view word) { return std::ranges::find(words, word) != words.end(); };
  return (has("analog") || has("analogue") || has("aux") || has("auxiliary")) && !has("emg");
}

}  // namespace myoid::recording
