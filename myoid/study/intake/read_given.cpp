#include "myoid/study/intake/read_given.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/kinematics/motion_plausibility.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/math/spline.h"
#include "myoid/recording/column_unit.h"
#include "myoid/recording/series_file.h"
#include "myoid/recording/signals/clock_gaps.h"
#include "myoid/study/intake/emg_cover.h"
#include "myoid/study/intake/limits.h"

namespace myoid::study {
namespace {

using Path = std::filesystem::path;

double span_s(const Eigen::VectorXd& time_s) { return time_s[time_s.size() - 1] - time_s[0]; }

/// Returns a motion without columns at the samples of the lengths.
TimeSeries times_of(const TimeSeries& lengths) {
  return {lengths.time_s(), {}, Eigen::MatrixXd(lengths.sample_count(), 0)};
}

/// A file of a trial with its clock.
struct Clock {
  Path file;
  Eigen::VectorXd time_s;
};

/// Returns the clocks of all files of a trial that gives lengths; the lengths' own is the first.
std::vector<Clock> clocks_of(const TrialSpec& trial, const TrialInput& input) {
  const GivenSpec& files = trial.given;
  const GivenStages& given = input.given;
  std::vector<Clock> found{{*files.lengths, given.lengths->time_s()}};
  if (files.velocities) found.push_back({*files.velocities, given.velocities->time_s()});
  for (std::size_t j = 0; j < given.moment_arms.size(); ++j)
    found.push_back({files.moment_arms[j], given.moment_arms[j].time_s()});
  if (given.torques) found.push_back({*files.torques, given.torques->time_s()});
  if (given.forces) found.push_back({*files.forces, given.forces->time_s()});
  if (input.emg) found.push_back({*trial.emg, input.emg->time_s()});
  if (input.markers) found.push_back({*trial.markers, input.markers->time_s});
  if (trial.motion) found.push_back({*trial.motion, input.motion->time_s()});
  return found;
}

/// Warns of files that begin with the others and last a whole multiple, or part, of their time. Returns true if there
/// is one.
bool warn_of_other_rate(const std::vector<Clock>& clocks, TrialInput& input) {
  const auto ratio = [](const Clock& a, const Clock& b) { return span_s(a.time_s) / span_s(b.time_s); };
  const auto like = [&](const Clock& clock) {
    return std::ranges::count_if(
        clocks, [&](const Clock& other) { return std::abs(ratio(other, clock) - 1.0) < kLimits.clocks.ends_together; });
  };
  const Clock& usual = *std::ranges::max_element(clocks, {}, like);
  bool said = false;
  for (const Clock& clock : clocks) {
    const std::optional<double> factor = whole_factor(ratio(clock, usual), kLimits.clocks.ends_together);
    if (!factor || std::abs(clock.time_s[0] - usual.time_s[0]) > kLimits.clocks.same_begin_s) continue;
    warn(input, RemarkCode::emg_length,
         fmt::format("{}: lasts {:.4g} s, and {} {:.4g} s: {:g} times as long; is the rate of one of them wrong? "
                     "Correct its times, or state start and end of the trial if both did last so",
                     clock.file.string(), span_s(clock.time_s), usual.file.string(), span_s(usual.time_s), *factor));
    said = true;
  }
  return said;
}

/// Excludes the times in which a file has no samples: intervals above 0.1 s and five usual ones. Values there are
/// interpolated between neighbors.
void exclude_gaps(const std::vector<Clock>& clocks, TrialSpec& trial, TrialInput& input) {
  constexpr double kShortest_s = 0.1, kUsual = 5.0;
  constexpr double kSplines_s = 0.1;  // reach of a spline's ends
  constexpr double kBehind_s = 0.3;   // longest lag of torque behind EMG
  const Eigen::VectorXd& own_s = input.given.lengths->time_s();
  for (const Clock& clock : clocks) {
    const double usual_s = recording::find_clock_gaps(clock.time_s).usual_interval_s;
    for (Eigen::Index i = 0; i + 1 < clock.time_s.size(); ++i) {
      const double begin_s = clock.time_s[i], end_s = clock.time_s[i + 1];
      if (end_s - begin_s <= std::max(kShortest_s, kUsual * usual_s) || end_s <= own_s[0] ||
          begin_s >= own_s[own_s.size() - 1])
        continue;
      const Stretch out{begin_s - kSplines_s, end_s + (clock.file == trial.emg ? kBehind_s : kSplines_s)};
      trial.exclude.windows.push_back(out);
      warn(input, RemarkCode::clock_pause,
           fmt::format("{}: no samples from {:.3f} to {:.3f} s: {:.3f} to {:.3f} s are not fitted", clock.file.string(),
                       begin_s, end_s, out.begin_s, out.end_s));
    }
  }
}

class GivenReader {
 public:
  GivenReader(const Study& study,
              const TrialSpec& trial,
              const body::BodyModel& model,
              const Remember& remember,
              TrialInput& input)
      : study_(study), trial_(trial), model_(model), remember_(remember), input_(input) {}

