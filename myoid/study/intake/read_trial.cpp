#include "myoid/study/intake/read_trial.h"

#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/angle_unit.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/ground/files/byte_source.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/recording/column_unit.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/series_file.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/study/intake/emg_cover.h"
#include "myoid/study/intake/read_fascicles.h"
#include "myoid/study/intake/read_given.h"
#include "myoid/study/intake/trial_emg.h"
#include "myoid/study/intake/trial_loads.h"
#include "myoid/study/intake/trial_markers.h"

namespace myoid::study {
namespace {

/// Throws ReadError, naming the key, for a missing file.
void require_files(const TrialSpec& trial) {
  using Key = std::pair<const char*, const std::optional<std::filesystem::path>*>;
  const auto require = [&](const char* key, const std::filesystem::path& path) {
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored)) return;
    throw ReadError(
        path, 0,
        fmt::format("there is no such file for {}; a path in a study counts from the folder of the study", key));
  };
  for (const auto& [key, path] :
       {Key{"markers", &trial.markers}, Key{"motion", &trial.motion}, Key{"emg", &trial.emg},
        Key{"external_torque", &trial.external_torque}, Key{"external_loads", &trial.external_loads},
        Key{"load_cell", &trial.load_cell}, Key{"fascicles", &trial.fascicles}, Key{"lengths", &trial.given.lengths},
        Key{"velocities", &trial.given.velocities}, Key{"torques", &trial.given.torques},
        Key{"forces", &trial.given.forces}}) {
    if (*path) require(key, **path);
  }
  for (const std::filesystem::path& path : trial.given.moment_arms) require("moment_arms", path);
}

/// Angles of a file, and whether its header says that some are in degrees.
struct AngleFile {
  TimeSeries angles;
  bool says_degrees = false;
};

/// Reads a storage file, whose header has one unit for all angles, or a table, whose columns have units of their own.
/// `is_angle` takes a column's name and whether it is the only one. Throws ReadError for an angle of a table in another
/// unit or in none.
AngleFile read_angles(const std::filesystem::path& path,
                      const std::vector<std::string>& coordinates,
                      const std::function<bool(const std::string&, bool)>& is_angle,
                      std::vector<Remark>& remarks) {
  if (format_of(path) != FileFormat::text_table) {
    const recording::Storage file = recording::read_storage(path);
    add_repairs(path, file.repairs, remarks);
    const bool alone = file.data.channel_count() == 1;
    return {recording::to_si(file, [&](const std::string& name) { return is_angle(name, alone); }), file.in_degrees};
  }
  recording::SeriesFile file = recording::read_series(path);
  add_repairs(path, file.repairs, remarks);
  for (const std::string& name : coordinates) recording::require_known_unit(path, file, name);
  for (const Channel& channel : file.data.channels()) {
    if (is_angle(channel.name, file.data.channel_count() == 1) && channel.unit != Unit::radian)
      throw ReadError(
          path, 0,
          fmt::format(
              "column '{}' {}, expected an angle; write its unit in the header, as in '{} [deg]'", channel.name,
              channel.unit == Unit::dimensionless ? "has no unit" : fmt::format("is in {}", symbol(channel.unit)),
              channel.name));
  }
  bool says_degrees = false;
  for (Eigen::Index c = 0; c < file.data.channel_count(); ++c)
    says_degrees |= file.data.channels()[static_cast<std::size_t>(c)].unit == Unit::radian &&
                    recording::written_factor(file, c) == kDegree;
  return {std::move(file.data), says_degrees};
}

TimeSeries read_motion(const Study& study,
                       const std::filesystem::path& path,
                       const body::BodyModel& model,
                       TrialInput& input) {
  // Without a body the only column is the angle of the only joint, by any name.
  const bool one_joint = study.model.is_none() && model.coordinates.size() == 1;
  const auto is_angle = [&](const std::string& name, bool alone) {
    const auto index = model.find_coordinate(name);
    return (one_joint && alone) ||
           (index && model.coordinates[static_cast<std::size_t>(*index)].motion == body::MotionType::rotational);
  };
  auto [motion, says_degrees] = read_angles(path, study_coordinates(study.model), is_angle, input.remarks);
  const bool only = one_joint && motion.channel_count() == 1;
  if (only) motion = {motion.time_s(), {{model.coordinates[0].name, Unit::radian}}, motion.values()};
  bool any = false;
  for (const Channel& channel : motion.channels()) any |= model.find_coordinate(channel.name).has_value();
  // A dynamometer's table may hold one angle, near 0: the trials of a study are judged together.
  const std::string doubt = check_angle_unit(path, says_degrees, motion);
  if (!doubt.empty() && format_of(path) != FileFormat::text_table)
    input.remarks.push_back({.code = RemarkCode::unit_doubtful,
                             .about = study.model.coordinate,
                             .says = fmt::format("{}: {}", path.filename().string(), doubt)});
  if (!any)
    throw ReadError(
        path, 0,
        fmt::format(
            "no column is a coordinate of the model; found {}, expected some of {}; rename the columns{}",
            channel_names(motion), name_list(model.coordinates, &body::Coordinate::name),
            study.model.is_none() ? ", or name the study's coordinate as they are (identify: --coordinate)" : ""));
  return motion;
}

