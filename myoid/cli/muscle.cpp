#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/cli/context.h"
#include "myoid/cli/stage_input.h"
#include "myoid/core/counted.h"
#include "myoid/core/error.h"
#include "myoid/core/json_text.h"
#include "myoid/core/provenance.h"
#include "myoid/files/atomic_file.h"
#include "myoid/files/text_file.h"
#include "myoid/muscle/fit_isolated.h"
#include "myoid/muscle/isolated_muscle.h"
#include "myoid/muscle/muscle_file.h"
#include "myoid/recording/recording.h"
#include "myoid/tables/series_file.h"
#include "myoid/tables/storage_writer.h"

namespace myoid::cli {
namespace {

struct MuscleOptions {
  std::string muscle, out, column, activation, excitation, initial = "0.01";
  std::vector<std::string> lengths, measured, fit;
  std::vector<double> scales{1.0};
  double offset_m = 0.0, isometric_n = 0.0, tolerance = 1e-9;
};

/// One column of a .sto, .mot, .csv, .tsv or .txt file: the only one, or the one of this name.
struct Column {
  Eigen::VectorXd time_s, values;
  std::string name;
};

Column read_column(const std::string& path, const std::string& wanted, const Context& context) {
  const recording::SeriesFile file = recording::read_series(path);
  for (const recording::Repair& repair : file.repairs)
    context.warn(recording::to_string(path, repair));
  const TimeSeries& series = file.data;
  std::string names;
  for (const Channel& channel : series.channels())
    names += (names.empty() ? "" : ", ") + channel.name;
  if (wanted.empty() && series.channel_count() != 1) {
    throw ReadError(path, 0, fmt::format("has the columns {}: choose one with --column", names));
  }
  if (!wanted.empty() && !series.find(wanted)) {
    throw ReadError(path, 0, fmt::format("has no column '{}'; there are {}", wanted, names));
  }
  const Eigen::Index at = wanted.empty() ? 0 : *series.find(wanted);
  Column column{series.time_s(), series.values().col(at),
                series.channels()[static_cast<std::size_t>(at)].name};
  if (!column.values.allFinite()) {
    throw ReadError(path, 0, fmt::format("column '{}' has gaps: fill them first", column.name));
  }
  return column;
}

std::optional<double> as_number(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size()) return value;
  return std::nullopt;
}

/// A number, or a file with the drive over time.
void read_drive(const MuscleOptions& o,
                const Context& context,
                muscle::IsolatedMuscleInput& input) {
  input.drive_is_excitation = !o.excitation.empty();
  const std::string& drive = input.drive_is_excitation ? o.excitation : o.activation;
  if (const std::optional<double> constant = as_number(drive)) {
    input.drive = Eigen::VectorXd::Constant(1, *constant);
    return;
  }
  const Column column = read_column(drive, "", context);
  input.drive_time_s = column.time_s;
  input.drive = column.values;
  const Eigen::Index last = column.time_s.size() - 1;
  if (column.time_s(0) > input.time_s(0) ||
      column.time_s(last) < input.time_s(input.time_s.size() - 1)) {
    context.warn(fmt::format("{} covers {:g} to {:g} s only; beyond, its first and last value hold",
                             drive, column.time_s(0), column.time_s(last)));
  }
}

void cut(Column& column, const Context& context) {
  if (!context.start_s && !context.end_s) return;
  const TimeSeries all(column.time_s, {{column.name, Unit::dimensionless}}, column.values);
  const Eigen::Index last = all.sample_count() - 1;
  const TimeSeries part = all.slice(context.start_s.value_or(all.time_s()(0)),
                                    context.end_s.value_or(all.time_s()(last)));
  column.time_s = part.time_s();
  column.values = part.values().col(0);
}

/// Mean absolute difference from a measured force at its times, over a force.
struct Comparison {
  double error_n = 0.0;
  double share = 0.0;
  Eigen::Index samples = 0;
};

/// The experiment of one length file.
muscle::IsolatedMuscleInput read_input(const MuscleOptions& o,
                                       std::size_t index,
                                       const muscle::MuscleFile& file,
                                       const Context& context) {
  const std::string& path = o.lengths[index];
  Column length = read_column(path, o.column, context);
  cut(length, context);
  muscle::IsolatedMuscleInput input;
  input.time_s = length.time_s;
  const double scale = o.scales[o.scales.size() > 1 ? index : 0];
  input.length_m = (scale * length.values.array() + o.offset_m).matrix();
  if (input.length_m.size() > 0 && !(input.length_m.minCoeff() > 0.0)) {
    throw InvalidInput(
        fmt::format("{}: the muscle would be {:g} m long; expected a positive length "
                    "in m (see --scale and --offset)",
                    path, input.length_m.minCoeff()));
  }
  const double usual =
      file.parameters.hill.optimal_fiber_length_m + file.parameters.hill.tendon_slack_length_m;
  // No muscle shortens to a third or lengthens to the triple of fiber and tendon at rest.
  if (input.length_m.size() > 0 &&
      (input.length_m.maxCoeff() > 3.0 * usual || input.length_m.minCoeff() < 0.3 * usual)) {
    throw InvalidInput(fmt::format(
        "{}: the length goes from {:g} to {:g} m, fiber and tendon together are about {:g} m; "
        "expected meters (see --scale and --offset), and not the file of forces",
        path, input.length_m.minCoeff(), input.length_m.maxCoeff(), usual));
  }
  read_drive(o, context, input);
  input.dynamics = file.activation;
  if (o.initial != "settled") {
    input.initial_activation = as_number(o.initial);
    if (!input.initial_activation) {
      throw InvalidInput(fmt::format(
          "--initial-activation {}: expected a number in 0 to 1, or `settled`", o.initial));
    }
  }
  return input;
}

/// Mean absolute error of a recording, over a force.
double share_of_error(const muscle::IsolatedModel& model,
                      const muscle::IsolatedRecording& recording,
                      double over_n,
                      double tolerance) {
  return (isolated_force(model, recording, tolerance) - recording.force_n).cwiseAbs().mean() /
         over_n;
}

/// A force that this muscle cannot make: the starting F_max is right within a few times, and what a
/// lengthening muscle makes is below twice F_max.
void check_size(const std::vector<muscle::IsolatedRecording>& recordings,
                double max_isometric_n,
                const Context& context) {
  constexpr double kLarge = 5.0, kNone = 50.0;
  for (const muscle::IsolatedRecording& r : recordings) {
    const double largest = r.force_n.cwiseAbs().maxCoeff();
    const std::string found = fmt::format(
        "{}: forces up to {:.4g} N, {:.3g} times the muscle's F_max "
        "of {:.4g} N",
        r.name, largest, largest / max_isometric_n, max_isometric_n);
    if (largest > kNone * max_isometric_n)
      throw InvalidInput(found +
                         "; expected at most some 2 times: write them in N (are they in mN?), and "
                         "give the files of --length and --measured in the same order");
    if (largest > kLarge * max_isometric_n || largest < max_isometric_n / kNone)
      context.warn(found + "; are they in another unit, or of another muscle?");
  }
}

/// Two recordings of which each is the other's experiment: with the muscle as it starts, the errors
/// of both together are less than half with their forces exchanged.
void check_order(const muscle::IsolatedModel& start,
                 const std::vector<muscle::IsolatedRecording>& recordings,
                 double tolerance,
                 const Context& context) {
  constexpr double kBetter = 0.5;
  const auto error = [&](std::size_t length, std::size_t force) {
    muscle::IsolatedRecording mixed = recordings[length];
    mixed.time_s = recordings[force].time_s;
    mixed.force_n = recordings[force].force_n;
    return share_of_error(start, mixed, 1.0, tolerance);
  };
  const auto covers = [&](std::size_t length, std::size_t force) {
    const Eigen::VectorXd& from = recordings[length].input.time_s;
    const Eigen::VectorXd& wanted = recordings[force].time_s;
    return from[0] <= wanted[0] && from[from.size() - 1] >= wanted[wanted.size() - 1];
  };
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    for (std::size_t j = i + 1; j < recordings.size(); ++j) {
      if (!covers(i, j) || !covers(j, i)) continue;
      if (error(i, j) + error(j, i) >= kBetter * (error(i, i) + error(j, j))) continue;
      context.warn(fmt::format(
          "{} and {} fit each other's length much better than their own, with the muscle as it "
          "starts: give --length, --scale and --measured in the same order",
          recordings[i].name, recordings[j].name));
    }
  }
}

