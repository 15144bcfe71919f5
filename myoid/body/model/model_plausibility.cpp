#include "myoid/body/model/model_plausibility.h"

#include <string>
#include <utility>

#include <fmt/format.h>

namespace myoid::body {
namespace {

std::optional<Remark> unlikely_mass(const BodyModel& model) {
  const double mass = mass_kg(model);
  const auto remark = [&](Severity severity, const char* says, const char* remedy) {
    return Remark{.code = RemarkCode::mass_impossible,
                  .severity = severity,
                  .about = "mass",
                  .value = mass,
                  .says = fmt::format("the bodies of the model weigh {:.4g} kg{}", mass, says),
                  .remedy = remedy};
  };
  if (mass > kModelLimits.heaviest_kg)
    return remark(Severity::error, ", more than any person: are its masses in grams?",
                  "write the masses and inertias in kg and kg m2, or scale the model to the person (myoid run-tool "
                  "with a set-up of the Scale tool)");
  if (mass < kModelLimits.lightest_kg)
    return remark(Severity::warning, ": weight and inertia of the limb are missing from its torque",
                  "give the bodies their masses [kg]");
  return std::nullopt;
}

std::optional<Remark> unlikely_gravity(const BodyModel& model) {
  const double g = model.gravity_G.norm();
  const bool strong = g > kModelLimits.strongest_mps2;
  if (!strong && (g == 0.0 || g >= kModelLimits.weakest_mps2)) return std::nullopt;
  return Remark{.code = RemarkCode::gravity_impossible,
                .severity = strong ? Severity::error : Severity::warning,
                .about = "gravity",
                .value = g,
                .says = fmt::format(
                    "the gravity of the model is {:.4g} m/s2, on earth it is 9.81: every torque by weight is wrong", g),
                .remedy = "write <gravity> in m/s2"};
}

/// A number of muscles, the first that is out of its limits, and how many are.
struct MuscleNumber {
  const char* name;
  const char* unit;
  double lower, upper;
  double MuscleProperties::*member;
};

std::optional<Remark> unlikely_number(const BodyModel& model, const MuscleNumber& number) {
  std::size_t count = 0;
  const Muscle* first = nullptr;
  for (const Muscle& muscle : model.muscles) {
    const double value = muscle.properties.*number.member;
    if (value >= number.lower && value <= number.upper) continue;
    if (count++ == 0) first = &muscle;
  }
  if (first == nullptr) return std::nullopt;
  return Remark{
      .code = RemarkCode::muscle_impossible,
      .about = first->name,
      .value = first->properties.*number.member,
      .says = fmt::format("{} of muscle {} is {:.4g} {}, expected {:g} to {:g} {}{}", number.name, first->name,
                          first->properties.*number.member, number.unit, number.lower, number.upper, number.unit,
                          count > 1 ? fmt::format(" ({} muscles are so)", count) : ""),
      .remedy = "write lengths in m and forces in N"};
}

/// Returns the distance of a point from the origin of its frame, with the coordinates at their defaults [m].
double distance_m(const BodyModel& model, const PathPoint& point) {
  if (!point.moving) return point.p_BP.norm();
  Vec3 p = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const int c = point.moving->coordinates[k];
    const double q = c < 0 ? 0.0 : model.coordinates[static_cast<std::size_t>(c)].default_value;
    p(static_cast<Eigen::Index>(k)) = evaluate(point.moving->location[k], q).value;
  }
  return p.norm();
}

std::optional<Remark> unlikely_point(const BodyModel& model) {
  for (const Muscle& muscle : model.muscles) {
    for (const PathPoint& point : muscle.path.points) {
      const double far_m = distance_m(model, point);
      if (far_m <= kModelLimits.farthest_point_m) continue;
      return Remark{.code = RemarkCode::muscle_impossible,
                    .about = muscle.name,
                    .value = far_m,
                    .says = fmt::format("point {} of muscle {} lies {:.4g} m from the origin of its frame, expected at "
                                        "most {:g} m",
                                        point.name, muscle.name, far_m, kModelLimits.farthest_point_m),
                    .remedy = "write places in m"};
    }
  }
  return std::nullopt;
}

}  // namespace

double mass_kg(const BodyModel& model) {
  double sum_kg = 0.0;
  for (const Body& body : model.bodies) sum_kg += body.mass_kg;
  return sum_kg;
}

std::vector<Remark> implausible(const BodyModel& model) {
  std::vector<Remark> found;
  const auto take = [&](std::optional<Remark> remark) {
    if (remark) found.push_back(std::move(*remark));
  };
  constexpr const ModelLimits& l = kModelLimits;
  take(unlikely_mass(model));
  take(unlikely_gravity(model));
  take(unlikely_number(model, {"optimal_fiber_length", "m", l.shortest_fiber_m, l.longest_fiber_m,
                               &MuscleProperties::optimal_fiber_length_m}));
  take(unlikely_number(
      model, {"tendon_slack_length", "m", 0.0, l.longest_tendon_m, &MuscleProperties::tendon_slack_length_m}));
  take(unlikely_number(
      model, {"max_isometric_force", "N", 0.0, l.strongest_muscle_n, &MuscleProperties::max_isometric_force_n}));
  take(unlikely_point(model));
  return found;
}

}  // namespace myoid::body
