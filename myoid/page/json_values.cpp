#include "myoid/page/json_values.h"

#include <cmath>
#include <vector>

#include "myoid/ground/core/json_text.h"
#include "myoid/page/packing.h"

namespace myoid::page {

using nlohmann::ordered_json;

ordered_json number_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json matrix_json(const Eigen::MatrixXd& matrix) {
  return array_of(matrix.rowwise(), [](const auto& row) { return array_of(row, number_or_null); });
}

ordered_json packed_json(const Eigen::Ref<const Eigen::VectorXd>& values) {
  const PackedNumbers p = packed(values);
  return {{"lower", p.lower}, {"upper", p.upper}, {"codes", packed_codes(p.codes)}};
}

ordered_json clock_json(const Eigen::VectorXd& time_s) {
  const Eigen::Index n = time_s.size();
  const double step = n > 1 ? (time_s[n - 1] - time_s[0]) / static_cast<double>(n - 1) : 0.0;
  bool even = true;
  for (Eigen::Index i = 0; i < n; ++i)
    even = even && std::abs(time_s[i] - time_s[0] - static_cast<double>(i) * step) < 1e-7;
  if (even) return {{"start", time_s[0]}, {"step", step}, {"count", n}};
  return {{"times", base64(std::vector<float>(time_s.begin(), time_s.end()))}};
}

ordered_json provenance_json(const Provenance& provenance) {
  ordered_json object;
  object["program"] = provenance.program;
  object["version"] = provenance.version;
  object["command"] = provenance.command;
  object["inputs"] = array_of(provenance.inputs, [](const InputFile& file) -> ordered_json {
    return {{"path", file.path}, {"sha256", file.sha256}};
  });
  object["options"] =
      provenance.options_json.empty() ? ordered_json::object() : parse_ordered_json(provenance.options_json);
  return object;
}

std::string embedded(const ordered_json& json) {
  const std::string text = json_text(json, -1);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

}  // namespace myoid::page