/// --fit: the parameters from all recordings, and how well those from the others predict each.
void fit(const MuscleOptions& o, Context& context, const muscle::MuscleFile& file) {
  const muscle::IsolatedModel start{file.parameters, file.laws, file.millard};
  std::vector<muscle::IsolatedRecording> recordings;
  for (std::size_t i = 0; i < o.lengths.size(); ++i) {
    const Column force = read_column(o.measured[i], "", context);
    recordings.push_back(
        {o.measured[i], read_input(o, i, file, context), force.time_s, force.values});
  }
  const double over =
      o.isometric_n > 0.0 ? o.isometric_n : start.parameters.hill.max_isometric_force_n;
  check_size(recordings, start.parameters.hill.max_isometric_force_n, context);
  check_order(start, recordings, std::max(o.tolerance, 1e-8), context);
  muscle::IsolatedFitOptions options;
  options.parameters = o.fit;
  options.relative_tolerance = std::max(o.tolerance, 1e-8);
  options.progress = context.progress();
  muscle::IsolatedFit all = fit_isolated_muscle(start, recordings, options);
  std::vector<muscle::IsolatedFit> without_one;
  std::string csv = "left_out,parameter,unit,start,estimate,std_error,at_bound\n";
  const auto add_rows = [&](const std::string& left_out, const muscle::IsolatedFit& result) {
    for (const muscle::IsolatedEstimate& e : result.estimates)
      csv += fmt::format("{},{},{},{},{},{},{}\n", left_out, e.parameter, symbol(e.unit), e.start,
                         e.value, e.std_error, e.at_bound);
  };
  std::string errors;
  nlohmann::json json_errors = nlohmann::json::array();
  bool converged = all.termination == math::Termination::converged;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const double before = share_of_error(start, recordings[i], over, options.relative_tolerance);
    const double fitted =
        share_of_error(all.model, recordings[i], over, options.relative_tolerance);
    double predicted = std::numeric_limits<double>::quiet_NaN();
    if (recordings.size() > 1) {
      std::vector<muscle::IsolatedRecording> others = recordings;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      const muscle::IsolatedFit& without =
          without_one.emplace_back(fit_isolated_muscle(start, others, options));
      converged = converged && without.termination == math::Termination::converged;
      predicted = share_of_error(without.model, recordings[i], over, options.relative_tolerance);
    }
    errors += fmt::format("{:<34}{:>12.2f}{:>12.2f}{:>12.2f}\n", recordings[i].name, 100.0 * before,
                          100.0 * fitted, 100.0 * predicted);
    json_errors.push_back({{"recording", recordings[i].name},
                           {"starting_values", before},
                           {"fitted", fitted},
                           {"predicted_from_the_others", predicted}});
  }
  context.end_progress();
  for (const muscle::DecidedByOne& found : widen_to_jackknife(all, without_one)) {
    const muscle::IsolatedEstimate& e = all.estimates[found.parameter];
    context.warn(fmt::format(
        "{} is {:.4g} {} without {}, {:.1f} of the fit's standard errors from {:.4g}: it hangs "
        "on that recording; its standard error is widened to what the recordings show",
        e.parameter, found.without, symbol(e.unit), recordings[found.recording].name,
        found.std_errors, e.value));
  }
  add_rows("", all);
  for (std::size_t i = 0; i < without_one.size(); ++i)
    add_rows(std::to_string(i + 1), without_one[i]);
  if (!o.out.empty()) recording::write_file(o.out, csv);
  if (!converged) context.exit_code = kQualityGateFailed;
  // Whoever guesses half of the maximum misses no force between none and it by more than half.
  constexpr double kGuess = 0.5;
  for (const auto& error : json_errors) {
    if (error["fitted"].get<double>() <= kGuess) continue;
    context.warn(fmt::format(
        "{}: the fit misses the force by {:.0f} % of {:.4g} N, more than a "
        "guess would: are the files of --length and --measured in the same "
        "order, and in m and N?",
        error["recording"].get<std::string>(), 100.0 * error["fitted"].get<double>(), over));
    context.exit_code = kQualityGateFailed;
  }
  if (context.json) {
    nlohmann::json json{{"muscle", file.name}, {"converged", converged}, {"errors", json_errors}};
    for (const muscle::IsolatedEstimate& e : all.estimates)
      json["estimates"].push_back({{"parameter", e.parameter},
                                   {"start", e.start},
                                   {"estimate", e.value},
                                   {"std_error", e.std_error},
                                   {"at_bound", e.at_bound}});
    fmt::print("{}\n", json_text(json));
    return;
  }
  fmt::print("{}: {} ({} simulated experiments)\n\n", file.name, all.message, all.evaluations);
  fmt::print("{:<28}{:>14}{:>14}{:>14}\n", "parameter", "start", "estimate", "std error");
  for (const muscle::IsolatedEstimate& e : all.estimates)
    fmt::print("{:<28}{:>14.6g}{:>14.6g}{:>14.2g} {}{}\n", e.parameter, e.start, e.value,
               e.std_error, symbol(e.unit), e.at_bound ? ", at its bound" : "");
  fmt::print("\n{:<34}{:>12}{:>12}{:>12}\n{}",
             fmt::format("mean absolute error [% of {:.4g} N]", over), "start", "fitted",
             "predicted", errors);
  if (recordings.size() > 1)
    fmt::print("predicted: with the parameters that the other recordings give\n");
  if (!o.out.empty()) fmt::print("{}\n", o.out);
}

