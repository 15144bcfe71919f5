#include "myoid/page/forest.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/page/svg_plot.h"
#include "myoid/page/tables.h"
#include "myoid/page/typeset.h"
#include "myoid/page/verdict_mark.h"

namespace myoid::page {
namespace {

constexpr std::size_t kMostInRowWord = 100;  // characters

constexpr double kEnd = 4.0;  // end of the scale, in standard deviations of the prior
constexpr double k95 = 1.96;

/// Returns the place of z in the drawing, in percent of its width.
double percent(double z) { return 50.0 + 50.0 * std::clamp(z, -kEnd, kEnd) / kEnd; }

std::string number(const ForestRow& row, double value) { return format_beside(value, row.lower, row.upper); }

std::string interval(const ForestRow& row) {
  return row.lower && row.upper ? format_interval(*row.lower, *row.upper) : std::string("none");
}

bool has_given(const ForestRow& row) { return row.given_lower && row.given_upper; }

std::string given_interval(const ForestRow& row) {
  return has_given(row) ? format_interval(*row.given_lower, *row.given_upper) : std::string("–");
}

/// Returns the literature's 95 %; a number that is positive by nature has no negative end.
std::string prior(const ForestRow& row) {
  if (!row.prior_mean || !row.prior_sd) return "–";
  const double lower = *row.prior_mean - k95 * *row.prior_sd;
  return format_interval(*row.prior_mean > 0.0 ? std::max(0.0, lower) : lower, *row.prior_mean + k95 * *row.prior_sd);
}

std::string bar(const ForestRow& row) {
  const std::string given = has_given(row) ? fmt::format(", given geometry and sensors {}", given_interval(row)) : "";
  const std::string sentence =
      fmt::format("{} {}: {} {}, 95 % interval {}{}, literature {}, {}", row.owner, row.name, number(row, row.estimate),
                  row.unit, interval(row), given, prior(row), row.verdict);
  std::string svg = fmt::format("<svg class=\"bar\" width=\"100%\" height=\"22\" role=\"img\"><title>{}</title>",
                                escape_xml(typographic(with_short_words(sentence, kMostInRowWord))));
  if (!row.prior_mean || !row.prior_sd || !(*row.prior_sd > 0.0))
    return svg + "<text x=\"50%\" y=\"15\" text-anchor=\"middle\" class=\"none\">no prior</text></svg>";
  const auto z = [&](double x) { return (x - *row.prior_mean) / *row.prior_sd; };
  svg += fmt::format(
      "<rect x=\"{:.2f}%\" width=\"{:.2f}%\" y=\"3\" height=\"16\" class=\"prior\"/>"
      "<line x1=\"50%\" x2=\"50%\" y1=\"0\" y2=\"22\" class=\"middle\"/>",
      percent(-k95), percent(k95) - percent(-k95));
  const std::string_view color = verdict_color(row.badge);
  const auto line = [&](double from, double to, int width) {
    return fmt::format("<line x1=\"{:.2f}%\" x2=\"{:.2f}%\" y1=\"11\" y2=\"11\" stroke=\"{}\" stroke-width=\"{}\"/>",
                       percent(z(from)), percent(z(to)), color, width);
  };
  if (row.lower && row.upper) {
    svg += line(*row.lower, *row.upper, has_given(row) ? 2 : 3);
    if (z(*row.lower) < -kEnd) svg += beyond_arrow(-1, color);
    if (z(*row.upper) > kEnd) svg += beyond_arrow(1, color);
  }
  if (has_given(row)) svg += line(*row.given_lower, *row.given_upper, 7);
  if (row.truth)
    svg += fmt::format("<line x1=\"{0:.2f}%\" x2=\"{0:.2f}%\" y1=\"1\" y2=\"21\" class=\"truth\"/>",
                       percent(z(*row.truth)));
  return svg + fmt::format("<svg x=\"{:.2f}%\" y=\"50%\" overflow=\"visible\">{}</svg></svg>", percent(z(row.estimate)),
                           verdict_shape(row.badge));
}

std::string scale() {
  std::string svg = "<svg class=\"bar\" width=\"100%\" height=\"18\" aria-hidden=\"true\">";
  for (const double at : {-k95, 0.0, k95})
    svg += fmt::format("<text x=\"{:.2f}%\" y=\"13\" text-anchor=\"middle\">{}</text>", percent(at),
                       at == 0.0 ? "literature" : "95 %");
  return svg + "</svg>";
}

/// Returns a text, which a keyboard or a finger opens to read the sentence behind it.
std::string opening(const std::string& shown, const std::string& sentence) {
  if (sentence.empty()) return shown;
  return fmt::format("<details class=\"why\"><summary>{}</summary>{}</details>", shown, typeset(sentence));
}

std::string row_html(const ForestRow& row, bool first) {
  return fmt::format(
      "<tr{} data-verdict=\"{}\" title=\"{}\"><td>{}</td><td>{}</td><td class=\"bar\">{}</td>"
      "<td class=\"number\">{}{}</td><td class=\"number\">{}</td>"
      "<td class=\"number wide-only\">{}</td><td class=\"number wide-only\">{}</td>"
      "<td>{}</td></tr>\n",
      first ? " class=\"first\"" : "", escape_xml(row.verdict), escape_xml(typographic(row.why)),
      typeset(spelled(row.owner)), opening(typeset(row.name), row.about), bar(row), number(row, row.estimate),
      row.unit.empty() ? "" : " " + escape_xml(row.unit), interval(row), given_interval(row), prior(row),
      opening(fmt::format("<span class=\"badge {}\">{}</span>", name(row.badge), typeset(row.verdict)), row.why));
}

/// The advice on numbers of a verdict, the best verdict first.
constexpr std::array kAdvice{
    std::pair{Badge::good, "the recording determines it: use it"},
    std::pair{Badge::repeat, "for comparing sessions of this person, not persons"},
    std::pair{Badge::weak, "known roughly: use the interval"},
    std::pair{Badge::info, "mostly the literature's: the recording adds little"},
    std::pair{Badge::none, "this recording cannot tell"},
    std::pair{Badge::bad, "no muscle can have it: look for an error"},
};

std::string legend(const std::vector<ForestRow>& rows) {
  std::string text = "<p class=\"legend\">";
  std::vector<std::string> seen;
  for (const auto& [badge, advice] : kAdvice) {
    for (const ForestRow& row : rows) {
      if (row.badge != badge || std::ranges::find(seen, row.verdict) != seen.end()) continue;
      seen.push_back(row.verdict);
      text += fmt::format("<span>{} <b>{}</b>: {}</span> ", verdict_mark(badge), typeset(row.verdict), typeset(advice));
    }
  }
  text += std::ranges::any_of(rows, has_given)
              ? "<span>\u2014 95 % interval of the person</span> <span><b>\u2501</b> the same if geometry and sensors "
                "were exact</span> "
              : "<span>\u2014 95 % interval after the recording</span> ";
  text += "<span><i class=\"prior\"></i> the literature's 95 %</span>";
  if (std::ranges::any_of(rows, [](const ForestRow& r) { return r.truth.has_value(); }))
    text += " <span><i class=\"truth\"></i> truth of the virtual person</span>";
  return text + "</p>\n";
}

/// Returns a paragraph on the numbers whose readings differ by more than the second one allows.
std::string readings_differ(const std::vector<ForestRow>& rows) {
  std::vector<std::string> names;
  for (const ForestRow& row : rows) {
    const bool told = row.badge == Badge::good || row.badge == Badge::repeat || row.badge == Badge::weak;
    if (told && has_given(row) && (row.estimate < *row.given_lower || row.estimate > *row.given_upper))
      names.push_back(fmt::format("{} {}", spelled(row.owner), row.name));
  }
  return names.empty() ? "" : fmt::format("<p class=\"caption\">{}</p>\n", typeset(outside_given_sentence(names)));
}

}  // namespace

std::string outside_given_sentence(const std::vector<std::string>& names) {
  if (names.empty()) return "";
  return fmt::format(
      "The person's number of {} lies outside its interval given geometry and sensors: the recording speaks for moment "
      "arms, tendons or sensors other than assumed, and only the person's number follows that.",
      fmt::join(names, ", "));
}

std::string forest_html(const std::vector<ForestRow>& rows) {
  if (rows.empty()) return "";
  std::string text = "<figure id=\"forest\" class=\"forest\">\n" + legend(rows) + readings_differ(rows) +
                     "<table><caption>Each number beside the literature's. A name opens its meaning, a verdict its "
                     "reason.</caption><thead><tr><th>muscle</th><th>number</th><th class=\"bar\">" +
                     scale() +
                     "</th><th>estimate</th><th>95 % interval</th>"
                     "<th class=\"wide-only\">given geometry and sensors</th>"
                     "<th class=\"wide-only\">literature, 95 %</th><th>verdict</th></tr></thead>\n<tbody>\n";
  const auto add = [&](bool beside) {
    const std::string* owner = nullptr;
    for (const ForestRow& row : rows) {
      if (row.beside != beside) continue;
      text += row_html(row, owner == nullptr || *owner != row.owner);
      owner = &row.owner;
    }
  };
  add(false);
  text += "</tbody>\n";
  if (std::ranges::any_of(rows, [](const ForestRow& r) { return r.beside; })) {
    text +=
        "<tbody class=\"beside\"><tr><th colspan=\"8\">Electrodes and joints: free so that their "
        "uncertainty counts</th></tr>\n";
    add(true);
    text += "</tbody>\n";
  }
  return text +
         "</table>\n<details class=\"reading\"><summary>How to read this</summary><dl>"
         "<dt>What this shows</dt><dd>Each number as its distance from the literature, in the "
         "literature's spread. Grey: the literature's 95 %. The thin line is the "
         "95 % interval of the person, the thick one the same if moment arms, tendons and sensors were exact: by it "
         "sessions of the person are compared. Pointing at a row, or opening its verdict, gives the reason.</dd>"
         "<dt>What bad looks like</dt><dd>A line as wide as the grey field: the recording added "
         "nothing. A mark outside of the grey field: an unusual person, or an error in "
         "electrodes, units, loads or geometry. A triangle: no muscle can have the value.</dd>"
         "<dt>What to do</dt><dd>Use the numbers that are identified. Report the interval of "
         "weak numbers. For the others the section “What to record next” names "
         "movements that would tell.</dd></dl></details>\n</figure>\n";
}

}  // namespace myoid::page
