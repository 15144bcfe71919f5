#include "myoid/recording/signals/mains_hum.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "myoid/ground/core/units.h"
#include "myoid/ground/math/decompositions.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/ground/math/zero_phase.h"
#include "myoid/recording/signals/spectrum.h"

namespace myoid::recording {
namespace {

constexpr double kSegment_s = 2.0;
constexpr double kStandsOut = 8.0;
constexpr double kHighestLine_hz = 450.0;
constexpr double kNotchWidth_hz = 4.0;
constexpr double kExtension_s = 1.0;  ///< The notch rings for 1 / (pi 4 Hz) = 0.08 s.
constexpr double kHumFit_s = 0.5;     ///< The mains drift by less than a tenth of a turn in this time.

/// Returns the power of a line above its neighbors; 0 if it does not stand out.
double line_power(const PowerSpectrum& s, double line_hz) {
  std::vector<double> neighbors;
  double peak = 0.0;
  for (Eigen::Index k = 0; k < s.frequency_hz.size(); ++k) {
    const double away_hz = std::abs(s.frequency_hz[k] - line_hz);
    if (away_hz <= 0.5) peak = std::max(peak, s.density[k]);
    if (away_hz >= 2.0 && away_hz <= 6.0) neighbors.push_back(s.density[k]);
  }
  if (neighbors.empty()) return 0.0;
  const double middle = math::upper_median(std::move(neighbors));
  if (peak <= kStandsOut * middle) return 0.0;
  constexpr double kHalfWidth_hz = 1.5;  // the window's main lobe
  return std::max(0.0, band_power(s, line_hz - kHalfWidth_hz, line_hz + kHalfWidth_hz) - 2.0 * kHalfWidth_hz * middle);
}

/// Extrapolates `count` samples beyond the last one: the lines continue as sines (least squares
/// over the last half second), the rest is mirrored. Mirroring would turn the phase of the lines,
/// and a notch passes such a turn for a tenth of a second.
Eigen::VectorXd beyond_the_end(const Eigen::VectorXd& x, double rate_hz, const Hum& hum, Eigen::Index count) {
  const Eigen::Index n = x.size();
  const auto lines = static_cast<Eigen::Index>(hum.lines_hz.size());
  // Columns of sines at `rows` samples from `first` on.
  const auto sines = [&](Eigen::Index first, Eigen::Index rows) {
    Eigen::MatrixXd columns(rows, 2 * lines);
    for (Eigen::Index k = 0; k < lines; ++k) {
      const Eigen::ArrayXd phase =
          2.0 * kPi * hum.lines_hz[static_cast<std::size_t>(k)] / rate_hz *
          Eigen::ArrayXd::LinSpaced(rows, static_cast<double>(first), static_cast<double>(first + rows - 1));
      columns.col(2 * k) = phase.cos();
      columns.col(2 * k + 1) = phase.sin();
    }
    return columns;
  };
  const Eigen::Index fitted = std::min(n, static_cast<Eigen::Index>(std::lround(kHumFit_s * rate_hz)));
  const Eigen::VectorXd weight = math::nearest_solution(sines(n - fitted, fitted), x.tail(fitted));
  const Eigen::VectorXd rest = x.tail(count + 1) - sines(n - 1 - count, count + 1) * weight;
  return rest.head(count).reverse() + sines(n, count) * weight;
}

}  // namespace

std::optional<Hum> find_hum(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_hz) {
  if (static_cast<double>(x.size()) < kSegment_s * rate_hz) return std::nullopt;
  const PowerSpectrum spectrum = power_spectrum(x, rate_hz, kSegment_s);
  const double total = band_power(spectrum, 20.0, 0.45 * rate_hz);
  if (!(total > 0.0)) return std::nullopt;
  std::optional<Hum> best;
  for (const double mains_hz : {50.0, 60.0}) {
    Hum hum{.mains_hz = mains_hz};
    for (double line = mains_hz; line < std::min(kHighestLine_hz, 0.45 * rate_hz); line += mains_hz) {
      const double power = line_power(spectrum, line);
      if (power <= 0.0) continue;
      hum.lines_hz.push_back(line);
      hum.share += power / total;
    }
    if (hum.share > 0.0 && (!best || hum.share > best->share)) best = std::move(hum);
  }
  return best;
}

Eigen::VectorXd without_hum(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_hz, const Hum& hum) {
  std::vector<math::SecondOrderSection> notches;
  for (const double line_hz : hum.lines_hz) {
    const double w = 2.0 * kPi * line_hz / rate_hz;
    // H(s) = (s^2 + w0^2) / (s^2 + B s + w0^2), by the bilinear transform exact at w.
    const double half_width = std::tan(kPi * kNotchWidth_hz / rate_hz);
    const double a0 = 1.0 + half_width;
    notches.push_back({.b0 = 1.0 / a0,
                       .b1 = -2.0 * std::cos(w) / a0,
                       .b2 = 1.0 / a0,
                       .a1 = -2.0 * std::cos(w) / a0,
                       .a2 = (1.0 - half_width) / a0});
  }
  if (notches.empty()) return x;
  const Eigen::Index n = x.size();
  const auto wanted = static_cast<Eigen::Index>(std::lround(kExtension_s * rate_hz));
  const Eigen::Index pad = std::min(n - 1, wanted);
  Eigen::VectorXd longer(n + 2 * pad);
  longer << beyond_the_end(x.reverse(), rate_hz, hum, pad).reverse(), x, beyond_the_end(x, rate_hz, hum, pad);
  return math::zero_phase(notches, longer, math::Ends::even).segment(pad, n);
}

}  // namespace myoid::recording
