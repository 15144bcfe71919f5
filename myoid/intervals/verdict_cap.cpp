#include "myoid/intervals/verdict_cap.h"

#include <algorithm>

namespace myoid::identification {
namespace {

bool names(const std::vector<std::string>& list, const std::string& name) {
  return list.empty() || std::ranges::find(list, name) != list.end();
}

}  // namespace

void apply(const std::vector<VerdictCap>& caps, IdentificationResult& result) {
  for (ParameterEstimate& e : result.estimates) {
    if (e.verdict != Verdict::identified && e.verdict != Verdict::reproducible) continue;
    const auto cap = std::ranges::find_if(caps, [&](const VerdictCap& c) {
      return names(c.methods, result.method) && names(c.owners, e.muscle) && names(c.parameters, e.parameter);
    });
    if (cap == caps.end()) continue;
    e.verdict = Verdict::weak;
    e.reason = cap->reason;
  }
}

}  // namespace myoid::identification
