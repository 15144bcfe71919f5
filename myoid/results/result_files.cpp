#include "myoid/results/result_files.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/page/json_values.h"
#include "myoid/page/tables.h"
#include "myoid/recording/tables/storage_writer.h"
#include "myoid/results/exports/identified_osim.h"
#include "myoid/results/methods_text.h"
#include "myoid/results/paper_tables.h"
#include "myoid/results/parameter_files.h"
#include "myoid/results/prediction_files.h"
#include "myoid/results/stage_files.h"
#include "myoid/run/study_emg.h"
#include "myoid/study/study_ids.h"

namespace myoid::results {
namespace {

using fit::IdentificationResult;
using nlohmann::ordered_json;

/// Returns reference, literature and identified force of every muscle, on the clock of the motion.
TimeSeries identified_forces(const run::StudyResult& result,
                             const fit::TrialData& data,
                             const IdentificationResult& method) {
  const fit::TrialFit* fit = run::trial_of(method, data.name);
  SeriesColumns columns;
  for (std::size_t m = 0; m < result.fit_input.data.muscles.size(); ++m) {
    const std::string& muscle = result.fit_input.data.muscles[m].name;
    const auto add = [&](const char* of, const Eigen::MatrixXd& force_n) {
      const Eigen::VectorXd force = force_n.col(static_cast<Eigen::Index>(m));
      columns.add(muscle + of, Unit::newton, force.array().isFinite().select(force, 0.0));
    };
    add("_reference", data.force_n);
    add("_literature", fit->literature_force_n);
    add("_identified", fit->force_fit_n);
  }
  return columns.series(data.time_s);
}

void write_informed_forces(const run::StudyResult& result,
                           const run::InformedForces& forces,
                           const std::filesystem::path& folder,
                           const std::vector<std::string>& comments) {
  std::vector<Channel> in_newtons, activations;
  for (const fit::MuscleSetup& muscle : result.fit_input.data.muscles) {
    in_newtons.push_back({muscle.name, Unit::newton});
    activations.push_back({muscle.name, Unit::dimensionless});
  }
  for (const std::string& name : study::study_coordinates(result.source.study.model))
    in_newtons.push_back({name + "_reserve", Unit::newton_meter});
  Eigen::MatrixXd values(forces.force_n.rows(), forces.force_n.cols() + forces.reserve_nm.cols());
  values << forces.force_n, forces.reserve_nm;
  recording::write_storage(folder / "EmgInformed_force.sto", {forces.time_s, std::move(in_newtons), std::move(values)},
                           {.title = "Forces informed by the EMG", .comments = comments});
  recording::write_storage(folder / "EmgInformed_activation.sto",
                           {forces.time_s, std::move(activations), forces.activation},
                           {.title = "Activations informed by the EMG", .comments = comments});
}

ordered_json fault_json(const Remark& fault) {
  return {{"fault", std::string(name(fault.code))},
          {"level", std::string(name(fault.severity))},
          {"channel", fault.about},
          {"begin_s", fault.when.value_or(Stretch{}).begin_s},
          {"end_s", fault.when.value_or(Stretch{}).end_s},
          {"value", fault.value.value_or(0.0)},
          {"message", sentence(fault)}};
}

/// Returns the median over the frames of the root mean square of the markers' distances; NaN without markers.
double median_marker_error_m(const run::TrialResult& trial) {
  std::vector<double> rms_m;
  for (const double value : trial.motion.ik ? trial.motion.ik->errors.column("marker_error_RMS") : Eigen::VectorXd())
    if (std::isfinite(value)) rms_m.push_back(value);
  return math::median(std::move(rms_m));
}

ordered_json trial_record(const run::TrialResult& trial, const NameIds& ids) {
  ordered_json record = {{"name", trial.spec.name},
                         {"folder", ids.of(trial.spec.name)},
                         {"use", std::string(choice_name(trial.spec.use))},
                         {"failure", trial.failure()},
                         {"marker_error_m", page::number_or_null(median_marker_error_m(trial))},
                         {"notes", sentences(trial.remarks)},
                         {"faults", array_of(trial.faults, fault_json)}};
  if (const auto& emg = trial.input.emg_clock) {
    ordered_json& clock = record["emg_clock"];
    clock = {{"offset_s", emg->clock.offset_s},
             {"drift_ppm", emg->clock.drift_ppm},
             {"pivot_s", emg->clock.pivot_s},
             {"source", emg->source}};
    if (emg->clock.offset_sd_s) clock["offset_sd_s"] = *emg->clock.offset_sd_s;
    if (emg->clock.drift_sd_ppm) clock["drift_sd_ppm"] = *emg->clock.drift_sd_ppm;
  }
  return record;
}

ordered_json run_json(const run::StudyResult& result, const Provenance& provenance) {
  ordered_json run = page::provenance_json(provenance);
  run["study"] = std::filesystem::absolute(result.source.study.file).string();
  run["start_s"] = page::number_or_null(result.start_s);
  run["end_s"] = page::number_or_null(result.end_s);
  run["seconds"] = ordered_json::object();
  for (const run::StageTime& stage : result.times) run["seconds"][stage.stage] = stage.seconds;
  const NameIds ids = study::trial_ids(result.source.study);
  run["trials"] = array_of(result.trials, [&](const run::TrialResult& trial) { return trial_record(trial, ids); });
  const recording::EmgChain emg = run::emg_chain(result, nullptr);
  run["emg"] = {{"steps", emg.steps}, {"methods", emg.methods}};
  run["faults"] = array_of(result.level_faults, fault_json);
  return run;
}

/// Writes the folder of each trial, and the predictions of those held back.
void write_series(const run::StudyResult& result, const Provenance& provenance, const std::filesystem::path& folder) {
  const std::vector<std::string> comments{fmt::format("Made by myoid {}.", provenance.version)};
  const auto with_emg = [&](const IdentificationResult* method) {
    std::vector<std::string> lines = comments;
    for (std::string& line : recording::header_lines(run::emg_chain(result, method))) lines.push_back(std::move(line));
    return lines;
  };
  const std::vector<std::string> of_activation = with_emg(nullptr);
  const NameIds ids = study::trial_ids(result.source.study);
  for (const run::TrialResult& trial : result.trials) {
    const std::filesystem::path place = folder / ids.of(trial.spec.name);
    if (!trial.emg.activation.empty())
      recording::write_storage(place / "activation.sto", trial.emg.activation,
                               {.title = "Activation", .comments = of_activation});
    if (!trial.has_motion()) continue;
    if (trial.motion.joints.q.channel_count() > 0)
      write_motion(*trial.motion.model, trial.motion.joints.q, place / "ik.mot", comments);
    if (trial.motion.ik) write_marker_errors(*trial.motion.ik, place / "ik_marker_errors.sto");
    body::MuscleKinematics paths = trial.forces.muscles;
    if (trial.forces.generalized.empty())
      paths.moment_arm.clear();
    else
      recording::write_storage(place / "id.sto", trial.forces.generalized,
                               {.title = "Inverse Dynamics Generalized Forces", .comments = comments});
    write_muscle_kinematics(paths, place);
    if (!trial.spec.given.forces) write_shared_forces(trial.forces.shared, place);
  }
  for (const IdentificationResult& method : result.fit.methods) {
    if (method.method != fit::Method::torque && result.fit.methods.size() > 1) continue;
    for (const fit::TrialData& data : result.fit_input.data.trials) {
      recording::write_storage(folder / ids.of(data.name) / "identified_forces.sto",
                               identified_forces(result, data, method),
                               {.title = "Forces", .comments = with_emg(&method)});
      if (const TimeSeries& drive = run::trial_of(method, data.name)->drive; !drive.empty())
        recording::write_storage(folder / ids.of(data.name) / "drive.sto", drive,
                                 {.title = "Drive", .comments = of_activation});
    }
  }
  for (const run::InformedForces& forces : result.fit.informed)
    write_informed_forces(result, forces, folder / ids.of(forces.trial), with_emg(run::torque_of(result.fit)));
  if (const IdentificationResult* torque = run::torque_of(result.fit))
    write_held_back(*torque, result.fit_input.data, provenance, folder);
}

}  // namespace

void write_results(const run::StudyResult& result,
                   const Provenance& provenance,
                   const std::filesystem::path& folder,
                   page::Kept kept) {
  if (kept == page::Kept::all) write_series(result, provenance, folder);
  write_identified_model(result, folder);
  if (!result.fit.contests.empty())
    write_file(folder / "solvers.csv", page::table_csv(solver_table(result.fit.contests)));
  write_parameter_files(result.fit.methods, result.folds,
                        without_places(provenance, result.source.study.file.parent_path()), parameter_context(result),
                        folder);
  const MethodsText methods = methods_text(result, provenance);
  write_file(folder / "methods.txt", methods_file(methods));
  write_file(folder / "methods.bib", methods_bibtex(methods));
  write_file(folder / "run.json", json_text(run_json(result, provenance)) + "\n");
}

}  // namespace myoid::results