TimeSeries read_trial_motion(const Study& study,
                             const TrialSpec& trial,
                             const body::BodyModel& model,
                             TrialInput& input) {
  TimeSeries motion = read_motion(study, *trial.motion, model, input);
  // Derivatives at given times follow from the whole motion, and `join_given_clocks` looks at its clock.
  if (!trial.given.lengths) motion = motion.slice(trial.start_s.value_or(-1e300), trial.end_s.value_or(1e300));
  require_finite(motion, trial.motion->string());
  const int least = trial.given.lengths ? 2 : kLeastOfATrial;
  if (motion.sample_count() < least) throw ReadError(*trial.motion, 0, few_samples(trial, motion, least));
  if (std::string pauses = trial.given.lengths ? "" : check_clock(*trial.motion, motion.time_s()); !pauses.empty())
    warn(input, RemarkCode::clock_pause, std::move(pauses));
  check_cutoff(study, *trial.motion, motion.time_s());
  return motion;
}

TimeSeries read_external_torque(const Study& study, const TrialSpec& trial, std::vector<Remark>& remarks) {
  recording::SeriesFile file = recording::read_series(*trial.external_torque);
  add_repairs(*trial.external_torque, file.repairs, remarks);
  std::vector<Channel> columns;
  std::vector<std::string> there;
  for (const std::string& name : study_coordinates(study.model)) {
    columns.push_back({name + "_moment", Unit::newton_meter});
    recording::require_known_unit(*trial.external_torque, file, columns.back().name);
    if (file.data.find(columns.back().name)) there.push_back(columns.back().name);
  }
  if (there.empty()) {
    throw ReadError(*trial.external_torque, 0,
                    fmt::format("no column '{}' [N m]{}", columns[0].name,
                                not_among(columns[0].name, file.data.channels(), &Channel::name)));
  }
  for (const std::string& name : there) {
    const Eigen::Index column = file.data.index(name);
    recording::require_unit(*trial.external_torque, file, column, Unit::newton_meter);
    const double to_si = recording::written_factor(file, column);
    if (to_si != 1.0)
      remarks.push_back(
          {.code = RemarkCode::reading,
           .severity = Severity::note,
           .about = name,
           .says = fmt::format("column '{}' is not in N m: by its unit its numbers times {:.6g} are", name, to_si)});
  }
  // A dynamometer acts on one joint only.
  const TimeSeries found = file.data.select(there);
  Eigen::MatrixXd torque = Eigen::MatrixXd::Zero(found.sample_count(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto column = found.find(columns[i].name);
    if (!column) continue;
    torque.col(static_cast<Eigen::Index>(i)) = found.values().col(*column);
    columns[i].missing = found.channels()[static_cast<std::size_t>(*column)].missing;
  }
  TimeSeries result(found.time_s(), std::move(columns), std::move(torque));
  if (const auto clock = loads_clock(study, trial, *trial.external_torque))
    result = recording::on_study_clock(std::move(result), *clock);
  require_finite(result, trial.external_torque->string());
  const Eigen::VectorXd used_s = result.slice(trial.start_s.value_or(-1e300), trial.end_s.value_or(1e300)).time_s();
  if (std::string pauses = check_clock(*trial.external_torque, used_s); !pauses.empty())
    remarks.push_back({.code = RemarkCode::clock_pause, .says = std::move(pauses)});
  return result;
}

/// Returns the part of the motion with measured loads, if more than 0.1 s of it has none: neither the last value nor a
/// line through the last two is a load of the time after it. Load cells and force plates refuse such a motion where
/// they are read.
std::optional<Cover> cover_by_files(const TrialSpec& trial, const TrialInput& input) {
  if (trial.external_loads) {
    const Eigen::Vector2d clock(input.loads->start_s, input.loads->end_s);
    if (auto cover = check_cover(*trial.external_loads, "force", clock, trial, input)) return cover;
  }
  if (!trial.external_torque) return std::nullopt;
  return check_cover(*trial.external_torque, "torque", input.external_torque->time_s(), trial, input);
}

/// Warns if the study's start_s or end_s lies outside of the recording: a file that was cut off ends early.
void warn_of_window(const TrialSpec& trial, TrialInput& input) {
  if (!input.markers && !input.motion) return;
  const Eigen::VectorXd& time_s = input.markers ? input.markers->time_s : input.motion->time_s();
  const double begin_s = time_s[0], end_s = time_s[time_s.size() - 1];
  const double asked_from_s = trial.start_s.value_or(begin_s), asked_to_s = trial.end_s.value_or(end_s);
  if (begin_s - asked_from_s <= kLimits.clocks.uncovered_s && asked_to_s - end_s <= kLimits.clocks.uncovered_s) return;
  warn(input, RemarkCode::general,
       fmt::format(
           "start_s and end_s ask for {:.4g} to {:.4g} s, and the files of the trial cover {:.4g} to {:.4g} s of "
           "them. Was a file cut off?",
           asked_from_s, asked_to_s, begin_s, end_s));
}

}  // namespace

