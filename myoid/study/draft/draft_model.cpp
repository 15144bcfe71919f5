#include "myoid/study/draft/draft_model.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>

#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/label_match.h"
#include "myoid/recording/recording.h"

namespace myoid::study {
namespace {

constexpr std::size_t kFilesWithMarkers = 3;

/// Returns the plain labels of the markers of the first recordings that have any.
std::set<std::string> marker_labels(const std::vector<std::filesystem::path>& files) {
  std::set<std::string> labels;
  std::size_t with_markers = 0;
  for (const std::filesystem::path& file : files) {
    if (with_markers == kFilesWithMarkers) break;
    try {
      const recording::Recording recording = recording::read_recording(file);
      for (const std::string& name : recording.markers.names) labels.insert(plain_label(name));
      with_markers += recording.markers.names.empty() ? 0 : 1;
    } catch (const InvalidInput&) {  // the draft names files that cannot be read
    }
  }
  return labels;
}

}  // namespace

ModelByMarkers model_of_markers(const std::vector<std::filesystem::path>& models,
                                const std::vector<std::filesystem::path>& files) {
  const std::set<std::string> labels = marker_labels(files);
  ModelByMarkers best;
  bool alone = false;
  for (const std::filesystem::path& path : models) {
    Eigen::Index known = 0;
    try {
      for (const body::Marker& marker : body::read_osim(path).markers)
        known += labels.contains(plain_label(marker.name)) ? 1 : 0;
    } catch (const InvalidInput&) {
      continue;
    }
    if (known > best.markers) {
      best = {path, known};
      alone = true;
    } else if (known == best.markers) {
      alone = false;
    }
  }
  return alone ? best : ModelByMarkers{};
}

bool is_of_a_leg(const std::vector<FoundRecording>& found) {
  constexpr std::array<std::string_view, 14> kWords{"asi", "psi",  "kne", "ank", "hee", "toe",   "thi",
                                                    "tib", "heel", "mtp", "mal", "cal", "troch", "foot"};
  std::set<std::string> legs;
  for (const FoundRecording& f : found) {
    for (const std::string& name : f.markers.names) {
      std::string plain = plain_label(name);
      if (plain.starts_with('l') || plain.starts_with('r')) plain.erase(0, 1);
      if (std::ranges::any_of(kWords, [&](std::string_view word) { return plain.starts_with(word); }))
        legs.insert(name);
    }
  }
  return legs.size() >= 4;
}

}  // namespace myoid::study
