#include "myoid/ground/core/remark.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace myoid::inline ground {
namespace {

/// In the order of RemarkCode.
constexpr std::array kNames = {
    "marker_unit",
    "marker_gap",
    "marker_jump",
    "marker_swap",
    "segment_not_rigid",
    "emg_amplitude",
    "emg_envelope",
    "emg_flat",
    "emg_clipped",
    "emg_saturated",
    "emg_hum",
    "emg_low_signal",
    "emg_crosstalk",
    "emg_drift",
    "emg_artifact",
    "emg_over_reference",
    "emg_gain",
    "emg_offset",
    "clock_uneven",
    "clock_offset",
    "clock_drift",
    "plate_offset",
    "plate_sign",
    "plate_pressure_outside",
    "general",
    "reading",
    "refused",
    "unit_doubtful",
    "clock_pause",
    "channel_unusable",
    "channel_missing",
    "emg_rate",
    "emg_processing",
    "emg_cover",
    "emg_length",
    "unanswered",
    "no_maximal_contraction",
    "no_body_mass",
    "flat_activations",
    "start_outside_bounds",
    "model_unsupported",
    "shared_muscle",
    "shared_channel",
    "idle_muscle",
    "same_recording",
    "angle_outside_range",
    "angle_jump",
    "motion_impossible",
    "coordinate_absent",
    "joint_undetermined",
    "torque_impossible",
    "mass_impossible",
    "gravity_impossible",
    "muscle_impossible",
    "reserves_act",
    "loads_unstated",
    "held_mass_impossible",
    "vertical_across_trunk",
    "sides_exchanged",
    "dynamometer_sign",
    "load_misplaced",
    "foreign_contact",
    "unloaded_time",
    "body_unsupported",
    "resting_torque",
    "force_enhancement",
    "fit_poor",
    "far_from_prior",
    "unlike_person",
    "several_modes",
    "draws_unreliable",
    "model_unfit",
    "motion_alone",
    "late_emg",
    "lower_minimum",
    "branches_differ",
    "not_predicted",
    "emg_delay_ignored",
    "gain_mismatch",
    "co_contraction_zeroed",
};
static_assert(kNames.size() == static_cast<std::size_t>(RemarkCode::count_of_codes));

bool are_alike(const Remark& a, const Remark& b) {
  const bool same_words = a.says == b.says && a.remedy == b.remedy;
  return a.code == b.code && a.severity == b.severity && a.about == b.about && (!a.about.empty() || same_words);
}

std::string quoted_name(const Remark& remark) { return "'" + remark.about + "'"; }

/// Code, severity, place, the words before and after the name, remedy, other places.
using SentenceWithoutName =
    std::tuple<RemarkCode, Severity, std::string, std::string, std::string, std::string, std::vector<std::string>>;

/// Returns nothing where the sentence does not quote the name.
std::optional<SentenceWithoutName> without_name(const Remark& remark) {
  const std::string name = quoted_name(remark);
  const std::size_t at = remark.about.empty() ? std::string::npos : remark.says.find(name);
  if (at == std::string::npos) return {};
  return SentenceWithoutName{
      remark.code,   remark.severity, remark.where, remark.says.substr(0, at), remark.says.substr(at + name.size()),
      remark.remedy, remark.likewise};
}

}  // namespace

std::string_view name(Severity severity) {
  constexpr std::array kSeverities = {"error", "warning", "note", "detail"};
  return kSeverities.at(static_cast<std::size_t>(severity));
}

std::string_view name(RemarkCode code) { return kNames.at(static_cast<std::size_t>(code)); }

std::string sentence(const Remark& remark) {
  // Every place of an error must be mended.
  const std::size_t most = remark.severity == Severity::error ? remark.likewise.size() : 4;
  std::string text = remark.says;
  if (!remark.remedy.empty()) text += "; " + remark.remedy;
  const std::size_t named = std::min(most, remark.likewise.size());
  if (named == 0) return text;
  const auto end = remark.likewise.begin() + static_cast<std::ptrdiff_t>(named);
  text += fmt::format(" (likewise in {}", fmt::join(remark.likewise.begin(), end, ", "));
  if (named < remark.likewise.size()) text += fmt::format(" and {} more", remark.likewise.size() - named);
  return text + ")";
}

std::vector<std::string> sentences(const std::vector<Remark>& remarks, std::optional<Severity> only) {
  std::vector<std::string> texts;
  for (const Remark& remark : remarks) {
    if (!only || remark.severity == *only) texts.push_back(sentence(remark));
  }
  return texts;
}

std::vector<Remark> grouped(const std::vector<Remark>& remarks, Times times) {
  std::vector<Remark> kept;
  for (const Remark& remark : remarks) {
    const bool alone = remark.when && times == Times::kept;
    const auto same =
        alone ? kept.end()
              : std::find_if(kept.begin(), kept.end(), [&](const Remark& k) { return are_alike(k, remark); });
    if (same == kept.end()) {
      kept.push_back(remark);
    } else if (same->where != remark.where &&
               std::find(same->likewise.begin(), same->likewise.end(), remark.where) == same->likewise.end()) {
      same->likewise.push_back(remark.where);
    }
  }
  return kept;
}

std::vector<Remark> named_together(const std::vector<Remark>& remarks) {
  std::vector<Remark> kept;
  std::vector<std::vector<std::string>> names;  // of each kept remark, but for the first
  std::map<SentenceWithoutName, std::size_t> places;
  for (const Remark& remark : remarks) {
    if (const std::optional<SentenceWithoutName> words = without_name(remark)) {
      const auto [place, first] = places.try_emplace(*words, kept.size());
      if (!first) {
        names[place->second].push_back(quoted_name(remark));
        continue;
      }
    }
    kept.push_back(remark);
    names.emplace_back();
  }
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!names[i].empty()) kept[i].says += fmt::format(" (likewise {})", fmt::join(names[i], ", "));
  }
  return kept;
}

void sort_by_severity(std::vector<Remark>& remarks) {
  std::stable_sort(remarks.begin(), remarks.end(),
                   [](const Remark& a, const Remark& b) { return a.severity < b.severity; });
}

}  // namespace myoid::inline ground
