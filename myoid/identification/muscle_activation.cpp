#include "myoid/identification/muscle_activation.h"

#include <map>

#include "myoid/identification/envelope.h"

namespace myoid::identification {

Eigen::MatrixXd muscle_activation(const StudyData& data,
                                  const TrialData& trial,
                                  const Eigen::VectorXd& time_s,
                                  double delay_s,
                                  Eigen::MatrixXd* slope) {
  Eigen::MatrixXd activation(time_s.size(), static_cast<Eigen::Index>(data.muscles.size()));
  if (slope != nullptr) slope->resize(activation.rows(), activation.cols());
  std::map<Eigen::Index, Eigen::Index> done;  // channel -> first muscle that uses it
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const Eigen::Index channel = trial.activation.index(data.muscles[k].emg_channel);
    if (const auto it = done.find(channel); it != done.end()) {
      activation.col(column) = activation.col(it->second);
      if (slope != nullptr) slope->col(column) = slope->col(it->second);
      continue;
    }
    done[channel] = column;
    const Envelope envelope(trial.activation.time_s(), trial.activation.values().col(channel));
    for (Eigen::Index i = 0; i < time_s.size(); ++i) {
      const Envelope::Value value = envelope.at(time_s[i] - delay_s);
      activation(i, column) = value.value;
      if (slope != nullptr) (*slope)(i, column) = value.slope;
    }
  }
  return activation;
}

}  // namespace myoid::identification
