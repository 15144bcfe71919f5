#include "myoid/recording/force_plate.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "myoid/ground/core/index.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/files/file_words.h"

namespace myoid::recording {
namespace {

using Wrench = Eigen::Matrix<double, Eigen::Dynamic, 6>;

std::size_t channels_of_type(int type) { return type == 3 ? 8 : 6; }

/// One plate of the group FORCE_PLATFORM.
class PlateParameters {
 public:
  PlateParameters(const C3dFile& file, std::size_t plate) : file_(file), plate_(plate) {}

  [[nodiscard]] std::optional<double> number(const char* name, std::size_t index) const {
    return number_at(file_.find("FORCE_PLATFORM", name), index);
  }
  [[nodiscard]] int type() const { return static_cast<int>(number("TYPE", plate_).value_or(0.0)); }

  /// Returns the plate's part of a parameter whose numbers run down the columns; empty if one of them is missing.
  template <int kRows, int kColumns>
  [[nodiscard]] std::optional<Eigen::Matrix<double, kRows, kColumns>> matrix(const char* name) const {
    Eigen::Matrix<double, kRows, kColumns> values;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      const auto value = number(name, at(values.size()) * plate_ + at(i));
      if (!value) return std::nullopt;
      values(i % kRows, i / kRows) = *value;
    }
    return values;
  }

  /// Returns the channels of a plate as numbers from 1; 0 where the file names none.
  [[nodiscard]] std::vector<double> channels(std::size_t count) const {
    const C3dParameter* channel = file_.find("FORCE_PLATFORM", "CHANNEL");
    const std::size_t stride = channel != nullptr && !channel->dimensions.empty() ? channel->dimensions[0] : count;
    std::vector<double> list;
    for (std::size_t c = 0; c < count; ++c)
      list.push_back(c < stride ? number_at(channel, stride * plate_ + c).value_or(0.0) : 0.0);
    return list;
  }

