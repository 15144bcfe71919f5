#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace myoid::test {

/// Recordings of other laboratories as they are published: their columns, and envelopes, levels and
/// torques made from them by nothing of this project.

/// Reads the columns of numbers behind `header` lines.
inline std::vector<std::vector<double>> read_columns(const std::filesystem::path& file, int header) {
  std::ifstream stream(file);
  std::string line;
  for (int i = 0; i < header; ++i) std::getline(stream, line);
  std::vector<std::vector<double>> columns;
  while (std::getline(stream, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (std::size_t c = 0; std::getline(cells, cell, ','); ++c) {
      if (columns.size() <= c) columns.emplace_back();
      columns[c].push_back(cell.empty() ? 0.0 : std::stod(cell));
    }
  }
  return columns;
}

/// Averages over `width` samples, at the ends over those that there are.
inline std::vector<double> moving_mean(const std::vector<double>& x, std::ptrdiff_t width) {
  std::vector<double> sums(x.size() + 1, 0.0), result(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) sums[i + 1] = sums[i] + x[i];
  const auto n = static_cast<std::ptrdiff_t>(x.size());
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    const auto from = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, i - width / 2));
    const auto to = static_cast<std::size_t>(std::min(n, i + width / 2 + 1));
    result[static_cast<std::size_t>(i)] = (sums[to] - sums[from]) / static_cast<double>(to - from);
  }
  return result;
}

/// Rectifies EMG about its mean and averages it over 0.2 s, twice.
inline std::vector<double> envelope(std::vector<double> raw, double rate_hz) {
  double mean = 0.0;
  for (const double x : raw) mean += x / static_cast<double>(raw.size());
  for (double& x : raw) x = std::abs(x - mean);
  const auto width = static_cast<std::ptrdiff_t>(0.2 * rate_hz);
  return moving_mean(moving_mean(raw, width), width);
}

/// Finds the greatest mean over half a second.
inline double greatest(const std::vector<double>& x, double rate_hz) {
  const std::vector<double> mean = moving_mean(x, static_cast<std::ptrdiff_t>(0.5 * rate_hz));
  return *std::max_element(mean.begin(), mean.end());
}

/// Fits a cubic to points by least squares (normal equations, four unknowns).
inline std::vector<double> cubic(const std::vector<std::pair<double, double>>& points) {
  double a[4][5] = {};
  for (const auto& [x, y] : points) {
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) a[i][j] += std::pow(x, i + j);
      a[i][4] += y * std::pow(x, i);
    }
  }
  for (int i = 0; i < 4; ++i) {
    for (int r = 0; r < 4; ++r) {
      if (r == i) continue;
      const double f = a[r][i] / a[i][i];
      for (int c = i; c < 5; ++c) a[r][c] -= f * a[i][c];
    }
  }
  return {a[0][4] / a[0][0], a[1][4] / a[1][1], a[2][4] / a[2][2], a[3][4] / a[3][3]};
}

inline double median(std::vector<double> x) {
  std::nth_element(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2), x.end());
  return x[x.size() / 2];
}

/// The tibialis anterior's share of a torque at the dynamometer of `tecchio-ankle`, as its authors
/// have it: half of the torque [N m] beyond that of the relaxed ankle at this angle [deg].
class TibialisTorque {
 public:
  explicit TibialisTorque(const std::filesystem::path& data) {
    std::vector<std::pair<double, double>> relaxed;
    for (const char* angle : {"-15", "-10", "5", "10", "20", "25"}) {
      const auto held = read_columns(data / fmt::format("Pas_{}_dynamometer.csv", angle), 1);
      relaxed.emplace_back(median(held[2]), median(held[1]));
    }
    relaxed_ = cubic(relaxed);
  }
  [[nodiscard]] double operator()(double torque_nm, double crank_deg) const {
    const auto& c = relaxed_;
    const double q = crank_deg;
    return 0.5 * (torque_nm - (c[0] + q * (c[1] + q * (c[2] + q * c[3]))));
  }

 private:
  std::vector<double> relaxed_;
};

}  // namespace myoid::test
