#pragma once

#include <array>
#include <optional>

#include "myoid/body/arm/planar_elbow.h"
#include "myoid/ground/math/random.h"
#include "myoid/lab/virtual_person/protocol.h"
#include "myoid/lab/virtual_person/virtual_arm.h"
#include "myoid/muscle/normalized_curves.h"

namespace myoid::lab {

/// Bodily properties of a person at L0 or L1 that differ from the fitted model.
struct Departures {
  /// The true moment arm is scale (r(q) + slope r(q0) (q - q0)), with the model's r and q0 the
  /// angle at which the muscle is optimal. The true length has r = -dl/dq and is the model's at q0.
  PerMuscle moment_arm_scale = {1.0, 1.0, 1.0, 1.0};
  PerMuscle moment_arm_slope_per_rad = {};
  PerMuscle tendon_strain = {};  ///< Strain of De Groote's tendon at F_max; 0: rigid.
  muscle::MusculotendonLaws laws = muscle::paper_laws(muscle::TendonMode::rigid);

  [[nodiscard]] bool paper_curves() const { return laws.length == muscle::LengthLaw::gaussian; }
  [[nodiscard]] bool elastic() const { return tendon_strain != PerMuscle{}; }
  /// Returns true if the curves have this parameter; published curves have F_max, l_0, v_max and l_ts.
  [[nodiscard]] bool has(const muscle::HillField& parameter) const;
};

/// Returns a normal number within 2.5 standard deviations: people with half a moment arm are rare.
[[nodiscard]] double bounded_normal(math::Random& random);

/// Draws scales and slopes, normal within 2.5 standard deviations, and tendon strains, uniform.
[[nodiscard]] Departures draw_departures(const TruthSpec& spec, math::Random random);

/// Multiplies the moment arm by `factor`, and the change of length, too.
void scale_moment_arm(body::PlanarMuscle& path, double factor);

/// Adds slope r(q0) (q - q0) to the moment arm; the length at q0 stays.
void taper_moment_arm(body::PlanarMuscle& path, double slope_per_rad, double q0_rad);

/// The muscles of a person at L0 or L1.
class DepartedMuscles {
 public:
  DepartedMuscles(const Departures& departures, const VirtualArm& modelled, const HillSet& muscles);

  [[nodiscard]] MuscleGeometry geometry(const Moment& elbow_flexion_rad) const;

  /// Returns l_mt minus the tendon's length under this tension [N].
  [[nodiscard]] double fiber_length_m(std::size_t muscle, double path_m, double tension_n) const;

  /// Returns the force at full activation [N] of muscles with optimal lengths longer by these
  /// factors, under these tensions. The fibers' speed is the path's, without the rate of the
  /// tendon's stretch, as in the identification's elastic tendon.
  [[nodiscard]] PerMuscle full_force_n(const MuscleGeometry& geometry,
                                       const PerMuscle& longer,
                                       const PerMuscle& tension_n) const;

 private:
  Departures departures_;
  const HillSet* muscles_;
  std::array<body::PlanarMuscle, 4> paths_;
  std::optional<muscle::NormalizedCurves<double>> curves_;  ///< Empty: the paper's curves.
};

}  // namespace myoid::lab
