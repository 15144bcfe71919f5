#include "myoid/page/parameter_words.h"

#include <array>
#include <utility>

namespace myoid::page {
namespace {

constexpr auto kMeanings = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"voluntary_torque_angle", "The joint's angle at which this torque is greatest."},
    {"voluntary_torque", "The greatest steady torque of the muscle alone at the effort of the maximal contraction."},
    {"voluntary_power", "The greatest power at that effort while the joint turns at the named speed."},
    {"max_isometric_force", "The force at full activation and optimal length, without movement."},
    {"optimal_fiber_length", "The length of the fibers at which the muscle is strongest."},
    {"force_length_width", "At this distance from the optimal length the force is down to 37 %."},
    {"concentric_curvature", "The smaller, the sooner the force falls as the muscle shortens faster."},
    {"eccentric_curvature_product", "The smaller, the sooner the force rises as the muscle is stretched faster."},
    {"eccentric_slope_ratio", "How steeply the force rises in stretching, over how steeply it falls in shortening."},
    {"eccentric_plateau", "The force in fast stretching over the force without movement."},
    {"max_shortening_speed", "The speed of the fibers at which no force is left."},
    {"tendon_slack_length", "The length from which on the tendon carries force."},
    {"pennation_angle", "The angle between fibers and tendon at the optimal length."},
    {"passive_force", "The force of the stretched muscle without activation, over its greatest active one."},
    {"passive_strain", "The stretch of the fibers at which the passive force is reached."},
    {"passive_shape", "How suddenly the passive force sets in."},
    {"length_activation", "By this share the optimal length is longer at low activation than at full activation."},
    {"tendon_strain", "The stretch of the tendon at the greatest force, over its length."},
    {"activation_share", "The activation of the muscle over that of the electrode that serves it."},
    {"emg_delay", "The time from the EMG to the force."},
    {"emg_gain", "The activation over the envelope of the EMG."},
    {"emg_shape", "How bent the activation is over the envelope; 0 is a straight line."},
    {"emg_exponent", "The power of the envelope to which the activation is proportional."},
    {"excitation_time", "The delay of the nerve's signal."},
    {"activation_time", "The time in which the activation rises."},
    {"deactivation_time", "The time in which the activation falls."},
    {"joint_viscosity", "The joint's own torque against its speed."},
    {"joint_inertia", "The inertia that the model of the body lacks."},
    {"joint_stiffness", "The joint's own torque against its angle."},
    {"joint_torque_offset", "A constant torque beside that of the muscles."},
});

}  // namespace

std::string_view parameter_meaning(std::string_view parameter) {
  for (const auto& [name, meaning] : kMeanings) {
    if (parameter == name || (parameter.starts_with(name) && parameter[name.size()] == '_')) return meaning;
  }
  return "";
}

}  // namespace myoid::page
