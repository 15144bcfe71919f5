#include "myoid/recording/plate_zero.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace myoid::recording {
namespace {

constexpr double kEmptyChange_n = 20.0;  ///< An empty plate on a running treadmill changes less.
constexpr double kEmptyChange = 0.25;    ///< Likewise, of the mean.
constexpr double kPerson_n = 30.0;       ///< A smaller mean is an offset.
constexpr double kRest_s = 0.1;          ///< Shortest rest at 0.
constexpr double kUnloading = 0.1;       ///< Share of the impulse that an empty plate does not lose.
constexpr double kAboveFloor_m = 0.25;   ///< Greatest height of a foot's marker.
constexpr double kNote_n = kLeastForce_n / 2;

/// Returns the longest time [samples] in which the force is near 0 and does not pass through.
Eigen::Index rest_at_zero(const Eigen::VectorXd& normal_n, Eigen::Index enough) {
  Eigen::Index longest = 0;
  for (Eigen::Index i = 0; i < normal_n.size();) {
    if (!(std::abs(normal_n[i]) < kNote_n)) {
      ++i;
      continue;
    }
    Eigen::Index end = i;
    while (end < normal_n.size() && std::abs(normal_n[end]) < kNote_n) ++end;
    const Eigen::Index half = (end - i) / 2;
    if (end - i >= enough) {
      const double change = normal_n.segment(i, half).mean() - normal_n.segment(end - half, half).mean();
      if (std::abs(change) < kNote_n / 2) longest = std::max(longest, end - i);
    }
    i = end;
  }
  return longest;
}

/// Returns true if the force falls below its mean in ZERO for a while, and never goes through 0: an empty plate reads
/// its least.
bool unloads(const Eigen::VectorXd& normal_n, double mean_n) {
  const double sign = mean_n < 0.0 ? -1.0 : 1.0;
  double more = 0.0, less = 0.0;
  Eigen::Index pulls = 0;
  for (const double f : normal_n) {
    const double beyond = sign * (f - mean_n);
    if (!(std::abs(beyond) > kLeastForce_n)) continue;
    (beyond > 0.0 ? more : less) += std::abs(beyond);
    if (sign * f < -kLeastForce_n) ++pulls;
  }
  return 100 * pulls < normal_n.size() && less > kUnloading * more;
}

/// Returns true if, at a time, the middle of the markers or a low marker is over the plate.
bool markers_over(const MarkerSeries& markers, const PlateSetup& plate, double time_s) {
  if (markers.frame_count() == 0) return false;
  const double* const begin = markers.time_s.data();
  const Eigen::Index frame = std::min<Eigen::Index>(
      std::lower_bound(begin, begin + markers.frame_count(), time_s) - begin, markers.frame_count() - 1);
  const Eigen::Matrix<double, 3, 4> corners = plate.R_GP.transpose() * (plate.corners_m.colwise() - plate.p_GP_m);
  const Eigen::Vector2d half = corners.topRows<2>().cwiseAbs().rowwise().maxCoeff();
  Vec3 sum = Vec3::Zero();
  Eigen::Index count = 0;
  bool low = false;
  for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
    if (markers.missing(frame, m)) continue;
    const Vec3 p = plate.R_GP.transpose() * (markers.position(frame, m) - plate.p_GP_m);
    low = low || ((p.head<2>().cwiseAbs() - half).maxCoeff() <= 0.0 && std::abs(p.z()) <= kAboveFloor_m);
    sum += p;
    ++count;
  }
  return low || (count > 0 && (sum.head<2>().cwiseAbs() / static_cast<double>(count) - half).maxCoeff() <= 0.0);
}

/// Returns true if the plate bears a load while ZERO says that it is empty.
bool is_loaded(const Recording& recording,
               const PlateSetup& plate,
               const Eigen::VectorXd& normal_n,
               const ZeroSamples& zero) {
  const auto part = normal_n.segment(zero.first, zero.count);
  const double mean_n = part.mean();
  const double change_n = std::sqrt((part.array() - mean_n).square().mean());
  if (std::abs(mean_n) < kPerson_n) return false;
  if (change_n > std::max(kEmptyChange_n, kEmptyChange * std::abs(mean_n))) return true;
  const Eigen::VectorXd time_s = recording.analog.time_s();
  const double rate_hz = static_cast<double>(time_s.size() - 1) / (time_s[time_s.size() - 1] - time_s[0]);
  const auto enough = std::max<Eigen::Index>(4, static_cast<Eigen::Index>(kRest_s * rate_hz));
  if (rest_at_zero(normal_n, enough) > 0) return true;
  if (unloads(normal_n, mean_n)) return true;
  const bool never_changes = ((normal_n.array() - mean_n).abs() > kLeastForce_n).count() * 100 < normal_n.size();
  return never_changes && markers_over(recording.markers, plate, time_s[zero.first]);
}

}  // namespace

