#pragma once

#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"

/// The greatest difference of one property over all parts of two models.
struct ModelDifference {
  std::string property;  ///< With its unit.
  double error = 0.0;
  double relative = 0.0;  ///< Of the greatest value of the property.
  std::string where;
};

/// Two models of the same parts, property by property. Joints are compared by where the bodies are
/// in 50 postures within the ranges, paths by their points, wrap objects and lengths in these.
std::vector<ModelDifference> compare_models(const myoid::body::BodyModel& ours, const myoid::body::BodyModel& theirs);
