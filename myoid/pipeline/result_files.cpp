#include "myoid/pipeline/result_files.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/pipeline/quality_gates.h"
#include "myoid/pipeline/study_model.h"
#include "myoid/recording/atomic_file.h"
#include "myoid/recording/storage_writer.h"
#include "myoid/recording/text_file.h"

namespace myoid::pipeline {
namespace {

using identification::IdentificationResult;
using identification::ParameterEstimate;
using nlohmann::ordered_json;

std::string number_or_empty(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? recording::format_number(*value) : "";
}

ordered_json number_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? ordered_json(*value) : ordered_json(nullptr);
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

ordered_json provenance_json(const Provenance& provenance) {
  ordered_json json;
  json["program"] = provenance.program;
  json["version"] = provenance.version;
  json["command"] = provenance.command;
  json["inputs"] = ordered_json::array();
  for (const InputFile& file : provenance.inputs)
    json["inputs"].push_back({{"path", file.path}, {"sha256", file.sha256}});
  json["options"] = provenance.options_json.empty() ? ordered_json::object()
                                                    : ordered_json::parse(provenance.options_json);
  return json;
}

/// Marker errors may hold gaps, which other tools do not read: a missing marker is written as a
/// distance of 0 would lie, so its column is left to the frames that have it; frames without any
/// marker are left out.
TimeSeries without_gaps(const TimeSeries& series) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index r = 0; r < series.sample_count(); ++r) {
    if (series.values().row(r).head(3).allFinite()) rows.push_back(r);
  }
  std::vector<Eigen::Index> columns;
  for (Eigen::Index c = 0; c < series.channel_count(); ++c) {
    bool complete = true;
    for (const Eigen::Index r : rows) complete = complete && std::isfinite(series.values()(r, c));
    if (complete) columns.push_back(c);
  }
  Eigen::VectorXd time(static_cast<Eigen::Index>(rows.size()));
  Eigen::MatrixXd values(time.size(), static_cast<Eigen::Index>(columns.size()));
  std::vector<Channel> channels;
  for (const Eigen::Index c : columns)
    channels.push_back(series.channels()[static_cast<std::size_t>(c)]);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    time[static_cast<Eigen::Index>(i)] = series.time_s()[rows[i]];
    for (std::size_t k = 0; k < columns.size(); ++k)
      values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          series.values()(rows[i], columns[k]);
  }
  return {std::move(time), std::move(channels), std::move(values)};
}

/// reference, literature and identified force of every muscle, on the clock of the motion.
TimeSeries identified_forces(const StudyResult& result,
                             const identification::TrialData& data,
                             const IdentificationResult& method) {
  const auto fit = std::find_if(method.trials.begin(), method.trials.end(),
                                [&](const auto& t) { return t.trial == data.name; });
  std::vector<Channel> channels;
  const auto muscles = static_cast<Eigen::Index>(result.data.muscles.size());
  Eigen::MatrixXd values(data.time_s.size(), 3 * muscles);
  for (Eigen::Index m = 0; m < muscles; ++m) {
    const std::string& muscle = result.data.muscles[static_cast<std::size_t>(m)].name;
    channels.push_back({muscle + "_reference", Unit::newton});
    channels.push_back({muscle + "_literature", Unit::newton});
    channels.push_back({muscle + "_identified", Unit::newton});
    values.col(3 * m) = data.force_n.col(m);
    values.col(3 * m + 1) = fit->literature_force_n.col(m);
    values.col(3 * m + 2) = fit->force_fit_n.col(m);
  }
  return {data.time_s, std::move(channels), values.array().isFinite().select(values, 0.0)};
}

void write_informed_forces(const StudyResult& result,
                           const identification::InformedForces& forces,
                           const std::filesystem::path& folder,
                           const std::vector<std::string>& comments) {
  std::vector<Channel> in_newtons, activations;
  for (const identification::MuscleSetup& muscle : result.data.muscles) {
    in_newtons.push_back({muscle.name, Unit::newton});
    activations.push_back({muscle.name, Unit::dimensionless});
  }
  for (const std::string& name : study_coordinates(result.study.model))
    in_newtons.push_back({name + "_reserve", Unit::newton_meter});
  Eigen::MatrixXd values(forces.force_n.rows(), forces.force_n.cols() + forces.reserve_nm.cols());
  values << forces.force_n, forces.reserve_nm;
  recording::write_storage(folder / "EmgInformed_force.sto",
                           {forces.time_s, std::move(in_newtons), std::move(values)},
                           {.title = "Forces informed by the EMG", .comments = comments});
  recording::write_storage(folder / "EmgInformed_activation.sto",
                           {forces.time_s, std::move(activations), forces.activation},
                           {.title = "Activations informed by the EMG", .comments = comments});
}

