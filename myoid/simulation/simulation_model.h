#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/model/body_model.h"
#include "myoid/muscle/joint_passive.h"
#include "myoid/muscle/musculotendon.h"
#include "myoid/simulation/simulation.h"

namespace myoid::simulation {

/// Which curves the muscles of a model file follow.
enum class MuscleCurves {
  file,  ///< Those of the muscle's class in the file: Thelen's, Millard's, De Groote's.
  paper,
  thelen,
  de_groote,
  millard,
};

struct ModelSetup {
  muscle::TendonMode mode = muscle::TendonMode::equilibrium;
  MuscleCurves curves = MuscleCurves::file;
  muscle::ActivationLaw activation = muscle::ActivationLaw::thelen;
  double excitation_time_s = 0.040;  ///< tau_ne, which no file has.
  /// A coordinate whose range is clamped gets exponential stops of 1 N m (1 N) at the range's ends
  /// that grow e-fold every 3 degrees (3 mm).
  bool stops = true;
  double joint_viscosity = 0.0;  ///< Of every coordinate [N m s/rad | N s/m].
};

struct ModelMuscle {
  std::string name;
  int index = 0;  ///< In the model's muscles.
  muscle::MusculotendonParameters<double> parameters;
  muscle::MusculotendonLaws laws;
  muscle::ActivationDynamics<double> activation;
};

/// A model of bodies, joints and paths with the laws of its muscles and joints: what can be
/// simulated. Muscles that apply no force are left out.
struct SimulationModel {
  model::BodyModel body;
  std::vector<ModelMuscle> muscles;
  std::vector<muscle::JointPassive<double>> joints;  ///< Per coordinate.
  std::vector<muscle::MillardShape> millard;         ///< Per muscle.
  std::size_t idle_actuators = 0;  ///< Actuators of the model; they exert nothing.
};

/// Parameters from the model: F_max, l0, l_t0, pennation, v_max, time constants; of Thelen's muscle
/// also his shapes and strains, with no damping, as OpenSim has it; of Millard's and De Groote's
/// the curves' numbers and damping, and with MuscleCurves::file what it says of a rigid tendon (in
/// the mode `equilibrium`) and of no activation dynamics. A spring on a coordinate joins the
/// joint's passive torque; the model's other passive forces act too, their work being counted as
/// viscous. Actuators exert nothing; `idle_actuators` counts them. Throws InvalidInput, naming the
/// muscle, if its numbers make no unit, ModelError if joints form a closed loop or a coupled
/// coordinate is prescribed.
[[nodiscard]] SimulationModel make_simulation_model(model::BodyModel body,
                                                    const ModelSetup& setup = {});

/// Its default posture and speeds; devices that lock what the model locks and prescribe what it
/// prescribes, with that posture at the start. What follows a locked coordinate's coupler is held
/// by holding the coordinate that it follows.
[[nodiscard]] SimulationStart default_start(const SimulationModel& model, double time_s = 0.0);
[[nodiscard]] std::vector<Device> default_devices(const SimulationModel& model);

/// Integrates the model's equations of motion, M(q) qddot = R F_t + gravity - Coriolis + joints +
/// external. As `simulate` for the arm, with all coordinates of the model in its order; dependent
/// coordinates of couplers start where these say. Throws InvalidInput if a device is to move one of
/// them, ModelError if the mass matrix of the free coordinates is not positive: a body without
/// mass.
[[nodiscard]] Simulation simulate(const SimulationModel& model,
                                  const SimulationInput& input,
                                  const SimulationStart& start,
                                  const SimulationOptions& options);

}  // namespace myoid::simulation
