#include "myoid/pipeline/trial_up.h"

#include <fmt/format.h>

#include "myoid/recording/plate_standing.h"

namespace myoid::pipeline {

std::optional<Vec3> stated_up(char markers_up) {
  if (markers_up == kUpOfTheFile) return std::nullopt;
  return Vec3::Unit(markers_up - 'x');
}

recording::LaboratoryUp trial_up(char markers_up, const std::filesystem::path& file) {
  if (const auto told = stated_up(markers_up)) return {told, "[markers] up"};
  recording::LaboratoryUp up = recording::read_laboratory_up(file);
  if (!up.up_L) return {Vec3::UnitY(), "nothing in the file tells"};
  return up;
}

std::string up_note(const recording::LaboratoryUp& up) {
  const std::string axis = recording::axis_name(up.up_L.value_or(Vec3::UnitY()));
  return axis == "y" ? fmt::format("y is up ({})", up.because)
                     : fmt::format("laboratory turned from {} up to y up ({})", axis, up.because);
}

}  // namespace myoid::pipeline
