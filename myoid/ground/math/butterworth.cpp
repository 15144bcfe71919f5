#include "myoid/ground/math/butterworth.h"

#include <cmath>
#include <complex>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::inline ground::math {
namespace {

void check(int order, double cutoff_hz, double rate_hz) {
  if (order < 1) throw InvalidInput(fmt::format("Butterworth filter: found order {}, expected 1 or more", order));
  if (!(cutoff_hz > 0.0) || !(cutoff_hz < 0.5 * rate_hz)) {
    throw InvalidInput(fmt::format(
        "Butterworth filter: a cut-off of {} Hz does not fit data sampled at {} Hz; it must lie between 0 and {} Hz",
        cutoff_hz, rate_hz, 0.5 * rate_hz));
  }
}

}  // namespace

std::vector<SecondOrderSection> design_butterworth(FilterBand band, int order, double cutoff_hz, double rate_hz) {
  check(order, cutoff_hz, rate_hz);
  const double w = std::tan(kPi * cutoff_hz / rate_hz);
  std::vector<SecondOrderSection> sections;
  // Pole pairs of the prototype: s^2 + 2 sin(theta) w s + w^2, theta = pi (2k+1) / (2 order); s =
  // (1 - z^-1)/(1 + z^-1).
  for (int k = 0; k < order / 2; ++k) {
    const double damping = 2.0 * std::sin(kPi * (2.0 * k + 1.0) / (2.0 * order)) * w;
    const double a0 = 1.0 + damping + w * w;
    SecondOrderSection section;
    section.a1 = 2.0 * (w * w - 1.0) / a0;
    section.a2 = (1.0 - damping + w * w) / a0;
    if (band == FilterBand::low_pass) {
      section.b0 = w * w / a0;
      section.b1 = 2.0 * section.b0;
    } else {
      section.b0 = 1.0 / a0;
      section.b1 = -2.0 * section.b0;
    }
    section.b2 = section.b0;
    sections.push_back(section);
  }
  if (order % 2 == 1) {
    SecondOrderSection section;
    section.a1 = (w - 1.0) / (w + 1.0);
    section.b0 = band == FilterBand::low_pass ? w / (w + 1.0) : 1.0 / (w + 1.0);
    section.b1 = band == FilterBand::low_pass ? section.b0 : -section.b0;
    sections.push_back(section);
  }
  return sections;
}

double two_pass_cutoff_hz(FilterBand band, int order, double cutoff_hz, double rate_hz) {
  check(order, cutoff_hz, rate_hz);
  const double c = std::pow(std::sqrt(2.0) - 1.0, 1.0 / (2.0 * order));
  const double w = std::tan(kPi * cutoff_hz / rate_hz);
  return std::atan(band == FilterBand::low_pass ? w / c : w * c) * rate_hz / kPi;
}

double gain(const std::vector<SecondOrderSection>& sections, double frequency_hz, double rate_hz) {
  const std::complex<double> z1 = std::polar(1.0, -2.0 * kPi * frequency_hz / rate_hz);
  double product = 1.0;
  for (const SecondOrderSection& s : sections) {
    product *= std::abs((s.b0 + z1 * (s.b1 + z1 * s.b2)) / (1.0 + z1 * (s.a1 + z1 * s.a2)));
  }
  return product;
}

}  // namespace myoid::inline ground::math
