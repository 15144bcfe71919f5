#include "myoid/identify_files/identify_trial.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/angle_unit.h"
#include "myoid/core/error.h"
#include "myoid/intake/emg_cover.h"
#include "myoid/intake/limits.h"
#include "myoid/kinematics/motion_plausibility.h"
#include "myoid/math/spline.h"
#include "myoid/math/statistics.h"
#include "myoid/recording/recording.h"
#include "myoid/run/joint_of_arms.h"
#include "myoid/signals/resample.h"
#include "myoid/tables/series_file.h"
#include "myoid/tables/storage_reader.h"

namespace myoid {
namespace {

using identification::MuscleSetup;
using identification::TrialData;

/// Resamples finite values to another clock; equal clocks leave them unchanged.
Eigen::MatrixXd on_clock_of(const TimeSeries& series, const std::string& path, const Eigen::VectorXd& clock) {
  require_finite(series, path);
  if (series.time_s().size() == clock.size() && (series.time_s() - clock).cwiseAbs().maxCoeff() < 1e-9)
    return series.values();
  return signals::resample(series, clock).values();
}

/// Returns the rates of the columns on another clock, by the quintic spline through the columns.
Eigen::MatrixXd rates_of(const TimeSeries& series, const Eigen::VectorXd& clock) {
  const math::SplineKnots knots(series.time_s());
  Eigen::MatrixXd rates(clock.size(), series.channel_count());
  for (Eigen::Index c = 0; c < rates.cols(); ++c)
    rates.col(c) = knots.interpolate(series.values().col(c)).evaluate(clock).first;
  return rates;
}

/// Returns the columns of the torque file, one for each coordinate; without coordinates its only column.
std::vector<Channel> torque_columns(const std::vector<std::string>& coordinates,
                                    const std::string& path,
                                    const TimeSeries& torques) {
  if (coordinates.empty()) {
    if (torques.channel_count() != 1) {
      throw ReadError(
          path, 0, fmt::format("has several columns ({}); name the joint's with --coordinate", channel_names(torques)));
    }
    return torques.channels();
  }
  std::vector<Channel> columns;
  for (const std::string& coordinate : coordinates) {
    auto column = torques.find(coordinate);
    if (!column) column = torques.find(coordinate + "_moment");
    if (!column) {
      throw ReadError(
          path, 0,
          fmt::format("no column '{}' or '{}_moment'; found {}", coordinate, coordinate, channel_names(torques)));
    }
    columns.push_back(torques.channels()[static_cast<std::size_t>(*column)]);
  }
  return columns;
}

/// Returns the intervals between samples that exceed 0.1 s and five times the median interval.
std::vector<Stretch> gaps_of(const Eigen::VectorXd& time_s) {
  constexpr double kShortest_s = 0.1, kUsual = 5.0;
  std::vector<Stretch> gaps;
  if (time_s.size() < 3) return gaps;
  const Eigen::VectorXd steps = time_s.tail(time_s.size() - 1) - time_s.head(time_s.size() - 1);
  const double usual_s = math::median({steps.begin(), steps.end()});
  for (Eigen::Index i = 0; i < steps.size(); ++i) {
    if (steps[i] > std::max(kShortest_s, kUsual * usual_s)) gaps.push_back({time_s[i], time_s[i + 1]});
  }
  return gaps;
}

class TrialReader {
 public:
  TrialReader(const IdentifySources& sources, const std::vector<MuscleSetup>& muscles, const TellRemark& remark)
      : sources_(sources), muscles_(muscles), remark_(remark) {}

