#pragma once

#include <vector>

#include <Eigen/Core>

namespace myoid::study {

/// Consecutive windows of 0.1 s of a trial; neighbors share a row.
struct ChangeWindows {
  Eigen::Index count = 0, reach = 1;  ///< Number of windows, and rows from the begin of one to that of the next.

  [[nodiscard]] Eigen::Index first(Eigen::Index window) const { return window * reach; }
  [[nodiscard]] Eigen::Index middle(Eigen::Index window) const { return first(window) + reach / 2; }
};
[[nodiscard]] ChangeWindows change_windows(const Eigen::VectorXd& time_s);

/// Returns the change of each column of `x` over each window, in rows.
[[nodiscard]] Eigen::MatrixXd changes(const ChangeWindows& windows, const Eigen::MatrixXd& x);

/// Returns the integral of each column of `f` over `x` within each window, by the trapezoidal rule.
[[nodiscard]] Eigen::MatrixXd integrals(const ChangeWindows& windows,
                                        const Eigen::MatrixXd& f,
                                        const Eigen::VectorXd& x);

/// Returns true if there are at least five windows and the changes [m] are above noise, 0.5 mm in their root mean
/// square.
[[nodiscard]] bool is_moved(const Eigen::MatrixXd& changes);

/// A muscle that takes no part, and one whose moment arms get the other sign; -1: none.
struct AlteredArms {
  Eigen::Index without = -1, turned = -1;
};

/// Returns the share of the muscles' changes of length that dl = -r dq explains with the best dq of each window; 0 with
/// no more muscles than joints. `arms_m` has the moment arms of each joint.
[[nodiscard]] double share_by_arms(const ChangeWindows& windows,
                                   const Eigen::MatrixXd& changes,
                                   const std::vector<const Eigen::MatrixXd*>& arms_m,
                                   const AlteredArms& altered = {});

}  // namespace myoid::study
