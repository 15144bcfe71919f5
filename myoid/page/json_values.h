#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/json_array.h"
#include "myoid/ground/core/provenance.h"

namespace myoid::page {

/// Returns a number as JSON; null where it is absent or not finite, which JSON cannot write.
[[nodiscard]] nlohmann::ordered_json number_or_null(const std::optional<double>& value);

/// Returns an array of the rows of a matrix.
[[nodiscard]] nlohmann::ordered_json matrix_json(const Eigen::MatrixXd& matrix);

/// Returns numbers in steps (packing.h), with the ends of their range.
[[nodiscard]] nlohmann::ordered_json packed_json(const Eigen::Ref<const Eigen::VectorXd>& values);

/// Returns an even clock as start, step and count, any other as 32-bit numbers.
[[nodiscard]] nlohmann::ordered_json clock_json(const Eigen::VectorXd& time_s);

/// Returns program, version, command, inputs with their SHA-256, and options.
[[nodiscard]] nlohmann::ordered_json provenance_json(const Provenance& provenance);

/// Returns JSON that may stand inside a <script> element: '<' is written as an escape.
[[nodiscard]] std::string embedded(const nlohmann::ordered_json& json);

}  // namespace myoid::page
