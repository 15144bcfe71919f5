#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/cli/context.h"
#include "myoid/cli/stage_input.h"
#include "myoid/core/error.h"
#include "myoid/identification/compare_solvers.h"
#include "myoid/identification/cross_validation.h"
#include "myoid/identification/force.h"
#include "myoid/identification/paper.h"
#include "myoid/identification/score.h"
#include "myoid/identification/torque.h"
#include "myoid/math/spline.h"
#include "myoid/pipeline/identify_input.h"
#include "myoid/pipeline/parameter_files.h"
#include "myoid/recording/atomic_file.h"
#include "myoid/recording/csv_reader.h"
#include "myoid/report/report.h"
#include "myoid/signals/resample.h"

namespace myoid::cli {
namespace {

using identification::MuscleSetup;
using identification::StudyData;
using identification::TrialData;

bool given_for_hill(std::string_view name) {
  return std::any_of(muscle::kHillFields.begin(), muscle::kHillFields.end(),
                     [&](const muscle::HillField& field) { return field.name == name; });
}

/// What muscles.csv says.
struct MuscleTable {
  std::vector<MuscleSetup> muscles;
  std::vector<identification::ParameterRule> rules;  ///< Parameters that are not held by default.
  std::vector<std::string> speed_may_be_free;  ///< Muscles whose v_max is neither held nor freed.
};

std::string known_parameters() {
  std::string names;
  for (const identification::ParameterField& field : identification::parameter_fields()) {
    if (field.scope == identification::Scope::muscle)
      names += (names.empty() ? "" : ", ") + std::string(field.name);
  }
  return names;
}

/// Column of a parameter in muscles.csv beyond the eight of the paper's law, in MuscleExtras.
double* extra_field(identification::MuscleExtras& extras, std::string_view name) {
  if (name == "pennation_angle") return &extras.pennation_angle_rad;
  if (name == "passive_force") return &extras.passive_force;
  if (name == "passive_strain") return &extras.passive_strain;
  if (name == "passive_shape") return &extras.passive_shape;
  if (name == "length_activation") return &extras.length_activation;
  if (name == "tendon_strain") return &extras.tendon_strain;
  if (name == "activation_share") return &extras.activation_share;
  return nullptr;
}

/// muscles.csv: `muscle` and one column per parameter; `<parameter>_fixed`, `_lower`, `_upper`,
/// `_prior_sd`, `emg`. `within_bounds`: the method keeps to bounds, so a start must lie in them.
MuscleTable read_muscles(const std::filesystem::path& path, bool within_bounds) {
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
  for (const identification::ParameterField& field : identification::parameter_fields()) {
    if (field.scope != identification::Scope::muscle) continue;
    for (const char* suffix : {"", "_fixed", "_lower", "_upper", "_prior_sd"})
      known.push_back(std::string(field.name) + suffix);
  }
  for (const std::string& name : table.names) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw ReadError(
          path, 1,
          fmt::format("unknown column '{}'; parameters are {} (SI)", name, known_parameters()));
    }
  }
  MuscleTable result;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto fail = [&](const std::string& message) {
      throw ReadError(path, table.lines[r], message);
    };
    const auto cell = [&](const std::string& name) -> std::string {
      const auto c = column(name);
      return c ? table.rows[r][*c] : "";
    };
    const auto number = [&](const std::string& name) -> std::optional<double> {
      if (cell(name).empty()) return std::nullopt;
      const auto value = recording::parse_number(cell(name));
      if (!value) fail(fmt::format("{}: expected a number, found '{}'", name, cell(name)));
      return value;
    };
    const auto flag = [&](const std::string& name) -> std::optional<bool> {
      const std::string text = cell(name);
      if (text.empty()) return std::nullopt;
      for (const char* yes : {"true", "1", "yes"}) {
        if (recording::equal_ignoring_case(text, yes)) return true;
      }
      for (const char* no : {"false", "0", "no"}) {
        if (recording::equal_ignoring_case(text, no)) return false;
      }
      fail(fmt::format("{}: expected true or false, found '{}'", name, text));
      return std::nullopt;
    };
    MuscleSetup setup;
    setup.name = cell("muscle");
    if (setup.name.empty()) fail("a muscle without a name");
    for (const MuscleSetup& other : result.muscles) {
      if (other.name == setup.name) fail(fmt::format("muscle '{}' is listed twice", setup.name));
    }
    setup.emg_channel = cell("emg").empty() ? setup.name : cell("emg");
    for (const muscle::HillField& field : muscle::kHillFields) {
      const std::string name(field.name);
      const auto start = number(name);
      if (!start && name != "tendon_slack_length") {
        fail(
            fmt::format("muscle '{}' has no {}; every parameter needs a starting value in SI units",
                        setup.name, name));
      }
      setup.start.*field.member = start.value_or(0.0);
    }
    try {
      muscle::validate(setup.start);
    } catch (const InvalidInput& error) {
      fail(fmt::format("muscle '{}': {}", setup.name, error.what()));
    }
    setup.priors = identification::literature_priors(setup.start);
    for (const identification::ParameterField& field : identification::parameter_fields()) {
      if (field.scope != identification::Scope::muscle) continue;
      const std::string name(field.name);
      double start = 0.0;
      if (const double* extra = extra_field(setup.extras, name)) start = *extra;
      if (const auto given = number(name)) {
        start = *given;
        if (double* extra = extra_field(setup.extras, name)) *extra = start;
      }
      if (given_for_hill(name)) start = setup.start.*muscle::hill_field(name).member;
      const auto held = flag(name + "_fixed");
      const auto lower = number(name + "_lower");
      const auto upper = number(name + "_upper");
      const auto sd = number(name + "_prior_sd");
      if (sd && !(*sd > 0.0))
        fail(fmt::format("{}_prior_sd: expected a positive number, found {}", name, *sd));
      if (lower || upper) {
        setup.bounds[name] = {lower.value_or(field.bounds.lower),
                              upper.value_or(field.bounds.upper)};
        if (!(setup.bounds[name].lower < setup.bounds[name].upper))
          fail(fmt::format("{}: lower bound {} is not below upper bound {}", name,
                           setup.bounds[name].lower, setup.bounds[name].upper));
      }
      const double least = lower.value_or(field.bounds.lower);
      const double most = upper.value_or(field.bounds.upper);
      if (within_bounds && given_for_hill(name) && !held.value_or(false) &&
          (start < least || start > most)) {
        fail(
            fmt::format("muscle '{}': {} = {}, expected {} to {} (SI units); columns {}_lower and "
                        "{}_upper set other bounds",
                        setup.name, name, start, least, most, name, name));
      }
      if (sd) setup.priors[name] = {.mean = start, .sd = *sd};
      const bool usual = field.field <= identification::kPlateau;
      // What the paper's law leaves out is held anyway.
      if (held.value_or(false) && (usual || given_for_hill(name))) setup.fixed.push_back(name);
      // Who asks something of the product itself has it as the unknown.
      if (name == "eccentric_curvature_product" && (held.value_or(false) || lower || upper || sd))
        setup.priors.erase("eccentric_slope_ratio");
      if (held && !*held && !usual) {
        identification::ParameterRule rule;
        rule.parameter = name;
        rule.owners = {setup.name};
        rule.free = true;
        if (number(name)) rule.value = *number(name);
        if (lower) rule.lower = *lower;
        if (upper) rule.upper = *upper;
        if (sd) rule.prior_sd = *sd;
        result.rules.push_back(rule);
      }
      if (name == "max_shortening_speed" && !held) result.speed_may_be_free.push_back(setup.name);
    }
    result.muscles.push_back(std::move(setup));
  }
  if (result.muscles.empty()) throw ReadError(path, 0, "there are no muscles");
  return result;
}

