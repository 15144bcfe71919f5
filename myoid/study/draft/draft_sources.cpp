#include "myoid/study/draft/draft_sources.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/kinematics/marker_places.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/label_match.h"
#include "myoid/recording/c3d_recording.h"
#include "myoid/recording/plate_standing.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/study/draft/draft_model.h"
#include "myoid/study/draft/draft_trials.h"

namespace myoid::study {
namespace {

namespace fs = std::filesystem;

class SourceReader {
 public:
  SourceReader(const fs::path& folder, const DraftOptions& options) : folder_(folder), options_(options) {}

  DraftSources read_all() {
    for (const fs::path& path : options_.from)
      if (!fs::exists(path)) throw ReadError(path, 0, "there is no such file or folder; check the path");
    const std::vector<fs::path> files = recordings_in(options_.from, s_.beside);
    for (const fs::path& loads : s_.beside.external_loads)
      loads_data_.insert(loads_data_file(loads).lexically_normal());
    for (const fs::path& results : s_.beside.results)
      note(RemarkCode::refused, results,
           fmt::format("{}: results of this program, no recordings; left out", relative(results)));
    choose_model(s_.beside.models, files);
    for (const fs::path& file : files) read(file);
    if (std::ranges::any_of(options_.from, [](const fs::path& path) { return fs::is_directory(path); }))
      s_.person = keep_one_person(s_.found);
    s_.raw_emg = takes_raw_emg(s_.found);
    note_other_kind();
    for (const std::string& file : s_.person.left_out)
      note(RemarkCode::refused, file, file + ": left out, of another person");
    require_a_recording();
    return std::move(s_);
  }

 private:
  /// Adds a remark on a file.
  void note(RemarkCode code, const fs::path& file, std::string says) {
    s_.remarks.push_back(
        {.code = code, .severity = Severity::note, .where = file.filename().string(), .says = std::move(says)});
  }

  [[nodiscard]] std::string relative(const fs::path& path) const { return path_from(folder_, path); }

  void choose_model(std::vector<fs::path> models, const std::vector<fs::path>& files) {
    if (!options_.model) leave_out_unreadable(models, s_.remarks);
    if (options_.model) {
      s_.model_file = *options_.model;
    } else if (models.size() == 1) {
      s_.model_file = models[0];
    } else if (models.size() > 1) {
      const ModelByMarkers chosen = model_of_markers(models, files);
      if (chosen.markers > 0) {
        s_.model_file = chosen.model;
        note(RemarkCode::reading, chosen.model,
             fmt::format("of {} models {} is taken: it knows {} of the recorded markers, {}", models.size(),
                         relative(chosen.model), chosen.markers,
                         chosen.rms_m ? fmt::format("which lie {:.0f} mm rms from its own, nearer than to those of any "
                                                    "other that knows as many",
                                                    1e3 * *chosen.rms_m)
                                      : "more than any other"));
      }
      for (const fs::path& m : models) {
        if (!s_.model_file || m != *s_.model_file) s_.other_models.push_back(m);
      }
    }
    s_.model = s_.model_file ? body::read_osim(*s_.model_file) : body::parse_osim(body::arm4_osim(), "arm4.osim");
    if (!options_.coordinate.empty()) (void)s_.model.coordinate_index(options_.coordinate);
  }