 private:
  const C3dFile& file_;
  std::size_t plate_;
};

bool is_quadrangle(const Eigen::Matrix<double, 3, 4>& corners_m) {
  const Vec3 a = corners_m.col(0) - corners_m.col(1);
  const Vec3 b = corners_m.col(0) - corners_m.col(3);
  return a.cross(b).norm() > 1e-3 * (a.squaredNorm() + b.squaredNorm()) && a.norm() > 0.01 && b.norm() > 0.01;
}

std::string_view unit_of_factor(double factor) { return factor > 1.0 ? "m" : "mm"; }

/// Takes corners in m where POINT:UNITS is mm, or the other way round: no plate is below 2 mm or above 100 m long.
void mend_corner_unit(PlateSetup& d, std::vector<Repair>& repairs) {
  const double length_m =
      std::max((d.corners_m.col(0) - d.corners_m.col(1)).norm(), (d.corners_m.col(0) - d.corners_m.col(3)).norm());
  const double factor = length_m > 1e-4 && length_m < 2e-3 ? 1e3 : length_m > 100.0 && length_m < 5e3 ? 1e-3 : 1.0;
  if (factor == 1.0) return;
  note(repairs,
       "force plate {}: FORCE_PLATFORM:CORNERS would make it {:.3g} m long; they are taken in {}, not in POINT:UNITS",
       d.number, length_m, unit_of_factor(factor));
  d.corners_m *= factor;
}

/// Likewise the ORIGIN: it is not further from the surface than the plate is long, and no plate states hundredths of a
/// millimeter. The sensors of type 3 are under the surface.
void mend_origin_unit(PlateSetup& d, std::vector<Repair>& repairs) {
  const double size_m = (d.corners_m.col(0) - d.corners_m.col(2)).norm();
  double factor = 1.0;
  if (d.type == 3) {
    const double reach_m = d.origin_m.head<2>().cwiseAbs().maxCoeff();
    if (reach_m > 10.0 * size_m && 1e-3 * reach_m <= size_m) factor = 1e-3;
    if (reach_m > 0.0 && reach_m < 0.01 * size_m && 1e3 * reach_m <= size_m) factor = 1e3;
  } else {
    const double length_m = d.origin_m.norm();
    const double depth_m = std::abs(d.origin_m.z());
    const bool tiny = depth_m >= 5e-6 && depth_m <= 2e-4 && d.origin_m.head<2>().cwiseAbs().maxCoeff() <= 5e-5;
    if (length_m > std::max(1.0, 3.0 * size_m) && 1e-3 * length_m <= size_m) factor = 1e-3;
    if (tiny && d.type != 1) factor = 1e3;
  }
  if (factor == 1.0) return;
  note(repairs, "force plate {}: FORCE_PLATFORM:ORIGIN is {:.3g} m from the surface; taken in {}, not in POINT:UNITS",
       d.number, d.origin_m.norm(), unit_of_factor(factor));
  d.origin_m *= factor;
}

/// Returns the origin of a plate; type 3 has the distances a, b in its first two numbers.
Vec3 plate_origin_m(const PlateParameters& parameters, const PlateSetup& d, std::vector<Repair>& repairs) {
  const auto stated = parameters.matrix<3, 1>("ORIGIN");
  if (!stated) {
    note(repairs, "force plate {}: FORCE_PLATFORM:ORIGIN is missing; the moments are taken about the surface",
         d.number);
    return Vec3::Zero();
  }
  Vec3 origin_m = d.to_m * *stated;
  if (d.type == 3 && (origin_m[0] < 0.0 || origin_m[1] < 0.0)) {
    note(repairs, "force plate {}: the distances a, b of FORCE_PLATFORM:ORIGIN are negative; taken as positive",
         d.number);
    origin_m.head<2>() = origin_m.head<2>().cwiseAbs().eval();
  }
  return origin_m;
}

/// Reads the plate's parameters; empty, with a note, if one is missing or impossible.
std::optional<PlateSetup> describe(const C3dFile& file, std::size_t plate, double to_m, std::vector<Repair>& repairs) {
  const auto refuse = [&](const std::string& why) {
    note(repairs, "force plate {} is left out: {}", plate + 1, why);
    return std::nullopt;
  };
  const PlateParameters parameters(file, plate);
  PlateSetup d;
  d.number = static_cast<int>(plate) + 1;
  d.to_m = to_m;
  d.calibrated_to_nm = to_m;
  d.type = parameters.type();
  if (d.type < 1 || d.type > 4)
    return refuse(fmt::format("FORCE_PLATFORM:TYPE is {}, types 1 to 4 are understood", d.type));
  const auto corners = parameters.matrix<3, 4>("CORNERS");
  if (!corners) return refuse("FORCE_PLATFORM:CORNERS is missing or too short");
  d.corners_m = to_m * *corners;
  mend_corner_unit(d, repairs);
  if (!is_quadrangle(d.corners_m)) return refuse("FORCE_PLATFORM:CORNERS are no quadrangle");
  d.origin_m = plate_origin_m(parameters, d, repairs);
  mend_origin_unit(d, repairs);
  for (const double channel : parameters.channels(channels_of_type(d.type))) {
    if (!(channel >= 1.0 && channel <= static_cast<double>(file.channels.size())))
      return refuse(
          fmt::format("FORCE_PLATFORM:CHANNEL names channel {}; there are {}", channel, file.channels.size()));
    d.channels.push_back(static_cast<Eigen::Index>(channel) - 1);
  }
  if (d.type == 4) {
    const auto calibration = parameters.matrix<6, 6>("CAL_MATRIX");
    if (!calibration) return refuse("FORCE_PLATFORM:CAL_MATRIX is missing or too short");
    d.calibration = *calibration;
  }
  return d;
}

/// Finds each channel's factor to SI; a force in volts or of unknown unit keeps its number.
void find_factors(const C3dFile& file, PlateSetup& d, std::vector<Repair>& repairs) {
  std::vector<std::string> assumed;
  for (std::size_t c = 0; c < d.channels.size(); ++c) {
    const C3dChannel& channel = file.channels[static_cast<std::size_t>(d.channels[c])];
    d.factors.push_back(1.0);
    if (d.type == 4) continue;  // a calibration matrix applies to the numbers as they are
    const bool length = d.type == 1 && (c == 3 || c == 4);
    const bool moment = (d.type == 2 && c >= 3) || (d.type == 1 && c == 5);
    const Unit expected = length ? Unit::meter : moment ? Unit::newton_meter : Unit::newton;
    const auto unit = parse_file_unit(channel.unit_text);
    if (unit && unit->unit == expected) {
      d.factors.back() = unit->to_si;
    } else {
      d.factors.back() = length || moment ? d.to_m : 1.0;
      assumed.push_back(fmt::format("{} [{}]", channel.name, channel.unit_text));
    }
  }
  if (!assumed.empty())
    note(repairs,
         "force plate {}: {} channels, the first {}, do not have the unit of a force, "
         "moment or length; taken as N and N times the points' unit",
         d.number, assumed.size(), assumed[0]);
}

/// Returns force and moment about the middle of the surface, in the plate's frame.
Wrench surface_wrench(const PlateSetup& d, const Eigen::MatrixXd& v) {
  Wrench w(v.rows(), 6);
  if (d.type == 1) {
    w.leftCols<3>() = v.leftCols<3>();
    w.col(3) = v.col(4).cwiseProduct(v.col(2));
    w.col(4) = -v.col(3).cwiseProduct(v.col(2));
    w.col(5) = v.col(5) + v.col(3).cwiseProduct(v.col(1)) - v.col(4).cwiseProduct(v.col(0));
    return w;
  }
  Vec3 o = d.origin_m;  // from the transducer to the middle of the surface
  if (d.type == 3) {
    const double a = d.origin_m[0];
    const double b = d.origin_m[1];
    w.col(0) = v.col(0) + v.col(1);
    w.col(1) = v.col(2) + v.col(3);
    w.col(2) = v.col(4) + v.col(5) + v.col(6) + v.col(7);
    w.col(3) = b * (v.col(4) + v.col(5) - v.col(6) - v.col(7));
    w.col(4) = a * (-v.col(4) + v.col(5) + v.col(6) - v.col(7));
    w.col(5) = b * (v.col(1) - v.col(0)) + a * (v.col(2) - v.col(3));
    o = Vec3(0.0, 0.0, d.origin_m[2]);
  } else {
    w = v;
  }
  for (Eigen::Index i = 0; i < w.rows(); ++i) {
    const Vec3 force = w.block<1, 3>(i, 0).transpose();
    w.block<1, 3>(i, 3) -= o.cross(force).transpose();
  }
  return w;
}

}  // namespace

