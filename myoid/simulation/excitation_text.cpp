#include "myoid/simulation/excitation_text.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"
#include "myoid/files/text_file.h"

namespace myoid::simulation {
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
        fmt::format("--excite '{}': expected MUSCLE=LEVEL, MUSCLE=LEVEL@START or MUSCLE=LEVEL@START+DURATION "
                    "(level 0 to 1, seconds), such as BIC=0.3@0.2+0.25",
                    text));
  };
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) throw bad();
  const std::size_t at = text.find('@', equals);
  const std::size_t plus = at == std::string::npos ? at : text.find('+', at);
  const auto number = [&](std::size_t from, std::size_t to) {
    const auto value =
        recording::parse_number(std::string_view(text).substr(from, to == std::string::npos ? to : to - from));
    if (!value || !std::isfinite(*value)) throw bad();
    return *value;
  };
  Excitation e{.muscle = text.substr(0, equals), .level = number(equals + 1, at)};
  if (at != std::string::npos) e.start_s = number(at + 1, plus);
  if (plus != std::string::npos) e.duration_s = number(plus + 1, std::string::npos);
  if (!(e.level >= 0.0 && e.level <= 1.0) || (e.duration_s && !(*e.duration_s > 0.0))) throw bad();
  return e;
}

}  // namespace

std::vector<simulation::Signal> described_excitations(const std::vector<std::string>& texts,
                                                      double rest,
                                                      const std::vector<std::string>& muscles) {
  std::vector<Excitation> list;
  for (const std::string& text : texts) {
    list.push_back(parse_excitation(text));
    const std::string& name = list.back().muscle;
    if (name != "all" && std::find(muscles.begin(), muscles.end(), name) == muscles.end()) {
      throw InvalidInput(
          fmt::format("--excite {}: the model has no such muscle; there are {}", name, fmt::join(muscles, ", ")));
    }
  }
  std::vector<simulation::Signal> result;
  for (const std::string& muscle : muscles) {
    double level = rest;
    std::vector<simulation::Burst> bursts;
    for (const Excitation& e : list) {
      if (e.muscle != "all" && e.muscle != muscle) continue;
      if (e.start_s) {
        bursts.push_back({*e.start_s, e.duration_s.value_or(1e9), e.level});
      } else {
        level = e.level;
      }
    }
    std::sort(bursts.begin(), bursts.end(), [](const auto& a, const auto& b) { return a.start_s < b.start_s; });
    result.push_back(simulation::bursts(bursts, level));
  }
  return result;
}

}  // namespace myoid::simulation