  void read() {
    const GivenSpec& files = trial_.given;
    GivenStages& given = input_.given;
    if (files.lengths) {
      const TimeSeries whole = of_muscles(*files.lengths, Unit::meter);
      given.lengths = within(whole);
      given.velocities =
          files.velocities ? of_muscles(*files.velocities, Unit::meter_per_second) : within(rates_of(whole));
      for (Remark& remark : body::implausible_motion(*given.lengths)) {
        remark.where = trial_.name;
        remark.severity = Severity::warning;
        input_.remarks.push_back(std::move(remark));
      }
    }
    for (const Path& path : files.moment_arms) given.moment_arms.push_back(of_muscles(path, Unit::meter));
    if (files.torques) given.torques = of_joints(*files.torques);
    if (files.forces) given.forces = of_muscles(*files.forces, Unit::newton);
    if (given.lengths && !input_.markers && !input_.motion) input_.motion = times_of(*given.lengths);
  }

 private:
  /// Reads a file whose numbers are in this unit, or have none.
  TimeSeries series_of(const Path& path, Unit unit) {
    remember_(path);
    recording::SeriesFile file = recording::read_series(path);
    add_repairs(path, file.repairs, input_.remarks);
    std::vector<Channel> channels = file.data.channels();
    for (std::size_t c = 0; c < channels.size(); ++c) {
      recording::require_unit(path, file, static_cast<Eigen::Index>(c), unit);
      channels[c].unit = unit;
    }
    return {file.data.time_s(), std::move(channels), file.data.values()};
  }

  /// Reads the columns of the model's muscles; those of the study must be there.
  TimeSeries of_muscles(const Path& path, Unit unit) {
    const TimeSeries all = series_of(path, unit);
    for (const MuscleSpec& muscle : study_.muscles) {
      for (const std::string& name : muscle.osim) {
        if (!all.find(name))
          throw ReadError(path, 0,
                          fmt::format("no column '{}', which [[muscle]] {} needs{}", name, muscle.name,
                                      not_among(name, all.channels(), &Channel::name)));
      }
    }
    std::vector<std::string> there;
    for (const body::Muscle& muscle : model_.muscles) {
      if (all.find(muscle.name)) there.push_back(muscle.name);
    }
    TimeSeries found = all.select(there);
    require_finite(found, path.string());
    return found;
  }

  /// Reads the torque of each coordinate; of a single coordinate also the only column of any name.
  TimeSeries of_joints(const Path& path) {
    const TimeSeries all = series_of(path, Unit::newton_meter);
    std::vector<Channel> channels;
    std::vector<Eigen::Index> columns;
    const std::vector<std::string> coordinates = study_coordinates(study_.model);
    for (const std::string& name : coordinates) {
      auto column = all.find(name + "_moment");
      if (!column) column = all.find(name);
      if (!column && coordinates.size() == 1 && all.channel_count() == 1) column = 0;
      if (!column)
        throw ReadError(path, 0,
                        fmt::format("no column '{}' or '{}_moment'{}; the study's coordinate (identify: "
                                    "--coordinate) names the column",
                                    name, name, not_among(name, all.channels(), &Channel::name)));
      columns.push_back(*column);
      channels.push_back({name + "_moment", Unit::newton_meter});
    }
    std::vector<std::string>& names = input_.given.torque_columns;
    for (const Eigen::Index column : columns) names.push_back(all.channels()[static_cast<std::size_t>(column)].name);
    for (const Channel& channel : all.channels()) {
      if (std::ranges::find(names, channel.name) == names.end()) names.push_back(channel.name);
    }
    TimeSeries found(all.time_s(), std::move(channels), all.values()(Eigen::all, columns));
    require_finite(found, path.string());
    return found;
  }

