#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/remark.h"
#include "myoid/ground/core/stretch.h"
#include "myoid/page/report.h"
#include "myoid/page/scene_page.h"

namespace myoid::page {

/// A curve over a trial's time.
struct TimeLine {
  std::string name;  ///< In the legend: "measured".
  Role role = Role::reference;
  int clock = 0;            ///< Number in WorkbenchTrial::clocks.
  Eigen::VectorXd value{};  ///< As long as the clock; NaN is a gap.
  Eigen::VectorXd upper{};  ///< Upper edge of a band; empty for a line.
};

/// A plot over a trial's time.
struct TimePlot {
  std::string kind;   ///< "angle", "torque", "emg", "activation", "force": decides the explanation.
  std::string title;  ///< "elbow flexion", "BIC"
  std::string unit;
  std::vector<TimeLine> lines{};
  int joint = -1;      ///< For a torque: number of the joint; -1: none.
  int muscle = -1;     ///< For a force: number in Workbench::muscles; -1: none.
  std::string file{};  ///< File of the run that holds the numbers, beside the report.
};

/// A channel of the carpet, in equal stretches of the trial's time.
struct CarpetRow {
  std::string name;
  std::string kind;  ///< "EMG" or "marker".
  std::string unit;
  Eigen::VectorXd value{};  ///< NaN: missing.
};

/// A fault of a recording, marked in carpet and plots.
struct TrialMark {
  std::string about;              ///< Channel or marker.
  std::optional<Stretch> when{};  ///< Empty: the whole trial.
  Badge badge = Badge::none;
  std::string text;
};

/// The inputs of one muscle's law over a trial, on its first clock.
struct MuscleDrive {
  Eigen::VectorXd activation{}, length_m{}, velocity_mps{};  ///< Musculotendon length and rate.
  std::vector<Eigen::VectorXd> moment_arm_m{};               ///< One per joint.
};

/// One trial of the workbench.
struct WorkbenchTrial {
  std::string name;
  std::string use;
  int scene = -1;                         ///< Number in Workbench::scenes; -1: none.
  Badge badge = Badge::none;              ///< The worst that is known about the trial.
  std::vector<Remark> remarks{};          ///< The reasons, and facts about the trial.
  std::vector<Eigen::VectorXd> clocks{};  ///< Times [s].
  std::vector<TimePlot> plots{};
  Stretch carpet_when{};
  std::vector<CarpetRow> carpet{};
  std::vector<TrialMark> marks{};
  std::vector<MuscleDrive> drives{};  ///< One for each of Workbench::muscles, or empty.
  std::string video{};                ///< Path of a film, from the report's folder; empty: none.
  double video_offset_s = 0.0;        ///< Time of the trial at which the film begins.
};

/// A number of a muscle that the page can move.
struct MovableNumber {
  int field = 0;     ///< Number in Workbench::fields.
  std::string name;  ///< "optimal fiber length"
  std::string unit;
  double lower = 0.0, upper = 0.0;  ///< Range of the slider.
  double sd_log = 0.0;              ///< Posterior standard deviation of the logarithm.
  std::string verdict;
};

/// A muscle whose law the page evaluates.
struct MovableMuscle {
  std::string name;
  std::vector<double> literature{}, identified{};  ///< In the order of Workbench::fields.
  std::vector<MovableNumber> numbers{};
  /// Correlation of the logarithms of `numbers`, after the recording.
  Eigen::MatrixXd correlation{};
  Eigen::MatrixXd draws{};         ///< From a posterior: a row for each of `numbers`; else empty.
  Eigen::VectorXd draw_weights{};  ///< Weights of the columns of `draws`; they add to 1.
};

/// The values that a report shows over time. The page draws them and computes none of them; it
/// evaluates only the law of a muscle whose numbers the reader moves.
struct Workbench {
  ScenePage scenes{};
  std::vector<WorkbenchTrial> trials{};
  std::vector<std::string> fields{};  ///< Names of a muscle's numbers, as the law takes them.
  std::vector<MovableMuscle> muscles{};
};

/// Throws InvalidInput, naming trial and plot, unless every line is as long as its clock, clocks
/// rise, and numbers of scenes, clocks and muscles exist.
void validate(const Workbench& workbench);

/// Returns the workbench as JSON that may stand inside a <script> element, without its scenes; the series are packed in
/// 16 bits (packing.h). `figures`: the numbers of the report's own figures go with it, by id.
[[nodiscard]] std::string workbench_json(const Workbench& workbench, const Report& report);

}  // namespace myoid::page
