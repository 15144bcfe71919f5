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
#include "myoid/recording/series_file.h"
#include "myoid/study/intake/trial_input.h"

namespace myoid::study {
namespace {

/// Refuses lengths that no fiber of this muscle has, which are in another unit than the one that is written.
void require_possible(const std::filesystem::path& path,
                      const std::string& muscle,
                      double optimal_m,
                      const Eigen::VectorXd& length_m) {
  constexpr double kShortest = 0.2, kLongest = 4.0;  // of the model's optimal fiber length: people differ by half
  std::vector<double> known;
  for (const double length : length_m)
    if (std::isfinite(length)) known.push_back(length);
  if (known.empty())
    throw ReadError(path, 0, fmt::format("column '{}' has no number; leave 'fascicles' out of the trial", muscle));
  const double usual_m = math::upper_median(known);
  if (usual_m >= kShortest * optimal_m && usual_m <= kLongest * optimal_m) return;
  throw ReadError(
      path, 0,
      fmt::format("column '{}': the median length is {:.4g} m, expected a fascicle of {:.2g} to {:.2g} m (the model's "
                  "fibers are {:.3g} m long); write the unit of the numbers, as in '{} [mm]'",
                  muscle, usual_m, kShortest * optimal_m, kLongest * optimal_m, optimal_m, muscle));
}

/// Returns the optimal fiber length of the longest head of a study's muscle [m].
double optimal_length(const body::BodyModel& model, const MuscleSpec& muscle) {
  double longest_m = 0.0;
  for (const std::string& head : muscle.osim)
    if (const auto found = model.find_muscle(head))
      longest_m =
          std::max(longest_m, model.muscles[static_cast<std::size_t>(*found)].properties.optimal_fiber_length_m);
  return longest_m;
}

}  // namespace

TimeSeries read_fascicles(const Study& study,
                          const body::BodyModel& model,
                          const std::filesystem::path& path,
                          std::vector<Remark>& remarks) {
  const recording::SeriesFile file = recording::read_series(path);
  add_repairs(path, file.repairs, remarks);
  std::vector<std::string> there;
  for (const MuscleSpec& muscle : study.muscles) {
    recording::require_known_unit(path, file, muscle.name);
    const auto column = file.data.find(muscle.name);
    if (!column) continue;
    there.push_back(muscle.name);
    recording::require_unit(path, file, *column, Unit::meter);
    require_possible(path, muscle.name, optimal_length(model, muscle), file.data.values().col(*column));
  }
  if (there.empty())
    throw ReadError(
        path, 0,
        fmt::format("no column is named as a [[muscle]]; found {}, expected some of {}, as in '{} [mm]'",
                    channel_names(file.data), name_list(study.muscles, &MuscleSpec::name), study.muscles.front().name));
  return file.data.select(there);
}

void require_times_of_trial(const std::filesystem::path& path,
                            const TimeSeries& fascicles,
                            const Eigen::VectorXd& trial_s) {
  const Eigen::VectorXd& own_s = fascicles.time_s();
  const double begin_s = trial_s[0], end_s = trial_s[trial_s.size() - 1];
  if (std::ranges::any_of(own_s, [&](double t) { return t >= begin_s && t <= end_s; })) return;
  throw ReadError(
      path, 0,
      fmt::format("the lengths are of {:.4g} to {:.4g} s and the trial's of {:.4g} to {:.4g} s: is it another "
                  "trial's file? Write the times of the lengths on the clock of the trial",
                  own_s[0], own_s[own_s.size() - 1], begin_s, end_s));
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
