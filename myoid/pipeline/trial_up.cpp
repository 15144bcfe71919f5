#include "myoid/pipeline/trial_up.h"

#include <fmt/format.h>

#include "myoid/recording/plate_standing.h"

namespace myoid::pipeline {

std::optional<Vec3> stated_up(char markers_up) {
  if (markers_up == kUpOfTheFile) return std::nullopt;
  return Vec3::Unit(markers_up - 'x');
}

Vec3 model_up(const model::BodyModel& model) {
  if (!(model.gravity_G.norm() > 0.0)) return Vec3::UnitY();
  return *recording::axis_vector(recording::axis_name(-model.gravity_G));
}

Mat3 rotation_onto(const model::BodyModel& model, const Vec3& up_L) {
  return recording::rotation_to_y_up(model_up(model)).transpose() *
         recording::rotation_to_y_up(up_L);
}

recording::LaboratoryUp trial_up(char markers_up,
                                 const std::filesystem::path& file,
                                 const model::BodyModel& model) {
  if (const auto told = stated_up(markers_up)) return {told, "[markers] up"};
  recording::LaboratoryUp up = recording::read_laboratory_up(file);
  if (!up.up_L) return {model_up(model), "nothing in the file tells"};
  return up;
}

std::string up_note(const recording::LaboratoryUp& up, const model::BodyModel& model) {
  const std::string to = recording::axis_name(model_up(model));
  const std::string from = up.up_L ? recording::axis_name(*up.up_L) : to;
  return from == to
             ? fmt::format("{} is up ({})", from, up.because)
             : fmt::format("laboratory turned from {} up to {} up ({})", from, to, up.because);
}

}  // namespace myoid::pipeline
