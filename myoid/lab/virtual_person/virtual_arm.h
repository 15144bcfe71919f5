#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/arm/arm7.h"
#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/geometry.h"
#include "myoid/lab/virtual_person/control.h"
#include "myoid/lab/virtual_person/protocol.h"
#include "myoid/lab/virtual_person/smooth_motion.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::lab {

using HillSet = std::array<muscle::HillParameters<double>, 4>;  ///< In the order of kArmMuscles.

/// Returns the segments of a virtual subject.
[[nodiscard]] body::ArmOptions arm_options(const VirtualSubject& subject);

/// The muscles at one angle and speed of the elbow.
struct MuscleGeometry {
  PerMuscle length_m = {};      ///< Length of muscle and tendon.
  PerMuscle velocity_mps = {};  ///< Rate of this length, positive in lengthening.
  PerMuscle moment_arm_m = {};
};

/// Returns lengths and moment arms of muscles along these paths.
[[nodiscard]] MuscleGeometry geometry_of(const std::array<body::PlanarMuscle, 4>& paths,
                                         const Moment& elbow_flexion_rad);

/// The distance of one marker of a person from the model's marker.
struct MarkerError {
  Vec3 misplaced_m = Vec3::Zero();  ///< In the frame of its body.
  /// Amplitude of the marker's motion on the skin, times sin(q + phase).
  Vec3 soft_tissue_m = Vec3::Zero();
  double phase_rad = 0.0;
};

enum class MarkerSegment { trunk, upper_arm, forearm };

/// The body of the model file that holds the mass in the hand.
inline constexpr std::string_view kHeldBody = "forearm_hand";

/// The skeleton of one virtual subject: the built-in arm with the subject's segments. Muscle
/// parameters are separate, because they are drawn.
struct VirtualArm {
  /// Builds the arm. `seven_heads`: the model file has seven heads instead of four muscles.
  explicit VirtualArm(const VirtualSubject& subject, bool seven_heads = false);

  body::PlanarElbow elbow;
  HillSet literature;
  std::string osim;                  ///< Text of the subject's model file with the literature's muscle parameters.
  body::BodyModel body_model;        ///< Read from this text, so that the markers are those of the file.
  std::vector<body::ArmHead> heads;  ///< Heads of the model file; empty: four muscles.
  Vec3 held_at_m = Vec3::Zero();     ///< Place of the held mass in `kHeldBody`.

  [[nodiscard]] MuscleGeometry geometry(const Moment& elbow_flexion_rad) const {
    return geometry_of(elbow.muscles, elbow_flexion_rad);
  }

  [[nodiscard]] std::vector<std::string> marker_names() const;
  [[nodiscard]] std::vector<MarkerSegment> marker_segments() const;
  /// Returns positions in ground: a row per angle, x y z of one marker after the other [m].
  /// `errors`: empty, or one per marker.
  [[nodiscard]] Eigen::MatrixXd markers_m(const Eigen::Ref<const Eigen::VectorXd>& elbow_flexion_rad,
                                          Plane plane,
                                          const std::vector<MarkerError>& errors = {}) const;

  /// Returns the muscle's path in the model file; for heads, the mean by the literature's F_max.
  [[nodiscard]] body::MuscleTravel modelled_travel(std::size_t muscle, double elbow_flexion_rad) const;
};

}  // namespace myoid::lab
