#include "myoid/commands/identify.h"

#include <algorithm>
#include <utility>

#include "myoid/commands/identify_study.h"
#include "myoid/files/atomic_file.h"
#include "myoid/files/quoted_text.h"
#include "myoid/files/text_file.h"
#include "myoid/identification/nuisances.h"
#include "myoid/identification/parameters.h"
#include "myoid/identify_files/electrode_ties.h"
#include "myoid/intervals/verdicts.h"
#include "myoid/methods/exchanged_electrodes.h"
#include "myoid/methods/force.h"
#include "myoid/methods/paper.h"
#include "myoid/methods/prediction.h"
#include "myoid/methods/torque.h"
#include "myoid/results/prediction_files.h"
#include "myoid/study/study_text.h"

namespace myoid::commands {
namespace {

using identification::EstimatorOptions;
using identification::IdentificationResult;
using identification::StudyData;

constexpr int kStartsToCompare = 3;

StudyData read_data(const IdentifyOptions& o, const MuscleTable& table, Remarks& remarks) {
  IdentifySources files = o.files;
  files.torque = o.method == "torque";
  files.start_s = o.call.start_s;
  files.end_s = o.call.end_s;
  files.resting_torque_is_free = std::ranges::any_of(
      o.free_more, [](const std::string& name) { return name == "joint_torque_offset" || name == "joint_stiffness"; });
  StudyData data = read_identify_data(files, table, [&](const std::string& text) { remarks.warn(text); });
  // First, so that rules of the user's own win.
  if (o.method != "paper") {
    const std::vector<identification::ParameterRule> nuisances = identification::nuisance_rules(data, true);
    data.rules.insert(data.rules.begin(), nuisances.begin(), nuisances.end());
  }
  if (files.torque && o.scales == "electrode") {
    const ElectrodeTies ties = electrode_ties(data.muscles);
    data.rules.insert(data.rules.begin(), ties.rules.begin(), ties.rules.end());
  }
  const auto add = [&](const std::string& name, std::vector<std::string> owners, bool free) {
    (void)identification::parameter_field(name);
    identification::ParameterRule rule;
    rule.parameter = name;
    rule.owners = std::move(owners);
    rule.free = free;
    data.rules.push_back(std::move(rule));
  };
  for (const identification::MuscleSetup& muscle : data.muscles)
    if (identification::contains(muscle.fixed, "length_activation")) add("length_activation", {muscle.name}, false);
  for (const std::string& name : o.free_more) add(name, {}, true);
  for (const std::string& name : o.hold) add(name, {}, false);
  return data;
}

/// Returns the data with the nuisances that a fit of data with noise frees.
StudyData as_fitted(StudyData data, const MuscleTable& table, const EstimatorOptions& options) {
  StudyData freed = data;
  identification::free_speeds(freed, table.speed_may_be_free);
  if (!identification::tells_nuisances(freed, options)) identification::hold_nuisances(data);
  return data;
}

/// Returns the fit, and makes the rules of its data those of the fit: frees the v_max that the fit freed, and without
/// noise holds the nuisances.
IdentificationResult with_freed(IdentificationResult fit, const MuscleTable& t, StudyData& data) {
  const auto has = [&](std::string_view parameter) {
    return std::ranges::any_of(fit.estimates, [&](const auto& e) { return e.parameter == parameter; });
  };
  if (fit.exact) identification::hold_nuisances(data, has("emg_exponent") ? "emg_exponent" : "");
  if (has("max_shortening_speed")) identification::free_speeds(data, t.speed_may_be_free);
  return fit;
}

IdentificationResult fit_torque(const MuscleTable& t, const EstimatorOptions& o, StudyData& data) {
  IdentificationResult fit = identification::identify_torque_or_exact(data, o, t.speed_may_be_free);
  if (!fit.exact) data = as_fitted(std::move(data), t, o);
  return with_freed(std::move(fit), t, data);
}

identification::ForceOptions force_options(const MuscleTable& t, const EstimatorOptions& o) {
  return {.estimator = o, .detect_exact = true, .speed_may_be_free = t.speed_may_be_free};
}

/// Fits the data by the method. A v_max that the fit frees becomes free in the data too.
IdentificationResult fit_data(const IdentifyOptions& o,
                              const MuscleTable& table,
                              const EstimatorOptions& options,
                              StudyData& data) {
  if (o.method == "paper") return identification::identify_paper(data, {.multistart = o.starts.value_or(1)});
  if (o.method == "force")
    return with_freed(identification::identify_force(data, force_options(table, options)), table, data);
  return fit_torque(table, options, data);
}

/// Predicts trials or blocks by the fit to the others. `data` are the data before the fit.
std::vector<identification::Fold> held_out(const IdentifyOptions& o,
                                           const StudyData& data,
                                           const EstimatorOptions& options,
                                           const MuscleTable& table,
                                           std::string& why_not) {
  const identification::CrossValidationOptions how{
      .kind = o.folds == "block" ? identification::FoldKind::block : identification::FoldKind::trial,
      .setting = "--folds"};
  (void)identification::splits(data, how, &why_not);
  // The whole data have noise, and so has a part of them.
  const auto fit_fold = [&](StudyData& fold, const EstimatorOptions& once) {
    identification::free_speeds(fold, table.speed_may_be_free);
    return identification::identify_torque(fold, once);
  };
  if (o.method == "torque")
    return identification::cross_validate(as_fitted(data, table, options), fit_fold, options, how);
  const auto fit_force = [&](StudyData& fold, const EstimatorOptions& once) {
    identification::free_speeds(fold, table.speed_may_be_free);
    return identification::identify_muscle_force(fold, {.estimator = once});
  };
  std::vector<identification::Fold> folds;
  const EstimatorOptions of_one = identification::of_one_force(options);
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    const StudyData one = as_fitted(identification::force_study(data, k), table, of_one);
    const auto more = identification::cross_validate(one, fit_force, of_one, how);
    folds.insert(folds.end(), more.begin(), more.end());
  }
  return folds;
}

Provenance provenance_of(const IdentifyOptions& o) {
  Provenance provenance;
  provenance.command = o.call.command;
  const auto add = [&](const std::string& path) {
    provenance.inputs.push_back({path, sha256(recording::read_text_file(path))});
  };
  add(o.muscles.string());
  if (o.beliefs && o.method != "paper") add(o.beliefs->string());
  for (const auto* list : {&o.files.activations, &o.files.lengths, &o.files.velocities, &o.files.forces,
                           &o.files.moment_arms, &o.files.torques, &o.files.motions}) {
    for (const std::string& path : *list) add(path);
  }
  return provenance;
}

/// solvers.csv: a row per search.
std::string solvers_csv(const std::vector<identification::NamedContest>& contests) {
  const auto number = [](double value) { return recording::format_number(value); };
  std::string text = "fit,solver,start,cost,distance,evaluations,seconds,termination\n";
  for (const auto& [fit, c] : contests) {
    for (const identification::SolverRun& run : c.runs) {
      text +=
          fmt::format("{},{},{},{},{},{},{},{}\n", recording::csv_cell(fit), run.solver, run.start, number(run.cost),
                      number(run.distance), run.evaluations, number(run.seconds), math::name(run.termination));
    }
  }
  return text;
}

}  // namespace

