#include "myoid/body/simulation/arm_model.h"

#include <utility>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/dynamics/held_mass.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::body {

SimulationModel make_arm_model(const ArmSetup& setup) {
  body::BodyModel body = body::parse_osim(body::arm4_osim({.person = setup.person, .elbow_only = true}), "arm4.osim");
  body = body::with_held_mass(std::move(body), "forearm_hand", body::arm4_held_at_m(setup.person), setup.held_mass_kg);
  if (setup.horizontal) body.gravity_G.setZero();
  SimulationModel model = make_simulation_model(std::move(body), setup.model);
  for (ModelMuscle& m : model.muscles) m.parameters = muscle::published_defaults(m.parameters.hill, m.laws);
  model.joints.front() = muscle::elbow_passive();
  return model;
}

}  // namespace myoid::body