  /// `of_no_joint`: all of the file are torques that no joint's name stands for.
  void note_unused(const fs::path& path, bool torques, bool of_no_joint) {
    if (of_no_joint) {
      s_.torques.of_no_joint.push_back(path.filename().string());
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
        if (angle && s_.model.find_coordinate(c.name)) f.angles.push_back(c.name);
        torques = torques || std::ranges::any_of(s_.model.coordinates, [&](const body::Coordinate& q) {
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
    if (torques) s_.torques.of_joints.push_back(path);
    const bool still = f.markers.frame_count() == 0 && f.angles.empty();
    if (still && !f.channels.empty() && f.loads.only_torques && !torques && format_of(path) == FileFormat::text_table)
      s_.torques.of_no_joint.push_back(path.filename().string());  // EMG, torque and angle in one table
    if (still && f.channels.empty()) return note_unused(path, torques, f.loads.only_torques && !torques);
    if (f.markers.frame_count() > 0) {
      Eigen::Index known = 0;
      std::vector<std::string> wanted;
      for (const body::Marker& m : s_.model.markers) wanted.push_back(m.name);
      const LabelMatch match = match_labels(f.markers.names, wanted);
      for (const std::string& name : f.markers.names) {
        if (s_.model.find_marker(name) || match.same.contains(name)) ++known;
      }
      for (std::string& name : f.markers.names) {
        if (const auto same = match.same.find(name); same != match.same.end()) name = same->second;
      }
      // No marker of an unknown set shows whether it lies on the person or on a box.
      if (known >= 3) f.loads.object_markers = object_markers(f.markers, s_.model);
      for (const body::PlacedMarker& pair : body::markers_by_place(s_.model, f.markers)) {
        const bool taken = std::ranges::any_of(s_.renamed, [&](const auto& p) { return p.second == pair.wanted; });
        if (!taken) s_.renamed.emplace(pair.recorded, pair.wanted);
      }
      s_.most_known = std::max(s_.most_known, known);
      if (known >= 4 && !s_.upright) s_.upright = upright_axis(s_.model, f.markers, {"y", "z", "x"});
    }
    s_.found.push_back(std::move(f));
  }

  /// Returns the channels of a file with angles, which are in radians.
  [[nodiscard]] TimeSeries motion_of(const fs::path& path, const recording::Recording& file) const {
    if (format_of(path) != FileFormat::storage) return file.analog.series();
    return recording::to_si(recording::read_storage(path), [&](const std::string& name) {
      const auto c = s_.model.find_coordinate(name);
      return c && s_.model.coordinates[static_cast<std::size_t>(*c)].motion == body::MotionType::rotational;
    });
  }

  /// Keeps the vertical that the first file with one states.
  void note_up(const fs::path& path, recording::Recording& file) {
    try {
      const recording::LaboratoryUp up = recording::stand_plates(file, std::nullopt);
      if (!up.up_L || s_.stated_up) return;
      s_.stated_up = {recording::axis_name(*up.up_L), fmt::format("{}: {}", path.filename().string(), up.because)};
    } catch (const InvalidInput& error) {
      note(RemarkCode::refused, path, fmt::format("{}: {}", path.filename().string(), error.what()));
    }
  }

  void note_other_kind() {
    for (const FoundRecording& f : s_.found) {
      if (s_.of_other_kind(f))
        note(RemarkCode::emg_processing, f.path,
             fmt::format("{}: {} not used", f.path.filename().string(),
                         f.raw ? "raw EMG, and more of the movements have envelopes;"
                               : "envelopes of EMG, and the study takes raw EMG;"));
    }
  }

  void require_a_recording() const {
    if (std::ranges::any_of(s_.found, [](const FoundRecording& f) {
          return f.markers.frame_count() > 0 || !f.angles.empty() || !f.channels.empty();
        }))
      return;
    std::vector<std::string> sources;
    for (const fs::path& path : options_.from) sources.push_back(path.string());
    const auto refused = std::ranges::find(s_.remarks, RemarkCode::refused, &Remark::code);
    throw InvalidInput(
        fmt::format("no recording with markers, joint angles or EMG in {}{}; name files or folders with --from",
                    fmt::join(sources, ", "), refused == s_.remarks.end() ? "" : " (" + refused->says + ")"));
  }

  const fs::path& folder_;
  const DraftOptions& options_;
  std::set<fs::path> loads_data_;
  DraftSources s_;
};

}  // namespace

std::string path_from(const fs::path& folder, const fs::path& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  const fs::path from = fs::absolute(folder, error);
  const fs::path result = absolute.lexically_normal().lexically_relative(from.lexically_normal());
  return (result.empty() ? absolute : result).generic_string();
}

DraftSources draft_sources(const fs::path& folder, const DraftOptions& options) {
  return SourceReader(folder, options).read_all();
}

}  // namespace myoid::study
