#include "tests/simbody_oracle/simbody_oracle.h"

#include <utility>

#include <SimTKsimbody.h>

namespace simbody_oracle {
namespace {

SimTK::Vec3 vec(const Vector& v) { return {v[0], v[1], v[2]}; }
Vector plain(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }
SimTK::Mat33 mat(const Matrix& m) { return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]}; }

SimTK::Transform transform(const Transform& x) {
  return SimTK::Transform(SimTK::Rotation(mat(x.R), true), vec(x.p));  // true: taken as it is
}

Transform plain(const SimTK::Transform& x) {
  Transform t;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) t.R[static_cast<std::size_t>(3 * i + j)] = x.R()[i][j];
  }
  t.p = plain(SimTK::Vec3(x.p()));
  return t;
}

class CurveFunction : public SimTK::Function {
 public:
  explicit CurveFunction(Curve curve) : curve_(std::move(curve)) {}
  SimTK::Real calcValue(const SimTK::Vector& x) const override { return curve_(x[0], 0); }
  SimTK::Real calcDerivative(const SimTK::Array_<int>& components, const SimTK::Vector& x) const override {
    return curve_(x[0], static_cast<int>(components.size()));
  }
  int getArgumentSize() const override { return 1; }
  int getMaxDerivativeOrder() const override { return 2; }

 private:
  Curve curve_;
};

SimTK::Body::Rigid rigid(const Link& link) {
  const SimTK::Mat33 i = mat(link.I_BBcm_B);
  const SimTK::Inertia central(i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2));
  const SimTK::Vec3 c = vec(link.p_BBcm_B);
  // MassProperties wants the inertia about the body's origin.
  return SimTK::Body::Rigid(SimTK::MassProperties(link.mass_kg, c, central.shiftFromMassCenter(-c, link.mass_kg)));
}

SimTK::MobilizedBody mobilized(SimTK::MobilizedBody& parent, const Link& link) {
  const SimTK::Transform X_PF = transform(link.X_PF);
  const SimTK::Transform X_BM = transform(link.X_BM);
  switch (link.kind) {
    case Kind::weld:
      return SimTK::MobilizedBody::Weld(parent, X_PF, rigid(link), X_BM);
    case Kind::pin:
      return SimTK::MobilizedBody::Pin(parent, X_PF, rigid(link), X_BM);
    case Kind::slider:
      return SimTK::MobilizedBody::Slider(parent, X_PF, rigid(link), X_BM);
    case Kind::custom:
      break;
  }
  SimTK::Array_<const SimTK::Function*> functions;
  SimTK::Array_<SimTK::Array_<int>> coordinates;
  SimTK::Array_<SimTK::Vec3> axes;
  for (const Axis& axis : link.axes) {
    axes.push_back(vec(axis.direction));
    coordinates.push_back(SimTK::Array_<int>());
    if (axis.coordinate < 0) {
      functions.push_back(new SimTK::Function::Constant(axis.curve ? axis.curve(0.0, 0) : 0.0,
                                                        0));  // Simbody owns it
    } else {
      coordinates.back().push_back(axis.coordinate);
      functions.push_back(new CurveFunction(axis.curve));
    }
  }
  return SimTK::MobilizedBody::FunctionBased(parent, X_PF, rigid(link), X_BM, link.coordinate_count, functions,
                                             coordinates, axes);
}

SimTK::Vector vector_of(const std::vector<double>& values) {
  SimTK::Vector v(static_cast<int>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) v[static_cast<int>(i)] = values[i];
  return v;
}

}  // namespace

Answer ask(const System& system,
           const std::vector<double>& q,
           const std::vector<double>& qdot,
           const std::vector<double>& qddot,
           const std::vector<Wrench>& wrenches) {
  SimTK::MultibodySystem multibody;
  SimTK::SimbodyMatterSubsystem matter(multibody);
  SimTK::GeneralForceSubsystem forces(multibody);
  SimTK::Force::Gravity(forces, matter, vec(system.gravity_G));
  std::vector<SimTK::MobilizedBody> bodies;
  for (const Link& link : system.links) {
    SimTK::MobilizedBody& parent = link.parent < 0 ? static_cast<SimTK::MobilizedBody&>(matter.Ground())
                                                   : bodies[static_cast<std::size_t>(link.parent)];
    bodies.push_back(mobilized(parent, link));
  }
  SimTK::State state = multibody.realizeTopology();
  multibody.realizeModel(state);
  state.updQ() = vector_of(q);
  state.updU() = vector_of(qdot);
  multibody.realize(state, SimTK::Stage::Dynamics);

  Answer answer;
  for (const SimTK::MobilizedBody& body : bodies) {
    answer.X_GB.push_back(plain(body.getBodyTransform(state)));
    answer.w_GB.push_back(plain(body.getBodyAngularVelocity(state)));
    answer.v_GB.push_back(plain(body.getBodyOriginVelocity(state)));
  }
  SimTK::Vector_<SimTK::SpatialVec> body_forces = multibody.getRigidBodyForces(state, SimTK::Stage::Dynamics);
  for (const Wrench& wrench : wrenches) {
    const SimTK::MobilizedBodyIndex index = bodies[static_cast<std::size_t>(wrench.link)].getMobilizedBodyIndex();
    body_forces[index] += SimTK::SpatialVec(vec(wrench.m_G), vec(wrench.f_G));
  }
  SimTK::Vector residual;
  matter.calcResidualForceIgnoringConstraints(state, SimTK::Vector(), body_forces, vector_of(qddot), residual);
  SimTK::Matrix mass;
  matter.calcM(state, mass);
  for (int i = 0; i < residual.size(); ++i) {
    answer.tau.push_back(residual[i]);
    answer.mass.emplace_back();
    for (int j = 0; j < residual.size(); ++j) answer.mass.back().push_back(mass(i, j));
  }
  return answer;
}

}  // namespace simbody_oracle
