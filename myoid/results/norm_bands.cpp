#include "myoid/results/norm_bands.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/page/typeset.h"

namespace myoid::results {
namespace {

bool belongs_to(const study::Norm& norm, const run::TrialResult& trial) {
  const bool part =
      std::ranges::any_of(trial.input.remarks, [](const Remark& r) { return r.code == RemarkCode::clock_pause; });
  const auto& named = norm.trials;
  return !part && (named.empty() || std::ranges::find(named, trial.spec.name) != named.end());
}

}  // namespace

void add_norms(const run::StudySource& source, const run::TrialResult& trial, page::WorkbenchTrial& shown) {
  if (!trial.has_motion()) return;
  const Eigen::VectorXd& t = trial.motion.joints.q.time_s();
  for (const study::Norm& norm : source.norms) {
    if (!belongs_to(norm, trial)) continue;
    const auto clock = static_cast<int>(shown.clocks.size());
    shown.clocks.emplace_back(t[0] + 0.01 * norm.percent.array() * (t[t.size() - 1] - t[0]));
    for (const study::NormCurve& curve : norm.curves) {
      for (page::TimePlot& plot : shown.plots) {
        if (plot.kind != (curve.torque ? "torque" : "angle") || plot.title != page::spelled(curve.coordinate)) continue;
        plot.lines.insert(plot.lines.begin(), {fmt::format("{}, mean ± 1 SD", norm.name), page::Role::norm, clock,
                                               curve.mean - curve.sd, curve.mean + curve.sd});
      }
    }
  }
}

}  // namespace myoid::results
