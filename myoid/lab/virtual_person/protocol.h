#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/ground/core/choice.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::lab {

using muscle::Range;  ///< The numbers from which a draw takes one, all equally likely.

/// The distance between the virtual recording and the model that is fitted to it.
enum class Level {
  noise_free,  ///< "L0": same model, exact activations and markers; for verification.
  noisy,       ///< "L1": same model; raw EMG and measurement noise.
  different,   ///< "L2": another truth (seven heads, elastic tendons, other curves, fatigue), with
               ///< systematic errors of the instruments.
};
inline constexpr std::string_view kLevelNames[] = {"L0", "L1", "L2"};
constexpr ChoiceNames choice_names(Level) { return kLevelNames; }

/// The task of a trial of the virtual experiment.
enum class TrialKind {
  flexion,         ///< Sinusoidal flexion and extension.
  eccentric,       ///< A held mass is raised and lowered slowly.
  isometric_ramp,  ///< The forearm held at an angle; effort rises and falls; torque is measured.
  isokinetic,      ///< A dynamometer moves the forearm at a constant speed against or with the effort.
  mvc,             ///< As isometric_ramp, with the greatest effort kept for a while.
  passive,         ///< Relaxed; a dynamometer moves the forearm slowly; torque is measured.
};
inline constexpr std::string_view kTrialKindNames[] = {"flexion",    "eccentric", "isometric_ramp",
                                                       "isokinetic", "mvc",       "passive"};
constexpr ChoiceNames choice_names(TrialKind) { return kTrialKindNames; }

enum class Plane {
  vertical,    ///< The upper arm hangs.
  horizontal,  ///< The upper arm is raised to the side and the axis of the elbow is vertical.
};
inline constexpr std::string_view kPlaneNames[] = {"vertical", "horizontal"};
constexpr ChoiceNames choice_names(Plane) { return kPlaneNames; }

enum class Direction { flexion, extension, both };  ///< `both`: alternately, flexion first.
inline constexpr std::string_view kDirectionNames[] = {"flexion", "extension", "both"};
constexpr ChoiceNames choice_names(Direction) { return kDirectionNames; }

struct VirtualSubject {
  std::string name = "virtual";  ///< The seed follows in study.toml: another seed is another person.
  double mass_kg = 73.0;
  std::string sex = "male";  ///< "male" or "female": which fractions of body mass apply.
  double upper_arm_length_m = 0.30;
  double forearm_length_m = 0.2689;  ///< Elbow to wrist.
};

/// Sensors that differ from the identification's assumptions.
struct SensorTruth {
  std::optional<double> emg_exponent;  ///< p of every muscle, in place of EmgNoise's range.
  double crosstalk = 0.0;              ///< Share of every other channel's signal in each channel.
  double emg_gain_drift = 0.0;         ///< Relative growth of the EMG per excitation over the session.
  bool emg_noise = false;              ///< The EMG is independent of the muscles.
  double torque_scale = 1.0;           ///< The dynamometer shows scale * torque + offset.
  double torque_offset_nm = 0.0;
  double fascicle_sd_m = 0.0;  ///< Error of fascicle lengths by ultrasound; 0: none were measured.
};

/// The origin of the true muscle parameters.
struct TruthSpec {
  double spread = 1.0;  ///< In standard deviations of the prior about the literature value.
  /// Names of the parameters that differ from the literature.
  std::vector<std::string> vary = {"max_isometric_force",  "optimal_fiber_length", "force_length_width",
                                   "concentric_curvature", "eccentric_plateau",    "eccentric_curvature_product"};
  /// Values that are set, not drawn, by muscle and parameter name; SI.
  std::map<std::string, std::map<std::string, double>> values;
  Range emg_delay_s = {0.030, 0.080};  ///< Electromechanical delay. (L2: follows from the activation dynamics.)
  /// Levels L0 and L1: draws the person's nuisances, too (fit/measurement/nuisances.h, `draw_beside_muscles`).
  bool beside_muscles = false;
  /// Shifts the mean of the drawn values, in standard deviations of the prior.
  double offset = 0.0;
  // The values of level L2. Levels L0 and L1: `default_protocol`.
  /// "paper" (L0, L1), "de_groote", "millard", or "any": one of the last two by chance.
  std::string curves = "any";
  Range tendon_strain = {0.03, 0.06};  ///< Strain at F_max; 0: rigid (L0, L1).
  double moment_arm_sd = 0.10;         ///< Relative, per muscle.
  double moment_arm_slope_sd = 0.0;    ///< Relative per radian, per muscle.
  double inertia_sd = 0.10;            ///< Relative, for forearm and hand. L2.
  SensorTruth sensors;
};

