#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/parameters.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/fit/posterior/recorded.h"
#include "myoid/fit/posterior/torque_signals.h"
#include "myoid/fit/posterior/trial_run.h"

namespace myoid::fit {

/// A quantity x ~ N(0, weight^2) that the residuals hardly determine and in which the torque is
/// linear: it adds x S(t) to the torque, and W S S' W to the covariance of all trials together.
struct UnseenQuantity {
  std::string name;
  Source source = Source::model;
  double weight = 0.0;                   ///< Standard deviation, over the size if there is one.
  std::optional<NoiseField> size = {};   ///< The hyperparameter whose exponential multiplies the weight.
  std::vector<std::size_t> strength_of;  ///< Muscles whose F_max it multiplies.
  bool of_session = false;               ///< Another in every session: a drift of gains, the place of a probe.

  /// Returns true if the quantity is of geometry or sensors and the same in every session of a person.
  [[nodiscard]] bool lasts() const { return source != Source::model && !of_session; }
};

/// All unseen quantities of a study, and their columns S in each run, at reference values of the unknowns. A relative
/// error refers to the recorded torque, so the size of S does not follow the unknowns: a moment arm that is 10 % too
/// large makes F_max 10 % too small, but does not shrink the other muscles' errors. The shape of S does: an error of
/// the length acts where the slope of the force-length curve is.
///
/// Moment arm: r (1 + alpha + beta x), x the length over the recorded range, -1 to 1, changes the length too, l =
/// l_mean + alpha (l - l_mean) + beta (range/4) (x^2 - 1/3), because r = -dl/dq. In a muscle that crosses several
/// joints each arm errs by itself: l and x are then the joint's part of the length (JointParts), and the length acts on
/// the force, and so on all joints. Slack length: an error d shortens the fibers by d. Tendon: one that the study holds
/// rigid stretches by l_ts e ln(1 + 5 F / F_max) / ln 6. Torque scales: of a dynamometer's part of the torque and,
/// apart from it, of the part by weight and inertia; all joints share both. Gain drift: the channel's torque times the
/// place in the session, 0 at the maximal contraction. Its effort: the channel's torque; no quantity where its spread
/// is 0. Cross-talk: the channel's torque times the share of its activation that is another muscle's, whose square adds
/// to the own one's. Rise and fall: activation that rises earlier and falls later by d than the delay says, a + d
/// |da/dt|. Model error: the muscle's torque times polynomials of length, ln(activation), speed and lag, and a constant
/// and a slope of the joint, as ErrorShapes; where the muscles share a free delay, a lag is its difference from their
/// mean.
///
/// Activation without EMG: the part of the muscle's torque that each part of the expected activation makes.
///
/// Measured fiber lengths have rows of their own: what changes a muscle's force stretches its tendon, and what changes
/// its length moves its fibers. Fascicles: a scale and an offset of the lengths of each measured muscle.
struct Unseen {
  /// A column of S whose shape changes with one of a muscle's unknowns.
  struct Slope {
    Eigen::Index quantity = 0, unknown = 0;
    /// The change ends at this distance from the reference: a tanh(distance / a).
    double reach = 1.0;
  };
  std::vector<UnseenQuantity> quantities;
  std::vector<Eigen::MatrixXd> columns;  ///< Per run: S, n (J + K) x quantities [N m], of fascicles [m].
  /// The entries of dS/dz that are not 0: with c the part of a column that one muscle makes, all
  /// runs one after the other,
  ///
  ///   d c / dz - c (c . d c / dz) / (c . c),
  ///
  /// so that the column turns and keeps its size.
  std::vector<Slope> slopes;
  std::vector<Eigen::MatrixXd> by_slope;  ///< Per run: n (J + K) x slopes.
  /// d ln S / dz of each column, quantities x unknowns. A column that multiplies the strength of
  /// muscles grows with the root of their F_max (geometric mean), because F + x sqrt(F F_ref) is an
  /// error that is symmetric in ln F, as a factor of F is. F + x F_ref is symmetric in newtons.
  Eigen::MatrixXd growth;
};

/// The runs where every unknown of one field of the muscles is larger by a step than the reference.
struct Stepped {
  int field = 0;
  Eigen::VectorXd step;  ///< Of each unknown; 0 of other fields.
  std::vector<RunEvaluation> at;
};

/// Evaluates the runs a small step away from z in each field of the muscles but F_max.
[[nodiscard]] std::vector<Stepped> steps_from(const Eigen::VectorXd& z,
                                              const ParameterMap& map,
                                              EmgLag lag,
                                              const std::vector<TrialRun>& runs);

/// Returns the unseen quantities. `at` holds the runs evaluated at the reference `values`; `recorded` describes the
/// fitted runs. The slopes are those of `steps`; without steps there are none.
[[nodiscard]] Unseen unseen_quantities(const StudyData& data,
                                       const EstimatorOptions& options,
                                       const ParameterMap& map,
                                       const Recorded& recorded,
                                       const std::vector<TrialRun>& runs,
                                       const ModelValues& values,
                                       const std::vector<RunEvaluation>& at,
                                       const std::vector<Stepped>& steps = {});

}  // namespace myoid::fit
