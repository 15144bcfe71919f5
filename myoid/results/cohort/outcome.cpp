#include "myoid/results/cohort/outcome.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/build_identity.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/byte_source.h"
#include "myoid/ground/files/result_record.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::results {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kFile = "outcome.json";

bool is_unchanged(const InputFile& input) {
  try {
    return sha256(read_bytes(input.path)) == input.sha256;
  } catch (const InvalidInput&) {
    return false;
  }
}

}  // namespace

namespace {

std::optional<Outcome> parse_outcome(const std::string& text) {
  try {
    const auto content = parse_ordered_json(text);
    const auto kind = choice_named<OutcomeKind>(content.at("outcome").get<std::string>());
    const auto kept = choice_named<page::Kept>(content.at("kept").get<std::string>());
    if (!kind || !kept) return std::nullopt;
    Outcome outcome{.kind = *kind,
                    .message = content.at("message").get<std::string>(),
                    .build = content.at("build").get<std::string>(),
                    .kept = *kept,
                    .inputs = {}};
    for (const ordered_json& input : content.at("inputs"))
      outcome.inputs.push_back({input.at("path").get<std::string>(), input.at("sha256").get<std::string>()});
    return outcome;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<Outcome> read_outcome(const fs::path& folder) {
  try {
    return parse_outcome(read_text_file(folder / kFile));
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
}

std::optional<Outcome> recorded_outcome(const fs::path& folder) {
  const std::optional<std::string> text = recorded_content(folder / kFile);
  return text ? parse_outcome(*text) : std::nullopt;
}

void write_outcome(const Outcome& outcome, const fs::path& folder) {
  ordered_json record{{"outcome", std::string(choice_name(outcome.kind))},
                      {"message", outcome.message},
                      {"build", outcome.build},
                      {"kept", std::string(choice_name(outcome.kept))},
                      {"inputs", ordered_json::array()}};
  for (const InputFile& input : outcome.inputs)
    record["inputs"].push_back({{"path", input.path}, {"sha256", input.sha256}});
  write_file(folder / kFile, json_text(record) + "\n");
}

void remove_outcome(const fs::path& folder) { remove_result(folder / kFile); }

bool is_current(const Outcome& outcome, const fs::path& study) {
  const auto& inputs = outcome.inputs;
  return outcome.kind != OutcomeKind::failed && outcome.build == build_identity() &&
         std::ranges::any_of(inputs, [&](const InputFile& input) { return input.path == study.string(); }) &&
         std::ranges::all_of(inputs, is_unchanged);
}

std::vector<std::string> failures(const std::vector<PersonOutcome>& outcomes) {
  std::vector<std::string> lines;
  for (const PersonOutcome& each : outcomes) {
    if (!each.outcome) {
      lines.push_back(fmt::format("{}: not computed yet; give the same command again", each.person));
    } else if (each.outcome->kind == OutcomeKind::failed) {
      lines.push_back(fmt::format("{}: {}", each.person, each.outcome->message));
    }
  }
  return lines;
}

}  // namespace myoid::results