/// Only numbers that are `identified`; F_max only if it means the maximum (EMG relative to an MVC);
/// no model at all if the motion failed its gates.
void write_identified_model(const StudyResult& result, const std::filesystem::path& folder) {
  if (motion_is_unreliable(result)) return;
  const bool from_mvc = result.study.emg.kind == EmgKind::activation || result.study.emg.has_mvc;
  for (const IdentificationResult& method : result.methods) {
    if (method.method != "torque") continue;
    std::vector<IdentifiedMuscle> muscles;
    for (std::size_t m = 0; m < result.data.muscles.size(); ++m) {
      IdentifiedMuscle muscle{
          result.data.muscles[m].name, result.data.muscles[m].start, method.muscles[m], {}};
      for (const ParameterEstimate& e : method.estimates) {
        const bool sure = e.verdict == identification::Verdict::identified &&
                          (from_mvc || e.parameter != "max_isometric_force");
        if (e.muscle == muscle.group && sure) muscle.changed.push_back(e.parameter);
      }
      muscles.push_back(std::move(muscle));
    }
    const std::string stem =
        result.study.model.file ? result.study.model.file->stem().string() : "arm4";
    recording::write_file(folder / (stem + "_identified.osim"),
                          identified_model(result.study, result.model_text, muscles));
  }
}

ordered_json faults_json(const std::vector<signals::Fault>& faults) {
  ordered_json list = ordered_json::array();
  for (const signals::Fault& fault : faults) {
    list.push_back({{"fault", std::string(signals::name(fault.kind))},
                    {"level", fault.grave ? "warning" : "note"},
                    {"channel", fault.channel},
                    {"begin_s", fault.begin_s},
                    {"end_s", fault.end_s},
                    {"value", fault.value},
                    {"message", signals::sentence(fault)}});
  }
  return list;
}

}  // namespace

std::string parameters_csv(const std::vector<IdentificationResult>& methods) {
  std::string text =
      "muscle,parameter,unit,method,case,initial,estimate,std_error,ci_low,ci_high,prior_mean,"
      "prior_sd,shrinkage,at_bound,verdict,reason";
  const std::vector<std::string> routes{"sandwich", "cluster", "jackknife", "bootstrap", "profile"};
  for (const std::string& route : routes) text += fmt::format(",ci_low_{0},ci_high_{0}", route);
  text += ",routes_disagree\n";
  for (const IdentificationResult& method : methods) {
    for (const ParameterEstimate& e : method.estimates) {
      text += fmt::format(
          "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", e.muscle, e.parameter, symbol(e.unit),
          e.method, e.fit_case, number_or_empty(e.initial), number_or_empty(e.estimate),
          number_or_empty(e.std_error), number_or_empty(e.ci_low), number_or_empty(e.ci_high),
          number_or_empty(e.prior_mean), number_or_empty(e.prior_sd), number_or_empty(e.shrinkage),
          e.at_bound ? "true" : "false", identification::name(e.verdict), quoted(e.reason));
      for (const std::string& route : routes) {
        const auto it = std::find_if(e.routes.begin(), e.routes.end(),
                                     [&](const auto& r) { return r.route == route; });
        text += it == e.routes.end()
                    ? ",,"
                    : fmt::format(",{},{}", number_or_empty(it->low), number_or_empty(it->high));
      }
      text += e.routes_disagree ? ",true\n" : ",false\n";
    }
  }
  return text;
}