/// Finite values of a series on another clock; as they are if the clocks agree.
Eigen::MatrixXd on_clock_of(const TimeSeries& series,
                            const std::string& path,
                            const Eigen::VectorXd& clock) {
  require_finite(series, path);
  if (series.time_s().size() == clock.size() &&
      (series.time_s() - clock).cwiseAbs().maxCoeff() < 1e-9)
    return series.values();
  return signals::resample(series, clock).values();
}

/// The columns of the muscles, by name.
TimeSeries muscle_series(const std::string& path, const std::vector<MuscleSetup>& muscles) {
  const TimeSeries series = read_series(path);
  std::vector<std::string> names;
  for (const MuscleSetup& m : muscles) {
    if (!series.find(m.name))
      throw ReadError(path, 0,
                      fmt::format("no column '{}'; found {}", m.name, channel_names(series)));
    names.push_back(m.name);
  }
  return series.select(names);
}

/// The same on the clock of the lengths.
Eigen::MatrixXd columns_of(const std::string& path,
                           const std::vector<MuscleSetup>& muscles,
                           const Eigen::VectorXd& clock) {
  return on_clock_of(muscle_series(path, muscles), path, clock);
}

/// Rates of the columns on another clock, by the quintic spline through them.
Eigen::MatrixXd rates_of(const TimeSeries& series, const Eigen::VectorXd& clock) {
  const math::SplineKnots knots(series.time_s());
  Eigen::MatrixXd rates(clock.size(), series.channel_count());
  for (Eigen::Index c = 0; c < rates.cols(); ++c)
    rates.col(c) = knots.interpolate(series.values().col(c)).evaluate(clock).first;
  return rates;
}

