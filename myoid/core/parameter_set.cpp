#include "myoid/core/parameter_set.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"

namespace myoid {
namespace {

void validate(const Parameter& p) {
  if (p.name.empty()) throw InvalidInput("a parameter has no name");
  if (!std::isfinite(p.value)) {
    throw InvalidInput(fmt::format("parameter '{}' has no finite value", p.name));
  }
  if (!(p.lower <= p.upper)) {
    throw InvalidInput(fmt::format("parameter '{}': lower bound {} above upper bound {}", p.name,
                                   p.lower, p.upper));
  }
  if (p.value < p.lower || p.value > p.upper) {
    throw InvalidInput(fmt::format("parameter '{}' = {} {} lies outside its bounds [{}, {}]",
                                   p.name, p.value, symbol(p.unit), p.lower, p.upper));
  }
  if (p.prior && (!(p.prior->sd > 0.0) || !std::isfinite(p.prior->mean))) {
    throw InvalidInput(
        fmt::format("parameter '{}': a prior needs a finite mean and a positive sd", p.name));
  }
  if (p.prior && p.prior->logarithmic && !(p.prior->mean > 0.0)) {
    throw InvalidInput(
        fmt::format("parameter '{}': a logarithmic prior needs a positive mean", p.name));
  }
}

template <typename Vector>
auto find_by_name(Vector& parameters, std::string_view name) {
  return std::find_if(parameters.begin(), parameters.end(),
                      [&](const Parameter& p) { return p.name == name; });
}

[[noreturn]] void throw_unknown(const std::vector<Parameter>& parameters, std::string_view name) {
  std::string names;
  for (const Parameter& p : parameters) names += (names.empty() ? "" : ", ") + p.name;
  throw InvalidInput(fmt::format("no parameter named '{}'; there are: {}", name, names));
}

template <typename Get>
Eigen::VectorXd gather(const std::vector<Parameter>& parameters, Get get) {
  std::vector<double> values;
  for (const Parameter& p : parameters) {
    if (p.free) values.push_back(get(p));
  }
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace

ParameterSet::ParameterSet(std::vector<Parameter> parameters) {
  for (Parameter& p : parameters) add(std::move(p));
}

void ParameterSet::add(Parameter parameter) {
  validate(parameter);
  if (contains(parameter.name)) {
    throw InvalidInput(fmt::format("two parameters are named '{}'", parameter.name));
  }
  parameters_.push_back(std::move(parameter));
}

bool ParameterSet::contains(std::string_view name) const {
  return find_by_name(parameters_, name) != parameters_.end();
}

const Parameter& ParameterSet::at(std::string_view name) const {
  const auto it = find_by_name(parameters_, name);
  if (it == parameters_.end()) throw_unknown(parameters_, name);
  return *it;
}

Parameter& ParameterSet::at(std::string_view name) {
  const auto it = find_by_name(parameters_, name);
  if (it == parameters_.end()) throw_unknown(parameters_, name);
  return *it;
}

std::vector<std::size_t> ParameterSet::free_indices() const {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    if (parameters_[i].free) indices.push_back(i);
  }
  return indices;
}

Eigen::VectorXd ParameterSet::free_values() const {
  return gather(parameters_, [](const Parameter& p) { return p.value; });
}
Eigen::VectorXd ParameterSet::free_lower() const {
  return gather(parameters_, [](const Parameter& p) { return p.lower; });
}
Eigen::VectorXd ParameterSet::free_upper() const {
  return gather(parameters_, [](const Parameter& p) { return p.upper; });
}

ParameterSet ParameterSet::with_free_values(const Eigen::Ref<const Eigen::VectorXd>& x) const {
  const std::vector<std::size_t> indices = free_indices();
  if (x.size() != static_cast<Eigen::Index>(indices.size())) {
    throw InvalidInput(fmt::format("{} values for {} free parameters", x.size(), indices.size()));
  }
  ParameterSet copy = *this;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    copy.parameters_[indices[i]].value = x[static_cast<Eigen::Index>(i)];
  }
  return copy;
}

}  // namespace myoid