void run(const MuscleOptions& o, Context& context) {
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
    throw InvalidInput(
        fmt::format("--scale: {} numbers for {} files of --length; give one, or one "
                    "each",
                    o.scales.size(), o.lengths.size()));
  }
  const muscle::MuscleFile file = muscle::read_muscle_file(o.muscle);
  if (!o.fit.empty()) {
    fit(o, context, file);
    return;
  }
  const muscle::Musculotendon<double> unit(file.parameters, file.laws, file.millard);
  const muscle::IsolatedMuscleInput input = read_input(o, 0, file, context);

  muscle::IsolatedMuscleOptions options;
  options.relative_tolerance = o.tolerance;
  options.absolute_tolerance = 1e-3 * o.tolerance;
  options.progress = context.progress();
  std::optional<Column> measured;
  if (!o.measured.empty()) {
    measured = read_column(o.measured.front(), "", context);
    options.output_time_s = measured->time_s;
  }
  const muscle::IsolatedMuscleResult result = simulate_isolated_muscle(unit, input, options);
  context.end_progress();
  if (!o.out.empty()) {
    recording::write_storage(
        o.out, result.series,
        {.title = file.name,
         .comments = {"myoid " + std::string(version()), context.command_line}});
  }
  if (result.status != math::OdeStatus::done) {
    context.warn(fmt::format("the simulation ended early, after {} of its samples: {}",
                             result.series.sample_count(), result.message));
    context.exit_code = kQualityGateFailed;
    return;
  }

  const Eigen::VectorXd force = result.series.column("tendon_force");
  std::optional<Comparison> comparison;
  if (measured) {
    const double over =
        o.isometric_n > 0.0 ? o.isometric_n : file.parameters.hill.max_isometric_force_n;
    const double error = (force - measured->values).cwiseAbs().mean();
    comparison = Comparison{error, error / over, force.size()};
    // Whoever guesses half of the maximum misses no force between none and it by more than half.
    if (comparison->share > 0.5) {
      context.warn(
          fmt::format("the force misses the measured one by {:.0f} % of {:g} N, more than a guess "
                      "would: are --length and --measured exchanged, in another unit, or of "
                      "another muscle?",
                      100.0 * comparison->share, over));
    }
  }
  if (context.json) {
    nlohmann::json json{{"muscle", file.name},
                        {"samples", force.size()},
                        {"least_force_n", force.minCoeff()},
                        {"greatest_force_n", force.maxCoeff()}};
    if (comparison) {
      json["mean_absolute_error_n"] = comparison->error_n;
      json["mean_absolute_error"] = comparison->share;
    }
    fmt::print("{}\n", json_text(json));
    return;
  }
  fmt::print("{}: {} samples, force {:.4g} to {:.4g} N\n", file.name, force.size(),
             force.minCoeff(), force.maxCoeff());
  if (comparison) {
    fmt::print("mean absolute error {:.4g} N, {:.2f} % of {:.4g} N, over {} samples\n",
               comparison->error_n, 100.0 * comparison->share,
               comparison->error_n / comparison->share, comparison->samples);
  }
  if (!o.out.empty()) fmt::print("{}\n", o.out);
}

}  // namespace

