#include "myoid/program/commands/twin_study.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/program/cli/command_help.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/say.h"
#include "myoid/program/commands/twin.h"

namespace myoid::program {
namespace {

std::string percent(double share) { return std::isfinite(share) ? fmt::format("{:.1f}", 100.0 * share) : "-"; }

void print_summary(const std::vector<lab::TwinSummary>& summaries, bool each_muscle) {
  const auto print = [](auto... cells) {
    say("{:<8} {:<12} {:<8} {:<28} {:>5} {:>7} {:>7} {:>7} {:>6} {:>6} {:>6} {:>6} {:>6} {:>7} {:>6} {:>6} {:>7} {:>9} "
        "{:>9}\n",
        cells...);
  };
  say("given: the reading with exact geometry and sensors\n");
  print("method", "case", "muscle", "parameter", "n", "bias", "error", "rmse", "<5 %", "<10 %", "<20 %", "prior",
        "cover", "half w.", "given:", "cover", "half w.", "identif.", "of these");
  print("", "", "", "", "", "[%]", "[%]", "[%]", "[%]", "[%]", "[%]", "<10 %", "[%]", "[%]", "error", "[%]", "[%]",
        "[%]", "<15 % [%]");
  for (const lab::TwinSummary& s : summaries) {
    if (!each_muscle && s.muscle != "all" && s.muscle != "subject") continue;
    const int identified = s.verdicts[0];
    print(fit::name(s.method), fit::name(s.fit_case), s.muscle, s.parameter, s.count, percent(s.bias),
          percent(s.median_error), percent(s.rmse), percent(s.within.of_5), percent(s.within.of_10),
          percent(s.within.of_20), percent(s.prior_within_10), percent(s.coverage), percent(s.half_width),
          percent(s.given.median_error), percent(s.given.coverage), percent(s.given.half_width),
          percent(static_cast<double>(identified) / s.count),
          identified > 0 ? percent(static_cast<double>(s.identified_within_15) / identified) : "-");
  }
}

/// Medians over all trials, then trial by trial.
void print_predictions(const lab::TwinStudyResult& result) {
  if (result.predictions.empty()) return;
  say("\ntrials held back, medians: NRMSE is RMSE over the range of the trial's torque\n");
  say("{:<28} {:>5} {:>10} {:>7} {:>19} {:>7}\n", "trial", "n", "NRMSE [%]", "R2", "below 1.5 Hz: NRMSE", "R2");
  std::vector<std::string> trials{"all"};
  for (const lab::TwinPrediction& p : result.predictions) {
    if (std::ranges::find(trials, p.trial) == trials.end()) trials.push_back(p.trial);
  }
  for (const std::string& trial : trials) {
    std::size_t count = 0;
    const auto medians = [&](fit::Score lab::TwinPrediction::*score) {
      std::vector<double> nrmse, r2;
      for (const lab::TwinPrediction& p : result.predictions) {
        if (trial != "all" && trial != p.trial) continue;
        nrmse.push_back(100.0 * (p.*score).nrmse_range());
        r2.push_back((p.*score).r2());
      }
      count = r2.size();
      return std::pair{math::median(std::move(nrmse)), math::median(std::move(r2))};
    };
    const auto law = medians(&lab::TwinPrediction::law), band = medians(&lab::TwinPrediction::band);
    say("{:<28} {:>5} {:>10.1f} {:>7.3f} {:>19.1f} {:>7.3f}\n", trial, count, law.first, law.second, band.first,
        band.second);
  }
}

void print_verdicts(const lab::TwinStudyResult& result, const std::vector<lab::TwinSummary>& summaries) {
  for (const fit::Method method : {fit::Method::torque, fit::Method::force, fit::Method::paper}) {
    int good = 0;
    int bad = 0;
    int other_good = 0;
    int other_bad = 0;
    int outside = 0;
    for (const lab::TwinSummary& s : summaries) {
      if (s.method != method || (s.muscle != "all" && s.muscle != "subject")) continue;
      good += s.confusion.identified_good;
      bad += s.confusion.identified_bad;
      other_good += s.confusion.other_good;
      other_bad += s.confusion.other_bad;
      outside += s.outside_physical;
    }
    if (good + bad + other_good + other_bad == 0) continue;
    say("\nmethod {}: does the verdict know?\n{:<24} {:>14} {:>14}\n", fit::name(method), "", "error < 10 %",
        "error >= 10 %");
    say("{:<24} {:>14} {:>14}\n{:<24} {:>14} {:>14}\n", "identified", good, bad, "not identified", other_good,
        other_bad);
    say("{} values outside the physical bounds without the verdict non_physical\n", outside);
  }
  print_predictions(result);
}

void carry_out(Context& context, const TwinStudyOptions& o, const CLI::App& command) {
  context.prepare_folder(o.out);
  const program::TwinStudyResult result = program::twin_study(o);
  context.end_progress();
  program::write_twin_study(result, o.out);
  const lab::TwinStudyResult& study = result.study;
  const std::string persons = study.interrupted
                                  ? fmt::format("INTERRUPTED: only {} of {}", study.finished, study.subjects)
                                  : fmt::format("{}", study.finished);
  say("protocol {}, level {}, {} persons, {} failures\n\n", study.protocol, study.level, persons,
      study.failures.size());
  print_summary(result.summaries, command.count("--each-muscle") > 0);
  print_verdicts(study, result.summaries);
  if (study.interrupted) throw Interrupted();
  if (!study.failures.empty()) context.exit_code = kSomeTrialsFailed;
}

}  // namespace

void add_twin_study(CLI::App& app, Context& context) {
  add_command<TwinStudyOptions>(
      app, context, "twin-study",
      "How good is the method? Many virtual persons, the whole chain, compared with the truth.\n"
      "Example: myoid twin-study --protocol examples/protocols/rich.toml --subjects 200 --out study",
      {.range = false}, carry_out)
      ->footer([] { return program::truth_help(help_width()); })
      ->add_flag_callback(
          "--each-muscle", [] {}, "A line for each muscle too");
}

}  // namespace myoid::program
