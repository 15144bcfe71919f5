#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/ground/core/choice.h"
#include "myoid/results/exports/activation_match.h"

namespace myoid::results {

/// The forms in which identified muscles are written for other programs.
enum class ExportFormat {
  osim,       ///< The study's model with identified numbers; written where one is identified.
  ceinms,     ///< Subject of CEINMS 0.21.
  ceinms_rt,  ///< Subject of CEINMS-RT.
  osimx,      ///< Muscles of the NMSM Pipeline.
};
inline constexpr std::string_view kExportFormatNames[] = {"osim", "ceinms", "ceinms-rt", "osimx"};
constexpr ChoiceNames choice_names(ExportFormat) { return kExportFormatNames; }

/// The numbers that a file gives a muscle of the fit, and the parts of its program's law that they do not tell.
struct ForeignMuscle {
  fit::MuscleValues values{};    ///< CEINMS: our law with these is theirs. NMSM: of them force, lengths, pennation.
  CeinmsActivation ceinms = {};  ///< Of CEINMS, CEINMS-RT; the scale is in the values.
  NmsmActivation nmsm = {};
};

/// The greatest difference of a muscle's force by another program's law from ours over the recorded samples.
struct LawDifference {
  std::string muscle;
  double of_max_force = 0.0;  ///< Over F_max.
  std::string trial;
  double time_s = 0.0;
};

/// Compares the forces by both laws at all samples of all trials, muscle by muscle. `channels` is the channel of each
/// muscle among those of the fit. An elastic tendon of CEINMS changes the fiber's rate, which ours leaves out.
[[nodiscard]] std::vector<LawDifference> law_differences(const fit::StudyData& data,
                                                         const fit::IdentificationResult& fit,
                                                         const std::vector<int>& channels,
                                                         const std::vector<ForeignMuscle>& theirs,
                                                         ExportFormat format);

}  // namespace myoid::results
