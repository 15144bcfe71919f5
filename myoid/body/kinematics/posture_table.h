#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/geometry.h"

namespace myoid::body {

/// Postures of a limb with the places of its markers on a base that stands still, made once. One product with the
/// targets of a frame says of all postures how well they fit: a search begins near each of the minima.
class PostureTable {
 public:
  /// The place of a marker in the frame of the limb's base, as a frame shows it.
  struct Target {
    Vec3 place_m = Vec3::Zero();
    double weight = 0.0;  ///< 0: the marker was not seen.
  };

  /// Takes over postures, one a row, and the places of the markers in each (x y z of each marker).
  PostureTable(Eigen::MatrixXd postures, const Eigen::MatrixXd& places_m);

  [[nodiscard]] Eigen::Index size() const { return postures_.rows(); }
  [[nodiscard]] Eigen::VectorXd posture(Eigen::Index row) const { return postures_.row(row).transpose(); }

  /// Returns up to `count` rows, the best first, that fit the targets better than their neighbors do.
  [[nodiscard]] std::vector<Eigen::Index> minima(const std::vector<Target>& targets, std::size_t count) const;

 private:
  Eigen::MatrixXd postures_;
  Eigen::MatrixXd places_m_;  ///< A column per posture.
  Eigen::MatrixXd terms_;     ///< A row per posture: x y z and their sum of squares of each marker.
  double near_m2_ = 0.0;      ///< Neighbors' markers are not farther apart than that, summed over the markers.
};

}  // namespace myoid::body