struct Options {
  std::string muscles, out, method = "torque";
  std::vector<std::string> coordinates;
  std::vector<std::string> activations, lengths, velocities, forces, arms, torques;
  std::optional<double> delay_s;
  bool no_priors = false;
  bool compare = false;
  int bootstrap = 0;
  bool profile = false;
  std::string loss = "square";
  int starts = 3;
  double residual_hz = identification::EstimatorOptions{}.residual_cutoff_hz.value_or(0.0);
  std::vector<std::string> free_more;
};

void require_count(std::size_t count, std::size_t trials, std::string_view option) {
  if (count != trials)
    throw InvalidInput(
        fmt::format("{}: {} files for {} trials; give one per trial, in the same order", option,
                    count, trials));
}

/// Columns of the torque file, one for each coordinate; without any the only one.
std::vector<Channel> torque_columns(const Options& o,
                                    const std::string& path,
                                    const TimeSeries& torques) {
  if (o.coordinates.empty()) {
    if (torques.channel_count() != 1) {
      throw ReadError(path, 0,
                      fmt::format("has several columns ({}); name the joint's with --coordinate",
                                  channel_names(torques)));
    }
    return torques.channels();
  }
  std::vector<Channel> columns;
  for (const std::string& coordinate : o.coordinates) {
    auto column = torques.find(coordinate);
    if (!column) column = torques.find(coordinate + "_moment");
    if (!column) {
      throw ReadError(path, 0,
                      fmt::format("no column '{}' or '{}_moment'; found {}", coordinate, coordinate,
                                  channel_names(torques)));
    }
    columns.push_back(torques.channels()[static_cast<std::size_t>(*column)]);
  }
  return columns;
}

/// The other files of a trial.
std::vector<std::string> files_of(const Options& o, std::size_t trial, std::size_t joints) {
  std::vector<std::string> files{o.activations[trial]};
  if (!o.velocities.empty()) files.push_back(o.velocities[trial]);
  if (!o.forces.empty()) files.push_back(o.forces[trial]);
  if (o.method == "torque") {
    files.push_back(o.torques[trial]);
    for (std::size_t j = 0; j < joints; ++j) files.push_back(o.arms[joints * trial + j]);
  }
  return files;
}

