#pragma once

#include <string>
#include <vector>

#include "myoid/draft/draft_recordings.h"

namespace myoid {

/// Returns the names of the persons that the names of the recordings or of their folders speak of: "sub-01" (BIDS), a
/// number after a word such as "subject"; else the numbers (with "S" or "P" before them) that stand alone as a folder
/// or begin a name, if two trials or more have each of them, as those of a protocol do. In order, each once.
[[nodiscard]] std::vector<std::string> persons_in(const std::vector<FoundRecording>& found);

}  // namespace myoid
