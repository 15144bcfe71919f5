#include "myoid/study/checks/marker_distance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/kinematics/marker_misfit.h"
#include "myoid/study/intake/limits.h"
#include "myoid/study/intake/trial_model.h"

namespace myoid::study {

std::optional<Remark> far_markers(const Study& study,
                                  const TrialSpec& trial,
                                  const body::BodyModel& model,
                                  const MarkerSeries& markers,
                                  const body::IkResult& solved) {
  body::MarkerMisfit misfit = body::marker_misfit(model, markers, solved);
  if (misfit.warning.empty()) return std::nullopt;
  const bool stands = study.model.is_arm() && !misfit.wrong_unit &&
                      std::ranges::find(study.ik.unlock, "base_tx") == study.ik.unlock.end();
  return Remark{.code = misfit.wrong_unit ? RemarkCode::marker_unit : RemarkCode::model_unfit,
                .where = trial.name,
                .about = "markers",
                .value = misfit.rms_m,
                .says = std::move(misfit.warning),
                .remedy = stands ? "the trunk of the built-in arm stands still: with forearm_rotations = true in "
                                   "[model] and unlock = [\"base_heading\", \"base_tx\", \"base_ty\", \"base_tz\"] in "
                                   "[ik] it moves; or name a model of this marker set"
                                 : ""};
}

std::optional<Remark> distant_markers(const Study& study,
                                      const TrialSpec& trial,
                                      const body::BodyModel& model,
                                      const TrialInput& input) {
  if (!input.markers) return std::nullopt;
  const std::optional<body::BodyModel> own = trial_model(study, model, trial, input);
  const MarkerSeries frames = body::spread_frames(*input.markers);
  const body::IkResult solved =
      body::inverse_kinematics(own ? *own : model, frames, {.marker_weights = study.markers.weight});
  if (auto far = far_markers(study, trial, own ? *own : model, frames, solved)) {
    far->says += fmt::format(" ({:.0f} mm rms in {} frames of the trial)", 1e3 * *far->value, frames.frame_count());
    return far;
  }
  double worst_m = 0.0;
  for (const double rms_m : solved.errors.column("marker_error_RMS"))
    if (std::isfinite(rms_m)) worst_m = std::max(worst_m, rms_m);
  if (worst_m < kGateLimits.marker_error_m) return std::nullopt;
  return Remark{
      .code = RemarkCode::model_unfit,
      .where = trial.name,
      .about = "markers",
      .value = worst_m,
      .says = fmt::format("the markers lie {:.0f} mm rms from the model's in the worst of {} frames, expected "
                          "below {:.0f} mm",
                          1e3 * worst_m, frames.frame_count(), 1e3 * kGateLimits.marker_error_m),
      .remedy = "scale the model to the person, or correct labels and [markers] weight"};
}

}  // namespace myoid::study
