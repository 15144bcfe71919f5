#include "myoid/study/draft/study_draft.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/file_words.h"
#include "myoid/ground/files/name_ids.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/study/draft/channel_muscles.h"
#include "myoid/study/draft/draft_coordinate.h"
#include "myoid/study/draft/draft_model.h"
#include "myoid/study/draft/draft_text.h"
#include "myoid/study/draft/draft_trials.h"

namespace myoid::study {
namespace {

namespace fs = std::filesystem;
using ground::toml_text;

class Draft {
 public:
  Draft(fs::path folder, const DraftOptions& options)
      : folder_(std::move(folder)), options_(options), s_(draft_sources(folder_, options)) {
    joint_.name = options.coordinate;
  }

  StudyDraft write() {
    if (joint_.name.empty()) choose_coordinate();
    subject_table();
    model_table();
    markers_table();
    emg_table();
    muscle_tables();
    if (!s_.torques.of_no_joint.empty()) out_.todo(question_of_torques(s_.torques.of_no_joint, joint_.name));
    draft_trials(s_.found,
                 {.external_loads = s_.beside.external_loads,
                  .torques = s_.torques.of_joints,
                  .own_model = s_.model_file.has_value(),
                  .raw_emg = s_.raw_emg,
                  .person = s_.person.kept,
                  .unnamed = s_.person.unnamed,
                  .relative = [&](const fs::path& path) { return path_from(folder_, path); }},
                 out_);
    tail();
    return {.toml = std::move(out_.toml), .todo = std::move(out_.questions), .remarks = std::move(s_.remarks)};
  }

 private:
  void line(const std::string& text) { out_.line(text); }
  void todo(const std::string& text, const std::string& answer = {}) { out_.todo(text, answer); }

  void choose_coordinate() {
    const std::vector<std::string> names = usual_first(free_coordinates());
    const std::vector<std::string> channels = all_channels();
    CoordinateOfChannels chosen =
        coordinate_of_channels(s_.model, moved_coordinates(s_.model, names, recorded_angles()), channels);
    if (chosen.name.empty()) chosen = coordinate_of_channels(s_.model, names, channels);
    joint_ = chosen;
    if (!joint_.name.empty()) return;
    joint_.name = names.empty() ? "TODO" : names[0];
    guessed_coordinate_ = names.empty() || !is_usual(names[0]) || !channels.empty();
  }

  /// Returns the angles of all recordings that have any; without one, those of a few frames of the first
  /// markers, of a file with EMG where there is one.
  [[nodiscard]] std::vector<TimeSeries> recorded_angles() const {
    std::vector<TimeSeries> angles;
    for (const FoundRecording& f : s_.found)
      if (!f.angles.empty()) angles.push_back(f.motion);
    if (!angles.empty()) return angles;
    const auto has_markers = [](const FoundRecording& f) { return f.markers.frame_count() > 0; };
    auto marked =
        std::ranges::find_if(s_.found, [&](const FoundRecording& f) { return has_markers(f) && !f.channels.empty(); });
    if (marked == s_.found.end()) marked = std::ranges::find_if(s_.found, has_markers);
    if (marked == s_.found.end()) return angles;
    if (std::optional<body::IkResult> quick = quick_motion(s_.model, marked->markers))
      angles.push_back(std::move(quick->q));
    return angles;
  }

  [[nodiscard]] std::vector<std::string> free_coordinates() const {
    std::vector<std::string> names;
    for (const body::Coordinate& c : s_.model.coordinates) {
      if (!c.locked) names.push_back(c.name);
    }
    return names;
  }

  void subject_table() {
    line(
        "# A study to start from, written by `myoid init`. A TODO wants an answer: change the line below it, or "
        "delete");
    line("# the TODO where nothing is to change. Then:");
    line("#   myoid check study.toml");
    line("#   myoid run study.toml --out results");
    line("");
    line("[subject]");
    std::error_code error;
    const fs::path at = fs::absolute(folder_, error).lexically_normal();
    const std::string folder = to_utf8((at.has_filename() ? at : at.parent_path()).filename().string());
    line("name = " + toml_text(name_refusal(folder).empty() ? folder : "subject"));
    if (!s_.person.left_out.empty())
      todo(
          fmt::format("{} in the names: a study is of one person, and this one is of {}; it leaves {} of the others "
                      "out. If these are other persons, draft a study for each (`myoid init DIR --from` that person's "
                      "files) and run all with `myoid cohort`; if not, name all files with --from one by one",
                      name_list(s_.person.all), s_.person.kept, counted(s_.person.left_out.size(), "file")));
    body_mass();
    line("");
  }

