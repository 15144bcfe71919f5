#include "myoid/study/checks/unloaded_times.h"

#include <algorithm>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/dynamics/ground_support.h"
#include "myoid/ground/math/decompositions.h"
#include "myoid/study/intake/limits.h"

namespace myoid::study {
namespace {

/// Returns the mean height of the markers that all frames show, or of the joint to the ground.
std::optional<Eigen::VectorXd> height_of(const body::BodyModel& model, const TrialInput& input) {
  if (!input.markers) {
    const auto root = body::unsupported_weight(model);
    const auto column = root ? input.motion->find(root->coordinate) : std::nullopt;
    if (!column) return std::nullopt;
    return input.motion->values().col(*column);
  }
  const MarkerSeries& markers = *input.markers;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(markers.frame_count());
  double count = 0.0;
  for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
    const Eigen::VectorXd height = markers.positions_m.middleCols(3 * m, 3) * -model.gravity_G.normalized();
    if (!height.allFinite()) continue;
    sum += height;
    count += 1.0;
  }
  if (!(count > 0.0)) return std::nullopt;
  return sum / count;
}

/// Returns the acceleration of the parabola through these samples.
double acceleration_of(const Eigen::VectorXd& time_s, const Eigen::VectorXd& height_m) {
  Eigen::MatrixXd terms(time_s.size(), 3);
  const Eigen::ArrayXd t = time_s.array() - time_s.mean();
  terms.col(0).setOnes();
  terms.col(1) = t;
  terms.col(2) = 0.5 * t.square();
  return math::nearest_solution(terms, height_m)[2];
}

}  // namespace

std::vector<Remark> unloaded_times(const body::BodyModel& model, const TrialSpec& trial, const TrialInput& input) {
  if (!input.loads || (!input.markers && !input.motion)) return {};
  const auto weight = body::unsupported_weight(model);
  const auto height = weight ? height_of(model, input) : std::nullopt;
  if (!height) return {};
  const Eigen::VectorXd& t = input.markers ? input.markers->time_s : input.motion->time_s();
  const double g = model.gravity_G.norm();
  const Vec3 up = -model.gravity_G / g;
  Eigen::VectorXd share(t.size());
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    double sum = 0.0;
    const double at = input.loads->data_time_s(t[i]);
    for (const body::ExternalForce& force : input.loads->forces) {
      if (force.body != 0 && force.force_frame == 0 && force.force) sum += up.dot(force.force->at(at));
    }
    share[i] = sum / weight->weight_n;
  }
  if (share.maxCoeff() < kLimits.weight.bears) return {};  // forces on the hands do not carry the body
  std::vector<std::string> times;
  double sum_s = 0.0;
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    const Eigen::Index first = i;
    while (i < t.size() && share[i] < kLimits.weight.bears_nothing) ++i;
    if (i == first || t[i - 1] - t[first] < kLimits.weight.unloaded_s || i - first < 4) continue;
    // A body in the air falls without any plate.
    if (acceleration_of(t.segment(first, i - first), height->segment(first, i - first)) < -kLimits.weight.falls * g)
      continue;
    // As `run` measures it: as long as a quarter of the weight is not carried.
    const auto affected = [&](Eigen::Index k) { return share[k] <= 1.0 - body::kAffectedWeight; };
    Eigen::Index from = first, to = i - 1;
    while (from > 0 && affected(from - 1)) --from;
    while (to + 1 < t.size() && affected(to + 1)) ++to;
    times.push_back(fmt::format("{:.4g} to {:.4g} s", t[from], t[to]));
    sum_s += t[to] - t[from];
    i = std::max(i, to);
  }
  if (times.empty()) return {};
  return {{.code = RemarkCode::unloaded_time,
           .severity = Severity::warning,
           .where = trial.name,
           .about = "ground",
           .says = fmt::format(
               "no measured force carries the body in {:.0f} % of the trial ({}), and it does not fall: was a foot "
               "beside the plates? `run` does not fit those times; start_s and end_s leave them out altogether",
               100.0 * sum_s / (t[t.size() - 1] - t[0]), fmt::join(times, ", "))}};
}

}  // namespace myoid::study
