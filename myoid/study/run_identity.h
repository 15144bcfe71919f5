#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/study/study.h"

namespace myoid {

/// Person and model of a result. The numbers of two results can be compared where both have the
/// same person and model.
struct RunIdentity {
  bool known = false;  ///< False: a result of `myoid identify`, which has neither person nor model.
  std::string subject;
  std::optional<double> mass_kg;
  std::string sex;
  std::string model;         ///< File, or name of the built-in one.
  std::string model_sha256;  ///< Of the file; empty where there is none.
  std::vector<std::string> coordinates, muscles;
};

/// Returns the identity of a study. Throws ReadError if its model's file cannot be read.
[[nodiscard]] RunIdentity identity_of(const Study& study);

/// Returns the identity of a folder's parameters.json. Throws ReadError if there is none.
[[nodiscard]] RunIdentity read_run_identity(const std::filesystem::path& folder);

struct IdentityDifferences {
  /// Model or coordinates differ, or no muscle is common: the numbers mean different things.
  std::vector<std::string> grave;
  std::vector<std::string> other;  ///< Subject, mass, sex, muscles that only one has.
};
/// Compares the facts that both state, in sentences: "the model is arm4 here, wu.osim there".
[[nodiscard]] IdentityDifferences differences(const RunIdentity& here, const RunIdentity& there);

}  // namespace myoid