  /// Offers the mass that a file states; the built-in arm needs one.
  void body_mass() {
    const auto stated =
        std::ranges::find_if(s_.found, [](const FoundRecording& f) { return f.body.mass_kg.has_value(); });
    if (stated == s_.found.end()) {
      if (s_.model_file) return;
      constexpr const char* kMass = "# mass_kg = 70.0";
      if (!wants_a_leg()) todo("the person's mass, for the segments of the built-in arm", kMass);
      line(kMass);
      return;
    }
    const std::string height =
        stated->body.height_m ? fmt::format(" and a height of {:.3g} m", *stated->body.height_m) : "";
    out_.ask(fmt::format("is this the person's mass? {} states it (PROCESSING:BODYMASS){}",
                         stated->path.filename().string(), height),
             fmt::format("mass_kg = {:g}", *stated->body.mass_kg));
  }

  /// True where the built-in arm stands for a leg's model: what it lacks is no question.
  [[nodiscard]] bool wants_a_leg() const { return !s_.model_file && s_.most_known < 3 && is_of_a_leg(s_.found); }

  void model_table() {
    line("[model]");
    const std::string model =
        s_.model_file ? "file = " + toml_text(path_from(folder_, *s_.model_file)) : "builtin = \"arm4\"";
    if (wants_a_leg())
      todo(
          "markers or EMG are those of a leg, and this built-in model is an arm: name a model of the leg with "
          "--model, OpenSim's gait2392 or Rajagopal2016, for example; joint, markers and muscles follow from it",
          model);
    if (!s_.other_models.empty()) {
      std::vector<std::string> others;
      for (const fs::path& other : s_.other_models) others.push_back(path_from(folder_, other));
      todo(fmt::format("or one of the {}models that were found: file = {}", s_.model_file ? "other " : "",
                       list_of(others)),
           model);
    }
    line(model);
    const std::string coordinate = "coordinate = " + toml_text(joint_.name);
    if (guessed_coordinate_ && !wants_a_leg())
      todo("which joint? free coordinates: " + fmt::format("{}", fmt::join(free_coordinates(), ", ")), coordinate);
    if (!joint_.more.empty())
      todo(fmt::format("which joint? More electrodes are on muscles of {}", fmt::join(joint_.more, ", ")), coordinate);
    if (options_.coordinate.empty()) ask_for_the_side(coordinate);
    line(coordinate);
    line("");
  }

  void ask_for_the_side(const std::string& answer) {
    const std::string other = same_on_the_other_side(s_.model, joint_.name, all_channels());
    if (other.empty()) return;
    todo(
        fmt::format("which side? No electrode's name states it, and this draft takes {} with the muscles of that side; "
                    "`myoid init --coordinate {}` drafts the other",
                    joint_.name, other),
        answer);
  }

  void markers_table() {
    if (std::ranges::none_of(s_.found, [&](const FoundRecording& f) { return starts_from_markers(f, s_.found); }))
      return;
    line("[markers]");
    vertical();
    marker_names();
    line("");
  }

  void vertical() {
    const std::optional<StatedUp>& stated = s_.stated_up;
    if (!s_.upright) {
      if (stated && stated->axis.size() == 1)
        line(fmt::format("up = \"{}\"   # {}", stated->axis, stated->because));
      else
        out_.ask("the vertical axis of the laboratory: x, y or z", "up = \"y\"");
      return;
    }
    const std::string up = fmt::format(
        "up = \"{}\"   # the model's markers stand upright in the laboratory like this ({:.0f} degrees off)",
        s_.upright->name, std::acos(std::clamp(s_.upright->cosine, -1.0, 1.0)) / kDegree);
    if (s_.upright->cosine < 0.7) todo("this is not upright; is it the right axis?", up);
    if (stated && stated->axis != s_.upright->name)
      todo(fmt::format("by its own words a file has {} up ({}); which is right?", stated->axis, stated->because), up);
    line(up);
  }

  void marker_names() {
    if (wants_a_leg()) return;
    if (s_.most_known < 3 && !s_.model.markers.empty()) {
      std::vector<std::string> names;
      for (const body::Marker& m : s_.model.markers) {
        if (names.size() < 40) names.push_back(m.name);
      }
      todo(
          fmt::format("{} of the recorded markers {} known to the model; its own are {}: rename = {{ FILE = \"MODEL\", "
                      "... }}, or name the model of this marker set with --model",
                      s_.most_known == 0 ? "none" : fmt::format("only {}", s_.most_known),
                      s_.most_known == 1 ? "is" : "are", fmt::join(names, ", ")));
    }
    const bool by_name = !s_.model_file && s_.renamed.empty();
    if (by_name)
      for (const FoundRecording& f : s_.found) s_.renamed.merge(usual_arm_markers(f.markers.names));
    if (s_.renamed.empty()) return;
    std::vector<std::string> pairs;
    for (const auto& [name, like] : s_.renamed)
      pairs.push_back(fmt::format("{} = {}", toml_text(name), toml_text(like)));
    out_.ask(by_name
                 ? "these are usual names of the same places on a right arm: are they the same? Then take the # away"
                 : "these stand where the model has the others: are they the same? Then take the # away",
             fmt::format("# rename = {{ {} }}", fmt::join(pairs, ", ")));
  }

