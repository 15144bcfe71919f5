#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/choice.h"
#include "myoid/identification/muscle_law.h"
#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"
#include "myoid/methods/force.h"

namespace myoid::identification {

/// Options for sharing the torque of a joint among muscles with known laws.
struct InformedSharing {
  double emg_weight = 10.0;  ///< W; 0: static optimization without EMG.
  double reserve_nm = 1.0;   ///< Optimal torque of the reserve actuator.
};

/// Shared forces of one trial: n samples, m muscles.
struct InformedForces {
  std::string trial;
  Eigen::VectorXd time_s;
  Eigen::MatrixXd activation;  ///< n x m, result of the sharing.
  Eigen::MatrixXd measured;    ///< n x m, from the EMG at the same instants.
  Eigen::MatrixXd force_n;     ///< n x m
  Eigen::MatrixXd reserve_nm;  ///< n x joints: torque that no muscle carries.
  int frames_not_solved = 0;
};

/// Shares torque among given muscles, informed by their EMG. In every sample
///
///   minimize  W sum_i (a_i - e_i)^2 + sum_i a_i^2 + sum_j y_j^2   subject to
///   sum_i r_ij F_i(a_i) + y_j T = torque_j for each joint j,   0 <= a_i <= 1
///
/// where e is the `measured` activation of each muscle's EMG channel (n x m) times its share, T is `reserve_nm`, and
/// F_i is the tension of muscle_law.h, taken as linear in a_i between 0 and 1. This is exact for the paper's law. With
/// gamma or an elastic tendon, the returned force follows the law at the activation found, and the reserve carries the
/// difference. Antagonists act together as far as the EMG shows it. Throws InvalidInput if sizes disagree.
[[nodiscard]] InformedForces informed_forces(const TrialData& trial,
                                             const Eigen::MatrixXd& measured,
                                             const std::vector<MuscleValues>& muscles,
                                             const InformedSharing& options = {});

struct ForceLoopOptions {
  ForceOptions force;  ///< Options of the fit in every round.
  InformedSharing sharing;
  double delay_s = 0.0;  ///< Delay of the EMG in the first round; later rounds take the fitted one.
  int max_rounds = 50;
  double tolerance = 1e-3;  ///< Greatest relative change of a parameter in the last round.
};

enum class LoopEnd {
  converged,    ///< No parameter changes further.
  diverged,     ///< The changes grow, or a fit failed.
  not_settled,  ///< Neither within the allowed rounds: the parameters creep or oscillate.
};
inline constexpr std::string_view kLoopEndNames[] = {"converged", "diverged", "not_settled"};
constexpr ChoiceNames choice_names(LoopEnd) { return kLoopEndNames; }
[[nodiscard]] constexpr std::string_view name(LoopEnd end) { return choice_name(end); }

struct ForceLoopRound {
  double parameter_change = 0.0;  ///< Largest |ln(new / old)| over muscles and parameters.
  std::string parameter;          ///< Parameter with that change: "BIC.optimal_fiber_length".
  double force_change = 0.0;      ///< Root mean square change, relative to that of the forces.
  double reserve_nm = 0.0;        ///< Root mean square of the reserves.
};

/// Result of the loop between forces and parameters.
struct ForceLoop {
  LoopEnd end = LoopEnd::not_settled;
  std::string message;  ///< The end of the loop and its meaning, as a sentence.
  std::vector<ForceLoopRound> rounds;
  IdentificationResult fit;            ///< Fit of the last round.
  std::vector<InformedForces> forces;  ///< Forces with the fitted muscles, all trials.
};

/// Finds forces and parameters that agree.
///
/// Least squares alternates until nothing changes between sharing the torque among the muscles
/// (informed_forces) and fitting every muscle to its force (identify_force). The source paper
/// leaves this loop open. The loop begins with the muscles' start. Its fixed point depends on the
/// EMG for large W and on the optimizer's criterion for small W; method `torque` needs neither.
///
/// The likelihood of the posterior (EstimatorOptions::estimator) includes the errors between muscles and torque. Shared
/// forces have no such errors, and a fit to them would count the torque twice. So the muscles come from the posterior
/// of the torque and share the forces. Both agree after one round, whose reserves measure the agreement. Throws as
/// identify_force and identify_torque; Interrupted.
[[nodiscard]] ForceLoop iterate_forces(StudyData data, const ForceLoopOptions& options = {});

}  // namespace myoid::identification
