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
  /// Sets `routes_disagree` if one interval is more than 1.5 times as wide as another. The
  /// difference must also exceed three times the chance spread of both (RouteInterval::spread; no
  /// pair of a hundred does by chance) and a tenth of the error allowed to an identified number.
  void compare(ParameterEstimate& estimate);

  /// Adds one line for all disagreements among `count` numbers, which says whether the reported
  /// interval is the wider one, and one line for all open profiles.
  void add_to(std::vector<std::string>& warnings, std::size_t count) const;

 private:
  int disagree_ = 0;
  int beyond_ = 0;  ///< Disagreements in which a route is wider than the reported interval.
  double worst_ = 0.0;
  std::string worst_text_;
  std::vector<std::string> open_;
};

/// The motions of a muscle while it is active (above 2 % of the greatest EMG) for at least a tenth of a second in
/// total, faster than a hundredth of v_max, where f_v differs from 1 by a few percent.
struct ActiveMotion {
  bool shortened = false, lengthened = false;
  /// Range of musculotendon lengths, without a tenth of a second at either end [m].
  double length_span_m = 0.0;
};
/// Returns the active motion of every muscle in the calibration trials; activation acts `delay_s` later.
[[nodiscard]] std::vector<ActiveMotion> active_motion(const StudyData& data, double delay_s);

/// Returns the only motion in which a muscle's number acts, if the active muscle never made this
/// motion (VerdictContext::never): "lengthened", "shortened"; empty: no motion is missing.
/// `by_ratio`: V_sh acts in lengthening, too.
[[nodiscard]] std::string never_done(const Unknown& parameter, const ActiveMotion& motion, bool by_ratio);

/// Names the source of a number's prior in words.
[[nodiscard]] std::string known_beforehand(const Unknown& parameter, bool from_mvc);

/// Returns |z - prior mean| / prior sd, in the solver's scale.
[[nodiscard]] double distance_from_prior(const Unknown& parameter, double z);

/// Returns one distance for each muscle that has free parameters with priors, at the numbers `z`.
[[nodiscard]] std::vector<PriorDistance> prior_distances(const std::vector<Unknown>& free,
                                                         const Eigen::VectorXd& z,
                                                         const StudyData& data);

/// Adds a line for each muscle whose distance exceeds VerdictRules::prior_conflict.
void add_distances_to(std::vector<std::string>& warnings, const std::vector<PriorDistance>& distances);

/// States in a sentence which lag of the EMG the fit chose (`shared_lag_gain`), and whether the
/// recording separates it from the other. Empty if the study set the lag.
[[nodiscard]] std::string lag_remark(const IdentificationResult& result);

/// Gives the last `count` estimates, which are one unknown of several owners, the worst of their
/// verdicts with its reason. A number of one owner stays unchanged.
void agree_on_tied(std::vector<ParameterEstimate>& estimates, std::size_t count);

}  // namespace myoid::identification
