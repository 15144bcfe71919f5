#include "myoid/study/trial_up.h"

#include <fmt/format.h>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/ground/math/decompositions.h"
#include "myoid/recording/plate_standing.h"

namespace myoid::study {

std::optional<Vec3> stated_up(char markers_up) {
  if (markers_up == kUpOfTheFile) return std::nullopt;
  return Vec3::Unit(markers_up - 'x');
}

Vec3 model_up(const body::BodyModel& model) {
  if (!(model.gravity_G.norm() > 0.0)) return Vec3::UnitY();
  return *recording::axis_vector(recording::axis_name(-model.gravity_G));
}

Mat3 rotation_onto(const body::BodyModel& model, const Vec3& up_L) {
  return recording::rotation_to_y_up(model_up(model)).transpose() * recording::rotation_to_y_up(up_L);
}

recording::LaboratoryUp trial_up(char markers_up, const std::filesystem::path& file, const body::BodyModel& model) {
  if (const auto told = stated_up(markers_up)) return {told, "[markers] up"};
  recording::LaboratoryUp up = recording::read_laboratory_up(file);
  if (!up.up_L) return {model_up(model), "nothing in the file tells"};
  return up;
}

std::string up_note(const recording::LaboratoryUp& up, const body::BodyModel& model) {
  const std::string to = recording::axis_name(model_up(model));
  const std::string from = up.up_L ? recording::axis_name(*up.up_L) : to;
  return from == to ? fmt::format("{} is up ({})", from, up.because)
                    : fmt::format("laboratory turned from {} up to {} up ({})", from, to, up.because);
}

std::optional<double> upright(const body::BodyModel& model, const MarkerSeries& markers, const Vec3& up_L) {
  const MarkerSeries turned = rotated(markers, rotation_onto(model, up_L));
  body::BodyState state = body::make_state(model);
  body::compute_poses(model, model.default_q(), state);
  for (Eigen::Index f = 0; f < std::min<Eigen::Index>(turned.frame_count(), 200); ++f) {
    Eigen::Matrix3Xd a(3, 0), b(3, 0);
    for (Eigen::Index m = 0; m < turned.marker_count(); ++m) {
      const auto known = model.find_marker(turned.names[static_cast<std::size_t>(m)]);
      if (!known || turned.missing(f, m)) continue;
      const body::Marker& marker = model.markers[static_cast<std::size_t>(*known)];
      a.conservativeResize(Eigen::NoChange, a.cols() + 1);
      b.conservativeResize(Eigen::NoChange, b.cols() + 1);
      a.col(a.cols() - 1) = state.X_GB[static_cast<std::size_t>(marker.body)] * marker.p_BM;
      b.col(b.cols() - 1) = turned.position(f, m);
    }
    if (a.cols() < 4) continue;
    const Vec3 mean_a = a.rowwise().mean(), mean_b = b.rowwise().mean();
    const Mat3 h = (b.colwise() - mean_b) * (a.colwise() - mean_a).transpose();
    const Mat3 R = math::nearest_rotation(h);
    const Vec3 down = model.gravity_G.norm() > 0.0 ? model.gravity_G.normalized() : Vec3(0, -1, 0);
    return (R * down).dot(down);
  }
  return std::nullopt;
}

std::optional<UprightAxis> upright_axis(const body::BodyModel& model,
                                        const MarkerSeries& markers,
                                        const std::vector<std::string>& axes) {
  constexpr double kSame = 1e-9;
  std::optional<UprightAxis> best;
  for (const std::string& axis : axes) {
    const std::optional<double> cosine = upright(model, markers, *recording::axis_vector(axis));
    if (cosine && (!best || *cosine > best->cosine + kSame)) best = {axis, *cosine};
  }
  return best;
}

}  // namespace myoid::study