/// The part of a series that all the files cover: nothing is made up beyond their ends.
TimeSeries common_time(TimeSeries series,
                       const std::vector<std::string>& files,
                       const std::string& path) {
  for (const std::string& file : files) {
    const Eigen::VectorXd time_s = read_series(file).time_s();
    const double begin_s = series.time_s()[0];
    const double end_s = series.time_s()[series.sample_count() - 1];
    const double last_s = time_s[time_s.size() - 1];
    // Half a sample more is where neither clock has anything to say.
    const double spare_s = 0.5 * (end_s - begin_s) / static_cast<double>(series.sample_count() - 1);
    if (begin_s >= time_s[0] - spare_s && end_s <= last_s + spare_s) continue;
    const bool apart = last_s <= begin_s || time_s[0] >= end_s;
    if (!apart) series = series.slice(time_s[0] - 1e-9, last_s + 1e-9);
    if (apart || series.sample_count() < 2) {
      throw ReadError(file, 0,
                      fmt::format("covers {:g} to {:g} s, {} covers {:g} to {:g} s: they must "
                                  "overlap; bring them to one clock",
                                  time_s[0], last_s, path, begin_s, end_s));
    }
  }
  return series;
}

StudyData read_data(const Options& o, const MuscleTable& table, const Context& context) {
  StudyData data;
  data.muscles = table.muscles;
  data.rules = table.rules;
  const std::size_t trials = o.lengths.size();
  require_count(o.activations.size(), trials, "--activations");
  if (!o.velocities.empty()) require_count(o.velocities.size(), trials, "--velocities");
  const bool torque = o.method == "torque";
  const std::size_t joints = std::max<std::size_t>(1, o.coordinates.size());
  if (torque) {
    if (joints > 1 && o.arms.size() != joints * trials) {
      throw InvalidInput(
          fmt::format("--moment-arms: {} files for {} trials with {} coordinates each; give the "
                      "first trial's in the order of --coordinate, then the next trial's",
                      o.arms.size(), trials, joints));
    }
    if (joints == 1) require_count(o.arms.size(), trials, "--moment-arms");
    require_count(o.torques.size(), trials, "--torques");
    if (!o.forces.empty()) require_count(o.forces.size(), trials, "--forces");
  } else {
    require_count(o.forces.size(), trials, "--forces");
  }
  for (std::size_t i = 0; i < trials; ++i) {
    TrialData trial;
    trial.name = std::filesystem::path(o.lengths[i]).stem().string();
    if (trials > 1) trial.name = fmt::format("{} ({})", i + 1, trial.name);
    TimeSeries on_clock = read_series(o.lengths[i]);
    if (context.start_s || context.end_s)
      on_clock = on_clock.slice(context.start_s.value_or(-1e300), context.end_s.value_or(1e300));
    if (on_clock.sample_count() < 2)
      throw ReadError(o.lengths[i], 0, "fewer than two samples in the time asked for");
    on_clock = common_time(std::move(on_clock), files_of(o, i, joints), o.lengths[i]);
    trial.time_s = on_clock.time_s();
    trial.length_m = columns_of(o.lengths[i], data.muscles, trial.time_s);
    trial.velocity_mps = o.velocities.empty()
                             ? rates_of(muscle_series(o.lengths[i], data.muscles), trial.time_s)
                             : columns_of(o.velocities[i], data.muscles, trial.time_s);
    trial.activation = read_series(o.activations[i]);
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
      trial.moment_arm_m = columns_of(o.arms[joints * i], data.muscles, trial.time_s);
      const TimeSeries torques = read_series(o.torques[i]);
      const std::vector<Channel> columns = torque_columns(o, o.torques[i], torques);
      for (std::size_t j = 0; j < columns.size(); ++j) {
        Eigen::VectorXd torque_nm =
            on_clock_of(torques.select({columns[j].name}), o.torques[i], trial.time_s).col(0);
        if (j == 0) {
          trial.torque_nm = std::move(torque_nm);
          if (!o.coordinates.empty()) trial.joint = o.coordinates[0];
        } else {
          trial.more_joints.push_back(
              {.name = o.coordinates[j],
               .torque_nm = std::move(torque_nm),
               .moment_arm_m = columns_of(o.arms[joints * i + j], data.muscles, trial.time_s)});
        }
      }
    }
    const auto of_trial = [&](const std::vector<std::string>& list) {
      return i < list.size() ? list[i] : std::string();
    };
    pipeline::IdentifyFiles files{.activations = o.activations[i],
                                  .lengths = o.lengths[i],
                                  .velocities = of_trial(o.velocities),
                                  .moment_arms = {},
                                  .torques = torque ? of_trial(o.torques) : ""};
    for (std::size_t j = 0; torque && j < joints; ++j)
      files.moment_arms.push_back(o.arms[joints * i + j]);
    for (const std::string& remark : pipeline::check_identify_trial(data, trial, files))
      context.warn(remark);
    data.trials.push_back(std::move(trial));
  }
  return data;
}

