#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/files/marker_series.h"
#include "myoid/identification/study_data.h"
#include "myoid/kinematics/lumped_muscles.h"
#include "myoid/model/body_model.h"
#include "myoid/muscle/thelen.h"
#include "myoid/study/study.h"

namespace myoid {

/// The study's model as text: its file, or the built-in arm made for the subject. `markers`, if
/// given, set the built-in arm's forearm length (elbow to middle of the styloids) where the study
/// does not; the upper arm follows in de Leva's proportion.
[[nodiscard]] std::string model_text(const Study& study,
                                     const recording::MarkerSeries* markers = nullptr);

/// The model itself. Throws ReadError, or ModelError if the study's coordinate, muscles or
/// held-mass body are not in it, with the names that are.
[[nodiscard]] model::BodyModel load_model(const Study& study,
                                          const recording::MarkerSeries* markers = nullptr);

/// What is identified: one entry per [[muscle]], heads lumped with their F_max as weights, with the
/// priors of the literature.
[[nodiscard]] std::vector<identification::MuscleSetup> muscle_setups(const Study& study,
                                                                     const model::BodyModel& model);

/// The model's muscles that make up each [[muscle]], weighted by their F_max.
[[nodiscard]] std::vector<kinematics::MuscleGroup> muscle_groups(const Study& study,
                                                                 const model::BodyModel& model);

/// The model's text in which only the identified numbers changed, of the muscles of each group:
/// F_max and optimal fiber length in the proportion in which the group's changed, and of Thelen's
/// muscles KshapeActive = (l_sh / l0)^2 where both are identified, Af = V_sh and Flen = V_ml.
/// Everything else stays byte for byte.
struct IdentifiedMuscle {
  std::string group;
  muscle::HillParameters<double> start, identified;
  std::vector<std::string> changed;  ///< Parameter names that may be taken over.
};
[[nodiscard]] std::string identified_model(const Study& study,
                                           const std::string& osim,
                                           const std::vector<IdentifiedMuscle>& muscles);

}  // namespace myoid
