#include "myoid/intervals/verdict_cap.h"

#include <algorithm>

namespace myoid::identification {
namespace {

bool names(const std::vector<std::string>& list, const std::string& name) {
  return list.empty() || std::ranges::find(list, name) != list.end();
}

/// Returns the number's owners: of a joint's torque the muscles that make it, too.
std::vector<std::string> owners_of(const ParameterEstimate& e, const IdentificationResult& result) {
  std::vector<std::string> owners{e.muscle};
  for (const VoluntaryCurve& curve : result.voluntary) {
    if (curve.of_joint && curve.owner == e.muscle && e.parameter.ends_with(curve.ending))
      owners.insert(owners.end(), curve.muscles.begin(), curve.muscles.end());
  }
  return owners;
}

/// Returns true if the cap is of this parameter. What is wrong with a strength is wrong with the torque that it makes.
bool is_of(const VerdictCap& cap, const std::string& parameter) {
  const bool follows = is_voluntary(parameter) && !is_voluntary_angle(parameter);
  return names(cap.parameters, parameter) || (follows && names(cap.parameters, "max_isometric_force"));
}

}  // namespace

void apply(const std::vector<VerdictCap>& caps, IdentificationResult& result) {
  for (ParameterEstimate& e : result.estimates) {
    const std::vector<std::string> owners = owners_of(e, result);
    const auto cap = std::ranges::find_if(caps, [&](const VerdictCap& c) {
      return severity(e.verdict) < severity(c.at_most) && names(c.methods, result.method) && is_of(c, e.parameter) &&
             std::ranges::any_of(owners, [&](const std::string& owner) { return names(c.owners, owner); });
    });
    if (cap == caps.end()) continue;
    e.verdict = cap->at_most;
    e.reason = cap->reason;
  }
}

}  // namespace myoid::identification
