#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/cli/context.h"
#include "myoid/core/error.h"
#include "myoid/identification/cross_validation.h"
#include "myoid/identification/paper.h"
#include "myoid/identification/torque.h"
#include "myoid/muscle/literature.h"
#include "myoid/pipeline/result_files.h"
#include "myoid/recording/atomic_file.h"
#include "myoid/recording/csv_reader.h"
#include "myoid/recording/storage_reader.h"
#include "myoid/report/report.h"
#include "myoid/signals/resample.h"

namespace myoid::cli {
namespace {

using identification::MuscleSetup;
using identification::StudyData;
using identification::TrialData;

/// muscles.csv: `muscle` and one column per parameter; `<parameter>_fixed`, `_lower`, `_upper`,
/// `_prior_sd`, `emg`.
std::vector<MuscleSetup> read_muscles(const std::filesystem::path& path) {
  const recording::CsvTable table = recording::read_csv_table(path);
  const auto column = [&](const std::string& name) -> std::optional<std::size_t> {
    const auto it = std::find(table.names.begin(), table.names.end(), name);
    return it == table.names.end()
               ? std::nullopt
               : std::optional<std::size_t>(static_cast<std::size_t>(it - table.names.begin()));
  };
  if (!column("muscle"))
    throw ReadError(
        path, 1, "no column 'muscle'; write muscle,max_isometric_force,optimal_fiber_length,...");
  std::vector<std::string> known{"muscle", "emg"};
  for (const muscle::HillField& field : muscle::kHillFields) {
    for (const char* suffix : {"", "_fixed", "_lower", "_upper", "_prior_sd"})
      known.push_back(std::string(field.name) + suffix);
  }
  for (const std::string& name : table.names) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw ReadError(path, 1,
                      fmt::format("unknown column '{}'; parameters are max_isometric_force, "
                                  "optimal_fiber_length, force_length_width, concentric_curvature, "
                                  "eccentric_curvature_product, eccentric_plateau, "
                                  "max_shortening_speed, tendon_slack_length (SI)",
                                  name));
    }
  }
  std::vector<MuscleSetup> muscles;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto number = [&](const std::string& name) -> std::optional<double> {
      const auto c = column(name);
      if (!c || table.rows[r][*c].empty()) return std::nullopt;
      const auto value = recording::parse_number(table.rows[r][*c]);
      if (!value)
        throw ReadError(path, table.lines[r],
                        fmt::format("{}: expected a number, found '{}'", name, table.rows[r][*c]));
      return value;
    };
    MuscleSetup setup;
    setup.name = table.rows[r][*column("muscle")];
    setup.emg_channel = column("emg") && !table.rows[r][*column("emg")].empty()
                            ? table.rows[r][*column("emg")]
                            : setup.name;
    for (const muscle::HillField& field : muscle::kHillFields) {
      const std::string name(field.name);
      const auto start = number(name);
      if (!start && name != "tendon_slack_length") {
        throw ReadError(
            path, table.lines[r],
            fmt::format("muscle '{}' has no {}; every parameter needs a starting value in SI units",
                        setup.name, name));
      }
      setup.start.*field.member = start.value_or(0.0);
    }
    for (const muscle::HillField& field : muscle::kHillFields) {
      const std::string name(field.name);
      const double start = setup.start.*field.member;
      if (const auto c = column(name + "_fixed");
          c && recording::equal_ignoring_case(table.rows[r][*c], "true"))
        setup.fixed.push_back(name);
      const auto lower = number(name + "_lower");
      const auto upper = number(name + "_upper");
      if (lower || upper)
        setup.bounds[name] = {lower.value_or(field.bounds.lower),
                              upper.value_or(field.bounds.upper)};
      if (const auto sd = number(name + "_prior_sd")) {
        setup.priors[name] = {.mean = start, .sd = *sd};
      } else if (const auto prior =
                     muscle::literature_prior(name, start, setup.start.optimal_fiber_length_m)) {
        setup.priors[name] = *prior;
      }
    }
    try {
      muscle::validate(setup.start);
    } catch (const InvalidInput& error) {
      throw ReadError(path, table.lines[r],
                      fmt::format("muscle '{}': {}", setup.name, error.what()));
    }
    muscles.push_back(std::move(setup));
  }
  if (muscles.empty()) throw ReadError(path, 0, "there are no muscles");
  return muscles;
}

