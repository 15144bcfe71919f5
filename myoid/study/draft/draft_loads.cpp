#include "myoid/study/draft/draft_loads.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/files/label_match.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::study {
namespace {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// The number that begins at a place of a name: digits with one '.', ',' or 'p' among them.
struct NumberAt {
  std::size_t begin = 0, end = 0;
  std::optional<double> value;
};

NumberAt number_at(const std::string& name, std::size_t at) {
  std::size_t end = at;
  bool point = false;
  std::string text;
  for (; end < name.size(); ++end) {
    const bool separator = (name[end] == '.' || name[end] == ',' || name[end] == 'p') && !point && end > at &&
                           end + 1 < name.size() && is_digit(name[end + 1]);
    if (!is_digit(name[end]) && !separator) break;
    point = point || separator;
    text += separator ? '.' : name[end];
  }
  return {at, end, parse_number(text)};
}

/// Returns the unit that follows a number: "kg" of "2.5 kg_slow".
std::string unit_behind(const std::string& name, std::size_t end) {
  while (end < name.size() && (name[end] == ' ' || name[end] == '_' || name[end] == '-')) ++end;
  for (const std::string_view word : {"kg", "lbs", "lb"}) {
    const std::size_t behind = end + word.size();
    if (name.compare(end, word.size(), word) == 0 && (behind >= name.size() || !is_letter(name[behind])))
      return word == "kg" ? "kg" : "lb";
  }
  return "";
}

/// Returns true if a word for a mass stands before the number: "load" of "load5p5".
bool load_before(const std::string& name, std::size_t begin) {
  while (begin > 0 && (name[begin - 1] == ' ' || name[begin - 1] == '_' || name[begin - 1] == '-')) --begin;
  const std::string_view before = std::string_view(name).substr(0, begin);
  return std::ranges::any_of(std::array<std::string_view, 5>{"load", "weight", "mass", "held", "dumbbell"},
                             [&](std::string_view word) { return before.ends_with(word); });
}

double spread(const std::vector<double>& values) {
  if (values.size() < 10) return std::numeric_limits<double>::infinity();
  double sum = 0.0, squares = 0.0;
  for (const double v : values) sum += v;
  const double mean = sum / static_cast<double>(values.size());
  for (const double v : values) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / static_cast<double>(values.size()));
}

/// Returns the standard deviation of the distance of two markers.
double distance_spread_m(const MarkerSeries& markers, Eigen::Index a, Eigen::Index b) {
  constexpr Eigen::Index kFrames = 200;
  const Eigen::Index step = std::max<Eigen::Index>(1, markers.frame_count() / kFrames);
  std::vector<double> distances;
  for (Eigen::Index i = 0; i < markers.frame_count(); i += step) {
    if (!markers.missing(i, a) && !markers.missing(i, b))
      distances.push_back((markers.position(i, a) - markers.position(i, b)).norm());
  }
  return spread(distances);
}

/// Returns true for a point that a gait model computes: Plug-in Gait writes the axes of each segment as four points,
/// whose names are the segment's with O, A, L and P (RTIO, RTIA, RTIL, RTIP).
bool is_segment_axis(const std::string& name, const std::set<std::string>& all) {
  constexpr std::string_view kAxes = "OALP";
  if (name.size() < 2 || kAxes.find(name.back()) == std::string_view::npos) return false;
  return std::ranges::all_of(kAxes, [&](char axis) { return all.contains(name.substr(0, name.size() - 1) + axis); });
}

std::string plain(const std::string& name) { return plain_label(name); }

bool has_word(const std::string& name, std::initializer_list<std::string_view> words) {
  const std::string text = plain(name);
  return std::ranges::any_of(words, [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

}  // namespace

double NamedMass::kg() const {
  constexpr double kPound_kg = 0.45359237;
  return unit == "lb" ? std::round(1000.0 * kPound_kg * value) / 1000.0 : value;
}

std::optional<NamedMass> mass_in_name(const std::string& name) {
  constexpr double kMost = 100.0;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (!is_digit(name[i])) continue;
    const NumberAt number = number_at(name, i);
    std::string unit = unit_behind(name, number.end);
    const bool told = !unit.empty() || load_before(name, number.begin);
    if (told && number.value && *number.value >= 0.0 && *number.value <= kMost)
      return NamedMass{*number.value, std::move(unit)};
    i = std::max(i, number.end - 1);
  }
  return std::nullopt;
}

std::vector<std::string> object_markers(const MarkerSeries& markers, const body::BodyModel& model) {
  constexpr double kRigid_m = 0.0025, kApart_m = 0.02;
  constexpr std::size_t kMost = 60;
  std::vector<Eigen::Index> known, unknown;
  const std::set<std::string> names_of_all(markers.names.begin(), markers.names.end());
  for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
    const std::string& name = markers.names[static_cast<std::size_t>(m)];
    if (!is_segment_axis(name, names_of_all)) (model.find_marker(name) ? known : unknown).push_back(m);
  }
  if (known.empty() || unknown.size() < 3 || unknown.size() > kMost) return {};
  std::vector<Eigen::Index> best;
  for (const Eigen::Index first : unknown) {
    std::vector<Eigen::Index> body{first};
    for (const Eigen::Index other : unknown) {
      if (other != first && std::ranges::all_of(body, [&](Eigen::Index own) {
            return distance_spread_m(markers, own, other) < kRigid_m;
          }))
        body.push_back(other);
    }
    if (body.size() <= std::max<std::size_t>(2, best.size())) continue;
    const bool of_the_person =
        std::ranges::any_of(known, [&](Eigen::Index own) { return distance_spread_m(markers, own, first) < kApart_m; });
    if (!of_the_person) best = std::move(body);
  }
  std::ranges::sort(best);
  std::vector<std::string> names;
  for (const Eigen::Index m : best) names.push_back(markers.names[static_cast<std::size_t>(m)]);
  return names;
}

