#include <utility>

#include "myoid/body/osim/osim_parts.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

/// Reads a coordinate that depends on several others.
void read_function_constraint(OsimReading& r,
                              pugi::xml_node node,
                              const std::string& name,
                              const std::vector<std::string>& independent) {
  auto function =
      multi_function(r, function_node(r, node, "coupled_coordinates_function"), static_cast<int>(independent.size()));
  if (!function) {
    r.leave_out(
        "constraint '{}' couples {} independent coordinates by another function than a LinearFunction or a "
        "MultivariatePolynomialFunction; it is not enforced",
        name, independent.size());
    return;
  }
  FunctionConstraint law;
  law.dependent = coordinate_named(r, node, r.xml.word(node, "dependent_coordinate_name"));
  for (const std::string& coordinate : independent) {
    law.independent.push_back(coordinate_named(r, node, coordinate));
    if (law.independent.back() == law.dependent)
      r.xml.fail(node, "constraint '{}' couples a coordinate with itself", name);
  }
  law.function = *std::move(function);
  law.function.scale *= r.xml.number(node, "scale_factor", 1.0);
  r.model.constraints.push_back({name, node.name(), std::move(law)});
}

/// Returns true for couplers of the same coordinates whose functions agree wherever they are tried.
bool is_same(const CoordinateCoupler& one, const CoordinateCoupler& two) {
  if (one.independent != two.independent || one.dependent != two.dependent) return false;
  for (const double x : {-3.1, -1.3, -0.6, -0.2, 0.0, 0.1, 0.4, 0.9, 1.7, 2.9})
    if (evaluate(one.function, x).value != evaluate(two.function, x).value) return false;
  return true;
}

/// Reads a coordinate that depends on one other.
void read_coupler(OsimReading& r, pugi::xml_node node, const std::string& name) {
  const auto independent = r.xml.words(node, "independent_coordinate_names");
  if (independent.size() > 1) return read_function_constraint(r, node, name, independent);
  const std::size_t listed = r.model.unsupported.size();
  const auto function = function_property(r, node, "coupled_coordinates_function");
  if (independent.size() != 1 || !function || r.model.unsupported.size() > listed) {
    r.leave_out("constraint '{}' couples {} independent coordinates{}; it is not enforced", name, independent.size(),
                function ? "" : " by no function");
    return;
  }
  CoordinateCoupler coupler;
  coupler.name = name;
  coupler.independent = coordinate_named(r, node, independent[0]);
  coupler.dependent = coordinate_named(r, node, r.xml.word(node, "dependent_coordinate_name"));
  coupler.function = *function;
  coupler.function.scale *= r.xml.number(node, "scale_factor", 1.0);
  if (coupler.independent == coupler.dependent)
    r.xml.fail(node, "constraint '{}' couples a coordinate with itself", name);
  for (const CoordinateCoupler& other : r.model.couplers) {
    if (other.dependent != coupler.dependent) continue;
    if (is_same(other, coupler)) {
      r.note("constraint '{}' repeats constraint '{}'", name, other.name);
      return;
    }
    r.note("constraints '{}' and '{}' both set coordinate '{}'; both hold, which ties the coordinates they follow",
           other.name, name, r.model.coordinates[at(coupler.dependent)].name);
    r.model.constraints.push_back({name, node.name(), SecondCoupler{std::move(coupler)}});
    return;
  }
  r.model.couplers.push_back(std::move(coupler));
}

}  // namespace

void read_constraints(OsimReading& r, pugi::xml_node set) {
  for (const auto node : OsimXml::objects(set)) read_constraint(r, node, "/constraintset/" + OsimXml::name_of(node));
}

void read_constraint(OsimReading& r, pugi::xml_node node, const std::string& owner) {
  if (!r.xml.flag(node, "isEnforced", true)) return;
  const std::string kind = node.name();
  const std::string name = OsimXml::name_of(node);
  if (kind == "CoordinateCouplerConstraint") {
    read_coupler(r, node, name);
  } else if (kind == "WeldConstraint") {
    const auto [first, second] = two_frames(r, node);
    r.model.constraints.push_back(
        {name, kind, FrameConstraint{first.body, second.body, first.X_BF, second.X_BF, true}});
  } else if (kind == "PointConstraint") {
    const FixedFrame first = frame_of(r, node, "body_1", owner);
    const FixedFrame second = frame_of(r, node, "body_2", owner);
    FrameConstraint law{first.body, second.body, first.X_BF, second.X_BF, false};
    law.X_BF1.p = first.X_BF * r.xml.vec3(node, "location_body_1", Vec3::Zero());
    law.X_BF2.p = second.X_BF * r.xml.vec3(node, "location_body_2", Vec3::Zero());
    r.model.constraints.push_back({name, kind, law});
  } else if (kind == "ConstantDistanceConstraint") {
    const BodyPoint first = point_of(r, node, owner, "body_1", "location_body_1");
    const BodyPoint second = point_of(r, node, owner, "body_2", "location_body_2");
    r.model.constraints.push_back({name, kind,
                                   DistanceConstraint{first.body, second.body, first.p_B, second.p_B,
                                                      r.xml.number(node, "constant_distance", 0.0)}});
  } else if (kind == "PointOnLineConstraint") {
    const FixedFrame line = frame_of(r, node, "line_body", owner);
    const Vec3 direction = line.X_BF.R * direction_of(r, node, "line_direction_vec", Vec3::UnitX());
    const BodyPoint start = point_of(r, node, owner, "line_body", "point_on_line");
    const BodyPoint follower = point_of(r, node, owner, "follower_body", "point_on_follower");
    r.model.constraints.push_back(
        {name, kind, LineConstraint{line.body, follower.body, direction, start.p_B, follower.p_B}});
  } else {
    r.leave_out("constraint '{}' of kind {} is not enforced", name, kind);
  }
}

}  // namespace myoid::body
