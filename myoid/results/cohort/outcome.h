#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/ground/core/choice.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/page/write_report.h"
#include "myoid/results/cohort/manifest.h"

namespace myoid::results {

enum class OutcomeKind {
  done,
  gate_failed,    ///< Computed, but a quality gate failed.
  trials_failed,  ///< Computed without some of the trials.
  failed,         ///< Nothing was computed; the message says why.
};
inline constexpr std::string_view kOutcomeNames[] = {"done", "gate_failed", "trials_failed", "failed"};
constexpr ChoiceNames choice_names(OutcomeKind) { return kOutcomeNames; }

/// The end of one person's job. A job that was killed has no outcome.
struct Outcome {
  OutcomeKind kind = OutcomeKind::done;
  std::string message;  ///< Empty where all went well.
  std::string build;    ///< `build_identity` of the program.
  page::Kept kept = page::Kept::page;
  std::vector<InputFile> inputs;
};

/// Returns the content of outcome.json in a person's folder; empty if the file is absent or damaged.
[[nodiscard]] std::optional<Outcome> read_outcome(const std::filesystem::path& folder);
/// Returns the same from a folder that the command holds (ground/files/result_record.h), if nothing changed the file.
[[nodiscard]] std::optional<Outcome> recorded_outcome(const std::filesystem::path& folder);
void write_outcome(const Outcome& outcome, const std::filesystem::path& folder);
void remove_outcome(const std::filesystem::path& folder);

/// Returns true if the person need not be computed again: the same program read
/// the same bytes, the study among them, and computed results.
[[nodiscard]] bool is_current(const Outcome& outcome, const std::filesystem::path& study);

/// The outcomes of some persons, in the order of the persons.
struct PersonOutcome {
  std::string person;
  std::optional<Outcome> outcome;  ///< Empty: the person is not computed yet.
  bool reused = false;
};

/// Returns a sentence on each person that failed or is not computed.
[[nodiscard]] std::vector<std::string> failures(const std::vector<PersonOutcome>& outcomes);

}  // namespace myoid::results
