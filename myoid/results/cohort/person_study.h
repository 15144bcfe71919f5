#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/results/cohort/manifest.h"
#include "myoid/study/study.h"

namespace myoid::results {

/// Fills a template: {name}, {label} and {COLUMN} for each further column of the manifest become
/// the person's own. `file` is the template's place, for messages. Throws ReadError with the line
/// for a word in braces that no column has, and for a column without a value for this person.
[[nodiscard]] std::string filled_study(std::string_view text, const std::filesystem::path& file, const Person& person);

/// The trials of a study that are used, by entities in the names of their recordings as BIDS has them: "ses" of {"01"},
/// "task" of {"lift", "mvc"}. Empty: all trials.
using BidsFilter = std::map<std::string, std::vector<std::string>, std::less<>>;

/// Adds the filter file of a BIDS App: {"motion": {"session": "01", "task": ["lift", "mvc"]}}. Throws ReadError for
/// other contents.
void add_bids_filter(const std::filesystem::path& file, BidsFilter& filter);

/// Returns true if no recording of the trial has another value of an entity of the filter.
[[nodiscard]] bool passes(const study::TrialSpec& trial, const BidsFilter& filter);

/// Returns the study file of a person: the one that the manifest names, or, if that file is a
/// template or a filter is given, `study.toml` in `folder`, which this function writes where its text differs. Paths in
/// a template are relative to the template. Throws ReadError as `filled_study` and `read_study` do, and where the
/// filter leaves no trial.
[[nodiscard]] std::filesystem::path person_study(const Person& person,
                                                 const std::filesystem::path& folder,
                                                 const BidsFilter& filter = {});

}  // namespace myoid::results
