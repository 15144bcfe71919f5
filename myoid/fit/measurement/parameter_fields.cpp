#include "myoid/fit/measurement/parameter_fields.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/core/nearest_word.h"

namespace myoid::fit {
namespace {

constexpr muscle::Range within(double lower, double upper) { return {lower, upper}; }
constexpr muscle::Range hill_bounds(int field) { return muscle::kHillFields[static_cast<std::size_t>(field)].bounds; }

using enum Scope;
constexpr std::array kFields = {
    ParameterField{"max_isometric_force", muscle, kMaxForce, Unit::newton, true, hill_bounds(kMaxForce),
                   beliefs::kMaxForce.sd, "F_max"},
    ParameterField{"optimal_fiber_length", muscle, kFiberLength, Unit::meter, false, hill_bounds(kFiberLength), 0.0,
                   "l_m0"},
    ParameterField{"force_length_width", muscle, kWidth, Unit::meter, false, hill_bounds(kWidth), 0.0, "l_msh"},
    ParameterField{"concentric_curvature", muscle, kCurvature, Unit::dimensionless, true, hill_bounds(kCurvature),
                   beliefs::kCurvature.sd, "V_sh"},
    ParameterField{"eccentric_curvature_product", muscle, kProduct, Unit::dimensionless, true, hill_bounds(kProduct),
                   beliefs::kProduct.sd, "V_sh V_shl"},
    ParameterField{"eccentric_slope_ratio", muscle, kSlopeRatio, Unit::dimensionless, true, within(0.02, 100.0),
                   beliefs::kSlopeRatio.sd, "S, slope of f_v in lengthening over that in shortening"},
    ParameterField{"eccentric_plateau", muscle, kPlateau, Unit::dimensionless, false, hill_bounds(kPlateau),
                   beliefs::kPlateau.sd, "V_ml"},
    ParameterField{"max_shortening_speed", muscle, kSpeed, Unit::meter_per_second, true, hill_bounds(kSpeed),
                   beliefs::kSpeed.sd, "v_max"},
    ParameterField{"tendon_slack_length", muscle, kSlack, Unit::meter, false, hill_bounds(kSlack), 0.0, "l_t0"},
    ParameterField{"pennation_angle", muscle, kPennation, Unit::radian, false, within(0.0, 1.0), beliefs::kPennation.sd,
                   "at the optimal fiber length", true},
    ParameterField{"passive_force", muscle, kPassiveForce, Unit::dimensionless, false, within(0.0, 3.0),
                   beliefs::kPassiveForce.sd, "of the stretched fiber at passive_strain, over F_max; 0: none", true},
    ParameterField{"passive_strain", muscle, kPassiveStrain, Unit::dimensionless, true, within(0.1, 2.0),
                   beliefs::kPassiveStrain.sd, "strain of the fiber at which passive_force is reached"},
    ParameterField{"passive_shape", muscle, kPassiveShape, Unit::dimensionless, true, within(0.5, 10.0),
                   beliefs::kPassiveShape.sd, "exponent of the passive force"},
    ParameterField{"length_activation", muscle, kLengthActivation, Unit::dimensionless, false, within(0.0, 0.5),
                   beliefs::kLengthActivation.sd, "gamma: optimal length l_m0 (1 + gamma (1 - a))", true},
    ParameterField{"tendon_strain", muscle, kTendonStrain, Unit::dimensionless, true, within(0.005, 0.2),
                   beliefs::kTendonStrain.sd, "of the tendon at F_max; 0: rigid"},
    ParameterField{"activation_share", muscle, kShare, Unit::dimensionless, true, within(0.1, 10.0),
                   beliefs::kActivationShare.sd, "activation of a muscle over that of the electrode that serves it"},
    ParameterField{"emg_delay", channel, kDelay, Unit::second, false, within(0.0, 0.15), beliefs::kEmgDelay.sd, "d"},
    ParameterField{"emg_gain", channel, kGain, Unit::dimensionless, true, within(0.2, 5.0), beliefs::kEmgGain.sd, "g"},
    ParameterField{"emg_shape", channel, kShape, Unit::dimensionless, false, within(-3.0, 3.0), beliefs::kEmgShape.sd,
                   "A of (exp(A u) - 1) / (exp(A) - 1); 0: linear", true},
    ParameterField{"emg_exponent", channel, kExponent, Unit::dimensionless, true, within(0.5, 2.5),
                   beliefs::kEmgExponent.sd, "p of activation = gain envelope^p; 1: proportional"},
    ParameterField{"excitation_time", channel, kExcitationTime, Unit::second, true, within(0.001, 0.2),
                   beliefs::kExcitationTime.sd, "tau_ne of equation (1)"},
    ParameterField{"activation_time", channel, kActivationTime, Unit::second, true, within(0.001, 0.2),
                   beliefs::kActivationTime.sd, "tau_ac of equation (1)"},
    ParameterField{"deactivation_time", channel, kDeactivationTime, Unit::second, true, within(0.001, 0.4),
                   beliefs::kDeactivationTime.sd, "tau_deac of equation (1)"},
    ParameterField{"joint_viscosity", joint, kViscosity, Unit::newton_meter_second, false, within(0.0, 5.0),
                   beliefs::kViscosity.sd, "B_l", true},
    ParameterField{"joint_inertia", joint, kInertia, Unit::kilogram_meter2, false, within(-0.5, 0.5),
                   beliefs::kInertia.sd, "what inverse dynamics left out", true},
    ParameterField{"joint_stiffness", joint, kStiffness, Unit::newton_meter, false, within(-5.0, 50.0),
                   beliefs::kStiffness.sd, "per radian", true},
    ParameterField{"joint_torque_offset", joint, kOffset, Unit::newton_meter, false, within(-20.0, 20.0),
                   beliefs::kOffset.sd, "constant torque beside the muscles'", true},
};

}  // namespace

double& ModelValues::number(Scope scope, int owner, int field) {
  const auto k = static_cast<std::size_t>(owner), f = static_cast<std::size_t>(field);
  return scope == muscle ? muscles[k][f] : scope == channel ? channels[k][f] : joints[k][f];
}

std::span<const ParameterField> parameter_fields() { return kFields; }

bool zero_by_nature(std::string_view parameter) {
  return std::any_of(kFields.begin(), kFields.end(),
                     [&](const ParameterField& field) { return field.zero_by_nature && field.name == parameter; });
}

bool is_lag(std::string_view parameter) {
  return std::any_of(kFields.begin(), kFields.end(), [&](const ParameterField& field) {
    return field.scope == Scope::channel && field.name == parameter &&
           (field.field == kExcitationTime || field.field == kActivationTime || field.field == kDeactivationTime);
  });
}

const ParameterField& parameter_field(std::string_view name) {
  for (const ParameterField& field : kFields) {
    if (field.name == name) return field;
  }
  throw InvalidInput(
      fmt::format("no parameter is named '{}'{}", name, not_among(name, kFields, &ParameterField::name)));
}

}  // namespace myoid::fit
