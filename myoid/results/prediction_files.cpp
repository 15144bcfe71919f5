#include "myoid/results/prediction_files.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "myoid/fit/methods/prediction.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/result_names.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/page/tables.h"
#include "myoid/recording/tables/storage_writer.h"
#include "myoid/results/stage_files.h"

namespace myoid::results {
namespace {

/// Returns each text of a member once, in the order in which the texts appear.
std::vector<std::string> unique_values(const std::vector<fit::TrialFit>& predictions,
                                       std::string fit::TrialFit::*member) {
  std::vector<std::string> values;
  for (const fit::TrialFit& each : predictions) {
    if (std::ranges::find(values, each.*member) == values.end()) values.push_back(each.*member);
  }
  return values;
}

}  // namespace

Band prediction_band(const Eigen::VectorXd& mean, const Eigen::VectorXd& sd) {
  if (sd.size() != mean.size()) return {};
  const double reach = math::normal_quantile(0.975);
  return {mean - reach * sd, mean + reach * sd};
}

std::string band_sentence(const std::vector<fit::TrialFit>& predictions) {
  const bool by_posterior =
      std::ranges::any_of(predictions, [](const fit::TrialFit& trial) { return !trial.drive.empty(); });
  return by_posterior
             ? "Bands are of the person: that of a torque holds the parameters, the errors of moment arms, tendons and "
               "sensors as far as the fitted trials show them, and the noise; that of a force holds the parameters, "
               "given the drive and the lengths."
             : "The run fitted data without noise: there are no bands.";
}

NameIds prediction_folders(const std::vector<fit::TrialFit>& predictions) {
  return NameIds(unique_values(predictions, &fit::TrialFit::trial), IdFor::file, result_names());
}

void write_prediction(const fit::TrialFit& prediction,
                      const std::vector<std::string>& muscles,
                      const NameIds& joints,
                      const std::filesystem::path& folder,
                      const std::vector<std::string>& comments) {
  SeriesColumns torque;
  const std::string& joint = prediction.joint;
  if (prediction.torque_fit_nm.size() > 0) {
    if (prediction.torque_nm.size() == prediction.torque_fit_nm.size() && prediction.torque_nm.allFinite())
      torque.add(joint + "_measured", Unit::newton_meter, prediction.torque_nm);
    torque.add(joint + "_predicted", Unit::newton_meter, prediction.torque_fit_nm);
    Band band = prediction_band(prediction.torque_fit_nm, prediction.torque_sd_nm);
    if (band.low.size() > 0) {
      torque.add(joint + "_low", Unit::newton_meter, std::move(band.low));
      torque.add(joint + "_high", Unit::newton_meter, std::move(band.high));
    }
    recording::write_storage(folder / fmt::format("predicted_torque_{}.sto", joints.of(joint)),
                             torque.series(prediction.time_s), {.title = "Predicted torque", .comments = comments});
  }
  SeriesColumns forces;
  for (std::size_t k = 0; k < muscles.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    forces.add(muscles[k], Unit::newton, prediction.force_fit_n.col(column));
    if (prediction.force_sd_n.cols() <= column) continue;
    Band band = prediction_band(prediction.force_fit_n.col(column), prediction.force_sd_n.col(column));
    forces.add(muscles[k] + "_low", Unit::newton, band.low.cwiseMax(0.0));
    forces.add(muscles[k] + "_high", Unit::newton, std::move(band.high));
  }
  recording::write_storage(folder / "predicted_forces.sto", forces.series(prediction.time_s),
                           {.title = "Predicted forces", .comments = comments});
  if (!prediction.drive.empty())
    recording::write_storage(folder / "drive.sto", prediction.drive, {.title = "Drive", .comments = comments});
}

void write_predictions(const std::vector<fit::TrialFit>& predictions,
                       const std::vector<std::string>& muscles,
                       const Provenance& provenance,
                       const std::filesystem::path& folder) {
  const std::vector<std::string> comments{fmt::format("Made by myoid {}.", provenance.version),
                                          band_sentence(predictions)};
  const NameIds folders = prediction_folders(predictions);
  const NameIds joints(unique_values(predictions, &fit::TrialFit::joint));
  for (const fit::TrialFit& trial : predictions)
    write_prediction(trial, muscles, joints, folder / folders.of(trial.trial), comments);
  write_file(folder / "predictions.csv", predictions_csv(predictions));
}

void write_held_back(const fit::IdentificationResult& fit,
                     const fit::StudyData& data,
                     const Provenance& provenance,
                     const std::filesystem::path& folder) {
  std::vector<fit::TrialFit> held_back;
  std::copy_if(fit.trials.begin(), fit.trials.end(), std::back_inserter(held_back),
               [](const fit::TrialFit& trial) { return !trial.calibration; });
  if (held_back.empty()) return;
  std::vector<std::string> muscles;
  for (const fit::MuscleSetup& muscle : data.muscles) muscles.push_back(muscle.name);
  write_predictions(held_back, muscles, provenance, folder);
}

std::string predictions_csv(const std::vector<fit::TrialFit>& predictions) {
  page::Table table{.columns = {"trial", "joint", "fitted", "samples", "rmse_nm", "nrmse_range", "r2", "band_rmse_nm",
                                "band_r2", "covered"}};
  for (const fit::TrialFit& p : predictions) {
    const double covered = fit::covered_share(p.torque_nm, p.torque_fit_nm, p.torque_sd_nm);
    std::vector<std::string> row{p.trial, p.joint, p.calibration ? "true" : "false"};
    for (const double value :
         {p.score.n, p.score.rmse_nm(), p.score.nrmse_range(), p.score.r2(), p.band.rmse_nm(), p.band.r2(), covered})
      row.push_back(std::isfinite(value) ? format_number(value) : "");
    table.rows.push_back(page::text_row(std::move(row)));
  }
  return page::table_csv(table);
}

}  // namespace myoid::results
