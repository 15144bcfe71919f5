#include "myoid/report/json_values.h"

#include <cmath>

namespace myoid::report {

using nlohmann::ordered_json;

ordered_json number_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json provenance_json(const Provenance& provenance) {
  ordered_json object;
  object["program"] = provenance.program;
  object["version"] = provenance.version;
  object["command"] = provenance.command;
  object["inputs"] = ordered_json::array();
  for (const InputFile& file : provenance.inputs)
    object["inputs"].push_back({{"path", file.path}, {"sha256", file.sha256}});
  object["options"] = provenance.options_json.empty()
                          ? ordered_json::object()
                          : ordered_json::parse(provenance.options_json);
  return object;
}

}  // namespace myoid::report