void print_result(const identification::IdentificationResult& result) {
  for (const auto& e : result.estimates) {
    fmt::print("{:<10} {:<28} {:<12} {:>14} {:>26}  {}: {}\n", e.muscle, e.parameter, e.fit_case,
               std::isfinite(e.estimate) ? report::format_value(e.estimate, 6) : "-",
               e.ci_low && e.ci_high ? fmt::format("[{}, {}]", report::format_value(*e.ci_low, 4),
                                                   report::format_value(*e.ci_high, 4))
                                     : "-",
               identification::name(e.verdict), e.reason);
  }
  if (result.method == "paper")
    fmt::print(
        "Method paper holds F_max and v_max at muscles.csv: an error in them goes into every other "
        "number.\n");
  if (result.exact) fmt::print("The data are free of noise: fitted as they are, without priors.\n");
  for (const std::string& text : result.diagnoses) fmt::print("signature: {}\n", text);
  for (const std::string& text : result.undetermined)
    fmt::print("left open by the data: {}\n", text);
  for (const std::string& text : result.warnings) fmt::print("warning: {}\n", text);
  for (const identification::BranchTest& test : result.branch_tests) {
    fmt::print(
        "{}: l0 and l_sh of the two branches differ by {:+.4f} and {:+.4f} m (Wald {:.1f}, p = "
        "{:.3f})\n",
        test.muscle, test.length_difference_m, test.width_difference_m, test.wald, test.p_value);
  }
}

/// How the fit meets what it was fitted to: torque by trial and joint, or force by trial and
/// muscle.
void print_fit(const identification::IdentificationResult& result,
               const StudyData& data,
               bool torque) {
  fmt::print("\n{:<34}{:>12}{:>8}\n", "fitted", torque ? "RMSE [N m]" : "RMSE [N]", "R2");
  const auto row = [](const std::string& name, double rmse, double r2) {
    fmt::print("{:<34}{:>12.4g}{:>8.3f}\n", name, rmse, r2);
  };
  for (const identification::TrialFit& t : result.trials) {
    if (torque) {
      row(t.joint == "joint" ? t.trial : t.trial + ", " + t.joint, t.rmse_nm, t.r2);
      continue;
    }
    const auto trial = std::find_if(data.trials.begin(), data.trials.end(),
                                    [&](const TrialData& d) { return d.name == t.trial; });
    for (std::size_t k = 0; trial != data.trials.end() && k < data.muscles.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      const identification::Score s =
          identification::score(trial->force_n.col(column), t.force_fit_n.col(column));
      row(t.trial + ", " + data.muscles[k].name, s.rmse_nm, s.r2);
    }
  }
  fmt::print("{:<34}{:>12}{:>8.3f}\n",
             torque ? "all, below the fit's cut-off, least" : "all, the least", "", result.r2);
}

