#include "myoid/study/draft/draft_trials.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

#include "myoid/ground/files/file_words.h"
#include "myoid/ground/files/name_ids.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::study {
namespace {

using ground::toml_text;

/// Grows as two files belong to one trial more surely: by an equal name, then by the folders that both are in, then by
/// a long name.
using Likeness = std::tuple<bool, std::ptrdiff_t, std::size_t>;

std::optional<Likeness> likeness(const FoundRecording& motion, const FoundRecording& emg) {
  const bool equal = emg.stem == motion.stem;
  if (!equal && !emg.stem.starts_with(motion.stem + "_") && !motion.stem.starts_with(emg.stem + "_"))
    return std::nullopt;
  const auto a = motion.path.parent_path(), b = emg.path.parent_path();
  const auto apart = std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first;
  return Likeness{equal, std::distance(a.begin(), apart), emg.stem.size()};
}

/// Returns the EMG of a movement that no trial has yet: of its own file, else of the file most like it.
const FoundRecording* emg_of(const FoundRecording& motion, const std::vector<FoundRecording>& found, bool raw) {
  if (!motion.channels.empty()) return motion.raw == raw ? &motion : nullptr;
  const FoundRecording* best = nullptr;
  std::optional<Likeness> most;
  for (const FoundRecording& f : found) {
    if (f.channels.empty() || f.emg_taken || f.raw != raw) continue;
    const auto alike = likeness(motion, f);
    if (!alike || (most && *alike <= *most)) continue;
    most = alike;
    best = &f;
  }
  return best;
}

/// Returns the trial of a table of torques: "flex_2kg" of "flex_2kg_torque.sto".
std::string stem_of_torques(const std::filesystem::path& path) {
  std::string stem = trial_stem(path);
  for (const std::string_view word : {"_torque", "_torques", "_moment", "_moments", "_dynamometer", "_id"}) {
    if (stem.size() > word.size() && stem.ends_with(word)) return stem.substr(0, stem.size() - word.size());
  }
  return stem;
}

/// Writes the [[trial]] tables one after another.
class TrialWriter {
 public:
  TrialWriter(std::vector<FoundRecording>& found, const TrialSurroundings& around, DraftText& out)
      : found_(found), around_(around), out_(out) {}

  void write() {
    // Joint angles first: a trial that has them needs no markers.
    for (FoundRecording& f : found_) {
      if (!f.angles.empty() && !f.motion_taken) motion_trial(f, "motion");
    }
    for (FoundRecording& f : found_) {
      if (f.markers.frame_count() == 0 || f.motion_taken) continue;
      if (!starts_from_markers(f, found_)) {
        notes_.push_back(fmt::format("# Not used: markers = {} (the trial starts from its joint angles)",
                                     toml_text(around_.relative(f.path))));
      } else {
        motion_trial(f, "markers");
      }
    }
    for (const FoundRecording& f : found_) {
      if (!f.channels.empty() && !f.emg_taken && !f.motion_taken && f.raw == around_.raw_emg) emg_trial(f);
    }
    if (!any_calibration_) out_.todo("no trial has use = \"calibration\", from which parameters are found");
    for (const std::string& note : notes_) out_.line(note);
    if (two_clocks_) clocks();
  }

 private:
  /// Returns a name of a trial from the name of a file, whatever bytes that has.
  [[nodiscard]] std::string unique(const std::string& stem) {
    std::string name = to_utf8(stem);
    if (name.empty() || !name_refusal(name).empty()) name = ids_of({stem}).front();
    while (!names_.insert(name).second) name += "_2";
    return name;
  }

  /// Adds a trial with the EMG of equal name; `key` names the kind of its file.
  void motion_trial(FoundRecording& f, const std::string& key) {
    f.motion_taken = true;
    const FoundRecording* emg = emg_of(f, found_, around_.raw_emg);
    Use use = guessed_use(f.stem);
    const bool without_emg = emg == nullptr && use != Use::static_pose;
    if (without_emg && use != Use::passive) use = Use::static_pose;
    if (emg != nullptr) found_[static_cast<std::size_t>(emg - found_.data())].emg_taken = true;
    out_.line("[[trial]]");
    const std::string name_line = "name = " + toml_text(unique(f.stem));
    if (std::ranges::find(around_.unnamed, f.path) != around_.unnamed.end())
      out_.todo(
          fmt::format("'{}' names no person, and the other files name {}: is it of the same person? If not, delete "
                      "this trial",
                      f.path.filename().string(), around_.person),
          name_line);
    out_.line(name_line);
    out_.line(key + " = " + toml_text(around_.relative(f.path)));
    if (emg != nullptr) out_.line("emg = " + toml_text(around_.relative(emg->path)));
    two_clocks_ = two_clocks_ || (emg != nullptr && emg != &f);
    const std::string use_line = "use = " + toml_text(std::string(choice_name(use)));
    if (without_emg && use != Use::passive) without(emg_of(f, found_, !around_.raw_emg), f.stem, use_line);
    out_.line(use_line);
    any_calibration_ = any_calibration_ || use == Use::calibration;
    bool stated = false;
    for (const std::filesystem::path& loads : around_.external_loads) {
      if (trial_stem(loads) != f.stem) continue;
      out_.line("external_loads = " + toml_text(around_.relative(loads)));
      stated = true;
    }
    if (f.plates > 0) {
      out_.line(fmt::format("# force_plates = {{ bodies = \"auto\" }}   # {} in this file, if the person stood on them",
                            f.plates));
    }
    const bool measured = offer_torque(f);
    const bool needed = use == Use::calibration || mass_in_name(f.stem) || !f.loads.object_markers.empty() ||
                        f.loads.only_torques;  // a maximal contraction whose torque was measured is fitted
    if (!stated && !measured && needed) ask_for_loads(f.stem, f.loads, around_.own_model, asked_for_loads_, out_);
    out_.line("");
  }

