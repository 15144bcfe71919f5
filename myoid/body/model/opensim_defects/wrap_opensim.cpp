#include "myoid/body/model/opensim_defects/wrap_opensim.h"

#include "myoid/body/model/opensim_defects/wrap_opensim_surfaces.h"

namespace myoid::body {

OpenSimContact opensim_contact(
    const WrapObject& object, WrapMethod method, const Vec3& p_W, const Vec3& q_W, bool single, const Compat& compat) {
  const Side side(object.quadrant);
  if (const auto* cylinder = std::get_if<CylinderShape>(&object.shape))
    return opensim_cylinder_contact(*cylinder, side, p_W, q_W, single, compat);
  if (const auto* sphere = std::get_if<SphereShape>(&object.shape))
    return opensim_sphere_contact(*sphere, side, p_W, q_W, compat);
  if (const auto* torus = std::get_if<TorusShape>(&object.shape))
    return opensim_torus_contact(*torus, side, p_W, q_W, single, compat);
  return opensim_ellipsoid_contact(std::get<EllipsoidShape>(object.shape), object.quadrant, method, p_W, q_W, compat);
}

}  // namespace myoid::body
