#include "myoid/program/steps/muscle.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/program/steps/check_options.h"
#include "myoid/program/steps/muscle_input.h"
#include "myoid/recording/series_file.h"

namespace myoid::program {
namespace {

using muscle::IsolatedRecording;

/// Returns the sets of laws that --laws names.
std::vector<muscle::LawSet> law_sets(const std::vector<std::string>& words) {
  std::vector<muscle::LawSet> sets;
  for (const std::string& word : words) {
    if (word == "all")
      return {muscle::LawSet::paper, muscle::LawSet::thelen, muscle::LawSet::de_groote, muscle::LawSet::millard,
              muscle::LawSet::soest};
    const std::optional<muscle::LawSet> set = choice_named<muscle::LawSet>(word);
    if (!set)
      throw InvalidInput(
          fmt::format("--laws {}: expected all, or some of {}", word, fmt::join(muscle::kLawSetNames, ", ")));
    if (std::ranges::find(sets, *set) == sets.end()) sets.push_back(*set);
  }
  return sets;
}

/// A measurement may have gaps: samples without a force are no part of it.
ColumnChoice measured_column(const MuscleOptions& o) {
  return {"--measured-column", o.measured_column, Unit::newton, Gaps::left_out};
}

/// Throws InvalidInput for a name that says another format than the file would have.
void require_ending(const char* option, const std::string& path, std::string_view ending) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  const bool is_device = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  if (path.empty() || is_device || extension_of(path) == ending) return;
  throw InvalidInput(fmt::format("{} {}: expected a name that ends in {}, since with --fit this file is {}", option,
                                 path, ending, ending == ".csv" ? "a table of parameters" : "a muscle"));
}

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
  if (!o.fit.empty()) {
    require_ending("--out", o.out, ".csv");
    require_ending("--fitted", o.fitted, ".toml");
  }
  (void)law_sets(o.laws);  // before the recordings are read
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
    measured = read_column(o.measured.front(), measured_column(o), remarks);
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

std::vector<IsolatedRecording> read_recordings(const MuscleOptions& o,
                                               const muscle::MuscleFile& file,
                                               Remarks& remarks) {
  std::vector<IsolatedRecording> recordings;
  for (std::size_t i = 0; i < o.lengths.size(); ++i) {
    const Column force = read_column(o.measured[i], measured_column(o), remarks);
    recordings.push_back({o.measured[i], read_experiment(o, i, file, remarks), force.time_s, force.values});
  }
  return recordings;
}

MuscleFit fit_of(const MuscleOptions& o, const muscle::MuscleFile& file, Remarks& remarks) {
  const muscle::IsolatedModel start{file.parameters, file.laws, file.millard, file.response};
  // Outside of the aggregate: GCC 12 destroys members that it has not made where an initializer throws.
  const std::vector<muscle::LawSet> laws = law_sets(o.laws);
  const MuscleFitSettings settings{.fit = {.parameters = o.fit,
                                           .own = o.own,
                                           .relative_tolerance = std::max(o.tolerance, 1e-7),
                                           .progress = o.call.progress},
                                   .laws = laws,
                                   .relative_to_n = related_to(o, file)};
  return fit_muscle(start, read_recordings(o, file, remarks), settings, remarks);
}

/// Returns the muscle with the numbers and laws of the fit.
muscle::MuscleFile fitted_file(muscle::MuscleFile file, const muscle::IsolatedModel& model) {
  file.parameters = model.parameters;
  file.laws = model.laws;
  file.millard = model.millard;
  file.response = model.response;
  return file;
}

/// Returns the rows of a fit; `left_out` counts the recordings from 1, empty: none.
std::string table_rows(const std::string& left_out,
                       const muscle::IsolatedFit& fit,
                       const std::vector<EstimateJudgment>& judgments) {
  std::string rows;
  for (std::size_t i = 0; i < fit.estimates.size(); ++i) {
    const muscle::IsolatedEstimate& e = fit.estimates[i];
    rows += fmt::format("{},{},{},{},{},{},{},{}", left_out, e.parameter, symbol(e.unit), e.start, e.value,
                        e.told ? fmt::format("{}", e.std_error) : "", e.at_bound, e.scatter);
    rows += judgments.empty()
                ? ",,,\n"
                : fmt::format(",{},{},{}\n", judgments[i].low, judgments[i].high, fit::name(judgments[i].verdict));
  }
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
  v.texts("own", o.own,
          {.says = "Of these parameters those of which each recording has its own value around a common one.",
           .option = {.needs = "fit", .by_comma = true}});
  v.texts("laws", o.laws,
          {.says = "Sets of laws to compare by their errors on left-out recordings: all, or some of paper, thelen, "
                   "de_groote, millard, soest.",
           .otherwise = "those of the muscle",
           .option = {.needs = "fit", .by_comma = true}});
  v.path("fitted", o.fitted,
         {.says = "With --fit, the muscle with the estimates (.toml).", .option = {.needs = "fit"}});
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
    result.fit = fit_of(options, file, remarks);
    result.fitted = fitted_file(file, result.fit->all.model);
  }
  result.remarks = remarks.list();
  return result;
}

void write_muscle(const MuscleResult& result, const std::filesystem::path& path) {
  if (result.simulated) {
    recording::write_series(path, result.simulated->simulated.series, result.name,
                            {"myoid " + std::string(version()), result.command});
    return;
  }
  std::string csv = "left_out,parameter,unit,start,estimate,std_error,at_bound,scatter,ci_low,ci_high,verdict\n";
  csv += table_rows("", result.fit->all, result.fit->judgments);
  for (std::size_t i = 0; i < result.fit->without_one.size(); ++i)
    csv += table_rows(std::to_string(i + 1), result.fit->without_one[i], {});
  write_file(path, csv);
}

void write_fitted_muscle(const MuscleResult& result, const std::filesystem::path& path) {
  write_file(path, muscle::muscle_toml(*result.fitted));
}

}  // namespace myoid::program
