#include "myoid/page/page_style.h"

#include <array>

#include <fmt/format.h>

namespace myoid::page {
namespace {

constexpr auto kColors = std::to_array<PageColor>({
    {"back", "#fff", "#14181d"},      {"ink", "#22262b", "#e4e8ed"},         {"dim", "#5a626b", "#a7b1bc"},
    {"faint", "#69717a", "#98a2ad"},  {"edge", "#8a9097", "#77818b"},        {"line", "#d5d9de", "#3b444e"},
    {"rule", "#e6e8eb", "#2c343d"},   {"zero", "#b5bac0", "#58626d"},        {"box", "#c3c9d0", "#505b66"},
    {"field", "#f3f6fa", "#1e252d"},  {"low", "#f4f6f8", "#1d242c"},         {"high", "#102a5c", "#9cc9ff"},
    {"prior", "#dfe3e8", "#38414b"},  {"spread", "#e6eaef", "#303942"},      {"truth", "#111", "#f4f6f8"},
    {"accent", "#1f5fa8", "#7fb6f2"}, {"orange", "#d1491b", "#ff8f63"},      {"green", "#00694b", "#4fc795"},
    {"amber", "#b86e00", "#e3a445"},  {"red", "#b3261e", "#ff857b"},         {"violet", "#7a3c8f", "#cf9be2"},
    {"moved", "#7b2d8b", "#d792e8"},  {"grey", "#6b6b6b", "#b0b0b0"},        {"raw", "#b9bec4", "#5d6670"},
    {"sky", "#3d8fc4", "#6db8e8"},    {"other", "#868d95", "#8c959e"},       {"hum", "#8d959e", "#737d87"},
    {"rose", "#a05a74", "#e39bb5"},   {"fault", "#d95f00", "#ff9a4d"},       {"pass-ink", "#14602f", "#93dfae"},
    {"pass", "#e4f4e9", "#15301f"},   {"pass-edge", "#9fd3b1", "#2f6b45"},   {"warn-ink", "#7a4b00", "#f3cd85"},
    {"warn", "#fff3d6", "#352808"},   {"warn-edge", "#e8c778", "#7a5a16"},   {"fail-ink", "#8e1c1c", "#ffb3ab"},
    {"fail", "#fde6e4", "#3b1715"},   {"fail-edge", "#eba8a2", "#86403a"},   {"info-ink", "#24507f", "#abd1f7"},
    {"info", "#e6f0fa", "#15293d"},   {"info-edge", "#a9c8e8", "#37618c"},   {"repeat-ink", "#5b2a6c", "#e0b6ee"},
    {"repeat", "#f4eaf7", "#2f1c37"}, {"repeat-edge", "#cfaedb", "#6c4579"},
});

constexpr std::string_view kStyle = R"(
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1640px; padding: 28px 24px 60px; background: var(--back); color: var(--ink);
  font: 15px/1.5 Helvetica, Arial, sans-serif; }
h1, h2, h3, p, li, figcaption { overflow-wrap: anywhere; }
h1 { font-size: 26px; line-height: 1.2; margin: 0 0 2px; }
h2 { font-size: 19px; margin: 38px 0 8px; padding-bottom: 4px; border-bottom: 1px solid var(--line); }
h3 { font-size: 15px; margin: 22px 0 4px; }
p { margin: 6px 0 10px; max-width: 74ch; }
.subtitle, .caption, .hints { color: var(--dim); }
.caption, .hints { font-size: 13px; }
.headline { font-size: 17px; margin: 16px 0 12px; max-width: 90ch; }
.answers { display: grid; grid-template-columns: max-content minmax(0, 90ch); gap: 4px 18px; margin: 8px 0; } .answers dt { font-weight: 600; } .answers dd { margin: 0; }
.light { display: flex; gap: 14px; align-items: center; margin: 12px 0; padding: 10px 14px; border: 1px solid; border-radius: 8px; }
.light p { margin: 0; max-width: 100ch; } .light ul { margin: 4px 0 0; padding-left: 18px; max-width: 100ch; } .light svg { flex: none; fill: currentColor; }
.light .sign { fill: none; stroke: var(--back); stroke-width: 4; }
.forest { margin: 10px 0 22px; }
.forest table { width: 100%; max-width: 1180px; }
.forest td, .forest th { padding: 1px 12px 1px 0; vertical-align: middle; }
.forest .bar { width: 28%; min-width: 120px; overflow: visible; padding-right: 22px; }
.forest svg.bar { width: 100%; display: block; padding: 0; }
.forest .number, .forest .badge { white-space: nowrap; }
.forest .bar text { font-size: 11px; fill: var(--dim); }
.forest .prior { fill: var(--prior); background: var(--prior); } .forest .middle { stroke: var(--edge); stroke-dasharray: 2 3; }
.forest .truth { stroke: var(--truth); stroke-width: 2; background: var(--truth); }
.legend { font-size: 13px; max-width: none; margin: 6px 0; } .legend span { display: inline-block; margin-right: 18px; }
.legend i { display: inline-block; width: 24px; height: 10px; } .legend i.truth { width: 3px; height: 14px; vertical-align: -2px; }
.mark { vertical-align: -3px; }
.forest td { border-bottom: 0; } .forest tr.first td { border-top: 1px solid var(--line); }
.forest tr:not(.first) td:first-child { color: var(--faint); }
.beside th { padding-top: 10px; color: var(--dim); }
details.reading { font-size: 13px; margin: 4px 0; } .reading summary { color: var(--accent); cursor: pointer; }
details.part > summary { cursor: pointer; } details.part h2 { display: inline-block; }
.reading dl { margin: 6px 0; max-width: 90ch; } .reading dt { font-weight: 600; } .reading dd { margin: 0 0 6px; }
nav { display: flex; flex-wrap: wrap; font-size: 13px; margin: 12px 0 0; padding: 6px 0; position: sticky; top: 0; z-index: 20; background: var(--back); }
h2 { scroll-margin-top: 44px; }
.why > summary { cursor: pointer; list-style: none; } .why > summary::-webkit-details-marker { display: none; }
.forest td:nth-child(2) { min-width: 9em; } .forest td:nth-child(2) summary { text-decoration: underline dotted var(--edge); text-underline-offset: 3px; }
.why[open] { max-width: 40ch; white-space: normal; }
.refused .forest td, .refused .headline { color: var(--faint); } .refused .forest svg.bar { opacity: .45; }
nav a { margin-right: 14px; white-space: nowrap; }
a { color: var(--accent); }
.grid { margin: 10px 0 26px; }
.grid table { width: 100%; table-layout: fixed; max-width: 1400px; }
.grid th, .grid td { padding: 0 14px 0 0; border-bottom: 1px solid var(--rule); vertical-align: middle; }
.grid th:first-child, .grid td:first-child { width: 15%; overflow: hidden; text-overflow: ellipsis; white-space: nowrap; }
.grid thead th { vertical-align: bottom; padding-top: 6px; } .grid thead small { display: flex; justify-content: space-between; font-weight: 400; color: var(--dim); }
.grid tbody tr:hover td, .grid tbody tr:focus-within td { background: var(--field); }
.grid svg.strip { width: 100%; height: 20px; display: block; overflow: visible; }
.grid .spread { fill: var(--spread); } .grid .middle { stroke: var(--edge); stroke-dasharray: 2 3; } .grid .truth { stroke: var(--truth); stroke-width: 2; }
.grid .ring { fill: none; stroke: var(--red); stroke-width: 2; } .grid .untold { opacity: .35; }
.wide { overflow-x: auto; }
caption { text-align: left; max-width: min(74ch, calc(100vw - 44px)); padding-bottom: 4px; font-size: 13px; color: var(--dim); }
table { border-collapse: collapse; font-size: 13px; margin: 6px 0; }
th, td { text-align: left; vertical-align: top; padding: 4px 12px 4px 0; border-bottom: 1px solid var(--rule); }
th { font-weight: 600; border-bottom: 1px solid var(--edge); vertical-align: bottom; }
td { font-variant-numeric: tabular-nums; }
td.short { white-space: nowrap; }
.badge { display: inline-block; padding: 0 7px; border-radius: 9px; font-size: 12px; font-weight: 600;
  white-space: nowrap; border: 1px solid; }
.pass, .good { color: var(--pass-ink); background: var(--pass); border-color: var(--pass-edge); }
.warn, .weak { color: var(--warn-ink); background: var(--warn); border-color: var(--warn-edge); }
.fail, .bad { color: var(--fail-ink); background: var(--fail); border-color: var(--fail-edge); }
.info { color: var(--info-ink); background: var(--info); border-color: var(--info-edge); }
.repeat { color: var(--repeat-ink); background: var(--repeat); border-color: var(--repeat-edge); }
figure { margin: 18px 0; break-inside: avoid; }
figure > svg { width: 100%; max-width: 1000px; height: auto; display: block; }
.save { font-size: 12px; margin: 2px 0; }
figcaption { font-size: 13px; color: var(--dim); margin-top: 4px; }
figcaption b { color: var(--ink); }
ul { margin: 6px 0; padding-left: 20px; }
li { margin: 3px 0; max-width: 74ch; }
@media screen and (max-width: 760px) { .headline { font-size: 15px; margin: 8px 0; } .answers { grid-template-columns: minmax(0, 1fr); gap: 0; font-size: 14px; } .answers dd { margin-bottom: 6px; } body { padding: 16px 12px 40px; } .wide-only { display: none; } .forest { font-size: 12px; }
  .forest td, .forest th, .grid td, .grid th { padding-right: 6px; } .grid { font-size: 12px; overflow-x: auto; } .grid table { min-width: 620px; }
  .grid th:first-child, .grid td:first-child { width: 24%; } .forest .bar { min-width: 70px; }
  nav { flex-wrap: nowrap; overflow-x: auto; }
  .gates table { min-width: 0; } .gates thead { display: none; } .gates tr { display: block; padding: 8px 0; border-bottom: 1px solid var(--rule); }
  .gates td { display: block; border: 0; padding: 1px 0; } .gates td:nth-child(2) { font-weight: 600; }
  .gates td:nth-child(3)::before { content: "Found: "; } .gates td:nth-child(4)::before { content: "Asked for: "; } }
@media screen and (max-width: 560px) { .forest .bar { display: none; } }
@media screen and (max-width: 580px) { .forest td:nth-child(2) { min-width: 0; } .wide:not(.gates, .facts) table { min-width: 1050px; }
  .changes { font-size: 11px; } .changes :is(.number, .badge) { white-space: normal; } .changes td { overflow-wrap: anywhere; }
  :is(.wide:not(.gates, .facts), .grid)::before { content: "Slide the table sideways for its other columns \2192"; display: block; position: sticky; left: 0;
    max-width: calc(100vw - 24px); font-size: 12px; color: var(--accent); }
  .wide:not(.gates, .facts) :is(td, th):first-child { position: sticky; left: 0; background: var(--back); max-width: 34vw; white-space: normal; } }
@media (prefers-reduced-motion: reduce) { * { animation: none !important; transition: none !important; scroll-behavior: auto !important; } }
code { font: 12px/1.4 Menlo, Consolas, monospace; overflow-wrap: anywhere; }
@media print { body { max-width: none; padding: 0; font-size: 11pt; } nav { display: none; }
  h2, h3 { break-after: avoid; } tr { break-inside: avoid; } a { color: inherit; text-decoration: none; }
  .badge, .light, .forest, .grid { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  .forest tr, .grid tr { break-inside: avoid; } .save, details:not([open]):not(.why) { display: none; } @page { size: A4; margin: 11mm 13mm; } }
)";

std::string variables(std::string_view PageColor::*scheme) {
  std::string text;
  for (const PageColor& color : kColors) text += fmt::format("--{}:{};", color.name, color.*scheme);
  return text;
}

/// Returns a rule for each color that a drawing may have as an attribute.
std::string drawing_rules() {
  std::string text;
  for (const PageColor& color : kColors)
    for (const std::string_view of : {"fill", "stroke"})
      text += fmt::format("[{0}=\"{1}\"]{{{0}:{2}}}", of, color.light, color.dark);
  return text;
}

}  // namespace

std::span<const PageColor> page_colors() { return kColors; }

std::string page_style() {
  return fmt::format(
      ":root{{color-scheme:light;{}}}\n@media screen and (prefers-color-scheme:dark){{:root{{color-scheme:dark;{}}}\n"
      "{}}}\n{}",
      variables(&PageColor::light), variables(&PageColor::dark), drawing_rules(), kStyle);
}

}  // namespace myoid::page
