#include "myoid/recording/channel_choice.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/clock_facts.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/files/label_match.h"
#include "myoid/recording/tables/instrument_names.h"

namespace myoid::recording {
namespace {

struct Found {
  std::size_t clock = 0;
  std::string name;  ///< As written in the file.
};

std::vector<std::string> names_of(const AnalogChannels& channels) {
  std::vector<std::string> names;
  for (const Channel& channel : channels.channels()) names.push_back(channel.name);
  return names;
}

std::string listed(const std::vector<std::string>& names, std::size_t most = 40) {
  const std::size_t shown = std::min(most, names.size());
  return fmt::format("{}{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                     shown < names.size() ? ", ..." : "");
}

std::optional<std::size_t> clock_of(const std::vector<const AnalogChannels*>& clocks, const std::string& name) {
  for (std::size_t k = 0; k < clocks.size(); ++k) {
    if (clocks[k]->find(name)) return k;
  }
  return std::nullopt;
}

Found find(const std::vector<const AnalogChannels*>& clocks,
           const std::string& wanted,
           const std::filesystem::path& path) {
  if (const auto clock = clock_of(clocks, wanted)) return {*clock, wanted};
  std::vector<std::string> names;
  for (const AnalogChannels* clock : clocks) {
    for (std::string& name : names_of(*clock)) names.push_back(std::move(name));
  }
  const LabelMatch match = match_labels(names, {wanted});
  if (!match.same.empty()) {
    const std::string& name = match.same.begin()->first;
    return {*clock_of(clocks, name), name};
  }
  throw ReadError(path, 0, "no channel '{}'{}; there are: {}", wanted, did_you_mean(wanted, names),
                  names.empty() ? "none" : listed(names));
}

std::string described(const AnalogChannels& channels) {
  const auto rate_hz = clock_facts(channels.time_s()).rate_hz;
  return fmt::format("{} ({})", listed(names_of(channels)), rate_hz ? fmt::format("{:.6g} Hz", *rate_hz) : "no rate");
}

}  // namespace

TimeSeries choose_channels(const std::vector<const AnalogChannels*>& clocks,
                           const std::vector<std::string>& wanted,
                           const std::filesystem::path& path) {
  if (wanted.empty()) return clocks.empty() ? TimeSeries() : clocks.front()->series();
  std::vector<std::string> names;
  std::optional<std::size_t> clock;
  for (const std::string& one : wanted) {
    Found found = find(clocks, one, path);
    if (clock && *clock != found.clock) {
      throw ReadError(path, 0,
                      "channels '{}' and '{}' have different clocks; ask for channels of one clock at a time: either "
                      "of {} or of {}",
                      names.front(), found.name, described(*clocks[*clock]), described(*clocks[found.clock]));
    }
    clock = found.clock;
    if (std::find(names.begin(), names.end(), found.name) == names.end()) names.push_back(std::move(found.name));
  }
  return clocks[*clock]->select(names);
}

std::string first_clock_alone(const std::vector<std::string>& left_out) {
  constexpr std::size_t kNamed = 6;
  return fmt::format(
      "only the channels of the first clock are taken, without {}; `emg` and `convert` take others by --channel",
      listed(left_out, kNamed));
}

std::string gaps_of(const TimeSeries& series, Eigen::Index column) {
  const auto x = series.values().col(column);
  const Eigen::Index gaps = (!x.array().isFinite()).count();
  if (gaps == 0) return "";
  Eigen::Index first = 0;
  while (std::isfinite(x[first])) ++first;
  return fmt::format("is not a number at {:.6g} s ({} {}{})", series.time_s()[first], gaps,
                     gaps == 1 ? "sample" : "samples", gap_text(series.channels()[static_cast<std::size_t>(column)]));
}

TimeSeries without_gaps(const TimeSeries& series, std::vector<Repair>& repairs) {
  std::vector<std::string> whole;
  for (Eigen::Index c = 0; c < series.channel_count(); ++c) {
    const std::string& name = series.channels()[static_cast<std::size_t>(c)].name;
    const std::string gaps = gaps_of(series, c);
    if (gaps.empty()) {
      whole.push_back(name);
    } else {
      note(repairs, "channel '{}' {}; it is left out", name, gaps);
    }
  }
  return static_cast<Eigen::Index>(whole.size()) == series.channel_count() ? series : series.select(whole);
}

std::vector<std::string> emg_channels(const std::vector<Channel>& channels, const std::vector<PlateSetup>& plates) {
  std::vector<bool> of_plate(channels.size(), false);
  for (const PlateSetup& plate : plates) {
    for (const Eigen::Index column : plate.channels) {
      if (column >= 0 && static_cast<std::size_t>(column) < of_plate.size())
        of_plate[static_cast<std::size_t>(column)] = true;
    }
  }
  std::vector<std::string> names;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (channels[c].unit == Unit::volt && !of_plate[c] && !named_as_no_emg(channels[c].name))
      names.push_back(channels[c].name);
  }
  return names;
}

}  // namespace myoid::recording
