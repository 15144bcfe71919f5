#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "myoid/fit/measurement/muscle_law.h"
#include "myoid/ground/core/units.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::fit {

/// The kind of owner of a parameter.
enum class Scope { muscle, channel, joint };

/// Index of the unknown of the force-velocity relation from which V_sh V_shl follows; no MuscleValues entry.
inline constexpr int kSlopeRatio = kMuscleFieldCount;

/// Indices of an EMG channel's numbers.
enum ChannelField : int {
  kDelay,
  kGain,
  kShape,  ///< A of (exp(A u) - 1) / (exp(A) - 1); 0: linear.
  kExcitationTime,
  kActivationTime,
  kDeactivationTime,
  kExponent,  ///< p of activation = gain envelope^p; 1: proportional.
  kChannelFieldCount
};
using ChannelValues = std::array<double, kChannelFieldCount>;

/// Indices of the numbers of a joint's own torque, which is subtracted from the muscles' torque:
///   T = sum r F - viscosity qdot - inertia qddot - stiffness q + offset
enum JointField : int { kViscosity, kInertia, kStiffness, kOffset, kJointFieldCount };
using JointValues = std::array<double, kJointFieldCount>;

/// A number that can be identified, with name, unit and bounds. `parameter_fields` returns the table of all numbers.
struct ParameterField {
  std::string_view name;
  Scope scope = Scope::muscle;
  int field = 0;
  Unit unit = Unit::dimensionless;
  bool logarithmic = false;  ///< The solver sees ln(value).
  muscle::Range bounds;
  /// Spread of the usual prior about the start: of ln(value) if logarithmic; 0: none.
  double prior_sd = 0.0;
  std::string_view meaning;
  /// Most people's value is near 0, so an error relative to the value says little.
  bool zero_by_nature = false;
};
[[nodiscard]] std::span<const ParameterField> parameter_fields();
/// Returns the row of this name; throws InvalidInput with the list of names if there is none.
[[nodiscard]] const ParameterField& parameter_field(std::string_view name);

/// Returns ParameterField::zero_by_nature of this name; false for an unknown name.
[[nodiscard]] bool zero_by_nature(std::string_view parameter);

/// Returns true for a time constant of equation (1), which acts only with `dynamics`.
[[nodiscard]] bool is_lag(std::string_view parameter);

/// All numbers of the model.
struct ModelValues {
  std::vector<MuscleValues> muscles;
  std::vector<ChannelValues> channels;
  std::vector<JointValues> joints;

  [[nodiscard]] double& number(Scope scope, int owner, int field);
};

}  // namespace myoid::fit