IdentifyResult identify(const IdentifyOptions& o) {
  check_values(o);
  Remarks remarks(o.call);
  const MuscleTable table = read_muscles_csv(o.muscles, o.method != "paper");
  refuse_impossible(o, table);
  for (const std::string& text : without_effect(o)) remarks.warn(text);
  const StudyData as_read = read_data(o, table, remarks);
  const EstimatorOptions as_asked = estimator_options(o, as_read, remarks);

  IdentifyResult result;
  result.study = identify_study(o, table, remarks);
  result.data = as_read;
  result.fit = fit_data(o, table, as_asked, result.data);
  if (o.method == "torque" && identification::exchanged_electrodes(as_read, EstimatorOptions{}.delay_prior_mean_s))
    identification::apply({{.reason = std::string(identification::kExchangedCap)}}, result.fit);
  if (o.method == "torque" && !result.fit.exact && result.data.rules != as_read.rules &&
      !identification::tells_nuisances(result.data, as_asked))
    remarks.note(
        "the trials hold few independent rows of torque for the unknowns of the muscles: exponents of the EMG, the "
        "joint's own torque and the shift of the optimal length with activation stay at their expected values; more "
        "trials would tell them, --free frees them");
  if (o.method != "paper" && o.folds != "none" && !result.fit.exact)
    result.folds = held_out(o, as_read, beginning_at(result.fit, as_asked), table, result.why_no_folds);
  if (const std::string text = identification::generalises_badly(result.folds); !text.empty())
    result.fit.warnings.push_back(text);
  if (o.compare_solvers && o.method == "paper")
    result.contests = identification::solver_contests(
        result.data, {.starts = o.starts.value_or(kStartsToCompare), .seed = o.call.seed, .progress = o.call.progress});
  for (const std::string& text : result.fit.warnings) remarks.warn(text);
  result.speed_may_be_free = !table.speed_may_be_free.empty();
  result.told.left_out = o.folds;
  result.told.starting_values = table.assumed;
  result.provenance = provenance_of(o);
  result.remarks = remarks.list();
  return result;
}

std::string identify_json(const IdentifyResult& result) {
  return parameters_json({result.fit}, result.folds, result.provenance, result.told);
}

void write_identify(const IdentifyResult& result, const std::filesystem::path& folder) {
  write_parameter_files({result.fit}, result.folds, result.provenance, result.told, folder);
  write_held_back(result.fit, result.data, result.provenance, folder);
  recording::write_file(folder / "study.toml", study_toml(seen_from(folder, result.study)));
  if (!result.contests.empty()) recording::write_file(folder / "solvers.csv", solvers_csv(result.contests));
}

}  // namespace myoid::commands
