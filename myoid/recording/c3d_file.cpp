#include "myoid/recording/c3d_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"

namespace myoid::recording {
namespace {

constexpr Eigen::Index kBlock = 64;  ///< Rows turned into columns at a time, to stay in the cache.

bool valid_utf8(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t more = lead < 0x80                    ? 0
                             : lead >= 0xC2 && lead <= 0xDF ? 1
                             : lead >= 0xE0 && lead <= 0xEF ? 2
                             : lead >= 0xF0 && lead <= 0xF4 ? 3
                                                            : 9;
    if (more == 9 || i + more >= text.size() + (more == 0 ? 1 : 0)) return false;
    for (std::size_t k = 1; k <= more; ++k) {
      if ((static_cast<unsigned char>(text[i + k]) & 0xC0) != 0x80) return false;
    }
    // Overlong forms, surrogates and what lies beyond the last code point.
    const auto second = more > 0 ? static_cast<unsigned char>(text[i + 1]) : 0;
    if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) ||
        (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F))
      return false;
    i += more + 1;
  }
  return true;
}

/// Group and parameter names that mean the same.
bool same_name(std::string_view stored, std::string_view wanted) {
  if (equal_ignoring_case(trim(stored), wanted)) return true;
  if (wanted == "FORCE_PLATFORM") {
    return equal_ignoring_case(stored, "FORCE_PLATEFORM") ||
           equal_ignoring_case(stored, "FORCE_PLATFORMS") ||
           equal_ignoring_case(stored, "FORCE PLATFORM");
  }
  if (wanted == "OFFSET") return equal_ignoring_case(stored, "OFFSETS");
  return false;
}

}  // namespace

