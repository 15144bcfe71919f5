#include "myoid/program/commands/review.h"

#include <nlohmann/json.hpp>

#include "myoid/ground/core/json_text.h"
#include "myoid/page/json_values.h"
#include "myoid/page/tables.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/say.h"
#include "myoid/results/review/review_report.h"

namespace myoid::program {
namespace {

using nlohmann::ordered_json;

ordered_json score_json(const std::optional<fit::Score>& score) {
  if (!score) return nullptr;
  return {{"r2", score->r2()}, {"rmse_nm", score->rmse_nm()}};
}

ordered_json to_json(const results::SecondOpinion& opinion) {
  ordered_json torques = ordered_json::array(), numbers = torques, strengths = torques;
  for (const results::ReviewedTorque& t : opinion.torques)
    torques.push_back({{"trial", t.trial},
                       {"joint", t.joint},
                       {"calibration", t.is_calibrating},
                       {"theirs", score_json(t.theirs)},
                       {"left_out", score_json(t.ours)}});
  for (const results::ReviewedNumber& n : opinion.numbers)
    numbers.push_back({{"muscle", n.muscle},
                       {"muscles", n.lumped},
                       {"parameter", n.ours.parameter},
                       {"unit", std::string(symbol(n.ours.unit))},
                       {"start", page::number_or_null(n.start)},
                       {"calibrated", n.theirs},
                       {"on_bound", n.on_bound},
                       {"estimate", n.ours.estimate},
                       {"ci_low", page::number_or_null(n.ours.ci_low)},
                       {"ci_high", page::number_or_null(n.ours.ci_high)},
                       {"verdict", std::string(fit::name(n.ours.verdict))},
                       {"standing", std::string(choice_name(n.standing))}});
  for (const results::JointStrength& s : opinion.strengths)
    strengths.push_back({{"joint", s.joint},
                         {"direction", s.is_positive ? 1 : -1},
                         {"strength_nm", s.all_nm},
                         {"without_emg_nm", s.without_emg_nm},
                         {"without_emg", s.without_emg}});
  return {{"dialect", std::string(choice_name(opinion.project.dialect))},
          {"subject", opinion.project.subject.string()},
          {"joints", opinion.joints},
          {"calibrated_numbers", opinion.unknowns},
          {"on_bound", opinion.on_bound},
          {"independent_rows", opinion.independent_rows},
          {"torques", torques},
          {"numbers", numbers},
          {"strengths", strengths},
          {"says", results::review_sentences(opinion)}};
}

void print(const results::SecondOpinion& opinion) {
  for (const std::string& sentence : results::review_sentences(opinion)) say("{}\n", sentence);
  say("\n{}", page::table_text(results::torque_table(opinion)));
}

void carry_out(Context& context, const ReviewOptions& o, const CLI::App& /*command*/) {
  context.prepare_folder(o.folder);
  const program::ReviewResult result = program::review(o);
  context.end_progress();
  program::write_review(result, o.folder);
  if (context.json) {
    say_whole(json_text(to_json(result.opinion)) + "\n");
    return;
  }
  print(result.opinion);
  say("{}/report.html\n", o.folder);
}

}  // namespace

void add_review(CLI::App& app, Context& context) {
  add_command<ReviewOptions>(
      app, context, "review",
      "A second opinion on a calibration by CEINMS, CEINMS-RT or NMSM: its torque by its own law, its numbers on "
      "bounds "
      "and without EMG, and the numbers that its recordings tell. Nothing is written into the project.\n"
      "Example: myoid review ceinms_project --out opinion",
      {}, carry_out);
}

}  // namespace myoid::program
