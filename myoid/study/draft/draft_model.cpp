#include "myoid/study/draft/draft_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/kinematics/marker_misfit.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/label_match.h"
#include "myoid/recording/laboratory_up.h"
#include "myoid/recording/recording.h"
#include "myoid/study/draft/channel_muscles.h"
#include "myoid/study/trial_up.h"

namespace myoid::study {
namespace {

constexpr std::size_t kFilesWithMarkers = 3;

/// Returns the markers of the first recordings that have any.
std::vector<MarkerSeries> first_markers(const std::vector<std::filesystem::path>& files) {
  std::vector<MarkerSeries> found;
  for (const std::filesystem::path& file : files) {
    if (found.size() == kFilesWithMarkers) break;
    try {
      recording::Recording recording = recording::read_recording(file);
      if (!recording.markers.names.empty()) found.push_back(std::move(recording.markers));
    } catch (const InvalidInput&) {  // the draft names files that cannot be read
    }
  }
  return found;
}

/// Returns the root mean square distance of the markers from the model's; empty where none can be found.
std::optional<double> distance_m(const body::BodyModel& model, const MarkerSeries& markers) {
  const std::optional<body::IkResult> solved = quick_motion(model, markers);
  if (!solved) return std::nullopt;
  double squares = 0.0, count = 0.0;
  for (const double rms_m : solved->errors.column("marker_error_RMS")) {
    if (!std::isfinite(rms_m)) continue;
    squares += rms_m * rms_m;
    count += 1.0;
  }
  return count > 0.0 ? std::optional(std::sqrt(squares / count)) : std::nullopt;
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

std::optional<body::IkResult> quick_motion(const body::BodyModel& model, MarkerSeries markers) {
  std::vector<std::string> wanted;
  for (const body::Marker& marker : model.markers) wanted.push_back(marker.name);
  const LabelMatch match = match_labels(markers.names, wanted);
  for (std::string& name : markers.names) {
    if (const auto same = match.same.find(name); same != match.same.end()) name = same->second;
  }
  const std::optional<UprightAxis> up = upright_axis(model, markers, {"y", "z", "x"});
  if (!up) return std::nullopt;
  try {
    const Mat3 turn = rotation_onto(model, *recording::axis_vector(up->name));
    return body::inverse_kinematics(model, body::spread_frames(rotated(std::move(markers), turn)), {});
  } catch (const InvalidInput&) {  // no frame has markers enough
    return std::nullopt;
  }
}

ModelByMarkers model_of_markers(const std::vector<std::filesystem::path>& models,
                                const std::vector<std::filesystem::path>& files) {
  constexpr double kNearlyAll = 0.8;
  const std::vector<MarkerSeries> recorded = first_markers(files);
  std::set<std::string> labels;
  for (const MarkerSeries& markers : recorded)
    for (const std::string& name : markers.names) labels.insert(plain_label(name));
  std::vector<std::pair<Eigen::Index, body::BodyModel>> known;
  Eigen::Index most = 0;
  for (const std::filesystem::path& path : models) {
    known.emplace_back(0, body::read_osim(path));
    for (const body::Marker& marker : known.back().second.markers)
      known.back().first += labels.contains(plain_label(marker.name)) ? 1 : 0;
    most = std::max(most, known.back().first);
  }
  std::vector<ModelByMarkers> near;
  for (std::size_t i = 0; i < models.size(); ++i)
    if (most > 0 && static_cast<double>(known[i].first) >= kNearlyAll * static_cast<double>(most))
      near.push_back({.model = models[i], .markers = known[i].first, .rms_m = {}});
  if (near.size() == 1) return near.front();
  for (ModelByMarkers& one : near) {
    const auto i = static_cast<std::size_t>(std::ranges::find(models, one.model) - models.begin());
    one.rms_m = distance_m(known[i].second, recorded.front());
  }
  std::erase_if(near, [](const ModelByMarkers& one) { return !one.rms_m; });
  std::ranges::sort(near, {}, [](const ModelByMarkers& one) { return *one.rms_m; });
  if (near.empty() || (near.size() > 1 && *near[0].rms_m == *near[1].rms_m)) return {};
  return near.front();
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
