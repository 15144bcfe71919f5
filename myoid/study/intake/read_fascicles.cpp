#include "myoid/study/intake/read_fascicles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/names.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/recording/column_unit.h"
#include "myoid/recording/tables/series_file.h"
#include "myoid/study/intake/trial_input.h"

namespace myoid::study {
namespace {

constexpr double kShortest_m = 0.003, kLongest_m = 0.6;  // fibers of human muscles: 10 mm to 0.45 m

/// Refuses lengths in another unit than the one that is written.
void require_possible(const std::filesystem::path& path, const std::string& muscle, const Eigen::VectorXd& length_m) {
  std::vector<double> known;
  for (const double length : length_m)
    if (std::isfinite(length)) known.push_back(length);
  if (known.empty())
    throw ReadError(path, 0, fmt::format("column '{}' has no number; leave 'fascicles' out of the trial", muscle));
  const double usual_m = math::upper_median(known);
  if (usual_m >= kShortest_m && usual_m <= kLongest_m) return;
  throw ReadError(
      path, 0,
      fmt::format("column '{}': the median length is {:.4g} m, expected a fascicle of {} to {} m; write the "
                  "unit of the numbers, as in '{} [mm]'",
                  muscle, usual_m, kShortest_m, kLongest_m, muscle));
}

}  // namespace

TimeSeries read_fascicles(const Study& study, const std::filesystem::path& path, std::vector<Remark>& remarks) {
  const recording::SeriesFile file = recording::read_series(path);
  add_repairs(path, file.repairs, remarks);
  std::vector<std::string> there;
  for (const MuscleSpec& muscle : study.muscles) {
    recording::require_known_unit(path, file, muscle.name);
    if (file.data.find(muscle.name)) there.push_back(muscle.name);
  }
  if (there.empty())
    throw ReadError(
        path, 0,
        fmt::format("no column is named as a [[muscle]]; found {}, expected some of {}, as in '{} [mm]'",
                    channel_names(file.data), name_list(study.muscles, &MuscleSpec::name), study.muscles.front().name));
  for (const std::string& muscle : there) {
    const Eigen::Index column = file.data.index(muscle);
    recording::require_unit(path, file, column, Unit::meter);
    require_possible(path, muscle, file.data.values().col(column));
  }
  return file.data.select(there);
}

Eigen::MatrixXd fascicles_at(const TimeSeries& fascicles,
                             const std::vector<MuscleSpec>& muscles,
                             const Eigen::VectorXd& time_s) {
  constexpr double kBridged_s = 0.2, kAbsent = std::numeric_limits<double>::quiet_NaN();
  const Eigen::VectorXd& own_s = fascicles.time_s();
  Eigen::MatrixXd found = Eigen::MatrixXd::Constant(time_s.size(), static_cast<Eigen::Index>(muscles.size()), kAbsent);
  for (Eigen::Index i = 0; i < time_s.size(); ++i) {
    const Eigen::Index after = std::ranges::lower_bound(own_s, time_s[i]) - own_s.begin();
    if (after == own_s.size() || (after == 0 && own_s[0] > time_s[i])) continue;
    const Eigen::Index before = std::max<Eigen::Index>(after - 1, 0);
    const double apart_s = own_s[after] - own_s[before];
    if (apart_s > kBridged_s) continue;
    const double share = after == before ? 0.0 : (time_s[i] - own_s[before]) / apart_s;
    for (std::size_t k = 0; k < muscles.size(); ++k) {
      if (const auto column = fascicles.find(muscles[k].name))
        found(i, static_cast<Eigen::Index>(k)) =
            (1.0 - share) * fascicles.values()(before, *column) + share * fascicles.values()(after, *column);
    }
  }
  return found;
}

}  // namespace myoid::study
