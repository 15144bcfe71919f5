#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "myoid/body/forces/sharing_objective.h"
#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/ground/core/choice.h"
#include "myoid/ground/core/geometry.h"
#include "myoid/ground/core/stretch.h"
#include "myoid/recording/signals/emg_envelope.h"
#include "myoid/study/equal_stretches.h"
#include "myoid/study/phases/phases.h"

namespace myoid::study {

/// The purpose of a trial.
enum class Use { calibration, validation, mvc, static_pose, passive, isometric };
inline constexpr std::string_view kUseNames[] = {"calibration", "validation", "mvc", "static", "passive", "isometric"};
constexpr ChoiceNames choice_names(Use) { return kUseNames; }

enum class Sex { unstated, male, female };
inline constexpr std::string_view kSexNames[] = {"", "male", "female"};
constexpr ChoiceNames choice_names(Sex) { return kSexNames; }

struct SubjectSpec {
  std::string name = "subject";
  std::optional<double> mass_kg;
  Sex sex = Sex::unstated;
  std::vector<std::string> assumptions;  ///< The user's own, printed in the report.
  bool operator==(const SubjectSpec&) const = default;
};

/// A point of a body where the held mass of a trial acts.
struct HeldMassSpec {
  std::string body;
  Vec3 p_BP_m = Vec3::Zero();  ///< In the body's frame [m].
  bool operator==(const HeldMassSpec&) const = default;
};

struct ModelSpec {
  std::optional<std::filesystem::path> file;  ///< .osim
  std::string text;                           ///< Text of the model instead of a file, for a study in memory.
  std::string builtin;                        ///< "arm4" or "none" if there is no file.
  std::optional<double> upper_arm_length_m;   ///< For the built-in arm.
  std::optional<double> forearm_length_m;     ///< For the built-in arm: elbow to wrist.
  bool horizontal = false;                    ///< Plane of movement of the built-in arm.
  bool forearm_rotations = false;             ///< For the built-in arm: free base and forearm rotations.
  std::string coordinate = "elbow_flexion";   ///< The joint whose torque the muscles share.
  std::vector<std::string> more_coordinates;  ///< Further joints that the same muscles cross.
  std::optional<HeldMassSpec> held_mass;
  bool operator==(const ModelSpec&) const = default;

