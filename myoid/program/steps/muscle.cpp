#include "myoid/program/steps/muscle.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/muscle/isolated_checks.h"
#include "myoid/program/steps/check_options.h"
#include "myoid/program/steps/muscle_input.h"
#include "myoid/recording/tables/storage_writer.h"

namespace myoid::program {
namespace {

using muscle::IsolatedFit;
using muscle::IsolatedRecording;

void refuse_contradictions(const MuscleOptions& o) {
  if (o.activation.empty() == o.excitation.empty()) {
    throw InvalidInput("give the drive once: --activation or --excitation, a number or a file");
  }
  const std::vector<std::string>& drive = o.excitation.empty() ? o.activation : o.excitation;
  if (drive.size() != 1 && drive.size() != o.lengths.size())
    throw InvalidInput(fmt::format("{}: {} for {} of --length; give one, or one each",
                                   o.excitation.empty() ? "--activation" : "--excitation",
                                   counted(drive.size(), "file"), o.lengths.size()));
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
  return o.isometric_n.value_or(file.parameters.hill.max_isometric_force_n);
}

ForceComparison compare_force(const Eigen::VectorXd& force_n,
                              const Eigen::VectorXd& measured_n,
                              double over_n,
                              Remarks& remarks) {
  const double error_n = (force_n - measured_n).cwiseAbs().mean();
  const ForceComparison comparison{error_n, error_n / over_n, force_n.size()};
  if (comparison.share > kErrorOfAGuess) {
    remarks.warn(
        fmt::format("the force misses the measured one by {:.0f} % of {:g} N, more than a guess would: are --length "
                    "and --measured exchanged, in another unit, or of another muscle?",
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
    measured = read_column(o.measured.front(), {"--measured-column", o.measured_column}, remarks);
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

/// Widens each standard error to the spread over fits without one recording (jackknife), and warns
/// of numbers that one recording decides.
void compare_left_out(const std::vector<IsolatedRecording>& recordings, MuscleFit& fit, Remarks& remarks) {
  for (const muscle::DecidedByOne& found : widen_to_jackknife(fit.all, fit.without_one)) {
    const muscle::IsolatedEstimate& e = fit.all.estimates[found.parameter];
    remarks.warn(fmt::format(
        "{} is {:.4g} {} without {}, {:.1f} of the fit's standard errors from {:.4g}: it hangs on that recording; its "
        "standard error is widened to the spread over the recordings",
        e.parameter, found.without, symbol(e.unit), recordings[found.recording].name, found.std_errors, e.value));
  }
}

std::vector<IsolatedRecording> read_recordings(const MuscleOptions& o,
                                               const muscle::MuscleFile& file,
                                               Remarks& remarks) {
  std::vector<IsolatedRecording> recordings;
  for (std::size_t i = 0; i < o.lengths.size(); ++i) {
    const Column force = read_column(o.measured[i], {"--measured-column", o.measured_column}, remarks);
    recordings.push_back({o.measured[i], read_experiment(o, i, file, remarks), force.time_s, force.values});
  }
  return recordings;
}

/// Warns of a search that left its start nowhere, of a better minimum elsewhere, and of parameters without an effect.
void warn_of_untold(const IsolatedFit& fit, Remarks& remarks) {
  if (!fit.moved)
    remarks.warn(
        "the search did not leave its start: the numbers are those of --muscle, not an answer of the recordings; start "
        "from values at which the muscle bears force (is it slack there?)");
  if (fit.from_elsewhere)
    remarks.warn(
        "the search from the values of --muscle ended in a worse minimum than a search from elsewhere, whose result "
        "this is: the recordings may have more minima; start from measured lengths, or identify fewer parameters");
  for (const muscle::IsolatedEstimate& e : fit.estimates) {
    if (!e.told)
      remarks.warn(fmt::format(
          "{}: the recordings do not tell it: under these laws the force does not depend on it, or other parameters "
          "undo its effect; {:.4g} {} is no estimate. Leave it out of --fit",
          e.parameter, e.value, symbol(e.unit)));
  }
}

std::vector<IsolatedFit> fits_without_one(const muscle::IsolatedModel& start,
                                          const std::vector<IsolatedRecording>& recordings,
                                          const muscle::IsolatedFitOptions& options) {
  std::vector<IsolatedFit> fits;
  for (std::size_t i = 0; recordings.size() > 1 && i < recordings.size(); ++i) {
    std::vector<IsolatedRecording> others = recordings;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    fits.push_back(fit_isolated_muscle(start, others, options));
  }
  return fits;
}

/// Adds the errors of every recording.
void add_errors(const muscle::IsolatedModel& start,
                const std::vector<IsolatedRecording>& recordings,
                double relative_tolerance,
                MuscleFit& fit) {
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const auto share = [&](const muscle::IsolatedModel& model) {
      return mean_force_error(model, recordings[i], relative_tolerance) / fit.relative_to_n;
    };
    fit.errors.push_back({.recording = recordings[i].name,
                          .starting_values = share(start),
                          .fitted = share(fit.all.model),
                          .predicted = fit.without_one.empty() ? std::numeric_limits<double>::quiet_NaN()
                                                               : share(fit.without_one[i].model)});
  }
}

void warn_of_misses(MuscleFit& fit, Remarks& remarks) {
  for (const RecordingErrors& error : fit.errors) {
    if (error.fitted <= kErrorOfAGuess) continue;
    remarks.warn(
        fmt::format("{}: the fit misses the force by {:.0f} % of {:.4g} N, more than a guess would: are the files of "
                    "--length and --measured in the same order, and in m and N?",
                    error.recording, 100.0 * error.fitted, fit.relative_to_n));
    fit.misses = true;
  }
}

/// Fits the parameters to all recordings and to all but each one, and compares the results. Throws
/// InvalidInput for forces that the muscle cannot produce.
MuscleFit fit_muscle(const MuscleOptions& o, const muscle::MuscleFile& file, Remarks& remarks) {
  const muscle::IsolatedModel start{file.parameters, file.laws, file.millard};
  const double max_isometric_n = start.parameters.hill.max_isometric_force_n;
  const muscle::IsolatedFitOptions options{
      .parameters = o.fit, .relative_tolerance = std::max(o.tolerance, 1e-8), .progress = o.call.progress};
  const std::vector<IsolatedRecording> recordings = read_recordings(o, file, remarks);
  for (const std::string& text : check_force_size(recordings, max_isometric_n)) remarks.warn(text);
  for (const std::string& text : check_recording_order(start, recordings, options.relative_tolerance))
    remarks.warn(text);
  MuscleFit fit;
  fit.relative_to_n = related_to(o, file);
  fit.all = fit_isolated_muscle(start, recordings, options);
  warn_of_untold(fit.all, remarks);
  muscle::IsolatedFitOptions near = options;
  near.other_starts = 0;
  fit.without_one = fits_without_one(fit.all.from_elsewhere ? fit.all.model : start, recordings, near);
  const auto converged = [](const IsolatedFit& one) {
    return one.termination == math::Termination::converged && one.moved;
  };
  fit.converged = converged(fit.all) && std::ranges::all_of(fit.without_one, converged);
  add_errors(start, recordings, options.relative_tolerance, fit);
  compare_left_out(recordings, fit, remarks);
  warn_of_misses(fit, remarks);
  return fit;
}

/// Returns the rows of a fit; `left_out` counts the recordings from 1, empty: none.
std::string table_rows(const std::string& left_out, const muscle::IsolatedFit& fit) {
  std::string rows;
  for (const muscle::IsolatedEstimate& e : fit.estimates)
    rows += fmt::format("{},{},{},{},{},{},{}\n", left_out, e.parameter, symbol(e.unit), e.start, e.value,
                        e.told ? fmt::format("{}", e.std_error) : "", e.at_bound);
  return rows;
}

}  // namespace

std::vector<std::string> MuscleOptions::inputs() const {
  std::vector<std::string> files{muscle};
  for (const auto* more : {&lengths, &activation, &excitation, &measured})
    files.insert(files.end(), more->begin(), more->end());
  return files;
}

void visit(MuscleOptions& o, study::SettingVisitor& v) {
  v.path("muscle", o.muscle, {.says = "The muscle (.toml).", .required = "a file"});
  v.paths("length", o.lengths,
          {.says = "Length of fiber and tendon together over time [m] (.sto, .mot, .csv).", .required = "a file"});
  v.text("column", o.column, {.says = "Which column of it.", .otherwise = "the only one"});
  v.numbers("scale", o.scales, {.says = "Its numbers times this ...; with several files one for each."});
  v.number("offset", o.offset_m, {.says = "... plus this are the length [m]."});
  v.texts("activation", o.activation,
          {.says = "Activation, a number in 0..1 or a file; with several --length one, or one for each.",
           .option = {.or_number = true}});
  v.texts("excitation", o.excitation,
          {.says = "Excitation, a number in 0..1 or a file; with several --length one, or one for each.",
           .option = {.or_number = true}});
  v.text("drive-column", o.drive_column, {.says = "Which column of these files.", .otherwise = "the only one"});
  v.text("initial-activation", o.initial_activation,
         {.says = "Activation at the start, with --excitation: a number, or `settled` on the first excitation.",
          .otherwise = "0.01, at rest",
          .option = {.or_number = true}});
  v.paths("measured", o.measured, {.says = "Measured force over time [N], to compare."});
  v.text("measured-column", o.measured_column, {.says = "Which column of it.", .otherwise = "the only one"});
  v.texts("fit", o.fit,
          {.says = "Parameters to identify from one or several --length and --measured, by comma: "
                   "max_isometric_force,tendon_strain,...; each recording is also predicted from the others.",
           .option = {.by_comma = true}});
  v.number("isometric-force", o.isometric_n,
           {.says = "Force that the error is related to.",
            .limits = study::above_zero("N"),
            .otherwise = "F_max of the muscle"});
  v.number("tolerance", o.tolerance, {.says = "Relative, of the integration.", .limits = study::within(1e-13, 1e-3)});
  v.path("out", o.out,
         {.says = "Forces, lengths, velocities, activation over time (.sto); with --fit the parameters (.csv)."});
}

MuscleResult muscle(const MuscleOptions& options) {
  check_options(options);
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
  write_file(path, csv);
}

}  // namespace myoid::program
