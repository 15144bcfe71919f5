#include "myoid/recording/laboratory_up.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::recording {
namespace {

constexpr double kFloor = 0.5;        ///< Cosine of 60 degrees: a steeper plate is a wall.
constexpr double kFaces = 0.8;        ///< Cosine of 37 degrees: a ramp still shows which axis is up.
constexpr double kAlong = 0.5;        ///< Cosine of 60 degrees: a person's mean force is less oblique.
constexpr double kOutweighs = 3.0;    ///< Least ratio of the floor's load to a wall's.
constexpr double kClearly = 0.95;     ///< Share of the markers on one side.
constexpr Eigen::Index kSeveral = 8;  ///< Fewer markers are no person.
constexpr Eigen::Index kFew = 3;      ///< Fewer markers tell nothing.
constexpr double kHigh_m = 0.3;       ///< Least median height of the markers.

/// Returns the heights of the markers above a point along a direction, in some 200 frames.
std::vector<double> heights(const MarkerSeries& markers, const Vec3& from_m, const Vec3& along) {
  std::vector<double> found;
  const Eigen::Index step = std::max<Eigen::Index>(1, markers.frame_count() / 200);
  for (Eigen::Index f = 0; f < markers.frame_count(); f += step) {
    for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
      if (!markers.missing(f, m)) found.push_back((markers.position(f, m) - from_m).dot(along));
    }
  }
  return found;
}

/// Faults of a direction taken as up, in units of one reversed convention of the plates.
constexpr double kAgainstScreen = 2.0;  ///< Qualisys writes "-Z" for z up: two conventions outweigh the screen,
constexpr double kDownwards = 3.5;      ///< and all three do not outweigh an axis that points up.
constexpr double kPersonBelow = 10.0;   ///< A person does not walk below the floor.
constexpr double kFewBelow = 2.0;
constexpr double kPersonBelowOrigin = 2.0;  ///< The origin may be on a table.
constexpr double kFewBelowOrigin = 1.0;

/// Returns +1 or -1 if the markers are clearly on one side of a point along a direction; else 0.
double clear_side(const MarkerSeries& markers, const Vec3& from_m, const Vec3& along) {
  std::vector<double> h = heights(markers, from_m, along);
  if (h.empty()) return 0.0;
  const auto above = std::count_if(h.begin(), h.end(), [](double x) { return x > 0.0; });
  const double share = static_cast<double>(above) / static_cast<double>(h.size());
  const double middle = math::median(std::move(h));
  if (share >= kClearly && middle >= kHigh_m) return 1.0;
  if (share <= 1.0 - kClearly && middle <= -kHigh_m) return -1.0;
  return 0.0;
}

/// Returns the axis along which a vector is longest.
Eigen::Index longest_axis(const Vec3& v) {
  Eigen::Index axis = 0;
  v.cwiseAbs().maxCoeff(&axis);
  return axis;
}

/// Splits a text into the axes it names: "+X", "-Z" of "+X-Z".
std::vector<Vec3> axes_of(std::string_view text) {
  std::vector<Vec3> axes;
  double sign = 1.0;
  for (const char c : text) {
    const char small = small_letter(c);
    if (small >= 'x' && small <= 'z') {
      axes.emplace_back(sign * Vec3::Unit(small - 'x'));
      sign = 1.0;
    } else if (c == '-' || c == '+') {
      sign = c == '-' ? -1.0 : 1.0;
    } else if (c != ' ' && c != ',') {
      return {};
    }
  }
  // "Z-" means "-Z".
  if (axes.size() == 1 && sign < 0.0) axes[0] = -axes[0];
  return axes;
}

/// Returns all axes of a text parameter; empty if it is absent or holds other words.
std::vector<Vec3> axes_of(const C3dParameter* parameter) {
  std::string all;
  if (parameter == nullptr || parameter->type != C3dType::text) return {};
  for (const std::string& text : texts(*parameter)) all += text + " ";
  return axes_of(std::string_view(all));
}

/// The evidence of one recording and the conclusion from it.
class Evidence {
 public:
  Evidence(const Recording& recording, const std::vector<PlateLoad>& loads) : recording_(recording), loads_(loads) {}

