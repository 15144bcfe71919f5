#include "myoid/fit/intervals/estimate_columns.h"

#include <array>
#include <limits>
#include <type_traits>

#include <nlohmann/json.hpp>

namespace myoid::fit {
namespace {

using enum EstimateColumn::Kind;
using E = ParameterEstimate;
constexpr std::array kColumns{
    EstimateColumn{"muscle", &E::muscle, key},
    EstimateColumn{"parameter", &E::parameter, key},
    EstimateColumn{"unit", &E::unit, key},
    EstimateColumn{"method", &E::method, key},
    EstimateColumn{"case", &E::fit_case, key},
    EstimateColumn{"initial", &E::initial},
    EstimateColumn{"estimate", &E::estimate},
    EstimateColumn{"std_error", &E::std_error},
    EstimateColumn{"ci_low", &E::ci_low},
    EstimateColumn{"ci_high", &E::ci_high},
    EstimateColumn{"given_estimate", &E::given_estimate},
    EstimateColumn{"given_ci_low", &E::given_ci_low},
    EstimateColumn{"given_ci_high", &E::given_ci_high},
    EstimateColumn{"prior_mean", &E::prior_mean},
    EstimateColumn{"prior_sd", &E::prior_sd},
    EstimateColumn{"prior_distance", &E::prior_distance, json},
    EstimateColumn{"shrinkage", &E::shrinkage},
    EstimateColumn{"at_bound", &E::at_bound},
    EstimateColumn{"verdict", &E::verdict, key},
    EstimateColumn{"reason", &E::reason, sentence},
};

void read(const nlohmann::json& cell, std::string& value) { value = cell.get<std::string>(); }

void read(const nlohmann::json& cell, std::optional<double>& value) {
  if (cell.is_number()) value = cell.get<double>();
}

void read(const nlohmann::json& cell, double& value) {
  value = cell.is_number() ? cell.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

void read(const nlohmann::json& cell, bool& value) { value = cell.get<bool>(); }

void read(const nlohmann::json& cell, Unit& value) {
  const auto text = cell.get<std::string>();
  for (int unit = 0; unit <= static_cast<int>(Unit::watt); ++unit) {
    if (symbol(static_cast<Unit>(unit)) == text) value = static_cast<Unit>(unit);
  }
}

template <typename Enumeration>
requires std::is_enum_v<Enumeration>
void read(const nlohmann::json& cell, Enumeration& value) {
  if (const auto named = choice_named<Enumeration>(cell.get<std::string>())) value = *named;
}

}  // namespace

std::span<const EstimateColumn> estimate_columns() { return kColumns; }

std::optional<ParameterEstimate> estimate_of_json(const nlohmann::json& row) {
  if (const auto estimate = row.find("estimate"); estimate == row.end() || !estimate->is_number()) return std::nullopt;
  ParameterEstimate e;
  for (const EstimateColumn& column : kColumns) {
    const auto cell = row.find(column.name);
    if (cell == row.end() && column.kind != key) continue;
    std::visit([&](const auto member) { read(row.at(std::string(column.name)), e.*member); }, column.member);
  }
  e.tied_to = row.value("tied_to", std::string());
  if (const auto shares = row.find("variance_shares"); shares != row.end()) {
    SourceShares& of = e.variance_shares.emplace();
    for (std::size_t s = 0; s < of.size(); ++s) of[s] = shares->at(std::string(kSourceColumns[s])).get<double>();
  }
  return e;
}

}  // namespace myoid::fit
