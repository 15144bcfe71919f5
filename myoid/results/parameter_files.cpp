#include "myoid/results/parameter_files.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/core/json_text.h"
#include "myoid/files/text_file.h"
#include "myoid/report/json_values.h"
#include "myoid/run/prediction_gates.h"

namespace myoid {
namespace {

using identification::IdentificationResult;
using identification::ParameterEstimate;
using nlohmann::ordered_json;

std::string number_or_empty(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? recording::format_number(*value) : "";
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

ordered_json estimate_json(const ParameterEstimate& e) {
  ordered_json object = {{"muscle", e.muscle},
                         {"parameter", e.parameter},
                         {"unit", std::string(symbol(e.unit))},
                         {"method", e.method},
                         {"case", e.fit_case},
                         {"initial", report::number_or_null(e.initial)},
                         {"estimate", report::number_or_null(e.estimate)},
                         {"std_error", report::number_or_null(e.std_error)},
                         {"ci_low", report::number_or_null(e.ci_low)},
                         {"ci_high", report::number_or_null(e.ci_high)},
                         {"prior_mean", report::number_or_null(e.prior_mean)},
                         {"prior_sd", report::number_or_null(e.prior_sd)},
                         {"prior_distance", report::number_or_null(e.prior_distance)},
                         {"shrinkage", report::number_or_null(e.shrinkage)},
                         {"at_bound", e.at_bound},
                         {"verdict", std::string(identification::name(e.verdict))},
                         {"reason", e.reason},
                         {"routes_disagree", e.routes_disagree}};
  if (!e.tied_to.empty()) object["tied_to"] = e.tied_to;
  ordered_json routes = ordered_json::array();
  for (const identification::RouteInterval& r : e.routes) {
    routes.push_back({{"route", r.route},
                      {"ci_low", report::number_or_null(r.low)},
                      {"ci_high", report::number_or_null(r.high)}});
  }
  object["intervals"] = routes;
  return object;
}

ordered_json basins_json(const identification::BasinTable& table) {
  ordered_json object = {{"fit", table.fit},
                         {"starts", table.starts},
                         {"starts_without_a_minimum", table.failed},
                         {"basins", ordered_json::array()}};
  for (const identification::BasinRow& basin : table.basins) {
    object["basins"].push_back({{"cost", report::number_or_null(basin.cost)},
                                {"starts", basin.starts},
                                {"converged", basin.converged},
                                {"distance", report::number_or_null(basin.distance)},
                                {"as_good_as_the_best", basin.rival},
                                {"of_the_given_start", basin.given}});
  }
  return object;
}

ordered_json method_json(const IdentificationResult& method) {
  ordered_json m;
  m["method"] = method.method;
  m["termination"] = std::string(math::name(method.termination));
  m["message"] = method.message;
  m["iterations"] = method.iterations;
  m["samples_used"] = method.samples_used;
  m["samples_dropped"] = method.samples_dropped;
  m["effective_samples"] = report::number_or_null(method.effective_samples);
  // Method paper knows neither noise nor delay, and predicts forces, not torque.
  const bool paper = method.method == "paper";
  const auto unless_paper = [&](double value) {
    return paper ? ordered_json(nullptr) : report::number_or_null(value);
  };
  m["torque_sd_nm"] = unless_paper(method.torque_sd_nm);
  m["emg_cv"] = unless_paper(method.emg_cv);
  m["r2"] = report::number_or_null(method.r2);
  m["model_error"] = unless_paper(method.model_error);
  m["condition"] = unless_paper(method.condition);
  m["emg_delay_s"] = unless_paper(method.delay_s);
  m["emg_lag"] = paper ? ordered_json(nullptr) : ordered_json(identification::name(method.lag));
  m["shared_lag_gain"] =
      method.shared_lag_gain ? report::number_or_null(*method.shared_lag_gain) : nullptr;
  m["hardly_told_apart"] = method.collinear;
  m["estimates"] = ordered_json::array();
  for (const ParameterEstimate& e : method.estimates) m["estimates"].push_back(estimate_json(e));
  m["exact_data"] = method.exact;
  m["left_open_by_the_data"] = method.undetermined;
  m["diagnoses"] = method.diagnoses;
  m["warnings"] = method.warnings;
  m["prior_distances"] = ordered_json::array();
  for (const identification::PriorDistance& d : method.prior_distances)
    m["prior_distances"].push_back({{"muscle", d.muscle},
                                    {"standard_deviations", d.distance},
                                    {"farthest", d.farthest},
                                    {"farthest_standard_deviations", d.farthest_distance}});
  m["bootstrap"] = {{"converged", method.bootstrap_replicates},
                    {"failed", method.bootstrap_failed}};
  m["branch_tests"] = ordered_json::array();
  for (const identification::BranchTest& test : method.branch_tests) {
    m["branch_tests"].push_back({{"muscle", test.muscle},
                                 {"optimal_fiber_length_difference", test.length_difference_m},
                                 {"force_length_width_difference", test.width_difference_m},
                                 {"wald", report::number_or_null(test.wald)},
                                 {"p_value", report::number_or_null(test.p_value)}});
  }
  m["searches"] = ordered_json::array();
  for (const identification::BasinTable& table : method.basins)
    m["searches"].push_back(basins_json(table));
  m["covariance"] = {{"parameters", method.free_parameters},
                     {"scale", "natural logarithm of F_max, V_sh, P and gains; SI otherwise"}};
  ordered_json rows = ordered_json::array();
  for (Eigen::Index r = 0; r < method.covariance.rows(); ++r) {
    ordered_json row = ordered_json::array();
    for (Eigen::Index c = 0; c < method.covariance.cols(); ++c)
      row.push_back(report::number_or_null(method.covariance(r, c)));
    rows.push_back(row);
  }
  m["covariance"]["matrix"] = rows;
  m["trials"] = ordered_json::array();
  for (const identification::TrialFit& t : method.trials) {
    m["trials"].push_back({{"trial", t.trial},
                           {"joint", t.joint},
                           {"calibration", t.calibration},
                           {"rmse_nm", unless_paper(t.score.rmse_nm())},
                           {"nrmse_range", unless_paper(t.score.nrmse_range())},
                           {"r2", unless_paper(t.score.r2())},
                           {"smoothed_r2", unless_paper(smoothed_score(t).r2())},
                           {"smoothed_below_hz", unless_paper(t.smooth_hz)},
                           {"band_rmse_nm", unless_paper(t.band.rmse_nm())},
                           {"band_nrmse_range", unless_paper(t.band.nrmse_range())},
                           {"band_r2", unless_paper(t.band.r2())}});
  }
  return m;
}

/// What a fold's prediction was made with.
ordered_json fold_values(const identification::Fold& fold) {
  ordered_json values = ordered_json::array();
  for (const ParameterEstimate& e : fold.parameters)
    values.push_back({{"muscle", e.muscle},
                      {"parameter", e.parameter},
                      {"estimate", report::number_or_null(e.estimate)}});
  return values;
}

ordered_json score_json(const identification::Score& s) {
  return ordered_json{{"rmse_nm", report::number_or_null(s.rmse_nm())},
                      {"nrmse_range", report::number_or_null(s.nrmse_range())},
                      {"nrmse_sd", report::number_or_null(s.nrmse_sd())},
                      {"r2", report::number_or_null(s.r2())},
                      {"vaf", report::number_or_null(s.vaf())}};
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

std::string fold_parameters_csv(const std::vector<identification::Fold>& folds) {
  std::string text = "left_out,muscle,parameter,unit,estimate,emg_lag\n";
  std::set<std::string> written;
  for (const identification::Fold& fold : folds) {
    for (const ParameterEstimate& e : fold.parameters) {
      // The joints of one trial are predicted by one fit.
      const std::string row = fmt::format("{},{},{}", quoted(fold.trial), e.muscle, e.parameter);
      if (!written.insert(row).second) continue;
      text += fmt::format("{},{},{},{}\n", row, symbol(e.unit), number_or_empty(e.estimate),
                          identification::name(fold.lag));
    }
  }
  return text;
}

std::string parameters_json(const std::vector<IdentificationResult>& methods,
                            const std::vector<identification::Fold>& folds,
                            const Provenance& provenance,
                            const ParameterContext& context) {
  ordered_json object;
  object["provenance"] = report::provenance_json(provenance);
  object["methods"] = ordered_json::array();
  for (const IdentificationResult& method : methods)
    object["methods"].push_back(method_json(method));
  object["segments"] = ordered_json::array();
  for (const TrialPhases& trial : context.phases) {
    for (const Phase& phase : trial.phases) {
      object["segments"].push_back({{"trial", trial.trial},
                                    {"phase", std::string(choice_name(phase.kind))},
                                    {"begin_s", phase.begin_s},
                                    {"end_s", phase.end_s},
                                    {"torque_per_emg", report::number_or_null(phase.gain)},
                                    {"median_frequency", report::number_or_null(phase.frequency)},
                                    {"fitted", !phase.excluded},
                                    {"reason", phase.reason}});
    }
  }
  if (context.force_loop != nullptr) {
    const identification::ForceLoop& loop = *context.force_loop;
    object["force_loop"] = {{"end", std::string(identification::name(loop.end))},
                            {"message", loop.message},
                            {"rounds", loop.rounds.size()}};
  }
  object["left_out"] = context.left_out;
  object["max_rate_hz"] = context.max_rate_hz ? ordered_json(*context.max_rate_hz) : nullptr;
  if (!context.starting_values.empty()) object["starting_values"] = context.starting_values;
  object["resting_torque"] = ordered_json::array();
  for (const identification::RestingJoint& joint : context.resting) {
    const Eigen::VectorXd& c = joint.torque.coefficient_nm;
    object["resting_torque"].push_back(
        {{"joint", joint.joint},
         {"trials", joint.trials},
         {"lowest_rad", joint.torque.lowest_rad},
         {"highest_rad", joint.torque.highest_rad},
         {"legendre_nm", std::vector<double>(c.data(), c.data() + c.size())},
         {"weight_sin_nm", joint.torque.weight_sin_nm},
         {"weight_cos_nm", joint.torque.weight_cos_nm},
         {"viscosity_nms", joint.torque.viscosity_nms},
         {"residual_nm", joint.torque.residual_nm}});
  }
  object["leave_one_trial_out"] = ordered_json::array();
  for (const identification::Fold& f : folds) {
    object["leave_one_trial_out"].push_back(
        {{"trial", f.trial},
         {"joint", f.joint},
         {"identified", score_json(f.identified)},
         {"identified_smoothed", score_json(f.smooth)},
         {"smoothed_below_hz", report::number_or_null(f.smooth_hz)},
         {"identified_below_cutoff", score_json(f.band)},
         {"literature_with_gain", score_json(f.literature)},
         {"gain", report::number_or_null(f.gain)},
         {"regression_on_emg", score_json(f.regression)},
         {"constant", score_json(f.constant)},
         {"paper", f.paper ? score_json(*f.paper) : ordered_json(nullptr)},
         {"lag_s", report::number_or_null(f.lag_s)},
         {"unseen_effort",
          {{"channel", f.unseen.channel}, {"ratio", report::number_or_null(f.unseen.ratio)}}},
         {"converged", f.converged},
         {"emg_lag", identification::name(f.lag)},
         {"parameters", fold_values(f)}});
  }
  return json_text(object) + "\n";
}

ParameterContext parameter_context(const StudyResult& result) {
  return {.phases = result.fit_input.phases,
          .resting = result.resting,
          .left_out = std::string(choice_name(result.source.study.identify.folds)),
          .max_rate_hz = result.source.study.identify.max_rate_hz,
          .force_loop = result.fit.force_loop ? &*result.fit.force_loop : nullptr};
}

}  // namespace myoid