  [[nodiscard]] LaboratoryUp up() const {
    const std::optional<Vec3>& screen = recording_.screen_up_L;
    if (loads_.empty() && !screen) return {};
    const Vec3 axis = screen ? screen->cwiseAbs().eval() : axis_of_plates();
    if (!loads_.empty()) {
      require_floor(axis);
      require_push(axis);
    }
    const Vec3 up = faults(-axis) < faults(axis) ? (-axis).eval() : axis;
    std::vector<std::string> because;
    if (screen) because.push_back(screen_text(up));
    if (!loads_.empty()) because.push_back(plates_text(up));
    if (side_of_markers(up) > 0.0)
      because.emplace_back(loads_.empty() ? "the markers are on that side of the origin"
                                          : "the markers are on that side of the plates");
    return {up, fmt::format("{}", fmt::join(because, "; "))};
  }

 private:
  [[nodiscard]] std::string screen_text(const Vec3& up) const {
    const std::string said = axis_name(*recording_.screen_up_L);
    if (*recording_.screen_up_L == up) return fmt::format("POINT:Y_SCREEN says that {} points up", said);
    return fmt::format("POINT:Y_SCREEN names the axis, as {}", said);
  }

  /// Returns the faults that the file has if a direction is up.
  [[nodiscard]] double faults(const Vec3& up) const {
    double sum = up.sum() < 0.0 ? kDownwards : 0.0;
    if (recording_.screen_up_L && *recording_.screen_up_L != up) sum += kAgainstScreen;
    if (side_of_markers(up) < 0.0) sum += weight_of_markers();
    return sum + faults_of_plates(up);
  }

  [[nodiscard]] double weight_of_markers() const {
    const bool person = recording_.markers.marker_count() >= kSeveral;
    if (loads_.empty()) return person ? kPersonBelowOrigin : kFewBelowOrigin;
    return person ? kPersonBelow : kFewBelow;
  }

  /// Returns the shares of the floor's plates that differ from the C3D guide, of 0 to 3 conventions.
  [[nodiscard]] double faults_of_plates(const Vec3& up) const {
    double floors = 0.0, reversed = 0.0, load = 0.0, pulling = 0.0, origins = 0.0, above = 0.0;
    for (std::size_t k = 0; k < loads_.size(); ++k) {
      if (!is_floor(loads_[k], up)) continue;
      const double side = loads_[k].normal_L.dot(up) < 0.0 ? -1.0 : 1.0;
      floors += 1.0;
      if (side > 0.0) reversed += 1.0;
      load += loads_[k].rms_n;
      if (side * loads_[k].along_n < 0.0) pulling += loads_[k].rms_n;
      const PlateSetup& setup = recording_.plates[k];
      if (setup.type == 1 || setup.origin_m.z() == 0.0) continue;
      origins += 1.0;
      if (side * setup.origin_m.z() < 0.0) above += 1.0;
    }
    const auto share = [](double part, double whole) { return whole > 0.0 ? part / whole : 0.0; };
    return share(reversed, floors) + share(pulling, load) + share(above, origins);
  }

  [[nodiscard]] int number(std::size_t plate) const { return recording_.plates[plate].number; }
  [[nodiscard]] std::string facing(std::size_t plate) const {
    return std::string(1, "xyz"[longest_axis(loads_[plate].normal_L)]);
  }

  [[noreturn]] void contradict(const std::string& one, const std::string& other) const {
    throw InvalidInput(
        "which way is up cannot be told: {}, but {}; say it (--up x, y or z; in a study [markers] up), or "
        "correct the file",
        one, other);
  }

  [[nodiscard]] std::size_t floor_plate(const Vec3& axis) const {
    for (std::size_t k = 0; k < loads_.size(); ++k)
      if (is_floor(loads_[k], axis)) return k;
    return 0;
  }

  /// Throws unless some plate is a floor for the axis that the screen names. An axis that comes
  /// from the plates always has one.
  void require_floor(const Vec3& axis) const {
    const bool any =
        std::any_of(loads_.begin(), loads_.end(), [&](const PlateLoad& load) { return is_floor(load, axis); });
    if (any || !recording_.screen_up_L) return;
    contradict(screen_text(*recording_.screen_up_L),
               fmt::format("by FORCE_PLATFORM:CORNERS the surface of {} faces {}",
                           loads_.size() == 1 ? fmt::format("plate {}", number(0))
                                              : fmt::format("all {} plates", loads_.size()),
                           facing(0)));
  }

