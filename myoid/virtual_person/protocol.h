#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::twin {

/// The distance of the virtual recording from the model that is fitted to it.
enum class Level {
  noise_free,  ///< "L0": same model, exact activations and markers; for verification.
  noisy,       ///< "L1": same model; raw EMG and measurement noise.
  different,   ///< "L2": another truth (seven heads, elastic tendons, other curves, fatigue), and
               ///< the systematic errors of instruments as well.
};
[[nodiscard]] std::string_view name(Level level);

/// The task of a trial of the virtual experiment.
enum class TrialKind {
  flexion,         ///< Sinusoidal flexion and extension.
  eccentric,       ///< A held mass is raised and lowered slowly.
  isometric_ramp,  ///< The forearm held at an angle; effort rises and falls; torque is measured.
  isokinetic,  ///< A dynamometer moves the forearm at a constant speed against or with the effort.
  mvc,         ///< As isometric_ramp, with the greatest effort kept for a while.
  passive,     ///< Relaxed; a dynamometer moves the forearm slowly; torque is measured.
};
[[nodiscard]] std::string_view name(TrialKind kind);

enum class Plane {
  vertical,    ///< The upper arm hangs.
  horizontal,  ///< The upper arm is raised to the side and the axis of the elbow is vertical.
};

enum class Direction { flexion, extension, both };  ///< `both`: alternately, flexion first.

struct VirtualSubject {
  std::string name = "virtual-1";
  double mass_kg = 73.0;
  std::string sex = "male";  ///< "male" or "female": which fractions of body mass apply.
  double upper_arm_length_m = 0.30;
  double forearm_length_m = 0.2689;  ///< Elbow to wrist.
};

/// Sensors that show something else than the identification believes.
struct SensorTruth {
  std::optional<double> emg_exponent;  ///< p of every muscle, in place of EmgNoise's range.
  double crosstalk = 0.0;              ///< Share of every other channel's signal in each channel.
  double emg_gain_drift = 0.0;  ///< Relative growth of the EMG per excitation over the session.
  bool emg_noise = false;       ///< The EMG has nothing to do with the muscles.
  double torque_scale = 1.0;    ///< The dynamometer shows scale * torque + offset.
  double torque_offset_nm = 0.0;
};

/// The origin of the true muscle parameters.
struct TruthSpec {
  double spread = 1.0;  ///< In standard deviations of the prior about the literature value.
  /// Names of the parameters that differ from the literature.
  std::vector<std::string> vary = {"max_isometric_force", "optimal_fiber_length",
                                   "force_length_width",  "concentric_curvature",
                                   "eccentric_plateau",   "eccentric_curvature_product"};
  /// Values that are not drawn, by muscle and parameter name; SI.
  std::map<std::string, std::map<std::string, double>> values;
  double emg_delay_min_s = 0.030;  ///< The electromechanical delay is drawn between these.
  double emg_delay_max_s = 0.080;  ///< (L2: it follows from the activation dynamics instead.)
  /// Levels L0 and L1: the person also has of what a fit finds beside the muscles' parameters
  /// (run/nuisances.h): `draw_beside_muscles`.
  bool beside_muscles = false;
  double offset = 0.0;  ///< Shifts the mean of what is drawn, in standard deviations of the prior.
  // The values of level L2. Levels L0 and L1: `default_protocol`.
  /// "paper" (L0, L1), "de_groote", "millard", or "any": one of the last two by chance.
  std::string curves = "any";
  double tendon_strain_min = 0.03;  ///< At F_max, drawn between these; 0: rigid (L0, L1).
  double tendon_strain_max = 0.06;
  double moment_arm_sd = 0.10;       ///< Relative, per muscle.
  double moment_arm_slope_sd = 0.0;  ///< Relative per radian, per muscle.
  double inertia_sd = 0.10;          ///< Relative, of forearm and hand. L2.
  SensorTruth sensors;
};

/// The rule by which the virtual person shares the effort.
struct ControlSpec {
  double co_contraction_min = 0.02;  ///< Of the antagonist, a share of the greatest activation.
  double co_contraction_max = 0.15;
  /// Standard deviation of ln(BRD / BIC activation), over trials and slowly within each: without it
  /// the two flexors' EMG would be one signal.
  double synergy = 0.35;
  /// The same of ln(BRA / BIC activation). 0: the brachialis acts exactly as the biceps does, and
  /// has no electrode. Above 0: it acts on its own, and a wire electrode records it.
  double brachialis_synergy = 0.0;
  /// Relative standard deviation of each muscle's drive below 3 Hz that nobody intends. L2 only.
  double motor_noise = 0.08;
  /// Unevenness of the movements, 1: as of people; 0: as of machines. Swings come early and late by
  /// up to a quarter of a radian; lifts last some 10 % more or less and end some 2 degrees off, and
  /// slow ones are made of several movements; the antagonist comes and goes with the movement.
  /// L2: 1.
  double irregularity = 0.0;
};

/// Fatigue: three compartments per muscle (muscle::published_fatigue_rates), carried on from trial
/// to trial.
struct FatigueSpec {
  bool on = false;  ///< L2: true unless the protocol says otherwise.
  std::string rates = "elbow_rest";
  double rest_s = 120.0;  ///< Between trials.
};

/// EMG and markers are on two clocks. The sum of both is what the file's EMG time is off by.
struct SyncError {
  double offset_sd_s = 0.0;  ///< Of the trigger, drawn for every trial. L2: 8 ms.
  double drift_ppm = 0.0;    ///< Of the EMG clock, in half of the people. L2: 50.
};

