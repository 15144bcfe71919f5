#include "myoid/body/scene/model_scene.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"
#include "myoid/body/model/path_polyline.h"
#include "myoid/body/scene/model_sticks.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/core/parallel.h"

namespace myoid::body {
namespace {

/// Returns rows of the clock that are at least 0.02 s apart, at most `most_frames`.
std::vector<Eigen::Index> chosen_frames(const Eigen::VectorXd& time_s, const SceneOptions& options) {
  constexpr double kMostFramesPerSecond = 50.0;
  const Eigen::Index count = time_s.size();
  const double duration = time_s[count - 1] - time_s[0];
  double step = 1.0 / kMostFramesPerSecond;
  if (duration / step > options.most_frames - 1) step = duration / (options.most_frames - 1);
  std::vector<Eigen::Index> rows;
  // Frame k is the first sample after k steps: as even as the samples allow.
  double next = time_s[0];
  for (Eigen::Index i = 0; i < count; ++i) {
    if (time_s[i] < next - 1e-3 * step) continue;
    rows.push_back(i);
    next = time_s[0] + step * (std::floor((time_s[i] - time_s[0]) / step + 1e-3) + 1.0);
  }
  return rows;
}

/// The place of a time between two samples; empty outside the clock.
struct Between {
  Eigen::Index before = 0, after = 0;
  double share = 0.0;
};
std::optional<Between> find_time(const Eigen::VectorXd& clock_s, double time_s) {
  constexpr double kSame_s = 1e-6;
  const double* const end = clock_s.data() + clock_s.size();
  const double* const after = std::lower_bound(clock_s.data(), end, time_s - kSame_s);
  if (after == end) return std::nullopt;
  const Eigen::Index i = after - clock_s.data();
  if (std::abs(*after - time_s) <= kSame_s) return Between{i, i, 0.0};
  if (i == 0) return std::nullopt;
  return Between{i - 1, i, (time_s - clock_s[i - 1]) / (clock_s[i] - clock_s[i - 1])};
}

page::SurfaceKind kind_of(const body::WrapObject& object) {
  if (std::holds_alternative<body::CylinderShape>(object.shape)) return page::SurfaceKind::cylinder;
  if (std::holds_alternative<body::TorusShape>(object.shape)) return page::SurfaceKind::torus;
  return page::SurfaceKind::ellipsoid;
}

Vec3 size_of(const body::WrapObject& object) {
  if (const auto* c = std::get_if<body::CylinderShape>(&object.shape)) return {c->radius_m, c->radius_m, c->length_m};
  if (const auto* t = std::get_if<body::TorusShape>(&object.shape)) return {t->inner_radius_m, t->outer_radius_m, 0.0};
  if (const auto* s = std::get_if<body::SphereShape>(&object.shape)) return Vec3::Constant(s->radius_m);
  return std::get<body::EllipsoidShape>(object.shape).radii_m;
}

bool is_fixed(const body::MusclePath& path) {
  return path.wraps.empty() && std::ranges::none_of(path.points, [](const body::PathPoint& p) {
           return p.condition.has_value() || p.moving.has_value();
         });
}

/// Returns all parts that do not depend on the posture.
page::Scene still_scene(const body::BodyModel& model) {
  page::Scene scene;
  if (!model.gravity_G.isZero(0.0)) scene.up = -model.gravity_G.normalized();
  const std::vector<BodySticks> sticks = body_sticks(model);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const body::Body& body = model.bodies[b];
    scene.bodies.push_back({body.name, body.mass_kg, body.p_BBcm_B, sticks[b]});
  }
  for (const body::Marker& m : model.markers) scene.markers.push_back({m.name, {m.body, m.p_BM}});
  std::vector<bool> is_used(model.wrap_objects.size(), false);
  for (std::size_t m = 0; m < model.muscles.size(); ++m) {
    const body::Muscle& muscle = model.muscles[m];
    page::SceneMuscle line{muscle.name, muscle.properties.max_isometric_force_n};
    if (is_fixed(muscle.path))
      for (const body::PathPoint& p : muscle.path.points) line.points.push_back({p.body, p.p_BP});
    else
      scene.moving_muscles.push_back(static_cast<int>(m));
    for (const body::PathWrap& wrap : muscle.path.wraps) is_used[at(wrap.wrap_object)] = true;
    scene.muscles.push_back(std::move(line));
  }
  for (std::size_t w = 0; w < model.wrap_objects.size(); ++w) {
    const body::WrapObject& object = model.wrap_objects[w];
    if (is_used[w] && object.active)
      scene.surfaces.push_back({object.name, object.body, object.X_BW, kind_of(object), size_of(object)});
  }
  for (const body::Coordinate& c : model.coordinates) {
    scene.coordinates.push_back({c.name, c.motion == body::MotionType::rotational      ? "deg"
                                         : c.motion == body::MotionType::translational ? "m"
                                                                                       : ""});
  }
  return scene;
}

/// Adds poses and moving lines in every frame, in parallel with one state per piece of work.
void place(const body::BodyModel& model, const Eigen::MatrixXd& q, page::Scene& scene) {
  const Eigen::Index frames = q.rows();
  scene.poses.resize(at(frames));
  scene.lines_m.resize(at(frames));
  parallel_ranges<Eigen::Index>(frames, 16, [&](const auto& range) {
    body::BodyState state = body::make_state(model);
    body::PathWorkspace workspace;
    body::PathResult result;
    for (Eigen::Index f = range.begin(); f != range.end(); ++f) {
      body::compute_poses(model, q.row(f).transpose(), state);
      state.qdot.setZero();
      body::compute_velocities(model, state.qdot, state);
      scene.poses[at(f)] = state.X_GB;
      auto& lines = scene.lines_m[at(f)];
      for (const int m : scene.moving_muscles) {
        const body::MusclePath& path = model.muscles[at(m)].path;
        body::compute_path(model, path, state, workspace, result);
        lines.push_back(body::path_polyline(model, path, state, workspace.stations));
      }
    }
  });
  scene.coordinate_values = q;
  for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
    if (model.coordinates[c].motion == body::MotionType::rotational)
      scene.coordinate_values.col(static_cast<Eigen::Index>(c)) /= kDegree;
  }
}

