#include "myoid/page/change_forest.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "myoid/page/svg_plot.h"
#include "myoid/page/tables.h"
#include "myoid/page/typeset.h"
#include "myoid/page/verdict_mark.h"

namespace myoid::page {
namespace {

constexpr double kMostChanges = 3.0;  // end of the scale, in smallest detectable changes

/// The look of a session: its color, and its mark about the origin.
struct SessionMark {
  std::string_view color, path;
};
constexpr SessionMark kFirst{"#1f5fa8", "M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0Z"};
constexpr SessionMark kSecond{"#d1491b", "M0 -6L6 0L0 6L-6 0Z"};

/// Returns the place of a change in the drawing, in percent of its width.
double change_percent(double change) {
  return 50.0 + 50.0 * std::clamp(change, -kMostChanges, kMostChanges) / kMostChanges;
}

std::string interval_text(const SessionValue& of) {
  return of.lower && of.upper ? fmt::format(" ({})", format_interval(*of.lower, *of.upper)) : "";
}

std::string value_text(const SessionValue& of) {
  return format_beside(of.value, of.lower, of.upper) + interval_text(of);
}

std::string mark(const SessionMark& session) {
  return fmt::format("<path d=\"{}\" fill=\"{}\"/>", session.path, session.color);
}

std::string session_bar(const ChangeRow& row, const SessionValue& of, const SessionMark& session, int y) {
  const auto change = [&](double value) { return (value - row.first.value) / *row.detectable; };
  std::string svg;
  if (of.lower && of.upper) {
    svg +=
        fmt::format("<line x1=\"{0:.2f}%\" x2=\"{1:.2f}%\" y1=\"{2}\" y2=\"{2}\" stroke=\"{3}\" stroke-width=\"3\"/>",
                    change_percent(change(*of.lower)), change_percent(change(*of.upper)), y, session.color);
  }
  const double at = change(of.value);
  if (std::abs(at) > kMostChanges)
    return svg + fmt::format("<svg y=\"{}\" height=\"1\" overflow=\"visible\">{}</svg>", y,
                             beyond_arrow(at < 0.0 ? -1 : 1, session.color));
  return svg +
         fmt::format("<svg x=\"{:.2f}%\" y=\"{}\" overflow=\"visible\">{}</svg>", change_percent(at), y, mark(session));
}

std::string bar(const ChangeRow& row) {
  const std::string sentence = fmt::format("{} {}: first {}, second {} {}, {}", row.owner, row.name,
                                           value_text(row.first), value_text(row.second), row.unit, row.verdict);
  std::string svg = fmt::format("<svg class=\"bar\" width=\"100%\" height=\"28\" role=\"img\"><title>{}</title>",
                                escape_xml(typographic(sentence)));
  if (!row.detectable || !(*row.detectable > 0.0))
    return svg + "<text x=\"50%\" y=\"18\" text-anchor=\"middle\">not compared</text></svg>";
  svg += fmt::format(
      "<rect x=\"{:.2f}%\" width=\"{:.2f}%\" y=\"1\" height=\"26\" class=\"prior\"/>"
      "<line x1=\"50%\" x2=\"50%\" y1=\"0\" y2=\"28\" class=\"middle\"/>",
      change_percent(-1.0), change_percent(1.0) - change_percent(-1.0));
  return svg + session_bar(row, row.first, kFirst, 9) + session_bar(row, row.second, kSecond, 19) + "</svg>";
}

std::string legend(const ChangeForest& forest) {
  const auto entry = [](const SessionMark& session, const std::string& name) {
    return fmt::format(
        "<span><svg class=\"mark\" width=\"16\" height=\"16\" viewBox=\"-8 -8 16 16\" aria-hidden=\"true\">{}</svg> "
        "<b>{}</b></span> ",
        mark(session), typeset(name));
  };
  return "<p class=\"legend\">" + entry(kFirst, forest.first) + entry(kSecond, forest.second) +
         "<span>\u2014 95 % interval</span> <span><i class=\"prior\"></i> changes that these recordings cannot "
         "see</span></p>\n";
}

std::string row_html(const ChangeRow& row, bool first) {
  return fmt::format(
      "<tr{}><td>{}</td><td>{}{}</td><td class=\"bar\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
      "<td><span class=\"badge {}\">{}</span></td></tr>\n",
      first ? " class=\"first\"" : "", typeset(row.owner), typeset(row.name),
      row.unit.empty() ? "" : fmt::format(" [{}]", escape_xml(row.unit)), bar(row), value_text(row.first),
      value_text(row.second), name(row.badge), typeset(row.verdict));
}

}  // namespace

std::string change_forest_html(const ChangeForest& forest) {
  if (forest.rows.empty()) return "";
  std::string text = fmt::format(
      "<figure class=\"forest changes\">\n{}<table><caption>Each number of both sessions, the first in the "
      "middle. "
      "A mark of the second outside of the grey field is a change, unless so many numbers are compared that chance "
      "explains it.</caption><thead><tr><th>muscle</th><th>number</th><th class=\"bar\"></th><th>{}</th><th>{}</th>"
      "<th>verdict</th></tr></thead>\n<tbody>\n",
      legend(forest), typeset(forest.first), typeset(forest.second));
  const std::string* owner = nullptr;
  for (const ChangeRow& row : forest.rows) {
    text += row_html(row, owner == nullptr || *owner != row.owner);
    owner = &row.owner;
  }
  return text + "</tbody>\n</table>\n</figure>\n";
}

}  // namespace myoid::page
