#include "myoid/page/write_report.h"

#include <nlohmann/json.hpp>

#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/page/html.h"
#include "myoid/page/json_values.h"
#include "myoid/page/strip_grid.h"
#include "myoid/page/svg_plot.h"
#include "myoid/page/tables.h"

namespace myoid::page {
namespace {

using Json = nlohmann::ordered_json;

Json gate_json(const Gate& gate) {
  return {{"name", gate.name},
          {"status", name(gate.status)},
          {"value", gate.value},
          {"threshold", gate.threshold},
          {"why", gate.why}};
}

Json cell_json(const Cell& cell) {
  Json entry = {{"text", cell.text}};
  if (cell.badge != Badge::none) entry["badge"] = name(cell.badge);
  if (!cell.hint.empty()) entry["hint"] = cell.hint;
  return entry;
}

Json table_json(const Table& table) {
  const auto row_json = [](const std::vector<Cell>& row) { return array_of(row, cell_json); };
  return {{"id", table.id},
          {"title", table.title},
          {"caption", table.caption},
          {"columns", table.columns},
          {"rows", array_of(table.rows, row_json)}};
}

Json drawing_json(const Figure& figure) {
  return {{"id", figure.id}, {"title", figure.title}, {"caption", figure.caption}};
}

Json section_json(const Section& section) {
  return {{"id", section.id},
          {"heading", section.heading},
          {"paragraphs", section.paragraphs},
          {"gates", array_of(section.gates, gate_json)},
          {"tables", array_of(section.tables, table_json)},
          {"figures", array_of(section.figures, drawing_json)}};
}

}  // namespace

std::string report_json(const Report& report) {
  const auto link_json = [](const Link& link) { return Json{{"text", link.text}, {"file", link.file}}; };
  const auto answer_json = [](const Answer& answer) {
    return Json{{"question", answer.question}, {"text", answer.text}};
  };
  const auto fact_json = [](const ProvenanceRow& row) { return Json{{"what", row.what}, {"value", row.value}}; };
  return json_text({{"title", report.title},
                    {"subtitle", report.subtitle},
                    {"headline", report.headline},
                    {"answers", array_of(report.answers, answer_json)},
                    {"gates", array_of(report.gates, gate_json)},
                    {"links", array_of(report.links, link_json)},
                    {"sections", array_of(report.sections, section_json)},
                    {"assumptions", report.assumptions},
                    {"provenance", array_of(report.provenance, fact_json)}}) +
         '\n';
}

void write_figure(const Figure& figure, const std::filesystem::path& directory) {
  write_file(directory / "figures" / (figure.id + ".svg"), svg_plot(figure));
  write_file(directory / "figures" / (figure.id + ".csv"), figure_csv(figure));
}

void write_report(Report report, const std::filesystem::path& directory, const Workbench* workbench, Kept kept) {
  validate(report);
  make_ids(report);
  for (const Section& section : report.sections) {
    if (kept != Kept::all) break;
    for (const Table& table : section.tables) write_file(directory / "tables" / (table.id + ".csv"), table_csv(table));
    for (const StripGrid& grid : section.grids)
      write_file(directory / "tables" / (grid.id + ".csv"), strip_grid_csv(grid));
    for (const Figure& figure : section.figures) write_figure(figure, directory);
  }
  write_file(directory / "report.json", report_json(report));
  if (kept != Kept::tables) write_file(directory / "report.html", html(report, workbench));
}

}  // namespace myoid::page