/// The rule by which the virtual person shares the effort.
struct ControlSpec {
  /// Activation of the antagonist, a share of the greatest activation.
  Range co_contraction = {0.02, 0.15};
  /// Standard deviation of ln(BRD / BIC activation), over trials and slowly within each. At 0 the
  /// two flexors' EMG would be one signal.
  double synergy = 0.35;
  /// Standard deviation of ln(BRA / BIC activation). 0: the brachialis acts exactly as the biceps does, and has no
  /// electrode. Above 0: the brachialis acts independently, and a wire electrode records it.
  double brachialis_synergy = 0.0;
  /// Relative standard deviation of each muscle's unintended drive below 3 Hz. L2 only.
  double motor_noise = 0.08;
  /// Unevenness of the movements, 1: as of people; 0: as of machines. Swings lead and lag by up to a quarter of a
  /// radian. Lifts last some 10 % more or less and end some 2 degrees off, and slow ones consist of several movements.
  /// The antagonist's co-contraction varies with the movement. L2: 1.
  double irregularity = 0.0;
};

/// Fatigue: three compartments per muscle (muscle::published_fatigue_rates), which persist from trial to trial.
struct FatigueSpec {
  bool on = false;  ///< L2: true unless the protocol says otherwise.
  std::string rates = "elbow_rest";
  double rest_s = 120.0;  ///< Time between trials.
};

/// Clocks of EMG and markers. The sum of both errors is the error of the file's EMG time.
struct SyncError {
  double offset_sd_s = 0.0;  ///< Offset of the trigger, drawn for every trial. L2: 8 ms.
  double drift_ppm = 0.0;    ///< Drift of the EMG clock, in half of the people. L2: 50.
};

/// Errors of the cameras. The last five are 0 at L1 and have the values in their comments at L2,
/// unless the protocol sets them.
struct MarkerNoise {
  double rate_hz = 100.0;
  double marker_sd_m = 0.0005;
  /// Soft tissue: scale of marker motion on the skin, a sine of the elbow's angle of 5 to 10 mm on
  /// the upper arm and 3 to 5 mm on the forearm; 1.
  double soft_tissue = 0.0;
  double misplacement_m = 0.0;     ///< Rms distance of a marker from its place in the model; 5 mm.
  double dropouts_per_min = 0.0;   ///< Rate for every marker, 30 to 300 ms each; 2.
  double frame_jitter_sd_s = 0.0;  ///< Jitter of the frames' times; 0.2 ms.
};

struct EmgNoise {
  double rate_hz = 1000.0;
  Range mvc_v = {0.3e-3, 1.2e-3};  ///< Rms of raw EMG at the greatest effort.
  double baseline = 0.015;         ///< Rms of the noise without effort, relative to the greatest effort's.
  double hum = 0.01;               ///< Rms of the mains hum.
  double hum_hz = 50.0;
  double artefact = 0.02;  ///< Rms of the movement artefact, below 15 Hz, while the arm moves.
  // Ranges of draws for each muscle or channel. At L1 the values have no effect; at L2 they are
  // those in the comments, unless the protocol sets them.
  Range crosstalk = {0.0, 0.0};  ///< Share of a neighbour's signal in a channel; 0.05 to 0.10.
  Range effort = {1.0, 1.0};     ///< Recorded greatest effort over the true greatest effort; 0.8 to 1.
  Range exponent = {1.0, 1.0};   ///< p: excitation = (rms / greatest rms)^p; 1 to 1.5.
  /// Factor on Shwedyk's frequencies, which depend on the muscle fibers and on the tissue between
  /// fibers and electrode; 0.6 to 1.2.
  Range spectrum = {1.0, 1.0};
  /// Number of motor units at the electrode: few units make single spikes. 0: Gaussian noise; 250.
  double motor_units = 0.0;
  /// Bandwidth of the amplifier, fourth order; 0: beyond half the rate; 450.
  double bandwidth_hz = 0.0;
};

