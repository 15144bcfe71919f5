#pragma once

#include <string>
#include <vector>

#include "myoid/study/draft/draft_recordings.h"

namespace myoid::study {

/// Returns for each recording the name of the person whom its name or its folders speak of, as `persons_in`; empty:
/// none.
[[nodiscard]] std::vector<std::string> person_of_each(const std::vector<FoundRecording>& found);

/// Returns the names of the persons that the names of the recordings or of their folders speak of: "sub-01" (BIDS), a
/// number after a word such as "subject"; else the numbers (with "S" or "P" before them) that stand alone as a folder
/// or begin a name, if two trials or more have each of them, as those of a protocol do; else the folders side by side
/// that share two names of recordings of markers or more ("Anna/lift.c3d", "Bob/lift.c3d"). In order, each once.
[[nodiscard]] std::vector<std::string> persons_in(const std::vector<FoundRecording>& found);

/// One person of several.
struct OnePerson {
  std::vector<std::string> all;       ///< The names of all persons; empty unless there are several.
  std::string kept;                   ///< Whose recordings stayed.
  std::vector<std::string> left_out;  ///< Names of the files that were taken out.
  /// Files that stayed and name nobody, beside more that name `kept`.
  std::vector<std::filesystem::path> unnamed;
};

/// Takes the recordings of all persons out of `found` but those of the person with most of them (of equals the first),
/// and those that name nobody.
OnePerson keep_one_person(std::vector<FoundRecording>& found);

}  // namespace myoid::study