/// The columns of the muscles, on the clock of the lengths.
Eigen::MatrixXd columns_of(const std::string& path,
                           const std::vector<MuscleSetup>& muscles,
                           const Eigen::VectorXd& clock) {
  const recording::Storage file = recording::read_storage(path);
  std::vector<std::string> names;
  for (const MuscleSetup& m : muscles) {
    if (!file.data.find(m.name))
      throw ReadError(path, 0,
                      fmt::format("no column '{}'; found {}", m.name, channel_names(file.data)));
    names.push_back(m.name);
  }
  const TimeSeries chosen = file.data.select(names);
  require_finite(chosen, path);
  if (chosen.time_s().size() == clock.size() &&
      (chosen.time_s() - clock).cwiseAbs().maxCoeff() < 1e-9)
    return chosen.values();
  return signals::resample(chosen, clock).values();
}

struct Options {
  std::string muscles, out, method = "torque", coordinate;
  std::vector<std::string> activations, lengths, velocities, forces, arms, torques;
  double delay_s = -1.0;
  bool no_priors = false;
};

void require_count(std::size_t count, std::size_t trials, std::string_view option) {
  if (count != trials)
    throw InvalidInput(
        fmt::format("{}: {} files for {} trials; give one per trial, in the same order", option,
                    count, trials));
}

StudyData read_data(const Options& o, const Context& context) {
  StudyData data;
  data.muscles = read_muscles(o.muscles);
  const std::size_t trials = o.lengths.size();
  require_count(o.activations.size(), trials, "--activations");
  require_count(o.velocities.size(), trials, "--velocities");
  const bool torque = o.method == "torque";
  if (torque) {
    require_count(o.arms.size(), trials, "--moment-arms");
    require_count(o.torques.size(), trials, "--torques");
  } else {
    require_count(o.forces.size(), trials, "--forces");
  }
  for (std::size_t i = 0; i < trials; ++i) {
    TrialData trial;
    trial.name = std::filesystem::path(o.lengths[i]).stem().string();
    if (trials > 1) trial.name = fmt::format("{} ({})", i + 1, trial.name);
    const recording::Storage lengths = recording::read_storage(o.lengths[i]);
    TimeSeries on_clock = lengths.data;
    if (context.start_s || context.end_s)
      on_clock = on_clock.slice(context.start_s.value_or(-1e300), context.end_s.value_or(1e300));
    if (on_clock.sample_count() < 2)
      throw ReadError(o.lengths[i], 0, "fewer than two samples in the time asked for");
    trial.time_s = on_clock.time_s();
    trial.length_m = columns_of(o.lengths[i], data.muscles, trial.time_s);
    trial.velocity_mps = columns_of(o.velocities[i], data.muscles, trial.time_s);
    trial.activation = recording::read_storage(o.activations[i]).data;
    require_finite(trial.activation, o.activations[i]);
    for (const MuscleSetup& m : data.muscles) {
      if (!trial.activation.find(m.emg_channel))
        throw ReadError(o.activations[i], 0,
                        fmt::format("no column '{}'; found {}", m.emg_channel,
                                    channel_names(trial.activation)));
    }
    trial.torque_nm = Eigen::VectorXd::Zero(trial.time_s.size());
    trial.moment_arm_m = Eigen::MatrixXd::Zero(trial.time_s.size(), trial.length_m.cols());
    if (!o.forces.empty()) trial.force_n = columns_of(o.forces[i], data.muscles, trial.time_s);
    if (torque) {
      trial.moment_arm_m = columns_of(o.arms[i], data.muscles, trial.time_s);
      const recording::Storage torques = recording::read_storage(o.torques[i]);
      std::string column = o.coordinate.empty() ? "" : o.coordinate;
      if (column.empty()) {
        if (torques.data.channel_count() != 1) {
          throw ReadError(
              o.torques[i], 0,
              fmt::format("has several columns ({}); name the joint's with --coordinate",
                          channel_names(torques.data)));
        }
        column = torques.data.channels()[0].name;
      } else if (!torques.data.find(column)) {
        column += "_moment";
        if (!torques.data.find(column))
          throw ReadError(o.torques[i], 0,
                          fmt::format("no column '{}' or '{}'; found {}", o.coordinate, column,
                                      channel_names(torques.data)));
      }
      const TimeSeries one = torques.data.select({column});
      require_finite(one, o.torques[i]);
      const bool same = one.time_s().size() == trial.time_s.size() &&
                        (one.time_s() - trial.time_s).cwiseAbs().maxCoeff() < 1e-9;
      trial.torque_nm = same
                            ? Eigen::VectorXd(one.values().col(0))
                            : Eigen::VectorXd(signals::resample(one, trial.time_s).values().col(0));
    }
    data.trials.push_back(std::move(trial));
  }
  return data;
}

}  // namespace