struct TorqueNoise {
  double sd_nm = 0.3;
  double bandwidth_hz = 5.0;
};

/// A movement to and fro.
struct CycleSpec {
  double frequency_hz = 0.5;
  double centre_rad = 1.2;
  double amplitude_rad = 0.8;
  double variation = 0.08;  ///< Relative change of amplitude from cycle to cycle.
  double duration_s = 10.0;
};

/// A movement up and down again.
struct LiftSpec {
  double from_rad = 0.35;  ///< Lowest angle.
  double to_rad = 2.0;     ///< Highest angle.
  double raise_s = 1.5;
  double lower_s = 3.0;
};

struct TrialProtocol {
  std::string name;
  TrialKind kind = TrialKind::flexion;
  std::string use = "calibration";  ///< Use in the study: calibration, validation, mvc, isometric, passive.
  Plane plane = Plane::vertical;
  double held_mass_kg = 0.0;
  std::optional<Range> co_contraction;  ///< Empty: ControlSpec's range.

  CycleSpec cycles;     ///< flexion
  LiftSpec lift;        ///< eccentric, passive; of isokinetic the angles.
  int repetitions = 1;  ///< eccentric, isometric_ramp, mvc.

  double angle_rad = 1.2;  ///< isometric_ramp, mvc.
  Direction direction = Direction::both;
  double peak = 0.7;    ///< isometric_ramp: activation of the most active muscle at the top.
  double rise_s = 2.0;  ///< isometric_ramp, mvc: to the top, and from it.
  double hold_s = 1.0;  ///< At the top.
  double rest_s = 1.0;  ///< Before each effort.

  double speed_radps = 1.0;  ///< isokinetic
  bool concentric = true;    ///< isokinetic: the dynamometer gives way to the effort.
  bool eccentric = true;     ///< isokinetic: the dynamometer drives the arm against the effort.

  /// End of the warm-up of person and electrodes: the antagonist's activity doubles and the EMG
  /// grows by 15 %, fading. 0: no warm-up.
  double warm_up_s = 0.0;
};

/// The plan of a virtual experiment.
struct Protocol {
  std::filesystem::path file;  ///< Path of the file; may be empty.
  std::string name = "protocol";
  Level level = Level::noisy;
  bool seven_heads = false;  ///< The recording's model has seven heads (arm7).
  VirtualSubject subject;
  TruthSpec truth;
  ControlSpec control;
  MarkerNoise motion;
  EmgNoise emg;
  TorqueNoise torque;
  SyncError sync;
  FatigueSpec fatigue;
  double mvc_window_s = 2.0;  ///< Moving mean from which the study takes the greatest EMG.
  double lowpass_hz = 6.0;    ///< Cut-off of the envelope, for the study.
  std::vector<TrialProtocol> trials;
};

/// Reads a protocol file (TOML). Throws ReadError with file and line for syntax, unknown keys (with
/// the nearest known one), wrong types, numbers out of range and repeated names. The message has
/// the value found, the expectation and the remedy.
///
/// The level determines the defaults of missing keys; `level` replaces the file's level.
[[nodiscard]] Protocol read_protocol(const std::filesystem::path& file, std::optional<Level> level = std::nullopt);
[[nodiscard]] Protocol parse_protocol(std::string_view text,
                                      const std::filesystem::path& file,
                                      std::optional<Level> level = std::nullopt);

/// Sets keys of the table [truth] beyond those of the file: "moment_arm_sd=0.15",
/// "curves=millard", "tendon_strain=[0.08, 0.08]". Throws ReadError as `read_protocol` does.
void set_truth(Protocol& protocol, const std::vector<std::string>& settings);

/// Returns the protocol of this level with defaults for every key.
[[nodiscard]] Protocol default_protocol(Level level);

}  // namespace myoid::lab
