#include "myoid/study/checks/length_changes.h"

#include <algorithm>
#include <cmath>

#include "myoid/ground/math/decompositions.h"

namespace myoid::study {

ChangeWindows change_windows(const Eigen::VectorXd& time_s) {
  constexpr double kWindow_s = 0.1;
  const Eigen::Index steps = time_s.size() - 1;
  if (steps < 1) return {};
  const double step_s = (time_s[steps] - time_s[0]) / static_cast<double>(steps);
  const auto reach = std::max<Eigen::Index>(1, std::lround(kWindow_s / step_s));
  return {.count = steps / reach, .reach = reach};
}

Eigen::MatrixXd changes(const ChangeWindows& windows, const Eigen::MatrixXd& x) {
  Eigen::MatrixXd result(windows.count, x.cols());
  for (Eigen::Index w = 0; w < windows.count; ++w)
    result.row(w) = x.row(windows.first(w + 1)) - x.row(windows.first(w));
  return result;
}

Eigen::MatrixXd integrals(const ChangeWindows& windows, const Eigen::MatrixXd& f, const Eigen::VectorXd& x) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(windows.count, f.cols());
  for (Eigen::Index w = 0; w < windows.count; ++w) {
    for (Eigen::Index i = windows.first(w); i < windows.first(w + 1); ++i)
      result.row(w) += 0.5 * (x[i + 1] - x[i]) * (f.row(i) + f.row(i + 1));
  }
  return result;
}

bool is_moved(const Eigen::MatrixXd& changes) {
  constexpr Eigen::Index kFewest = 5;
  constexpr double kNoise_m = 5e-4;
  return changes.rows() >= kFewest && changes.norm() >= kNoise_m * std::sqrt(static_cast<double>(changes.size()));
}

double share_by_arms(const ChangeWindows& windows,
                     const Eigen::MatrixXd& changes,
                     const std::vector<const Eigen::MatrixXd*>& arms_m,
                     const AlteredArms& altered) {
  double total = 0.0, left = 0.0;
  std::vector<Eigen::Index> muscles;
  for (Eigen::Index k = 0; k < changes.cols(); ++k) {
    if (k != altered.without) muscles.push_back(k);
  }
  if (muscles.size() <= arms_m.size()) return 0.0;
  Eigen::MatrixXd r(static_cast<Eigen::Index>(muscles.size()), static_cast<Eigen::Index>(arms_m.size()));
  const auto place = std::ranges::find(muscles, altered.turned);
  for (Eigen::Index w = 0; w < changes.rows(); ++w) {
    for (std::size_t j = 0; j < arms_m.size(); ++j)
      r.col(static_cast<Eigen::Index>(j)) = arms_m[j]->row(windows.middle(w))(muscles).transpose();
    if (place != muscles.end()) r.row(place - muscles.begin()) *= -1.0;
    const Eigen::VectorXd dl = changes.row(w)(muscles).transpose();
    total += dl.squaredNorm();
    left += (dl - r * math::nearest_solution(r, dl)).squaredNorm();
  }
  return total > 0.0 ? 1.0 - left / total : 1.0;
}

}  // namespace myoid::study
