#include "myoid/run/design/earlier_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/fit/intervals/estimate_columns.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/result_folder.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::run {

using fit::ParameterEstimate;

EarlierRun read_earlier_run(const std::filesystem::path& folder) {
  require_results(folder, "parameters.json");
  const std::filesystem::path file = folder / "parameters.json";
  try {
    const nlohmann::json all = parse_json(read_text_file(file));
    for (const nlohmann::json& method : all.at("methods")) {
      if (method.at("method") != "torque") continue;
      EarlierRun run;
      run.parameters = method.at("covariance").at("parameters").get<std::vector<std::string>>();
      const nlohmann::json& rows = method.at("covariance").at("matrix");
      const auto p = static_cast<Eigen::Index>(run.parameters.size());
      run.covariance.resize(p, p);
      run.estimate.setConstant(p, std::nan(""));
      for (Eigen::Index a = 0; a < p; ++a) {
        for (Eigen::Index b = 0; b < p; ++b)
          run.covariance(a, b) = rows.at(static_cast<std::size_t>(a)).at(static_cast<std::size_t>(b));
      }
      for (const nlohmann::json& e : method.at("estimates")) {
        const std::string label = e.at("muscle").get<std::string>() + "." + e.at("parameter").get<std::string>();
        if (auto row = fit::estimate_of_json(e)) run.estimates.push_back(std::move(*row));
        const auto it = std::ranges::find(run.parameters, label);
        if (it == run.parameters.end()) continue;
        run.estimate[it - run.parameters.begin()] = e.at("estimate").get<double>();
      }
      run.torque_sd_nm = method.at("torque_sd_nm");
      run.emg_cv = method.at("emg_cv");
      if (method.contains("model_error") && method.at("model_error").is_number())
        run.model_error = method.at("model_error");
      return run;
    }
  } catch (const nlohmann::json::exception& error) {
    throw ReadError(file, 0,
                    fmt::format("is not what `myoid run` writes ({}); run the study again", json_error_text(error)));
  }
  throw ReadError(file, 0, "holds no fit by method torque; run the study with method = \"torque\"");
}

EarlierRun earlier_run(const fit::IdentificationResult& fit) {
  EarlierRun run{
      .parameters = fit.free_parameters,
      .estimate = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(fit.free_parameters.size()), std::nan("")),
      .covariance = fit.covariance,
      .torque_sd_nm = fit.torque_sd_nm,
      .emg_cv = fit.emg_cv,
      .model_error = fit.model_error,
      .estimates = fit.estimates};
  for (const ParameterEstimate& e : fit.estimates) {
    const auto it = std::ranges::find(run.parameters, e.muscle + "." + e.parameter);
    if (it != run.parameters.end()) run.estimate[it - run.parameters.begin()] = e.estimate;
  }
  return run;
}

}  // namespace myoid::run