void add_identify(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "identify",
      "Muscle parameters straight from files, where the earlier stages are done elsewhere.\n"
      "Example: myoid identify --muscles muscles.csv --activations a.sto --lengths l.sto "
      "--velocities v.sto\n"
      "                        --moment-arms r.sto --torques id.sto --method torque --out results");
  const auto o = std::make_shared<Options>();
  command.add_option("--muscles", o->muscles, "muscles.csv: starting values, SI")->required();
  command
      .add_option("--activations", o->activations,
                  "Activations 0..1 by muscle (.sto), one file per trial")
      ->required();
  command
      .add_option("--lengths", o->lengths,
                  "Musculotendon lengths [m] (fiber lengths where tendon_slack_length is 0), one "
                  "file per trial")
      ->required();
  command.add_option("--velocities", o->velocities, "Their rates [m/s], lengthening positive")
      ->required();
  command.add_option("--forces", o->forces, "Muscle forces [N], for --method paper");
  command.add_option("--moment-arms", o->arms, "Moment arms [m] by muscle, for --method torque");
  command.add_option("--torques", o->torques,
                     "Joint torque of the muscles [N m], for --method torque");
  command.add_option("--coordinate", o->coordinate,
                     "Column of the torque file, where it has several");
  command.add_option("--method", o->method, "paper or torque (default torque)")
      ->check(CLI::IsMember({"paper", "torque"}));
  command.add_option("--delay", o->delay_s,
                     "EMG delay held at this [s] (default: estimated, method torque)");
  command.add_flag("--no-priors", o->no_priors,
                   "Method torque: the data alone, plain least squares");
  command.add_option("--out", o->out, "Folder for parameters.csv, parameters.json")->required();
  command.add_flag("--strict", context.strict, "Exit with 4 if a parameter is not identifiable");
  add_common_options(command, context);
  command.callback([&context, o] {
    const StudyData data = read_data(*o, context);
    context.prepare_folder(o->out);
    identification::IdentificationResult result;
    std::vector<identification::Fold> folds;
    if (o->method == "paper") {
      result = identification::identify_paper(data);
    } else {
      identification::TorqueOptions options;
      options.priors = !o->no_priors;
      options.weights = !o->no_priors;
      options.max_rate_hz = 200.0;
      if (o->delay_s >= 0.0) options.delay_s = o->delay_s;
      options.progress = context.progress();
      result = identification::identify_torque(data, options);
      folds = identification::cross_validate(data, options);
    }
    context.end_progress();
    Provenance provenance;
    provenance.command = context.command_line;
    provenance.inputs.push_back({o->muscles, sha256(recording::read_text_file(o->muscles))});
    for (const auto* list :
         {&o->activations, &o->lengths, &o->velocities, &o->forces, &o->arms, &o->torques}) {
      for (const std::string& path : *list)
        provenance.inputs.push_back({path, sha256(recording::read_text_file(path))});
    }
    const std::vector<identification::IdentificationResult> results{result};
    recording::write_file(std::filesystem::path(o->out) / "parameters.json",
                          pipeline::parameters_json(results, folds, provenance));
    recording::write_file(std::filesystem::path(o->out) / "parameters.csv",
                          pipeline::parameters_csv(results));
    if (context.json) {
      fmt::print("{}", pipeline::parameters_json(results, folds, provenance));
    } else {
      for (const auto& e : result.estimates) {
        fmt::print(
            "{:<10} {:<28} {:<12} {:>14} {:>26}  {}: {}\n", e.muscle, e.parameter, e.fit_case,
            std::isfinite(e.estimate) ? report::format_value(e.estimate, 6) : "-",
            e.ci_low && e.ci_high ? fmt::format("[{}, {}]", report::format_value(*e.ci_low, 4),
                                                report::format_value(*e.ci_high, 4))
                                  : "-",
            identification::name(e.verdict), e.reason);
      }
      fmt::print("{}/parameters.csv\n", o->out);
    }
    bool gate = o->method == "torque" && result.termination != math::Termination::converged;
    for (const auto& e : result.estimates)
      gate = gate || (context.strict && e.verdict == identification::Verdict::not_identifiable);
    if (gate) context.exit_code = kQualityGateFailed;
  });
}

}  // namespace myoid::cli