std::string to_utf8(std::string_view bytes) {
  std::string text;
  const bool utf8 = valid_utf8(bytes);
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

const C3dParameter* C3dFile::find(std::string_view group, std::string_view name) const {
  for (const C3dGroup& g : groups) {
    if (!same_name(g.name, group)) continue;
    const C3dParameter* other_spelling = nullptr;
    for (const C3dParameter& p : g.parameters) {
      if (equal_ignoring_case(trim(p.name), name)) return &p;
      if (same_name(p.name, name)) other_spelling = &p;
    }
    if (other_spelling != nullptr) return other_spelling;
  }
  return nullptr;
}

std::vector<std::string> texts(const C3dParameter& parameter) {
  std::vector<std::string> list;
  if (parameter.type != C3dType::text) return list;
  const std::size_t width =
      parameter.dimensions.empty() ? 1 : std::size_t{parameter.dimensions.front()};
  std::size_t count = 1;
  for (std::size_t d = 1; d < parameter.dimensions.size(); ++d) count *= parameter.dimensions[d];
  count = std::min<std::size_t>(count, 65535);  // texts of no length may claim to be any number
  for (std::size_t i = 0; i < count; ++i) {
    std::string_view text = parameter.text;
    text = i * width < text.size() ? text.substr(i * width, width) : std::string_view();
    text = text.substr(0, text.find('\0'));
    list.push_back(to_utf8(text));
  }
  return list;
}

std::optional<double> number_at(const C3dParameter* parameter, std::size_t index) {
  if (parameter == nullptr || index >= parameter->numbers.size() ||
      !std::isfinite(parameter->numbers[index]))
    return std::nullopt;
  return parameter->numbers[index];
}

std::optional<ScaledUnit> parse_c3d_unit(std::string_view text) {
  std::string word;
  for (const char c : text) {
    if (c != ' ' && c != '\0') word += c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  }
  struct Word {
    std::string_view text;
    ScaledUnit unit;
  };
  constexpr std::array kWords = {
      Word{"nt", {Unit::newton, 1.0}},
      Word{"newton", {Unit::newton, 1.0}},
      Word{"ntm", {Unit::newton_meter, 1.0}},
      Word{"ntmm", {Unit::newton_meter, 1e-3}},
      Word{"nm", {Unit::newton_meter, 1.0}},
      Word{"nmm", {Unit::newton_meter, 1e-3}},
      Word{"n-m", {Unit::newton_meter, 1.0}},
      Word{"n-mm", {Unit::newton_meter, 1e-3}},
      Word{"n*m", {Unit::newton_meter, 1.0}},
      Word{"n*mm", {Unit::newton_meter, 1e-3}},
      Word{"n/m", {Unit::newton_per_meter, 1.0}},
      Word{"ncm", {Unit::newton_meter, 1e-2}},
      Word{"g", {Unit::meter_per_second2, kStandardGravity}},
      Word{"mg", {Unit::meter_per_second2, 1e-3 * kStandardGravity}},
      Word{"m/s2", {Unit::meter_per_second2, 1.0}},
      Word{"m/s/s", {Unit::meter_per_second2, 1.0}},
      Word{"mm/s2", {Unit::meter_per_second2, 1e-3}},
      Word{"mm/s^2", {Unit::meter_per_second2, 1e-3}},
      Word{"rad/s2", {Unit::radian_per_second2, 1.0}},
      Word{"deg/sec", {Unit::radian_per_second, kDegree}},
      Word{"°/s", {Unit::radian_per_second, kDegree}},
      Word{"dps", {Unit::radian_per_second, kDegree}},
      Word{"v", {Unit::volt, 1.0}},
      Word{"volts", {Unit::volt, 1.0}},
      Word{"uv", {Unit::volt, 1e-6}},
      Word{"millivolt", {Unit::volt, 1e-3}},
      Word{"microvolt", {Unit::volt, 1e-6}},
      Word{"inches", {Unit::meter, 0.0254}},
      Word{"inch", {Unit::meter, 0.0254}},
  };
  // "mV" and "MV", "N" and "n" differ by case; where all is in capitals the usual one is meant.
  if (word == "mv") return ScaledUnit{Unit::volt, 1e-3};
  for (const Word& entry : kWords) {
    if (entry.text == word) return entry.unit;
  }
  const std::string clean = to_utf8(text.substr(0, text.find('\0')));
  if (const auto unit = parse_unit(clean)) return unit;
  return parse_unit(word == "n" ? "N" : word);
}

std::vector<Eigen::Index> marker_columns(const C3dFile& file) {
  std::set<std::string> derived;
  for (const char* kind : {"ANGLES", "FORCES", "MOMENTS", "POWERS", "SCALARS", "REACTIONS"}) {
    for (int block = 1; block <= 20; ++block) {
      const std::string name = block == 1 ? kind : fmt::format("{}{}", kind, block);
      const C3dParameter* parameter = file.find("POINT", name);
      if (parameter == nullptr) break;
      for (const std::string& label : texts(*parameter)) derived.insert(label);
    }
  }
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < file.point_labels.size(); ++i) {
    if (!derived.contains(file.point_labels[i])) columns.push_back(static_cast<Eigen::Index>(i));
  }
  return columns;
}

