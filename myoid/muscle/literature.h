#pragma once

#include <array>
#include <string_view>

#include "myoid/muscle/hill_parameters.h"

namespace myoid::muscle {

/// A muscle of the elbow in the literature, its heads lumped into one.
struct LiteratureMuscle {
  std::string_view name;
  double max_isometric_force_n = 0.0;
  double optimal_fiber_length_m = 0.0;
  double tendon_slack_length_m = 0.0;  ///< In the geometry of its source: match it to yours.
  double pennation_rad = 0.0;
};

/// BIC (long and short head), BRA, BRD, TRI (three heads): Holzbaur, Murray & Delp (2005), Ann
/// Biomed Eng 33:829-840, as OpenSim's models carry it. F_max are sums, lengths weighted by F_max.
inline constexpr std::array<LiteratureMuscle, 4> kElbowMuscles = {{{"BIC", 1059.86, 0.1224, 0.2394, 0.0},
                                                                   {"BRA", 987.26, 0.0858, 0.0535, 0.0},
                                                                   {"BRD", 261.33, 0.1726, 0.1330, 0.0},
                                                                   {"TRI", 2047.12, 0.1217, 0.1134, 0.1775}}};

/// The values for a muscle without better data.
inline constexpr double kLiteratureWidth = 0.45;  ///< l_sh / l0
inline constexpr double kSoestWidth = 0.56;       ///< Half width of the parabola over l0 (van Soest & Bobbert 1993).
inline constexpr double kLiteratureCurvature = 0.28;  ///< V_sh
inline constexpr double kLiteraturePlateau = 1.4;     ///< V_ml
inline constexpr double kLiteratureSlopeRatio = 1.5;  ///< S: slopes of f_v at rest, eccentric over concentric
inline constexpr double kLiteratureSpeed = 10.0;      ///< v_max / l0 [1/s]

/// The range of l_sh / l0 in muscles. A sarcomere makes half of its greatest force between about
/// 0.65 and 1.3 of its optimal length (Gordon, Huxley and Julian 1966), a Gaussian of 0.35 to
/// 0.4. Fibers of unequal length only widen their sum, so no muscle has half of this width. Models
/// in use go up to 0.71 (Thelen's gamma of 0.5).
inline constexpr Range kRelativeWidths{0.2, 1.0};

/// Returns the numbers above for one muscle: l_sh = 0.45 l0, V_sh = 0.28, V_ml = 1.4, S = 1.5, v_max = 10 l0/s.
[[nodiscard]] HillParameters<double> literature_parameters(const LiteratureMuscle& muscle);

/// Returns the muscle of this name (BIC, BRA, BRD, TRI); throws InvalidInput with these names.
[[nodiscard]] const LiteratureMuscle& literature_muscle(std::string_view name);

/// Initial values in the source paper's tables I and II, which omit F_max and v_max. The paper's
/// widths are far below the literature's: do not take them for normalized ones.
struct PaperMuscle {
  std::string_view name;
  double optimal_fiber_length_m = 0.0;
  double force_length_width_m = 0.0;
};
inline constexpr std::array<PaperMuscle, 3> kPaperMuscles = {
    {{"TRI", 0.216, 0.018}, {"BRD", 0.212, 0.035}, {"BRA", 0.142, 0.035}}};
inline constexpr double kPaperCurvature = 0.3;          ///< V_sh
inline constexpr double kPaperCurvatureProduct = 0.12;  ///< V_sh V_shl
inline constexpr double kPaperPlateau = 1.3;            ///< V_ml

}  // namespace myoid::muscle
