#include "myoid/program/commands/design.h"

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/json_text.h"
#include "myoid/page/tables.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/say.h"
#include "myoid/run/design/design_report.h"

namespace myoid::program {
namespace {

using fit::ParameterEstimate;

/// Prints the plan and the targets as the report of a run has them; a sentence where no movement is left.
void print_plan(const run::DesignStudyResult& result) {
  const page::Section section = run::next_recording_section(result);
  if (section.tables.empty()) say("{}\n", fmt::join(section.paragraphs, "\n"));
  for (const page::Table& table : section.tables) say("{}\n", page::table_text(table));
}

nlohmann::ordered_json estimates_json(const std::vector<ParameterEstimate>& estimates) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ParameterEstimate& e : estimates) {
    list.push_back({{"muscle", e.muscle},
                    {"parameter", e.parameter},
                    {"unit", symbol(e.unit)},
                    {"value", e.estimate},
                    {"ci_low", *e.ci_low},
                    {"ci_high", *e.ci_high},
                    {"verdict", std::string(fit::name(e.verdict))}});
  }
  return list;
}

void print_json(const run::DesignStudyResult& result) {
  nlohmann::ordered_json json;
  json["catalogue_size"] = result.catalogue_size;
  json["beforehand"] = estimates_json(result.beforehand);
  json["plan"] = nlohmann::ordered_json::array();
  for (const run::PlannedMovement& m : result.plan) {
    json["plan"].push_back({{"movement", m.movement.description()},
                            {"duration_s", m.movement.duration_s},
                            {"rest_before_s", m.rest_before_s},
                            {"fatigued_share", m.fatigued_share},
                            {"expected", estimates_json(m.expected)}});
  }
  say_whole(json_text(json) + "\n");
}

void carry_out(Context& context, const DesignOptions& o, const CLI::App& /*command*/) {
  const program::DesignResult result = program::design(o);
  context.end_progress();
  context.json ? print_json(result.design) : print_plan(result.design);
}

}  // namespace

void add_design(CLI::App& app, Context& context) {
  add_command<DesignOptions>(app, context, "design",
                             "Which movements to record so that the target parameters become identifiable.\n"
                             "Example: myoid design --model arm4 --targets max_isometric_force BIC.force_length_width",
                             {.range = false, .overwrite = false}, carry_out);
}

}  // namespace myoid::program
