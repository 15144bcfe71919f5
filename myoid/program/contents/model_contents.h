#pragma once

#include <cstdint>

#include <nlohmann/json.hpp>

#include "myoid/body/model/body_model.h"

namespace myoid::program {

/// Optional analyses of a model beside its contents.
struct ModelQuestions {
  bool compare_compat = false;  ///< Muscles whose exact paths differ from OpenSim's.
  bool jumps = false;           ///< Where a length or a moment arm jumps.
  int postures = 1000;          ///< Random ones, of the comparison.
  std::uint64_t seed = 1;       ///< Seed of the postures.
};

/// Describes a model for people and programs: bodies, joints, coordinates with range and unit,
/// muscles, markers, actuators, and unsupported parts.
[[nodiscard]] nlohmann::ordered_json model_contents(const body::BodyModel& model, const ModelQuestions& ask = {});

}  // namespace myoid::program
