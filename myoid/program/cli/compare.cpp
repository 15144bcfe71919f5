#include "myoid/program/commands/compare.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "myoid/ground/core/json_text.h"
#include "myoid/page/json_values.h"
#include "myoid/page/tables.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/say.h"
#include "myoid/results/comparison/change_sentences.h"
#include "myoid/results/comparison/comparison_report.h"

namespace myoid::program {
namespace {

nlohmann::ordered_json to_json(const results::RunComparison& comparison) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const results::ComparedParameter& p : comparison.parameters) {
    rows.push_back({{"muscle", p.muscle},
                    {"parameter", p.first.parameter},
                    {"unit", std::string(symbol(p.first.unit))},
                    {"method", std::string(fit::name(p.first.method))},
                    {"case", std::string(fit::name(p.first.fit_case))},
                    {"first", p.of_first.value},
                    {"second", p.of_second.value},
                    {"difference", p.difference},
                    {"difference_percent",
                     results::has_scale(p) ? nlohmann::ordered_json(100.0 * p.difference / std::abs(p.of_first.value))
                                           : nlohmann::ordered_json(nullptr)},
                    {"smallest_detectable", page::number_or_null(p.smallest_detectable)},
                    {"p_alone", page::number_or_null(p.p_alone)},
                    {"tested", p.tested},
                    {"p_value", page::number_or_null(p.p_value)},
                    {"change", std::string(results::name(p.change))},
                    {"says", results::change_text(p)}});
  }
  return {{"first", comparison.first.string()},
          {"second", comparison.second.string()},
          {"first_date", comparison.first_date},
          {"second_date", comparison.second_date},
          {"headline", results::changes_sentence(comparison)},
          {"parameters", rows},
          {"unlike", comparison.unlike},
          {"remarks", sentences(comparison.remarks)}};
}

/// Prints the sentence and the numbers that both sessions tell; with `all` the others, too.
void print(const results::RunComparison& comparison, bool all) {
  for (const std::string& sentence : {results::unlike_sentence(comparison), results::changes_sentence(comparison),
                                      results::reading_sentence(comparison)})
    if (!sentence.empty()) say("{}\n\n", sentence);
  for (const fit::Method method : results::methods_of(comparison))
    if (results::rests_on_measurement(method))
      say("{}", page::table_text(results::compared_table(comparison, method, all)));
  for (const std::string& remark : sentences(comparison.remarks)) say("{}\n", remark);
}

void carry_out(Context& context, const CompareOptions& o, const CLI::App& /*command*/) {
  if (!o.out.empty()) context.prepare_folder(o.out);
  const program::CompareResult result = program::compare(o);
  if (!o.out.empty()) program::write_compare(result, o.out);
  if (context.json) {
    say_whole(json_text(to_json(result.comparison)) + "\n");
    return;
  }
  print(result.comparison, context.verbose);
  if (!o.out.empty()) say("{}/report.html\n", o.out);
}

}  // namespace

void add_compare(CLI::App& app, Context& context) {
  add_command<CompareOptions>(app, context, "compare",
                              "Two finished runs, number by number: which parameters differ by more than "
                              "chance, which do not, and which the recordings cannot tell.\n"
                              "Example: myoid compare results/before results/after --out compared",
                              {.threads = false, .seed = false, .range = false}, carry_out);
}

}  // namespace myoid::program
