#include "tests/simbody_oracle/simbody_oracle.h"

#include <random>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"

#include "tests/support/data_folder.h"

namespace myoid::body {
namespace {

namespace oracle = simbody_oracle;

/// Numbers in -1..1, the same on every machine.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : engine_(seed) {}
  double operator()() { return static_cast<double>(engine_() >> 11) * 0x1.0p-52 - 1.0; }
  Vec3 vec() { return {(*this)(), (*this)(), (*this)()}; }
  Pose pose() { return {rotation_body_xyz(2.0 * vec()), 0.3 * vec()}; }
  Eigen::VectorXd values(std::size_t count) {
    Eigen::VectorXd v(static_cast<Eigen::Index>(count));
    for (double& x : v) x = (*this)();
    return v;
  }

 private:
  std::mt19937_64 engine_;
};

oracle::Vector plain(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
oracle::Matrix plain(const Mat3& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}
oracle::Transform plain(const Pose& x) { return {plain(x.R), plain(x.p)}; }
std::vector<double> plain(const Eigen::VectorXd& v) { return {v.begin(), v.end()}; }

/// The model as Simbody is told of it. Pin, slider and weld joints go to Simbody's own mobilizers,
/// which know nothing of axes and functions; curves are evaluated by the program (their formulas
/// have tests of their own), differentiated by it too.
oracle::System told(const BodyModel& model) {
  oracle::System system{.gravity_G = plain(model.gravity_G), .links = {}};
  std::vector<int> link_of_body(model.bodies.size(), -1);
  for (const Joint& joint : model.joints) {
    const Body& body = model.bodies[static_cast<std::size_t>(joint.child)];
    oracle::Link link;
    link.parent = link_of_body[static_cast<std::size_t>(joint.parent)];
    link.X_PF = plain(joint.X_PF);
    link.X_BM = plain(joint.X_BM);
    link.coordinate_count = static_cast<int>(joint.coordinates.size());
    link.mass_kg = body.mass_kg;
    link.p_BBcm_B = plain(body.p_BBcm_B);
    link.I_BBcm_B = plain(body.I_BBcm_B);
    if (joint.class_name == "PinJoint") {
      link.kind = oracle::Kind::pin;
    } else if (joint.class_name == "SliderJoint") {
      link.kind = oracle::Kind::slider;
    } else if (joint.class_name != "WeldJoint") {
      link.kind = oracle::Kind::custom;
      for (std::size_t k = 0; k < 6; ++k) {
        const TransformAxis& axis = k < 3 ? joint.rotation[k] : joint.translation[k - 3];
        const int local = axis.coordinate < 0 ? -1 : axis.coordinate - joint.coordinates.front();
        link.axes[k] = {plain(axis.axis), local, [function = axis.function](double x, int order) {
                          const FunctionValue v = evaluate(function, x);
                          return order == 0 ? v.value : order == 1 ? v.first : v.second;
                        }};
      }
    }
    link_of_body[static_cast<std::size_t>(joint.child)] = static_cast<int>(system.links.size());
    system.links.push_back(std::move(link));
  }
  return system;
}

Mat3 inertia_of_four_points(Uniform& u, double mass_kg) {
  // Points of mass: always a possible inertia (Simbody refuses others).
  Mat3 inertia = 1e-4 * Mat3::Identity();
  for (int i = 0; i < 4; ++i) {
    const Vec3 r = 0.2 * u.vec();
    inertia += 0.25 * mass_kg * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  }
  return inertia;
}

/// Eight bodies in a branched tree of pin, slider, weld and custom joints with oblique axes, curved
/// functions and coordinates that turn and shift at once. Rotations never share a coordinate and
/// constant ones never stand before moving ones: there Simbody 3.7's accelerations are not the
/// derivative of its velocities (Lagrange's equations in kinematic_tree.test.cpp cover it).
BodyModel random_tree(std::uint64_t seed) {
  Uniform u(seed);
  BodyModel m;
  m.gravity_G = Vec3(1.0, -9.5, 2.0);
  m.bodies.push_back({.name = "ground"});
  const std::array<int, 8> parents{0, 1, 2, 1, 4, 5, 5, 3};
  const std::array<const char*, 8> kinds{"CustomJoint", "PinJoint",    "CustomJoint", "SliderJoint",
                                         "CustomJoint", "CustomJoint", "WeldJoint",   "PinJoint"};
  for (std::size_t b = 0; b < parents.size(); ++b) {
    const double mass_kg = 1.5 + u();
    m.bodies.push_back({.name = "b" + std::to_string(b + 1),
                        .mass_kg = mass_kg,
                        .p_BBcm_B = 0.2 * u.vec(),
                        .I_BBcm_B = inertia_of_four_points(u, mass_kg)});
    Joint joint{.name = "j" + std::to_string(b + 1),
                .class_name = kinds[b],
                .parent = parents[b],
                .X_PF = u.pose(),
                .child = static_cast<int>(b) + 1,
                .X_BM = u.pose()};
    for (std::size_t k = 0; k < 3; ++k) {
      joint.rotation[k].axis = joint.translation[k].axis = Vec3::Unit(static_cast<Eigen::Index>(k));
    }
    const auto add_coordinate = [&] {
      const int c = static_cast<int>(m.coordinates.size());
      m.coordinates.push_back({.name = "q" + std::to_string(c), .joint = static_cast<int>(b)});
      joint.coordinates.push_back(c);
      return c;
    };
    if (joint.class_name == "PinJoint") {
      joint.rotation[0] = {.axis = Vec3::UnitZ(), .coordinate = add_coordinate(), .function = Linear{1.0, 0.0}};
    } else if (joint.class_name == "SliderJoint") {
      joint.translation[0] = {.axis = Vec3::UnitX(), .coordinate = add_coordinate(), .function = Linear{1.0, 0.0}};
    } else if (joint.class_name == "CustomJoint") {
      const int a = add_coordinate();
      const int c = add_coordinate();
      const auto spline = [&] { return make_simm_spline({-2, -1, 0, 1, 2}, {u(), u(), u(), u(), u()}); };
      joint.rotation[0] = {.axis = u.vec().normalized(), .coordinate = a, .function = Linear{1.0 + 0.3 * u(), u()}};
      joint.rotation[1] = {.axis = u.vec().normalized(), .coordinate = c, .function = Function(spline(), 0.7)};
      joint.rotation[2] = {.axis = u.vec().normalized(),
                           .coordinate = add_coordinate(),
                           .function = Function(Polynomial{{u(), u(), u()}}, 0.4)};
      joint.translation[0] = {.axis = u.vec().normalized(), .coordinate = c, .function = Function(spline(), 0.2)};
      joint.translation[1] = {
          .axis = u.vec().normalized(), .coordinate = a, .function = Function(Polynomial{{u(), u(), u()}}, 0.2)};
      joint.translation[2] = {.axis = u.vec().normalized(), .function = Constant{0.1 * u()}};
    }
    m.joints.push_back(joint);
  }
  return finalize(m);
}

/// Poses, velocities, mass matrix and generalized forces against Simbody at one random state.
void expect_agreement(const BodyModel& m, Uniform& u) {
  const Eigen::VectorXd q = u.values(m.coordinates.size());
  const Eigen::VectorXd qdot = 3.0 * u.values(m.coordinates.size());
  const Eigen::VectorXd qddot = 10.0 * u.values(m.coordinates.size());
  // Simbody numbers coordinates joint by joint, in the order of the joints in the tree; the model
  // in the order of its file.
  std::vector<int> simbody_order;
  for (const Joint& joint : m.joints) {
    simbody_order.insert(simbody_order.end(), joint.coordinates.begin(), joint.coordinates.end());
  }
  ASSERT_EQ(simbody_order.size(), m.coordinates.size());
  const auto told_values = [&](const Eigen::VectorXd& v) { return plain(Eigen::VectorXd(v(simbody_order))); };
  const int tip = static_cast<int>(m.joints.size()) - 1;
  const Vec3 f_G = 20.0 * u.vec();
  const Vec3 m_G = 5.0 * u.vec();
  const oracle::Answer simbody = oracle::ask(told(m), told_values(q), told_values(qdot), told_values(qddot),
                                             {{.link = tip, .f_G = plain(f_G), .m_G = plain(m_G)}});
  BodyState state = make_state(m);
  const Eigen::MatrixXd mass = mass_matrix(m, q, state);
  const Eigen::VectorXd tau =
      inverse_dynamics(m, q, qdot, qddot, {{.body = m.joints.back().child, .f_G = f_G, .m_G = m_G}}, state);

  // Two orders of summation over a dozen products of numbers of this size: some hundred roundings.
  for (std::size_t j = 0; j < m.joints.size(); ++j) {
    const auto b = static_cast<std::size_t>(m.joints[j].child);
    SCOPED_TRACE(m.bodies[b].name);
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> R(simbody.X_GB[j].R.data());
    EXPECT_LT((state.X_GB[b].R - R).norm(), 1e-13);
    EXPECT_LT((state.X_GB[b].p - Eigen::Map<const Vec3>(simbody.X_GB[j].p.data())).norm(), 1e-13);
    EXPECT_LT((state.w_GB[b] - Eigen::Map<const Vec3>(simbody.w_GB[j].data())).norm(), 1e-12);
    EXPECT_LT((state.v_GB[b] - Eigen::Map<const Vec3>(simbody.v_GB[j].data())).norm(), 1e-12);
  }
  ASSERT_EQ(simbody.tau.size(), static_cast<std::size_t>(tau.size()));
  Eigen::VectorXd expected(tau.size());
  expected(simbody_order) = Eigen::Map<const Eigen::VectorXd>(simbody.tau.data(), tau.size());
  EXPECT_LT((tau - expected).norm(), 1e-12 * (1.0 + expected.norm())) << tau.transpose() << "\n"
                                                                      << expected.transpose();
  for (Eigen::Index i = 0; i < tau.size(); ++i) {
    for (Eigen::Index k = 0; k < tau.size(); ++k) {
      EXPECT_NEAR(mass(simbody_order[static_cast<std::size_t>(i)], simbody_order[static_cast<std::size_t>(k)]),
                  simbody.mass[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)], 1e-12 * mass.norm());
    }
  }
}

TEST(Simbody, PosesVelocitiesMassesAndForcesOfRandomTreesAgree) {
  Uniform u(100);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    expect_agreement(random_tree(seed), u);
  }
}

TEST(Simbody, AgreesOnAnArmAsItsFileDescribesIt) {
  const std::filesystem::path file = test::data_folder() / "opensim/arm26/model.osim";
  MYOID_REQUIRE_DATA(file);
  const BodyModel m = read_osim(file);
  Uniform u(200);
  for (int i = 0; i < 10; ++i) expect_agreement(m, u);
}

}  // namespace
}  // namespace myoid::body