void print_folds(const std::vector<identification::Fold>& folds, const Options& o) {
  if (folds.empty()) return;
  const bool several = o.method == "force" || o.coordinates.size() > 1;
  fmt::print("\n{:<34}{:>12}{:>14}{:>8}   {}\n", "left out of the fit, then predicted",
             o.method == "force" ? "RMSE [N]" : "RMSE [N m]", "of range [%]", "R2",
             "starting values, one gain: R2");
  for (const identification::Fold& fold : folds) {
    fmt::print("{:<34}{:>12.4g}{:>14.1f}{:>8.3f}   {:.3f}\n",
               several ? fmt::format("{}, {}", fold.trial, fold.joint) : fold.trial,
               fold.identified.rmse_nm, 100.0 * fold.identified.nrmse_range, fold.identified.r2,
               fold.literature.r2);
  }
}

void print_comparison(const std::string& name, const identification::SolverComparison& c) {
  fmt::print("\nSolvers, {}:\n{:<22}{:>6}{:>16}{:>12}{:>13}{:>10}  {}\n", name, "solver", "start",
             "cost", "distance", "evaluations", "seconds", "ended");
  for (const identification::SolverRun& run : c.runs) {
    fmt::print("{:<22}{:>6}{:>16.6g}{:>12.2g}{:>13}{:>10.3f}  {}\n", run.solver, run.start,
               run.cost, run.distance, run.evaluations, run.seconds, math::name(run.termination));
  }
  fmt::print("Basins of Levenberg-Marquardt from {} starts:\n", c.multistart.starts.size());
  for (std::size_t i = 0; i < c.multistart.basins.size() && i < 8; ++i) {
    const math::Basin& basin = c.multistart.basins[i];
    fmt::print("  cost {:<14.6g} reached from {} starts{}\n", basin.cost, basin.members.size(),
               basin.rival && i > 0 ? ", as good as the best: both are answers" : "");
  }
}

