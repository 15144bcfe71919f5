#include "myoid/study/draft/study_draft.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/kinematics/marker_places.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/file_words.h"
#include "myoid/ground/files/label_match.h"
#include "myoid/ground/files/name_ids.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/recording/c3d_recording.h"
#include "myoid/recording/plate_standing.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/study/draft/channel_muscles.h"
#include "myoid/study/draft/draft_coordinate.h"
#include "myoid/study/draft/draft_model.h"
#include "myoid/study/draft/draft_persons.h"
#include "myoid/study/draft/draft_recordings.h"
#include "myoid/study/draft/draft_text.h"
#include "myoid/study/draft/draft_trials.h"
#include "myoid/study/trial_up.h"

namespace myoid::study {
namespace {

namespace fs = std::filesystem;
using ground::toml_text;

/// Tables of torques, by their columns' names.
struct TorqueTables {
  std::vector<fs::path> of_joints;
  std::vector<std::string> of_no_joint;  ///< File names.
};

class Draft {
 public:
  Draft(fs::path folder, const DraftOptions& options) : folder_(std::move(folder)), options_(options) {}

  StudyDraft write() {
    for (const fs::path& path : options_.from)
      if (!fs::exists(path)) throw ReadError(path, 0, "there is no such file or folder; check the path");
    FoundBeside beside;
    const std::vector<fs::path> files = recordings_in(options_.from, beside);
    for (const fs::path& loads : beside.external_loads) loads_data_.insert(loads_data_file(loads).lexically_normal());
    for (const fs::path& results : beside.results)
      note(RemarkCode::refused, results,
           fmt::format("{}: results of this program, no recordings; left out", relative(results)));
    choose_model(beside.models, files);
    for (const fs::path& file : files) read(file);
    if (std::ranges::any_of(options_.from, [](const fs::path& path) { return fs::is_directory(path); }))
      person_ = keep_one_person(found_);
    raw_emg_ = takes_raw_emg(found_);
    note_other_kind();
    if (joint_.name.empty()) choose_coordinate();
    if (std::ranges::none_of(found_, [](const FoundRecording& f) {
          return f.markers.frame_count() > 0 || !f.angles.empty() || !f.channels.empty();
        })) {
      std::vector<std::string> sources;
      for (const fs::path& path : options_.from) sources.push_back(path.string());
      const auto refused = std::ranges::find(draft_.remarks, RemarkCode::refused, &Remark::code);
      throw InvalidInput(
          fmt::format("no recording with markers, joint angles or EMG in {}{}; name files or folders with --from",
                      fmt::join(sources, ", "), refused == draft_.remarks.end() ? "" : " (" + refused->says + ")"));
    }
    subject_table();
    model_table();
    markers_table();
    emg_table();
    muscle_tables();
    if (!torques_.of_no_joint.empty()) out_.todo(question_of_torques(torques_.of_no_joint, joint_.name));
    draft_trials(found_,
                 {.external_loads = beside.external_loads,
                  .torques = torques_.of_joints,
                  .own_model = model_file_.has_value(),
                  .raw_emg = raw_emg_,
                  .person = person_.kept,
                  .unnamed = person_.unnamed,
                  .relative = [&](const fs::path& path) { return relative(path); }},
                 out_);
    tail();
    draft_.toml = std::move(out_.toml);
    draft_.todo = std::move(out_.questions);
    return std::move(draft_);
  }

 private:
  /// Adds a remark on a file.
  void note(RemarkCode code, const fs::path& file, std::string says) {
    draft_.remarks.push_back(
        {.code = code, .severity = Severity::note, .where = file.filename().string(), .says = std::move(says)});
  }

  void line(const std::string& text) { out_.line(text); }
  void todo(const std::string& text, const std::string& answer = {}) { out_.todo(text, answer); }
  [[nodiscard]] std::string relative(const fs::path& path) const {
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error);
    const fs::path from = fs::absolute(folder_, error);
    const fs::path result = absolute.lexically_normal().lexically_relative(from.lexically_normal());
    return (result.empty() ? absolute : result).generic_string();
  }