  /// Returns true for a table that is the motion of another trial.
  [[nodiscard]] bool is_of_another(const std::filesystem::path& table, const FoundRecording& motion) const {
    return std::ranges::any_of(
        found_, [&](const FoundRecording& f) { return &f != &motion && !f.angles.empty() && f.path == table; });
  }

  /// Offers the table of torques of a trial, which may be measured or computed: the motion's own, else that beside the
  /// motion, else any; false if there is none.
  bool offer_torque(const FoundRecording& motion) {
    auto table = std::ranges::find(around_.torques, motion.path);
    for (auto other = around_.torques.begin(); other != around_.torques.end(); ++other) {
      if (table != around_.torques.end() && *table == motion.path) break;
      if (stem_of_torques(*other) != motion.stem || is_of_another(*other, motion)) continue;
      const bool beside = other->parent_path() == motion.path.parent_path();
      if (table == around_.torques.end() || beside) table = other;
    }
    if (table == around_.torques.end()) return false;
    const std::string line = "# external_torque = " + toml_text(around_.relative(*table));
    if (!asked_for_torque_)
      out_.todo(
          "tables of joint torques have the names of trials (each # external_torque): did a dynamometer measure them? "
          "Take each # away. Computed by inverse dynamics: delete them, and say what was held with held_mass_kg",
          line);
    asked_for_torque_ = true;
    out_.line(line);
    return true;
  }

  /// Says why a trial has no EMG: `other` is of the kind that the study does not take, or null.
  void without(const FoundRecording* other, const std::string& stem, const std::string& use_line) {
    const std::string why = other == nullptr
                                ? fmt::format("no EMG was found for '{}'", stem)
                                : fmt::format("the EMG of '{}' ({}) is {}", stem, other->path.filename().string(),
                                              other->raw ? "raw, and the study takes envelopes"
                                                         : "an envelope, and the study takes raw EMG");
    out_.todo(
        fmt::format("{}; '{}' gives motion and torque only; use = \"passive\" if the muscles were at rest", why, stem),
        use_line);
  }

  /// Writes a maximal contraction if the name says so, otherwise a question, of relaxed muscles if the name says that.
  void emg_trial(const FoundRecording& f) {
    const Use guessed = guessed_use(f.stem);
    const bool mvc = guessed == Use::mvc, passive = guessed == Use::passive;
    const std::string remark = mvc ? "" : "# ";
    const std::string use_line =
        remark + "use = " + toml_text(std::string(choice_name(passive ? Use::passive : Use::mvc)));
    if (!mvc)
      out_.todo(
          fmt::format("'{}' has EMG and no motion: {}", f.path.filename().string(),
                      passive ? "relaxed muscles tell the joint's resting torque where motion and external_torque are "
                                "measured; give these and take the # away, or delete the lines"
                              : "give it markers or motion; or take the # away if it is a maximal contraction"),
          use_line);
    out_.line(remark + "[[trial]]");
    out_.line(remark + "name = " + toml_text(unique(f.stem)));
    out_.line(remark + "emg = " + toml_text(around_.relative(f.path)));
    out_.line(use_line);
    out_.line("");
  }

  void clocks() {
    out_.line("");
    out_.line("# EMG and motion are in different files. If they did not start together, or their clocks run");
    out_.line("# apart, say so (myoid check --settings sync explains the keys):");
    out_.line("# [sync]");
    out_.line("# offset_s = 0.0");
  }

  std::vector<FoundRecording>& found_;
  const TrialSurroundings& around_;
  DraftText& out_;
  std::set<std::string> names_;
  std::vector<std::string> notes_;
  bool two_clocks_ = false, any_calibration_ = false, asked_for_loads_ = false, asked_for_torque_ = false;
};

}  // namespace

bool starts_from_markers(const FoundRecording& recording, const std::vector<FoundRecording>& found) {
  return recording.markers.frame_count() > 0 && std::ranges::none_of(found, [&](const FoundRecording& other) {
           return !other.angles.empty() && other.stem == recording.stem;
         });
}

bool takes_raw_emg(const std::vector<FoundRecording>& found) {
  const auto movements = [&](bool raw) {
    return std::ranges::count_if(found, [&](const FoundRecording& f) {
      return (!f.angles.empty() || starts_from_markers(f, found)) && emg_of(f, found, raw) != nullptr;
    });
  };
  const auto files = [&](bool raw) {
    return std::ranges::count_if(found, [&](const FoundRecording& f) { return !f.channels.empty() && f.raw == raw; });
  };
  if (files(true) == 0 || files(false) == 0) return files(false) == 0;
  return movements(true) >= movements(false);
}

void draft_trials(std::vector<FoundRecording>& found, const TrialSurroundings& around, DraftText& out) {
  TrialWriter(found, around, out).write();
}

}  // namespace myoid::study
