#include "myoid/body/kinematics/surrogate_file.h"

#include <limits>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/body/model/multi_polynomial.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::body {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view kKind = "myoid path surrogates";
constexpr int kVersion = 1;

ordered_json json_numbers(const Eigen::VectorXd& values) { return std::vector<double>(values.begin(), values.end()); }

/// Reads null as infinity, which JSON lacks.
double number_of(const ordered_json& value) {
  return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

Eigen::VectorXd vector_of(const ordered_json& value) {
  const auto values = value.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

ordered_json names(const body::BodyModel& model, const std::vector<int>& coordinates) {
  ordered_json list = ordered_json::array();
  for (const int c : coordinates) list.push_back(model.coordinates[static_cast<std::size_t>(c)].name);
  return list;
}

std::vector<int> indices(const body::BodyModel& model, const ordered_json& list) {
  std::vector<int> result;
  for (const auto& name : list) result.push_back(model.coordinate_index(name.get<std::string>()));
  return result;
}

PathSurrogate surrogate_of(const body::BodyModel& model, const ordered_json& object) {
  PathSurrogate s;
  s.muscle = object.at("muscle").get<std::string>();
  s.coordinates = indices(model, object.at("coordinates"));
  s.lower = vector_of(object.at("lower"));
  s.upper = vector_of(object.at("upper"));
  s.held = indices(model, object.at("held"));
  s.held_at = vector_of(object.at("held_at"));
  s.degree = object.at("degree").get<int>();
  s.coefficient_m = vector_of(object.at("coefficient_m"));
  s.length_error_m = number_of(object.at("length_error_m"));
  s.length_rms_m = number_of(object.at("length_rms_m"));
  s.arm_error_m = number_of(object.at("arm_error_m"));
  s.arm_rms_m = number_of(object.at("arm_rms_m"));
  s.within_tolerance = object.at("within_tolerance").get<bool>();
  return s;
}

/// Checks the numbers of a file that is JSON of the right shape.
void check(const PathSurrogate& s, const std::string& muscle, const std::filesystem::path& path) {
  const auto d = static_cast<Eigen::Index>(s.coordinates.size());
  const bool fits = s.muscle == muscle && s.degree >= 0 && s.degree <= 64 && s.lower.size() == d &&
                    s.upper.size() == d && ((s.upper - s.lower).array() > 0.0).all() &&
                    s.held_at.size() == static_cast<Eigen::Index>(s.held.size()) && s.coefficient_m.allFinite() &&
                    s.coefficient_m.size() == static_cast<Eigen::Index>(term_count(static_cast<int>(d), s.degree));
  if (!fits) {
    throw ReadError(
        path, 0,
        fmt::format("the surrogate of muscle '{}' is damaged; delete the file, it will be made again", muscle));
  }
}

}  // namespace

std::string surrogate_key(std::string_view model_text, const body::Compat& compat, const SurrogateOptions& options) {
  return sha256(fmt::format("{} {}\n{}\n{} {} {} {} {}\n{}", kKind, kVersion, name_of(compat),
                            options.length_tolerance_m, options.arm_tolerance_m, options.max_degree, options.max_terms,
                            options.seed, model_text));
}

void write_surrogates(const std::filesystem::path& path,
                      const body::BodyModel& model,
                      const std::string& key,
                      const std::vector<PathSurrogate>& surrogates) {
  ordered_json object{{"kind", kKind}, {"version", kVersion}, {"key", key}};
  object["muscles"] = ordered_json::array();
  for (const PathSurrogate& s : surrogates) {
    object["muscles"].push_back({{"muscle", s.muscle},
                                 {"coordinates", names(model, s.coordinates)},
                                 {"lower", json_numbers(s.lower)},
                                 {"upper", json_numbers(s.upper)},
                                 {"held", names(model, s.held)},
                                 {"held_at", json_numbers(s.held_at)},
                                 {"degree", s.degree},
                                 {"length_error_m", s.length_error_m},
                                 {"length_rms_m", s.length_rms_m},
                                 {"arm_error_m", s.arm_error_m},
                                 {"arm_rms_m", s.arm_rms_m},
                                 {"within_tolerance", s.within_tolerance},
                                 {"coefficient_m", json_numbers(s.coefficient_m)}});
  }
  write_file(path, json_text(object, 1) + "\n");
}

std::optional<std::vector<PathSurrogate>> read_surrogates(const std::filesystem::path& path,
                                                          const body::BodyModel& model,
                                                          const std::string& key) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return std::nullopt;
  try {
    const ordered_json object = parse_ordered_json(read_text_file(path));
    if (object.value("kind", "") != kKind) {
      throw ReadError(path, 0, "this is no file of path surrogates; it is left as it is, give another name");
    }
    if (object.value("version", 0) != kVersion || object.value("key", "") != key) return std::nullopt;
    std::vector<PathSurrogate> all;
    for (const ordered_json& entry : object.at("muscles")) {
      all.push_back(surrogate_of(model, entry));
      if (all.size() > model.muscles.size()) break;
      check(all.back(), model.muscles[all.size() - 1].name, path);
    }
    if (all.size() != model.muscles.size())
      throw ReadError(path, 0,
                      fmt::format("expected {} muscles, found {}", model.muscles.size(), object.at("muscles").size()));
    return all;
  } catch (const nlohmann::json::exception& error) {
    throw ReadError(path, 0,
                    fmt::format("cannot be read as path surrogates ({}); delete the file, it will be made again",
                                json_error_text(error)));
  }
}

}  // namespace myoid::body
