#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/identification/parameters.h"
#include "myoid/identification/result.h"
#include "myoid/identification/study_data.h"

namespace myoid::identification {

/// What the routes to an interval disagree on, for few lines at the end.
class RouteRemarks {
 public:
  /// Fills `routes_disagree`: one interval is more than 1.5 times as wide as another.
  void compare(ParameterEstimate& estimate);

  /// One line for all that disagree of `count` numbers, and one for all open profiles.
  void add_to(std::vector<std::string>& warnings, std::size_t count) const;

 private:
  int disagree_ = 0;
  double worst_ = 0.0;
  std::string worst_text_;
  std::vector<std::string> open_;
};

/// |z - prior mean| / prior sd, of the logarithm where the solver has that.
[[nodiscard]] double distance_from_prior(const FreeParameter& parameter, double z);

/// Of each muscle that has free parameters of its own with priors, at the solver's numbers `z`.
[[nodiscard]] std::vector<PriorDistance> prior_distances(const std::vector<FreeParameter>& free,
                                                         const Eigen::VectorXd& z,
                                                         const StudyData& data);

/// A line for each muscle that is more than VerdictRules::prior_conflict away.
void add_distances_to(std::vector<std::string>& warnings,
                      const std::vector<PriorDistance>& distances);

/// The last `count` estimates are one unknown of several owners: they get one verdict, the worst
/// that any of them has, with its reason. Nothing is done to a number of one owner.
void agree_on_tied(std::vector<ParameterEstimate>& estimates, std::size_t count);

}  // namespace myoid::identification