  static TimeSeries rates_of(const TimeSeries& lengths) {
    const math::SplineKnots knots(lengths.time_s());
    std::vector<Channel> channels = lengths.channels();
    for (Channel& channel : channels) channel.unit = Unit::meter_per_second;
    Eigen::MatrixXd rates(lengths.sample_count(), lengths.channel_count());
    for (Eigen::Index c = 0; c < rates.cols(); ++c)
      rates.col(c) = knots.interpolate(lengths.values().col(c)).evaluate(lengths.time_s()).first;
    return {lengths.time_s(), std::move(channels), std::move(rates)};
  }

  /// Returns the lengths' samples in the times of the trial.
  TimeSeries within(const TimeSeries& whole) const {
    TimeSeries series = whole.slice(trial_.start_s.value_or(-1e300), trial_.end_s.value_or(1e300));
    if (series.sample_count() < 2) throw ReadError(*trial_.given.lengths, 0, few_samples(trial_, series, 2));
    return series;
  }

  const Study& study_;
  const TrialSpec& trial_;
  const body::BodyModel& model_;
  const Remember& remember_;
  TrialInput& input_;
};

}  // namespace

void read_given_stages(const Study& study,
                       const TrialSpec& trial,
                       const body::BodyModel& model,
                       const Remember& remember,
                       TrialInput& input) {
  GivenReader(study, trial, model, remember, input).read();
}

void join_given_clocks(TrialSpec& trial, TrialInput& input) {
  if (!input.given.lengths) return;
  const std::vector<Clock> clocks = clocks_of(trial, input);
  const bool other_rate = !trial.start_s && !trial.end_s && warn_of_other_rate(clocks, input);
  TimeSeries& lengths = *input.given.lengths;
  const double asked_s = span_s(lengths.time_s()), asked_from_s = lengths.time_s()[0];
  const Clock* shortest = nullptr;  // the file that leaves out most
  double most_left_out_s = 0.0;
  for (const Clock& clock : clocks) {
    const double begin_s = lengths.time_s()[0], end_s = lengths.time_s()[lengths.sample_count() - 1];
    const double first_s = clock.time_s[0], last_s = clock.time_s[clock.time_s.size() - 1];
    // A gap of half a sample at the ends is within the resolution of the clocks.
    const double spare_s = 0.5 * lengths.mean_interval_s();
    if (begin_s >= first_s - spare_s && end_s <= last_s + spare_s) continue;
    const bool apart = last_s <= begin_s || first_s >= end_s;
    if (!apart) lengths = lengths.slice(first_s - 1e-9, last_s + 1e-9);
    if (apart || lengths.sample_count() < 2)
      throw ReadError(
          clock.file, 0,
          fmt::format("covers {:g} to {:g} s, {} covers {:g} to {:g} s: they must overlap; bring them to one clock",
                      first_s, last_s, clocks.front().file.string(), begin_s, end_s));
    const double left_out_s = end_s - begin_s - span_s(lengths.time_s());
    if (left_out_s <= most_left_out_s) continue;
    most_left_out_s = left_out_s;
    shortest = &clock;
  }
  const double used_s = span_s(lengths.time_s());
  if (shortest != nullptr && asked_s - used_s > kLimits.clocks.uncovered_s && !other_rate)
    input.remarks.push_back(
        {.code = RemarkCode::emg_cover,
         .severity = used_s < kLimits.clocks.covered * asked_s ? Severity::warning : Severity::note,
         .says =
             fmt::format("{}: {:.3g} of {:.3g} s are used, the time that all files of the trial cover; it has "
                         "{:.4g} to {:.4g} s, and {} {:.4g} to {:.4g} s. Was one of them cut off, or is its clock "
                         "another?",
                         clocks.front().file.string(), used_s, asked_s, asked_from_s, asked_from_s + asked_s,
                         shortest->file.string(), shortest->time_s[0], shortest->time_s[shortest->time_s.size() - 1])});
  if (!trial.motion && !input.markers) input.motion = times_of(lengths);
  exclude_gaps(clocks, trial, input);
}

}  // namespace myoid::study
