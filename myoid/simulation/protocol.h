#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::simulation {

/// How far the virtual recording departs from what is fitted to it.
enum class Level {
  noise_free,  ///< "L0": same model, exact activations and markers; for verification.
  noisy,       ///< "L1": same model; raw EMG and measurement noise.
};

/// What a trial of the virtual experiment consists of.
enum class TrialKind {
  flexion,         ///< Sinusoidal flexion and extension.
  eccentric,       ///< A held mass is raised and lowered slowly.
  isometric_ramp,  ///< The forearm held at an angle; effort rises and falls; torque is measured.
  mvc,             ///< As isometric_ramp, with the greatest effort kept for a while.
  passive,         ///< Relaxed; a dynamometer moves the forearm slowly; torque is measured.
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

/// Where the true muscle parameters come from.
struct TruthSpec {
  double spread = 1.0;  ///< In standard deviations of the prior about the literature value.
  /// Names of the parameters that differ from the literature.
  std::vector<std::string> vary = {"max_isometric_force", "optimal_fiber_length",
                                   "force_length_width",  "concentric_curvature",
                                   "eccentric_plateau",   "eccentric_curvature_product"};
  /// Values that are not drawn, by muscle and parameter name; SI.
  std::map<std::string, std::map<std::string, double>> values;
  double emg_delay_min_s = 0.030;  ///< The electromechanical delay is drawn between these.
  double emg_delay_max_s = 0.080;
};

/// How the virtual person shares the effort.
struct ControlSpec {
  double co_contraction_min = 0.02;  ///< Of the antagonist, a share of the greatest activation.
  double co_contraction_max = 0.15;
  /// Standard deviation of ln(BRD / BIC activation), over trials and slowly within each: without it
  /// the two flexors' EMG would be one signal.
  double synergy = 0.35;
  /// The same of ln(BRA / BIC activation). 0: the brachialis acts exactly as the biceps does, and
  /// has no electrode. Above 0: it acts on its own, and a wire electrode records it.
  double brachialis_synergy = 0.0;
};

struct MarkerNoise {
  double rate_hz = 100.0;
  double marker_sd_m = 0.0005;
};

struct EmgNoise {
  double rate_hz = 1000.0;
  double mvc_min_v = 0.3e-3;  ///< Rms of raw EMG at the greatest effort: drawn between these.
  double mvc_max_v = 1.2e-3;
  double baseline = 0.015;  ///< Rms of the noise without effort, a share of the above.
  double hum = 0.01;        ///< Rms of the mains.
  double hum_hz = 50.0;
  double artefact = 0.02;  ///< Rms of the movement artefact, below 15 Hz, while the arm moves.
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
};

/// What is recorded in a virtual experiment.
struct Protocol {
  std::filesystem::path file;  ///< Where it was read from; may be empty.
  std::string name = "protocol";
  Level level = Level::noisy;
  VirtualSubject subject;
  TruthSpec truth;
  ControlSpec control;
  MarkerNoise motion;
  EmgNoise emg;
  TorqueNoise torque;
  double mvc_window_s = 2.0;  ///< Moving mean that the study takes the greatest EMG from.
  double lowpass_hz = 6.0;    ///< Of the envelope, for the study.
  std::vector<TrialProtocol> trials;
};

/// Reads a protocol file (TOML). Throws ReadError with file and line for syntax, unknown keys (with
/// the nearest known one), wrong types, numbers out of range and names given twice; says what was
/// found, what is expected and how to mend it.
[[nodiscard]] Protocol read_protocol(const std::filesystem::path& file);
[[nodiscard]] Protocol parse_protocol(std::string_view text, const std::filesystem::path& file);

}  // namespace myoid::simulation