  void choose_model(std::vector<fs::path> models, const std::vector<fs::path>& files) {
    if (!options_.model) leave_out_unreadable(models, draft_.remarks);
    if (options_.model) {
      model_file_ = *options_.model;
    } else if (models.size() == 1) {
      model_file_ = models[0];
    } else if (models.size() > 1) {
      const ModelByMarkers chosen = model_of_markers(models, files);
      if (chosen.markers > 0) {
        model_file_ = chosen.model;
        note(RemarkCode::reading, chosen.model,
             fmt::format("of {} models {} is taken: it knows {} of the recorded markers, {}", models.size(),
                         relative(chosen.model), chosen.markers,
                         chosen.rms_m ? fmt::format("which lie {:.0f} mm rms from its own, nearer than to those of any "
                                                    "other that knows as many",
                                                    1e3 * *chosen.rms_m)
                                      : "more than any other"));
      }
      for (const fs::path& m : models) {
        if (!model_file_ || m != *model_file_) other_models_.push_back(relative(m));
      }
    }
    model_ = model_file_ ? body::read_osim(*model_file_) : body::parse_osim(body::arm4_osim(), "arm4.osim");
    joint_.name = options_.coordinate;
    if (!joint_.name.empty()) (void)model_.coordinate_index(joint_.name);
  }

  void choose_coordinate() {
    const std::vector<std::string> names = usual_first(free_coordinates());
    const std::vector<std::string> channels = all_channels();
    CoordinateOfChannels chosen =
        coordinate_of_channels(model_, moved_coordinates(model_, names, recorded_angles()), channels);
    if (chosen.name.empty()) chosen = coordinate_of_channels(model_, names, channels);
    joint_ = chosen;
    if (!joint_.name.empty()) return;
    joint_.name = names.empty() ? "TODO" : names[0];
    guessed_coordinate_ = names.empty() || !is_usual(names[0]) || !channels.empty();
  }

  /// Returns the angles of all recordings that have any; without one, those of a few frames of the first
  /// markers, of a file with EMG where there is one.
  [[nodiscard]] std::vector<TimeSeries> recorded_angles() const {
    std::vector<TimeSeries> angles;
    for (const FoundRecording& f : found_)
      if (!f.angles.empty()) angles.push_back(f.motion);
    if (!angles.empty()) return angles;
    const auto has_markers = [](const FoundRecording& f) { return f.markers.frame_count() > 0; };
    auto marked =
        std::ranges::find_if(found_, [&](const FoundRecording& f) { return has_markers(f) && !f.channels.empty(); });
    if (marked == found_.end()) marked = std::ranges::find_if(found_, has_markers);
    if (marked == found_.end()) return angles;
    if (std::optional<body::IkResult> quick = quick_motion(model_, marked->markers))
      angles.push_back(std::move(quick->q));
    return angles;
  }

  [[nodiscard]] std::vector<std::string> free_coordinates() const {
    std::vector<std::string> names;
    for (const body::Coordinate& c : model_.coordinates) {
      if (!c.locked) names.push_back(c.name);
    }
    return names;
  }

  /// `of_no_joint`: all of the file are torques that no joint's name stands for.
  void note_unused(const fs::path& path, bool torques, bool of_no_joint) {
    if (of_no_joint) {
      torques_.of_no_joint.push_back(path.filename().string());
      return;
    }
    constexpr const char* kTorques =
        "joint torques; a study takes measured ones as external_torque of a trial, and computes the others "
        "(`myoid identify --torques` reads them)";
    note(RemarkCode::refused, path,
         fmt::format("{}: {}", path.filename().string(),
                     torques ? kTorques : "no markers, no coordinate of the model, no EMG; not used"));
  }

