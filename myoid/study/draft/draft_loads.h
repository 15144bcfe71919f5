#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/recording/force_plate.h"
#include "myoid/study/draft/draft_text.h"

namespace myoid::study {

/// A mass that a name speaks of.
struct NamedMass {
  double value = 0.0;
  std::string unit;  ///< "kg", "lb"; empty: the name does not say.
  [[nodiscard]] double kg() const;
};

/// Returns the mass in a name in small letters: "flex_2.5kg", "load5p5", "5lb_slow".
[[nodiscard]] std::optional<NamedMass> mass_in_name(const std::string& name);

/// Returns markers that the model lacks and that move as one rigid body, three or more, which no marker of the model
/// belongs to: of a box or a tool. Distances among them change by less than 2.5 mm, those to the nearest marker of the
/// model by more than 20 mm (standard deviations).
[[nodiscard]] std::vector<std::string> object_markers(const MarkerSeries& markers, const body::BodyModel& model);

/// Returns the channels that may be those of a load cell: they vary, no plate has them, and they are in N, N m or named
/// like a force, or in volts beside channels that are named EMG.
[[nodiscard]] std::vector<std::string> load_channels(const TimeSeries& analog,
                                                     const std::vector<recording::PlateSetup>& plates);

/// Returns true if all channels of these names are in N m, as a dynamometer's are; a load cell has forces.
[[nodiscard]] bool only_torques(const TimeSeries& analog, const std::vector<std::string>& names);

/// Returns the question of tables with torques in N m that name no joint: how their columns must be called for `init`
/// to make trials of them. `coordinate`: the study's.
[[nodiscard]] std::string question_of_torques(const std::vector<std::string>& files, const std::string& coordinate);

/// Signs of loads on the person that a recording holds.
struct LoadHints {
  std::vector<std::string> object_markers = {}, channels = {};
  bool only_torques = false;  ///< All `channels` are in N m.
};

/// Asks what was held in a trial whose loads no file states, with the mass that its name tells. `asked`: the question
/// stands at an earlier trial; set to true.
void ask_for_loads(const std::string& stem, const LoadHints& hints, bool own_model, bool& asked, DraftText& out);

}  // namespace myoid::study