std::string parameters_json(const std::vector<IdentificationResult>& methods,
                            const std::vector<identification::Fold>& folds,
                            const Provenance& provenance,
                            const std::vector<TrialPhases>& phases) {
  ordered_json json;
  json["provenance"] = provenance_json(provenance);
  json["methods"] = ordered_json::array();
  for (const IdentificationResult& method : methods) {
    ordered_json m;
    m["method"] = method.method;
    m["termination"] = std::string(math::name(method.termination));
    m["message"] = method.message;
    m["iterations"] = method.iterations;
    m["samples_used"] = method.samples_used;
    m["samples_dropped"] = method.samples_dropped;
    m["effective_samples"] = number_or_null(method.effective_samples);
    // Method paper knows neither noise nor delay, and predicts forces, not torque.
    const bool paper = method.method == "paper";
    const auto unless_paper = [&](double value) {
      return paper ? ordered_json(nullptr) : number_or_null(value);
    };
    m["torque_sd_nm"] = unless_paper(method.torque_sd_nm);
    m["emg_cv"] = unless_paper(method.emg_cv);
    m["r2"] = number_or_null(method.r2);
    m["model_error"] = unless_paper(method.model_error);
    m["condition"] = unless_paper(method.condition);
    m["emg_delay_s"] = unless_paper(method.delay_s);
    m["hardly_told_apart"] = method.collinear;
    m["estimates"] = ordered_json::array();
    for (const ParameterEstimate& e : method.estimates) {
      m["estimates"].push_back({{"muscle", e.muscle},
                                {"parameter", e.parameter},
                                {"unit", std::string(symbol(e.unit))},
                                {"method", e.method},
                                {"case", e.fit_case},
                                {"initial", number_or_null(e.initial)},
                                {"estimate", number_or_null(e.estimate)},
                                {"std_error", number_or_null(e.std_error)},
                                {"ci_low", number_or_null(e.ci_low)},
                                {"ci_high", number_or_null(e.ci_high)},
                                {"prior_mean", number_or_null(e.prior_mean)},
                                {"prior_sd", number_or_null(e.prior_sd)},
                                {"shrinkage", number_or_null(e.shrinkage)},
                                {"at_bound", e.at_bound},
                                {"verdict", std::string(identification::name(e.verdict))},
                                {"reason", e.reason},
                                {"routes_disagree", e.routes_disagree}});
      ordered_json routes = ordered_json::array();
      for (const identification::RouteInterval& r : e.routes) {
        routes.push_back({{"route", r.route},
                          {"ci_low", number_or_null(r.low)},
                          {"ci_high", number_or_null(r.high)}});
      }
      m["estimates"].back()["intervals"] = routes;
    }
    m["exact_data"] = method.exact;
    m["left_open_by_the_data"] = method.undetermined;
    m["diagnoses"] = method.diagnoses;
    m["warnings"] = method.warnings;
    m["bootstrap"] = {{"converged", method.bootstrap_replicates},
                      {"failed", method.bootstrap_failed}};
    m["branch_tests"] = ordered_json::array();
    for (const identification::BranchTest& test : method.branch_tests) {
      m["branch_tests"].push_back({{"muscle", test.muscle},
                                   {"optimal_fiber_length_difference", test.length_difference_m},
                                   {"force_length_width_difference", test.width_difference_m},
                                   {"wald", number_or_null(test.wald)},
                                   {"p_value", number_or_null(test.p_value)}});
    }
    m["covariance"] = {{"parameters", method.free_parameters},
                       {"scale", "natural logarithm of F_max, V_sh, P and gains; SI otherwise"}};
    ordered_json rows = ordered_json::array();
    for (Eigen::Index r = 0; r < method.covariance.rows(); ++r) {
      ordered_json row = ordered_json::array();
      for (Eigen::Index c = 0; c < method.covariance.cols(); ++c)
        row.push_back(number_or_null(method.covariance(r, c)));
      rows.push_back(row);
    }
    m["covariance"]["matrix"] = rows;
    m["trials"] = ordered_json::array();
    for (const identification::TrialFit& t : method.trials) {
      m["trials"].push_back({{"trial", t.trial},
                             {"joint", t.joint},
                             {"calibration", t.calibration},
                             {"rmse_nm", unless_paper(t.rmse_nm)},
                             {"nrmse_range", unless_paper(t.nrmse_range)},
                             {"r2", unless_paper(t.r2)},
                             {"band_rmse_nm", unless_paper(t.band.rmse_nm)},
                             {"band_nrmse_range", unless_paper(t.band.nrmse_range)},
                             {"band_r2", unless_paper(t.band.r2)}});
    }
    json["methods"].push_back(m);
  }
  const auto score_json = [](const identification::Score& s) {
    return ordered_json{{"rmse_nm", number_or_null(s.rmse_nm)},
                        {"nrmse_range", number_or_null(s.nrmse_range)},
                        {"nrmse_sd", number_or_null(s.nrmse_sd)},
                        {"r2", number_or_null(s.r2)},
                        {"vaf", number_or_null(s.vaf)}};
  };
  json["segments"] = ordered_json::array();
  for (const TrialPhases& trial : phases) {
    for (const Phase& phase : trial.phases) {
      json["segments"].push_back({{"trial", trial.trial},
                                  {"phase", std::string(name(phase.kind))},
                                  {"begin_s", phase.begin_s},
                                  {"end_s", phase.end_s},
                                  {"torque_per_emg", number_or_null(phase.gain)},
                                  {"median_frequency", number_or_null(phase.frequency)},
                                  {"fitted", !phase.excluded},
                                  {"reason", phase.reason}});
    }
  }
  json["leave_one_trial_out"] = ordered_json::array();
  for (const identification::Fold& f : folds) {
    json["leave_one_trial_out"].push_back(
        {{"trial", f.trial},
         {"joint", f.joint},
         {"identified", score_json(f.identified)},
         {"identified_below_cutoff", score_json(f.band)},
         {"literature_with_gain", score_json(f.literature)},
         {"gain", number_or_null(f.gain)},
         {"regression_on_emg", score_json(f.regression)},
         {"constant", score_json(f.constant)},
         {"paper", f.paper ? score_json(*f.paper) : ordered_json(nullptr)},
         {"lag_s", number_or_null(f.lag_s)}});
  }
  return json.dump(2) + "\n";
}