  [[nodiscard]] std::vector<std::string> all_channels() const {
    std::vector<std::string> channels;
    for (const FoundRecording& f : s_.found) {
      if (s_.of_other_kind(f)) continue;
      for (const std::string& c : f.channels) {
        if (std::ranges::find(channels, c) == channels.end()) channels.push_back(c);
      }
    }
    return channels;
  }

  void emg_table() {
    const bool unit = std::ranges::all_of(
        s_.found, [&](const FoundRecording& f) { return f.has_unit || f.channels.empty() || s_.of_other_kind(f); });
    line("[emg]");
    line(fmt::format("kind = \"{}\"   # {}", s_.raw_emg ? "raw" : "envelope",
                     s_.raw_emg ? "by how often it goes through its median" : "it changes slowly"));
    if (s_.raw_emg && !unit)
      out_.ask("the unit of the EMG, where the file does not say: V, mV or uV", "# unit = \"uV\"");
    line("");
  }

  void muscle_tables() {
    const std::vector<std::string> channels = all_channels();
    if (channels.empty())
      todo(
          "no EMG was found, and a study identifies muscles from EMG; for motion and joint torque alone see `myoid ik` "
          "and `myoid id`");
    const std::vector<std::string> able =
        joint_.name == "TODO" ? std::vector<std::string>{} : movers(s_.model, joint_.name);
    std::set<std::string> covered, names;
    std::vector<std::string> unused;
    std::vector<std::string> drafted;
    for (const ChannelMuscles& pair : match_channels(channels, able)) {
      std::vector<std::string> fresh;
      for (const std::string& m : pair.muscles) {
        if (covered.insert(m).second) fresh.push_back(m);
      }
      if (fresh.empty()) {
        unused.push_back(pair.channel);
        continue;
      }
      std::string name = fresh.size() == 1 ? fresh[0] : abbreviation(fresh);
      while (!names.insert(name).second) name += "_2";
      drafted.push_back(name);
      line("[[muscle]]");
      line("name = " + toml_text(name));
      line("osim = " + list_of(fresh));
      line("emg = " + toml_text(pair.channel));
      line("");
    }
    if (drafted.empty()) {
      if (!channels.empty()) unknown_pairs(channels, able);
      return;
    }
    std::vector<std::string> left;
    std::ranges::copy_if(able, std::back_inserter(left),
                         [&](const std::string& muscle) { return !covered.contains(muscle); });
    if (!left.empty()) without_electrode(left, drafted);
    if (!unused.empty()) {
      line(fmt::format("# Channels that no muscle about {} takes: {}", joint_.name, fmt::join(unused, ", ")));
      line("");
    }
  }

  /// Writes a table to fill in, where no channel is named like a muscle.
  void unknown_pairs(const std::vector<std::string>& channels, const std::vector<std::string>& able) {
    line("[[muscle]]");
    const std::string osim = fmt::format("osim = [\"TODO\"]   # of {}", fmt::join(able, ", "));
    if (!wants_a_leg())
      todo(fmt::format("no channel's name is that of a muscle that moves {}; name the pairs", joint_.name), osim);
    line("name = \"TODO\"");
    line(osim);
    line(fmt::format("emg = \"TODO\"      # of {}", fmt::join(channels, ", ")));
    line("");
  }

  /// Asks what to do with muscles without electrode; the first is written as one that acts like one of `drafted`.
  void without_electrode(const std::vector<std::string>& left, const std::vector<std::string>& drafted) {
    const std::string emg = fmt::format("# emg = {{ same_as = \"TODO\" }}   # a muscle that pulls with it, of {}",
                                        fmt::join(drafted, ", "));
    todo(fmt::format("these move {} too, and have no electrode: {}. Leave them out, add them to a group, or let them "
                     "act as another muscle does:",
                     joint_.name, fmt::join(left, ", ")),
         emg);
    line("# [[muscle]]");
    line("# name = " + toml_text(left[0]));
    line(emg);
    line("");
  }

  static std::string abbreviation(const std::vector<std::string>& heads) {
    std::string name = heads[0];
    for (const std::string& h : heads) {
      std::size_t k = 0;
      while (k < name.size() && k < h.size() && name[k] == h[k]) ++k;
      name.resize(k);
    }
    while (!name.empty() && (name.back() == '_' || name.back() == '-')) name.pop_back();
    return name.size() >= 2 ? name : heads[0];
  }

  void tail() {
    line("");
    line("[identify]");
    line("# method = [\"paper\", \"torque\"]   # the default; where a muscle has without_emg, torque alone");
    if (!s_.remarks.empty()) line("");
    for (const Remark& remark : s_.remarks) line("# " + in_remark(remark.says));
  }

  fs::path folder_;
  const DraftOptions& options_;
  DraftSources s_;
  CoordinateOfChannels joint_;
  bool guessed_coordinate_ = false;
  DraftText out_;
};

}  // namespace

StudyDraft draft_study(const std::filesystem::path& folder, const DraftOptions& options) {
  return Draft(folder, options).write();
}

}  // namespace myoid::study