  void read(const fs::path& path) {
    FoundRecording f;
    f.path = path;
    f.stem = trial_stem(path);
    bool torques = false;
    try {
      const auto format = format_of(path);
      recording::Recording file = recording::read_recording(path);
      f.plates = static_cast<int>(file.plates.size());
      f.body = recording::read_stated_body(path);
      note_up(path, file);
      f.markers = std::move(file.markers);
      if (format != FileFormat::storage && !file.analog.empty()) {
        f.loads.channels = load_channels(file.analog.series(), file.plates);
        f.loads.only_torques = only_torques(file.analog.series(), f.loads.channels);
      }
      for (const Channel& c : file.analog.channels()) {
        const bool angle = format == FileFormat::storage || c.unit == Unit::radian;
        if (angle && model_.find_coordinate(c.name)) f.angles.push_back(c.name);
        torques = torques || std::ranges::any_of(model_.coordinates, [&](const body::Coordinate& q) {
                    return c.name == q.name + "_moment";
                  });
      }
      if (!f.angles.empty()) f.motion = motion_of(path, file).select(f.angles);
      const bool of_motion = format == FileFormat::storage && !f.angles.empty();
      if (!of_motion && !file.analog.empty() && format != FileFormat::bids_motion)
        find_emg(path, file.analog.series(), file.plates, f);
    } catch (const InvalidInput& error) {
      note(RemarkCode::refused, path, fmt::format("not read: {}", error.what()));
      return;
    }
    if (loads_data_.contains(path.lexically_normal())) return;  // its ExternalLoads file names it
    if (torques) torques_.of_joints.push_back(path);
    const bool still = f.markers.frame_count() == 0 && f.angles.empty();
    if (still && !f.channels.empty() && f.loads.only_torques && !torques && format_of(path) == FileFormat::text_table)
      torques_.of_no_joint.push_back(path.filename().string());  // EMG, torque and angle in one table
    if (still && f.channels.empty()) return note_unused(path, torques, f.loads.only_torques && !torques);
    if (f.markers.frame_count() > 0) {
      Eigen::Index known = 0;
      std::vector<std::string> wanted;
      for (const body::Marker& m : model_.markers) wanted.push_back(m.name);
      const LabelMatch match = match_labels(f.markers.names, wanted);
      for (const std::string& name : f.markers.names) {
        if (model_.find_marker(name) || match.same.contains(name)) ++known;
      }
      for (std::string& name : f.markers.names) {
        if (const auto same = match.same.find(name); same != match.same.end()) name = same->second;
      }
      // No marker of an unknown set shows whether it lies on the person or on a box.
      if (known >= 3) f.loads.object_markers = object_markers(f.markers, model_);
      for (const body::PlacedMarker& pair : body::markers_by_place(model_, f.markers)) {
        const bool taken = std::ranges::any_of(elsewhere_, [&](const auto& p) { return p.second == pair.wanted; });
        if (!taken) elsewhere_.emplace(pair.recorded, pair.wanted);
      }
      most_known_ = std::max(most_known_, known);
      if (known >= 4 && up_ == ' ') find_up(f.markers);
    }
    found_.push_back(std::move(f));
  }

  /// Returns the channels of a file with angles, which are in radians.
  [[nodiscard]] TimeSeries motion_of(const fs::path& path, const recording::Recording& file) const {
    if (format_of(path) != FileFormat::storage) return file.analog.series();
    return recording::to_si(recording::read_storage(path), [&](const std::string& name) {
      const auto c = model_.find_coordinate(name);
      return c && model_.coordinates[static_cast<std::size_t>(*c)].motion == body::MotionType::rotational;
    });
  }

  /// Keeps the vertical that the first file with one states.
  void note_up(const fs::path& path, recording::Recording& file) {
    try {
      const recording::LaboratoryUp up = recording::stand_plates(file, std::nullopt);
      if (!up.up_L || !file_up_.empty()) return;
      file_up_ = recording::axis_name(*up.up_L);
      file_up_because_ = fmt::format("{}: {}", path.filename().string(), up.because);
    } catch (const InvalidInput& error) {
      note(RemarkCode::refused, path, fmt::format("{}: {}", path.filename().string(), error.what()));
    }
  }

