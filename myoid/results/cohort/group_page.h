#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "myoid/page/report.h"
#include "myoid/results/cohort/group_person.h"

namespace myoid::results {

/// A number of one person that lies far from the other persons'.
struct Outlier {
  std::string person, number, unit;
  double value = 0.0, median = 0.0;
  double distance = 0.0;  ///< In robust standard deviations, with sign.
};

/// The robust distance of each value from the others: (x - median) / (1.4826 MAD), MAD the median absolute deviation
/// from the median. 0 for all where MAD is 0 or there are fewer than five values. Beyond 3.5 a value is an outlier
/// (Iglewicz and Hoaglin, How to Detect and Handle Outliers, 1993).
inline constexpr double kOutlierDistance = 3.5;
inline constexpr std::size_t kFewestForOutliers = 5;
[[nodiscard]] std::vector<double> robust_distances(const std::vector<double>& values);

/// The persons side by side: quality first, then each parameter with a column per muscle, then the
/// outliers, then mean and spread. Numbers that a recording does not determine (verdict other than
/// identified, reproducible or weak) are drawn pale and not counted. The page draws 60 persons at most, and names the
/// first 200 outliers; medians, spreads and means are those of all persons.
struct GroupPage {
  page::Section persons;  ///< Strip plots and summary, with ids.
  std::vector<Outlier> outliers;
};
[[nodiscard]] GroupPage group_page(const std::vector<GroupPerson>& persons);

/// Returns a sentence that names the outliers; empty without any.
[[nodiscard]] std::string outlier_sentence(const std::vector<Outlier>& outliers);

}  // namespace myoid::results
