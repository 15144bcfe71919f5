#include "myoid/recording/plate_unit.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "myoid/ground/math/statistics.h"

namespace myoid::recording {
namespace {

constexpr double kNearlyAll = 0.95;
constexpr double kAll = 0.99;
constexpr double kFar = 10.0;          ///< Sizes of the plate.
constexpr double kNear = 1.0 / 500.0;  ///< Sizes of the plate.
constexpr double kAway_m = 0.02;       ///< Of numbers that are no noise.
constexpr double kLoaded_n = 50.0;
constexpr std::size_t kFewest = 20;

/// Where the line of force of each loaded sample crosses the transducer's plane, and its moment about the normal.
struct Loaded {
  std::vector<double> away_m;   ///< Distance from the middle of the surface.
  std::vector<double> twist_m;  ///< Moment about the normal over the force.
};

Loaded loaded_samples(const PlateSetup& setup, const Eigen::MatrixXd& v) {
  Loaded list;
  for (Eigen::Index i = 0; i < v.rows(); ++i) {
    const double f = v(i, 2);
    if (!(std::abs(f) >= kLoaded_n) || !v.row(i).allFinite()) continue;
    const Eigen::Vector2d p =
        setup.type == 1 ? Eigen::Vector2d(v(i, 3), v(i, 4)) : Eigen::Vector2d(-v(i, 4) / f, v(i, 3) / f);
    list.away_m.push_back(p.norm());
    list.twist_m.push_back(std::abs(v(i, 5) / f));
  }
  return list;
}

double share_within(const std::vector<double>& values, double most) {
  const auto inside = std::count_if(values.begin(), values.end(), [&](double x) { return x <= most; });
  return static_cast<double>(inside) / static_cast<double>(values.size());
}

/// Returns the factor that puts the points inside a plate: 1, 1/1,000 or 1,000.
double factor_of(const std::vector<double>& away_m, double size_m) {
  const double middle_m = math::median(away_m);
  if (share_within(away_m, size_m) <= 1.0 - kNearlyAll && middle_m >= kFar * size_m &&
      share_within(away_m, 1e3 * size_m) >= kNearlyAll)
    return 1e-3;
  if (share_within(away_m, kNear * size_m) >= kAll && 1e3 * middle_m >= kAway_m &&
      share_within(away_m, 1e-3 * size_m) >= kNearlyAll)
    return 1e3;
  return 1.0;
}

std::string_view unit_by(double factor, bool length) {
  if (length) return factor < 1.0 ? "mm" : "m";
  return factor < 1.0 ? "N mm" : "N m";
}

}  // namespace

void mend_moment_unit(PlateSetup& setup, const Eigen::MatrixXd& channel_values, std::vector<Repair>& repairs) {
  if (setup.type == 3 || setup.factors.size() < 6) return;
  const Loaded loaded = loaded_samples(setup, plate_channels_si(setup, channel_values));
  if (loaded.away_m.size() < kFewest) return;
  const double size_m = std::max((setup.corners_m.col(0) - setup.corners_m.col(2)).norm(),
                                 (setup.corners_m.col(1) - setup.corners_m.col(3)).norm());
  const double factor = factor_of(loaded.away_m, size_m);
  const bool length = setup.type == 1;
  if (factor != 1.0) {
    note(repairs,
         "force plate {}: with the unit that the file states, the center of pressure would be {:.3g} m from the "
         "middle of a plate of {:.2g} m; the {} are taken in {}",
         setup.number, math::median(loaded.away_m), size_m, length ? "points" : "moments", unit_by(factor, length));
  }
  if (setup.type == 4) {
    setup.calibrated_to_nm *= factor;
    return;
  }
  const bool with_normal = !length && setup.factors[5] == setup.factors[3];
  setup.factors[3] *= factor;
  setup.factors[4] *= factor;
  if (with_normal) {
    setup.factors[5] *= factor;
  } else if (share_within(loaded.twist_m, size_m) <= 1.0 - kNearlyAll &&
             share_within(loaded.twist_m, 1e3 * size_m) >= kNearlyAll) {
    setup.factors[5] *= 1e-3;
    note(repairs, "force plate {}: its moment about the normal exceeds the force times its size; taken in N mm",
         setup.number);
  }
}

}  // namespace myoid::recording
