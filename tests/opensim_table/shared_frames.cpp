#include "shared_frames.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/recording/tables/storage_reader.h"

namespace myoid::opensim_table {

void compare_sharing(const SharedFrames& shared, const std::filesystem::path& reference, const Rows& rows) {
  const TimeSeries theirs = recording::read_storage(reference).data;
  double residual_ours = 0.0, residual_theirs = 0.0, excess = -INFINITY, priced = -INFINITY;
  int residual_above = 0, cost_above = 0, priced_above = 0, count = 0;
  for (const auto& [i, frame] : shared.frames) {
    const auto& [problem, solution] = frame;
    if (i >= theirs.sample_count() || problem.forces.cols() != theirs.channel_count()) return;
    const Eigen::VectorXd x = theirs.values().row(i).transpose();
    const auto cost = [&](const Eigen::VectorXd& control) {
      return control.cwiseAbs().array().pow(problem.exponent).sum();
    };
    const Eigen::VectorXd gap = problem.required - problem.forces * x;
    const double mine = (problem.required - problem.forces * solution.control).cwiseAbs().maxCoeff();
    const double other = gap.cwiseAbs().maxCoeff();
    residual_ours = std::max(residual_ours, mine);
    residual_theirs = std::max(residual_theirs, other);
    const double above = cost(solution.control) / cost(x) - 1.0;
    const double charged = cost(solution.control) / (cost(x) + solution.multiplier.dot(gap)) - 1.0;
    excess = std::max(excess, above);
    priced = std::max(priced, charged);
    residual_above += mine > other ? 1 : 0;
    cost_above += above > 1e-9 ? 1 : 0;
    priced_above += charged > 1e-9 ? 1 : 0;
    ++count;
  }
  if (count == 0) return;
  const auto frames = [&](int above) { return fmt::format("above in {} of {} frames", above, count); };
  rows.add("constraint residual", fmt::format("{:.1e}, OpenSim's {:.1e} N m, N", residual_ours, residual_theirs),
           frames(residual_above));
  rows.add("cost, ours above theirs", fmt::format("{:.1e}", excess), frames(cost_above));
  rows.add("the same, their residual charged", fmt::format("{:.1e}", priced), frames(priced_above));
}

}  // namespace myoid::opensim_table
