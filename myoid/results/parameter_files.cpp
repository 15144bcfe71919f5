#include "myoid/results/parameter_files.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <type_traits>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/fit/intervals/estimate_columns.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/page/json_values.h"
#include "myoid/page/tables.h"
#include "myoid/results/voluntary_report.h"
#include "myoid/run/prediction_gates.h"
#include "myoid/study/study_model.h"

namespace myoid::results {
namespace {

using fit::EstimateColumn;
using fit::IdentificationResult;
using fit::ParameterEstimate;
using ground::csv_cell;
using ground::csv_quoted;
using nlohmann::ordered_json;
using page::number_or_null;

std::string number_or_empty(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? format_number(*value) : "";
}

struct CsvCell {
  std::string operator()(const std::string& text) const { return text; }
  std::string operator()(const std::optional<double>& value) const { return number_or_empty(value); }
  std::string operator()(double value) const { return number_or_empty(value); }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(Unit unit) const { return std::string(symbol(unit)); }
  template <typename Enumeration>
  requires std::is_enum_v<Enumeration> std::string operator()(Enumeration value) const {
    return std::string(choice_name(value));
  }
};

struct JsonValue {
  ordered_json operator()(const std::optional<double>& value) const { return number_or_null(value); }
  ordered_json operator()(double value) const { return number_or_null(value); }
  ordered_json operator()(bool value) const { return value; }
  ordered_json operator()(const auto& other) const { return CsvCell{}(other); }
};

template <typename Format>
auto cell_of(const ParameterEstimate& e, const EstimateColumn& column, Format format) {
  return std::visit([&](const auto member) { return format(e.*member); }, column.member);
}

ordered_json estimate_json(const ParameterEstimate& e) {
  ordered_json object;
  for (const EstimateColumn& column : fit::estimate_columns())
    object[std::string(column.name)] = cell_of(e, column, JsonValue{});
  if (!e.tied_to.empty()) object["tied_to"] = e.tied_to;
  if (e.variance_shares) {
    for (std::size_t s = 0; s < fit::kSourceColumns.size(); ++s)
      object["variance_shares"][std::string(fit::kSourceColumns[s])] = (*e.variance_shares)[s];
  }
  return object;
}

/// Returns true if the sources of the variance have columns.
bool with_shares(const std::vector<IdentificationResult>& methods) {
  return std::ranges::any_of(methods, [](const IdentificationResult& method) {
    return std::ranges::any_of(method.estimates, [](const auto& e) { return e.variance_shares.has_value(); });
  });
}

/// Returns a row of parameters.csv without its end of line.
std::string estimate_row(const ParameterEstimate& e, bool shares) {
  std::vector<std::string> cells;
  for (const EstimateColumn& column : fit::estimate_columns()) {
    if (column.kind == EstimateColumn::Kind::json) continue;
    const std::string cell = cell_of(e, column, CsvCell{});
    cells.push_back(column.kind == EstimateColumn::Kind::sentence ? csv_quoted(cell) : csv_cell(cell));
  }
  for (std::size_t s = 0; shares && s < fit::kSourceColumns.size(); ++s)
    cells.push_back(e.variance_shares ? number_or_empty((*e.variance_shares)[s]) : "");
  return fmt::format("{}", fmt::join(cells, ","));
}

ordered_json basin_json(const fit::BasinRow& basin) {
  return {{"cost", number_or_null(basin.cost)}, {"starts", basin.starts},
          {"converged", basin.converged},       {"distance", number_or_null(basin.distance)},
          {"as_good_as_the_best", basin.rival}, {"of_the_given_start", basin.given}};
}

ordered_json basins_json(const fit::BasinTable& table) {
  return {{"fit", table.fit},
          {"starts", table.starts},
          {"starts_without_a_minimum", table.failed},
          {"basins", array_of(table.basins, basin_json)}};
}

ordered_json distance_json(const fit::PriorDistance& d) {
  return {{"muscle", d.muscle},
          {"standard_deviations", d.distance},
          {"farthest", d.farthest},
          {"farthest_standard_deviations", d.farthest_distance}};
}

ordered_json branch_test_json(const fit::BranchTest& test) {
  return {{"muscle", test.muscle},
          {"optimal_fiber_length_difference", test.length_difference_m},
          {"force_length_width_difference", test.width_difference_m},
          {"wald", number_or_null(test.wald)},
          {"p_value", number_or_null(test.p_value)}};
}

ordered_json published_json(const fit::PublishedSearch& search) {
  return {{"muscle", search.muscle},
          {"case", std::string(name(search.fit_case))},
          {"termination", std::string(math::name(search.termination))},
          {"message", search.message},
          {"iterations", search.iterations},
          {"damped", search.damped},
          {"start_cost", number_or_null(search.start_cost)},
          {"cost", number_or_null(search.cost)},
          {"plain_termination", std::string(math::name(search.plain))},
          {"plain_iterations", search.plain_iterations},
          {"plain_elsewhere", search.plain_elsewhere}};
}

/// Root mean square error of each muscle's predicted fiber length against the measured one.
ordered_json fibers_json(const fit::FiberScores& scores) {
  ordered_json of = ordered_json::object();
  for (const fit::FiberScore& fiber : scores.fibers) of[fiber.muscle] = number_or_null(fiber.rms_m());
  return of;
}

/// Converts a trial. `number` writes numbers that method paper does not have.
template <typename Number>
ordered_json trial_json(const fit::TrialFit& t, Number number) {
  return {{"trial", t.trial},
          {"joint", t.joint},
          {"calibration", t.calibration},
          {"rmse_nm", number(t.score.rmse_nm())},
          {"nrmse_range", number(t.score.nrmse_range())},
          {"r2", number(t.score.r2())},
          {"band_rmse_nm", number(t.band.rmse_nm())},
          {"band_nrmse_range", number(t.band.nrmse_range())},
          {"band_r2", number(t.band.r2())},
          {"covered", number(fit::covered_share(t.torque_nm, t.torque_fit_nm, t.torque_sd_nm))},
          {"fiber_length_rms_m", fibers_json(t)}};
}

ordered_json method_json(const IdentificationResult& method) {
  // Method paper has neither noise nor delay, and predicts forces, not torque.
  const bool paper = method.method == fit::Method::paper;
  const auto unless_paper = [&](double value) { return paper ? ordered_json(nullptr) : number_or_null(value); };
  return {{"method", std::string(name(method.method))},
          {"termination", std::string(math::name(method.termination))},
          {"message", method.message},
          {"iterations", method.iterations},
          {"samples_used", method.samples_used},
          {"samples_dropped", method.samples_dropped},
          {"effective_samples", number_or_null(method.effective_samples)},
          {"torque_sd_nm", unless_paper(method.torque_sd_nm)},
          {"emg_cv", unless_paper(method.emg_cv)},
          {"r2", number_or_null(method.r2)},
          {"model_error", unless_paper(method.model_error)},
          {"emg_delay_s", unless_paper(method.delay_s)},
          {"emg_lag", paper ? ordered_json(nullptr) : ordered_json(fit::name(method.lag))},
          {"maximal_contraction",
           method.voluntary.empty() ? ordered_json(nullptr) : ordered_json(method.voluntary.front().from_mvc)},
          {"estimates", array_of(method.estimates, estimate_json)},
          {"exact_data", method.exact},
          {"left_open_by_the_data", method.open_sums},
          {"diagnoses", sentences(method.diagnoses)},
          {"warnings", sentences(method.warnings)},
          {"prior_distances", array_of(method.prior_distances, distance_json)},
          {"branch_tests", array_of(method.branch_tests, branch_test_json)},
          {"published_searches", array_of(method.published, published_json)},
          {"searches", array_of(method.basins, basins_json)},
          {"covariance",
           {{"parameters", method.free_parameters},
            {"mean", page::to_vector(method.solution)},
            {"scale", "natural logarithm of F_max, V_sh, P and gains; SI otherwise"},
            {"matrix", page::matrix_json(method.covariance)}}},
          {"envelope_variance", page::to_vector(method.envelope_variance)},
          {"noise", page::to_vector(method.noise)},
          {"trials", array_of(method.trials, [&](const auto& trial) { return trial_json(trial, unless_paper); })}};
}

ordered_json fold_value_json(const ParameterEstimate& e) {
  return {{"muscle", e.muscle}, {"parameter", e.parameter}, {"estimate", number_or_null(e.estimate)}};
}

ordered_json score_json(const fit::Score& s) {
  return {{"rmse_nm", number_or_null(s.rmse_nm())},
          {"nrmse_range", number_or_null(s.nrmse_range())},
          {"nrmse_sd", number_or_null(s.nrmse_sd())},
          {"r2", number_or_null(s.r2())},
          {"vaf", number_or_null(s.vaf())}};
}

ordered_json fold_json(const fit::Fold& f) {
  return {{"trial", f.trial},
          {"joint", f.joint},
          {"identified", score_json(f.identified)},
          {"identified_below_cutoff", score_json(f.band)},
          {"literature_with_gain", score_json(f.literature)},
          {"gain", number_or_null(f.gain)},
          {"regression_on_emg", score_json(f.regression)},
          {"constant", score_json(f.constant)},
          {"lag_s", number_or_null(f.lag_s)},
          {"covered", number_or_null(f.covered)},
          {"fiber_length_rms_m", fibers_json(f)},
          {"unseen_effort", {{"channel", f.unseen.channel}, {"ratio", number_or_null(f.unseen.ratio)}}},
          {"converged", f.converged},
          {"emg_lag", fit::name(f.lag)},
          {"parameters", array_of(f.parameters, fold_value_json)}};
}

ordered_json phase_json(const std::string& trial, const study::Phase& phase) {
  return {{"trial", trial},
          {"phase", std::string(choice_name(phase.kind))},
          {"begin_s", phase.begin_s},
          {"end_s", phase.end_s},
          {"torque_per_emg", number_or_null(phase.gain)},
          {"median_frequency", number_or_null(phase.frequency)},
          {"fitted", !phase.excluded},
          {"reason", phase.reason}};
}

ordered_json resting_json(const run::RestingJoint& joint) {
  return {{"joint", joint.joint},
          {"trials", joint.trials},
          {"lowest_rad", joint.torque.lowest_rad},
          {"highest_rad", joint.torque.highest_rad},
          {"legendre_nm", page::to_vector(joint.torque.coefficient_nm)},
          {"weight_sin_nm", joint.torque.weight_sin_nm},
          {"weight_cos_nm", joint.torque.weight_cos_nm},
          {"viscosity_nms", joint.torque.viscosity_nms},
          {"residual_nm", joint.torque.residual_nm}};
}

/// Returns true if a trial took no part in the fits and was predicted.
bool any_held_back(const std::vector<IdentificationResult>& methods) {
  return std::ranges::any_of(methods, [](const IdentificationResult& method) {
    return std::ranges::any_of(method.trials, [](const fit::TrialFit& trial) { return !trial.calibration; });
  });
}

}  // namespace

std::string parameters_csv(const std::vector<IdentificationResult>& methods) {
  const bool shares = with_shares(methods);
  std::vector<std::string> names;
  for (const EstimateColumn& column : fit::estimate_columns()) {
    if (column.kind != EstimateColumn::Kind::json) names.emplace_back(column.name);
  }
  for (std::size_t s = 0; shares && s < fit::kSourceColumns.size(); ++s)
    names.push_back(fmt::format("variance_{}", fit::kSourceColumns[s]));
  std::string text = fmt::format("{}\n", fmt::join(names, ","));
  for (const IdentificationResult& method : methods) {
    for (const ParameterEstimate& e : method.estimates) text += estimate_row(e, shares) + "\n";
  }
  return text;
}

std::string posterior_csv(const IdentificationResult& method) {
  std::string text = "weight";
  for (const std::string& name : method.free_parameters) text += "," + csv_cell(name);
  text += "\n";
  for (Eigen::Index i = 0; i < method.draws.cols(); ++i) {
    text += fmt::format("{:.6g}", method.draw_weights[i]);
    for (const double value : method.draws.col(i)) text += fmt::format(",{:.6g}", value);
    text += "\n";
  }
  return text;
}

std::string fold_parameters_csv(const std::vector<fit::Fold>& folds) {
  std::string text = "left_out,muscle,parameter,unit,estimate,emg_lag\n";
  std::set<std::string> written;
  for (const fit::Fold& fold : folds) {
    for (const ParameterEstimate& e : fold.parameters) {
      // One fit predicts all joints of a trial.
      const std::string row = fmt::format("{},{},{}", csv_quoted(fold.trial), csv_cell(e.muscle), e.parameter);
      if (!written.insert(row).second) continue;
      text += fmt::format("{},{},{},{}\n", row, symbol(e.unit), number_or_empty(e.estimate), fit::name(fold.lag));
    }
  }
  return text;
}

std::string parameters_json(const std::vector<IdentificationResult>& methods,
                            const std::vector<fit::Fold>& folds,
                            const Provenance& provenance,
                            const ParameterContext& context) {
  ordered_json object{{"provenance", page::provenance_json(provenance)},
                      {"methods", array_of(methods, method_json)},
                      {"segments", ordered_json::array()}};
  for (const study::TrialPhases& trial : context.phases) {
    for (const study::Phase& phase : trial.phases) object["segments"].push_back(phase_json(trial.trial, phase));
  }
  object["left_out"] = !folds.empty() ? context.left_out : any_held_back(methods) ? "validation" : "none";
  object["max_rate_hz"] = fit::EstimatorOptions{}.max_rate_hz;
  if (!context.starting_values.empty()) object["starting_values"] = context.starting_values;
  object["resting_torque"] = array_of(context.resting, resting_json);
  object["leave_one_trial_out"] = array_of(folds, fold_json);
  return json_text(object) + "\n";
}

ParameterContext parameter_context(const run::StudyResult& result) {
  return {.phases = result.fit_input.phases,
          .resting = result.resting,
          .left_out = std::string(choice_name(result.source.study.identify.folds)),
          .starting_values = study::assumed_starts(result.source.study)};
}

void write_parameter_files(const std::vector<IdentificationResult>& methods,
                           const std::vector<fit::Fold>& folds,
                           const Provenance& provenance,
                           const ParameterContext& context,
                           const std::filesystem::path& folder) {
  write_file(folder / "parameters.json", parameters_json(methods, folds, provenance, context));
  write_file(folder / "parameters.csv", parameters_csv(methods));
  if (!folds.empty()) write_file(folder / "fold_parameters.csv", fold_parameters_csv(folds));
  const auto drawn = std::ranges::find_if(methods, [](const auto& method) { return method.draws.size() > 0; });
  const auto told = std::ranges::find_if(methods, [](const auto& method) { return !method.voluntary.empty(); });
  if (told != methods.end()) write_file(folder / "voluntary_torque.csv", voluntary_csv(*told));
  if (drawn != methods.end()) write_file(folder / "posterior.csv", posterior_csv(*drawn));
}

}  // namespace myoid::results