  /// Returns true if there is no body: the trials give lengths, moment arms and torques of the muscles.
  [[nodiscard]] bool is_none() const { return builtin == "none"; }
  /// Returns true for the built-in arm.
  [[nodiscard]] bool is_arm() const { return !file && text.empty() && !is_none(); }
};

/// A load cell in an object that the person holds.
struct LoadCellSpec {
  std::vector<std::string> channels;     ///< Six channels, in the order of the matrix's columns.
  std::filesystem::path calibration;     ///< Six rows of six numbers: N and N m for each volt.
  double sign = 1.0;                     ///< -1: the cell measures the opposite force.
  std::vector<double> zero_s{0.0, 1.0};  ///< Time without load on the cell.
  std::optional<std::filesystem::path>
      instrument;                    ///< Model of the object, posed by its markers; empty: the study's model.
  std::string frame;                 ///< Body of the instrument: the cell's axes and origin.
  std::string body;                  ///< Body of the person that feels the load.
  std::optional<double> lowpass_hz;  ///< Empty: as for the motion.
  bool operator==(const LoadCellSpec&) const = default;
};

enum class Smoothing { automatic, none, cutoff };
inline constexpr std::string_view kSmoothingNames[] = {"auto", "none", "cutoff"};
constexpr ChoiceNames choice_names(Smoothing) { return kSmoothingNames; }

struct MotionSpec {
  Smoothing smoothing = Smoothing::automatic;
  double cutoff_hz = 6.0;  ///< -3 dB of both passes together, if `smoothing` is cutoff.
  double rate_hz = 100.0;  ///< Rate of the analysed samples.
  bool operator==(const MotionSpec&) const = default;
};

struct MarkerSpec {
  std::map<std::string, std::string> rename;  ///< From the file's labels to the model's.
  std::map<std::string, double> weight;       ///< Weights by the model's names; 1 for other markers.
  char up = 'a';                              ///< Vertical axis: 'x', 'y', 'z'; 'a': as each file states.
  bool undo_swaps = true;                     ///< Undoes exchanged labels.
  bool fill_gaps = true;                      ///< Fills gaps by splines and from the segment's other markers.
  bool operator==(const MarkerSpec&) const = default;
};

/// Coordinates that are measured once in a known posture and then held.
struct CalibrationSpec {
  std::vector<double> window_s;  ///< Start and end in the trial.
  /// Coordinates found in the window, with all others at their default.
  std::vector<std::string> free;
  std::vector<std::string> hold;  ///< Coordinates of `free` that are then locked at their median.
  bool operator==(const CalibrationSpec&) const = default;
};

struct IkSpec {
  std::vector<std::string> unlock;  ///< Coordinates that the model locks and this study frees.
  std::vector<std::string> lock;    ///< Coordinates held at their default value.
  std::optional<CalibrationSpec> calibrate;
  bool operator==(const IkSpec&) const = default;
};

enum class EmgKind { raw, envelope, activation };
inline constexpr std::string_view kEmgKindNames[] = {"raw", "envelope", "activation"};
constexpr ChoiceNames choice_names(EmgKind) { return kEmgKindNames; }

struct EmgSpec {
  EmgKind kind = EmgKind::raw;
  std::string unit;  ///< "uV", ...; empty: as the file states.
  recording::EnvelopeOptions chain;
  double normalise_window_s = 0.5;
  /// Share of the muscles' full force that the MVC trials reach, and its standard deviation among
  /// people. With 1 and 0, F_max is the force at the greatest recorded effort.
  double mvc_effort = 1.0, mvc_effort_sd = 0.0;
  bool has_mvc = true;            ///< False: no trial is a maximal contraction (set from the trials).
  std::optional<double> delay_s;  ///< Empty: estimated.
  bool operator==(const EmgSpec&) const = default;
};

struct MuscleSpec {
  std::string name;
  std::vector<std::string> osim;       ///< Muscles of the model that act as this one.
  std::string emg;                     ///< EMG channel; empty with `without_emg`.
  std::optional<std::string> same_as;  ///< For a muscle without an electrode: the muscle whose channel it uses.
  std::optional<fit::WithoutEmg> without_emg = {};  ///< Where no electrode stands for the muscle.
  std::map<std::string, double> start;              ///< Starting values by parameter name, SI.
  std::vector<std::string> fixed;                   ///< Parameters held at their start.
  bool operator==(const MuscleSpec&) const = default;
};

/// The common signal that relates the clocks of EMG and motion.
enum class SyncMatch {
  rising,   ///< Rising edges of a channel.
  falling,  ///< Falling edges.
  shape,    ///< Shape of the whole signal.
};
inline constexpr std::string_view kSyncMatchNames[] = {"rising", "falling", "shape"};
constexpr ChoiceNames choice_names(SyncMatch) { return kSyncMatchNames; }

/// Relation of the clocks of a trial's EMG and loads to the clock of the motion. Applies if the EMG
/// has a file of its own. The electromechanical delay is the
/// parameter `emg_delay` of an EMG channel instead.
struct SyncSpec {
  std::optional<double> offset_s;  ///< Added to the times of the EMG.
  std::optional<double> offset_sd_s;
  double drift_ppm = 0.0;                             ///< Drift of the file's clock, from its time 0 on.
  bool estimate = false;                              ///< The offset is estimated from EMG and motion.
  std::string emg_trigger;                            ///< Channel or event of the EMG's file.
  std::string motion_trigger;                         ///< Channel or event of the motion's file, or "start".
  std::optional<std::filesystem::path> trigger_file;  ///< File on the motion's clock; empty: the motion's own file.
  SyncMatch match = SyncMatch::rising;
  double search_s = 0.6;        ///< Range of the search for "estimate" and "shape", to either side.
  double loads_offset_s = 0.0;  ///< Added to the times of the loads' file.
  double loads_drift_ppm = 0.0;
  bool operator==(const SyncSpec&) const = default;
};

/// Force plates under the person.
struct PlateSpec {
  std::filesystem::path file;        ///< .c3d
  std::vector<std::string> bodies;   ///< Body on each plate; empty: found from the markers.
  double least_force_n = 10.0;       ///< Smaller forces count as no load.
  std::optional<double> lowpass_hz;  ///< Empty: as for the motion.
  bool operator==(const PlateSpec&) const = default;
};

/// Times of a trial that are predicted, but neither fitted nor scored, and from which no EMG reference is taken.
struct ExcludeSpec {
  std::vector<Stretch> windows;  ///< On the clock of the motion.
  bool foreign_contacts =
      false;  ///< Adds the times in which another foot stands on a plate (study/checks/foreign_contacts).
  bool operator==(const ExcludeSpec& other) const {
    return foreign_contacts == other.foreign_contacts && equal_stretches(windows, other.windows);
  }
};

/// Files that hold stages of a trial, in the place of this program's computation.
struct GivenSpec {
  std::optional<std::filesystem::path> lengths;     ///< Musculotendon lengths [m].
  std::optional<std::filesystem::path> velocities;  ///< Rates of `lengths` [m/s].
  std::vector<std::filesystem::path> moment_arms;   ///< -dl/dq [m], in the order of the study's coordinates.
  std::optional<std::filesystem::path> torques;     ///< Torques of the muscles [N m].
  std::optional<std::filesystem::path> forces;      ///< Muscle forces [N].
  bool operator==(const GivenSpec&) const = default;

