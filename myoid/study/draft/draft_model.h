#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Core>

#include "myoid/study/draft/draft_recordings.h"

namespace myoid::study {

/// A model and the number of recorded markers that it knows.
struct ModelByMarkers {
  std::filesystem::path model;
  Eigen::Index markers = 0;  ///< 0: no model knows more than the others.
};

/// Returns the model that knows the most markers of the first recordings with markers. Models that cannot be read know
/// none. Of models that know equally many none is chosen.
[[nodiscard]] ModelByMarkers model_of_markers(const std::vector<std::filesystem::path>& models,
                                              const std::vector<std::filesystem::path>& files);

/// True if four or more markers have the usual names of a leg's or a pelvis' (LASI, RKNE, R.Heel, ...).
[[nodiscard]] bool is_of_a_leg(const std::vector<FoundRecording>& found);

}  // namespace myoid::study
