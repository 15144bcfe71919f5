#include "myoid/results/read_fit.h"

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/core/error.h"
#include "myoid/core/index.h"
#include "myoid/core/json_text.h"
#include "myoid/files/text_file.h"
#include "myoid/identification/parameters.h"

namespace myoid {
namespace {

using identification::EmgLag;
using nlohmann::json;

double number(const json& cell) {
  return cell.is_number() ? cell.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

/// The lists of numbers of one method in a file. Throws ReadError for a cell that is no number and for another shape.
struct Numbers {
  const std::filesystem::path& path;
  const json& of;

  [[nodiscard]] Eigen::VectorXd vector(std::string_view name) const { return finite(name, of.at(name)); }

  [[nodiscard]] Eigen::MatrixXd square(std::string_view name, Eigen::Index n) const {
    const json& rows = of.at(name);
    Eigen::MatrixXd values(n, n);
    bool is_square = static_cast<Eigen::Index>(rows.size()) == n;
    for (Eigen::Index i = 0; is_square && i < n; ++i) {
      const Eigen::VectorXd row = finite(name, rows.at(at(i)));
      is_square = row.size() == n;
      if (is_square) values.row(i) = row;
    }
    if (!is_square)
      throw ReadError(path, 0, "\"{}\" is no matrix of {} rows and columns; run the study again", name, n);
    return values;
  }

 private:
  [[nodiscard]] Eigen::VectorXd finite(std::string_view name, const json& list) const {
    Eigen::VectorXd values(static_cast<Eigen::Index>(list.size()));
    for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = number(list.at(at(i)));
    if (!values.allFinite()) throw ReadError(path, 0, "\"{}\" has a cell that is no number; run the study again", name);
    return values;
  }
};

EmgLag lag_of(const json& method) {
  const json& word = method.at("emg_lag");
  for (const EmgLag lag : {EmgLag::shared, EmgLag::equation_1}) {
    if (word.is_string() && word.get<std::string>() == identification::name(lag)) return lag;
  }
  return EmgLag::delay;
}

identification::IdentificationResult fit_of(const std::filesystem::path& path, const json& method) {
  const Numbers numbers{path, method};
  identification::IdentificationResult fit;
  fit.lag = lag_of(method);
  fit.exact = method.at("exact_data").get<bool>();
  fit.torque_sd_nm = number(method.at("torque_sd_nm"));
  fit.envelope_variance = numbers.vector("envelope_variance");
  fit.noise = numbers.vector("noise");
  if (!fit.exact && fit.noise.size() == 0)
    throw InvalidInput("its fit is that of an earlier version, by an estimator that is gone; run the study again");
  const json& covariance = method.at("covariance");
  const Numbers of_covariance{path, covariance};
  fit.free_parameters = covariance.at("parameters").get<std::vector<std::string>>();
  fit.solution = of_covariance.vector("mean");
  const auto n = static_cast<Eigen::Index>(fit.free_parameters.size());
  fit.covariance = of_covariance.square("matrix", n);
  return fit;
}

}  // namespace

identification::IdentificationResult read_fit(const std::filesystem::path& folder,
                                              const identification::StudyData& data,
                                              const identification::EstimatorOptions& options) {
  const std::filesystem::path path = folder / "parameters.json";
  try {
    const json content = parse_json(recording::read_text_file(path));
    for (const json& method : content.at("methods")) {
      if (method.at("method") != "torque") continue;
      identification::IdentificationResult fit = fit_of(path, method);
      const identification::ParameterMap map(data, options);
      std::vector<std::string> labels;
      for (const identification::Unknown& unknown : map.free()) labels.push_back(unknown.label);
      if (labels != fit.free_parameters || fit.solution.size() != map.size())
        throw InvalidInput(fmt::format(
            "{} has {} unknowns, the study {} or others: its settings are not those of the run; run the study again",
            path.string(), fit.free_parameters.size(), labels.size()));
      fit.values = map.values(fit.solution);
      fit.delay_s = fit.values.channels.front()[identification::kDelay];
      return fit;
    }
  } catch (const json::exception& error) {
    throw ReadError(
        path, 0, fmt::format("is no result of a run of this version: {}; run the study again", json_error_text(error)));
  }
  throw InvalidInput(fmt::format("{} has no method torque; add it to method in [identify]", path.string()));
}

}  // namespace myoid
