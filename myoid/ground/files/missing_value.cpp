#include "myoid/ground/files/missing_value.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "myoid/ground/core/numbers.h"

namespace myoid::inline ground {
namespace {

constexpr double kLeast = 999.0;  ///< Fewer nines are usual numbers.
constexpr double kFarther = 3.0;  ///< Times the largest other number.

/// Replaces the numbers in one column and returns how often each was there.
std::map<double, Eigen::Index> take_out_of(Eigen::Ref<Eigen::VectorXd> column) {
  std::map<double, Eigen::Index> counts;
  double largest = 0.0;
  for (const double x : column) {
    if (may_stand_for_missing(x)) {
      ++counts[x];
    } else if (std::isfinite(x)) {
      largest = std::max(largest, std::abs(x));
    }
  }
  std::erase_if(counts, [&](const auto& of) { return std::abs(of.first) <= kFarther * largest; });
  if (counts.empty()) return counts;
  for (double& x : column)
    if (counts.contains(x)) x = kNan;
  return counts;
}

}  // namespace

bool may_stand_for_missing(double number) {
  const double size = std::abs(number);
  if (!(size >= kLeast)) return false;
  constexpr double kMostDigits = 1e9;
  for (const double shift : {1.0, 10.0, 100.0}) {
    const double digits = size * shift;
    if (digits > kMostDigits) return false;
    const double nines = std::pow(10.0, std::round(std::log10(digits + 1.0))) - 1.0;
    if (std::abs(digits - nines) < 1e-6) return true;
  }
  return false;
}

std::vector<std::optional<double>> take_out_missing(Eigen::MatrixXd& values,
                                                    const std::vector<std::string>& names,
                                                    std::vector<Repair>& repairs) {
  std::vector<std::optional<double>> found(names.size());
  for (std::size_t c = 0; c < names.size(); ++c) {
    const std::map<double, Eigen::Index> counts = take_out_of(values.col(static_cast<Eigen::Index>(c)));
    if (counts.empty()) continue;
    const auto& [number, count] = *std::ranges::max_element(counts, {}, [](const auto& of) { return of.second; });
    found[c] = number;
    note(repairs, "{} in {} {} of column '{}' stands for a missing value; kept as a gap", number, count,
         count == 1 ? "row" : "rows", names[c]);
  }
  return found;
}

}  // namespace myoid::inline ground
