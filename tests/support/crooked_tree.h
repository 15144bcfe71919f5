#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "myoid/body/model/body_model.h"

namespace myoid::test {

/// Numbers in -1..1, the same on every machine.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : engine_(seed) {}
  double operator()() { return static_cast<double>(engine_() >> 11) * 0x1.0p-52 - 1.0; }
  Vec3 vec() { return {(*this)(), (*this)(), (*this)()}; }

 private:
  std::mt19937_64 engine_;
};

/// Four bodies in a branched tree, every slot of a joint used, oblique axes, curved functions, a
/// coordinate that drives a rotation and two translations. With `shared`, joints' rotations share a
/// coordinate: one and three, two and three, one and two, all three. With `bent`, the second joint
/// is at the end of a rod that bends by up to 1.5 rad, the third on an ellipsoid.
inline body::BodyModel crooked_tree(std::uint64_t seed, bool shared = false, bool bent = false) {
  using namespace body;
  Uniform u(seed);
  BodyModel m;
  m.bodies.push_back({.name = "ground"});
  const int parents[4] = {0, 1, 2, 1};
  for (int b = 1; b <= 4; ++b) {
    Body body{.name = "b" + std::to_string(b), .mass_kg = 1.5 + u(), .p_BBcm_B = 0.2 * u.vec()};
    Mat3 s;
    for (double& x : s.reshaped()) x = u();
    body.I_BBcm_B = 0.01 * (s * s.transpose() + Mat3::Identity());
    m.bodies.push_back(body);
    Joint joint;
    joint.name = "j" + std::to_string(b);
    joint.parent = parents[b - 1];
    joint.child = b;
    joint.X_PF = {rotation_body_xyz(u.vec()), 0.3 * u.vec()};
    joint.X_BM = {rotation_body_xyz(u.vec()), 0.1 * u.vec()};
    for (int k = 0; k < 3; ++k) {
      const int c = static_cast<int>(m.coordinates.size());
      m.coordinates.push_back({.name = "q" + std::to_string(c), .joint = b - 1});
      joint.coordinates.push_back(c);
      joint.rotation[static_cast<std::size_t>(k)] = {
          .axis = u.vec().normalized(),
          .coordinate = c,
          .function = k == 1 ? Function(make_simm_spline({-2, -1, 0, 1, 2}, {u(), u(), u(), u(), u()}))
                             : Function(Linear{1.0 + 0.3 * u(), u()})};
      joint.translation[static_cast<std::size_t>(k)] = {.axis = u.vec().normalized(),
                                                        .coordinate = k == 2 ? c - 1 : c,
                                                        .function = Function(Polynomial{{u(), u(), u()}}, 0.1)};
    }
    if (shared) {
      const int sharing[4][3] = {{0, 1, 0}, {0, 1, 1}, {0, 0, 1}, {0, 0, 0}};
      for (std::size_t k = 0; k < 3; ++k) {
        joint.rotation[k].coordinate = joint.coordinates[static_cast<std::size_t>(sharing[b - 1][k])];
      }
    }
    if (bent && b == 2) {
      joint.rod_length_m = 0.4;
      const Eigen::Index order[3] = {0, 2, 1};
      for (std::size_t k = 0; k < 3; ++k) {
        joint.rotation[k].axis = Vec3::Unit(order[k]);
        joint.rotation[k].function = Linear{1.0, 0.1};
      }
    }
    if (bent && b == 3) joint.ellipsoid_radii_m = Vec3(0.1, 0.2, 0.15);
    m.joints.push_back(joint);
  }
  return finalize(m);
}

inline Eigen::VectorXd random_vector(Eigen::Index n, Uniform& u) {
  Eigen::VectorXd v(n);
  for (double& x : v) x = u();
  return v;
}

}  // namespace myoid::test