  /// Returns true if nothing of a fit to torques is left to compute from a body.
  [[nodiscard]] bool tells_torques() const { return lengths && !moment_arms.empty() && torques; }
  /// Returns true if nothing of a fit to torques, or to forces, is.
  [[nodiscard]] bool needs_no_body() const { return tells_torques() || (lengths && forces); }
};

struct TrialSpec {
  std::string name;
  std::optional<std::filesystem::path> markers;
  std::optional<std::filesystem::path> motion;
  std::optional<std::filesystem::path> emg;
  std::optional<std::filesystem::path> external_torque;  ///< <coordinate>_moment of the surroundings [N m].
  std::optional<std::filesystem::path> external_loads;   ///< OpenSim's ExternalLoads (.xml).
  std::optional<std::filesystem::path> load_cell;        ///< File of the load cell's channels.
  std::optional<PlateSpec> plates;
  std::optional<std::filesystem::path> fascicles;  ///< Measured fiber lengths [m], in columns named as the muscles.
  GivenSpec given;
  Use use = Use::calibration;
  std::optional<double> held_mass_kg;  ///< Empty: the study does not say what was held.
  ExcludeSpec exclude;
  std::string condition;                 ///< Trials of one condition are left out together by folds = "condition".
  std::optional<double> start_s, end_s;  ///< On the clock of the motion.
  std::optional<std::filesystem::path> video;  ///< Film of the trial; the report shows it.
  double video_offset_s = 0.0;                 ///< Time of the film's begin, on the clock of the motion.
  std::optional<SyncSpec> sync;
  bool operator==(const TrialSpec&) const = default;

