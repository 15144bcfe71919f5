#include "myoid/program/commands/design.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/json_text.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/say.h"

namespace myoid::program {
namespace {

using fit::ParameterEstimate;

void print_plan(const run::DesignStudyResult& result) {
  say("{:>2}  {:<58} {:>6} {:>6} {:>11} {:>15}\n", "", "movement", "time", "rest", "median 95 %", "identified");
  say("{:>2}  {:<58} {:>6} {:>6} {:>11} {:>15}\n", "", "", "[s]", "[s]", "[+- %]",
      fmt::format("of {}", result.beforehand.size()));
  say("{:>2}  {:<58} {:>6} {:>6} {:>11.0f} {:>15}\n", 0, "what is known beforehand", "", "",
      run::median_half_width(result.beforehand), run::identified_count(result.beforehand));
  for (std::size_t i = 0; i < result.plan.size(); ++i) {
    const run::PlannedMovement& m = result.plan[i];
    say("{:>2}  {:<58} {:>6.0f} {:>6.0f} {:>11.1f} {:>15}\n", i + 1, m.movement.description(), m.movement.duration_s,
        m.rest_before_s, run::median_half_width(m.expected), run::identified_count(m.expected));
  }
  if (result.plan.empty()) return;
  say("\nexpected 95 % interval, as +- % of the value (the delay: +- ms)\n{:<38} {:>11}", "target", "beforehand");
  for (std::size_t i = 0; i < result.plan.size(); ++i) say(" {:>7}", i + 1);
  say("  verdict\n");
  for (std::size_t t = 0; t < result.beforehand.size(); ++t) {
    const ParameterEstimate& before = result.beforehand[t];
    say("{:<38} {:>11.1f}", before.muscle + "." + before.parameter, run::relative_half_width(before));
    for (const run::PlannedMovement& m : result.plan) say(" {:>7.1f}", run::relative_half_width(m.expected[t]));
    say("  {}\n", fit::name(result.plan.back().expected[t].verdict));
  }
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
