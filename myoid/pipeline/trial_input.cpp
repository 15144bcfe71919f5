#include "myoid/pipeline/trial_input.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/recording/byte_source.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/storage_reader.h"
#include "myoid/recording/text_file.h"
#include "myoid/recording/toml_table.h"

namespace myoid::pipeline {
namespace {

void add_repairs(const std::filesystem::path& path,
                 const std::vector<recording::Repair>& repairs,
                 std::vector<std::string>& notes) {
  for (const recording::Repair& repair : repairs) {
    notes.push_back(
        repair.line > 0
            ? fmt::format("{}:{}: {}", path.filename().string(), repair.line, repair.message)
            : fmt::format("{}: {}", path.filename().string(), repair.message));
  }
}

recording::MarkerSeries read_markers(const Study& study,
                                     const std::filesystem::path& path,
                                     std::vector<std::string>& notes) {
  recording::MarkerFile file = recording::read_markers(path);
  add_repairs(path, file.repairs, notes);
  for (std::string& name : file.markers.names) {
    if (const auto it = study.markers.rename.find(name); it != study.markers.rename.end())
      name = it->second;
  }
  if (study.markers.up != 'y') {
    notes.push_back(fmt::format("{}: laboratory turned from {} up to y up",
                                path.filename().string(), study.markers.up));
    file.markers =
        recording::rotated(std::move(file.markers), recording::rotation_to_y_up(study.markers.up));
  }
  return std::move(file.markers);
}

TimeSeries read_motion(const std::filesystem::path& path,
                       const model::BodyModel& model,
                       std::vector<std::string>& notes) {
  const recording::Storage file = recording::read_storage(path);
  add_repairs(path, file.repairs, notes);
  const auto is_angle = [&](const std::string& name) {
    const auto index = model.find_coordinate(name);
    return index && model.coordinates[static_cast<std::size_t>(*index)].motion ==
                        model::MotionType::rotational;
  };
  TimeSeries motion = recording::to_si(file, is_angle);
  bool any = false;
  for (Eigen::Index c = 0; c < motion.channel_count(); ++c) {
    const Channel& channel = motion.channels()[static_cast<std::size_t>(c)];
    if (!model.find_coordinate(channel.name)) continue;
    any = true;
    if (channel.unit != Unit::radian) continue;
    const double largest = motion.values().col(c).cwiseAbs().maxCoeff();
    if (largest > 4.0 * kPi) {
      throw ReadError(
          path, 0,
          fmt::format("column '{}' reaches {:.4g} although the header says inDegrees={}: these are "
                      "degrees, not radians; write inDegrees=yes "
                      "into the header",
                      channel.name, file.in_degrees ? largest / kDegree : largest,
                      file.in_degrees ? "yes" : "no"));
    }
    const double range = motion.values().col(c).maxCoeff() - motion.values().col(c).minCoeff();
    if (file.in_degrees && largest < 3.5 * kDegree && range > 0.2 * kDegree) {
      notes.push_back(fmt::format(
          "{}: column '{}' stays below 3.5 degrees; if these are radians, write inDegrees=no",
          path.filename().string(), channel.name));
    }
  }
  if (!any) {
    std::string names;
    for (const model::Coordinate& c : model.coordinates)
      names += (names.empty() ? "" : ", ") + c.name;
    throw ReadError(path, 0,
                    fmt::format("no column is a coordinate of the model; found {}, expected some "
                                "of {}; rename the columns",
                                channel_names(motion), names));
  }
  return motion;
}

/// A muscle of the study may name its EMG by the muscle that the electrode is on (EMG-BIDS).
void name_by_target_muscle(const Study& study,
                           const std::filesystem::path& path,
                           recording::EmgFile& file,
                           std::vector<std::string>& notes) {
  std::vector<Channel> channels = file.data.channels();
  bool renamed = false;
  for (const MuscleSpec& muscle : study.muscles) {
    if (file.data.find(muscle.emg)) continue;
    std::vector<std::size_t> targets;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const auto it = file.target_muscle.find(channels[c].name);
      if (it != file.target_muscle.end() && recording::equal_ignoring_case(it->second, muscle.emg))
        targets.push_back(c);
    }
    if (targets.size() != 1) continue;
    notes.push_back(fmt::format("{}: channel '{}' is on {}", path.filename().string(),
                                channels[targets[0]].name, muscle.emg));
    channels[targets[0]].name = muscle.emg;
    renamed = true;
  }
  if (renamed) file.data = TimeSeries(file.data.time_s(), std::move(channels), file.data.values());
}

void require_channels(const Study& study,
                      const std::filesystem::path& path,
                      const TimeSeries& emg) {
  for (const MuscleSpec& muscle : study.muscles) {
    if (emg.find(muscle.emg)) continue;
    std::vector<std::string> names;
    for (const Channel& channel : emg.channels()) names.push_back(channel.name);
    const auto near = recording::nearest_word(muscle.emg, names);
    throw ReadError(
        path, 0,
        fmt::format(
            "no EMG channel '{}' for muscle {}; found {}{}; correct [[muscle]] emg in the study",
            muscle.emg, muscle.name, channel_names(emg),
            near ? fmt::format(" (did you mean '{}'?)", *near) : ""));
  }
}

}  // namespace

