#include "myoid/run/identify_files/muscle_columns.h"

#include <array>
#include <cctype>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/fit/measurement/parameters.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::run {
namespace {

/// Another name of a quantity, in small letters without signs.
struct Alias {
  std::string_view written, quantity;
};

constexpr std::string_view kSpeedInLengths = "max_contraction_velocity";

constexpr std::array kAliases = {
    Alias{"name", "muscle"},
    Alias{"musclename", "muscle"},
    Alias{"muscles", "muscle"},
    Alias{"muscletendonunit", "muscle"},
    Alias{"mtu", "muscle"},
    Alias{"channel", "emg"},
    Alias{"emgchannel", "emg"},
    Alias{"fmax", "max_isometric_force"},
    Alias{"fm0", "max_isometric_force"},
    Alias{"f0m", "max_isometric_force"},
    Alias{"fmo", "max_isometric_force"},
    Alias{"fom", "max_isometric_force"},
    Alias{"fiso", "max_isometric_force"},
    Alias{"maxforce", "max_isometric_force"},
    Alias{"maxisoforce", "max_isometric_force"},
    Alias{"maximumisometricforce", "max_isometric_force"},
    Alias{"peakisometricforce", "max_isometric_force"},
    Alias{"lm0", "optimal_fiber_length"},
    Alias{"l0m", "optimal_fiber_length"},
    Alias{"lmo", "optimal_fiber_length"},
    Alias{"lom", "optimal_fiber_length"},
    Alias{"l0", "optimal_fiber_length"},
    Alias{"lopt", "optimal_fiber_length"},
    Alias{"lmopt", "optimal_fiber_length"},
    Alias{"ofl", "optimal_fiber_length"},
    Alias{"optimalfibrelength", "optimal_fiber_length"},
    Alias{"optimallength", "optimal_fiber_length"},
    Alias{"optfiberlength", "optimal_fiber_length"},
    Alias{"optfibrelength", "optimal_fiber_length"},
    Alias{"lts", "tendon_slack_length"},
    Alias{"lst", "tendon_slack_length"},
    Alias{"lt0", "tendon_slack_length"},
    Alias{"lslack", "tendon_slack_length"},
    Alias{"ltslack", "tendon_slack_length"},
    Alias{"tsl", "tendon_slack_length"},
    Alias{"pennationangleatoptimal", "pennation_angle"},
    Alias{"pennationangleatoptimalfiberlength", "pennation_angle"},
    Alias{"optimalpennationangle", "pennation_angle"},
    Alias{"pennation", "pennation_angle"},
    Alias{"alpha0", "pennation_angle"},
    Alias{"maxcontractionvelocity", kSpeedInLengths},
    Alias{"maximumcontractionvelocity", kSpeedInLengths},
};

std::string plain(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) result += small_letter(c);
  }
  return result;
}

/// Returns the program's own names of columns: the parameters, alone and with suffixes.
std::vector<std::string> own_names() {
  std::vector<std::string> names{"muscle", "emg", "without_emg", std::string(kSpeedInLengths)};
  for (const fit::ParameterField& field : fit::parameter_fields()) {
    if (field.scope != fit::Scope::muscle) continue;
    for (const char* suffix : {"", "_fixed", "_lower", "_upper", "_prior_sd"})
      names.push_back(std::string(field.name) + suffix);
  }
  return names;
}

/// The parts of a header such as "F_max [kN]".
struct Header {
  std::string word, unit;
};

Header split(const std::string& text) {
  const std::size_t open = text.find_first_of("[(");
  if (open == std::string::npos) return {text, ""};
  const std::size_t close = text.find_first_of("])", open);
  return {text.substr(0, open), text.substr(open + 1, close == std::string::npos ? close : close - open - 1)};
}

std::optional<std::string> quantity_of(const std::string& word, const std::vector<std::string>& names) {
  const std::string bare = plain(word);
  for (const std::string& name : names) {
    if (plain(name) == bare) return name;
  }
  for (const Alias& alias : kAliases) {
    if (alias.written == bare) return std::string(alias.quantity);
  }
  return std::nullopt;
}

/// Returns the factor to SI. Throws ReadError for a unit of another quantity.
double scale_of(const std::string& name,
                const Header& header,
                const recording::CsvTable& table,
                const std::filesystem::path& path) {
  if (header.unit.empty()) return 1.0;
  std::string parameter = name;
  for (const char* suffix : {"_lower", "_upper", "_prior_sd"}) {
    if (parameter.ends_with(suffix)) parameter.erase(parameter.size() - std::string_view(suffix).size());
  }
  for (const fit::ParameterField& field : fit::parameter_fields()) {
    if (field.name != parameter || field.scope != fit::Scope::muscle) continue;
    const auto found = parse_unit(header.unit);
    if (found && found->unit == field.unit) return found->to_si;
    throw ReadError(path, table.header_line,
                    fmt::format("column '{} [{}]': expected a unit of {}, such as [{}]", header.word, header.unit,
                                field.name, symbol(field.unit)));
  }
  return 1.0;
}

}  // namespace

std::map<std::string, MuscleColumn> muscle_columns(const recording::CsvTable& table,
                                                   const std::filesystem::path& path) {
  const std::vector<std::string> names = own_names();
  std::map<std::string, MuscleColumn> columns;
  for (std::size_t c = 0; c < table.names.size(); ++c) {
    const Header header = split(table.names[c]);
    const auto name = quantity_of(header.word, names);
    if (!name) {
      throw ReadError(
          path, table.header_line,
          fmt::format("unknown column '{}'{}; needed are muscle, max_isometric_force [N] and optimal_fiber_length [m]; "
                      "delete a column that is no number of the muscle. Known are {}",
                      table.names[c], did_you_mean(table.names[c], names), fmt::join(names, ", ")));
    }
    const bool by_length = *name == kSpeedInLengths;
    const MuscleColumn column{
        .index = c, .to_si = by_length ? 1.0 : scale_of(*name, header, table, path), .in_fiber_lengths = by_length};
    const std::string key = by_length ? "max_shortening_speed" : *name;
    if (!columns.emplace(key, column).second)
      throw ReadError(path, table.header_line, fmt::format("two columns give {}: leave one of them out", key));
  }
  for (const char* needed : {"muscle", "max_isometric_force", "optimal_fiber_length"}) {
    if (columns.contains(needed)) continue;
    throw ReadError(
        path, table.header_line,
        fmt::format("no column '{}'; found {}; write at least muscle,max_isometric_force,optimal_fiber_length (N, m)",
                    needed, fmt::join(table.names, ", ")));
  }
  return columns;
}

}  // namespace myoid::run