void write_motion(const model::BodyModel& model,
                  const TimeSeries& q,
                  const std::filesystem::path& path,
                  const std::vector<std::string>& comments) {
  // Only rotational coordinates are written in degrees; a coupled one stays as it is.
  std::vector<Channel> channels = q.channels();
  for (Channel& channel : channels) {
    const auto c = model.find_coordinate(channel.name);
    if (c &&
        model.coordinates[static_cast<std::size_t>(*c)].motion != model::MotionType::rotational)
      channel.unit = Unit::meter;
  }
  recording::write_storage(
      path, {q.time_s(), std::move(channels), q.values()},
      {.title = "Coordinates", .angles_in_degrees = true, .comments = comments});
}

void write_marker_errors(const kinematics::IkResult& ik, const std::filesystem::path& path) {
  recording::write_storage(path, without_gaps(ik.errors), {.title = "Model Marker Errors from IK"});
}

void write_muscle_kinematics(const kinematics::MuscleKinematics& muscles,
                             const std::filesystem::path& folder) {
  recording::write_storage(folder / "MuscleAnalysis_Length.sto", muscles.length,
                           {.title = "Length"});
  recording::write_storage(folder / "MuscleAnalysis_MuscleTendonVelocity.sto", muscles.velocity,
                           {.title = "MuscleTendonVelocity"});
  for (const auto& [coordinate, arms] : muscles.moment_arm) {
    recording::write_storage(folder / ("MuscleAnalysis_MomentArm_" + coordinate + ".sto"), arms,
                             {.title = "MomentArm_" + coordinate});
  }
}

void write_shared_forces(const forces::MuscleForces& shared, const std::filesystem::path& folder) {
  const auto with_reserves = [&](const TimeSeries& muscles) {
    std::vector<Channel> channels = muscles.channels();
    Eigen::MatrixXd values(muscles.sample_count(),
                           muscles.channel_count() + shared.reserve.channel_count());
    values << muscles.values(), shared.reserve.values();
    for (const Channel& channel : shared.reserve.channels()) channels.push_back(channel);
    return TimeSeries(muscles.time_s(), std::move(channels), std::move(values));
  };
  recording::write_storage(folder / "StaticOptimization_force.sto", with_reserves(shared.force),
                           {.title = "Static Optimization"});
  recording::write_storage(folder / "StaticOptimization_activation.sto", shared.activation,
                           {.title = "Static Optimization"});
  std::string status = "time_s,status,kkt_residual\n";
  for (std::size_t i = 0; i < shared.status.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    status += fmt::format("{},{},{}\n", recording::format_number(shared.force.time_s()[row]),
                          forces::name(shared.status[i]),
                          recording::format_number(shared.kkt_residual[row]));
  }
  recording::write_file(folder / "StaticOptimization_status.csv", status);
}

