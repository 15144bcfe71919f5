#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/body/kinematics/lumped_muscles.h"
#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/fit/measurement/muscle_law.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/study/study.h"

namespace myoid::run {

/// A kind of movement that a person can do for a recording.
enum class MovementKind {
  swing,       ///< The joint is moved to and fro, a mass held.
  lowering,    ///< A mass is raised quickly and lowered slowly.
  isometric,   ///< The joint is fixed; effort rises and falls; the torque is measured.
  isokinetic,  ///< A dynamometer moves the joint at one speed, to and fro, against the effort.
};

struct Movement {
  MovementKind kind = MovementKind::swing;
  bool horizontal = false;    ///< Plane of movement of the built-in arm.
  double held_mass_kg = 0.0;  ///< swing, lowering.
  double lowest_rad = 0.0;    ///< Range of the joint; both ends are equal for isometric.
  double highest_rad = 0.0;
  double frequency_hz = 0.0;  ///< swing.
  double speed_radps = 0.0;   ///< isokinetic.
  double level = 0.0;         ///< isometric, isokinetic: greatest activation.
  bool positive = true;       ///< isometric, isokinetic: effort in the coordinate's direction.
  std::string direction;      ///< Name of that direction: "flexion".
  double duration_s = 10.0;

  /// Returns "swing 0.6 Hz, 15-122 deg, 2 kg, vertical".
  [[nodiscard]] std::string description() const;
};

/// The variations of a catalogue of movements.
struct CatalogueOptions {
  std::vector<double> held_masses_kg = {0.0, 1.0, 2.0, 4.0};
  std::vector<double> frequencies_hz = {0.3, 0.6, 1.0, 1.5, 2.0};
  int angles = 6;           ///< Isometric postures over the range.
  bool planes = true;       ///< Both planes (built-in arm) or the model's posture only.
  bool dynamometer = true;  ///< False: no isokinetic movement.
  std::string coordinate;   ///< Names the directions of effort.
};

/// Returns all combinations over the coordinate's range [rad] without a tenth at each end: swings over the whole and
/// over either half, lowerings, isometric and isokinetic efforts in both directions.
[[nodiscard]] std::vector<Movement> movement_catalogue(double lowest_rad,
                                                       double highest_rad,
                                                       const CatalogueOptions& options = {});

/// Returns "flexion" or "extension" if the coordinate's name says so, else "positive" or "negative".
[[nodiscard]] std::string direction_name(const std::string& coordinate, bool positive);

/// The part of a movement that is the same for every person, on a clock that begins before the
/// trial because of the EMG's delay.
struct MovementCourse {
  Movement movement;
  Eigen::VectorXd time_s;              ///< From -0.4 s; the trial begins at 0.
  body::LumpedMuscles muscles;         ///< Kinematics of the study's muscles.
  Eigen::VectorXd required_torque_nm;  ///< For swing, lowering; empty where a device measures the torque.
  Eigen::VectorXd effort;              ///< Share of `level`, 0..1, for isometric, isokinetic; else empty.
};

/// The study's model (`given`) in both planes of movement, with only the study's muscles. The
/// built-in arm has a model of its own for the other plane.
struct MovementModels {
  body::BodyModel vertical, horizontal;
};
[[nodiscard]] MovementModels movement_models(const study::Study& study, const body::BodyModel& given);

/// Computes the course of a movement by the study's model: muscle paths and inverse dynamics of the
/// coordinate's motion, with the other coordinates at their default.
[[nodiscard]] MovementCourse movement_course(const study::Study& study,
                                             const MovementModels& models,
                                             const Movement& movement);

/// A virtual person's muscles and coordination.
struct MovementPerson {
  std::vector<fit::MuscleValues> muscles;  ///< In the study's order.
  double emg_delay_s = fit::beliefs::kEmgDelay.value;
  double co_contraction = 0.05;  ///< Least activation of every muscle.
  double synergy = 0.35;         ///< Spread of ln(share of each EMG channel), over trials and within.
  double most_activation = 0.8;
  std::uint64_t seed = 1;
};

/// Returns the trial as `person` would perform it, ready for an estimator. The torque is shared among the EMG channels
/// with the least sum of squares of activations about person-specific, slowly changing proportions. Muscles of one
/// channel act as one. Empty if the trial needs an activation above the person's greatest.
[[nodiscard]] std::optional<fit::TrialData> perform(const MovementCourse& course,
                                                    const std::vector<fit::MuscleSetup>& muscles,
                                                    const MovementPerson& person);

}  // namespace myoid::run
