#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/files/marker_series.h"
#include "myoid/identification/study_data.h"
#include "myoid/kinematics/lumped_muscles.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// The study's model as text: its file, or the built-in arm made for the subject.
[[nodiscard]] std::string model_text(const Study& study);

/// The model of that text, read once for all trials of a study. Throws ReadError, or ModelError if
/// the study's coordinate, muscles or held-mass body are not in it, with the names that are.
[[nodiscard]] model::BodyModel load_model(const Study& study, const std::string& text);
[[nodiscard]] model::BodyModel load_model(const Study& study);

/// The built-in arm with the forearm length (elbow to middle of the styloids) that these markers
/// measure; the upper arm follows in de Leva's proportion. Empty where that is the study's model:
/// it has a model file, states the length, or the markers do not show it.
[[nodiscard]] std::optional<model::BodyModel> arm_of_markers(
    const Study& study, const recording::MarkerSeries& markers);

/// The point that a trial's held mass acts at. Throws InvalidInput where the study does not say it.
[[nodiscard]] HeldMassSpec held_mass_place(const Study& study);

/// The muscles to identify: one entry per [[muscle]], heads lumped with their F_max as weights,
/// with the priors of the literature.
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
