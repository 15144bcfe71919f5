#include "myoid/page/html.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include <fmt/format.h>

#include "myoid/page/change_forest.h"
#include "myoid/page/forest.h"
#include "myoid/page/light.h"
#include "myoid/page/page_style.h"
#include "myoid/page/strip_grid.h"
#include "myoid/page/svg_plot.h"
#include "myoid/page/tables.h"
#include "myoid/page/typeset.h"
#include "myoid/page/viewer_bundle.h"

namespace myoid::page {
namespace {

constexpr std::size_t kMostInTitle = 200;  // characters

/// Longer cells may be broken into lines.
constexpr std::size_t kShortCell = 30;

/// Writes the gates worst first, otherwise in the order given.
std::string gates_html(const std::vector<Gate>& gates) {
  if (gates.empty()) return "";
  std::string text =
      "<div class=\"wide gates\"><table><caption>Questions about the recording and the fit, the worst answers "
      "first.</caption><thead><tr><th></th><th>Question</th><th>Found</th>"
      "<th>Asked for</th><th>What follows</th></tr></thead><tbody>\n";
  for (const GateStatus status : {GateStatus::fail, GateStatus::warn, GateStatus::pass, GateStatus::info}) {
    for (const Gate& gate : gates) {
      if (gate.status != status) continue;
      text += fmt::format(
          "<tr><td><span class=\"badge {}\">{}</span></td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
          name(status), spelled(status), typeset(gate.name), typeset(gate.value), typeset(gate.threshold),
          typeset(gate.why));
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

/// Returns the words that name a row: its first cell, and the second unless it holds a number.
std::string name_of(const std::vector<Cell>& row) {
  const bool named_twice =
      row.size() > 2 && !row[1].text.empty() && std::isalpha(static_cast<unsigned char>(row[1].text.front()));
  return named_twice ? row[0].text + ' ' + row[1].text : row.front().text;
}

std::string table_html(const Table& table) {
  std::string text = fmt::format("<h3 id=\"{}\">{}</h3>\n", escape_xml(table.id), typeset(table.title));
  // On paper the reason of a number stands below it, over the whole width.
  const bool reasons = !table.columns.empty() && table.columns.back() == "why";
  text += fmt::format("<div class=\"wide{}\"><table aria-labelledby=\"{}\">", reasons ? " reasons" : "",
                      escape_xml(table.id));
  if (!table.caption.empty()) text += fmt::format("<caption>{}</caption>", typeset(table.caption));
  text += "<thead><tr>";
  for (const std::string& column : table.columns) text += fmt::format("<th>{}</th>", typeset(column));
  text += "</tr></thead><tbody>\n";
  std::vector<std::string> hints;
  for (const std::vector<Cell>& row : table.rows) {
    text += "<tr>";
    const bool several = std::ranges::count_if(row, [](const Cell& cell) { return !cell.hint.empty(); }) > 1;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const Cell& cell = row[c];
      const std::string hint = cell.hint.empty() ? "" : fmt::format(" title=\"{}\"", escape_xml(cell.hint));
      if (!cell.hint.empty()) {
        const std::string of = several ? ", " + table.columns[c] : "";
        const std::string line = fmt::format("{}{}: {}", name_of(row), of, cell.hint);
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
  text += change_forest_html(section.changes);
  for (const StripGrid& grid : section.grids) text += strip_grid_html(grid);
  for (const Table& table : section.tables) text += table_html(table);
  for (const Figure& figure : section.figures) text += figure_html(figure);
  if (!section.folded) return part_html(section.id, section.heading, text);
  return fmt::format(
      "<section>\n<details class=\"part\"><summary><h2 id=\"{}\">{}</h2></summary>\n{}</details>\n</section>\n",
      escape_xml(section.id), typeset(section.heading), text);
}

std::string answers_html(const std::vector<Answer>& answers) {
  if (answers.empty()) return "";
  std::string text = "<dl class=\"answers\">\n";
  for (const Answer& answer : answers) {
    const std::string question = typeset(answer.question);
    text += fmt::format(
        "<dt>{}</dt><dd>{}</dd>\n",
        answer.section.empty() ? question : fmt::format("<a href=\"#{}\">{}</a>", escape_xml(answer.section), question),
        typeset(answer.text));
  }
  return text + "</dl>\n";
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
      escape_xml(elided(report.title, kMostInTitle)),
      live ? fmt::format("<!-- The script below contains three.js:\n\n{}-->\n", bundle.license) : "", page_style(),
      live ? bundle.report : "");
}

}  // namespace

std::string html(const Report& report, const Workbench* workbench) {
  const bool live = workbench != nullptr && !workbench->trials.empty() && has_viewer();
  std::string text = head_html(report, live);
  const bool refused = !report.gates.empty() && light_of(report.gates).status == GateStatus::fail;
  text += fmt::format("<body{}>\n<header>\n<h1>{}</h1>\n", refused ? " class=\"refused\"" : "",
                      escape_xml(elided(report.title, kMostInTitle)));
  if (!report.subtitle.empty()) text += fmt::format("<div class=\"subtitle\">{}</div>\n", typeset(report.subtitle));
  text += light_html(report.gates);
  if (!report.headline.empty()) text += fmt::format("<p class=\"headline\">{}</p>\n", typeset(report.headline));
  text += answers_html(report.answers);
  for (const Link& link : report.links)
    text += fmt::format("<p><a href=\"{}\">{}</a></p>\n", url_path(link.file), typeset(link.text));
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
                      "<div class=\"wide facts\"><table><caption>Files with their hashes, times of the stages, "
                      "options.</caption><tbody>\n" +
                          rows + "</tbody></table></div>\n");
  }
  text += "</main>\n";
  if (live) text += scripts_html(report, *workbench);
  return text + "</body>\n</html>\n";
}

}  // namespace myoid::page
