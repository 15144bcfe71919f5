#include "myoid/program/commands/predict.h"

#include <fmt/format.h>

#include "myoid/fit/methods/prediction.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/say.h"
#include "myoid/results/prediction_files.h"

namespace myoid::program {
namespace {

void print_predict(const program::PredictResult& result) {
  say("{:<20} {:<16} {:>10} {:>8} {:>13} {:>16}\n", "trial", "joint", "RMSE [N m]", "R2", "R2 < 1.5 Hz",
      "in the 95 % band");
  for (const fit::TrialFit& t : result.trials) {
    const double covered = fit::covered_share(t.torque_nm, t.torque_fit_nm, t.torque_sd_nm);
    say("{:<20} {:<16} {:>10.2f} {:>8.3f} {:>13.3f} {:>14.0f} %{}\n", in_column(t.trial), in_column(t.joint),
        t.score.rmse_nm(), t.score.r2(), t.band.r2(), 100.0 * covered, t.calibration ? "  (took part in the fit)" : "");
  }
  say("{}\n", results::band_sentence(result.trials));
}

}  // namespace

void add_predict(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("predict",
                          "Torque and muscle forces, with 95 % bands, of trials that took no part in a run's fit.\n"
                          "The bands are of the person.\n"
                          "Example: myoid predict results --trials fast_lift --out predicted");
  const auto out = std::make_shared<std::string>();
  const auto o = std::make_shared<program::PredictOptions>();
  command.add_option("folder", o->folder, "Folder of a run (with run.json)")->required();
  command.add_option("--study", o->study,
                     "Another study of the same person and muscles, with the trials (default: the study of the run)");
  command.add_option("--trials", o->trials, "Names of the trials (default: all that took no part in the fit)");
  command.add_option("--out", *out, "Folder of the predictions")->required();
  add_common_options(command, context, {.seed = false});
  command.callback([&context, o, out] {
    context.prepare_folder(*out);
    o->call = context.call();
    const program::PredictResult result = program::predict(*o);
    context.end_progress();
    program::write_predict(result, *out);
    if (context.json) {
      say_whole(program::predict_json(result));
    } else {
      print_predict(result);
      say("{}\n", *out);
    }
  });
}

}  // namespace myoid::program
