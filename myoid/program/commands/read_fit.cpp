#include "myoid/program/commands/read_fit.h"

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/fit/measurement/parameters.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::program {
namespace {

using fit::EmgLag;
using nlohmann::json;

double number(const json& cell) {
  return cell.is_number() ? cell.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

/// Returns the list `name` of numbers in a file. Throws ReadError for a cell that is no number and another length.
Eigen::VectorXd numbers(const std::filesystem::path& path,
                        const json& list,
                        std::string_view name,
                        std::optional<std::size_t> count = {}) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(list.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = number(list.at(at(i)));
  if (!values.allFinite() || list.size() != count.value_or(list.size()))
    throw ReadError(path, 0, "\"{}\" is no list of {} numbers; run the study again", name, count.value_or(list.size()));
  return values;
}

EmgLag lag_of(const json& method) {
  const json& word = method.at("emg_lag");
  for (const EmgLag lag : {EmgLag::shared, EmgLag::equation_1}) {
    if (word.is_string() && word.get<std::string>() == fit::name(lag)) return lag;
  }
  return EmgLag::delay;
}

fit::IdentificationResult fit_of(const std::filesystem::path& path, const json& method) {
  fit::IdentificationResult fit;
  fit.lag = lag_of(method);
  fit.exact = method.at("exact_data").get<bool>();
  fit.torque_sd_nm = number(method.at("torque_sd_nm"));
  fit.envelope_variance = numbers(path, method.at("envelope_variance"), "envelope_variance");
  fit.noise = numbers(path, method.at("noise"), "noise");
  if (!fit.exact && fit.noise.size() == 0)
    throw InvalidInput("its fit is that of an earlier version, by an estimator that is gone; run the study again");
  const json& covariance = method.at("covariance");
  fit.free_parameters = covariance.at("parameters").get<std::vector<std::string>>();
  fit.solution = numbers(path, covariance.at("mean"), "mean");
  const std::size_t n = fit.free_parameters.size();
  fit.covariance.resize(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  const json& matrix = covariance.at("matrix");
  if (matrix.size() > n) throw ReadError(path, 0, "\"matrix\" has more than {} rows; run the study again", n);
  for (std::size_t i = 0; i < n; ++i)
    fit.covariance.row(static_cast<Eigen::Index>(i)) = numbers(path, matrix.at(i), "matrix", n);
  return fit;
}

}  // namespace

fit::IdentificationResult read_fit(const std::filesystem::path& folder,
                                   const fit::StudyData& data,
                                   const fit::EstimatorOptions& options) {
  const std::filesystem::path path = folder / "parameters.json";
  try {
    const json content = parse_json(read_text_file(path));
    for (const json& method : content.at("methods")) {
      if (method.at("method") != "torque") continue;
      fit::IdentificationResult fit = fit_of(path, method);
      const fit::ParameterMap map(data, options);
      std::vector<std::string> labels;
      for (const fit::Unknown& unknown : map.free()) labels.push_back(unknown.label);
      if (labels != fit.free_parameters || fit.solution.size() != map.size())
        throw InvalidInput(fmt::format(
            "{} has {} unknowns, the study {} or others: its settings are not those of the run; run the study again",
            path.string(), fit.free_parameters.size(), labels.size()));
      fit.values = map.values(fit.solution);
      fit.delay_s = fit.values.channels.front()[fit::kDelay];
      return fit;
    }
  } catch (const json::exception& error) {
    throw ReadError(
        path, 0, fmt::format("is no result of a run of this version: {}; run the study again", json_error_text(error)));
  }
  throw InvalidInput(fmt::format("{} has no method torque; add it to method in [identify]", path.string()));
}

}  // namespace myoid::program
