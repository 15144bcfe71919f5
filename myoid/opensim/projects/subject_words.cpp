#include "myoid/opensim/projects/subject_words.h"

#include <numbers>

namespace myoid::opensim {
namespace {

using Quantity = MuscleQuantity;

const SubjectWords& ceinms_words() {
  static const SubjectWords kWords{.dialect = Dialect::ceinms,
                                   .defaults = "mtuDefault",
                                   .curve = "curve",
                                   .muscles = "mtuSet",
                                   .muscle = "mtu",
                                   .dofs = "dofSet",
                                   .dof = "dof",
                                   .dof_muscles = "mtuNameSet",
                                   .numbers = {{"emDelay", Quantity::delay},
                                               {"c1", Quantity::c1},
                                               {"c2", Quantity::c2},
                                               {"shapeFactor", Quantity::shape_factor},
                                               {"activationScale", Quantity::activation_scale},
                                               {"optimalFibreLength", Quantity::optimal_fiber_length, true},
                                               {"pennationAngle", Quantity::pennation_angle},
                                               {"tendonSlackLength", Quantity::tendon_slack_length, true},
                                               {"maxContractionVelocity", Quantity::max_contraction_velocity},
                                               {"maxIsometricForce", Quantity::max_isometric_force, true},
                                               {"strengthCoefficient", Quantity::strength_coefficient}},
                                   .angle_unit = 1.0};
  return kWords;
}

const SubjectWords& ceinms_rt_words() {
  static const SubjectWords kWords{.dialect = Dialect::ceinms_rt,
                                   .defaults = "muscleDefault",
                                   .curve = "Curve",
                                   .muscles = "muscles",
                                   .muscle = "muscle",
                                   .dofs = "DoFs",
                                   .dof = "DoF",
                                   .dof_muscles = "muscleSequence",
                                   .numbers = {{"C1", Quantity::c1},
                                               {"C2", Quantity::c2},
                                               {"shapeFactor", Quantity::shape_factor},
                                               {"optimalFiberLength", Quantity::optimal_fiber_length, true},
                                               {"pennationAngle", Quantity::pennation_angle},
                                               {"tendonSlackLength", Quantity::tendon_slack_length, true},
                                               {"maxIsometricForce", Quantity::max_isometric_force, true},
                                               {"strengthCoefficient", Quantity::strength_coefficient}},
                                   .angle_unit = std::numbers::pi / 180.0};
  return kWords;
}

}  // namespace

const SubjectWords& subject_words(Dialect dialect) {
  return dialect == Dialect::ceinms_rt ? ceinms_rt_words() : ceinms_words();
}

}  // namespace myoid::opensim
