#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/body/simulation/simulation.h"
#include "myoid/muscle/joint_passive.h"
#include "myoid/muscle/musculotendon.h"

namespace myoid::body {

/// Force curves of the muscles of a model file.
enum class MuscleCurves {
  file,  ///< The curves of the muscle's class in the file: Thelen's, Millard's, De Groote's.
  paper,
  thelen,
  de_groote,
  millard,
};
inline constexpr std::string_view kMuscleCurvesNames[] = {"file", "paper", "thelen", "de_groote", "millard"};
constexpr ChoiceNames choice_names(MuscleCurves) { return kMuscleCurvesNames; }

struct ModelSetup {
  muscle::TendonMode mode = muscle::TendonMode::equilibrium;
  MuscleCurves curves = MuscleCurves::file;
  muscle::ActivationLaw activation = muscle::ActivationLaw::thelen;
  double excitation_time_s = 0.040;  ///< tau_ne, which model files do not have.
  /// A coordinate with a clamped range gets exponential stops of 1 N m (1 N) at the range's ends
  /// that grow e-fold every 3 degrees (3 mm).
  bool stops = true;
  double joint_viscosity = 0.0;  ///< Viscosity of every coordinate [N m s/rad | N s/m].
};

struct ModelMuscle {
  std::string name;
  int index = 0;  ///< Index among the model's muscles.
  muscle::MusculotendonParameters<double> parameters;
  muscle::MusculotendonLaws laws;
  muscle::ActivationDynamics<double> activation;
};

/// A model of bodies, joints and paths with the laws of its muscles and joints, ready for
/// simulation. Muscles that apply no force are left out.
struct SimulationModel {
  body::BodyModel body;
  std::vector<ModelMuscle> muscles;
  std::vector<muscle::JointPassive<double>> joints;  ///< One per coordinate.
  std::vector<muscle::MillardShape> millard;         ///< One per muscle.
  std::size_t idle_actuators = 0;                    ///< Number of the model's actuators, which exert nothing.
};

/// Takes the parameters from the model. All muscles: F_max, l0, l_t0, pennation, v_max, time constants. Thelen's
/// muscles: also shapes and strains, without damping, as in OpenSim. Millard's and De Groote's: the curves' parameters
/// and damping, and with MuscleCurves::file the statements on a rigid tendon (in the mode `equilibrium`) and on missing
/// activation dynamics. A spring on a coordinate joins the joint's passive torque; the model's other passive forces act
/// too, with their work counted as viscous. Actuators exert nothing; `idle_actuators` counts them. Throws InvalidInput,
/// naming the muscle, if its parameters are impossible, ModelError if joints form a closed loop or a coupled coordinate
/// is prescribed.
[[nodiscard]] SimulationModel make_simulation_model(body::BodyModel body, const ModelSetup& setup = {});

/// Returns the model's default posture and speeds, and devices that hold locked coordinates and move prescribed ones,
/// with their posture at the start. If a locked coordinate follows another by a coupler, the other one is held.
[[nodiscard]] SimulationStart default_start(const SimulationModel& model, double time_s = 0.0);
[[nodiscard]] std::vector<Device> default_devices(const SimulationModel& model);

}  // namespace myoid::body