std::string solvers_csv(
    const std::vector<std::pair<std::string, identification::SolverComparison>>& comparisons) {
  std::string text = "fit,solver,start,cost,distance,evaluations,seconds,termination\n";
  for (const auto& [name, c] : comparisons) {
    for (const identification::SolverRun& run : c.runs) {
      text += fmt::format("{},{},{},{},{},{},{},{}\n", name, run.solver, run.start, run.cost,
                          run.distance, run.evaluations, run.seconds, math::name(run.termination));
    }
  }
  return text;
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
  command.add_option("--velocities", o->velocities,
                     "Their rates [m/s], lengthening positive (default: by a spline through the "
                     "lengths)");
  command.add_option("--forces", o->forces, "Muscle forces [N], for --method paper and force");
  command.add_option("--moment-arms", o->arms, "Moment arms [m] by muscle, for --method torque");
  command.add_option("--torques", o->torques,
                     "Joint torque of the muscles [N m], for --method torque");
  command.add_option("--coordinate", o->coordinates,
                     "Columns of the torque file, where it has several; with more than one, "
                     "--moment-arms has a file for each, trial by trial");
  command.add_option("--method", o->method, "paper, force or torque (default torque)")
      ->check(CLI::IsMember({"paper", "force", "torque"}));
  command
      .add_option("--delay", o->delay_s,
                  "EMG delay held at this [s] (default: estimated, methods force and torque)")
      ->check(CLI::Range(0.0, 0.3));
  command.add_flag("--no-priors", o->no_priors,
                   "Methods force and torque: the data alone, plain least squares");
  command
      .add_option("--free", o->free_more,
                  "Further parameters to identify, of all muscles, channels or the joint: "
                  "emg_shape, length_activation, ...")
      ->delimiter(',');
  command
      .add_option("--residual-cutoff", o->residual_hz,
                  "Both sides of the residual are low-passed here [Hz], methods force and torque; "
                  "0: not at all")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  command.add_option("--loss", o->loss, "square, huber or cauchy (default square)")
      ->check(CLI::IsMember({"square", "huber", "cauchy"}));
  command.add_option("--bootstrap", o->bootstrap, "Bootstrap replicates (default 0: none)")
      ->check(CLI::Range(0, 100000));
  command.add_flag("--profile", o->profile, "Profile likelihood of every parameter");
  command.add_flag("--compare-solvers", o->compare,
                   "Gauss-Newton, Levenberg-Marquardt, simplex and annealing from the same starts");
  command.add_option("--starts", o->starts, "Starts of --compare-solvers (default 3)")
      ->check(CLI::Range(1, 100));
  command.add_option("--out", o->out, "Folder for parameters.csv, parameters.json")->required();
  command.add_flag("--strict", context.strict, "Exit with 4 if a parameter is not identifiable");
  add_common_options(command, context);
  command.callback([&context, o] {
    const MuscleTable table = read_muscles(o->muscles, o->method != "paper");
    StudyData data = read_data(*o, table, context);
    for (const std::string& name : o->free_more) {
      (void)identification::parameter_field(name);
      identification::ParameterRule rule;
      rule.parameter = name;
      rule.free = true;
      data.rules.push_back(rule);
    }
    context.prepare_folder(o->out);
    context.protect_inputs(o->out, {"parameters.", "solvers."}, {o->muscles});
    identification::EstimatorOptions options;
    options.priors = !o->no_priors;
    options.weights = !o->no_priors;
    options.max_rate_hz = 200.0;
    options.delay_s = o->delay_s;
    options.residual_cutoff_hz.reset();
    if (o->residual_hz > 0.0) options.residual_cutoff_hz = o->residual_hz;
    options.loss = o->loss == "huber"    ? identification::Loss::huber
                   : o->loss == "cauchy" ? identification::Loss::cauchy
                                         : identification::Loss::square;
    options.intervals = {.bootstrap = o->bootstrap, .profile = o->profile, .seed = context.seed};
    options.progress = context.progress();
    identification::IdentificationResult result;
    std::vector<identification::Fold> folds;
    if (o->method == "paper") {
      result = identification::identify_paper(data);
    } else if (o->method == "force") {
      result = identification::identify_force(data, {.estimator = options,
                                                     .detect_exact = true,
                                                     .speed_may_be_free = table.speed_may_be_free});
      for (std::size_t k = 0; !result.exact && k < data.muscles.size(); ++k) {
        const auto more =
            identification::cross_validate(identification::force_study(data, k), options);
        folds.insert(folds.end(), more.begin(), more.end());
      }
    } else {
      result = identification::identify_torque_or_exact(data, options, table.speed_may_be_free);
      if (!result.exact) folds = identification::cross_validate(data, options);
    }
    std::vector<std::pair<std::string, identification::SolverComparison>> comparisons;
    if (o->compare && o->method == "torque") {
      comparisons.emplace_back("all muscles",
                               identification::compare_solvers(
                                   data, options, {.starts = o->starts, .seed = context.seed}));
    } else if (o->compare) {
      for (std::size_t k = 0; k < data.muscles.size(); ++k) {
        comparisons.emplace_back(
            data.muscles[k].name,
            identification::compare_solvers(identification::force_study(data, k), options,
                                            {.starts = o->starts, .seed = context.seed}));
      }
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
    const std::filesystem::path folder(o->out);
    recording::write_file(folder / "parameters.json",
                          pipeline::parameters_json(results, folds, provenance));
    recording::write_file(folder / "parameters.csv", pipeline::parameters_csv(results));
    if (!comparisons.empty())
      recording::write_file(folder / "solvers.csv", solvers_csv(comparisons));
    if (context.json) {
      fmt::print("{}", pipeline::parameters_json(results, folds, provenance));
    } else {
      print_result(result);
      print_fit(result, data, o->method == "torque");
      print_folds(folds, *o);
      for (const auto& [name, comparison] : comparisons) print_comparison(name, comparison);
      fmt::print("{}/parameters.csv\n", o->out);
    }
    bool gate = o->method != "paper" && result.termination != math::Termination::converged;
    for (const auto& e : result.estimates)
      gate = gate || (context.strict && e.verdict == identification::Verdict::not_identifiable);
    if (gate) context.exit_code = kQualityGateFailed;
  });
}

}  // namespace myoid::cli
