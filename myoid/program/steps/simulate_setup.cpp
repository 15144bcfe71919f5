#include "myoid/program/steps/simulate_setup.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/simulation/excitation.h"
#include "myoid/body/simulation/sensitivity.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/program/steps/stage_input.h"
#include "myoid/recording/tables/storage_reader.h"

namespace myoid::program {
namespace {

/// Splits "NAME=NUMBER" of an option.
std::pair<std::string, double> assignment(const std::string& text, std::string_view option) {
  const std::size_t at = text.find('=');
  const auto number = at == std::string::npos ? std::nullopt : parse_number(text.substr(at + 1));
  if (at == 0 || !number || !std::isfinite(*number))
    throw InvalidInput(fmt::format("{} '{}': expected NAME=NUMBER", option, text));
  return {text.substr(0, at), *number};
}

std::size_t index_of(const std::string& name,
                     const std::vector<NamedCoordinate>& coordinates,
                     std::string_view option) {
  const auto found = std::ranges::find(coordinates, name, &NamedCoordinate::name);
  if (found != coordinates.end()) return static_cast<std::size_t>(found - coordinates.begin());
  throw InvalidInput(fmt::format("{} {}: the model has no such coordinate{}", option, name,
                                 not_among(name, coordinates, &NamedCoordinate::name)));
}

}  // namespace

Drive read_drive(const SimulateOptions& o, const std::vector<std::string>& muscles, Remarks& remarks) {
  Drive drive;
  drive.start_s = o.call.start_s.value_or(0.0);
  drive.end_s = o.call.end_s.value_or(drive.start_s + 1.0);
  if (o.excitations.empty()) {
    drive.excitation = body::described_excitations(o.excite, o.rest, muscles);
    return drive;
  }
  const recording::Storage file = recording::read_storage(o.excitations);
  warn_of_repairs(o.excitations, file.repairs, remarks);
  try {
    drive.excitation = body::excitations_from(file.data, muscles);
  } catch (const ReadError&) {
    throw;
  } catch (const InvalidInput& error) {
    throw ReadError(o.excitations, 0, error.what());
  }
  drive.start_s = o.call.start_s.value_or(file.data.time_s()[0]);
  drive.end_s = o.call.end_s.value_or(file.data.time_s()[file.data.sample_count() - 1]);
  return drive;
}

void place(const SimulateOptions& o,
           const std::vector<NamedCoordinate>& coordinates,
           body::SimulationStart& start,
           std::vector<body::Device>& devices) {
  start.qdot.resize(coordinates.size(), 0.0);
  const auto assign = [&](const std::vector<std::string>& texts, std::string_view option, std::vector<double>& values) {
    for (const std::string& text : texts) {
      const auto [name, value] = assignment(text, option);
      const std::size_t k = index_of(name, coordinates, option);
      values[k] = coordinates[k].turns ? value * kDegree : value;
    }
  };
  assign(o.initial, "--initial", start.q);
  assign(o.initial_speed, "--initial-speed", start.qdot);
  for (const std::string& name : o.lock) devices[index_of(name, coordinates, "--lock")] = body::locked();
}

void refuse_followers(const SimulateOptions& o, const body::BodyModel& body) {
  for (const body::CoordinateCoupler& c : body.couplers) {
    const std::string& name = body.coordinates[static_cast<std::size_t>(c.dependent)].name;
    for (const auto* list : {&o.initial, &o.initial_speed}) {
      for (const std::string& text : *list) {
        if (!text.starts_with(name + "=")) continue;
        throw InvalidInput(fmt::format("{}: the coordinate follows '{}' (coupler '{}'); place that", text,
                                       body.coordinates[static_cast<std::size_t>(c.independent)].name, c.name));
      }
    }
  }
}

std::vector<std::string> wanted_parameters(const SimulateOptions& o, const body::SimulationModel& model) {
  const std::vector<std::string> all = body::sensitivity_names(model);
  std::vector<std::string> result;
  for (const std::string& text : o.sensitivity) {
    const std::string head = text.ends_with('*') ? text.substr(0, text.size() - 1) : text;
    bool found = false;
    for (const std::string& name : all) {
      if (text.ends_with('*') ? !name.starts_with(head) : name != text) continue;
      found = true;
      if (std::ranges::find(result, name) == result.end()) result.push_back(name);
    }
    if (!found) {
      throw InvalidInput(fmt::format("--sensitivity {}: no such parameter{}", text, not_among(text, all)));
    }
  }
  return result;
}

}  // namespace myoid::program
