#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/study/draft/draft_recordings.h"

namespace myoid::study {

/// Leaves out the models that cannot be read, with a remark on each.
void leave_out_unreadable(std::vector<std::filesystem::path>& models, std::vector<Remark>& remarks);

/// A model and the number of recorded markers that it knows.
struct ModelByMarkers {
  std::filesystem::path model;
  Eigen::Index markers = 0;  ///< 0: no model knows more than the others.
};

/// Returns the model that knows the most markers of the first recordings with markers. Of models that know
/// equally many none is chosen. Throws as `read_osim`.
[[nodiscard]] ModelByMarkers model_of_markers(const std::vector<std::filesystem::path>& models,
                                              const std::vector<std::filesystem::path>& files);

/// True if the EMG is of a leg's muscles and none of an arm's; without EMG of either, if four or more markers have the
/// usual names of a leg's or a pelvis', and one of a leg's (LASI, RKNE, R.Heel, ...).
[[nodiscard]] bool is_of_a_leg(const std::vector<FoundRecording>& found);

/// Pairs the markers of a recording with the built-in arm's by the usual names of the same place on the right arm or
/// the trunk (ISB, Vicon's upper body: RELB, EL, RWRA, US): recorded name and the arm's. A name that the arm has, or a
/// place that two recorded markers claim, takes no part.
[[nodiscard]] std::map<std::string, std::string> usual_arm_markers(const std::vector<std::string>& recorded);

}  // namespace myoid::study
