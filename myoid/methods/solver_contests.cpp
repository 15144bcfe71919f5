#include "myoid/methods/solver_contests.h"

#include <functional>
#include <utility>

#include <fmt/format.h>

#include "myoid/methods/force.h"

namespace myoid::identification {
namespace {

struct ContestedFit {
  std::string name;
  std::function<SolverContest(const ContestOptions&)> contest;
};

/// Returns the progress of part `index` of `count`.
Progress part_of(const Progress& whole, std::size_t index, std::size_t count) {
  Progress part = whole;
  if (!whole.report) return part;
  part.report = [report = whole.report, index, count](double share, std::string_view what) {
    report((static_cast<double>(index) + share) / static_cast<double>(count), what);
  };
  return part;
}

}  // namespace

std::vector<NamedContest> solver_contests(const StudyData& data,
                                          const std::string& method,
                                          const EstimatorOptions& estimator,
                                          const ContestOptions& options) {
  std::vector<ContestedFit> fits;
  if (method == "torque") {
    fits.push_back({"all muscles", [&](const ContestOptions& how) { return compare_solvers(data, estimator, how); }});
  }
  for (std::size_t k = 0; method != "torque" && k < data.muscles.size(); ++k) {
    const std::string& muscle = data.muscles[k].name;
    if (method == "force") {
      fits.push_back({muscle, [&, k](const ContestOptions& how) {
                        return compare_solvers(force_study(data, k), estimator, how);
                      }});
      continue;
    }
    for (const bool shortening : {true, false}) {
      fits.push_back(
          {muscle + (shortening ? " shortening" : " lengthening"),
           [&, k, shortening](const ContestOptions& how) { return compare_paper_solvers(data, k, shortening, how); }});
    }
  }
  std::vector<NamedContest> contests;
  for (const ContestedFit& fit : fits) {
    ContestOptions how = options;
    how.progress = part_of(options.progress, contests.size(), fits.size());
    contests.push_back({fit.name, fit.contest(how)});
  }
  return contests;
}

}  // namespace myoid::identification
