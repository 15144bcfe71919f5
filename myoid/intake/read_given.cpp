#include "myoid/intake/read_given.h"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/intake/clock_check.h"
#include "myoid/intake/limits.h"
#include "myoid/kinematics/motion_plausibility.h"
#include "myoid/math/spline.h"
#include "myoid/tables/series_file.h"

namespace myoid {
namespace {

using Path = std::filesystem::path;

class GivenReader {
 public:
  GivenReader(const Study& study,
              const TrialSpec& trial,
              const model::BodyModel& model,
              const Remember& remember,
              TrialInput& input)
      : study_(study), trial_(trial), model_(model), remember_(remember), input_(input) {}

  void read() {
    const GivenSpec& files = trial_.given;
    GivenStages& given = input_.given;
    if (files.lengths) {
      const TimeSeries whole = of_muscles(*files.lengths, Unit::meter);
      given.lengths = within(*files.lengths, whole);
      given.velocities = files.velocities
                             ? within(*files.velocities, of_muscles(*files.velocities, Unit::meter_per_second))
                             : rates_of(whole);
      for (Remark& remark : kinematics::implausible(*given.lengths)) {
        remark.where = trial_.name;
        remark.severity = Severity::warning;
        input_.remarks.push_back(std::move(remark));
      }
    }
    for (const Path& path : files.moment_arms) given.moment_arms.push_back(within(path, of_muscles(path, Unit::meter)));
    if (files.torques) given.torques = within(*files.torques, of_joints(*files.torques));
    if (files.forces) given.forces = within(*files.forces, of_muscles(*files.forces, Unit::newton));
    if (given.lengths) join_clocks(*given.lengths);
  }

 private:
  /// Reads a file whose numbers are in this unit, or have none.
  TimeSeries series_of(const Path& path, Unit unit) {
    remember_(path);
    recording::SeriesFile file = recording::read_series(path);
    add_repairs(path, file.repairs, input_.remarks);
    std::vector<Channel> channels = file.data.channels();
    for (Channel& channel : channels) {
      if (channel.unit != unit && channel.unit != Unit::dimensionless)
        throw ReadError(path, 0,
                        fmt::format("column '{}' is in {}, expected {}; correct the unit in the header", channel.name,
                                    symbol(channel.unit), symbol(unit)));
      channel.unit = unit;
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
                          fmt::format("no column '{}', which [[muscle]] {} needs; found {}", name, muscle.name,
                                      channel_names(all)));
      }
    }
    std::vector<std::string> there;
    for (const model::Muscle& muscle : model_.muscles) {
      if (all.find(muscle.name)) there.push_back(muscle.name);
    }
    return all.select(there);
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
                        fmt::format("no column '{}' or '{}_moment'; found {}", name, name, channel_names(all)));
      columns.push_back(*column);
      channels.push_back({name + "_moment", Unit::newton_meter});
    }
    return {all.time_s(), std::move(channels), all.values()(Eigen::all, columns)};
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

  /// Returns the samples in the times of the trial.
  TimeSeries within(const Path& path, const TimeSeries& whole) {
    require_finite(whole, path.string());
    TimeSeries series = whole.slice(trial_.start_s.value_or(-1e300), trial_.end_s.value_or(1e300));
    if (series.sample_count() < 10) throw ReadError(path, 0, few_samples(trial_, series));
    if (std::string pauses = check_clock(path, series.time_s()); !pauses.empty())
      warn(input_, RemarkCode::clock_pause, std::move(pauses));
    return series;
  }

  /// Keeps the samples of the lengths that every file and the motion cover, up to half a sample at the ends. Files that
  /// lack more are cut by `read_trial_parts`, which names them.
  void join_clocks(TimeSeries& lengths) {
    const double spare_s = 0.5 * lengths.mean_interval_s();
    const double first_s = lengths.time_s()[0] - spare_s;
    const double last_s = lengths.time_s()[lengths.sample_count() - 1] + spare_s;
    double begin_s = first_s, end_s = last_s;
    const auto cut = [&](const Eigen::VectorXd& time_s) {
      begin_s = std::max(begin_s, time_s[0] - spare_s);
      end_s = std::min(end_s, time_s[time_s.size() - 1] + spare_s);
    };
    for (const GivenFile& file : given_files(trial_, input_)) cut(file.series->time_s());
    if (input_.markers) cut(input_.markers->time_s);
    if (input_.motion) cut(input_.motion->time_s());
    if (!input_.markers && !input_.motion)
      input_.motion = TimeSeries(lengths.time_s(), {}, Eigen::MatrixXd(lengths.sample_count(), 0));
    if (std::max(begin_s - first_s, last_s - end_s) > kLimits.uncovered_s) return;
    lengths = lengths.slice(begin_s, end_s);
  }

  const Study& study_;
  const TrialSpec& trial_;
  const model::BodyModel& model_;
  const Remember& remember_;
  TrialInput& input_;
};

}  // namespace

void read_given_stages(const Study& study,
                       const TrialSpec& trial,
                       const model::BodyModel& model,
                       const Remember& remember,
                       TrialInput& input) {
  GivenReader(study, trial, model, remember, input).read();
}

std::vector<GivenFile> given_files(const TrialSpec& trial, const TrialInput& input) {
  const GivenSpec& files = trial.given;
  const GivenStages& given = input.given;
  std::vector<GivenFile> found;
  if (given.lengths) found.push_back({*files.lengths, "lengths", &*given.lengths});
  if (files.velocities && given.velocities) found.push_back({*files.velocities, "velocities", &*given.velocities});
  for (std::size_t j = 0; j < given.moment_arms.size(); ++j)
    found.push_back({files.moment_arms[j], "moment arms", &given.moment_arms[j]});
  if (given.torques) found.push_back({*files.torques, "torque", &*given.torques});
  if (given.forces) found.push_back({*files.forces, "forces", &*given.forces});
  return found;
}

}  // namespace myoid
