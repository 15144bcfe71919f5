#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace myoid::test {

/// The law of the muscles once more, from the equations of docs/theory alone, and files read by nothing of
/// this project: numbers that the program prints are computed anew from what it wrote. Envelopes between samples by
/// cubics, the rest by lines, equation (1) by exact steps of a tenth of a millisecond.

/// A storage file (.sto, .mot).
struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
  [[nodiscard]] const std::vector<double>& of(const std::string& name) const {
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end()) throw std::runtime_error("no column " + name);
    return columns[static_cast<std::size_t>(at - names.begin())];
  }
};

inline Table read_table(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error("no file " + file.string());
  std::string line;
  while (std::getline(stream, line) && !line.starts_with("endheader")) {
  }
  Table table;
  std::getline(stream, line);
  std::istringstream names(line);
  for (std::string name; names >> name;) table.names.push_back(name);
  table.columns.resize(table.names.size());
  while (std::getline(stream, line)) {
    std::istringstream cells(line);
    double x = 0.0;
    for (std::size_t c = 0; c < table.columns.size() && cells >> x; ++c) table.columns[c].push_back(x);
  }
  return table;
}

inline double between(const std::vector<double>& t, const std::vector<double>& x, double at) {
  if (at <= t.front()) return x.front();
  if (at >= t.back()) return x.back();
  const auto after = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), at) - t.begin());
  const double share = (at - t[after - 1]) / (t[after] - t[after - 1]);
  return x[after - 1] + share * (x[after] - x[after - 1]);
}

/// The cubic through four neighbors of an even clock (Catmull and Rom): an envelope of 6 Hz at 100
/// samples a second loses half a percent between them by straight lines.
inline double curve(const std::vector<double>& t, const std::vector<double>& x, double at) {
  const auto k = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), at) - t.begin());
  if (k < 2 || k + 1 >= t.size()) return between(t, x, at);
  const double s = (at - t[k - 1]) / (t[k] - t[k - 1]);
  const double before = x[k - 2], left = x[k - 1], right = x[k], after = x[k + 1];
  return left +
         0.5 * s *
             (right - before +
              s * (2.0 * before - 5.0 * left + 4.0 * right - after + s * (3.0 * (left - right) + after - before)));
}

/// Parameters by their names in parameters.csv, with what stands for those that are absent.
struct Numbers {
  std::map<std::string, double> value;
  [[nodiscard]] double get(const std::string& name, double otherwise) const {
    const auto at = value.find(name);
    return at == value.end() ? otherwise : at->second;
  }
};

/// An envelope behind the delay, or behind delay and lags that share it as 10, 40, 15 (50 where it falls) ms of 82.5.
inline std::vector<double> follow(const std::vector<double>& clock,
                                  const std::vector<double>& envelope,
                                  const std::vector<double>& at,
                                  double delay_s,
                                  bool shared) {
  std::vector<double> result;
  if (!shared) {
    for (const double t : at) result.push_back(std::max(0.0, curve(clock, envelope, t - delay_s)));
    return result;
  }
  const double unit = delay_s / 82.5;
  constexpr double kStep_s = 1e-4;
  std::vector<double> times, values;
  double e = std::max(0.0, envelope.front()), a = e;
  for (double t = clock.front(); t <= clock.back() + 1e-9; t += kStep_s) {
    const double u = std::max(0.0, curve(clock, envelope, t));
    e += (1.0 - std::exp(-kStep_s / (40.0 * unit))) * (u - e);
    a += (1.0 - std::exp(-kStep_s / ((e >= a ? 15.0 : 50.0) * unit))) * (e - a);
    times.push_back(t);
    values.push_back(a);
  }
  for (const double t : at) result.push_back(between(times, values, t - 10.0 * unit));
  return result;
}

/// Tension of equations (2) to (4), with a rigid tendon, a fixed width of the fibers and an optimal
/// length that grows at low activation.
inline double tension(double a, double length_m, double velocity_mps, const Numbers& m) {
  const double l0 = m.value.at("optimal_fiber_length"), l_sh = m.value.at("force_length_width");
  const double v_max = m.value.at("max_shortening_speed");
  const double v_sh = m.value.at("concentric_curvature");
  const double p = m.value.at("eccentric_curvature_product");
  const double v_ml = m.value.at("eccentric_plateau");
  const double along = length_m - m.get("tendon_slack_length", 0.0);
  const double width = l0 * std::sin(m.get("pennation_angle", 0.0));
  const double l = std::hypot(width, along), cosine = width > 0.0 ? along / l : 1.0;
  const double v = velocity_mps * cosine;
  const double optimum = l0 * (1.0 + m.get("length_activation", 0.0) * (1.0 - a));
  const double f_l = std::exp(-std::pow((l - optimum) / l_sh, 2));
  const double f_v = v <= -v_max ? 0.0
                     : v <= 0.0  ? v_sh * (v_max + v) / (v_sh * v_max - v)
                                 : (p * v_max + v_ml * v) / (p * v_max + v);
  return m.value.at("max_isometric_force") * a * f_l * f_v * cosine;
}

inline double r2_of(const std::vector<double>& measured, const std::vector<double>& predicted) {
  double mean = 0.0, errors = 0.0, spread = 0.0;
  for (const double x : measured) mean += x / static_cast<double>(measured.size());
  for (std::size_t i = 0; i < measured.size(); ++i) {
    errors += std::pow(measured[i] - predicted[i], 2);
    spread += std::pow(measured[i] - mean, 2);
  }
  return 1.0 - errors / spread;
}

}  // namespace myoid::test
