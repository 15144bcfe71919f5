#include "myoid/methods/motion_alone.h"

#include <fmt/format.h>

#include "myoid/identification/told_by_motion.h"
#include "myoid/intervals/verdict_rules.h"

namespace myoid::identification {

void judge_motion_alone(const StudyData& data, IdentificationResult& result) {
  const std::optional<double> share = told_by_motion_alone(data);
  if (!share || *share < VerdictRules{}.motion_alone) return;
  result.warnings.push_back(
      fmt::format("angle, rate and acceleration alone tell {:.1f} % of the torque's variance: no fit can tell the "
                  "muscles from a spring and an inertia, and intervals may miss the truth. Record efforts against "
                  "several loads, or at held angles",
                  100.0 * *share));
  for (ParameterEstimate& e : result.estimates) {
    if (e.verdict != Verdict::identified) continue;
    e.verdict = Verdict::weak;
    e.reason = fmt::format("motion alone tells {:.1f} % of the torque", 100.0 * *share);
  }
}

}  // namespace myoid::identification