/// Cameras. The last five are 0 at L1 and as their comments say at L2, unless the protocol sets
/// them.
struct MarkerNoise {
  double rate_hz = 100.0;
  double marker_sd_m = 0.0005;
  /// Soft tissue: markers move on the skin as a sine of the elbow's angle, 5 to 10 mm on the upper
  /// arm and 3 to 5 mm on the forearm times this; 1.
  double soft_tissue = 0.0;
  double misplacement_m = 0.0;     ///< Rms distance of a marker from where the model has it; 5 mm.
  double dropouts_per_min = 0.0;   ///< Of every marker, 30 to 300 ms each; 2.
  double frame_jitter_sd_s = 0.0;  ///< Of the times at which frames are taken; 0.2 ms.
};

struct EmgNoise {
  double rate_hz = 1000.0;
  double mvc_min_v = 0.3e-3;  ///< Rms of raw EMG at the greatest effort: drawn between these.
  double mvc_max_v = 1.2e-3;
  double baseline = 0.015;  ///< Rms of the noise without effort, a share of the above.
  double hum = 0.01;        ///< Rms of the mains.
  double hum_hz = 50.0;
  double artefact = 0.02;  ///< Rms of the movement artefact, below 15 Hz, while the arm moves.
  // Drawn between these for each muscle or channel. At L1 nothing of it happens, at L2 they are as
  // the comments say, unless the protocol sets them.
  double crosstalk_min = 0.0;  ///< Share of a neighbour's signal in a channel; 0.05 to 0.10.
  double crosstalk_max = 0.0;
  double effort_min = 1.0;  ///< What the greatest effort reaches of the truly greatest; 0.8 to 1.
  double effort_max = 1.0;
  double exponent_min = 1.0;  ///< p: excitation = (rms / greatest rms)^p; 1 to 1.5.
  double exponent_max = 1.0;
  /// Least factor on Shwedyk's frequencies, which muscle fibers and the tissue between them and the
  /// electrode lower or raise; 0.6 to 1.2.
  double spectrum_min = 1.0;
  double spectrum_max = 1.0;
  /// Motor units that the electrode sees: few of them make single spikes. 0: Gaussian noise; 250.
  double motor_units = 0.0;
  double bandwidth_hz = 0.0;  ///< Of the amplifier, fourth order; 0: beyond half the rate; 450.
};

struct TorqueNoise {
  double sd_nm = 0.3;
  double bandwidth_hz = 5.0;
};

struct TrialProtocol {
  std::string name;
  TrialKind kind = TrialKind::flexion;
  std::string use =
      "calibration";  ///< Of the study: calibration, validation, mvc, isometric, passive.
  Plane plane = Plane::vertical;
  double held_mass_kg = 0.0;
  std::vector<double> co_contraction;  ///< Empty: ControlSpec's range.

  double frequency_hz = 0.5;
  double centre_rad = 1.2;
  double amplitude_rad = 0.8;
  double variation = 0.08;  ///< Relative change of amplitude from cycle to cycle.
  double duration_s = 10.0;

  double from_rad = 0.35;  ///< eccentric, passive: lowest angle.
  double to_rad = 2.0;     ///< eccentric, passive: highest angle.
  double raise_s = 1.5;    ///< eccentric: time of raising.
  double lower_s = 3.0;    ///< eccentric: time of lowering.
  int repetitions = 1;     ///< eccentric, isometric_ramp, mvc.

  double angle_rad = 1.2;  ///< isometric_ramp, mvc.
  Direction direction = Direction::both;
  double peak = 0.7;    ///< isometric_ramp: activation of the most active muscle at the top.
  double rise_s = 2.0;  ///< isometric_ramp, mvc: to the top, and from it.
  double hold_s = 1.0;  ///< At the top.
  double rest_s = 1.0;  ///< Before each effort.

  double speed_radps = 1.0;  ///< isokinetic
  bool concentric = true;    ///< isokinetic: the dynamometer gives way ...
  bool eccentric = true;     ///< ... or drives the arm against the effort.

  /// Until then the person and the electrodes warm up: the antagonist works along twice as much and
  /// the EMG is 15 % larger, fading. 0: not at all.
  double warm_up_s = 0.0;
};

/// The plan of a virtual experiment.
struct Protocol {
  std::filesystem::path file;  ///< Where it was read from; may be empty.
  std::string name = "protocol";
  Level level = Level::noisy;
  bool seven_heads = false;  ///< The model that goes with the recording has seven heads (arm7).
  VirtualSubject subject;
  TruthSpec truth;
  ControlSpec control;
  MarkerNoise motion;
  EmgNoise emg;
  TorqueNoise torque;
  SyncError sync;
  FatigueSpec fatigue;
  double mvc_window_s = 2.0;  ///< Moving mean that the study takes the greatest EMG from.
  double lowpass_hz = 6.0;    ///< Of the envelope, for the study.
  std::vector<TrialProtocol> trials;
};

/// Reads a protocol file (TOML). Throws ReadError with file and line for syntax, unknown keys (with
/// the nearest known one), wrong types, numbers out of range and names given twice; says what was
/// found, what is expected and how to mend it.
///
/// The level decides what the keys that are not there stand for; `level` takes the place of the
/// file's.
[[nodiscard]] Protocol read_protocol(const std::filesystem::path& file,
                                     std::optional<Level> level = std::nullopt);
[[nodiscard]] Protocol parse_protocol(std::string_view text,
                                      const std::filesystem::path& file,
                                      std::optional<Level> level = std::nullopt);

/// Sets keys of the table [truth] beyond those of the file: "moment_arm_sd=0.15",
/// "curves=millard", "tendon_strain=[0.08, 0.08]". Throws ReadError as `read_protocol` does.
void set_truth(Protocol& protocol, const std::vector<std::string>& settings);

/// Returns the protocol of this level, before any key of a file is read.
[[nodiscard]] Protocol default_protocol(Level level);

}  // namespace myoid::twin
