#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/kinematics/inverse_kinematics.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/study/draft/draft_recordings.h"

namespace myoid::study {

/// Leaves out the models that cannot be read, with a remark on each.
void leave_out_unreadable(std::vector<std::filesystem::path>& models, std::vector<Remark>& remarks);

/// A model, the number of recorded markers that it knows, and how far they lie from the model's.
struct ModelByMarkers {
  std::filesystem::path model;
  Eigen::Index markers = 0;     ///< 0: no model is better than the others.
  std::optional<double> rms_m;  ///< By `quick_motion` of the first recording; empty: no other knows nearly as many.
};

/// Returns the model that knows the most markers of the first recordings with markers; of models that know four in five
/// of so many, that to which they lie nearest. Of equal models none is chosen. Throws as `read_osim`.
[[nodiscard]] ModelByMarkers model_of_markers(const std::vector<std::filesystem::path>& models,
                                              const std::vector<std::filesystem::path>& files);

/// Solves inverse kinematics in a few frames of a recording (body::spread_frames), with the vertical by which its
/// markers stand upright. Empty if fewer than four markers are known, or no frame can be solved.
[[nodiscard]] std::optional<body::IkResult> quick_motion(const body::BodyModel& model, MarkerSeries markers);

/// True if the EMG is of a leg's muscles and none of an arm's; without EMG of either, if four or more markers have the
/// usual names of a leg's or a pelvis', and one of a leg's (LASI, RKNE, R.Heel, ...).
[[nodiscard]] bool is_of_a_leg(const std::vector<FoundRecording>& found);

/// Pairs the markers of a recording with the built-in arm's by the usual names of the same place on the right arm or
/// the trunk (ISB, Vicon's upper body: RELB, EL, RWRA, US): recorded name and the arm's. A name that the arm has, or a
/// place that two recorded markers claim, takes no part.
[[nodiscard]] std::map<std::string, std::string> usual_arm_markers(const std::vector<std::string>& recorded);

}  // namespace myoid::study
