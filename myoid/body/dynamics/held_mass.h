#pragma once

#include "myoid/body/model/body_model.h"

namespace myoid::body {

/// Returns the model with a point mass fixed to a body. Mass, mass center and inertia of the body
/// become the combined ones (parallel axes; the inertia about the common mass center).
///
///   m = m_b + m_p,   c = (m_b c_b + m_p p) / m,
///   I = I_b + m_b S(c_b - c)' S(c_b - c) + m_p S(p - c)' S(p - c)
///
/// `p_BP_m` is expressed in the body's frame [m]. A mass of 0 leaves the model unchanged. Throws
/// InvalidInput if the mass is negative or not finite, ModelError if the body is unknown or ground.
[[nodiscard]] body::BodyModel with_held_mass(body::BodyModel model,
                                             std::string_view body,
                                             const Vec3& p_BP_m,
                                             double mass_kg);

}  // namespace myoid::body
