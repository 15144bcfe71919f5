#pragma once

#include <optional>

#include "myoid/osim/osim_frames.h"

namespace myoid::model {

/// A function element of any kind. One that is not supported is listed in BodyModel::unsupported
/// and read as zero; throws ReadError for bad numbers.
[[nodiscard]] Function read_function(OsimReading& reading, pugi::xml_node node);
/// The function inside a holder (<function>, <x_location>, ...); empty if the holder is.
[[nodiscard]] std::optional<Function> function_in(OsimReading& reading, pugi::xml_node holder);
/// The function that a property of an object holds, in either of the ways in which OpenSim writes
/// it: <property><Sine/></property>, or <Sine name="property"/>; empty if there is none.
[[nodiscard]] std::optional<Function> function_property(OsimReading& reading,
                                                        pugi::xml_node object,
                                                        const char* property);
/// The function of several variables that a property holds, a MultivariatePolynomialFunction or a
/// LinearFunction, inside MultiplierFunctions or not; empty for another. Throws ReadError if it
/// has not as many coefficients as its dimension and order ask for, or is of other dimension.
[[nodiscard]] std::optional<MultiPolynomial> multi_function_property(const OsimReading& reading,
                                                                     pugi::xml_node object,
                                                                     const char* property,
                                                                     int dimension);
/// The same of a function element.
[[nodiscard]] std::optional<MultiPolynomial> multi_function(const OsimReading& reading,
                                                            pugi::xml_node node,
                                                            int dimension);
/// The functions of a property that is a set of them, in either way.
[[nodiscard]] std::vector<Function> functions_property(OsimReading& reading,
                                                       pugi::xml_node object,
                                                       const char* property);

}  // namespace myoid::model
