#include "myoid/body/simulation/excitation.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::body {

void validate(const Signal& signal, std::string_view what) {
  const auto& t = signal.time_s;
  if (t.empty() || t.size() != signal.value.size()) {
    throw InvalidInput(fmt::format("{}: {} times and {} values, expected as many of both, at least one", what, t.size(),
                                   signal.value.size()));
  }
  for (std::size_t k = 0; k < t.size(); ++k) {
    if (!std::isfinite(t[k]) || !std::isfinite(signal.value[k])) {
      throw InvalidInput(
          fmt::format("{}: node {} is {} at {} s, expected finite numbers", what, k, signal.value[k], t[k]));
    }
    if (k > 0 && t[k] < t[k - 1])
      throw InvalidInput(fmt::format("{}: time goes back from {} to {} s", what, t[k - 1], t[k]));
    if (k > 1 && t[k] == t[k - 2])
      throw InvalidInput(fmt::format("{}: more than two nodes at {} s; two make a jump", what, t[k]));
  }
}

void validate_excitation(const Signal& signal, std::string_view what) {
  validate(signal, what);
  for (std::size_t k = 0; k < signal.value.size(); ++k) {
    if (!(signal.value[k] >= 0.0 && signal.value[k] <= 1.0)) {
      throw InvalidInput(fmt::format(
          "{}: excitation {:.6g} at {:.6g} s, expected 0 to 1; divide by the value of a maximal effort first", what,
          signal.value[k], signal.time_s[k]));
    }
  }
}

double value_at(const Signal& signal, double time_s) {
  const auto& t = signal.time_s;
  const auto after = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), time_s) - t.begin());
  if (after == 0) return signal.value.front();
  if (after == t.size()) return signal.value.back();
  const double share = (time_s - t[after - 1]) / (t[after] - t[after - 1]);
  return signal.value[after - 1] + share * (signal.value[after] - signal.value[after - 1]);
}

std::vector<double> jumps(const Signal& signal) {
  std::vector<double> result;
  for (std::size_t k = 1; k < signal.time_s.size(); ++k) {
    if (signal.time_s[k] == signal.time_s[k - 1] && signal.value[k] != signal.value[k - 1])
      result.push_back(signal.time_s[k]);
  }
  return result;
}

Signal constant(double value) { return {{0.0}, {value}}; }

Signal bursts(std::span<const Burst> list, double rest) {
  Signal signal;
  const auto add = [&](double t, double v) {
    signal.time_s.push_back(t);
    signal.value.push_back(v);
  };
  for (const Burst& burst : list) {
    if (!(burst.duration_s > 0.0)) {
      throw InvalidInput(
          fmt::format("burst at {} s: its duration is {} s, expected more than 0", burst.start_s, burst.duration_s));
    }
    if (!signal.time_s.empty() && burst.start_s <= signal.time_s.back()) {
      throw InvalidInput(
          fmt::format("burst at {} s begins before the last one ends ({} s)", burst.start_s, signal.time_s.back()));
    }
    add(burst.start_s, rest);
    add(burst.start_s, burst.level);
    add(burst.start_s + burst.duration_s, burst.level);
    add(burst.start_s + burst.duration_s, rest);
  }
  if (signal.time_s.empty()) add(0.0, rest);
  return signal;
}

Signal step(double start_s, double level, double rest) { return {{start_s, start_s}, {rest, level}}; }

namespace {

/// NAME=LEVEL, NAME=LEVEL@START or NAME=LEVEL@START+DURATION.
struct Excitation {
  std::string muscle;
  double level = 0.0;
  std::optional<double> start_s, duration_s;
};

Excitation parse_excitation(const std::string& text) {
  const auto bad = [&] {
    return InvalidInput(
        fmt::format("--excite '{}': expected MUSCLE=LEVEL, MUSCLE=LEVEL@START or MUSCLE=LEVEL@START+DURATION (level 0 "
                    "to 1, seconds), such as BIC=0.3@0.2+0.25",
                    text));
  };
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) throw bad();
  const std::size_t at = text.find('@', equals);
  const std::size_t plus = at == std::string::npos ? at : text.find('+', at);
  const auto number = [&](std::size_t from, std::size_t to) {
    const auto value = parse_number(std::string_view(text).substr(from, to == std::string::npos ? to : to - from));
    if (!value || !std::isfinite(*value)) throw bad();
    return *value;
  };
  Excitation e{.muscle = text.substr(0, equals), .level = number(equals + 1, at)};
  if (at != std::string::npos) e.start_s = number(at + 1, plus);
  if (plus != std::string::npos) e.duration_s = number(plus + 1, std::string::npos);
  if (!(e.level >= 0.0 && e.level <= 1.0) || (e.duration_s && !(*e.duration_s > 0.0))) throw bad();
  return e;
}

std::optional<Eigen::Index> channel_of(const TimeSeries& series, const std::string& muscle) {
  for (const std::string& name : {muscle, muscle + ".excitation", muscle + "_excitation"}) {
    if (const auto found = series.find(name)) return found;
  }
  for (Eigen::Index c = 0; c < series.channel_count(); ++c) {
    const std::string& name = series.channels()[static_cast<std::size_t>(c)].name;
    if (name.ends_with("/" + muscle) || name.ends_with("/" + muscle + "/excitation")) return c;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Signal> excitations_from(const TimeSeries& series, std::span<const std::string> names) {
  if (series.empty()) throw InvalidInput("excitations: no samples");
  std::vector<Signal> result;
  for (const std::string& name : names) {
    const auto column = channel_of(series, name);
    if (!column) {
      throw InvalidInput(fmt::format("excitations: no channel for muscle '{}'{}", name,
                                     not_among(name, series.channels(), &Channel::name)));
    }
    Signal signal;
    signal.time_s.assign(series.time_s().begin(), series.time_s().end());
    const Eigen::VectorXd values = series.values().col(*column);
    signal.value.assign(values.begin(), values.end());
    validate_excitation(signal, "excitations of " + name);
    result.push_back(std::move(signal));
  }
  return result;
}

std::vector<Signal> described_excitations(const std::vector<std::string>& texts,
                                          double rest,
                                          const std::vector<std::string>& muscles) {
  std::vector<Excitation> list;
  for (const std::string& text : texts) {
    list.push_back(parse_excitation(text));
    const std::string& name = list.back().muscle;
    if (name != "all" && std::find(muscles.begin(), muscles.end(), name) == muscles.end()) {
      throw InvalidInput(fmt::format("--excite {}: the model has no such muscle{}", name, not_among(name, muscles)));
    }
  }
  std::vector<Signal> result;
  for (const std::string& muscle : muscles) {
    double level = rest;
    std::vector<Burst> bursts;
    for (const Excitation& e : list) {
      if (e.muscle != "all" && e.muscle != muscle) continue;
      if (e.start_s) {
        bursts.push_back({*e.start_s, e.duration_s.value_or(1e9), e.level});
      } else {
        level = e.level;
      }
    }
    std::sort(bursts.begin(), bursts.end(), [](const auto& a, const auto& b) { return a.start_s < b.start_s; });
    result.push_back(body::bursts(bursts, level));
  }
  return result;
}

}  // namespace myoid::body
