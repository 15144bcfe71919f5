#include "myoid/results/exports/law_differences.h"

#include <cmath>

#include <Eigen/Core>

#include "myoid/fit/measurement/envelope.h"
#include "myoid/opensim/projects/ceinms_law.h"
#include "myoid/results/exports/foreign_law.h"

namespace myoid::results {
namespace {

using Eigen::VectorXd;

/// One muscle in one trial.
struct Recorded {
  const fit::TrialData& trial;
  Eigen::Index muscle;
  const VectorXd& envelope_time_s;
  VectorXd envelope;
};

/// Reads samples of an envelope's clock, `delay_s` before those of the trial.
VectorXd read_at(const Recorded& r, const VectorXd& values, double delay_s) {
  const fit::Envelope curve(r.envelope_time_s, values);
  VectorXd read(r.trial.time_s.size());
  for (Eigen::Index k = 0; k < read.size(); ++k) read[k] = curve.at(r.trial.time_s[k] - delay_s).value;
  return read;
}

double interval_s(const VectorXd& time_s) {
  return time_s.size() < 2 ? 1.0 : (time_s[time_s.size() - 1] - time_s[0]) / static_cast<double>(time_s.size() - 1);
}

VectorXd own_force(const Recorded& r,
                   const fit::MuscleValues& values,
                   const fit::ChannelValues& channel,
                   fit::EmgLag lag) {
  const fit::Envelope envelope(r.envelope_time_s, r.envelope);
  const std::vector<fit::Activation> activation = fit::activation(envelope, r.trial.time_s, channel, lag);
  VectorXd force(r.trial.time_s.size());
  for (Eigen::Index k = 0; k < force.size(); ++k)
    force[k] = fit::tension_n(activation[static_cast<std::size_t>(k)].value, r.trial.length_m(k, r.muscle),
                              r.trial.velocity_mps(k, r.muscle), values);
  return force;
}

VectorXd ceinms_force(const Recorded& r, const ForeignMuscle& theirs) {
  const VectorXd neural =
      read_at(r, opensim::recursive_activation(r.envelope, theirs.ceinms.c1, theirs.ceinms.c2), theirs.ceinms.delay_s);
  VectorXd activation(neural.size()), velocity = r.trial.velocity_mps.col(r.muscle), force(neural.size());
  for (Eigen::Index k = 0; k < neural.size(); ++k)
    activation[k] = opensim::exponential_shape(neural[k], theirs.ceinms.shape_factor);
  const VectorXd length = r.trial.length_m.col(r.muscle);
  if (theirs.values[fit::kTendonStrain] > 0.0) {
    VectorXd strain(neural.size());
    for (Eigen::Index k = 0; k < strain.size(); ++k)
      strain[k] = fit::tension(activation[k], length[k], velocity[k], theirs.values).strain;
    for (Eigen::Index k = 1; k + 1 < strain.size(); ++k)
      velocity[k] -= theirs.values[fit::kSlack] * (strain[k + 1] - strain[k - 1]) /
                     (r.trial.time_s[k + 1] - r.trial.time_s[k - 1]);
  }
  for (Eigen::Index k = 0; k < force.size(); ++k)
    force[k] = fit::tension_n(activation[k], length[k], velocity[k], theirs.values);
  return force;
}

VectorXd pipeline_force(const Recorded& r, const ForeignMuscle& theirs) {
  const VectorXd excitation = theirs.nmsm.emg_scale * r.envelope;
  const VectorXd neural =
      read_at(r, nmsm_neural_activation(excitation, interval_s(r.envelope_time_s), theirs.nmsm.time_constant_s),
              theirs.nmsm.delay_s);
  const NmsmMuscle muscle{theirs.values[fit::kMaxForce], theirs.values[fit::kFiberLength], theirs.values[fit::kSlack],
                          theirs.values[fit::kPennation]};
  VectorXd force(neural.size());
  for (Eigen::Index k = 0; k < force.size(); ++k)
    force[k] = nmsm_force(nmsm_activation(neural[k], theirs.nmsm.nonlinearity), r.trial.length_m(k, r.muscle),
                          r.trial.velocity_mps(k, r.muscle), muscle);
  return force;
}

}  // namespace

std::vector<LawDifference> law_differences(const fit::StudyData& data,
                                           const fit::IdentificationResult& fit,
                                           const std::vector<int>& channels,
                                           const std::vector<ForeignMuscle>& theirs,
                                           ExportFormat format) {
  std::vector<LawDifference> differences;
  for (std::size_t m = 0; m < data.muscles.size(); ++m) {
    const fit::MuscleValues& own = fit.values.muscles[m];
    LawDifference greatest{.muscle = data.muscles[m].name};
    for (const fit::TrialData& trial : data.trials) {
      const Eigen::Index column = trial.activation.index(data.muscles[m].emg_channel);
      const Recorded r{trial, static_cast<Eigen::Index>(m), trial.activation.time_s(),
                       trial.activation.values().col(column)};
      const VectorXd ours = own_force(r, own, fit.values.channels[static_cast<std::size_t>(channels[m])], fit.lag);
      const VectorXd other = format == ExportFormat::osimx ? pipeline_force(r, theirs[m]) : ceinms_force(r, theirs[m]);
      Eigen::Index at = 0;
      const double difference = (ours - other).cwiseAbs().maxCoeff(&at) / own[fit::kMaxForce];
      if (!(difference > greatest.of_max_force)) continue;
      greatest.of_max_force = difference;
      greatest.trial = trial.name;
      greatest.time_s = trial.time_s[at];
    }
    differences.push_back(greatest);
  }
  return differences;
}

}  // namespace myoid::results