  void find_up(const MarkerSeries& markers) {
    const std::optional<UprightAxis> best = upright_axis(model_, markers, {"y", "z", "x"});
    if (!best) return;
    up_ = best->name[0];
    up_cosine_ = best->cosine;
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
    if (!person_.left_out.empty())
      todo(
          fmt::format("{} in the names: a study is of one person, and this one is of {}; it leaves {} of the others "
                      "out. If these are other persons, draft a study for each (`myoid init DIR --from` that person's "
                      "files) and run all with `myoid cohort`; if not, name all files with --from one by one",
                      name_list(person_.all), person_.kept, counted(person_.left_out.size(), "file")));
    body_mass();
    line("");
  }

  /// Offers the mass that a file states; the built-in arm needs one.
  void body_mass() {
    const auto stated =
        std::ranges::find_if(found_, [](const FoundRecording& f) { return f.body.mass_kg.has_value(); });
    if (stated == found_.end()) {
      if (model_file_) return;
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
  [[nodiscard]] bool wants_a_leg() const { return !model_file_ && most_known_ < 3 && is_of_a_leg(found_); }

  void model_table() {
    line("[model]");
    const std::string model = model_file_ ? "file = " + toml_text(relative(*model_file_)) : "builtin = \"arm4\"";
    if (wants_a_leg())
      todo(
          "markers or EMG are those of a leg, and this built-in model is an arm: name a model of the leg with "
          "--model, OpenSim's gait2392 or Rajagopal2016, for example; joint, markers and muscles follow from it",
          model);
    if (!other_models_.empty())
      todo(fmt::format("or one of the {}models that were found: file = {}", model_file_ ? "other " : "",
                       list_of(other_models_)),
           model);
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
    const std::string other = same_on_the_other_side(model_, joint_.name, all_channels());
    if (other.empty()) return;
    todo(
        fmt::format("which side? No electrode's name states it, and this draft takes {} with the muscles of that side; "
                    "`myoid init --coordinate {}` drafts the other",
                    joint_.name, other),
        answer);
  }

  void markers_table() {
    if (std::ranges::none_of(found_, [&](const FoundRecording& f) { return starts_from_markers(f, found_); })) return;
    line("[markers]");
    vertical();
    marker_names();
    line("");
  }

  void vertical() {
    if (up_ == ' ' && file_up_.size() == 1) {
      line(fmt::format("up = \"{}\"   # {}", file_up_, file_up_because_));
      return;
    }
    if (up_ == ' ') {
      out_.ask("the vertical axis of the laboratory: x, y or z", "up = \"y\"");
      return;
    }
    const std::string up = fmt::format(
        "up = \"{}\"   # the model's markers stand upright in the laboratory like this ({:.0f} degrees off)", up_,
        std::acos(std::clamp(up_cosine_, -1.0, 1.0)) / kDegree);
    if (up_cosine_ < 0.7) todo("this is not upright; is it the right axis?", up);
    if (!file_up_.empty() && file_up_ != std::string(1, up_))
      todo(fmt::format("by its own words a file has {} up ({}); which is right?", file_up_, file_up_because_), up);
    line(up);
  }

  void marker_names() {
    if (wants_a_leg()) return;
    if (most_known_ < 3 && !model_.markers.empty()) {
      std::vector<std::string> names;
      for (const body::Marker& m : model_.markers) {
        if (names.size() < 40) names.push_back(m.name);
      }
      todo(
          fmt::format("{} of the recorded markers {} known to the model; its own are {}: rename = {{ FILE = \"MODEL\", "
                      "... }}, or name the model of this marker set with --model",
                      most_known_ == 0 ? "none" : fmt::format("only {}", most_known_), most_known_ == 1 ? "is" : "are",
                      fmt::join(names, ", ")));
    }
    const bool by_name = !model_file_ && elsewhere_.empty();
    if (by_name)
      for (const FoundRecording& f : found_) elsewhere_.merge(usual_arm_markers(f.markers.names));
    if (elsewhere_.empty()) return;
    std::vector<std::string> pairs;
    for (const auto& [name, like] : elsewhere_)
      pairs.push_back(fmt::format("{} = {}", toml_text(name), toml_text(like)));
    out_.ask(by_name
                 ? "these are usual names of the same places on a right arm: are they the same? Then take the # away"
                 : "these stand where the model has the others: are they the same? Then take the # away",
             fmt::format("# rename = {{ {} }}", fmt::join(pairs, ", ")));
  }

  [[nodiscard]] bool of_other_kind(const FoundRecording& f) const { return !f.channels.empty() && f.raw != raw_emg_; }

  void note_other_kind() {
    for (const FoundRecording& f : found_) {
      if (of_other_kind(f))
        note(RemarkCode::emg_processing, f.path,
             fmt::format("{}: {} not used", f.path.filename().string(),
                         f.raw ? "raw EMG, and more of the movements have envelopes;"
                               : "envelopes of EMG, and the study takes raw EMG;"));
    }
  }

  [[nodiscard]] std::vector<std::string> all_channels() const {
    std::vector<std::string> channels;
    for (const FoundRecording& f : found_) {
      if (of_other_kind(f)) continue;
      for (const std::string& c : f.channels) {
        if (std::ranges::find(channels, c) == channels.end()) channels.push_back(c);
      }
    }
    return channels;
  }

  void emg_table() {
    const bool unit = std::ranges::all_of(
        found_, [&](const FoundRecording& f) { return f.has_unit || f.channels.empty() || of_other_kind(f); });
    line("[emg]");
    line(fmt::format("kind = \"{}\"   # {}", raw_emg_ ? "raw" : "envelope",
                     raw_emg_ ? "by how often it goes through its median" : "it changes slowly"));
    if (raw_emg_ && !unit) out_.ask("the unit of the EMG, where the file does not say: V, mV or uV", "# unit = \"uV\"");
    line("");
  }

  void muscle_tables() {
    const std::vector<std::string> channels = all_channels();
    if (channels.empty())
      todo(
          "no EMG was found, and a study identifies muscles from EMG; for motion and joint torque alone see `myoid ik` "
          "and `myoid id`");
    const std::vector<std::string> able =
        joint_.name == "TODO" ? std::vector<std::string>{} : movers(model_, joint_.name);
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
    for (const std::string& file : person_.left_out)
      note(RemarkCode::refused, file, file + ": left out, of another person");
    if (!draft_.remarks.empty()) line("");
    for (const Remark& remark : draft_.remarks) line("# " + in_remark(remark.says));
  }

  fs::path folder_;
  const DraftOptions& options_;
  std::optional<fs::path> model_file_;
  std::vector<std::string> other_models_;
  body::BodyModel model_;
  CoordinateOfChannels joint_;
  bool guessed_coordinate_ = false;
  std::set<fs::path> loads_data_;
  TorqueTables torques_;
  std::vector<FoundRecording> found_;
  OnePerson person_;
  bool raw_emg_ = true;
  std::map<std::string, std::string> elsewhere_;
  Eigen::Index most_known_ = 0;
  char up_ = ' ';
  std::string file_up_, file_up_because_;  ///< The upward axis, such as "z", and the sentence of
                                           ///< the file that states it.
  double up_cosine_ = 0.0;
  DraftText out_;
  StudyDraft draft_;
};

}  // namespace

StudyDraft draft_study(const std::filesystem::path& folder, const DraftOptions& options) {
  return Draft(folder, options).write();
}

}  // namespace myoid::study
