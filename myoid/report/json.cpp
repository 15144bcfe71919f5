#include "myoid/report/json.h"

#include <nlohmann/json.hpp>

#include "myoid/core/json_text.h"
#include "myoid/report/tables.h"

namespace myoid::report {
namespace {

using Json = nlohmann::ordered_json;

Json gates_json(const std::vector<Gate>& gates) {
  Json result = Json::array();
  for (const Gate& gate : gates) {
    result.push_back({{"name", gate.name},
                      {"status", name(gate.status)},
                      {"value", gate.value},
                      {"threshold", gate.threshold},
                      {"why", gate.why}});
  }
  return result;
}

Json table_json(const Table& table) {
  Json rows = Json::array();
  for (const std::vector<Cell>& row : table.rows) {
    Json cells = Json::array();
    for (const Cell& cell : row) {
      Json entry = {{"text", cell.text}};
      if (cell.badge != Badge::none) entry["badge"] = name(cell.badge);
      if (!cell.hint.empty()) entry["hint"] = cell.hint;
      cells.push_back(entry);
    }
    rows.push_back(cells);
  }
  return {
      {"id", table.id}, {"title", table.title}, {"caption", table.caption}, {"columns", table.columns}, {"rows", rows}};
}

}  // namespace

std::string report_json(const Report& report) {
  Json sections = Json::array();
  for (const Section& section : report.sections) {
    Json tables = Json::array();
    for (const Table& table : section.tables) tables.push_back(table_json(table));
    Json figures = Json::array();
    for (const Figure& figure : section.figures) {
      figures.push_back({{"id", figure.id}, {"title", figure.title}, {"caption", figure.caption}});
    }
    sections.push_back({{"id", section.id},
                        {"heading", section.heading},
                        {"paragraphs", section.paragraphs},
                        {"gates", gates_json(section.gates)},
                        {"tables", tables},
                        {"figures", figures}});
  }
  Json links = Json::array();
  for (const Link& link : report.links) links.push_back({{"text", link.text}, {"file", link.file}});
  Json provenance = Json::array();
  for (const ProvenanceRow& row : report.provenance) {
    provenance.push_back({{"what", row.what}, {"value", row.value}});
  }
  const Json json = {{"title", report.title},
                     {"subtitle", report.subtitle},
                     {"headline", report.headline},
                     {"gates", gates_json(report.gates)},
                     {"links", links},
                     {"sections", sections},
                     {"assumptions", report.assumptions},
                     {"provenance", provenance}};
  // Invalid UTF-8 (in a file name, for instance) is shown with a replacement character, not refused.
  return json_text(json) + '\n';
}

}  // namespace myoid::report
