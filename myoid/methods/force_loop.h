#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/identification/muscle_law.h"
#include "myoid/identification/study_data.h"
#include "myoid/intervals/result.h"
#include "myoid/methods/force.h"

namespace myoid::identification {

/// How the torque of a joint is shared among muscles whose laws are known.
struct InformedSharing {
  double emg_weight = 10.0;  ///< W; 0: static optimization, the EMG counts for nothing.
  double reserve_nm = 1.0;   ///< Optimal torque of the reserve.
};

/// Forces of one trial, n samples, m muscles.
struct InformedForces {
  std::string trial;
  Eigen::VectorXd time_s;
  Eigen::MatrixXd activation;  ///< n x m, found.
  Eigen::MatrixXd measured;    ///< n x m, of the EMG at the same instants.
  Eigen::MatrixXd force_n;     ///< n x m
  Eigen::MatrixXd reserve_nm;  ///< n x joints: torque that no muscle carries.
  int frames_not_solved = 0;
};

/// Forces and activations with given muscles, informed by their EMG: in every sample
///
///   minimize  W sum_i (a_i - e_i)^2 + sum_i a_i^2 + sum_j y_j^2   subject to
///   sum_i r_ij F_i(a_i) + y_j T = torque_j for each joint j,   0 <= a_i <= 1
///
/// e the `measured` activation of each muscle's EMG channel (n x m) times its share, T
/// `reserve_nm`, F_i the tension of muscle_law.h, taken as linear in a_i between 0 and 1 (exact for
/// the paper's law; with gamma or an elastic tendon the force returned is that of the law at the
/// activation found, and the reserve carries the difference). Antagonists may act together as far
/// as the EMG shows it. Throws InvalidInput if sizes disagree.
[[nodiscard]] InformedForces informed_forces(const TrialData& trial,
                                             const Eigen::MatrixXd& measured,
                                             const std::vector<MuscleValues>& muscles,
                                             const InformedSharing& options = {});

struct ForceLoopOptions {
  ForceOptions force;  ///< Of the fit in every round.
  InformedSharing sharing;
  double delay_s = 0.0;  ///< From EMG to activation in the first round; then the one found.
  int max_rounds = 50;
  double tolerance = 1e-3;  ///< Largest relative change of a parameter in a round.
};

enum class LoopEnd {
  converged,    ///< No parameter changes any more.
  diverged,     ///< The changes grow, or a fit failed.
  not_settled,  ///< Neither within the rounds allowed: it creeps or swings.
};
[[nodiscard]] std::string_view name(LoopEnd end);

struct ForceLoopRound {
  double parameter_change = 0.0;  ///< Largest |ln(new / old)| over muscles and parameters.
  std::string parameter;          ///< Where: "BIC.optimal_fiber_length".
  double force_change = 0.0;      ///< Root mean square, relative to the forces' own.
  double reserve_nm = 0.0;        ///< Root mean square.
};

/// Forces <-> parameters.
struct ForceLoop {
  LoopEnd end = LoopEnd::not_settled;
  std::string message;  ///< The end of the loop and its meaning, as a sentence.
  std::vector<ForceLoopRound> rounds;
  IdentificationResult fit;            ///< Of the last round.
  std::vector<InformedForces> forces;  ///< With its muscles, all trials.
};

/// Shares the torque with the muscles as they are believed to be, fits every muscle to its force
/// (identify_force), shares again with the muscles found, until nothing changes: the loop that the
/// source paper leaves open. It begins at the muscles' start. Its fixed point rests on the EMG
/// where W is large and on the optimizer's criterion where it is small; method `torque` needs
/// neither. Throws as identify_force; Interrupted.
[[nodiscard]] ForceLoop iterate_forces(StudyData data, const ForceLoopOptions& options = {});

}  // namespace myoid::identification
