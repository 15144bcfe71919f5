#include "myoid/program/commands/predict.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/fit/methods/prediction.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/page/json_values.h"
#include "myoid/program/commands/prediction_input.h"
#include "myoid/program/commands/read_fit.h"
#include "myoid/results/prediction_files.h"
#include "myoid/study/study_text.h"

namespace myoid::program {
void visit(PredictOptions& o, study::SettingVisitor& v) {
  v.folder("folder", o.folder,
           {.says = "Folder of a run (with run.json).", .required = "a folder", .option = {.by_place = true}});
  v.path(
      "study", o.study,
      {.says = "Another study of the same person and muscles, with the trials.", .otherwise = "the study of the run"});
  v.texts("trials", o.trials, {.says = "Names of the trials.", .otherwise = "all that took no part in the fit"});
  v.folder("out", o.out, {.says = "Folder of the predictions.", .required = "a folder"});
}

PredictResult predict(const PredictOptions& o) {
  Remarks remarks(o.call);
  const PredictionInput input = prediction_input(o.folder, {.study = o.study,
                                                            .trials = o.trials,
                                                            .start_s = o.call.start_s,
                                                            .end_s = o.call.end_s,
                                                            .progress = o.call.progress});
  remarks.warn_of_changes(o.folder, {"parameters.json", "run.json"});
  for (const Remark& remark : input.remarks) remarks.add(remark);
  PredictResult result;
  result.provenance.command = o.call.command;
  result.provenance.inputs = input.files;
  result.provenance.options_json = study::study_json(input.study);
  const fit::IdentificationResult fit = read_fit(o.folder, input.fit.data, input.fit.options);
  const fit::TrialPredictions predictions(input.fit.data, input.fit.options, fit);
  for (const fit::TrialData& trial : input.trials) {
    if (trial.calibration) remarks.note(fmt::format("trial {} took part in the fit", trial.name));
    for (std::size_t j = 0; j < fit::joint_count(trial); ++j)
      result.trials.push_back(predictions.of(fit::of_joint(trial, j)));
  }
  for (const fit::MuscleSetup& muscle : input.fit.data.muscles) result.muscles.push_back(muscle.name);
  result.remarks = remarks.list();
  return result;
}

std::string predict_json(const PredictResult& result) {
  nlohmann::ordered_json object;
  object["provenance"] = page::provenance_json(result.provenance);
  object["bands"] = results::band_sentence(result.trials);
  object["trials"] = nlohmann::ordered_json::array();
  const NameIds folders = results::prediction_folders(result.trials);
  for (const fit::TrialFit& t : result.trials) {
    object["trials"].push_back(
        {{"trial", t.trial},
         {"folder", folders.of(t.trial)},
         {"joint", t.joint},
         {"fitted", t.calibration},
         {"samples", t.score.n},
         {"rmse_nm", page::number_or_null(t.score.rmse_nm())},
         {"r2", page::number_or_null(t.score.r2())},
         {"band_rmse_nm", page::number_or_null(t.band.rmse_nm())},
         {"band_r2", page::number_or_null(t.band.r2())},
         {"covered", page::number_or_null(fit::covered_share(t.torque_nm, t.torque_fit_nm, t.torque_sd_nm))}});
  }
  return json_text(object) + "\n";
}

void write_predict(const PredictResult& result, const std::filesystem::path& folder) {
  results::write_predictions(result.trials, result.muscles, result.provenance, folder);
  write_file(folder / "predictions.json", predict_json(result));
}

}  // namespace myoid::program
