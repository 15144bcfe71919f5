#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/body/kinematics/lumped_muscles.h"
#include "myoid/body/model/body_model.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Returns the study's model as text: its file with the sets that stand in files of their own, or the built-in arm made
/// for the subject.
[[nodiscard]] std::string model_text(const Study& study);

/// Reads the model of that text, once for all trials of a study. Throws ReadError, or ModelError
/// with the names in the model, if it lacks the study's coordinate, muscles or held-mass body.
[[nodiscard]] body::BodyModel load_model(const Study& study, const std::string& text);
[[nodiscard]] body::BodyModel load_model(const Study& study);

/// Returns the distance from the middle of the epicondyles to the middle of the styloids in every frame that shows all
/// four; empty without these markers of the built-in arm.
[[nodiscard]] std::vector<double> forearm_lengths_m(const MarkerSeries& markers);

/// Returns the built-in arm with the forearm length (elbow to middle of the styloids) that these
/// markers measure; the upper arm follows in de Leva's proportion. Empty if the study has a model
/// file or states the length, or if the markers do not show it.
[[nodiscard]] std::optional<body::BodyModel> arm_of_markers(const Study& study, const MarkerSeries& markers);

/// Returns the names of all bodies but the ground.
[[nodiscard]] std::vector<std::string> body_names(const body::BodyModel& model);

/// Returns the point at which a trial's held mass acts. Throws InvalidInput if the study does not state it.
[[nodiscard]] HeldMassSpec held_mass_place(const Study& study);

/// Returns true if the muscles in the fit have pennation and passive force of the model's.
[[nodiscard]] bool takes_model_law(const Study& study);

/// Returns the muscles to identify: one for each [[muscle]], with the heads lumped with their F_max
/// as weights, and with the priors of the literature.
[[nodiscard]] std::vector<fit::MuscleSetup> muscle_setups(const Study& study, const body::BodyModel& model);

/// Describes the starting values that a study without a body does not state and takes from the literature, in a
/// sentence; empty: none.
[[nodiscard]] std::string assumed_starts(const Study& study);

/// Returns the note that the default methods leave `paper` out, because a muscle has no EMG; empty: they do not.
[[nodiscard]] std::optional<Remark> without_paper(const Study& study);

/// Returns the model's muscles that make up each [[muscle]], weighted by their F_max.
[[nodiscard]] std::vector<body::MuscleGroup> muscle_groups(const Study& study, const body::BodyModel& model);

/// The identified numbers of a [[muscle]] for the model's text. F_max and optimal fiber length of its heads change in
/// the group's proportion. Thelen's muscles also get KshapeActive = (l_sh / l0)^2 if both are identified, Af = V_sh and
/// Flen = V_ml. The rest of the text stays byte for byte.
struct IdentifiedMuscle {
  std::string group;
  muscle::HillParameters<double> start, identified;
  std::vector<std::string> changed;  ///< Names of the parameters to write.
};
[[nodiscard]] std::string identified_model(const Study& study,
                                           const std::string& osim,
                                           const std::vector<IdentifiedMuscle>& muscles);

}  // namespace myoid::study
