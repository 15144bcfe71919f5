#include "myoid/fit/beliefs/beliefs.h"

#include <algorithm>
#include <array>

namespace myoid::fit {

namespace beliefs {

constexpr std::array kAll = {&kMaxForce,         &kFiberLength,        &kWidth,           &kCurvature,
                             &kProduct,          &kSlopeRatio,         &kPlateau,         &kSpeed,
                             &kTendonSlack,      &kPennation,          &kPassiveForce,    &kPassiveStrain,
                             &kPassiveShape,     &kLengthActivation,   &kTendonStrain,    &kActivationShare,
                             &kEmgDelay,         &kEmgDelayBesideLags, &kEmgGain,         &kEmgShape,
                             &kEmgExponent,      &kExcitationTime,     &kActivationTime,  &kDeactivationTime,
                             &kStiffnessShare,   &kOffsetShare,        &kViscosityShare,  &kStiffness,
                             &kOffset,           &kViscosity,          &kInertia,         &kLeastEffort,
                             &kEmgNoise,         &kEmgBandwidth,       &kModelError,      &kRestingWeight,
                             &kRestingTissue,    &kTorqueNoise,        &kTorqueNoiseTime, &kTrialTorqueNoise,
                             &kStrength,         &kIndependentRows,    &kUnlikeness,      &kMomentArm,
                             &kMomentArmSlope,   &kTorqueScale,        &kTendonStretch,   &kCrossTalk,
                             &kGainDrift,        &kRiseAndFall,        &kVoluntaryEffort, &kUnknownEmgNoise,
                             &kFascicleError,    &kFascicleErrorTime,  &kFascicleScale,   &kFascicleOffset,
                             &kUnseenActivation, &kUnseenLevel,        &kSynergyWeight,   &kOwnActivation};

/// The muscle parameters whose prior lies about their starting value.
constexpr std::array kOfMuscles = {&kMaxForce, &kFiberLength, &kWidth, &kCurvature,
                                   &kProduct,  &kPlateau,     &kSpeed, &kTendonSlack};

}  // namespace beliefs

std::span<const Belief* const> all_beliefs() { return beliefs::kAll; }

std::optional<Prior> literature_prior(std::string_view parameter, double start, double optimal_fiber_length_m) {
  const auto found = std::find_if(beliefs::kOfMuscles.begin(), beliefs::kOfMuscles.end(),
                                  [&](const Belief* b) { return b->name == parameter; });
  if (found == beliefs::kOfMuscles.end()) return std::nullopt;
  const Belief& belief = **found;
  const double unit = belief.spread == SpreadOf::fiber_length ? optimal_fiber_length_m : 1.0;
  return Prior{.mean = start, .sd = belief.sd * unit, .logarithmic = belief.spread == SpreadOf::logarithm};
}

}  // namespace myoid::fit
