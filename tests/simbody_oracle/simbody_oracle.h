#pragma once

#include <array>
#include <functional>
#include <vector>

/// Multibody systems as plain numbers, posed and differentiated by Simbody. No type of Simbody's or
/// of the program's appears here: the two sides are compiled for different standards.
namespace simbody_oracle {

using Vector = std::array<double, 3>;
using Matrix = std::array<double, 9>;  ///< Row by row.

struct Transform {
  Matrix R{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vector p{};
};

/// The value (order 0) or a derivative (1, 2) at x.
using Curve = std::function<double(double x, int order)>;

struct Axis {
  Vector direction{};
  int coordinate = -1;  ///< Within the joint; -1: does not move.
  Curve curve;
};

enum class Kind { weld, pin, slider, custom };

/// A body on its joint: X_PB = X_PF X_FM(q) X_BM^-1.
struct Link {
  int parent = -1;  ///< Index of a link before it; -1: ground.
  Kind kind = Kind::weld;
  Transform X_PF;
  Transform X_BM;
  int coordinate_count = 0;
  std::array<Axis, 6> axes;  ///< Of a custom joint: three rotations, three translations.
  double mass_kg = 0.0;
  Vector p_BBcm_B{};
  Matrix I_BBcm_B{};
};

/// Force and moment at the origin of a link's body, expressed in ground.
struct Wrench {
  int link = 0;
  Vector f_G{};
  Vector m_G{};
};

struct System {
  Vector gravity_G{};
  std::vector<Link> links;
};

struct Answer {
  std::vector<Transform> X_GB;            ///< Per link.
  std::vector<Vector> w_GB, v_GB;         ///< Per link.
  std::vector<double> tau;                ///< Generalized forces for qddot at (q, qdot).
  std::vector<std::vector<double>> mass;  ///< Mass matrix.
};

/// Coordinates are numbered link by link. Throws what Simbody throws.
Answer ask(const System& system,
           const std::vector<double>& q,
           const std::vector<double>& qdot,
           const std::vector<double>& qddot,
           const std::vector<Wrench>& wrenches);

}  // namespace simbody_oracle