  TrialData read(std::size_t number) {
    const TrialFiles files = files_of(sources_, number);
    const std::string forces = sources_.forces.empty() ? "" : sources_.forces[number];
    const std::string motion = sources_.torque && !sources_.motions.empty() ? sources_.motions[number] : "";
    TrialData trial;
    trial.name = trial_label(sources_.lengths, number);
    trial.time_s = clock(files, {forces, motion});
    trial.length_m = columns_of(files.lengths, trial.time_s);
    say_implausible(files.lengths, muscle_series(files.lengths), Unit::meter);
    trial.velocity_mps = files.velocities.empty() ? rates_of(muscle_series(files.lengths), trial.time_s)
                                                  : columns_of(files.velocities, trial.time_s);
    trial.activation = selected(files.activations, &MuscleSetup::emg_channel);
    require_finite(trial.activation, files.activations);
    trial.torque_nm = Eigen::VectorXd::Zero(trial.time_s.size());
    trial.moment_arm_m = Eigen::MatrixXd::Zero(trial.time_s.size(), trial.length_m.cols());
    if (!forces.empty()) trial.force_n = columns_of(forces, trial.time_s);
    if (sources_.torque) add_torques(files, trial);
    if (!motion.empty()) add_motion(motion, trial);
    leave_out_gaps(files, {forces, motion}, trial);
    return trial;
  }

 private:
  const TimeSeries& series(const std::string& path) {
    const auto known = read_.find(path);
    if (known != read_.end()) return known->second;
    if (std::ranges::find(sources_.motions, path) != sources_.motions.end())
      return read_.emplace(path, motion_series(path)).first->second;
    recording::SeriesFile file = recording::read_series(path);
    for (const recording::Repair& repair : file.repairs) remark_(recording::to_string(path, repair));
    return read_.emplace(path, std::move(file.data)).first->second;
  }

  /// Remarks on what no movement does.
  void say_implausible(const std::string& path, const TimeSeries& series, Unit unit) {
    std::vector<Channel> channels = series.channels();
    for (Channel& channel : channels) channel.unit = unit;
    for (const Remark& found : kinematics::implausible({series.time_s(), std::move(channels), series.values()}))
      remark_(fmt::format("{}: {}", path, sentence(found)));
  }

  /// Returns the columns that a name of the muscles (`name`, `emg_channel`) names, each once.
  TimeSeries selected(const std::string& path, std::string MuscleSetup::*name) {
    const TimeSeries& all = series(path);
    std::vector<std::string> names;
    for (const MuscleSetup& m : muscles_) {
      if (!all.find(m.*name))
        throw ReadError(path, 0, fmt::format("no column '{}'; found {}", m.*name, channel_names(all)));
      if (std::ranges::find(names, m.*name) == names.end()) names.push_back(m.*name);
    }
    return all.select(names);
  }

  TimeSeries muscle_series(const std::string& path) { return selected(path, &MuscleSetup::name); }

  Eigen::MatrixXd columns_of(const std::string& path, const Eigen::VectorXd& clock_s) {
    return on_clock_of(muscle_series(path), path, clock_s);
  }