  /// Returns the load [N] of the plates that face each axis.
  [[nodiscard]] std::array<double, 3> loads_by_axis() const {
    std::array<double, 3> sum{};
    for (const PlateLoad& load : loads_) {
      for (Eigen::Index a = 0; a < 3; ++a)
        if (std::abs(load.normal_L[a]) >= kFaces) sum[static_cast<std::size_t>(a)] += load.rms_n;
    }
    return sum;
  }

  [[nodiscard]] Vec3 axis_of_plates() const {
    const std::array<double, 3> sum = loads_by_axis();
    const auto best = static_cast<std::size_t>(std::max_element(sum.begin(), sum.end()) - sum.begin());
    if (sum[best] > 0.0) {
      for (std::size_t a = 0; a < 3; ++a) {
        if (a != best && kOutweighs * sum[a] > sum[best])
          contradict(fmt::format("{} faces {} and is loaded", plate_facing(best), "xyz"[best]),
                     fmt::format("{} faces {} and is loaded too", plate_facing(a), "xyz"[a]));
      }
      return Vec3::Unit(static_cast<Eigen::Index>(best));
    }
    return axis_without_loads();
  }

  /// Returns the axis of plates that are never loaded or all stand obliquely.
  [[nodiscard]] Vec3 axis_without_loads() const {
    Vec3 pushed = Vec3::Zero();
    for (const PlateLoad& load : loads_) pushed += load.push_n.cwiseAbs();
    const Eigen::Index steepest = longest_axis(pushed);
    if (!pushed.isZero() && pushed[steepest] >= kFaces * pushed.norm()) return Vec3::Unit(steepest);
    const std::string first = facing(0);
    for (std::size_t k = 0; k < loads_.size(); ++k) {
      if (facing(k) != first)
        contradict(fmt::format("plate {} faces {}", number(0), first),
                   fmt::format("plate {} faces {}, and neither is loaded", number(k), facing(k)));
      if (loads_[k].normal_L.cwiseAbs().maxCoeff() < kFaces)
        contradict(fmt::format("plate {} stands obliquely", number(k)), "nothing else in the file tells");
    }
    return *axis_vector(first);
  }

  [[nodiscard]] std::string plate_facing(std::size_t axis) const {
    for (std::size_t k = 0; k < loads_.size(); ++k) {
      if (loads_[k].loaded() && std::abs(loads_[k].normal_L[static_cast<Eigen::Index>(axis)]) >= kFaces)
        return fmt::format("plate {}", number(k));
    }
    return "a plate";
  }

  /// Throws unless the floor's load is across its surface.
  void require_push(const Vec3& axis) const {
    Vec3 sum = Vec3::Zero();
    double normal = 0.0;
    std::vector<int> numbers;
    for (std::size_t k = 0; k < loads_.size(); ++k) {
      const PlateLoad& load = loads_[k];
      if (!load.loaded() || !is_floor(load, axis)) continue;
      const double share = load.rms_n * (load.along_n < 0.0 ? -1.0 : 1.0);
      sum += share * load.push_n;
      normal += load.rms_n * std::abs(load.along_n);
      numbers.push_back(number(k));
    }
    if (numbers.empty() || normal >= kAlong * sum.norm()) return;
    contradict(
        fmt::format("by FORCE_PLATFORM:CORNERS the surface of plate {} faces {}", numbers.front(), axis_name(axis)),
        fmt::format("its mean force runs along {}, {:.0f} degrees from the normal (are the corners or "
                    "FORCE_PLATFORM:CHANNEL in another order?)",
                    "xyz"[longest_axis(sum)], std::acos(std::min(1.0, normal / sum.norm())) / kDegree));
  }

  [[nodiscard]] std::string plates_text(const Vec3& axis) const {
    std::vector<int> numbers;
    double most_n = 0.0;
    for (std::size_t k = 0; k < loads_.size(); ++k) {
      if (!is_floor(loads_[k], axis)) continue;
      numbers.push_back(number(k));
      most_n = std::max(most_n, std::abs(loads_[k].along_n));
    }
    if (numbers.empty()) return "the plates push along it";
    return fmt::format(
        "plate{} {} {} it{}", numbers.size() == 1 ? "" : "s", fmt::join(numbers, ", "),
        numbers.size() == 1 ? "faces" : "face",
        most_n > 0.0 ? fmt::format(" and bear{} {:.0f} N along it", numbers.size() == 1 ? "s" : "", most_n) : "");
  }