std::vector<std::string> load_channels(const TimeSeries& analog, const std::vector<recording::PlateSetup>& plates) {
  const bool named_emg =
      std::ranges::any_of(analog.channels(), [](const Channel& c) { return has_word(c.name, {"emg"}); });
  std::vector<std::string> found;
  for (Eigen::Index c = 0; c < analog.channel_count(); ++c) {
    const Channel& channel = analog.channels()[static_cast<std::size_t>(c)];
    const bool of_plate = std::ranges::any_of(plates, [&](const recording::PlateSetup& plate) {
      return std::ranges::find(plate.channels, c) != plate.channels.end();
    });
    const bool other =
        has_word(channel.name, {"emg", "acc", "gyr", "mag", "sync", "trig", "foot", "switch", "time", "frame"});
    const bool force = channel.unit == Unit::newton || channel.unit == Unit::newton_meter ||
                       has_word(channel.name, {"force", "moment", "torque", "load", "cell", "handle"});
    const auto values = analog.values().col(c);
    const bool varies = values.size() > 0 && values.maxCoeff() > values.minCoeff();
    if (!of_plate && !other && varies && (force || (named_emg && channel.unit == Unit::volt)))
      found.push_back(channel.name);
  }
  return found;
}

bool only_torques(const TimeSeries& analog, const std::vector<std::string>& names) {
  return !names.empty() && std::ranges::all_of(names, [&](const std::string& name) {
    const auto column = analog.find(name);
    return column && analog.channels()[static_cast<std::size_t>(*column)].unit == Unit::newton_meter;
  });
}

std::string question_of_torques(const std::vector<std::string>& files, const std::string& coordinate) {
  const std::string others = files.size() > 1 ? fmt::format(" and {} more", files.size() - 1) : "";
  return fmt::format(
      "{}{}: torque in N m, of no joint by its name. Of a dynamometer? Call its column '{}_moment [Nm]' (the torque on "
      "the "
      "body) and that of the angle '{} [deg]' (a held posture is a column of one angle), both positive in the "
      "direction "
      "of {}; init then makes trials of such files",
      files.front(), others, coordinate, coordinate, coordinate);
}

void ask_for_loads(const std::string& stem, const LoadHints& hints, bool own_model, bool& asked, DraftText& out) {
  std::vector<std::string> objects = hints.object_markers;
  std::vector<std::string> channels = hints.channels;
  constexpr std::size_t kNamed = 8;
  objects.resize(std::min(objects.size(), kNamed));
  channels.resize(std::min(channels.size(), kNamed));
  const std::optional<NamedMass> mass = mass_in_name(stem);
  const std::string answer = mass ? fmt::format("# held_mass_kg = {}", mass->kg()) : "# held_mass_kg = 0.0";
  if (!objects.empty())
    out.todo(fmt::format("{} move as one rigid body that is not the person's: was it held, and how heavy is it?",
                         fmt::join(objects, ", ")),
             answer);
  if (!channels.empty())
    out.todo(fmt::format("{} {} of no force plate{}", fmt::join(channels, ", "), channels.size() == 1 ? "is" : "are",
                         hints.only_torques ? ", in N m: a dynamometer? Then external_torque names a table with it as "
                                              "<coordinate>_moment, which myoid convert writes"
                                            : ": a load cell? Then [load_cell] and load_cell say how it acts"));
  const std::string where = own_model ? " Then [model] held_mass must say where it acts" : "";
  if (mass) {
    const std::string unit = mass->unit.empty() ? " without a unit (kg? lb?)" : " " + mass->unit;
    out.todo(fmt::format("the name says {}{}: held in the hand?{}", mass->value, unit, mass->kg() > 0.0 ? where : ""),
             answer);
  } else if (!asked) {
    out.todo(fmt::format("what was held, carried or pushed in each trial? Take the # away; 0: nothing.{}{} Forces that "
                         "were measured: external_loads, force_plates, load_cell, external_torque",
                         where, where.empty() ? "" : "."),
             answer);
  }
  out.line(answer);
  asked = true;
}

}  // namespace myoid::study