  /// Returns the times of the lengths within the requested time and the time that all files cover,
  /// because nothing is extrapolated.
  Eigen::VectorXd clock(const TrialFiles& files, const std::vector<std::string>& more) {
    TimeSeries lengths = series(files.lengths);
    if (sources_.start_s || sources_.end_s)
      lengths = lengths.slice(sources_.start_s.value_or(-1e300), sources_.end_s.value_or(1e300));
    if (lengths.sample_count() < 2) throw ReadError(files.lengths, 0, "fewer than two samples in the time asked for");
    const double asked_s = span_s(lengths), asked_from_s = lengths.time_s()[0];
    std::vector<std::string> all{files.lengths, files.activations, files.velocities, files.torques};
    all.insert(all.end(), more.begin(), more.end());
    all.insert(all.end(), files.moment_arms.begin(), files.moment_arms.end());
    const bool other_rate = !sources_.start_s && !sources_.end_s && say_other_rate(all);
    std::string shortest;  // the file that leaves out most
    double most_left_out_s = 0.0;
    std::vector<std::string> others{files.activations, files.velocities, files.torques};
    others.insert(others.end(), more.begin(), more.end());
    others.insert(others.end(), files.moment_arms.begin(), files.moment_arms.end());
    for (const std::string& file : others) {
      if (file.empty()) continue;
      const Eigen::VectorXd& time_s = series(file).time_s();
      const double begin_s = lengths.time_s()[0];
      const double end_s = lengths.time_s()[lengths.sample_count() - 1];
      const double last_s = time_s[time_s.size() - 1];
      // A gap of half a sample at the ends is within the resolution of the clocks.
      const double spare_s = 0.5 * (end_s - begin_s) / static_cast<double>(lengths.sample_count() - 1);
      if (begin_s >= time_s[0] - spare_s && end_s <= last_s + spare_s) continue;
      const bool apart = last_s <= begin_s || time_s[0] >= end_s;
      if (!apart) lengths = lengths.slice(time_s[0] - 1e-9, last_s + 1e-9);
      if (const double left_out_s = end_s - begin_s - span_s(lengths); left_out_s > most_left_out_s) {
        most_left_out_s = left_out_s;
        shortest = file;
      }
      if (apart || lengths.sample_count() < 2) {
        throw ReadError(
            file, 0,
            fmt::format("covers {:g} to {:g} s, {} covers {:g} to {:g} s: they must overlap; bring them to one clock",
                        time_s[0], last_s, files.lengths, begin_s, end_s));
      }
    }
    constexpr double kMost = 0.5;  // of the lengths' time
    if (span_s(lengths) < kMost * asked_s && !other_rate)
      remark_(
          fmt::format("{}: {:.3g} of {:.3g} s are used, the time that all files of the trial cover; it has {:.4g} to "
                      "{:.4g} s, and {} {:.4g} to {:.4g} s. Was one of them cut off, or is its clock another?",
                      files.lengths, span_s(lengths), asked_s, asked_from_s, asked_from_s + asked_s, shortest,
                      series(shortest).time_s()[0], series(shortest).time_s()[0] + span_s(series(shortest))));
    return lengths.time_s();
  }

  /// Remarks on files that begin with the others and last a whole multiple, or part, of their time.
  bool say_other_rate(std::vector<std::string> files) {
    std::erase(files, "");
    const auto ratio = [&](const std::string& a, const std::string& b) {
      return span_s(series(a)) / span_s(series(b));
    };
    const auto like = [&](const std::string& file) {
      return std::ranges::count_if(
          files, [&](const std::string& other) { return std::abs(ratio(other, file) - 1.0) < kLimits.ends_together; });
    };
    const std::string usual = *std::ranges::max_element(files, {}, like);
    bool said = false;
    for (const std::string& file : files) {
      const std::optional<double> factor = whole_factor(ratio(file, usual), kLimits.ends_together);
      if (!factor || std::abs(series(file).time_s()[0] - series(usual).time_s()[0]) > kLimits.same_begin_s) continue;
      remark_(
          fmt::format("{}: lasts {:.4g} s, and {} {:.4g} s: {:g} times as long; is the rate of one of them wrong? "
                      "Correct its times, or give --start and --end if both did last so",
                      file, span_s(series(file)), usual, span_s(series(usual)), *factor));
      said = true;
    }
    return said;
  }

  static double span_s(const TimeSeries& series) {
    return series.time_s()[series.sample_count() - 1] - series.time_s()[0];
  }

  /// Returns the files of a trial, each once.
  static std::vector<std::string> all_of(const TrialFiles& files, const std::vector<std::string>& more) {
    std::vector<std::string> all{files.lengths, files.activations, files.velocities, files.torques};
    all.insert(all.end(), more.begin(), more.end());
    all.insert(all.end(), files.moment_arms.begin(), files.moment_arms.end());
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    all.erase(std::remove(all.begin(), all.end(), ""), all.end());
    return all;
  }

  /// Excludes stretches without samples, whose values would be interpolated between neighbors.
  void leave_out_gaps(const TrialFiles& files, const std::vector<std::string>& more, TrialData& trial) {
    constexpr double kSplines_s = 0.1;  // reach of a spline's ends
    constexpr double kBehind_s = 0.3;   // longest lag of torque behind EMG
    const double begin_s = trial.time_s[0], end_s = trial.time_s[trial.time_s.size() - 1];
    for (const std::string& file : all_of(files, more)) {
      for (const Stretch& gap : gaps_of(series(file).time_s())) {
        if (gap.end_s <= begin_s || gap.begin_s >= end_s) continue;
        const double after_s = file == files.activations ? kBehind_s : kSplines_s;
        trial.excluded.push_back({gap.begin_s - kSplines_s, gap.end_s + after_s});
        remark_(fmt::format("{}: no samples from {:.3f} to {:.3f} s: {:.3f} to {:.3f} s are not fitted", file,
                            gap.begin_s, gap.end_s, trial.excluded.back().begin_s, trial.excluded.back().end_s));
      }
    }
  }

