#include "myoid/program/commands/predict.h"

#include "myoid/fit/methods/prediction.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
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

void carry_out(Context& context, const PredictOptions& o, const CLI::App& /*command*/) {
  context.prepare_folder(o.out);
  const program::PredictResult result = program::predict(o);
  context.end_progress();
  program::write_predict(result, o.out);
  if (context.json) {
    say_whole(program::predict_json(result));
  } else {
    print_predict(result);
    say("{}\n", o.out);
  }
}

}  // namespace

void add_predict(CLI::App& app, Context& context) {
  add_command<PredictOptions>(app, context, "predict",
                              "Torque and muscle forces, with 95 % bands, of trials that took no part in a run's fit.\n"
                              "The bands are of the person.\n"
                              "Example: myoid predict results --trials fast_lift --out predicted",
                              {.seed = false}, carry_out);
}

}  // namespace myoid::program
