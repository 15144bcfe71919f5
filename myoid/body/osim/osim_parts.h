#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/body/osim/osim_frames.h"

namespace myoid::body {

/// Reads the joints with their coordinates. A ScapulothoracicJoint becomes an ellipsoid joint and a hinge with a
/// massless body between.
void read_joints(OsimReading& reading, pugi::xml_node model);

/// Reads the enforced constraints; constraints of an unknown kind are listed in `unsupported`.
void read_constraints(OsimReading& reading, pugi::xml_node set);

/// Reads a constraint if it is enforced; `owner` is its path in the model.
void read_constraint(OsimReading& reading, pugi::xml_node node, const std::string& owner);

/// Returns the pairs of a HuntCrossleyForce or a SmoothSphereHalfSpaceForce that can touch: spheres with half-spaces
/// and with spheres of other bodies. Surfaces of other kinds (meshes) are listed in `unsupported`.
[[nodiscard]] std::vector<Contact> read_contacts(OsimReading& reading, pugi::xml_node force);

/// Adds a note for each class of muscles with curves other than Thelen's, with the commands that use them.
void note_classes(BodyModel& model);

/// Returns true if an element is a muscle of a kind that is read.
[[nodiscard]] bool is_muscle(pugi::xml_node node);
[[nodiscard]] Muscle read_muscle(OsimReading& reading, pugi::xml_node node);

/// Reads muscles, actuators and passive forces of a force set. Forces that are unknown or only
/// partly supported are listed in `unsupported`.
void read_forces(OsimReading& reading, pugi::xml_node set);

/// Reads one force of a force set.
void read_force(OsimReading& reading, pugi::xml_node node);

/// Reads a force among the components of a model, outside of the force set; ignores components of other kinds.
void read_component_force(OsimReading& reading, pugi::xml_node node);

/// Reads the wrap objects of ground and of the bodies in the order of the tree: a path finds the
/// first object of a name.
void read_wrap_objects(OsimReading& reading, pugi::xml_node model);

/// Reads the path of a muscle or another force: <GeometryPath>, <path><GeometryPath> or a FunctionBasedPath of
/// polynomials. Throws ReadError without a path.
[[nodiscard]] MusclePath read_path(OsimReading& reading, pugi::xml_node node);

/// Returns the class of an unsupported path (Scholz2015GeometryPath, a FunctionBasedPath of
/// functions other than polynomials); empty for a supported path.
[[nodiscard]] std::string foreign_path(const OsimReading& reading, pugi::xml_node node);

/// Reads a function element of any kind. An unsupported function is listed in
/// BodyModel::unsupported and read as zero. Throws ReadError for bad numbers.
[[nodiscard]] Function read_function(OsimReading& reading, pugi::xml_node node);
/// Returns the element of the function in a property of an object, in either of OpenSim's forms:
/// <property><Sine/></property> or <Sine name="property"/>. Empty without a function.
[[nodiscard]] pugi::xml_node function_node(const OsimReading& reading, pugi::xml_node object, const char* property);
/// Returns the function of `function_node`; empty without one.
[[nodiscard]] std::optional<Function> function_property(OsimReading& reading,
                                                        pugi::xml_node object,
                                                        const char* property);
/// Returns the function of several variables of a function element: a MultivariatePolynomialFunction or a
/// LinearFunction, also inside MultiplierFunctions; empty for another class or no element. Throws ReadError if the
/// dimension is not `dimension` or the number of coefficients contradicts dimension and order.
[[nodiscard]] std::optional<MultiPolynomial> multi_function(const OsimReading& reading,
                                                            pugi::xml_node node,
                                                            int dimension);
/// Returns the functions in a property that holds a set of functions, in either form.
[[nodiscard]] std::vector<Function> functions_property(OsimReading& reading,
                                                       pugi::xml_node object,
                                                       const char* property);

}  // namespace myoid::body