/// Returns true if a column of a result or states file belongs to the muscle.
bool belongs_to(std::string_view column, std::string_view muscle, std::string_view quantity) {
  const auto without_suffix = [&](std::string_view text) {
    for (const char mark : {'/', '.', '|'}) {
      const std::string suffix = std::string(1, mark) + std::string(quantity);
      if (text.size() > suffix.size() && text.ends_with(suffix)) return text.substr(0, text.size() - suffix.size());
    }
    return text;
  };
  std::string_view name = without_suffix(column);
  if (const std::size_t slash = name.rfind('/'); slash != std::string_view::npos) name.remove_prefix(slash + 1);
  return name == muscle;
}

/// Rounds up to two significant digits.
double rounded_up(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return unit * std::ceil(value / unit - 1e-9);
}

void add_coloring(const body::BodyModel& model, const MuscleColoring& coloring, page::Scene& scene) {
  const auto muscles = static_cast<Eigen::Index>(model.muscles.size());
  Eigen::MatrixXd values = Eigen::MatrixXd::Constant(scene.time_s.size(), muscles, kNan);
  std::vector<std::string> without;
  for (Eigen::Index m = 0; m < muscles; ++m) {
    const std::string& name = model.muscles[at(m)].name;
    const auto& channels = coloring.series.channels();
    const auto found = std::ranges::find_if(
        channels, [&](const Channel& channel) { return belongs_to(channel.name, name, coloring.name); });
    if (found == channels.end()) {
      without.push_back(name);
      continue;
    }
    const Eigen::Index column = found - channels.begin();
    for (Eigen::Index f = 0; f < scene.time_s.size(); ++f) {
      const auto time = find_time(coloring.series.time_s(), scene.time_s[f]);
      if (!time) continue;
      const double before = coloring.series.values()(time->before, column);
      const double after = coloring.series.values()(time->after, column);
      values(f, m) = before + time->share * (after - before);
    }
  }
  if (without.size() == model.muscles.size()) {
    throw InvalidInput(fmt::format(
        "no column of the {} file is a muscle of the model; its columns begin with '{}', the muscles with '{}'",
        coloring.name, coloring.series.channels().empty() ? "" : coloring.series.channels().front().name,
        without.empty() ? "" : without.front()));
  }
  if (!without.empty()) {
    constexpr std::size_t kNamed = 6;
    const std::size_t named = std::min(kNamed, without.size());
    const std::span<const std::string> first(without.data(), named);
    scene.notes.push_back(
        {.severity = Severity::note,
         .says = fmt::format("No {} is given for {} of {} muscles: {}{}.", coloring.name, without.size(), muscles,
                             fmt::join(first, ", "), without.size() > named ? ", ..." : "")});
  }
  double top = coloring.unit.empty() ? 1.0 : 0.0;
  bool any = false;
  for (const double v : values.reshaped()) {
    any = any || std::isfinite(v);
    if (std::isfinite(v) && !coloring.unit.empty()) top = std::max(top, v);
  }
  if (!any)
    scene.notes.push_back(
        {.severity = Severity::note, .says = fmt::format("The {} file has no samples at these times.", coloring.name)});
  scene.values.push_back({coloring.name, coloring.unit, top > 0.0 ? rounded_up(top) : 1.0, std::move(values)});
}

