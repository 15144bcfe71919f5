#include "myoid/fit/beliefs/beliefs.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

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
                             &kRestingTissue,    &kStrengthRatio,      &kTorqueNoise,     &kTorqueNoiseTime,
                             &kTrialTorqueNoise, &kStrength,           &kIndependentRows, &kUnlikeness,
                             &kMomentArm,        &kMomentArmSlope,     &kTorqueScale,     &kTendonStretch,
                             &kCrossTalk,        &kGainDrift,          &kRiseAndFall,     &kVoluntaryEffort,
                             &kUnknownEmgNoise};

/// The muscle parameters whose prior lies about their starting value.
constexpr std::array kOfMuscles = {&kMaxForce, &kFiberLength, &kWidth, &kCurvature,
                                   &kProduct,  &kPlateau,     &kSpeed, &kTendonSlack};

}  // namespace beliefs

namespace {

std::string spread_text(const Belief& belief) {
  if (belief.sd == 0.0) return "–";
  switch (belief.spread) {
    case SpreadOf::logarithm:
      return fmt::format("ln {:g}", belief.sd);
    case SpreadOf::fiber_length:
      return fmt::format("{:g} l_m⁰", belief.sd);
    case SpreadOf::joint_strength:
      return fmt::format("{:g} % of the joint's strength", 100.0 * belief.sd);
    case SpreadOf::value:
      break;
  }
  return fmt::format("{:g}", belief.sd);
}

}  // namespace

std::span<const Belief* const> all_beliefs() { return beliefs::kAll; }

std::optional<Prior> literature_prior(std::string_view parameter, double start, double optimal_fiber_length_m) {
  const auto found = std::find_if(beliefs::kOfMuscles.begin(), beliefs::kOfMuscles.end(),
                                  [&](const Belief* b) { return b->name == parameter; });
  if (found == beliefs::kOfMuscles.end()) return std::nullopt;
  const Belief& belief = **found;
  const double unit = belief.spread == SpreadOf::fiber_length ? optimal_fiber_length_m : 1.0;
  return Prior{.mean = start, .sd = belief.sd * unit, .logarithmic = belief.spread == SpreadOf::logarithm};
}

std::string beliefs_markdown() {
  std::string text = "| quantity | expected | spread | unit | used | source |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const Belief* belief : beliefs::kAll) {
    const bool parameter = belief->name.find(' ') == std::string_view::npos;
    text += fmt::format("| {}{}{} | {} | {} | {} | {} | {} |\n", parameter ? "`" : "", belief->name,
                        parameter ? "`" : "", belief->mean.empty() ? fmt::format("{:g}", belief->value) : belief->mean,
                        spread_text(*belief), belief->unit.empty() ? "–" : belief->unit, belief->when, belief->source);
  }
  return text;
}

}  // namespace myoid::fit
