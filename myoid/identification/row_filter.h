#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/math/butterworth.h"

namespace myoid::identification {

/// One signal in memory: sample i is at `data[i * stride]`.
struct SignalRow {
  double* data = nullptr;
  Eigen::Index stride = 1;
};

/// Filters `rows` of `count` samples each in place, forwards and backwards (no delay), as
/// math::zero_phase does. The reflected ends differ: they last until the filter's slowest mode has
/// decayed to 1e-4. Eight rows pass the recursion at once.
void filter_rows(const std::vector<math::SecondOrderSection>& sections,
                 const std::vector<SignalRow>& rows,
                 Eigen::Index count);

/// Applies the transpose of filter_rows: <filter_rows(x), y> = <x, transposed(y)> for every signal
/// x. It turns a gradient by the filtered signal into one by the signal itself.
[[nodiscard]] Eigen::VectorXd transposed_filter(const std::vector<math::SecondOrderSection>& sections,
                                                const Eigen::VectorXd& y);

/// Filters the rows of a matrix.
void filter_rows(const std::vector<math::SecondOrderSection>& sections, Eigen::Ref<Eigen::MatrixXd> x);

}  // namespace myoid::identification