std::vector<PlateSetup> plate_setups(const C3dFile& file, std::vector<Repair>& repairs) {
  std::vector<PlateSetup> plates;
  const C3dParameter* types = file.find("FORCE_PLATFORM", "TYPE");
  const double used = number_at(file.find("FORCE_PLATFORM", "USED"), 0)
                          .value_or(types == nullptr ? 0.0 : static_cast<double>(types->numbers.size()));
  if (!(used >= 1.0) || file.channels.empty()) return plates;
  const auto length = parse_file_unit(file.point_unit);
  const double to_m = length && length->unit == Unit::meter ? length->to_si : 1e-3;
  for (std::size_t n = 0; n < static_cast<std::size_t>(std::min(used, 255.0)); ++n) {
    auto d = describe(file, n, to_m, repairs);
    if (!d) continue;
    d->p_GP_m = d->corners_m.rowwise().mean();
    const Vec3 x = (d->corners_m.col(0) - d->corners_m.col(1)).normalized();
    const Vec3 z = x.cross(Vec3(d->corners_m.col(0) - d->corners_m.col(3))).normalized();
    d->R_GP.col(0) = x;
    d->R_GP.col(1) = z.cross(x);
    d->R_GP.col(2) = z;
    d->side.out_L = -z;
    find_factors(file, *d, repairs);
    plates.push_back(*std::move(d));
  }
  if (!plates.empty() && file.find("FORCE_PLATFORM", "FPCOPPOLY") != nullptr)
    note(repairs,
         "FORCE_PLATFORM:FPCOPPOLY, the maker's correction of the center of pressure (millimeters), is not applied");
  return plates;
}

