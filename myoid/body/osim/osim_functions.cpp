#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/osim/osim_parts.h"
#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

constexpr const char* kSupported =
    "supported are Constant, LinearFunction, PolynomialFunction, PiecewiseLinearFunction, PiecewiseConstantFunction, "
    "StepFunction, Sine, SimmSpline, NaturalCubicSpline, GCVSpline that interpolates (degree 1, 3, 5 or 7), "
    "MultivariatePolynomialFunction of one variable and MultiplierFunction";

std::string named(pugi::xml_node node) {
  const std::string name = OsimXml::name_of(node);
  return name.empty() ? fmt::format("<{}>", node.name()) : fmt::format("<{}> '{}'", node.name(), name);
}

/// Describes the element that holds the function, and the element's owner.
std::string place_of(pugi::xml_node node) {
  std::string place;
  int levels = 0;
  for (auto n = node.parent(); n && levels < 2; n = n.parent()) {
    const std::string_view kind = n.name();
    if (kind == "objects" || kind == "function" || kind.ends_with("Set")) continue;
    place += " of " + named(n);
    ++levels;
  }
  return place;
}

Function unsupported(OsimReading& r, pugi::xml_node node, const std::string& why) {
  r.leave_out("function <{}>{} {}; it is taken as zero ({})", node.name(), place_of(node), why, kSupported);
  return Constant{0.0};
}

std::vector<double> coefficients_of(const OsimReading& r, pugi::xml_node node) {
  auto c = r.xml.numbers(r.xml.property(node, "coefficients"));
  if (c.empty()) r.xml.fail(node, "<coefficients>: expected at least one number");
  return c;
}

Function read_knots(OsimReading& r, pugi::xml_node node, double scale) {
  const std::string_view kind = node.name();
  std::vector<double> x = r.xml.numbers(r.xml.property(node, "x"));
  std::vector<double> y = r.xml.numbers(r.xml.property(node, "y"));
  try {
    if (kind == "SimmSpline") return {make_simm_spline(std::move(x), std::move(y)), scale};
    if (kind == "PiecewiseLinearFunction") return {make_piecewise_linear(std::move(x), std::move(y)), scale};
    if (kind == "PiecewiseConstantFunction") return {make_piecewise_constant(std::move(x), std::move(y)), scale};
    const double half_order = r.xml.number(node, "half_order", 3.0);
    if (r.xml.number(node, "error_variance", 0.0) > 0.0)
      return unsupported(r, node, "smooths (its <error_variance> is above 0)");
    if (half_order == 1.0) return {make_piecewise_linear(std::move(x), std::move(y)), scale};
    if (half_order == 2.0) return {make_natural_spline(std::move(x), std::move(y)), scale};
    if (half_order == 3.0) return {make_quintic_spline(x, y), scale};
    if (half_order == 4.0) return {make_septic_spline(x, y), scale};
    return unsupported(r, node, fmt::format("has <half_order> {}", half_order));
  } catch (const ReadError&) {
    throw;
  } catch (const InvalidInput& error) {
    r.xml.fail(node, error.what());
  }
}

/// Replaces MultiplierFunctions by the function inside; returns the product of their scales.
double unwrap(const OsimReading& r, pugi::xml_node& node) {
  double scale = 1.0;
  for (int depth = 0; std::string_view(node.name()) == "MultiplierFunction"; ++depth) {
    scale *= r.xml.number(node, "scale", 1.0);
    auto inner = OsimXml::first_element(node.child("function"));
    if (!inner) inner = node.find_child_by_attribute("name", "function");
    if (!inner) r.xml.fail(node, "<MultiplierFunction> has no function inside");
    if (depth > 64) r.xml.fail(node, "<MultiplierFunction> is nested more than 64 deep");
    node = inner;
  }
  return scale;
}

}  // namespace

pugi::xml_node function_node(const OsimReading& r, pugi::xml_node object, const char* property) {
  if (const auto holder = r.xml.property(object, property)) return OsimXml::first_element(holder);
  return object.find_child_by_attribute("name", property);
}

