#include "myoid/page/light.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/page/tables.h"
#include "myoid/page/typeset.h"

namespace myoid::page {
namespace {

/// Octagon, triangle or circle, 40 units wide.
std::string_view shape(GateStatus status) {
  switch (status) {
    case GateStatus::fail:
      return "<path d=\"M13 3H27L37 13V27L27 37H13L3 27V13Z\"/><path class=\"sign\" d=\"M13 13L27 27M27 13L13 27\"/>";
    case GateStatus::warn:
      return "<path d=\"M20 3L38 36H2Z\"/><path class=\"sign\" d=\"M20 14V25M20 30V31\"/>";
    default:
      return "<circle cx=\"20\" cy=\"20\" r=\"18\"/><path class=\"sign\" d=\"M11 20L18 27L29 13\"/>";
  }
}

}  // namespace

Light light_of(const std::vector<Gate>& gates) {
  const auto count = [&](GateStatus status) { return std::ranges::count(gates, status, &Gate::status); };
  Light light;
  std::vector<std::string> unasked;
  for (const Gate& gate : gates)
    if (!gate.asked) unasked.push_back(gate.name);
  light.answered = fmt::format("{} of {} questions about the recording and the fit are answered well{}",
                               count(GateStatus::pass), std::ssize(gates) - count(GateStatus::info),
                               unasked.empty() ? "" : fmt::format(" (not asked: {})", fmt::join(unasked, "; ")));
  if (count(GateStatus::fail) > 0) {
    light.status = GateStatus::fail;
    light.head = "Do not use the numbers";
    light.leads_to = "; these failed:";
  } else if (count(GateStatus::warn) > 0) {
    light.status = GateStatus::warn;
    light.head = "Use the numbers with caution";
    light.leads_to = "; these ask for caution:";
  } else {
    light.head =
        unasked.empty() ? "The recording passed every question" : "The recording passed the questions that were asked";
    light.leads_to = ".";
    return light;
  }
  const auto explains = [](const Gate& gate) {
    return gate.explains && (gate.status == GateStatus::warn || gate.status == GateStatus::fail);
  };
  std::ranges::copy_if(gates, std::back_inserter(light.reasons), explains);
  std::ranges::copy_if(gates, std::back_inserter(light.reasons),
                       [&](const Gate& gate) { return gate.status == light.status && !explains(gate); });
  std::vector<std::string> cautions;
  for (const Gate& gate : gates)
    if (gate.status == GateStatus::warn && light.status == GateStatus::fail && !explains(gate))
      cautions.push_back(gate.name);
  if (!cautions.empty()) light.besides = fmt::format("Besides, these ask for caution: {}.", fmt::join(cautions, "; "));
  return light;
}

std::string light_html(const std::vector<Gate>& gates) {
  if (gates.empty()) return "";
  const Light light = light_of(gates);
  std::string reasons;
  for (const Gate& gate : light.reasons)
    reasons += fmt::format("<li>{}{}</li>", typeset(gate.name), gate.value.empty() ? "" : ": " + typeset(gate.value));
  return fmt::format(
      "<div class=\"light {}\"><svg width=\"40\" height=\"40\" viewBox=\"0 0 40 40\" "
      "aria-hidden=\"true\">{}</svg><div><p><b>{}.</b> {} (<a href=\"#quality\">all</a>){}</p>{}{}</div></div>\n",
      name(light.status), shape(light.status), light.head, light.answered, light.leads_to,
      reasons.empty() ? "" : "<ul>" + reasons + "</ul>",
      light.besides.empty() ? "" : "<p>" + typeset(light.besides) + "</p>");
}

}  // namespace myoid::page