  /// Returns +1 or -1 if three or more markers are clearly above or below the floor's plates; without plates, the
  /// origin of the laboratory. The lowest step of a stair is the floor.
  [[nodiscard]] double side_of_markers(const Vec3& up) const {
    if (recording_.markers.marker_count() < kFew) return 0.0;
    if (loads_.empty()) return clear_side(recording_.markers, Vec3::Zero(), up);
    Vec3 lowest = recording_.plates[floor_plate(up)].p_GP_m;
    Vec3 highest = lowest;
    for (std::size_t k = 0; k < loads_.size(); ++k) {
      if (!is_floor(loads_[k], up)) continue;
      const Vec3& middle = recording_.plates[k].p_GP_m;
      if (middle.dot(up) < lowest.dot(up)) lowest = middle;
      if (middle.dot(up) > highest.dot(up)) highest = middle;
    }
    const bool above = clear_side(recording_.markers, lowest, up) > 0.0;
    const bool below = clear_side(recording_.markers, highest, up) < 0.0;
    return above == below ? 0.0 : above ? 1.0 : -1.0;
  }

  const Recording& recording_;
  const std::vector<PlateLoad>& loads_;
};

}  // namespace

std::string axis_name(const Vec3& axis) {
  const Eigen::Index along = longest_axis(axis);
  return fmt::format("{}{}", axis[along] < 0.0 ? "-" : "", "xyz"[along]);
}

std::optional<Vec3> axis_vector(std::string_view name) {
  const std::vector<Vec3> axes = axes_of(name);
  if (axes.size() != 1) return std::nullopt;
  return axes[0];
}

Mat3 rotation_to_y_up(const Vec3& up_L) {
  const std::string name = axis_name(up_L);
  if (name.size() == 1) return ground::rotation_to_y_up(name[0]);
  Mat3 R = Mat3::Zero();
  if (name[1] == 'x') {
    R << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  } else if (name[1] == 'y') {
    R.diagonal() << 1, -1, -1;
  } else {
    R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  }
  return R;
}

std::optional<Vec3> screen_up(const C3dFile& file) {
  const std::vector<Vec3> right = axes_of(file.find("POINT", "X_SCREEN"));
  const std::vector<Vec3> up = axes_of(file.find("POINT", "Y_SCREEN"));
  if (up.size() == 1) {
    if (right.size() == 1 && right[0].cwiseAbs() == up[0].cwiseAbs()) return std::nullopt;
    return up[0];
  }
  const std::vector<Vec3> both = axes_of(file.find("POINT", "SCREEN"));
  if (both.size() != 2 || both[0].cwiseAbs() == both[1].cwiseAbs()) return std::nullopt;
  return both[1];
}

PlateLoad plate_load(const Recording& recording, const PlateSetup& setup, double least_force_n) {
  PlateLoad load{.normal_L = setup.R_GP.col(2)};
  const Eigen::MatrixX3d force = channel_forces(setup, recording.analog.as_written(setup.channels));
  constexpr Eigen::Index kMany = 10;
  if (force.rows() > kMany && force.row(0).norm() >= least_force_n &&
      (force.rowwise() - force.row(0)).cwiseAbs().maxCoeff() == 0.0) {
    load.constant_n = force.row(0).dot(load.normal_L.transpose());
    return load;
  }
  double weight = 0.0;
  double square = 0.0;
  for (Eigen::Index i = 0; i < force.rows(); ++i) {
    const Vec3 f = force.row(i).transpose();
    if (!f.allFinite()) continue;
    load.largest_n = std::max(load.largest_n, f.norm());
    const double normal = f.dot(load.normal_L);
    if (std::abs(normal) < least_force_n) continue;
    load.push_n += f * std::abs(normal);
    weight += std::abs(normal);
    square += normal * normal;
  }
  if (weight > 0.0) load.push_n /= weight;
  load.along_n = load.push_n.dot(load.normal_L);
  load.rms_n = std::sqrt(square / static_cast<double>(std::max<Eigen::Index>(1, force.rows())));
  return load;
}

double markers_side(const MarkerSeries& markers, const Vec3& from_m, const Vec3& along) {
  return markers.marker_count() < kSeveral ? 0.0 : clear_side(markers, from_m, along);
}

bool is_floor(const PlateLoad& load, const Vec3& up_L) { return std::abs(load.normal_L.dot(up_L)) >= kFloor; }

LaboratoryUp laboratory_up(const Recording& recording, const std::vector<PlateLoad>& loads) {
  return Evidence(recording, loads).up();
}

}  // namespace myoid::recording