std::optional<Function> function_property(OsimReading& r, pugi::xml_node object, const char* property) {
  const auto node = function_node(r, object, property);
  return node ? std::optional(read_function(r, node)) : std::nullopt;
}

std::vector<Function> functions_property(OsimReading& r, pugi::xml_node object, const char* property) {
  auto set = r.xml.property(object, property);
  if (!set) set = object.find_child_by_attribute("name", property);
  if (const auto inner = set.child("FunctionSet")) set = inner;
  std::vector<Function> functions;
  for (const auto node : OsimXml::objects(set)) functions.push_back(read_function(r, node));
  return functions;
}

std::optional<MultiPolynomial> multi_function(const OsimReading& r, pugi::xml_node node, int dimension) {
  const double scale = unwrap(r, node);
  const std::string_view kind = node.name();
  MultiPolynomial f{.dimension = dimension, .degree = 1, .scale = scale};
  if (kind == "LinearFunction") {
    // Slopes in the order of the variables, then the intercept: reverse the order.
    f.coefficients = coefficients_of(r, node);
    std::reverse(f.coefficients.begin(), f.coefficients.end());
  } else if (kind == "MultivariatePolynomialFunction") {
    const double stated = r.xml.number(node, "dimension", 0.0);
    const double order = r.xml.number(node, "order", 0.0);
    constexpr double kHighest = 100.0;
    if (stated != dimension || !(order >= 0.0 && order <= kHighest)) {
      r.xml.fail(node, "<dimension> {} and <order> {}, expected a function of {} variables and an order of 0 to {}",
                 stated, order, dimension, kHighest);
    }
    f.degree = static_cast<int>(order);
    f.coefficients = coefficients_of(r, node);
  } else {
    return std::nullopt;
  }
  const double needed = term_count(f.dimension, f.degree);
  if (static_cast<double>(f.coefficients.size()) != needed) {
    r.xml.fail(node, "<coefficients>: expected {} for {} variables and order {}, found {}", needed, f.dimension,
               f.degree, f.coefficients.size());
  }
  return f;
}

Function read_function(OsimReading& r, pugi::xml_node node) {
  const double scale = unwrap(r, node);
  const std::string_view kind = node.name();
  if (kind == "Constant") return {Constant{r.xml.number(node, "value", 0.0)}, scale};
  if (kind == "LinearFunction") {
    const auto given = r.xml.property(node, "coefficients");
    const auto c = given ? r.xml.numbers(given) : std::vector<double>{1.0, 0.0};
    if (c.size() != 2) {
      r.xml.fail(node, "<coefficients>: expected slope and intercept, found {} numbers", c.size());
    }
    return {Linear{c[0], c[1]}, scale};
  }
  if (kind == "PolynomialFunction") return {Polynomial{coefficients_of(r, node)}, scale};
  if (kind == "MultivariatePolynomialFunction") {
    if (r.xml.number(node, "dimension", 1.0) != 1.0) return unsupported(r, node, "is one of several variables");
    auto c = coefficients_of(r, node);  // lowest power first
    std::reverse(c.begin(), c.end());
    return {Polynomial{std::move(c)}, scale};
  }
  if (kind == "Sine") {
    return {Sine{r.xml.number(node, "amplitude", 1.0), r.xml.number(node, "omega", 1.0),
                 r.xml.number(node, "phase", 0.0), r.xml.number(node, "offset", 0.0)},
            scale};
  }
  if (kind == "StepFunction") {
    const SmoothStep step{r.xml.number(node, "start_time", 0.0), r.xml.number(node, "end_time", 1.0),
                          r.xml.number(node, "start_value", 0.0), r.xml.number(node, "end_value", 1.0)};
    if (!(step.end > step.start)) {
      r.xml.fail(node, "<StepFunction>: expected <end_time> after <start_time> {}, found {}", step.start, step.end);
    }
    return {step, scale};
  }
  if (kind == "SimmSpline" || kind == "PiecewiseLinearFunction" || kind == "GCVSpline" ||
      kind == "PiecewiseConstantFunction")
    return read_knots(r, node, scale);
  return unsupported(r, node, "is not supported");
}

}  // namespace myoid::body
