#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/identification/parameters.h"
#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"

namespace myoid::identification {

/// Collects disagreements between the routes to an interval, for a few lines at the end.
class RouteRemarks {
 public:
  /// Fills `routes_disagree`: one interval is more than 1.5 times as wide as another, by more than
  /// three times the spread that chance gives both (RouteInterval::spread; of a hundred pairs
  /// none), and wider than a tenth of the error allowed to an identified number.
  void compare(ParameterEstimate& estimate);

  /// One line for all that disagree of `count` numbers, which says whether the reported interval is
  /// the wider, and one for all open profiles.
  void add_to(std::vector<std::string>& warnings, std::size_t count) const;

 private:
  int disagree_ = 0;
  int beyond_ = 0;  ///< Of these, with a route wider than the reported interval.
  double worst_ = 0.0;
  std::string worst_text_;
  std::vector<std::string> open_;
};

/// The motion of a muscle while it is active (above 2 % of the greatest EMG) for a tenth of a
/// second in all, faster than a hundredth of v_max, where f_v differs from 1 by a few percent.
struct ActiveMotion {
  bool shortened = false, lengthened = false;
  /// From the shortest to the longest musculotendon length, each but for a tenth of a second [m].
  double length_span_m = 0.0;
};
/// Returns the active motion of every muscle in the calibration trials; activation acts `delay_s`
/// later.
[[nodiscard]] std::vector<ActiveMotion> active_motion(const StudyData& data, double delay_s);

/// The motion in which alone a muscle's number acts, if the muscle never made it while active
/// (VerdictContext::never): "lengthened", "shortened"; empty: nothing is missing. `by_ratio`: V_sh
/// acts in lengthening, too.
[[nodiscard]] std::string never_done(const Unknown& parameter,
                                     const ActiveMotion& motion,
                                     bool by_ratio);

/// The source of a number's prior, in words.
[[nodiscard]] std::string known_beforehand(const Unknown& parameter, bool from_mvc);

/// |z - prior mean| / prior sd, of the logarithm where the solver has that.
[[nodiscard]] double distance_from_prior(const Unknown& parameter, double z);

/// Returns one distance for each muscle that has free parameters with priors, at the numbers `z`.
[[nodiscard]] std::vector<PriorDistance> prior_distances(const std::vector<Unknown>& free,
                                                         const Eigen::VectorXd& z,
                                                         const StudyData& data);

/// A line for each muscle that is more than VerdictRules::prior_conflict away.
void add_distances_to(std::vector<std::string>& warnings,
                      const std::vector<PriorDistance>& distances);

/// Says in a sentence which lag of the EMG the fit chose (`shared_lag_gain`), and whether the
/// recording tells it from the other. Empty if the study set the lag.
[[nodiscard]] std::string lag_remark(const IdentificationResult& result);

/// The last `count` estimates are one unknown of several owners: they get one verdict, the worst
/// that any of them has, with its reason. Nothing is done to a number of one owner.
void agree_on_tied(std::vector<ParameterEstimate>& estimates, std::size_t count);

}  // namespace myoid::identification
