#include "myoid/cli/solver_contests.h"

#include <functional>
#include <utility>

#include <fmt/format.h>

#include "myoid/files/text_file.h"
#include "myoid/methods/force.h"

namespace myoid::cli {
namespace {

using identification::ContestOptions;
using identification::SolverContest;

struct Fit {
  std::string name;
  std::function<SolverContest(const ContestOptions&)> contest;
};

/// What is told of part `index` of `count`.
Progress part_of(const Progress& whole, std::size_t index, std::size_t count) {
  Progress part = whole;
  if (!whole.report) return part;
  part.report = [report = whole.report, index, count](double share, std::string_view what) {
    report((static_cast<double>(index) + share) / static_cast<double>(count), what);
  };
  return part;
}

}  // namespace

std::vector<NamedContest> solver_contests(const identification::StudyData& data,
                                          const std::string& method,
                                          const identification::EstimatorOptions& estimator,
                                          const ContestOptions& options) {
  std::vector<Fit> fits;
  if (method == "torque") {
    fits.push_back({"all muscles", [&](const ContestOptions& how) {
                      return identification::compare_solvers(data, estimator, how);
                    }});
  }
  for (std::size_t k = 0; method != "torque" && k < data.muscles.size(); ++k) {
    const std::string& muscle = data.muscles[k].name;
    if (method == "force") {
      fits.push_back({muscle, [&, k](const ContestOptions& how) {
                        return identification::compare_solvers(identification::force_study(data, k),
                                                               estimator, how);
                      }});
      continue;
    }
    for (const bool shortening : {true, false}) {
      fits.push_back({muscle + (shortening ? " shortening" : " lengthening"),
                      [&, k, shortening](const ContestOptions& how) {
                        return identification::compare_paper_solvers(data, k, shortening, how);
                      }});
    }
  }
  std::vector<NamedContest> contests;
  for (const Fit& fit : fits) {
    ContestOptions how = options;
    how.progress = part_of(options.progress, contests.size(), fits.size());
    contests.push_back({fit.name, fit.contest(how)});
  }
  return contests;
}

void print_contest(const NamedContest& named) {
  const SolverContest& c = named.contest;
  if (c.runs.empty()) {
    fmt::print("\nSolvers, {}: nothing to fit\n", named.fit);
    return;
  }
  fmt::print("\nSolvers, {}:\n{:<22}{:>6}{:>16}{:>12}{:>13}{:>10}  {}\n", named.fit, "solver",
             "start", "cost", "distance", "evaluations", "seconds", "ended");
  for (const identification::SolverRun& run : c.runs) {
    fmt::print("{:<22}{:>6}{:>16.6g}{:>12.2g}{:>13}{:>10.3f}  {}\n", run.solver, run.start,
               run.cost, run.distance, run.evaluations, run.seconds, math::name(run.termination));
  }
  fmt::print("Levenberg-Marquardt:\n");
  print_basins(c.basins);
}

void print_basins(const identification::BasinTable& table) {
  constexpr std::size_t kMost = 8;
  fmt::print("{:<22}{:>12}{:>16}{:>12}\n", fmt::format("  basin of {} starts", table.starts),
             "starts", "cost", "distance");
  for (std::size_t i = 0; i < table.basins.size() && i < kMost; ++i) {
    const identification::BasinRow& basin = table.basins[i];
    fmt::print("  {:<20}{:>12}{:>16.6g}{:>12.2g}{}{}\n", i + 1, basin.starts, basin.cost,
               basin.distance,
               basin.converged < basin.starts
                   ? fmt::format("  {} did not converge", basin.starts - basin.converged)
                   : "",
               basin.rival && i > 0 ? "  as good as the best: both are answers" : "");
  }
  if (table.basins.size() > kMost) fmt::print("  and {} more\n", table.basins.size() - kMost);
  if (table.failed > 0) fmt::print("  {:<20}{:>12}\n", "no minimum", table.failed);
}

std::string solvers_csv(const std::vector<NamedContest>& contests) {
  const auto number = [](double value) { return recording::format_number(value); };
  std::string text = "fit,solver,start,cost,distance,evaluations,seconds,termination\n";
  for (const auto& [fit, c] : contests) {
    for (const identification::SolverRun& run : c.runs) {
      text += fmt::format("{},{},{},{},{},{},{},{}\n", fit, run.solver, run.start, number(run.cost),
                          number(run.distance), run.evaluations, number(run.seconds),
                          math::name(run.termination));
    }
  }
  return text;
}

}  // namespace myoid::cli