std::optional<ZeroSamples> zero_samples(const C3dFile& file,
                                        Eigen::Index frames,
                                        std::size_t plate,
                                        std::vector<Repair>& repairs) {
  const C3dParameter* zero = file.find("FORCE_PLATFORM", "ZERO");
  if (zero == nullptr || zero->type == C3dType::text) return std::nullopt;
  const bool of_each = zero->dimensions.size() == 2 && zero->numbers.size() >= 2 * (plate + 1);
  const auto first = number_at(zero, of_each ? 2 * plate : 0);
  const auto last = number_at(zero, of_each ? 2 * plate + 1 : 1);
  if (!first || !last || *last < 1.0 || *last < *first) return std::nullopt;
  auto from = static_cast<double>(std::max(1.0, *first));
  double to = *last;
  const auto count = static_cast<double>(frames);
  const auto cut = static_cast<double>(file.first_frame - 1);
  if (to > count && from > cut && to <= cut + count) {
    from -= cut;
    to -= cut;
  }
  if (*first < 0.0 || to > count) {
    if (plate == 0 || of_each)
      note(repairs,
           "FORCE_PLATFORM:ZERO names frames {} to {} as those of empty plates, and the file has {}; nothing is "
           "subtracted",
           *first, *last, frames);
    return std::nullopt;
  }
  const auto ratio = static_cast<Eigen::Index>(file.analog_per_frame);
  const auto begin = static_cast<Eigen::Index>(from) - 1;
  return ZeroSamples{begin * ratio, (static_cast<Eigen::Index>(to) - begin) * ratio};
}

void find_baselines(const C3dFile& file, Eigen::Index frames, Recording& recording, std::vector<Repair>& repairs) {
  for (PlateSetup& plate : recording.plates) {
    const auto zero = zero_samples(file, frames, static_cast<std::size_t>(plate.number - 1), repairs);
    if (!zero || zero->first + zero->count > recording.analog.sample_count()) continue;
    const Eigen::MatrixXd channels = recording.analog.as_written(plate.channels);
    const Eigen::MatrixX3d force_n = channel_forces(plate, channels);
    if ((force_n.rowwise() - force_n.row(0)).cwiseAbs().maxCoeff() == 0.0) continue;
    Eigen::VectorXd baseline = channels.middleRows(zero->first, zero->count).colwise().mean().transpose();
    if (!baseline.allFinite()) continue;
    // Type 1 measures a point there, which an empty plate does not have.
    if (plate.type == 1) baseline.segment<2>(3).setZero();
    const Vec3 mean_n = force_n.middleRows(zero->first, zero->count).colwise().mean().transpose();
    const double mean_normal_n = mean_n.dot(plate.R_GP.col(2));
    const Eigen::Index frame = zero->first / file.analog_per_frame + 1;
    const Eigen::Index last = (zero->first + zero->count) / file.analog_per_frame;
    if (is_loaded(recording, plate, force_n * plate.R_GP.col(2), *zero)) {
      note(repairs,
           "force plate {} bears {:.0f} N in frames {} to {}, in which FORCE_PLATFORM:ZERO calls it empty; nothing is "
           "subtracted",
           plate.number, std::abs(mean_normal_n), frame, last);
      continue;
    }
    plate.baseline = std::move(baseline);
    if (mean_n.norm() < kNote_n) continue;
    note(repairs,
         "force plate {}: its mean in frames {} to {} is subtracted, in which FORCE_PLATFORM:ZERO calls it empty: "
         "{:.1f} N, of which {:.1f} N along its normal",
         plate.number, frame, last, mean_n.norm(), std::abs(mean_normal_n));
  }
}

}  // namespace myoid::recording
