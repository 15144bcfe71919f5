#include "myoid/program/steps/muscle_input.h"

#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/program/steps/stage_input.h"
#include "myoid/recording/column_unit.h"
#include "myoid/recording/series_file.h"

namespace myoid::program {
namespace {

Column within_call(Column column, const Call& call) {
  if (!call.start_s && !call.end_s) return column;
  const TimeSeries all(column.time_s, {{column.name, Unit::dimensionless}}, column.values);
  const Eigen::Index last = all.sample_count() - 1;
  const TimeSeries part = all.slice(call.start_s.value_or(all.time_s()(0)), call.end_s.value_or(all.time_s()(last)));
  column.time_s = part.time_s();
  column.values = part.values().col(0);
  return column;
}

/// Returns the samples that have a number, and tells of the others.
Column without_gaps(const std::string& path, const Column& column, Remarks& remarks) {
  std::vector<Eigen::Index> told;
  for (Eigen::Index i = 0; i < column.values.size(); ++i)
    if (std::isfinite(column.values[i])) told.push_back(i);
  if (told.empty()) throw ReadError(path, 0, fmt::format("column '{}' has no number", column.name));
  remarks.warn(fmt::format("{}: {} of {} samples of '{}' have no number and are left out", path,
                           column.values.size() - std::ssize(told), column.values.size(), column.name));
  return {column.time_s(told), column.values(told), column.name};
}

void check_length(const Eigen::VectorXd& length_m, const muscle::MuscleFile& file, const std::string& path) {
  if (length_m.size() == 0) return;
  if (!(length_m.minCoeff() > 0.0)) {
    throw InvalidInput(
        fmt::format("{}: the muscle would be {:g} m long; expected a positive length in m (see --scale and --offset)",
                    path, length_m.minCoeff()));
  }
  const double usual_m = file.parameters.hill.optimal_fiber_length_m + file.parameters.hill.tendon_slack_length_m;
  // No muscle shortens to a third or lengthens to the triple of fiber and tendon at rest.
  if (length_m.maxCoeff() > 3.0 * usual_m || length_m.minCoeff() < 0.3 * usual_m) {
    throw InvalidInput(
        fmt::format("{}: the length goes from {:g} to {:g} m, fiber and tendon together are about {:g} m; expected "
                    "meters (see --scale and --offset), and not the file of forces",
                    path, length_m.minCoeff(), length_m.maxCoeff(), usual_m));
  }
}

/// Reads the drive: a number, or a file with the drive over time.
void read_drive(const MuscleOptions& o, std::size_t index, Remarks& remarks, muscle::IsolatedMuscleInput& input) {
  input.drive_is_excitation = !o.excitation.empty();
  const std::vector<std::string>& drives = input.drive_is_excitation ? o.excitation : o.activation;
  const std::string& drive = drives[drives.size() > 1 ? index : 0];
  if (const std::optional<double> constant = parse_number(drive)) {
    input.drive = Eigen::VectorXd::Constant(1, *constant);
    return;
  }
  const Column column = read_column(drive, {"--drive-column", o.drive_column}, remarks);
  input.drive_time_s = column.time_s;
  input.drive = column.values;
  const Eigen::Index last = column.time_s.size() - 1;
  if (column.time_s(0) > input.time_s(0) || column.time_s(last) < input.time_s(input.time_s.size() - 1)) {
    remarks.warn(fmt::format("{} covers {:g} to {:g} s only; beyond, its first and last value hold", drive,
                             column.time_s(0), column.time_s(last)));
  }
}

}  // namespace

Column read_column(const std::string& path, const ColumnChoice& choice, Remarks& remarks) {
  const std::string& wanted = choice.name;
  const recording::SeriesFile file = recording::read_series(path);
  warn_of_repairs(path, file.repairs, remarks);
  const TimeSeries& series = file.data;
  const std::string names = name_list(series.channels(), &Channel::name);
  if (wanted.empty() && series.channel_count() != 1) {
    throw ReadError(path, 0, fmt::format("has the columns {}: choose one with {}", names, choice.option));
  }
  if (!wanted.empty() && !series.find(wanted)) {
    throw ReadError(path, 0,
                    fmt::format("has no column '{}' ({}){}", wanted, choice.option,
                                not_among(wanted, series.channels(), &Channel::name)));
  }
  const Eigen::Index at = wanted.empty() ? 0 : *series.find(wanted);
  if (choice.unit != Unit::dimensionless) recording::require_unit(path, file, at, choice.unit);
  Column column{series.time_s(), series.values().col(at), series.channels()[static_cast<std::size_t>(at)].name};
  if (column.values.allFinite()) return column;
  if (choice.gaps == Gaps::refused)
    throw ReadError(path, 0, fmt::format("column '{}' has gaps: fill them first", column.name));
  return without_gaps(path, column, remarks);
}

muscle::IsolatedMuscleInput read_experiment(const MuscleOptions& o,
                                            std::size_t index,
                                            const muscle::MuscleFile& file,
                                            Remarks& remarks) {
  const std::string& path = o.lengths[index];
  const Column length = within_call(read_column(path, {"--column", o.column, Unit::meter}, remarks), o.call);
  muscle::IsolatedMuscleInput input;
  input.time_s = length.time_s;
  const double scale = o.scales[o.scales.size() > 1 ? index : 0];
  input.length_m = (scale * length.values.array() + o.offset_m).matrix();
  check_length(input.length_m, file, path);
  read_drive(o, index, remarks, input);
  input.response = file.response;
  if (o.initial_activation == "settled") return input;
  input.initial_activation = parse_number(o.initial_activation);
  if (!input.initial_activation) {
    throw InvalidInput(
        fmt::format("--initial-activation {}: expected a number in 0 to 1, or `settled`", o.initial_activation));
  }
  return input;
}

}  // namespace myoid::program