  void add_torques(const TrialFiles& files, TrialData& trial) {
    trial.moment_arm_m = columns_of(files.moment_arms[0], trial.time_s);
    const TimeSeries& torques = series(files.torques);
    const std::vector<Channel> columns = torque_columns(sources_.coordinates, files.torques, torques);
    for (std::size_t j = 0; j < columns.size(); ++j) {
      Eigen::VectorXd torque_nm = on_clock_of(torques.select({columns[j].name}), files.torques, trial.time_s).col(0);
      if (const std::string text = check_joint_by_name(files.moment_arms[j], columns[j].name, torques); !text.empty())
        remark_(text);
      if (j == 0) {
        trial.torque_nm = std::move(torque_nm);
        if (!sources_.coordinates.empty()) trial.joint = sources_.coordinates[0];
      } else {
        trial.more_joints.push_back({.joint = sources_.coordinates[j],
                                     .torque_nm = std::move(torque_nm),
                                     .moment_arm_m = columns_of(files.moment_arms[j], trial.time_s)});
      }
    }
  }

  /// Adds angle, speed and acceleration of every joint, by the whole file's quintic spline.
  void add_motion(const std::string& path, TrialData& trial) {
    const TimeSeries& angles = series(path);
    say_implausible(path, angles, Unit::radian);
    const auto column = [&](const std::string& joint) {
      const auto found = angles.find(joint);
      if (!found && !(sources_.coordinates.empty() && angles.channel_count() == 1)) {
        throw ReadError(
            path, 0,
            sources_.coordinates.empty()
                ? fmt::format("has several columns ({}); name the joint's with --coordinate", channel_names(angles))
                : fmt::format("no column '{}'; found {}", joint, channel_names(angles)));
      }
      return angles.values().col(found.value_or(0));
    };
    const auto set = [&](auto& joint, const std::string& name) {
      const math::Spline spline = sources_.motion_cutoff_hz
                                      ? math::Spline::smooth(angles.time_s(), column(name),
                                                             {.cutoff_hz = sources_.motion_cutoff_hz, .noise_sd = {}})
                                      : math::Spline::interpolate(angles.time_s(), column(name));
      math::SplineValues at = spline.evaluate(trial.time_s);
      joint.angle_rad = std::move(at.value);
      joint.velocity_radps = std::move(at.first);
      joint.acceleration_radps2 = std::move(at.second);
    };
    set(trial, trial.joint);
    for (identification::JointData& joint : trial.more_joints) set(joint, joint.joint);
  }

  /// Returns the angles of a file in radians.
  TimeSeries motion_series(const std::string& path) {
    const recording::Storage file = recording::read_storage(path);
    for (const recording::Repair& repair : file.repairs) remark_(recording::to_string(path, repair));
    TimeSeries angles = recording::to_si(file, [](const std::string&) { return true; });
    require_finite(angles, path);
    if (const std::string doubt = check_angle_unit(path, file.in_degrees, angles); !doubt.empty())
      remark_(fmt::format("{}: {}", std::filesystem::path(path).filename().string(), doubt));
    return angles;
  }

  const IdentifySources& sources_;
  const std::vector<MuscleSetup>& muscles_;
  const TellRemark& remark_;
  std::map<std::string, TimeSeries> read_;
};

}  // namespace

TrialData read_identify_trial(const IdentifySources& sources,
                              std::size_t number,
                              const std::vector<MuscleSetup>& muscles,
                              const TellRemark& remark) {
  return TrialReader(sources, muscles, remark).read(number);
}

}  // namespace myoid