void turn_origin(PlateSetup& setup, std::vector<Repair>& repairs) {
  const double out = setup.R_GP.col(2).dot(setup.side.out_L) * setup.origin_m.z();
  if (setup.type == 1 || !(out < 0.0)) return;
  if (setup.type == 3) {
    note(repairs,
         "force plate {}: a_z0 in FORCE_PLATFORM:ORIGIN places the sensors above the surface; its sign is turned",
         setup.number);
    setup.origin_m.z() = -setup.origin_m.z();
    return;
  }
  note(repairs,
       "force plate {}: FORCE_PLATFORM:ORIGIN points from the surface to the transducer "
       "instead of the other way; turned round",
       setup.number);
  setup.origin_m = -setup.origin_m;
}

Eigen::MatrixXd plate_channels_si(const PlateSetup& setup, Eigen::MatrixXd channel_values) {
  Eigen::MatrixXd& v = channel_values;
  if (setup.baseline.size() > 0) v.rowwise() -= setup.baseline.transpose();
  for (std::size_t c = 0; c < setup.factors.size(); ++c) v.col(static_cast<Eigen::Index>(c)) *= setup.factors[c];
  if (setup.type == 4) {
    v = (v * setup.calibration.transpose()).eval();
    v.rightCols<3>() *= setup.calibrated_to_nm;
  }
  return channel_values;
}

ForcePlate force_plate(const PlateSetup& setup, Eigen::VectorXd time_s, Eigen::MatrixXd channel_values) {
  ForcePlate plate{setup};
  plate.time_s = std::move(time_s);
  const Wrench w = setup.side.turn * surface_wrench(setup, plate_channels_si(setup, std::move(channel_values)));
  const Eigen::Index samples = w.rows();
  plate.force_n = w.leftCols<3>() * plate.R_GP.transpose();
  plate.moment_nm = w.rightCols<3>() * plate.R_GP.transpose();
  plate.pressure_center_m.resize(samples, 3);
  plate.free_moment_nm.resize(samples, 3);
  for (Eigen::Index i = 0; i < samples; ++i) {
    if (!(std::abs(w(i, 2)) >= kLeastForce_n)) {
      plate.pressure_center_m.row(i).setConstant(kNan);
      plate.free_moment_nm.row(i).setZero();
      continue;
    }
    const double px = -w(i, 4) / w(i, 2);
    const double py = w(i, 3) / w(i, 2);
    const double tz = w(i, 5) - px * w(i, 1) + py * w(i, 0);
    plate.pressure_center_m.row(i) = (plate.p_GP_m + plate.R_GP * Vec3(px, py, 0.0)).transpose();
    plate.free_moment_nm.row(i) = (tz * plate.R_GP.col(2)).transpose();
  }
  return plate;
}

Eigen::MatrixX3d channel_forces(const PlateSetup& setup, Eigen::MatrixXd channel_values) {
  Eigen::MatrixXd v = plate_channels_si(setup, std::move(channel_values));
  if (setup.type == 3) {
    v.col(0) += v.col(1);
    v.col(1) = v.col(2) + v.col(3);
    v.col(2) = v.col(4) + v.col(5) + v.col(6) + v.col(7);
  }
  return v.leftCols<3>() * setup.R_GP.transpose();
}

std::optional<PlateAction> action_on_person(const ForcePlate& plate, Eigen::Index sample, double least_force_n) {
  const Vec3 force = plate.force_n.row(sample).transpose();
  const Vec3 moment = plate.moment_nm.row(sample).transpose();
  const Vec3 point = plate.pressure_center_m.row(sample).transpose();
  const Vec3 free = plate.free_moment_nm.row(sample).transpose();
  if (!force.allFinite() || !moment.allFinite()) return std::nullopt;
  const double push_n = force.dot(plate.side.out_L);
  if (plate.side.is_floor) {
    if (!(push_n >= least_force_n) || !point.allFinite()) return std::nullopt;
    return PlateAction{force, point, free};
  }
  if (!(force.norm() >= least_force_n)) return std::nullopt;
  const double reach_m = (plate.corners_m.colwise() - plate.p_GP_m).colwise().norm().maxCoeff();
  if (push_n >= least_force_n && point.allFinite() && (point - plate.p_GP_m).norm() <= reach_m)
    return PlateAction{force, point, free};
  return PlateAction{force, plate.p_GP_m, moment};
}

}  // namespace myoid::recording
