#include "myoid/body/dynamics/held_mass.h"

#include <cmath>
#include <span>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/core/nearest_word.h"

namespace myoid::body {

body::BodyModel with_held_mass(body::BodyModel model, std::string_view body, const Vec3& p_BP_m, double mass_kg) {
  if (!(mass_kg >= 0.0) || !std::isfinite(mass_kg)) {
    throw InvalidInput(fmt::format("held mass: found {} kg, expected 0 or more", mass_kg));
  }
  const auto index = model.find_body(body);
  if (!index || *index == 0) {
    throw ModelError(fmt::format("held mass: the model has no body '{}'{}", body,
                                 not_among(body, std::span(model.bodies).subspan(1), &body::Body::name)));
  }
  if (mass_kg == 0.0) return model;
  body::Body& carrier = model.bodies[static_cast<std::size_t>(*index)];
  const double mass = carrier.mass_kg + mass_kg;
  const Vec3 center = (carrier.mass_kg * carrier.p_BBcm_B + mass_kg * p_BP_m) / mass;
  const auto shifted = [&](double m, const Vec3& p) -> Mat3 {
    const Mat3 s = skew(p - center);
    return m * s.transpose() * s;
  };
  carrier.I_BBcm_B += shifted(carrier.mass_kg, carrier.p_BBcm_B) + shifted(mass_kg, p_BP_m);
  carrier.p_BBcm_B = center;
  carrier.mass_kg = mass;
  return model;
}

}  // namespace myoid::body
