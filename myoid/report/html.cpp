#include "myoid/report/html.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "myoid/report/forest.h"
#include "myoid/report/light.h"
#include "myoid/report/strip_grid.h"
#include "myoid/report/svg_plot.h"
#include "myoid/report/tables.h"
#include "myoid/report/typeset.h"
#include "myoid/report/viewer_bundle.h"

namespace myoid::report {
namespace {

constexpr std::string_view kStyle = R"(
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1640px; padding: 28px 24px 60px; background: #fff; color: #22262b;
  font: 15px/1.5 Helvetica, Arial, sans-serif; }
h1, h2, h3, p, li, figcaption { overflow-wrap: anywhere; }
h1 { font-size: 26px; line-height: 1.2; margin: 0 0 2px; }
h2 { font-size: 19px; margin: 38px 0 8px; padding-bottom: 4px; border-bottom: 1px solid #d5d9de; }
h3 { font-size: 15px; margin: 22px 0 4px; }
p { margin: 6px 0 10px; max-width: 74ch; }
.subtitle, .caption, .hints { color: #5a626b; }
.caption, .hints { font-size: 13px; }
.headline { font-size: 17px; margin: 16px 0 12px; max-width: 90ch; }
.light { display: flex; gap: 14px; align-items: center; margin: 12px 0; padding: 10px 14px; border: 1px solid; border-radius: 8px; }
.light p { margin: 0; max-width: 100ch; } .light ul { margin: 4px 0 0; padding-left: 18px; max-width: 100ch; } .light svg { flex: none; fill: currentColor; }
.light .sign { fill: none; stroke: #fff; stroke-width: 4; }
.forest { margin: 10px 0 22px; }
.forest table { width: 100%; max-width: 1180px; }
.forest td, .forest th { padding: 1px 12px 1px 0; vertical-align: middle; }
.forest .bar { width: 28%; min-width: 120px; overflow: visible; padding-right: 22px; }
.forest svg.bar { width: 100%; display: block; padding: 0; }
.forest .number, .forest .badge { white-space: nowrap; }
.forest .bar text { font-size: 11px; fill: #5a626b; }
.forest .prior { fill: #dfe3e8; background: #dfe3e8; } .forest .middle { stroke: #8a9097; stroke-dasharray: 2 3; }
.forest .truth { stroke: #111; stroke-width: 2; background: #111; }
.legend { font-size: 13px; max-width: none; margin: 6px 0; } .legend span { display: inline-block; margin-right: 18px; }
.legend i { display: inline-block; width: 24px; height: 10px; } .legend i.truth { width: 3px; height: 14px; vertical-align: -2px; }
.mark { vertical-align: -3px; }
.forest td { border-bottom: 0; } .forest tr.first td { border-top: 1px solid #d5d9de; }
.forest tr:not(.first) td:first-child { color: #a8aeb5; }
.beside th { padding-top: 10px; color: #5a626b; }
details.reading { font-size: 13px; margin: 4px 0; } .reading summary { color: #1f5fa8; cursor: pointer; }
details.part > summary { cursor: pointer; } details.part h2 { display: inline-block; }
.reading dl { margin: 6px 0; max-width: 90ch; } .reading dt { font-weight: 600; } .reading dd { margin: 0 0 6px; }
nav { display: flex; flex-wrap: wrap; font-size: 13px; margin: 12px 0 0; padding: 6px 0; position: sticky; top: 0; z-index: 20; background: #fff; }
h2 { scroll-margin-top: 44px; }
.why > summary { cursor: pointer; list-style: none; } .why > summary::-webkit-details-marker { display: none; }
.why[open] { max-width: 40ch; white-space: normal; }
.refused .forest td, .refused .headline { color: #767d85; } .refused .forest svg.bar { opacity: .45; }
nav a { margin-right: 14px; white-space: nowrap; }
a { color: #1f5fa8; }
.grid { margin: 10px 0 26px; }
.grid table { width: 100%; table-layout: fixed; max-width: 1400px; }
.grid th, .grid td { padding: 0 14px 0 0; border-bottom: 1px solid #eef0f2; vertical-align: middle; }
.grid th:first-child, .grid td:first-child { width: 15%; overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
.grid thead th { vertical-align: bottom; padding-top: 6px; } .grid thead small { display: flex; justify-content: space-between; font-weight: 400; color: #5a626b; }
.grid tbody tr:hover td, .grid tbody tr:focus-within td { background: #f3f6fa; }
.grid svg.strip { width: 100%; height: 20px; display: block; overflow: visible; }
.grid .spread { fill: #e6eaef; } .grid .middle { stroke: #8a9097; stroke-dasharray: 2 3; } .grid .truth { stroke: #111; stroke-width: 2; }
.grid .ring { fill: none; stroke: #b3261e; stroke-width: 2; } .grid .untold { opacity: .35; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 13px; margin: 6px 0; }
th, td { text-align: left; vertical-align: top; padding: 4px 12px 4px 0; border-bottom: 1px solid #e6e8eb; }
th { font-weight: 600; border-bottom: 1px solid #8a9097; vertical-align: bottom; }
td { font-variant-numeric: tabular-nums; }
td.short { white-space: nowrap; }
.badge { display: inline-block; padding: 0 7px; border-radius: 9px; font-size: 12px; font-weight: 600;
  white-space: nowrap; border: 1px solid; }
.pass, .good { color: #14602f; background: #e4f4e9; border-color: #9fd3b1; }
.warn, .weak { color: #7a4b00; background: #fff3d6; border-color: #e8c778; }
.fail, .bad { color: #8e1c1c; background: #fde6e4; border-color: #eba8a2; }
.info { color: #24507f; background: #e6f0fa; border-color: #a9c8e8; }
.repeat { color: #5b2a6c; background: #f4eaf7; border-color: #cfaedb; }
figure { margin: 18px 0; break-inside: avoid; }
figure > svg { width: 100%; max-width: 1000px; height: auto; display: block; }
.save { font-size: 12px; margin: 2px 0; }
figcaption { font-size: 13px; color: #5a626b; margin-top: 4px; }
figcaption b { color: #22262b; }
ul { margin: 6px 0; padding-left: 20px; }
li { margin: 3px 0; max-width: 74ch; }
@media (max-width: 760px) { body { padding: 16px 12px 40px; } .wide-only { display: none; } .forest { font-size: 12px; }
  .forest td, .forest th, .grid td, .grid th { padding-right: 6px; } .grid { font-size: 12px; overflow-x: auto; } .grid table { min-width: 620px; }
  .grid th:first-child, .grid td:first-child { width: 24%; } .forest .bar { min-width: 70px; }
  nav { flex-wrap: nowrap; overflow-x: auto; }
  .gates table { min-width: 0; } .gates thead { display: none; } .gates tr { display: block; padding: 8px 0; border-bottom: 1px solid #e6e8eb; }
  .gates td { display: block; border: 0; padding: 1px 0; } .gates td:nth-child(2) { font-weight: 600; }
  .gates td:nth-child(3)::before { content: "Found: "; } .gates td:nth-child(4)::before { content: "Asked for: "; } }
@media (max-width: 560px) { .forest .bar { display: none; } }
@media (prefers-reduced-motion: reduce) { * { animation: none !important; transition: none !important; scroll-behavior: auto !important; } }
code { font: 12px/1.4 Menlo, Consolas, monospace; overflow-wrap: anywhere; }
@media print { body { max-width: none; padding: 0; font-size: 11pt; } nav { display: none; }
  h2, h3 { break-after: avoid; } tr { break-inside: avoid; } a { color: inherit; text-decoration: none; }
  .badge, .light, .forest, .grid { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  .forest tr, .grid tr { break-inside: avoid; } .save, details:not([open]):not(.why) { display: none; } @page { size: A4; margin: 14mm; } }
)";

constexpr std::size_t kMostInTitle = 200;  // characters

/// Longer cells may be broken into lines.
constexpr std::size_t kShortCell = 30;

/// Writes the gates worst first, otherwise in the order given.
std::string gates_html(const std::vector<Gate>& gates) {
  if (gates.empty()) return "";
  std::string text =
      "<div class=\"wide gates\"><table><thead><tr><th></th><th>Question</th><th>Found</th>"
      "<th>Asked for</th><th>What follows</th></tr></thead><tbody>\n";
  for (const auto& [status, word] : {std::pair{GateStatus::fail, "failed"}, std::pair{GateStatus::warn, "caution"},
                                     std::pair{GateStatus::pass, "passed"}, std::pair{GateStatus::info, "note"}}) {
    for (const Gate& gate : gates) {
      if (gate.status != status) continue;
      text += fmt::format(
          "<tr><td><span class=\"badge {}\">{}</span></td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
          name(status), word, typeset(gate.name), typeset(gate.value), typeset(gate.threshold), typeset(gate.why));
    }
  }
  return text + "</tbody></table></div>\n";
}

std::string items_html(const std::vector<std::string>& texts) {
  std::string items;
  for (const std::string& text : texts) items += fmt::format("<li>{}</li>\n", typeset(text));
  return items;
}

std::string part_html(std::string_view id, std::string_view heading, std::string_view content) {
  return fmt::format("<section>\n<h2 id=\"{}\">{}</h2>\n{}</section>\n", escape_xml(id), typeset(heading), content);
}

std::string table_html(const Table& table) {
  std::string text = fmt::format("<h3 id=\"{}\">{}</h3>\n", escape_xml(table.id), typeset(table.title));
  if (!table.caption.empty()) text += fmt::format("<p class=\"caption\">{}</p>\n", typeset(table.caption));
  text += "<div class=\"wide\"><table aria-labelledby=\"" + escape_xml(table.id) + "\"><thead><tr>";
  for (const std::string& column : table.columns) text += fmt::format("<th>{}</th>", typeset(column));
  text += "</tr></thead><tbody>\n";
  std::vector<std::string> hints;
  for (const std::vector<Cell>& row : table.rows) {
    text += "<tr>";
    for (const Cell& cell : row) {
      const std::string hint = cell.hint.empty() ? "" : fmt::format(" title=\"{}\"", escape_xml(cell.hint));
      if (!cell.hint.empty()) {
        // The first two cells name a row: muscle and parameter.
        const std::string row_name = row.size() > 2 ? row[0].text + ' ' + row[1].text : row.front().text;
        const std::string line = fmt::format("{}: {}", row_name, cell.hint);
        if (std::ranges::find(hints, line) == hints.end()) hints.push_back(line);
      }
      const std::string inner = cell.badge == Badge::none ? typeset(cell.text)
                                                          : fmt::format("<span class=\"badge {}\">{}</span>",
                                                                        name(cell.badge), typeset(cell.text));
      text += fmt::format("<td{}{}>{}</td>", cell.text.size() <= kShortCell ? " class=\"short\"" : "", hint, inner);
    }
    text += "</tr>\n";
  }
  text += "</tbody></table></div>\n";
  if (!hints.empty()) {
    // On paper there is no pointer: the hints become a list.
    text += "<ul class=\"hints\">\n" + items_html(hints) + "</ul>\n";
  }
  return text;
}

/// Returns the three answers that a reader of a figure needs.
std::string reading_html(const Figure& figure) {
  if (figure.bad.empty() && figure.act.empty()) return "";
  return fmt::format(
      "<details class=\"reading\"><summary>How to read this</summary><dl><dt>What this shows</dt>"
      "<dd>{}</dd><dt>What bad looks like</dt><dd>{}</dd><dt>What to do</dt><dd>{}</dd></dl>"
      "</details>\n",
      typeset(figure.caption), typeset(figure.bad), typeset(figure.act));
}

/// Returns the panels that the page draws.
Figure on_page(Figure figure) {
  const auto most = static_cast<std::size_t>(figure.most_on_page);
  if (most > 0 && figure.panels.size() > most) {
    figure.caption += fmt::format(" The first {} of {} panels; the files hold all.", most, figure.panels.size());
    figure.panels.resize(most);
  }
  return figure;
}

std::string figure_html(const Figure& whole) {
  const Figure figure = on_page(whole);
  const std::string id = escape_xml(figure.id);
  return fmt::format(
      "<figure id=\"{0}\"{1}>\n{2}<figcaption><b>{3}.</b> {4}</figcaption>\n{5}"
      "<p class=\"save\"><a href=\"figures/{0}.csv\">CSV</a> <a href=\"figures/{0}.svg\">SVG</a>"
      "</p>\n</figure>\n",
      id, figure.in_workbench ? " class=\"in-workbench\"" : "", svg_plot(figure), typeset(figure.title),
      typeset(figure.caption), reading_html(figure));
}

std::string section_html(const Section& section) {
  std::string text;
  for (const std::string& paragraph : section.paragraphs) text += fmt::format("<p>{}</p>\n", typeset(paragraph));
  text += gates_html(section.gates);
  for (const StripGrid& grid : section.grids) text += strip_grid_html(grid);
  for (const Table& table : section.tables) text += table_html(table);
  for (const Figure& figure : section.figures) text += figure_html(figure);
  if (!section.folded) return part_html(section.id, section.heading, text);
  return fmt::format(
      "<section>\n<details class=\"part\"><summary><h2 id=\"{}\">{}</h2></summary>\n{}</details>\n</section>\n",
      escape_xml(section.id), typeset(section.heading), text);
}

/// Returns the scripts of the workbench: its values, its scenes and the program that shows them.
std::string scripts_html(const Report& report, const Workbench& workbench) {
  std::string text = fmt::format("<script type=\"application/json\" id=\"workbench-data\">{}</script>\n",
                                 workbench_json(workbench, report));
  if (!workbench.scenes.scenes.empty())
    text += fmt::format("<script type=\"application/json\" id=\"scene\">{}</script>\n", scenes_json(workbench.scenes));
  return text + fmt::format("<script>{}</script>\n", viewer_bundle().script);
}

std::string head_html(const Report& report, bool live) {
  const ViewerBundle bundle = viewer_bundle();
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{}</title>\n{}<style>{}{}</style>\n</head>\n",
      escape_xml(recording::elided(report.title, kMostInTitle)),
      live ? fmt::format("<!-- The script below contains three.js:\n\n{}-->\n", bundle.license) : "", kStyle,
      live ? bundle.report : "");
}

}  // namespace

std::string html(const Report& report, const Workbench* workbench) {
  const bool live = workbench != nullptr && !workbench->trials.empty() && has_viewer();
  std::string text = head_html(report, live);
  const bool refused = !report.gates.empty() && light_of(report.gates).status == GateStatus::fail;
  text += fmt::format("<body{}>\n<header>\n<h1>{}</h1>\n", refused ? " class=\"refused\"" : "",
                      escape_xml(recording::elided(report.title, kMostInTitle)));
  if (!report.subtitle.empty()) text += fmt::format("<div class=\"subtitle\">{}</div>\n", typeset(report.subtitle));
  if (!report.headline.empty()) {
    const bool next = std::ranges::any_of(report.sections, [](const Section& section) { return section.id == "next"; });
    text += fmt::format("<p class=\"headline\">{}{}</p>\n", typeset(report.headline),
                        next ? " <a href=\"#next\">What to record next</a>" : "");
  }
  text += light_html(report.gates);
  for (const Link& link : report.links)
    text += fmt::format("<p><a href=\"{}\">{}</a></p>\n", recording::url_path(link.file), typeset(link.text));
  text += "</header>\n<nav class=\"contents\">";
  const auto links_to = [&](bool before_numbers) {
    for (const Section& section : report.sections)
      if (section.before_numbers == before_numbers)
        text += fmt::format("<a href=\"#{}\">{}</a>", escape_xml(section.id), typeset(section.heading));
  };
  links_to(true);
  if (!report.forest.empty()) text += "<a href=\"#numbers\">All numbers</a>";
  if (live) text += "<a class=\"live-only\" href=\"#workbench\" hidden>Workbench</a>";
  if (!report.gates.empty()) text += "<a href=\"#quality\">Quality</a>";
  links_to(false);
  text += "</nav>\n<main>\n";
  for (const Section& section : report.sections)
    if (section.before_numbers) text += section_html(section);
  if (!report.forest.empty()) text += part_html("numbers", "All numbers", forest_html(report.forest));
  if (live) text += "<section id=\"workbench\" class=\"workbench\" hidden></section>\n";
  if (!report.gates.empty())
    text += part_html("quality", "Quality of the data and of the fit", gates_html(report.gates));
  for (const Section& section : report.sections)
    if (!section.before_numbers) text += section_html(section);
  if (!report.assumptions.empty()) {
    text += part_html("assumptions", "Assumptions", "<ul>\n" + items_html(report.assumptions) + "</ul>\n");
  }
  if (!report.provenance.empty()) {
    std::string rows;
    for (const ProvenanceRow& row : report.provenance)
      rows +=
          fmt::format("<tr><td>{}</td><td><code>{}</code></td></tr>\n", escape_xml(row.what), escape_xml(row.value));
    text += part_html("provenance", "Where this comes from",
                      "<div class=\"wide\"><table><tbody>\n" + rows + "</tbody></table></div>\n");
  }
  text += "</main>\n";
  if (live) text += scripts_html(report, *workbench);
  return text + "</body>\n</html>\n";
}

}  // namespace myoid::report
