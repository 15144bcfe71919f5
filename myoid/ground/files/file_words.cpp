#include "myoid/ground/files/file_words.h"

#include <array>

#include "myoid/ground/files/text_file.h"
#include "myoid/ground/files/utf8.h"

namespace myoid::inline ground {

namespace {

constexpr double kFootPound = 0.3048 * 4.4482216152605;  // foot times pound-force [N m]
struct Word {
  std::string_view text;
  ScaledUnit unit;
};
constexpr std::array kWords = {
    Word{"nt", {Unit::newton, 1.0}},
    Word{"newton", {Unit::newton, 1.0}},
    Word{"n/m", {Unit::newton_per_meter, 1.0}},
    Word{"mrad", {Unit::radian, 1e-3}},
    Word{"degs", {Unit::radian, kDegree}},
    Word{"g", {Unit::meter_per_second2, kStandardGravity}},
    Word{"mg", {Unit::meter_per_second2, 1e-3 * kStandardGravity}},
    Word{"m/s2", {Unit::meter_per_second2, 1.0}},
    Word{"m/s/s", {Unit::meter_per_second2, 1.0}},
    Word{"mm/s2", {Unit::meter_per_second2, 1e-3}},
    Word{"mm/s^2", {Unit::meter_per_second2, 1e-3}},
    Word{"rad/s2", {Unit::radian_per_second2, 1.0}},
    Word{"m/s²", {Unit::meter_per_second2, 1.0}},
    Word{"deg/sec", {Unit::radian_per_second, kDegree}},
    Word{"deg/s", {Unit::radian_per_second, kDegree}},
    Word{"degrees/sec", {Unit::radian_per_second, kDegree}},
    Word{"degrees/s", {Unit::radian_per_second, kDegree}},
    Word{"°/s", {Unit::radian_per_second, kDegree}},
    Word{"dps", {Unit::radian_per_second, kDegree}},
    Word{"v", {Unit::volt, 1.0}},
    Word{"volts", {Unit::volt, 1.0}},
    Word{"uv", {Unit::volt, 1e-6}},
    Word{"millivolt", {Unit::volt, 1e-3}},
    Word{"microvolt", {Unit::volt, 1e-6}},
    Word{"msec", {Unit::second, 1e-3}},
    Word{"msecs", {Unit::second, 1e-3}},
    Word{"millisec", {Unit::second, 1e-3}},
    Word{"secs", {Unit::second, 1.0}},
    Word{"inches", {Unit::meter, 0.0254}},
    Word{"inch", {Unit::meter, 0.0254}},
    Word{"deg.", {Unit::radian, kDegree}},
    Word{"º", {Unit::radian, kDegree}},  // the ordinal of Spanish and Portuguese keyboards
    Word{"º/s", {Unit::radian_per_second, kDegree}},
    Word{"°/sec", {Unit::radian_per_second, kDegree}},
    Word{"degs-1", {Unit::radian_per_second, kDegree}},
    Word{"°s-1", {Unit::radian_per_second, kDegree}},
    Word{"degree/s", {Unit::radian_per_second, kDegree}},
    Word{"degree/second", {Unit::radian_per_second, kDegree}},
    Word{"degrees/second", {Unit::radian_per_second, kDegree}},
    Word{"rpm", {Unit::radian_per_second, 6.0 * kDegree}},
    Word{"mvolt", {Unit::volt, 1e-3}},
    Word{"mvolts", {Unit::volt, 1e-3}},
    Word{"uvolt", {Unit::volt, 1e-6}},
    Word{"uvolts", {Unit::volt, 1e-6}},
    Word{"us", {Unit::second, 1e-6}},
    Word{"µs", {Unit::second, 1e-6}},  // micro sign
    Word{"μs", {Unit::second, 1e-6}},  // Greek mu
    Word{"usec", {Unit::second, 1e-6}},
    Word{"microseconds", {Unit::second, 1e-6}},
    Word{"milliseconds", {Unit::second, 1e-3}},
    Word{"um", {Unit::meter, 1e-6}},
    Word{"µm", {Unit::meter, 1e-6}},
};

/// Words of a torque without the marks between their parts: "N-m", "N.m" and "N·m" are "nm".
constexpr std::array kTorqueWords = {
    Word{"nm", {Unit::newton_meter, 1.0}},
    Word{"ntm", {Unit::newton_meter, 1.0}},
    Word{"newtonmeter", {Unit::newton_meter, 1.0}},
    Word{"newtonmeters", {Unit::newton_meter, 1.0}},
    Word{"newtonmetres", {Unit::newton_meter, 1.0}},
    Word{"nmm", {Unit::newton_meter, 1e-3}},
    Word{"ntmm", {Unit::newton_meter, 1e-3}},
    Word{"mnm", {Unit::newton_meter, 1e-3}},
    Word{"ncm", {Unit::newton_meter, 1e-2}},
    Word{"knm", {Unit::newton_meter, 1e3}},
    Word{"ftlb", {Unit::newton_meter, kFootPound}},
    Word{"ftlbs", {Unit::newton_meter, kFootPound}},
    Word{"ftlbf", {Unit::newton_meter, kFootPound}},
    Word{"lbft", {Unit::newton_meter, kFootPound}},
    Word{"lbsft", {Unit::newton_meter, kFootPound}},
    Word{"lbfft", {Unit::newton_meter, kFootPound}},
    Word{"footlbs", {Unit::newton_meter, kFootPound}},
    Word{"footpound", {Unit::newton_meter, kFootPound}},
    Word{"footpounds", {Unit::newton_meter, kFootPound}},
    Word{"inlb", {Unit::newton_meter, kFootPound / 12.0}},
    Word{"inlbs", {Unit::newton_meter, kFootPound / 12.0}},
    Word{"inlbf", {Unit::newton_meter, kFootPound / 12.0}},
    Word{"lbin", {Unit::newton_meter, kFootPound / 12.0}},
    Word{"lbfin", {Unit::newton_meter, kFootPound / 12.0}},
    Word{"kgm", {Unit::newton_meter, kStandardGravity}},
    Word{"kgfm", {Unit::newton_meter, kStandardGravity}},
    Word{"kpm", {Unit::newton_meter, kStandardGravity}},
    Word{"kgcm", {Unit::newton_meter, 1e-2 * kStandardGravity}},
    Word{"kgfcm", {Unit::newton_meter, 1e-2 * kStandardGravity}},
};

}  // namespace

std::string to_utf8(std::string_view bytes) {
  std::string text;
  const bool utf8 = is_utf8(bytes);
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) {
      text += ' ';
    } else if (utf8 || byte < 0x80) {
      text += c;
    } else {
      text += static_cast<char>(0xC0 | (byte >> 6));
      text += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  std::size_t begin = 0;
  while (begin < text.size() && text[begin] == ' ') ++begin;
  return text.substr(begin);
}

std::optional<ScaledUnit> parse_file_unit(std::string_view text) {
  std::string word;
  for (const char c : text) {
    if (c != ' ' && c != '\0') word += small_letter(c);
  }
  // "mV" and "MV", "N" and "n" differ by case; in capitals or small letters only, the usual unit is meant.
  if (word == "mv") return ScaledUnit{Unit::volt, 1e-3};
  for (const Word& entry : kWords) {
    if (entry.text == word) return entry.unit;
  }
  const std::string clean = to_utf8(text.substr(0, text.find('\0')));
  std::string parts = to_utf8(word);
  for (const std::string_view mark : {"-", "*", ".", "_", "·", "\u22c5"})  // the last one is the dot operator
    for (std::size_t at = parts.find(mark); at != std::string::npos; at = parts.find(mark))
      parts.erase(at, mark.size());
  for (const Word& entry : kTorqueWords) {
    if (entry.text == parts) return entry.unit;
  }
  if (const auto unit = parse_unit(clean)) return unit;
  return parse_unit(word == "n" ? "N" : word);
}

}  // namespace myoid::inline ground
