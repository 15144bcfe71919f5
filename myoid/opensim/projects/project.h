#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/ground/core/choice.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/stretch.h"

namespace myoid::opensim {

/// The programs whose projects are read.
enum class Dialect { ceinms, ceinms_rt, nmsm, mrs };
inline constexpr std::string_view kDialectNames[] = {"CEINMS", "CEINMS-RT", "NMSM", "muscle redundancy solver"};
constexpr ChoiceNames choice_names(Dialect) { return kDialectNames; }

/// The numbers of a muscle that these programs calibrate, in SI.
enum class MuscleQuantity {
  c1,  ///< First recursion coefficient of the activation, as is `c2`; they hold for the rate of the samples.
  c2,
  shape_factor,              ///< A of (exp(A u) - 1) / (exp(A) - 1).
  activation_scale,          ///< Factor of the activation.
  optimal_fiber_length,      ///< [m]
  pennation_angle,           ///< At optimal fiber length [rad].
  tendon_slack_length,       ///< [m]
  max_contraction_velocity,  ///< [optimal fiber lengths / s]
  max_isometric_force,       ///< [N]
  strength_coefficient,      ///< Factor of the maximal isometric force.
  delay,                     ///< From EMG to force [s].
  activation_time,           ///< Time constant of the activation [s].
  activation_nonlinearity,
  emg_scale,         ///< Factor of the EMG.
  tendon_stiffness,  ///< Factor of the tendon's stiffness.
};
inline constexpr std::string_view kMuscleQuantityNames[] = {
    "c1",
    "c2",
    "shape_factor",
    "activation_scale",
    "optimal_fiber_length_m",
    "pennation_angle_rad",
    "tendon_slack_length_m",
    "max_contraction_velocity",
    "max_isometric_force_n",
    "strength_coefficient",
    "delay_s",
    "activation_time_s",
    "activation_nonlinearity",
    "emg_scale",
    "tendon_stiffness",
};
constexpr ChoiceNames choice_names(MuscleQuantity) { return kMuscleQuantityNames; }

/// The least and the greatest value that a calibration allows.
struct CalibrationBounds {
  double lower = 0.0, upper = 0.0;
};

/// One number of one muscle.
struct ProjectNumber {
  double value = 0.0;
  std::optional<double> start = {};         ///< The value from which the calibration started, if it is known.
  std::optional<std::size_t> unknown = {};  ///< Of a calibrated number; muscles that share an unknown have one index.
  std::optional<CalibrationBounds> bounds = {};  ///< Of a calibrated number, as far as they are known.

  /// Returns true within 1 % of the range from a bound.
  [[nodiscard]] bool is_on_bound() const;
};

/// A share of a muscle's excitation.
struct ProjectInput {
  std::string channel = {};
  double weight = 1.0;
};

struct ProjectMuscle {
  std::string name = {};
  std::map<MuscleQuantity, ProjectNumber> numbers = {};
  std::vector<ProjectInput> inputs = {};  ///< Empty: the muscle has no EMG.
};

/// A curve of all muscles as a table of points, normalised as the program has it.
struct ProjectCurve {
  std::string name = {};
  std::vector<double> x = {}, y = {};
};

/// A degree of freedom with the muscles that act on it.
struct ProjectDof {
  std::string name = {};
  std::vector<std::string> muscles = {};
  bool is_calibrated = false;  ///< Its torque was fitted.
};

/// The quantity that a file of a trial holds.
enum class TrialRole { emg, lengths, moment_arms, torques, motion, loads, velocities, ultrasound };
inline constexpr std::string_view kTrialRoleNames[] = {"emg",    "lengths", "moment_arms", "torques",
                                                       "motion", "loads",   "velocities",  "ultrasound"};
constexpr ChoiceNames choice_names(TrialRole) { return kTrialRoleNames; }

struct TrialFile {
  TrialRole role = TrialRole::emg;
  std::filesystem::path path = {};  ///< Its place; its expected place, if there is no such file.
  bool exists = false;
  std::string dof = {};                    ///< Of moment arms.
  std::optional<Stretch> time = {};        ///< Of a table that was read.
  double rate_hz = 0.0;                    ///< Mean rate; 0: not known.
  std::optional<bool> is_in_degrees = {};  ///< Of a motion that was read; false: radians.
  std::vector<std::string> channels = {};  ///< Of EMG that was read, in the order of its columns.
};

struct ProjectTrial {
  std::string name = {};
  bool is_calibrating = false;
  std::optional<Stretch> used =
      {};  ///< The stretch that the calibration takes; in CEINMS-RT counted from the first sample.
  std::vector<TrialFile> files = {};
};

/// Weights of the errors that a hybrid run of CEINMS weighs against each other.
struct HybridWeights {
  double torque = 0.0;          ///< alpha
  double excitation_sum = 0.0;  ///< beta: squared excitations.
  double emg = 0.0;             ///< gamma: change of the measured excitations.
  bool operator==(const HybridWeights&) const = default;
};

/// Numbers that all muscles of a subject share.
struct CommonNumbers {
  std::optional<double> delay_s = {};            ///< From EMG to force.
  std::optional<double> damping = {};            ///< Force over F_max at the maximal speed.
  std::optional<double> percentage_change = {};  ///< Of the optimal length from full to no activation.
  bool operator==(const CommonNumbers&) const = default;
};

/// A calibration of another program as values, in SI.
struct Project {
  Dialect dialect = Dialect::ceinms;
  std::string version = {};            ///< "0.9", "0.21"; empty if nothing tells it.
  std::filesystem::path set_up = {};   ///< The file that names the others; empty if there is none.
  std::filesystem::path subject = {};  ///< The subject whose numbers are `value`.
  std::filesystem::path start = {};    ///< The subject whose numbers are `start`; empty if there is none.
  std::filesystem::path model = {};    ///< The OpenSim model; empty if none is named or found.
  bool is_calibrated = false;
  std::string tendon = {}, activation = {}, objective = {};  ///< As the program names them.
  std::optional<HybridWeights> hybrid = {};                  ///< Of the first hybrid run.
  std::vector<std::string> synthesized = {};                 ///< Muscles whose excitation a hybrid run makes up.
  CommonNumbers common = {};
  std::vector<ProjectCurve> curves = {};
  std::vector<ProjectMuscle> muscles = {};
  std::vector<ProjectDof> dofs = {};
  std::vector<ProjectTrial> trials = {};
  bool has_mapping = false;  ///< A file tells which channel drives which muscle.
  std::vector<Remark> remarks = {};

  [[nodiscard]] ProjectMuscle* find(std::string_view name);
  [[nodiscard]] const ProjectMuscle* find(std::string_view name) const;
};

/// Numbers of unknowns of a calibration; an unknown that several muscles share counts once.
struct UnknownCount {
  std::size_t all = 0, on_bound = 0;
};

/// Counts the unknowns of one quantity.
[[nodiscard]] UnknownCount unknowns(const Project& project, MuscleQuantity quantity);

/// Returns the names of the muscles without EMG; empty if no file tells the channels.
[[nodiscard]] std::vector<std::string> muscles_without_emg(const Project& project);

/// Returns the knees of which no muscle of the quadriceps, by its name, has EMG; empty if no file tells the channels
/// or the muscles of the joints.
[[nodiscard]] std::vector<std::string> knees_without_extensor(const Project& project);

}  // namespace myoid::opensim