TrialInput read_trial_input(const Study& study,
                            const TrialSpec& trial,
                            const model::BodyModel& model) {
  TrialInput input;
  const auto remember = [&](const std::filesystem::path& path) {
    input.files.push_back({path.string(), sha256(recording::read_bytes(path))});
  };
  const double start = trial.start_s.value_or(-1e300);
  const double end = trial.end_s.value_or(1e300);
  if (trial.markers) {
    remember(*trial.markers);
    recording::MarkerSeries markers = read_markers(study, *trial.markers, input.notes);
    if (trial.start_s || trial.end_s) {
      Eigen::Index first = 0;
      while (first < markers.frame_count() && markers.time_s[first] < start) ++first;
      Eigen::Index last = markers.frame_count();
      while (last > first && markers.time_s[last - 1] > end) --last;
      markers.time_s = markers.time_s.segment(first, last - first).eval();
      markers.positions_m = markers.positions_m.middleRows(first, last - first).eval();
    }
    if (markers.frame_count() < 10)
      throw ReadError(*trial.markers, 0,
                      fmt::format("only {} frames; at least 10 are needed", markers.frame_count()));
    input.markers = std::move(markers);
  }
  if (trial.motion) {
    remember(*trial.motion);
    input.motion = read_motion(*trial.motion, model, input.notes).slice(start, end);
    require_finite(*input.motion, trial.motion->string());
    if (input.motion->sample_count() < 10)
      throw ReadError(*trial.motion, 0, "fewer than 10 samples in the time asked for");
  }
  if (trial.emg) {
    remember(*trial.emg);
    recording::EmgFile file =
        recording::read_emg(*trial.emg, study.emg.unit, study.emg.kind != EmgKind::raw);
    add_repairs(*trial.emg, file.repairs, input.notes);
    name_by_target_muscle(study, *trial.emg, file, input.notes);
    require_channels(study, *trial.emg, file.data);
    std::vector<std::string> wanted;
    for (const MuscleSpec& muscle : study.muscles) {
      if (std::find(wanted.begin(), wanted.end(), muscle.emg) == wanted.end())
        wanted.push_back(muscle.emg);
    }
    // The EMG may begin earlier than the motion: the delay reaches back.
    input.emg = file.data.select(wanted).slice(start - 0.5, end);
    require_finite(*input.emg, trial.emg->string());
    if (input.emg->sample_count() < 10)
      throw ReadError(*trial.emg, 0, "fewer than 10 samples in the time asked for");
    const Eigen::VectorXd& clock = input.emg->time_s();
    const Eigen::VectorXd* motion_clock = input.markers  ? &input.markers->time_s
                                          : input.motion ? &input.motion->time_s()
                                                         : nullptr;
    if (motion_clock != nullptr) {
      const double overlap =
          std::min(clock[clock.size() - 1], (*motion_clock)[motion_clock->size() - 1]) -
          std::max(clock[0], (*motion_clock)[0]);
      if (overlap < 0.5) {
        throw ReadError(*trial.emg, 0,
                        fmt::format("EMG ({:.3g} to {:.3g} s) and motion ({:.3g} to {:.3g} s) "
                                    "hardly overlap; are both on one clock?",
                                    clock[0], clock[clock.size() - 1], (*motion_clock)[0],
                                    (*motion_clock)[motion_clock->size() - 1]));
      }
    }
  }
  if (trial.external_torque) {
    remember(*trial.external_torque);
    recording::Storage file = recording::read_storage(*trial.external_torque);
    add_repairs(*trial.external_torque, file.repairs, input.notes);
    const std::string column = study.model.coordinate + "_moment";
    if (!file.data.find(column)) {
      throw ReadError(
          *trial.external_torque, 0,
          fmt::format("no column '{}' [N m]; found {}", column, channel_names(file.data)));
    }
    const TimeSeries one = file.data.select({column});
    input.external_torque = TimeSeries(one.time_s(), {{column, Unit::newton_meter}}, one.values());
    require_finite(*input.external_torque, trial.external_torque->string());
  }
  return input;
}

}  // namespace myoid::pipeline
