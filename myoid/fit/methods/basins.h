#pragma once

#include <functional>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/fit/methods/paper_case.h"
#include "myoid/ground/core/progress.h"
#include "myoid/ground/math/least_squares.h"

namespace myoid::fit {

/// The box of the searches' starts: two spreads of the priors to either side of the given start.
struct StartBox {
  Eigen::VectorXd given;
  Eigen::VectorXd spread;  ///< Spread of the prior; without a prior a tenth of the value.
  Eigen::VectorXd lower;   ///< Two spreads below the given start, inside the bounds.
  Eigen::VectorXd upper;
};
/// Returns the box of the source paper's unknowns, each in its own unit and within its physical bounds.
[[nodiscard]] StartBox start_box(const PaperCase& samples, const MuscleSetup& setup);

/// Returns the given start and Sobol points of the box.
[[nodiscard]] std::vector<Eigen::VectorXd> starts_in(const StartBox& box, int count);

/// Returns the root mean square of the unknowns' differences, in spreads.
[[nodiscard]] double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const StartBox& box);

/// The end of one local search.
struct LocalMinimum {
  math::Termination termination = math::Termination::no_descent;
  Eigen::VectorXd x;
  double cost = std::numeric_limits<double>::infinity();  ///< Infinite: the start is outside the domain.
  int evaluations = 0;
};

/// Descends from `start`. Called from several threads at once.
using LocalSearch = std::function<LocalMinimum(const Eigen::VectorXd& start)>;

/// Searches from the given start and Sobol points of the box, in parallel; the result does not depend on the number of
/// threads. Two ends are one basin if no unknown differs by more than 0.04 spreads. The cost has no weights: its
/// variance over `samples` residuals scales it to chi-square. Throws Interrupted.
[[nodiscard]] BasinTable find_basins(
    const LocalSearch& search, const StartBox& box, int starts, Eigen::Index samples, const Progress& progress = {});

/// Returns the minima of the source paper's published criterion for one muscle in one branch.
/// Empty if every number is held or the case is not fitted (PaperCase::obstacle).
[[nodiscard]] BasinTable find_paper_basins(const StudyData& data, std::size_t muscle, bool shortening, int starts);

}  // namespace myoid::fit