MarkerSeries c3d_markers(const C3dFile& file, std::vector<Repair>& repairs) {
  const std::vector<Eigen::Index> columns = marker_columns(file);
  if (columns.empty() || file.frame_count() == 0)
    throw InvalidInput("the C3D file holds no markers");
  const std::optional<ScaledUnit> unit = parse_c3d_unit(file.point_unit);
  if (!unit || unit->unit != Unit::meter) {
    throw InvalidInput(
        fmt::format("POINT:UNITS: found '{}', expected mm, cm or m; correct the file's parameter",
                    file.point_unit));
  }
  if (columns.size() < file.point_labels.size()) {
    repairs.push_back({0, fmt::format("{} points are angles, forces, moments, powers or scalars of "
                                      "another program and no markers; left out",
                                      file.point_labels.size() - columns.size())});
  }
  const Eigen::Index frames = file.frame_count();
  MarkerSeries markers;
  markers.time_s.resize(frames);
  for (Eigen::Index k = 0; k < frames; ++k)
    markers.time_s[k] = static_cast<double>(file.first_frame - 1 + k) / file.point_rate_hz;

  // Names without the subject's prefix, if that keeps them apart.
  std::set<std::string> bare;
  bool prefixed = false;
  for (const Eigen::Index c : columns) {
    const std::string& name = file.point_labels[static_cast<std::size_t>(c)];
    const std::size_t colon = name.rfind(':');
    const bool has = colon != std::string::npos && colon > 0 && colon + 1 < name.size();
    prefixed = prefixed || has;
    bare.insert(has ? name.substr(colon + 1) : name);
    markers.names.push_back(name);
  }
  if (prefixed && bare.size() == columns.size()) {
    for (std::string& name : markers.names) {
      const std::size_t colon = name.rfind(':');
      if (colon != std::string::npos && colon > 0 && colon + 1 < name.size())
        name.erase(0, colon + 1);
    }
    repairs.push_back({0, "the subject's prefix ('subject:marker') is left out of the names"});
  } else if (prefixed) {
    repairs.push_back(
        {0, "names keep their subject's prefix, since without it some would be the same"});
  }

  markers.positions_m.resize(frames, static_cast<Eigen::Index>(3 * columns.size()));
  constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
  const double to_m = unit->to_si;
  Eigen::Index zeros = 0;
  Eigen::Index zero_frame = 0;
  for (Eigen::Index begin = 0; begin < frames; begin += kBlock) {
    const Eigen::Index end = std::min(frames, begin + kBlock);
    for (std::size_t m = 0; m < columns.size(); ++m) {
      const Eigen::Index from = 4 * columns[m];
      const auto to = static_cast<Eigen::Index>(3 * m);
      for (Eigen::Index k = begin; k < end; ++k) {
        const float* const p = &file.points(k, from);
        const bool zero = p[0] == 0.0F && p[1] == 0.0F && p[2] == 0.0F;
        const bool measured = p[3] >= 0.0F && std::isfinite(p[0]) && std::isfinite(p[1]) &&
                              std::isfinite(p[2]) && !zero;
        if (zero && p[3] >= 0.0F && zeros++ == 0) zero_frame = k;
        for (Eigen::Index axis = 0; axis < 3; ++axis)
          markers.positions_m(k, to + axis) = measured ? to_m * static_cast<double>(p[axis]) : kGap;
      }
    }
  }
  if (zeros > 0) {
    repairs.push_back({0, fmt::format("{} positions are exactly 0 0 0 though not marked as missing "
                                      "(the first in frame {}); taken as missing",
                                      zeros, file.first_frame + zero_frame)});
  }
  return markers;
}

TimeSeries c3d_analog(const C3dFile& file, const std::vector<Eigen::Index>& columns) {
  std::vector<Eigen::Index> chosen = columns;
  if (chosen.empty()) {
    for (Eigen::Index c = 0; c < file.analog.cols(); ++c) chosen.push_back(c);
  }
  if (chosen.empty() || file.analog.rows() == 0)
    throw InvalidInput("the C3D file holds no analog channels");
  const Eigen::Index samples = file.analog.rows();
  const double start = static_cast<double>(file.first_frame - 1) * file.analog_per_frame;
  Eigen::VectorXd time(samples);
  for (Eigen::Index i = 0; i < samples; ++i)
    time[i] = (start + static_cast<double>(i)) / file.analog_rate_hz();
  std::vector<Channel> channels;
  Eigen::MatrixXd values(samples, static_cast<Eigen::Index>(chosen.size()));
  std::vector<double> to_si;
  for (const Eigen::Index c : chosen) {
    const C3dChannel& channel = file.channels[static_cast<std::size_t>(c)];
    const auto unit = parse_c3d_unit(channel.unit_text);
    channels.push_back({channel.name, unit ? unit->unit : Unit::dimensionless});
    to_si.push_back(unit ? unit->to_si : 1.0);
  }
  for (Eigen::Index begin = 0; begin < samples; begin += kBlock) {
    const Eigen::Index end = std::min(samples, begin + kBlock);
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      const C3dChannel& channel = file.channels[static_cast<std::size_t>(chosen[k])];
      for (Eigen::Index i = begin; i < end; ++i) {
        values(i, static_cast<Eigen::Index>(k)) =
            (static_cast<double>(file.analog(i, chosen[k])) - channel.offset) * channel.scale *
            to_si[k];
      }
    }
  }
  return {std::move(time), std::move(channels), std::move(values)};
}

}  // namespace myoid::recording
