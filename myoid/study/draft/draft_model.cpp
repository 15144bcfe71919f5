#include "myoid/study/draft/draft_model.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/label_match.h"
#include "myoid/recording/recording.h"
#include "myoid/study/draft/channel_muscles.h"

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

void leave_out_unreadable(std::vector<std::filesystem::path>& models, std::vector<Remark>& remarks) {
  std::erase_if(models, [&](const std::filesystem::path& model) {
    try {
      (void)body::read_osim(model);
      return false;
    } catch (const InvalidInput& error) {
      remarks.push_back({.code = RemarkCode::refused,
                         .severity = Severity::note,
                         .where = model.filename().string(),
                         .says = fmt::format("not read: {}", error.what())});
      return true;
    }
  });
}

ModelByMarkers model_of_markers(const std::vector<std::filesystem::path>& models,
                                const std::vector<std::filesystem::path>& files) {
  const std::set<std::string> labels = marker_labels(files);
  ModelByMarkers best;
  bool alone = false;
  for (const std::filesystem::path& path : models) {
    Eigen::Index known = 0;
    for (const body::Marker& marker : body::read_osim(path).markers)
      known += labels.contains(plain_label(marker.name)) ? 1 : 0;
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
  constexpr std::array<std::string_view, 12> kLegs{"kne",  "ank", "hee", "toe", "thi",   "tib",
                                                   "heel", "mtp", "mal", "cal", "troch", "foot"};
  constexpr std::array<std::string_view, 2> kPelvis{"asi", "psi"};
  const auto begins = [](std::string_view name, const auto& words) {
    return std::ranges::any_of(words, [&](std::string_view word) { return name.starts_with(word); });
  };
  std::set<std::string> legs, pelvis, channels;
  for (const FoundRecording& f : found) {
    channels.insert(f.channels.begin(), f.channels.end());
    for (const std::string& name : f.markers.names) {
      std::string plain = plain_label(name);
      if (plain.starts_with('l') || plain.starts_with('r')) plain.erase(0, 1);
      if (begins(plain, kLegs)) legs.insert(name);
      if (begins(plain, kPelvis)) pelvis.insert(name);
    }
  }
  const Limbs emg = limbs_of({channels.begin(), channels.end()});
  if (emg.arm || emg.leg) return !emg.arm;
  return !legs.empty() && legs.size() + pelvis.size() >= 4;
}

std::map<std::string, std::string> usual_arm_markers(const std::vector<std::string>& recorded) {
  static const std::map<std::string, std::string, std::less<>> kUsual{
      {"ij", "sternum"},
      {"clav", "sternum"},
      {"jugularnotch", "sternum"},
      {"rsho", "r_acromion"},
      {"ac", "r_acromion"},
      {"rac", "r_acromion"},
      {"acr", "r_acromion"},
      {"racr", "r_acromion"},
      {"acromion", "r_acromion"},
      {"acrotip", "r_acromion"},
      {"rshoulder", "r_acromion"},
      {"el", "r_epicondyle_lateral"},
      {"rel", "r_epicondyle_lateral"},
      {"relb", "r_epicondyle_lateral"},
      {"rlel", "r_epicondyle_lateral"},
      {"epicl", "r_epicondyle_lateral"},
      {"repiclat", "r_epicondyle_lateral"},
      {"relbowlat", "r_epicondyle_lateral"},
      {"rlelb", "r_epicondyle_lateral"},
      {"em", "r_epicondyle_medial"},
      {"rem", "r_epicondyle_medial"},
      {"relbm", "r_epicondyle_medial"},
      {"rmelb", "r_epicondyle_medial"},
      {"rmel", "r_epicondyle_medial"},
      {"epicm", "r_epicondyle_medial"},
      {"repicmed", "r_epicondyle_medial"},
      {"relbowmed", "r_epicondyle_medial"},
      {"rs", "r_styloid_radial"},
      {"rrs", "r_styloid_radial"},
      {"rwra", "r_styloid_radial"},
      {"stylr", "r_styloid_radial"},
      {"rstyrad", "r_styloid_radial"},
      {"us", "r_styloid_ulnar"},
      {"rus", "r_styloid_ulnar"},
      {"rwrb", "r_styloid_ulnar"},
      {"stylu", "r_styloid_ulnar"},
      {"rstyuln", "r_styloid_ulnar"},
      {"rfin", "r_hand"},
  };
  std::map<std::string, std::vector<std::string>> claims;  // by the arm's name
  for (const std::string& name : recorded) {
    if (const auto place = kUsual.find(plain_label(name)); place != kUsual.end()) claims[place->second].push_back(name);
  }
  std::map<std::string, std::string> pairs;
  for (const auto& [wanted, names] : claims) {
    const bool there = std::ranges::find(recorded, wanted) != recorded.end();
    if (names.size() == 1 && !there) pairs.emplace(names.front(), wanted);
  }
  return pairs;
}

}  // namespace myoid::study
