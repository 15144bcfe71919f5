#include "myoid/ground/math/zero_phase.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground::math {
namespace {

constexpr Eigen::Index kLongestExtension = 100'000;  ///< In samples, for very low cut-offs.

/// Returns the number of samples after which the slowest pole has decayed to 1e-8.
Eigen::Index impulse_length(const std::vector<SecondOrderSection>& sections) {
  double radius = 0.0;
  for (const SecondOrderSection& s : sections) {
    const double discriminant = s.a1 * s.a1 - 4.0 * s.a2;
    const double r = discriminant < 0.0 ? std::sqrt(s.a2) : 0.5 * (std::abs(s.a1) + std::sqrt(discriminant));
    radius = std::max(radius, r);
  }
  if (radius <= 0.0) return 1;
  return static_cast<Eigen::Index>(std::ceil(std::log(1e-8) / std::log(std::min(radius, 1.0 - 1e-9))));
}

void run(const std::vector<SecondOrderSection>& sections, std::vector<double>& x) {
  for (const SecondOrderSection& s : sections) {
    // Transposed direct form II, started in the steady state of a constant input x[0].
    const double constant = x.front();
    const double out = constant * (s.b0 + s.b1 + s.b2) / (1.0 + s.a1 + s.a2);
    double z2 = s.b2 * constant - s.a2 * out;
    double z1 = s.b1 * constant - s.a1 * out + z2;
    for (double& value : x) {
      const double in = value;
      value = s.b0 * in + z1;
      z1 = s.b1 * in - s.a1 * value + z2;
      z2 = s.b2 * in - s.a2 * value;
    }
  }
}

/// Returns x with `pad` more samples on either side.
std::vector<double> extended(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index pad, Ends ends) {
  const Eigen::Index n = x.size();
  // Sample i of the signal reflected to and fro between its ends.
  const auto mirrored = [&](Eigen::Index i) {
    const Eigen::Index period = 2 * (n - 1);
    const Eigen::Index k = ((i % period) + period) % period;
    return x[k < n ? k : period - k];
  };
  const auto beyond = [&](Eigen::Index end, Eigen::Index i) {
    return ends == Ends::even ? mirrored(i) : 2.0 * x[end] - mirrored(i);
  };
  std::vector<double> y;
  y.reserve(static_cast<std::size_t>(n + 2 * pad));
  for (Eigen::Index i = -pad; i < 0; ++i) y.push_back(beyond(0, i));
  y.insert(y.end(), x.data(), x.data() + n);
  for (Eigen::Index i = n; i < n + pad; ++i) y.push_back(beyond(n - 1, i));
  return y;
}

}  // namespace

Eigen::VectorXd zero_phase(const std::vector<SecondOrderSection>& sections,
                           const Eigen::Ref<const Eigen::VectorXd>& x,
                           Ends ends) {
  const Eigen::Index n = x.size();
  if (n < 4) throw InvalidInput(fmt::format("zero-phase filter: {} samples are too few; at least 4 are needed", n));
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!std::isfinite(x[i])) {
      throw InvalidInput(fmt::format("zero-phase filter: sample {} is not a number; fill the gaps first", i + 1));
    }
  }
  const Eigen::Index response = 3 * impulse_length(sections);
  const Eigen::Index most = ends == Ends::even ? std::max(n - 1, kLongestExtension) : n - 1;
  const Eigen::Index pad = std::min(most, response);
  std::vector<double> y = extended(x, pad, ends);
  run(sections, y);
  std::reverse(y.begin(), y.end());
  run(sections, y);
  std::reverse(y.begin(), y.end());
  return Eigen::Map<const Eigen::VectorXd>(y.data() + pad, n);
}

}  // namespace myoid::inline ground::math
