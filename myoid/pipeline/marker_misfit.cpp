#include "myoid/pipeline/marker_misfit.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/pipeline/marker_segments.h"
#include "myoid/signals/marker_quality.h"

namespace myoid::pipeline {

MarkerMisfit marker_misfit(const model::BodyModel& model,
                           const recording::MarkerSeries& markers,
                           const kinematics::IkResult& solved) {
  constexpr double kFar_m = 0.04;
  MarkerMisfit misfit;
  double sum = 0.0;
  int seen = 0;
  for (const double value : solved.errors.column("marker_error_RMS")) {
    if (std::isnan(value)) continue;
    sum += value * value;
    ++seen;
  }
  misfit.rms_m = std::sqrt(sum / std::max(1, seen));
  if (misfit.rms_m <= kFar_m) return misfit;
  if (const auto fault = signals::check_marker_unit(markers, segments_of(model, markers))) {
    misfit.wrong_unit = true;
    misfit.warning = fmt::format("{}: {}", fault->text, fault->remedy);
  } else {
    misfit.warning =
        "the markers lie far from the model's: another model, other units or swapped labels? The "
        "angles may still fit, the marker errors do not";
  }
  return misfit;
}

}  // namespace myoid::pipeline
