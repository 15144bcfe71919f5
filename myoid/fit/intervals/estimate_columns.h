#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include <nlohmann/json_fwd.hpp>

#include "myoid/fit/intervals/result.h"

namespace myoid::fit {

/// A column of parameters.csv, and the key of the same number in parameters.json.
struct EstimateColumn {
  enum class Kind {
    key,       ///< Identifies the row's number; every row has it.
    value,     ///< In both files.
    json,      ///< In parameters.json only.
    sentence,  ///< In both files; quoted in parameters.csv.
  };
  using Member = std::variant<std::string ParameterEstimate::*,
                              double ParameterEstimate::*,
                              std::optional<double> ParameterEstimate::*,
                              bool ParameterEstimate::*,
                              Unit ParameterEstimate::*,
                              Method ParameterEstimate::*,
                              FitCase ParameterEstimate::*,
                              Verdict ParameterEstimate::*>;
  std::string_view name;
  Member member;
  Kind kind = Kind::value;
};

/// Returns the columns of every row, in the files' order. The intervals of the routes follow them.
[[nodiscard]] std::span<const EstimateColumn> estimate_columns();

/// Reads a row of parameters.json without the intervals of its routes. Empty if the estimate is not
/// a number. Throws nlohmann::json::exception if a key is missing.
[[nodiscard]] std::optional<ParameterEstimate> estimate_of_json(const nlohmann::json& row);

}  // namespace myoid::fit
