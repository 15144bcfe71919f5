#include "myoid/body/arm/planar_elbow.h"

#include <cmath>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

/// de Leva (1996): fractions of body mass and of segment length.
struct Fractions {
  double mass;
  double center;
  double sagittal;  ///< Radii of gyration about the center.
  double transverse;
  double longitudinal;
};

struct ArmFractions {
  Fractions upper_arm;
  Fractions forearm;
  Fractions hand;  ///< Its length: wrist to the third knuckle.
};

constexpr ArmFractions kMale = {{0.0271, 0.5772, 0.285, 0.269, 0.158},
                                {0.0162, 0.4574, 0.276, 0.265, 0.121},
                                {0.0061, 0.7900, 0.628, 0.513, 0.401}};
constexpr ArmFractions kFemale = {{0.0255, 0.5754, 0.278, 0.260, 0.148},
                                  {0.0138, 0.4559, 0.261, 0.257, 0.094},
                                  {0.0056, 0.7474, 0.531, 0.454, 0.335}};

constexpr double kHandPerForearm = 0.0862 / 0.2689;  ///< Length of the hand, as above.

const ArmFractions& fractions(const ArmOptions& options) {
  const auto check = [](double value, const char* what) {
    if (!(value > 0.0) || !std::isfinite(value)) {
      throw InvalidInput(fmt::format("{} of the arm is {}, expected a positive number (SI)", what, value));
    }
  };
  check(options.mass_kg, "mass_kg");
  check(options.upper_arm_length_m, "upper_arm_length_m");
  check(options.forearm_length_m, "forearm_length_m");
  return options.female ? kFemale : kMale;
}

SegmentInertia segment(const Fractions& f, double body_mass_kg, double length_m) {
  const Vec3 gyration_m = length_m * Vec3(f.sagittal, f.longitudinal, f.transverse);
  const double mass_kg = f.mass * body_mass_kg;
  return {mass_kg, f.center * length_m, mass_kg * gyration_m.cwiseAbs2()};
}

}  // namespace

SegmentInertia upper_arm(const ArmOptions& options) {
  return segment(fractions(options).upper_arm, options.mass_kg, options.upper_arm_length_m);
}

SegmentInertia forearm_with_hand(const ArmOptions& options) {
  const ArmFractions& f = fractions(options);
  const double hand_m = kHandPerForearm * options.forearm_length_m;
  const SegmentInertia forearm = segment(f.forearm, options.mass_kg, options.forearm_length_m);
  SegmentInertia hand = segment(f.hand, options.mass_kg, hand_m);
  hand.center_m += options.forearm_length_m;

  SegmentInertia both;
  both.mass_kg = forearm.mass_kg + hand.mass_kg;
  both.center_m = (forearm.mass_kg * forearm.center_m + hand.mass_kg * hand.center_m) / both.mass_kg;
  const double apart_m = hand.center_m - forearm.center_m;
  const double reduced_kg = forearm.mass_kg * hand.mass_kg / both.mass_kg;
  both.I_cm_kgm2 = forearm.I_cm_kgm2 + hand.I_cm_kgm2 + reduced_kg * apart_m * apart_m * Vec3(1.0, 0.0, 1.0);
  return both;
}

double held_at_m(const ArmOptions& options) {
  return options.forearm_length_m * (1.0 + kHandPerForearm * fractions(options).hand.center);
}

MuscleTravel travel(const PlanarMuscle& muscle, double elbow_flexion_rad) {
  const double from_rad = elbow_flexion_rad - muscle.taper_about_rad;
  const double taper_m = muscle.taper_mprad * from_rad;
  MuscleTravel result{muscle.constant_m + muscle.pulley_m * elbow_flexion_rad - 0.5 * taper_m * from_rad,
                      -muscle.pulley_m + taper_m, muscle.taper_mprad};
  if (muscle.above_m == 0.0) return result;
  const double psi = muscle.straight_rad - elbow_flexion_rad;
  const double product_m2 = muscle.above_m * muscle.below_m;
  const double across_m =
      std::sqrt(muscle.above_m * muscle.above_m + muscle.below_m * muscle.below_m - 2.0 * product_m2 * std::cos(psi));
  const double arm_m = product_m2 * std::sin(psi) / across_m;
  result.length_m += across_m;
  result.moment_arm_m += arm_m;
  // dr/dq of r = L1 L2 sin(psi) / l, with dpsi/dq = -1 and dl/dq = -r.
  result.moment_arm_slope_mprad += (arm_m * arm_m - product_m2 * std::cos(psi)) / across_m;
  return result;
}

PlanarElbow planar_elbow(const ArmOptions& options) {
  const SegmentInertia forearm = forearm_with_hand(options);
  const double upper_arm_m = options.upper_arm_length_m;
  PlanarElbow elbow;
  // The parts along the bones: biceps from the shoulder, brachialis from the middle of the upper
  // arm, brachioradialis on to the wrist, triceps from high on the upper arm.
  elbow.muscles = {{{"BIC", upper_arm_m - 0.080, 0.080, 0.048, 165.0 * kDegree, 0.0},
                    {"BRA", 0.5 * upper_arm_m - 0.050, 0.050, 0.030, 165.0 * kDegree, 0.0},
                    {"BRD", options.forearm_length_m - 0.076, 0.070, 0.076, 170.0 * kDegree, 0.0},
                    {"TRI", 0.8 * upper_arm_m, 0.0, 0.0, 0.0, 0.021}}};
  elbow.inertia_kgm2 = forearm.I_cm_kgm2.z() + forearm.mass_kg * forearm.center_m * forearm.center_m;
  elbow.static_moment_kgm = forearm.mass_kg * forearm.center_m;
  elbow.held_at_m = held_at_m(options);
  return elbow;
}

double required_torque_nm(const HingedForearm& forearm,
                          double elbow_flexion_rad,
                          double acceleration_radps2,
                          double gravity_mps2,
                          double held_mass_kg) {
  const double d_m = forearm.held_at_m;
  return (forearm.inertia_kgm2 + held_mass_kg * d_m * d_m) * acceleration_radps2 +
         (forearm.static_moment_kgm + held_mass_kg * d_m) * gravity_mps2 * std::sin(elbow_flexion_rad);
}

}  // namespace myoid::body
