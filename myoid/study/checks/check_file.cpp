#include "myoid/study/checks/check_file.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/kinematics/motion_plausibility.h"
#include "myoid/body/model/model_plausibility.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/angle_unit.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/label_match.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/angle_file.h"
#include "myoid/recording/channel_choice.h"
#include "myoid/recording/column_unit.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/plate_standing.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/series_file.h"
#include "myoid/recording/signals/clock_gaps.h"
#include "myoid/recording/signals/clock_offset.h"
#include "myoid/recording/signals/emg_envelope.h"
#include "myoid/recording/signals/emg_levels.h"
#include "myoid/recording/signals/emg_quality.h"
#include "myoid/recording/signals/marker_quality.h"
#include "myoid/recording/signals/plate_quality.h"
#include "myoid/recording/tables/result_units.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/study/intake/trial_input.h"

namespace myoid::study {
namespace {

/// Returns the channels that may be EMG, or only those named so if there are some, since others may be a load cell's. A
/// storage file has no units of channels: all of them count if its title states a voltage.
std::optional<TimeSeries> voltages(const std::filesystem::path& path,
                                   const AnalogChannels& analog,
                                   const std::vector<recording::PlateSetup>& plates) {
  const std::vector<std::string> names = recording::emg_channels(analog.channels(), plates);
  std::vector<std::string> named_emg;
  for (const std::string& name : names) {
    if (plain_label(name).find("emg") != std::string::npos) named_emg.push_back(name);
  }
  if (!named_emg.empty()) return analog.select(named_emg);
  if (!names.empty()) return analog.select(names);
  if (format_of(path) != FileFormat::storage) return std::nullopt;
  if (!recording::stated_voltage(recording::read_storage(path))) return std::nullopt;
  return recording::read_emg(path, "", false).data;
}

/// Reports channels of a recording whose EMG does not rise from rest.
std::vector<Remark> levels_alone(const TimeSeries& emg, bool raw, const std::string& where) {
  constexpr double kSlowest_hz = 100.0;  // twice the rate that the high-pass needs
  if (raw && emg.mean_rate_hz() < kSlowest_hz) return {};
  recording::EnvelopeOptions options;
  options.whitening = false;
  const recording::EmgStages stages = raw ? recording::process_emg(emg, options) : recording::EmgStages{};
  const std::vector<recording::TrialEnvelope> one{{where, false, raw ? &stages.envelope : &emg, {}, stages.flatness}};
  std::vector<Remark> faults = recording::check_emg_levels(one);
  // A muscle may rest or work throughout one recording. Noise alone is a fault.
  for (Remark& fault : faults) {
    const auto c = one.front().envelope->find(fault.about);
    const bool noise =
        fault.severity == Severity::error || (raw && c && stages.flatness[*c] > recording::kLimits.noise.flatness);
    const bool resting = fault.code == RemarkCode::emg_low_signal && !noise;
    fault.severity = std::max(fault.severity, resting ? Severity::note : Severity::warning);
  }
  return faults;
}

std::vector<Remark> joined(std::vector<Remark> all, std::vector<Remark> more) {
  std::ranges::move(more, std::back_inserter(all));
  return all;
}

/// Checks the EMG of a recording; of one that pauses the longest part, since filters bridge no pause.
std::vector<Remark> check_channels_of_emg(const std::filesystem::path& path, const TimeSeries& all) {
  constexpr double kPause = 2.5, kUneven = 0.2;  // intervals; as in find_clock_gaps and the filters
  require_finite(all, path.string());
  constexpr Eigen::Index kFewest = 10;
  if (all.sample_count() < kFewest)
    throw ReadError(path, 0,
                    fmt::format("only {} sample{} of EMG; at least {} are needed", all.sample_count(),
                                all.sample_count() == 1 ? "" : "s", kFewest));
  if (std::string slow = body::slow_clock(all.time_s()); !slow.empty())
    return {{.code = RemarkCode::refused, .severity = Severity::error, .says = std::move(slow)}};
  std::vector<Remark> faults;
  TimeSeries emg = all;
  if (const recording::ClockGaps gaps = recording::find_clock_gaps(all.time_s()); gaps.count > 0) {
    const std::vector<Stretch> parts = recording::clock_stretches(all.time_s(), kPause * gaps.usual_interval_s);
    const Stretch longest = *std::ranges::max_element(parts, {}, [](const Stretch& s) { return s.end_s - s.begin_s; });
    emg = all.slice(longest.begin_s, longest.end_s);
    faults.push_back({.code = RemarkCode::clock_pause,
                      .when = Stretch{gaps.longest_begin_s, gaps.longest_end_s},
                      .value = gaps.total_s,
                      .says = fmt::format("the EMG pauses ({}); its longest part, from {:.6g} to {:.6g} s, is checked",
                                          gaps.text(), longest.begin_s, longest.end_s),
                      .remedy = "no filter bridges a pause: take a part without one, by start_s and end_s of a trial "
                                "or --start and --end of emg"});
    if (emg.sample_count() < kFewest) return faults;
  }
  std::vector<Remark> found = recording::check_emg(emg, {.remedies = recording::EmgRemedies::none});
  const bool raw = std::ranges::none_of(found, [](const Remark& f) { return f.code == RemarkCode::emg_envelope; });
  faults = joined(std::move(faults), std::move(found));
  if (!raw || emg.is_uniform(kUneven)) {
    if (auto uneven = recording::check_clock_evenness(emg.time_s(), "EMG")) faults.push_back(std::move(*uneven));
    return joined(std::move(faults), levels_alone(emg, raw, path.filename().string()));
  }
  faults.push_back({.code = RemarkCode::clock_uneven,
                    .severity = Severity::error,
                    .says = "the samples of the EMG are not evenly spaced, and no filter takes them",
                    .remedy = "export them with an even clock, or give them one (myoid convert --rate)"});
  return faults;
}

/// Returns true for a name that speaks of an angle. Any file of OpenSim says `inDegrees=no`, whatever it holds.
bool names_an_angle(const std::string& name) {
  const std::string word = small_letters(name);
  return !recording::names_other_quantity(name) &&
         std::ranges::any_of(std::array{"angle", "flexion", "adduction", "abduction", "rotation", "_tilt"},
                             [&](const char* part) { return word.find(part) != std::string::npos; });
}

/// Returns true if a column that is named as a translation holds more than a hundred meters: it is a force, and the
/// others are torques that are named as coordinates.
bool has_forces_of_coordinates(const recording::Storage& file) {
  constexpr double kFarthest_m = 100.0;
  for (Eigen::Index c = 0; c < file.data.channel_count(); ++c) {
    const bool translation = recording::is_translation_by_name(file.data.channels()[static_cast<std::size_t>(c)].name);
    if (translation && (file.data.values().col(c).array().abs() > kFarthest_m).any()) return true;
  }
  return false;
}

/// Returns the motion of a file in rad and m: the coordinates of the model or, without one, the columns that are angles
/// or lengths by header and name. Empty if nothing is known of them.
TimeSeries angles_of(const recording::Storage& file, const body::BodyModel* model) {
  if (model != nullptr) {
    const auto is_angle = [&](const std::string& name) {
      const auto c = model->find_coordinate(name);
      return c && model->coordinates[static_cast<std::size_t>(*c)].motion == body::MotionType::rotational;
    };
    return recording::to_si(file, is_angle);
  }
  if (!recording::states_degrees(file) || (!file.in_degrees && has_forces_of_coordinates(file))) return {};
  const auto is_angle = [&](const std::string& name) {
    return file.in_degrees ? recording::is_angle_in_degrees(file, name) : names_an_angle(name);
  };
  std::vector<std::string> known;
  for (const Channel& channel : file.data.channels())
    if (is_angle(channel.name) || (file.in_degrees && recording::is_translation_by_name(channel.name)))
      known.push_back(channel.name);
  return recording::to_si(file, is_angle).select(known);
}

/// Returns the columns of a table whose header says radians.
TimeSeries radians_of(const std::filesystem::path& path) {
  const recording::SeriesFile file = recording::read_series(path);
  std::vector<std::string> names;
  for (Eigen::Index c = 0; c < file.data.channel_count(); ++c) {
    const Channel& channel = file.data.channels()[static_cast<std::size_t>(c)];
    if (channel.unit == Unit::radian && recording::written_factor(file, c) == 1.0) names.push_back(channel.name);
  }
  return file.data.select(names);
}

/// Compares a motion with the unit of its file.
std::vector<Remark> unit_doubts(const std::filesystem::path& path, bool says_degrees, const TimeSeries& motion) {
  try {
    const std::string doubt = check_angle_unit(path, says_degrees, motion);
    if (doubt.empty()) return {};
    return {{.code = RemarkCode::unit_doubtful, .says = doubt}};
  } catch (const ReadError& error) {
    return {{.code = RemarkCode::unit_doubtful, .severity = Severity::error, .says = error.what()}};
  }
}

}  // namespace

std::vector<Remark> check_motion_file(const std::filesystem::path& path, const body::BodyModel* model) {
  const recording::Storage file = recording::read_storage(path);
  const bool of_model = model != nullptr && std::ranges::any_of(file.data.channels(), [&](const Channel& channel) {
                          return model->find_coordinate(channel.name).has_value();
                        });
  if ((!of_model && !recording::may_hold_angles(file)) || recording::stated_voltage(file)) return {};
  const TimeSeries motion = angles_of(file, model);
  if (motion.empty()) return {};
  std::vector<Remark> found =
      joined(unit_doubts(path, file.in_degrees, motion),
             model != nullptr ? body::implausible_motion(*model, motion) : body::implausible_motion(motion));
  for (Remark& remark : found) remark.where = path.filename().string();
  return found;
}

std::vector<Remark> check_model_file(const std::filesystem::path& path) {
  const std::string where = path.filename().string();
  const body::BodyModel model = body::read_osim(path);
  std::vector<Remark> found;
  try {
    body::require_lengths_in_m(model, path);
  } catch (const InvalidInput& error) {
    found.push_back({.code = RemarkCode::refused, .severity = Severity::error, .says = error.what()});
  }
  for (const std::string& text : model.unsupported)
    found.push_back({.code = RemarkCode::model_unsupported, .says = text});
  for (const std::string& text : sentences(model.notes))
    found.push_back({.code = RemarkCode::reading, .severity = Severity::note, .says = text});
  found = joined(std::move(found), body::implausible(model));
  for (Remark& remark : found) remark.where = where;
  sort_by_severity(found);
  return found;
}

std::vector<Remark> check_recording(const std::filesystem::path& path,
                                    const std::optional<Vec3>& stated_up_L,
                                    const body::BodyModel* model) {
  recording::Recording file = recording::read_recording(path);
  const std::string where = path.filename().string();
  std::vector<Remark> findings;
  bool standing = true;
  try {
    const recording::LaboratoryUp up = recording::stand_plates(file, stated_up_L);
    if (up.up_L)
      findings.push_back({.code = RemarkCode::reading,
                          .severity = Severity::note,
                          .where = where,
                          .says = fmt::format("{} is up ({})", recording::axis_name(*up.up_L), up.because)});
  } catch (const InvalidInput& error) {
    findings.push_back(
        {.code = RemarkCode::refused, .severity = Severity::error, .where = where, .says = error.what()});
    standing = false;
  }
  for (const Repair& repair : file.repairs) {
    findings.push_back(remark_of(repair, recording::to_string(repair)));
    findings.back().where = where;
  }
  if (format_of(path) == FileFormat::storage) findings = joined(std::move(findings), check_motion_file(path, model));
  const auto add = [&](std::vector<Remark> faults) {
    for (Remark& fault : faults) {
      fault.where = where;
      findings.push_back(std::move(fault));
    }
  };
  std::vector<Remark> of_markers = recording::check_markers(file.markers);
  for (Remark& fault : of_markers) {
    // A label of the laboratory's list that nobody used. A study warns of it where its model has that marker.
    const Eigen::VectorXd& t = file.markers.time_s;
    const bool never = fault.code == RemarkCode::marker_gap && fault.value >= t[t.size() - 1] - t[0];
    if (never) fault.severity = std::max(fault.severity, Severity::note);
  }
  add(std::move(of_markers));
  const std::vector<Channel>& channels = file.analog.channels();
  if (format_of(path) == FileFormat::text_table &&
      std::ranges::find(channels, Unit::radian, &Channel::unit) != channels.end())
    add(unit_doubts(path, false, radians_of(path)));
  if (const auto emg = voltages(path, file.analog, file.plates)) add(check_channels_of_emg(path, *emg));
  for (const recording::PlateSetup& plate : file.plates) {
    if (standing) add(recording::check_force_plate(file.force_plate(plate)));
  }
  sort_by_severity(findings);
  return findings;
}

}  // namespace myoid::study
