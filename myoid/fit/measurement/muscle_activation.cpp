#include "myoid/fit/measurement/muscle_activation.h"

#include <map>

#include "myoid/fit/measurement/envelope.h"

namespace myoid::fit {

Eigen::MatrixXd muscle_activation(const StudyData& data, const TrialData& trial, double delay_s) {
  Eigen::MatrixXd activation(trial.time_s.size(), static_cast<Eigen::Index>(data.muscles.size()));
  std::map<Eigen::Index, Eigen::Index> done;  // channel -> first muscle that uses it
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const Eigen::Index channel = trial.activation.index(data.muscles[k].emg_channel);
    if (const auto it = done.find(channel); it != done.end()) {
      activation.col(column) = activation.col(it->second);
      continue;
    }
    done[channel] = column;
    const Envelope envelope(trial.activation.time_s(), trial.activation.values().col(channel));
    for (Eigen::Index i = 0; i < activation.rows(); ++i)
      activation(i, column) = envelope.at(trial.time_s[i] - delay_s).value;
  }
  return activation;
}

}  // namespace myoid::fit
