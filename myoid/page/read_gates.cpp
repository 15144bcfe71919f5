#include "myoid/page/read_gates.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/page/tables.h"

namespace myoid::page {

UnpassedGates read_gates(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "report.json";
  UnpassedGates gates;
  if (!std::filesystem::exists(file)) return gates;
  try {
    const nlohmann::json report = parse_json(read_text_file(file));
    for (const nlohmann::json& gate : report.at("gates")) {
      const auto status = gate.at("status").get<std::string>();
      if (status == page::name(page::GateStatus::fail)) gates.failed.push_back(gate.at("name").get<std::string>());
      if (status == page::name(page::GateStatus::warn)) gates.warned.push_back(gate.at("name").get<std::string>());
    }
  } catch (const nlohmann::json::exception& error) {
    throw ReadError(file, 0, fmt::format("is damaged: {}; run the study again", json_error_text(error)));
  }
  return gates;
}

}  // namespace myoid::page