void add_muscle(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("muscle",
                          "One muscle alone: which force does it make under an imposed length?\n"
                          "Example: myoid muscle --muscle soleus.toml --length length.sto "
                          "--excitation 1 --out force.sto");
  const auto o = std::make_shared<MuscleOptions>();
  command.add_option("--muscle", o->muscle, "The muscle (.toml)")->required();
  command
      .add_option("--length", o->lengths,
                  "Length of fiber and tendon together over time [m] (.sto, .mot, .csv)")
      ->required();
  command.add_option("--column", o->column, "Which column of it (default: the only one)");
  command.add_option("--scale", o->scales,
                     "Its numbers times this ... (default 1); with several files one for each");
  command.add_option("--offset", o->offset_m, "... plus this are the length [m] (default 0)");
  command.add_option("--activation", o->activation, "Activation, a number in 0..1 or a file");
  command.add_option("--excitation", o->excitation, "Excitation, a number in 0..1 or a file");
  command.add_option("--initial-activation", o->initial,
                     "Activation at the start, with --excitation: a number, or `settled` on the "
                     "first excitation (default 0.01: at rest)");
  command.add_option("--measured", o->measured, "Measured force over time [N], to compare");
  command
      .add_option("--fit", o->fit,
                  "Parameters to identify from one or several --length and --measured, by comma: "
                  "max_isometric_force,tendon_strain,...; each recording is also predicted from "
                  "the others")
      ->delimiter(',');
  command.add_option("--isometric-force", o->isometric_n,
                     "Force that the error is related to [N] (default: F_max of the muscle)");
  command.add_option("--tolerance", o->tolerance, "Relative, of the integration (default 1e-9)")
      ->check(CLI::Range(1e-13, 1e-3));
  command.add_option("--out", o->out,
                     "Forces, lengths, velocities, activation over time (.sto); with --fit the "
                     "parameters (.csv)");
  add_common_options(command, context, {.threads = false, .seed = false});
  command.callback([&context, o] {
    if (!o->out.empty()) {
      std::vector<std::string> inputs{o->muscle, o->activation, o->excitation};
      inputs.insert(inputs.end(), o->lengths.begin(), o->lengths.end());
      inputs.insert(inputs.end(), o->measured.begin(), o->measured.end());
      context.prepare_file(o->out, inputs);
    }
    run(*o, context);
  });
}

}  // namespace myoid::cli
