#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/osim/osim_parts.h"

namespace myoid::body {
namespace {

/// A property of an object and the field for its value.
template <typename Object>
using Field = std::pair<const char*, double Object::*>;

constexpr Field<muscle::MillardActive> kActiveCurve[] = {
    {"min_norm_active_fiber_length", &muscle::MillardActive::shortest_length},
    {"transition_norm_fiber_length", &muscle::MillardActive::transition_length},
    {"max_norm_active_fiber_length", &muscle::MillardActive::longest_length},
    {"shallow_ascending_slope", &muscle::MillardActive::shallow_slope},
    {"minimum_value", &muscle::MillardActive::minimum}};

constexpr Field<muscle::MillardVelocity> kVelocityCurve[] = {
    {"concentric_slope_at_vmax", &muscle::MillardVelocity::slope_at_shortening_limit},
    {"concentric_slope_near_vmax", &muscle::MillardVelocity::slope_near_shortening_limit},
    {"isometric_slope", &muscle::MillardVelocity::slope_at_rest},
    {"eccentric_slope_at_vmax", &muscle::MillardVelocity::slope_at_lengthening_limit},
    {"eccentric_slope_near_vmax", &muscle::MillardVelocity::slope_near_lengthening_limit},
    {"max_eccentric_velocity_force_multiplier", &muscle::MillardVelocity::max_eccentric_multiplier},
    {"concentric_curviness", &muscle::MillardVelocity::concentric_curviness},
    {"eccentric_curviness", &muscle::MillardVelocity::eccentric_curviness}};

constexpr Field<MuscleProperties> kProperties[] = {
    {"max_contraction_velocity", &MuscleProperties::max_contraction_velocity},
    {"KshapeActive", &MuscleProperties::active_shape},
    {"KshapePassive", &MuscleProperties::passive_shape},
    {"FmaxTendonStrain", &MuscleProperties::max_tendon_strain},
    {"FmaxMuscleStrain", &MuscleProperties::max_muscle_strain},
    {"Af", &MuscleProperties::concentric_shape},
    {"Flen", &MuscleProperties::eccentric_plateau},
    {"fv_linear_extrap_threshold", &MuscleProperties::force_velocity_extrapolation},
    {"maximum_pennation_angle", &MuscleProperties::max_pennation_rad},
    {"activation_time_constant", &MuscleProperties::activation_time_s},
    {"deactivation_time_constant", &MuscleProperties::deactivation_time_s},
    {"minimum_activation", &MuscleProperties::minimum_activation},
    {"default_activation", &MuscleProperties::default_activation}};

/// A negative number stands for the value that the class computes.
MillardCurves millard_curves(const OsimReading& r, pugi::xml_node node) {
  MillardCurves c;
  const auto read = [&](const char* curve_name, auto& shape, const auto& fields) {
    const auto curve = r.xml.property(node, curve_name);
    for (const auto& [name, field] : fields) shape.*field = r.xml.number(curve, name, shape.*field);
  };
  read("ActiveForceLengthCurve", c.shape.active, kActiveCurve);
  read("ForceVelocityCurve", c.shape.velocity, kVelocityCurve);
  const auto given = [&](pugi::xml_node curve, const char* name, double& value) {
    if (const double number = r.xml.number(curve, name, -1.0); number >= 0.0) value = number;
  };
  const auto fiber = r.xml.property(node, "FiberForceLengthCurve");
  muscle::MillardPassive& passive = c.shape.passive;
  passive.strain_at_zero = r.xml.number(fiber, "strain_at_zero_force", passive.strain_at_zero);
  passive.strain_at_one = r.xml.number(fiber, "strain_at_one_norm_force", passive.strain_at_one);
  given(fiber, "stiffness_at_low_force", passive.stiffness_low);
  given(fiber, "curviness", passive.curviness);
  if (const double stiffness = r.xml.number(fiber, "stiffness_at_one_norm_force", -1.0); stiffness > 0.0)
    c.passive_stiffness_at_one = stiffness;
  const auto tendon = r.xml.property(node, "TendonForceLengthCurve");
  c.tendon_strain_at_one_force = r.xml.number(tendon, "strain_at_one_norm_force", c.tendon_strain_at_one_force);
  if (const double stiffness = r.xml.number(tendon, "stiffness_at_one_norm_force", -1.0); stiffness > 0.0)
    c.shape.tendon.stiffness_at_one = stiffness * c.tendon_strain_at_one_force;
  given(tendon, "norm_force_at_toe_end", c.shape.tendon.toe_force);
  given(tendon, "curviness", c.shape.tendon.curviness);
  c.fiber_damping = r.xml.number(node, "fiber_damping", 0.1);
  c.ignore_tendon_compliance = r.xml.flag(node, "ignore_tendon_compliance", false);
  c.ignore_activation_dynamics = r.xml.flag(node, "ignore_activation_dynamics", false);
  return c;
}

SchutteCurves schutte_curves(OsimReading& r, pugi::xml_node node) {
  SchutteCurves c;
  c.time_scale_s = r.xml.number(node, "time_scale", 0.1);
  c.activation1 = r.xml.number(node, "activation1", 7.667);
  c.activation2 = r.xml.number(node, "activation2", 1.459854);
  c.damping = r.xml.number(node, "damping", 0.05);
  const auto curve = [&](const char* name) { return function_property(r, node, name); };
  c.active_force_length = curve("active_force_length_curve");
  c.passive_force_length = curve("passive_force_length_curve");
  c.tendon_force_length = curve("tendon_force_length_curve");
  c.force_velocity = curve("force_velocity_curve");
  return c;
}

DeGrooteCurves de_groote_curves(const OsimReading& r, pugi::xml_node node) {
  DeGrooteCurves c;
  c.active_width_scale = r.xml.number(node, "active_force_width_scale", 1.0);
  c.fiber_damping = r.xml.number(node, "fiber_damping", 0.0);
  c.passive_fiber_strain_at_one_force = r.xml.number(node, "passive_fiber_strain_at_one_norm_force", 0.6);
  c.tendon_strain_at_one_force = r.xml.number(node, "tendon_strain_at_one_norm_force", 0.049);
  c.ignore_passive_fiber_force = r.xml.flag(node, "ignore_passive_fiber_force", false);
  c.ignore_tendon_compliance = r.xml.flag(node, "ignore_tendon_compliance", false);
  c.ignore_activation_dynamics = r.xml.flag(node, "ignore_activation_dynamics", false);
  c.tendon_dynamics_implicit = r.xml.word(node, "tendon_compliance_dynamics_mode") == "implicit";
  return c;
}

}  // namespace

void note_classes(BodyModel& model) {
  std::map<std::string, std::vector<std::string>> by_class;
  for (const Muscle& muscle : model.muscles)
    if (!muscle.class_name.starts_with("Thelen2003Muscle")) by_class[muscle.class_name].push_back(muscle.name);
  for (const auto& [name, muscles] : by_class) {
    const bool own = name.starts_with("Millard2012") || name.starts_with("DeGrooteFregly2016");
    constexpr std::size_t kNamed = 3;
    const std::vector<std::string> named(
        muscles.begin(), muscles.begin() + static_cast<std::ptrdiff_t>(std::min(kNamed, muscles.size())));
    model.notes.push_back(
        {.code = RemarkCode::reading,
         .severity = Severity::note,
         .says = fmt::format(
             "{} {} of class {} ({}{}): identification starts from the numbers that the class shares with Thelen's; {}",
             muscles.size(), muscles.size() == 1 ? "muscle is" : "muscles are", name, fmt::join(named, ", "),
             named.size() < muscles.size() ? ", ..." : "",
             own ? "so, run-tool and simulate use the class's own curves"
                 : "so, run-tool and simulate take Thelen's curves with their numbers")});
  }
}

bool is_muscle(pugi::xml_node node) {
  const std::string_view kind = node.name();
  return kind.ends_with("Muscle") || kind.ends_with("Muscle_Deprecated");
}

Muscle read_muscle(OsimReading& r, pugi::xml_node node) {
  Muscle muscle;
  muscle.name = OsimXml::name_of(node);
  muscle.class_name = node.name();
  if (muscle.name.empty()) r.xml.fail(node, "a muscle has no name");
  if (r.model.find_muscle(muscle.name)) r.xml.fail(node, "two muscles are named '{}'", muscle.name);
  muscle.applies_force = r.xml.flag(node, "appliesForce", true);
  const bool thelen = muscle.class_name.starts_with("Thelen2003Muscle");
  const bool de_groote = muscle.class_name.starts_with("DeGrooteFregly2016");
  const bool millard = muscle.class_name.starts_with("Millard2012");
  const bool schutte = muscle.class_name.starts_with("Schutte1993") || muscle.class_name.starts_with("Delp1990");
  MuscleProperties& p = muscle.properties;
  const auto set = [&](const char* name, double& value) {
    value = r.xml.number(node, name, value);
    if (!std::isfinite(value) && std::string_view(name) != "min_control" && std::string_view(name) != "max_control")
      r.xml.fail(node, "muscle '{}': <{}> is not finite", muscle.name, name);
  };
  if (!thelen) {
    p.activation_time_s = de_groote ? 0.015 : 0.01;
    p.deactivation_time_s = de_groote ? 0.06 : 0.04;
  }
  if (!thelen && !millard) p.control.least = 0.0;
  set("max_isometric_force", p.max_isometric_force_n);
  p.optimal_fiber_length_m = positive(r, node, "optimal_fiber_length", p.optimal_fiber_length_m);
  set("tendon_slack_length", p.tendon_slack_length_m);
  set("pennation_angle_at_optimal", p.pennation_at_optimal_rad);
  for (const auto& [name, field] : kProperties) set(name, p.*field);
  // OpenSim starts every muscle at its classes' default of 0.1 m.
  if (!r.compat.class_fiber_length) p.default_fiber_length_m = p.optimal_fiber_length_m;
  set("default_fiber_length", p.default_fiber_length_m);
  set("min_control", p.control.least);
  set("max_control", p.control.most);
  if (millard) {
    p.curves = millard_curves(r, node);
  } else if (schutte) {
    p.curves = schutte_curves(r, node);
  } else if (de_groote) {
    p.curves = de_groote_curves(r, node);
  }
  muscle.path = read_path(r, node);
  return muscle;
}

}  // namespace myoid::body
