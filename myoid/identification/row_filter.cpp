#include "myoid/identification/row_filter.h"

#include <algorithm>
#include <cmath>

namespace myoid::identification {
namespace {

constexpr Eigen::Index kTogether = 8;
using Lane = Eigen::Array<double, kTogether, 1>;

/// Returns the number of samples after which the slowest mode has decayed to 1e-4.
Eigen::Index memory_of(const std::vector<math::SecondOrderSection>& sections) {
  double radius = 0.0;
  for (const math::SecondOrderSection& s : sections) {
    const double discriminant = s.a1 * s.a1 - 4.0 * s.a2;
    radius = std::max(radius, discriminant < 0.0 ? std::sqrt(s.a2) : 0.5 * (std::abs(s.a1) + std::sqrt(discriminant)));
  }
  return static_cast<Eigen::Index>(std::ceil(std::log(1e-4) / std::log(std::clamp(radius, 1e-3, 1.0 - 1e-9))));
}

/// The state of a section after constant input 1.
struct SteadyState {
  explicit SteadyState(const math::SecondOrderSection& s) {
    const double gain = (s.b0 + s.b1 + s.b2) / (1.0 + s.a1 + s.a2);
    z2 = s.b2 - s.a2 * gain;
    z1 = s.b1 - s.a1 * gain + z2;
  }
  double z1 = 0.0, z2 = 0.0;
};

/// Runs one section over the columns of y from one end to the other, from the steady state of the first sample.
void run(const math::SecondOrderSection& s, Eigen::Matrix<double, kTogether, Eigen::Dynamic>& y, bool forwards) {
  const Eigen::Index begin = forwards ? 0 : y.cols() - 1;
  const Eigen::Index step = forwards ? 1 : -1;
  const SteadyState steady(s);
  Lane z1 = steady.z1 * y.col(begin).array();
  Lane z2 = steady.z2 * y.col(begin).array();
  for (Eigen::Index i = begin; i >= 0 && i < y.cols(); i += step) {
    const Lane in = y.col(i).array();
    const Lane out = s.b0 * in + z1;
    z1 = s.b1 * in - s.a1 * out + z2;
    z2 = s.b2 * in - s.a2 * out;
    y.col(i) = out.matrix();
  }
}

/// Applies the transpose of `run` to one signal: the recursion's derivatives, last step first.
void run_transposed(const math::SecondOrderSection& s, Eigen::VectorXd& y, bool forwards) {
  const Eigen::Index begin = forwards ? 0 : y.size() - 1;
  const Eigen::Index step = forwards ? 1 : -1;
  double by_z1 = 0.0, by_z2 = 0.0;
  for (Eigen::Index k = y.size() - 1; k >= 0; --k) {
    double& at = y[begin + step * k];
    const double by_out = at - s.a1 * by_z1 - s.a2 * by_z2;
    at = s.b0 * by_out + s.b1 * by_z1 + s.b2 * by_z2;
    by_z2 = by_z1;
    by_z1 = by_out;
  }
  const SteadyState steady(s);
  y[begin] += steady.z1 * by_z1 + steady.z2 * by_z2;
}

}  // namespace

void filter_rows(const std::vector<math::SecondOrderSection>& sections,
                 const std::vector<SignalRow>& rows,
                 Eigen::Index count) {
  if (sections.empty() || count == 0) return;
  const Eigen::Index pad = std::min(count - 1, memory_of(sections));
  Eigen::Matrix<double, kTogether, Eigen::Dynamic> y(kTogether, count + 2 * pad);
  for (std::size_t first = 0; first < rows.size(); first += kTogether) {
    const auto here = std::min(static_cast<Eigen::Index>(rows.size() - first), Eigen::Index{kTogether});
    if (here < kTogether) y.setZero();
    for (Eigen::Index r = 0; r < here; ++r) {
      const SignalRow& row = rows[first + static_cast<std::size_t>(r)];
      for (Eigen::Index i = 0; i < count; ++i) y(r, pad + i) = row.data[i * row.stride];
    }
    for (Eigen::Index i = 1; i <= pad; ++i) {
      y.col(pad - i) = 2.0 * y.col(pad) - y.col(pad + i);
      y.col(pad + count - 1 + i) = 2.0 * y.col(pad + count - 1) - y.col(pad + count - 1 - i);
    }
    for (const math::SecondOrderSection& section : sections) {
      run(section, y, true);
      run(section, y, false);
    }
    for (Eigen::Index r = 0; r < here; ++r) {
      const SignalRow& row = rows[first + static_cast<std::size_t>(r)];
      for (Eigen::Index i = 0; i < count; ++i) row.data[i * row.stride] = y(r, pad + i);
    }
  }
}

Eigen::VectorXd transposed_filter(const std::vector<math::SecondOrderSection>& sections, const Eigen::VectorXd& y) {
  const Eigen::Index count = y.size();
  if (sections.empty() || count == 0) return y;
  const Eigen::Index pad = std::min(count - 1, memory_of(sections));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(count + 2 * pad);
  x.segment(pad, count) = y;
  for (auto section = sections.rbegin(); section != sections.rend(); ++section) {
    run_transposed(*section, x, false);
    run_transposed(*section, x, true);
  }
  const Eigen::Index last = pad + count - 1;
  for (Eigen::Index i = 1; i <= pad; ++i) {
    x[pad] += 2.0 * x[pad - i];
    x[pad + i] -= x[pad - i];
    x[last] += 2.0 * x[last + i];
    x[last - i] -= x[last + i];
  }
  return x.segment(pad, count);
}

void filter_rows(const std::vector<math::SecondOrderSection>& sections, Eigen::Ref<Eigen::MatrixXd> x) {
  std::vector<SignalRow> rows;
  for (Eigen::Index r = 0; r < x.rows(); ++r) rows.push_back({x.data() + r, x.outerStride()});
  filter_rows(sections, rows, x.cols());
}

}  // namespace myoid::identification