void add_measured(const MarkerSeries& markers, page::Scene& scene) {
  scene.measured_markers = markers.names;
  scene.measured_m.setConstant(scene.time_s.size(), markers.positions_m.cols(), kNan);
  for (Eigen::Index f = 0; f < scene.time_s.size(); ++f) {
    const auto time = find_time(markers.time_s, scene.time_s[f]);
    if (!time) continue;
    scene.measured_m.row(f) = (1.0 - time->share) * markers.positions_m.row(time->before) +
                              time->share * markers.positions_m.row(time->after);
  }
  const auto count = std::ranges::count_if(markers.names, [&](const std::string& name) {
    return std::ranges::find(scene.markers, name, &page::SceneMarker::name) != scene.markers.end();
  });
  if (count < markers.marker_count()) {
    scene.notes.push_back(
        {.severity = Severity::note,
         .says = fmt::format(
             "{} of {} measured markers have no marker of their name in the model: no error is drawn for them.",
             markers.marker_count() - count, markers.marker_count())});
  }
  if (!scene.measured_m.array().isFinite().any())
    scene.notes.push_back({.severity = Severity::note, .says = "No marker was measured at these times."});
}

}  // namespace

page::Scene model_scene(const body::BodyModel& model, const SceneInput& input, const SceneOptions& options) {
  page::Scene scene = still_scene(model);
  scene.name = input.name;
  Eigen::MatrixXd q = model.default_q().transpose();
  scene.time_s = Eigen::VectorXd::Zero(1);
  if (!input.q.empty()) {
    if (input.q.channel_count() != static_cast<Eigen::Index>(model.coordinates.size())) {
      throw InvalidInput(fmt::format("expected the values of {} coordinates, found {} channels",
                                     model.coordinates.size(), input.q.channel_count()));
    }
    const std::vector<Eigen::Index> rows = chosen_frames(input.q.time_s(), options);
    q = input.q.values()(rows, Eigen::all);
    scene.time_s = input.q.time_s()(rows);
    if (static_cast<Eigen::Index>(rows.size()) < input.q.sample_count()) {
      scene.notes.push_back(
          {.severity = Severity::note,
           .says = fmt::format(
               "{} of {} samples are shown, {:.3g} of {:.3g} per second.", rows.size(), input.q.sample_count(),
               static_cast<double>(rows.size() - 1) / (scene.time_s[scene.time_s.size() - 1] - scene.time_s[0]),
               input.q.mean_rate_hz())});
    }
  }
  place(model, q, scene);
  for (const std::string& text : model.unsupported)
    scene.notes.push_back({.code = RemarkCode::model_unsupported, .says = text});
  for (const MuscleColoring& coloring : input.colorings) add_coloring(model, coloring, scene);
  if (input.markers != nullptr) add_measured(*input.markers, scene);
  return scene;
}

}  // namespace myoid::body
