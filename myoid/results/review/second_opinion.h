#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/intervals/score.h"
#include "myoid/ground/core/choice.h"
#include "myoid/ground/core/remark.h"
#include "myoid/opensim/projects/project.h"
#include "myoid/run/study_result.h"

namespace myoid::results {

/// The relation of a calibration's number to the recording.
enum class Standing {
  agrees,   ///< It lies within the interval that the recording leaves.
  differs,  ///< It lies outside.
  untold,   ///< The recording tells no number of this kind: the calibration's is one of many that do as well.
};
inline constexpr std::string_view kStandingNames[] = {"agrees", "differs", "untold"};
constexpr ChoiceNames choice_names(Standing) { return kStandingNames; }

/// A number of the project's muscles beside the estimate of the same trials.
struct ReviewedNumber {
  std::string muscle;      ///< As the study names it.
  std::size_t lumped = 1;  ///< Muscles of the project for which it stands: forces add, lengths are means by force.
  double theirs = 0.0;
  std::optional<double> start;  ///< Before the calibration.
  std::size_t on_bound = 0;     ///< Of the lumped muscles, those whose number lies on a bound.
  fit::ParameterEstimate ours;  ///< With the interval of the person.
  Standing standing = Standing::untold;
};

/// The torque of one joint in one trial.
struct ReviewedTorque {
  std::string trial, joint;
  bool is_calibrating = false;  ///< The project's calibration fitted it.
  Eigen::VectorXd time_s, measured_nm;
  Eigen::VectorXd theirs_nm;  ///< By the project's law; empty if the files lack one.
  Eigen::VectorXd ours_nm;    ///< Of a fit without the trial, at `ours_time_s`; empty: never left out.
  Eigen::VectorXd ours_time_s;
  std::optional<fit::Score> theirs, ours;
};

/// Strength of a joint in one direction: maximal forces times mean moment arms.
struct JointStrength {
  std::string joint;
  bool is_positive = true;  ///< The direction of the coordinate.
  double all_nm = 0.0;
  double without_emg_nm = 0.0;
  std::vector<std::string> without_emg;  ///< Muscles, the strongest first.
};

/// A calibration of another program, judged with its own files.
struct SecondOpinion {
  opensim::Project project;
  run::StudyResult study;  ///< The fit of the same trials.
  std::vector<std::string> joints;
  std::vector<ReviewedTorque> torques;
  std::vector<ReviewedNumber> numbers;
  std::vector<JointStrength> strengths;
  std::string no_law;             ///< Why their torque is not computed; empty: it is.
  std::size_t unknowns = 0;       ///< Of the calibration.
  std::size_t on_bound = 0;       ///< Of these.
  double independent_rows = 0.0;  ///< Of the trials of the calibration: one per 0.22 s and joint, at most.
};

/// Judges a project by a study of its trials (project_study.h). Their torque is that of all muscles of the joint, those
/// without EMG passive.
[[nodiscard]] SecondOpinion second_opinion(opensim::Project project,
                                           std::vector<std::string> joints,
                                           run::StudyResult study);

}  // namespace myoid::results
