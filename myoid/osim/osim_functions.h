#pragma once

#include <optional>

#include "myoid/osim/osim_frames.h"

namespace myoid::model {

/// Reads a function element of any kind. An unsupported function is listed in
/// BodyModel::unsupported and read as zero. Throws ReadError for bad numbers.
[[nodiscard]] Function read_function(OsimReading& reading, pugi::xml_node node);
/// Returns the function inside a holder (<function>, <x_location>, ...); empty if the holder is.
[[nodiscard]] std::optional<Function> function_in(OsimReading& reading, pugi::xml_node holder);
/// Returns the function in a property of an object, in either of OpenSim's forms:
/// <property><Sine/></property> or <Sine name="property"/>. Empty without a function.
[[nodiscard]] std::optional<Function> function_property(OsimReading& reading,
                                                        pugi::xml_node object,
                                                        const char* property);
/// Returns the function of several variables in a property: a MultivariatePolynomialFunction or a
/// LinearFunction, also inside MultiplierFunctions; empty for another class. Throws ReadError if
/// the dimension is not `count` or the number of coefficients contradicts dimension and order.
[[nodiscard]] std::optional<MultiPolynomial> multi_function_property(const OsimReading& reading,
                                                                     pugi::xml_node object,
                                                                     const char* property,
                                                                     int dimension);
/// Returns the function of several variables of a function element.
[[nodiscard]] std::optional<MultiPolynomial> multi_function(const OsimReading& reading,
                                                            pugi::xml_node node,
                                                            int dimension);
/// Returns the functions in a property that holds a set of functions, in either form.
[[nodiscard]] std::vector<Function> functions_property(OsimReading& reading,
                                                       pugi::xml_node object,
                                                       const char* property);

}  // namespace myoid::model
