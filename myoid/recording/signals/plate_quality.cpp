#include "myoid/recording/signals/plate_quality.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace myoid::recording {
namespace {

using recording::ForcePlate;

double rate_of(const ForcePlate& plate) {
  const Eigen::Index n = plate.time_s.size();
  return static_cast<double>(n - 1) / (plate.time_s[n - 1] - plate.time_s[0]);
}

void check_offset(const ForcePlate& plate,
                  const Eigen::VectorXd& normal_n,
                  const std::string& channel,
                  std::vector<Remark>& faults) {
  constexpr double kWindow_s = 0.2;
  constexpr double kSteady_n = 5.0;
  constexpr double kPerson_n = 80.0;
  const auto width = static_cast<Eigen::Index>(kWindow_s * rate_of(plate));
  if (width < 4) return;
  double least_n = kPerson_n;
  double offset_n = 0.0;
  Eigen::Index at = -1;
  for (Eigen::Index i = 0; i + width <= normal_n.size(); i += std::max<Eigen::Index>(1, width / 4)) {
    const auto part = normal_n.segment(i, width);
    const double mean = part.mean();
    if (!(std::abs(mean) < least_n)) continue;
    if (std::sqrt((part.array() - mean).square().mean()) > kSteady_n) continue;
    least_n = std::abs(mean);
    offset_n = mean;
    at = i;
  }
  if (at < 0 || least_n < kLimits.plates.offset_n) return;
  faults.push_back(
      {.code = RemarkCode::plate_offset,
       .severity = Severity::warning,
       .about = channel,
       .when = Stretch{plate.time_s[at], plate.time_s[at + width - 1]},
       .value = offset_n,
       .says = fmt::format("{} reads {:.1f} N at {:.6g} s, when it bears least", channel, offset_n, plate.time_s[at]),
       .remedy = "was it zeroed while empty? Subtract that from the file"});
}

void check_pressure(const ForcePlate& plate,
                    const Eigen::VectorXd& normal_n,
                    const std::string& channel,
                    std::vector<Remark>& faults) {
  const Eigen::Matrix<double, 3, 4> corners = plate.R_GP.transpose() * (plate.corners_m.colwise() - plate.p_GP_m);
  const double half_x_m = corners.row(0).cwiseAbs().maxCoeff();
  const double half_y_m = corners.row(1).cwiseAbs().maxCoeff();
  Eigen::Index loaded = 0;
  Eigen::Index outside = 0;
  Eigen::Index worst = -1;
  double furthest_m = 0.0;
  for (Eigen::Index i = 0; i < normal_n.size(); ++i) {
    if (!(std::abs(normal_n[i]) > kLimits.plates.loaded_n)) continue;
    const Vec3 p = plate.R_GP.transpose() * (plate.pressure_center_m.row(i).transpose() - plate.p_GP_m);
    if (!p.allFinite()) continue;
    ++loaded;
    const double away_m = std::max(std::abs(p[0]) - half_x_m, std::abs(p[1]) - half_y_m);
    if (away_m <= kLimits.plates.margin_m) continue;
    ++outside;
    if (away_m <= furthest_m) continue;
    furthest_m = away_m;
    worst = i;
  }
  if (worst < 0 || static_cast<double>(outside) < kLimits.plates.outside_share * static_cast<double>(loaded)) return;
  faults.push_back({.code = RemarkCode::plate_pressure_outside,
                    .severity = Severity::warning,
                    .about = channel,
                    .when = Stretch{plate.time_s[worst], plate.time_s[worst]},
                    .value = static_cast<double>(outside) / static_cast<double>(loaded),
                    .says = fmt::format("{}: the center of pressure lies outside the plate in {:.1f} % of the loaded "
                                        "time, by up to {:.0f} mm at {:.6g} s",
                                        channel, 100.0 * static_cast<double>(outside) / static_cast<double>(loaded),
                                        1000.0 * furthest_m, plate.time_s[worst]),
                    .remedy = "check the corners, the origin and the order of the channels in the file"});
}

std::string plate_name(const ForcePlate& plate) { return fmt::format("plate {}", plate.number); }

}  // namespace

std::vector<Remark> check_plate_pressure(const ForcePlate& plate) {
  std::vector<Remark> faults;
  if (plate.time_s.size() >= 2) check_pressure(plate, plate.force_n * plate.side.out_L, plate_name(plate), faults);
  return faults;
}

std::vector<Remark> check_force_plate(const ForcePlate& plate) {
  std::vector<Remark> faults;
  if (plate.time_s.size() < 2) return faults;
  const std::string channel = plate_name(plate);
  const Eigen::VectorXd normal_n = plate.force_n * plate.side.out_L;
  check_offset(plate, normal_n, channel, faults);
  if (plate.side.turn < 0.0) {
    Eigen::Index at = 0;
    normal_n.maxCoeff(&at);
    faults.push_back({.code = RemarkCode::plate_sign,
                      .severity = Severity::note,
                      .about = channel,
                      .when = Stretch{plate.time_s[at], plate.time_s[at]},
                      .value = -normal_n[at],
                      .says = fmt::format(
                          "{} pulls the person down, with {:.0f} N at {:.6g} s: the file holds the force on the plate",
                          channel, normal_n[at], plate.time_s[at]),
                      .remedy = "`convert` and `run` turn it round"});
  }
  check_pressure(plate, normal_n, channel, faults);
  return faults;
}

}  // namespace myoid::recording
