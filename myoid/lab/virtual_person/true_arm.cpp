#include "myoid/lab/virtual_person/true_arm.h"

#include <algorithm>
#include <cmath>

#include "myoid/body/arm/arm7.h"
#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/ground/core/units.h"
#include "myoid/lab/virtual_person/departures.h"
#include "myoid/lab/virtual_person/draw_truth.h"
#include "myoid/lab/virtual_person/virtual_arm.h"

namespace myoid::lab {
namespace {

namespace beliefs = fit::beliefs;

constexpr double kHeadStrengthSd = 0.05;
constexpr double kHeadFiberLengthSd = 0.03;
constexpr double kReachSd = 0.03;  // of l_0 + l_ts
constexpr double kHeldSd = 0.02;
constexpr double kExcitationTimeSd = 0.2;
constexpr double kActivationTimeSd = 0.25;
constexpr double kHeadDriveSd = 0.08;
constexpr double kMostPureDelay_s = 0.020;
/// Passive strains at F_max. The published 0.6 and 0.7 would give the relaxed biceps of this arm, whose fibers are
/// optimal at 85 degrees, several newton meters at 20 degrees; a relaxed elbow has about one.
constexpr double kLeastPassiveStrain = 0.8;
constexpr double kMostPassiveStrain = 1.2;
/// Share of each head in the EMG of its muscle: both heads of the biceps, and mainly the lateral head of the triceps.
constexpr PerHead kElectrodeShare = {0.5, 0.5, 1.0, 1.0, 0.3, 0.6, 0.1};

/// The draws for one muscle, in standard deviations.
struct MuscleDraw {
  double strength, fiber_length, reach, speed, moment_arm, strain;
};

/// Returns the strain at which the passive force is F_max.
double set_curves(const TruthSpec& spec, math::Random& random, TrueArm& arm) {
  const bool coin = random.uniform() < 0.5;
  const double eccentric = random.uniform(1.3, 1.5);
  const double passive_strain = random.uniform(kLeastPassiveStrain, kMostPassiveStrain);
  const bool millard = spec.curves == "millard" || (spec.curves == "any" && coin);
  arm.laws = millard ? muscle::millard_laws() : muscle::de_groote_laws();
  arm.millard.velocity.max_eccentric_multiplier = eccentric;
  arm.millard.passive.strain_at_one = passive_strain;
  arm.millard.passive.stiffness_at_one = 2.0 / passive_strain;
  return passive_strain;
}

}  // namespace

TrueArm draw_true_arm(const TruthSpec& spec, const VirtualSubject& subject, math::Random& random) {
  const auto z = [&] { return spec.spread * bounded_normal(random); };
  const body::ArmOptions options = arm_options(subject);
  TrueArm arm;
  const double passive_strain = set_curves(spec, random, arm);
  const double shared_strength = z();
  const double shift = random.uniform(0.10, 0.20);
  std::array<MuscleDraw, 4> draws{};
  for (MuscleDraw& d : draws) {
    d = {.strength = z(),
         .fiber_length = z() + spec.offset,
         .reach = z(),
         .speed = z() + spec.offset,
         .moment_arm = z(),
         .strain = random.uniform(spec.tendon_strain.lower, spec.tendon_strain.upper)};
  }

  const std::array<body::ArmHead, kHeadCount> published = body::arm7_heads(options);
  PerHead raw_drive = {};
  for (std::size_t i = 0; i < kHeadCount; ++i) {
    const body::ArmHead& from = published[i];
    const auto lump = static_cast<std::size_t>(from.lump);
    const MuscleDraw& d = draws[lump];
    TrueHead& head = arm.heads[i];
    head.name = from.path.name;
    head.muscle = lump;
    head.electrode_share = kElectrodeShare[i];
    muscle::HillParameters<double> hill = from.hill;
    hill.max_isometric_force_n *= std::exp(kSharedStrengthSd * shared_strength + kStrengthSd * d.strength +
                                           kHeadStrengthSd * z() + beliefs::kMaxForce.sd * spec.offset);
    const double length = std::max(0.5, 1.0 + kFiberLengthSd * d.fiber_length + kHeadFiberLengthSd * z());
    hill.optimal_fiber_length_m *= length;
    hill.force_length_width_m *= length;
    // v_max is a fixed number of fiber lengths per second.
    hill.max_shortening_speed_mps *= length * std::exp(beliefs::kSpeed.sd * d.speed);
    head.parameters = muscle::published_defaults(hill, arm.laws);
    head.parameters.pennation_at_optimal_rad = from.pennation_at_optimal_rad;
    head.parameters.tendon_strain = d.strain;
    head.parameters.passive_strain = passive_strain;
    head.parameters.optimal_length_shift = shift;

    // At the angle of the literature's optimum, the path is as long as fiber and half-stretched
    // tendon, apart from the person's own departure.
    head.path = from.path;
    scale_moment_arm(head.path, std::max(0.5, 1.0 + spec.moment_arm_sd * d.moment_arm));
    const double published_m = from.hill.optimal_fiber_length_m + from.hill.tendon_slack_length_m;
    const double wanted_m = hill.optimal_fiber_length_m * std::cos(from.pennation_at_optimal_rad) +
                            hill.tendon_slack_length_m * (1.0 + 0.5 * d.strain) - kReachSd * d.reach * published_m;
    head.path.constant_m += wanted_m - body::travel(head.path, body::kArmOptimalAt_rad[lump]).length_m;
    raw_drive[i] = std::exp(kHeadDriveSd * z());
  }
  // A muscle's excitation is the mean of its heads', by strength.
  for (std::size_t m = 0; m < kArmMuscles.size(); ++m) {
    double strength = 0.0;
    double driven = 0.0;
    for (std::size_t i = 0; i < kHeadCount; ++i) {
      if (arm.heads[i].muscle != m) continue;
      const double force_n = arm.heads[i].parameters.hill.max_isometric_force_n;
      strength += force_n;
      driven += force_n * raw_drive[i];
    }
    for (std::size_t i = 0; i < kHeadCount; ++i) {
      if (arm.heads[i].muscle == m) arm.heads[i].drive = raw_drive[i] * strength / driven;
    }
  }

  arm.activation.excitation_time_s *= std::exp(kExcitationTimeSd * z());
  arm.activation.activation_time_s *= std::exp(kActivationTimeSd * z());
  arm.activation.deactivation_time_s *= std::exp(kActivationTimeSd * z());
  arm.delay_s = random.uniform(0.0, kMostPureDelay_s);

  arm.joint = muscle::elbow_passive();
  const double share = 0.5 * random.uniform();
  arm.joint.stiffness_nm_per_rad *= share;
  arm.joint.viscosity_nms_per_rad *= share;

  const body::PlanarElbow elbow = body::planar_elbow(options);
  const double inertia = std::max(0.5, 1.0 + spec.inertia_sd * z());
  arm.inertia_kgm2 = elbow.inertia_kgm2 * inertia;
  arm.static_moment_kgm = elbow.static_moment_kgm * inertia;
  arm.held_at_m = elbow.held_at_m * (1.0 + kHeldSd * z());
  if (spec.moment_arm_slope_sd > 0.0) {
    PerMuscle slope_per_rad;
    for (double& slope : slope_per_rad) slope = spec.moment_arm_slope_sd * bounded_normal(random);
    for (TrueHead& head : arm.heads)
      taper_moment_arm(head.path, slope_per_rad[head.muscle], body::kArmOptimalAt_rad[head.muscle]);
  }
  return arm;
}

double required_torque_nm(const body::HingedForearm& forearm,
                          double elbow_flexion_rad,
                          double acceleration_radps2,
                          Plane plane,
                          double held_mass_kg) {
  const double gravity_mps2 = plane == Plane::vertical ? kStandardGravity : 0.0;
  return body::required_torque_nm(forearm, elbow_flexion_rad, acceleration_radps2, gravity_mps2, held_mass_kg);
}

}  // namespace myoid::lab