TrialInput read_trial_input(const Study& study, const TrialSpec& trial, const body::BodyModel& model) {
  TrialInput input;
  require_files(trial);
  const auto remember = [&](const std::filesystem::path& path) {
    input.files.push_back({path.string(), sha256(read_bytes(path))});
  };
  if (trial.markers) {
    remember(*trial.markers);
    input.markers = read_trial_markers(study, trial, model, input);
  }
  if (trial.motion) {
    remember(*trial.motion);
    input.motion = read_trial_motion(study, trial, model, input);
  }
  read_given_stages(study, trial, model, remember, input);
  if (trial.emg) {
    remember(*trial.emg);
    input.emg = read_trial_emg(study, trial, remember, input);
  }
  if (trial.external_torque) {
    remember(*trial.external_torque);
    input.external_torque = read_external_torque(study, trial, input.remarks);
  }
  if (trial.fascicles) {
    remember(*trial.fascicles);
    input.fascicles = read_fascicles(study, model, *trial.fascicles, input.remarks);
    if (input.markers || input.motion)
      require_times_of_trial(*trial.fascicles, *input.fascicles,
                             input.markers ? input.markers->time_s : input.motion->time_s());
  }
  input.loads = read_trial_loads(study, trial, model, input.markers, remember, input.remarks);
  return input;
}

namespace {

/// As read_trial_parts; `of_study`: start_s and end_s of the trial are the study's.
std::vector<TrialPart> parts_of(const Study& study,
                                const TrialSpec& trial,
                                const body::BodyModel& model,
                                bool of_study) {
  std::vector<TrialPart> parts;
  try {
    TrialPart whole{trial, read_trial_input(study, trial, model)};
    join_given_clocks(whole.spec, whole.input);
    const auto cover = cover_by_files(trial, whole.input);
    if (!cover) {
      if (of_study) warn_of_window(trial, whole.input);
      parts.push_back(std::move(whole));
      return parts;
    }
    TrialSpec within = trial;
    within.start_s = cover->begin_s;
    within.end_s = cover->end_s;
    parts = parts_of(study, within, model, false);
    for (TrialPart& part : parts) {
      part.input.lengths = lengths_of(trial, whole.input);
      warn(part.input, RemarkCode::general,
           cover->lacks + ": those seconds are left out. A file that was cut off ends early, too");
    }
    return parts;
  } catch (const ClockPause& pause) {
    if (study.ik.calibrate) throw;
    int number = 0;
    for (const Stretch& stretch : pause.stretches()) {
      TrialSpec spec = trial;
      spec.name = fmt::format("{}.{}", trial.name, ++number);
      spec.start_s = std::max(trial.start_s.value_or(stretch.begin_s), stretch.begin_s);
      spec.end_s = std::min(trial.end_s.value_or(stretch.end_s), stretch.end_s);
      if (*spec.end_s - *spec.start_s < kShortestPart_s) continue;
      // The other recording may have pauses elsewhere.
      for (TrialPart& part : parts_of(study, spec, model, false)) parts.push_back(std::move(part));
    }
    if (parts.empty()) throw;
    for (TrialPart& part : parts) {
      warn(part.input, RemarkCode::clock_pause,
           fmt::format("part of trial '{}', which is cut at the pauses of its clock ({})", trial.name,
                       pause.path().filename().string()));
    }
  }
  return parts;
}

}  // namespace

std::vector<TrialPart> read_trial_parts(const Study& study, const TrialSpec& trial, const body::BodyModel& model) {
  return parts_of(study, trial, model, true);
}

}  // namespace myoid::study