void remove_results(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::ifstream stream(folder / "run.json");
  if (!stream) return;
  const ordered_json run = ordered_json::parse(stream, nullptr, false);
  if (run.is_discarded() || !run.contains("trials")) return;
  std::error_code ignored;
  for (const ordered_json& trial : run["trials"]) {
    const std::string name = trial.value("name", "");
    if (name.empty() || name.find('/') != std::string::npos || name == "..") continue;
    for (const auto& entry : fs::directory_iterator(folder / name, ignored)) {
      const std::string file = entry.path().filename().string();
      const bool ours = file == "ik.mot" || file == "ik_marker_errors.sto" || file == "id.sto" ||
                        file == "activation.sto" || file == "identified_forces.sto" ||
                        file.starts_with("MuscleAnalysis_") || file.starts_with("EmgInformed_") ||
                        file.starts_with("StaticOptimization_");
      if (ours) fs::remove(entry.path(), ignored);
    }
    fs::remove(folder / name, ignored);  // only if nothing else is in it
  }
  for (const char* place : {"figures", "tables"}) {
    for (const auto& entry : fs::directory_iterator(folder / place, ignored)) {
      const fs::path extension = entry.path().extension();
      if (extension == ".svg" || extension == ".csv") fs::remove(entry.path(), ignored);
    }
  }
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string file = entry.path().filename().string();
    if (file.ends_with("_identified.osim")) fs::remove(entry.path(), ignored);
  }
}

void write_results(const StudyResult& result,
                   const Provenance& provenance,
                   const std::filesystem::path& folder) {
  const std::vector<std::string> comments{fmt::format("Made by myoid {}.", provenance.version)};
  for (const TrialResult& trial : result.trials) {
    const std::filesystem::path place = folder / trial.spec.name;
    if (!trial.activation.empty())
      recording::write_storage(place / "activation.sto", trial.activation,
                               {.title = "Activation", .comments = comments});
    if (!trial.has_motion()) continue;
    write_motion(trial.model, trial.motion.q, place / "ik.mot", comments);
    if (trial.ik) write_marker_errors(*trial.ik, place / "ik_marker_errors.sto");
    recording::write_storage(
        place / "id.sto", trial.generalized_forces,
        {.title = "Inverse Dynamics Generalized Forces", .comments = comments});
    write_muscle_kinematics(trial.muscles, place);
    write_shared_forces(trial.shared, place);
  }
  for (const IdentificationResult& method : result.methods) {
    if (method.method != "torque" && result.methods.size() > 1) continue;
    for (const identification::TrialData& data : result.data.trials) {
      recording::write_storage(folder / data.name / "identified_forces.sto",
                               identified_forces(result, data, method),
                               {.title = "Forces", .comments = comments});
    }
  }
  for (const identification::InformedForces& forces : result.informed)
    write_informed_forces(result, forces, folder / forces.trial, comments);
  write_identified_model(result, folder);
  recording::write_file(folder / "parameters.json",
                        parameters_json(result.methods, result.folds, provenance, result.phases));
  recording::write_file(folder / "parameters.csv", parameters_csv(result.methods));
  ordered_json run = provenance_json(provenance);
  run["study"] = std::filesystem::absolute(result.study.file).string();
  run["start_s"] = number_or_null(result.start_s);
  run["end_s"] = number_or_null(result.end_s);
  run["seconds"] = ordered_json::object();
  for (const StageTime& stage : result.times) run["seconds"][stage.stage] = stage.seconds;
  if (result.force_loop) {
    run["force_loop"] = {{"end", std::string(identification::name(result.force_loop->end))},
                         {"message", result.force_loop->message},
                         {"rounds", result.force_loop->rounds.size()}};
  }
  run["trials"] = ordered_json::array();
  for (const TrialResult& trial : result.trials) {
    run["trials"].push_back({{"name", trial.spec.name},
                             {"use", std::string(name(trial.spec.use))},
                             {"failure", trial.failure},
                             {"notes", trial.notes},
                             {"faults", faults_json(trial.faults)}});
    if (const auto& emg = trial.emg_clock) {
      ordered_json& clock = run["trials"].back()["emg_clock"];
      clock = {{"offset_s", emg->clock.offset_s},
               {"drift_ppm", emg->clock.drift_ppm},
               {"pivot_s", emg->clock.pivot_s},
               {"source", emg->source}};
      if (emg->clock.offset_sd_s) clock["offset_sd_s"] = *emg->clock.offset_sd_s;
      if (emg->clock.drift_sd_ppm) clock["drift_sd_ppm"] = *emg->clock.drift_sd_ppm;
    }
  }
  run["faults"] = faults_json(result.level_faults);
  recording::write_file(folder / "run.json", run.dump(2) + "\n");
}

}  // namespace myoid::pipeline