  /// Returns true if the trial has samples of a movement, or of a posture.
  [[nodiscard]] bool moves() const { return markers || motion || given.lengths; }
};

/// Curves of a group of people, drawn behind the person's curves.
struct NormSpec {
  std::string name;                 ///< Name of the group: "adults, N = 24".
  std::filesystem::path file;       ///< Table over percent of the movement.
  std::vector<std::string> trials;  ///< Empty: every movement.
  bool operator==(const NormSpec&) const = default;
};

/// Films that a command line adds to the trials of a study.
struct VideoChoice {
  std::vector<std::string> files;  ///< "TRIAL=FILE", or "FILE" for a study of one movement.
  std::optional<double> offset_s;  ///< Begin of each of `files`, on the motion's clock.
};

struct SharingSpec {
  body::SharingObjective objective = body::SharingObjective::activation;
  double exponent = 2.0;
  double reserve_nm = 1.0;  ///< Optimal force of the reserve on the coordinate.
  bool operator==(const SharingSpec&) const = default;
};

/// The search for fatigue.
struct PhasesSpec {
  bool search = true;
  /// Phases that are not fitted.
  std::vector<PhaseKind> exclude{PhaseKind::fatigued};
  bool operator==(const PhasesSpec&) const = default;
};

/// Pennation and passive force of the muscles in the fit.
enum class MuscleLaw {
  automatic,  ///< `model` with an OpenSim model, else `paper`.
  paper,      ///< Neither.
  model,      ///< As the model's muscles have them.
};
inline constexpr std::string_view kMuscleLawNames[] = {"automatic", "paper", "model"};
constexpr ChoiceNames choice_names(MuscleLaw) { return kMuscleLawNames; }

struct IdentifySpec {
  /// Without the setting of a study in which a muscle has no EMG: `torque` alone.
  std::vector<fit::Method> methods{fit::Method::paper, fit::Method::torque};
  bool leaves_out_paper = false;     ///< `methods` is the default of such a study.
  std::vector<std::string> muscles;  ///< Empty: all.
  int posterior_draws = 0;           ///< Draws by Hamiltonian Monte Carlo; 0: draws from an approximation.
  bool gain = true;                  ///< EMG gain per channel as a nuisance with a tight prior.
  bool cross_validate = true;
  int next_movements = 4;  ///< Movements to suggest for the next recording; 0: none.
  fit::FoldKind folds = fit::FoldKind::trial;
  /// Method `paper`: above 1 adds Sobol points, and the table of basins; empty: 1, and 3 to compare solvers.
  std::optional<int> starts;
  bool compare_solvers = false;  ///< Method `paper`: every solver from the same starts.
  fit::Eccentric eccentric = fit::Eccentric::automatic;
  bool normalised = false;  ///< l_sh and v_max keep their ratio to l0.
  fit::LagChoice lag = fit::LagChoice::automatic;
  bool dynamics = false;  ///< Turns envelope into activation by the lags of equation (1).
  MuscleLaw muscle_law = MuscleLaw::automatic;
  bool elastic_tendon = true;  ///< The model's tendon strain, quasi-static; else rigid.
  bool delay_per_channel = false;
  double angle_sd_deg = 0.0;  ///< Errors of the joint angle and of its rate, propagated.
  double angle_rate_sd_degps = 0.0;
  std::vector<std::string> without_effect;  ///< A sentence for each setting of an earlier version.
  bool operator==(const IdentifySpec&) const = default;
};

/// The settings of a study.toml. Paths are absolute or relative to the working directory,
/// resolved against the file's own folder.
struct Study {
  std::filesystem::path file;
  SubjectSpec subject;
  ModelSpec model;
  MotionSpec motion;
  MarkerSpec markers;
  IkSpec ik;
  EmgSpec emg;
  SharingSpec sharing;
  PhasesSpec phases;
  IdentifySpec identify;
  fit::UnseenSpreads beliefs;
  std::optional<LoadCellSpec> load_cell;
  std::optional<SyncSpec> sync;  ///< For trials without their own.
  std::vector<MuscleSpec> muscles;
  std::vector<TrialSpec> trials;
  std::vector<fit::ParameterRule> parameters;  ///< [[parameter]]
  std::vector<NormSpec> norms;                 ///< [[norm]]
  std::optional<std::filesystem::path> truth;
  bool operator==(const Study&) const = default;

  /// Returns true if the fit takes the trial's torque. The torque of a maximal contraction has to be measured: whatever
  /// holds the limb is part of no model. A dynamometer measures one joint only; at the others straps hold the limb.
  [[nodiscard]] bool fits(const TrialSpec& trial) const {
    const bool measured =
        trial.load_cell || trial.given.torques || (trial.external_torque && model.more_coordinates.empty());
    return trial.use == Use::calibration || trial.use == Use::isometric ||
           (trial.use == Use::mvc && trial.moves() && measured);
  }
};

/// Returns every coordinate whose torque the muscles share, the main one first.
[[nodiscard]] std::vector<std::string> study_coordinates(const ModelSpec& model);

/// Returns the cut-off of the motion's smoothing, -3 dB [Hz]; empty: not smoothed. `automatic`
/// takes the EMG's low-pass, so that torque and prediction have the same band.
[[nodiscard]] std::optional<double> motion_cutoff_hz(const Study& study);

/// Restricts every trial to the time between `start_s` and `end_s` on its own clock. Throws
/// InvalidInput, with the trial's name, if a trial has no such time.
void restrict_trials(Study& study, std::optional<double> start_s, std::optional<double> end_s);

}  // namespace myoid::study
