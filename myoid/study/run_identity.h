#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "myoid/study/study.h"

namespace myoid::study {

/// A file of a recording that a run rests on.
struct RecordedFile {
  std::string name, sha256;
};

/// Person and model of a result. The numbers of two results are comparable if person and model are the same.
struct RunIdentity {
  bool known = false;  ///< False: of a study without a body, as that of `identify`: person and model are not stated.
  std::string subject;
  std::optional<double> mass_kg;
  std::string sex;
  std::string model;         ///< File, or name of the built-in one.
  std::string model_sha256;  ///< Hash of the file; empty without a file.
  std::vector<std::string> coordinates, muscles;
  std::vector<RecordedFile> recordings;  ///< Of a run; a study alone has none.
  /// Settings by their names, "muscle BRA emg", as text.
  std::map<std::string, std::string> settings;
};

/// Returns the names of the recordings of `here` whose content `there` has, too.
[[nodiscard]] std::vector<std::string> common_recordings(const RunIdentity& here, const RunIdentity& there);

/// Returns true if both runs rest on one recording: more than half of the files of the run with fewer are common.
[[nodiscard]] bool of_one_recording(const RunIdentity& here, const RunIdentity& there);

/// Returns the names of the settings in which two runs differ, but for paths of files.
[[nodiscard]] std::vector<std::string> differing_settings(const RunIdentity& here, const RunIdentity& there);

/// Returns the identity of a study. Throws ReadError if its model's file cannot be read.
[[nodiscard]] RunIdentity identity_of(const Study& study);

/// Returns the identity of a folder's parameters.json. Throws ReadError if there is none.
[[nodiscard]] RunIdentity read_run_identity(const std::filesystem::path& folder);

/// Whose results are compared: one person's, or those of several persons, who differ in body, model and name.
enum class Whose { one_person, several_persons };

struct IdentityDifferences {
  /// Model or coordinates differ, or no muscle is common: the numbers mean different things.
  std::vector<std::string> grave;
  std::vector<std::string> other;  ///< Subject, mass, sex, and muscles that only one result has.
};
/// Compares the facts that both results state, in sentences: "the model is arm4 here, wu.osim there". Of several
/// persons only coordinates and muscles, and recordings that both have, which count as grave.
[[nodiscard]] IdentityDifferences differences(const RunIdentity& here,
                                              const RunIdentity& there,
                                              Whose whose = Whose::one_person);

}  // namespace myoid::study
