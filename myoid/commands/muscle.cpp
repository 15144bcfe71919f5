#include "myoid/commands/muscle.h"

#include <fmt/format.h>

#include "myoid/commands/muscle_fit.h"
#include "myoid/commands/muscle_input.h"
#include "myoid/core/counted.h"
#include "myoid/core/error.h"
#include "myoid/core/provenance.h"
#include "myoid/files/atomic_file.h"
#include "myoid/tables/storage_writer.h"

namespace myoid::commands {
namespace {

void refuse_contradictions(const MuscleOptions& o) {
  if (o.activation.empty() == o.excitation.empty()) {
    throw InvalidInput("give the drive once: --activation or --excitation, a number or a file");
  }
  if (o.fit.empty() && (o.lengths.size() > 1 || o.measured.size() > 1))
    throw InvalidInput("several recordings are for --fit: without it, give one --length");
  if (!o.fit.empty() && o.measured.size() != o.lengths.size()) {
    throw InvalidInput(fmt::format("--measured: {} for {} of --length; --fit needs one each",
                                   counted(o.measured.size(), "file"), o.lengths.size()));
  }
  if (o.scales.size() != 1 && o.scales.size() != o.lengths.size()) {
    throw InvalidInput(fmt::format("--scale: {} numbers for {} files of --length; give one, or one each",
                                   o.scales.size(), o.lengths.size()));
  }
}

/// Returns the reference force of relative errors [N].
double related_to(const MuscleOptions& o, const muscle::MuscleFile& file) {
  return o.isometric_n > 0.0 ? o.isometric_n : file.parameters.hill.max_isometric_force_n;
}

ForceComparison compare_force(const Eigen::VectorXd& force_n,
                              const Eigen::VectorXd& measured_n,
                              double over_n,
                              Remarks& remarks) {
  const double error_n = (force_n - measured_n).cwiseAbs().mean();
  const ForceComparison comparison{error_n, error_n / over_n, force_n.size()};
  if (comparison.share > kErrorOfAGuess) {
    remarks.warn(
        fmt::format("the force misses the measured one by {:.0f} % of {:g} N, more than a guess "
                    "would: are --length and --measured exchanged, in another unit, or of "
                    "another muscle?",
                    100.0 * comparison.share, over_n));
  }
  return comparison;
}

ImposedLength simulate_muscle(const MuscleOptions& o, const muscle::MuscleFile& file, Remarks& remarks) {
  const muscle::Musculotendon<double> unit(file.parameters, file.laws, file.millard);
  const muscle::IsolatedMuscleInput input = read_experiment(o, 0, file, remarks);
  muscle::IsolatedMuscleOptions options;
  options.relative_tolerance = o.tolerance;
  options.absolute_tolerance = 1e-3 * o.tolerance;
  options.progress = o.call.progress;
  std::optional<Column> measured;
  if (!o.measured.empty()) {
    measured = read_column(o.measured.front(), "", remarks);
    options.output_time_s = measured->time_s;
  }
  ImposedLength result{simulate_isolated_muscle(unit, input, options), std::nullopt};
  if (result.simulated.status != math::OdeStatus::done) {
    remarks.warn(fmt::format("the simulation ended early, after {} of its samples: {}",
                             result.simulated.series.sample_count(), result.simulated.message));
    return result;
  }
  if (measured)
    result.comparison =
        compare_force(result.simulated.series.column("tendon_force"), measured->values, related_to(o, file), remarks);
  return result;
}

/// Returns the rows of a fit; `left_out` counts the recordings from 1, empty: none.
std::string table_rows(const std::string& left_out, const muscle::IsolatedFit& fit) {
  std::string rows;
  for (const muscle::IsolatedEstimate& e : fit.estimates)
    rows += fmt::format("{},{},{},{},{},{},{}\n", left_out, e.parameter, symbol(e.unit), e.start, e.value, e.std_error,
                        e.at_bound);
  return rows;
}

}  // namespace

MuscleResult muscle(const MuscleOptions& options) {
  refuse_contradictions(options);
  Remarks remarks(options.call);
  const muscle::MuscleFile file = muscle::read_muscle_file(options.muscle);
  MuscleResult result;
  result.name = file.name;
  result.command = options.call.command;
  if (options.fit.empty()) {
    result.simulated = simulate_muscle(options, file, remarks);
  } else {
    result.fit = fit_muscle(options, file, remarks);
  }
  result.remarks = remarks.list();
  return result;
}

void write_muscle(const MuscleResult& result, const std::filesystem::path& path) {
  if (result.simulated) {
    recording::write_storage(path, result.simulated->simulated.series,
                             {.title = result.name, .comments = {"myoid " + std::string(version()), result.command}});
    return;
  }
  std::string csv = "left_out,parameter,unit,start,estimate,std_error,at_bound\n";
  csv += table_rows("", result.fit->all);
  for (std::size_t i = 0; i < result.fit->without_one.size(); ++i)
    csv += table_rows(std::to_string(i + 1), result.fit->without_one[i]);
  recording::write_file(path, csv);
}

}  // namespace myoid::commands
