#include "myoid/run/torque_scales.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/fit/methods/prediction.h"
#include "myoid/fit/posterior/likelihood.h"

namespace myoid::run {

std::string TorqueScales::sentence() const {
  return fmt::format(
      "the dynamometer's torques are {:.2f} times as large as those by weight and inertia (95 %: {:.2f} "
      "to {:.2f})",
      ratio, low, high);
}

std::optional<TorqueScales> torque_scales(const fit::StudyData& data,
                                          const fit::EstimatorOptions& options,
                                          const fit::IdentificationResult& torque) {
  std::ptrdiff_t measured = 0, computed = 0;
  for (const fit::TrialData& trial : data.trials)
    if (trial.calibration) ++(trial.dynamics_nm.size() > 0 ? measured : computed);
  if (measured == 0 || computed == 0 || torque.noise.size() == 0) return std::nullopt;
  fit::EstimatorOptions at = fit::beginning_at(torque, options);
  at.law = torque.lag;
  at.progress = {};
  fit::Likelihood likelihood(data, at, fit::Columns::at_reference);
  likelihood.refer_to(torque.solution);
  const fit::Likelihood::UnseenGiven unseen = likelihood.unseen_given(torque.solution, torque.noise);
  const std::vector<fit::UnseenQuantity>& quantities = likelihood.unseen().quantities;
  Eigen::VectorXd apart = Eigen::VectorXd::Zero(unseen.mean.size());
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const double sign = quantities[i].name == "dynamometer_scale" ? 1.0
                        : quantities[i].name == "torque_scale"    ? -1.0
                                                                  : 0.0;
    apart[static_cast<Eigen::Index>(i)] = sign * quantities[i].weight;
  }
  const Eigen::VectorXd by_z = unseen.by_z.transpose() * apart;
  const double mean = apart.dot(unseen.mean);
  const double sd = std::sqrt(apart.dot(unseen.covariance * apart) + by_z.dot(torque.covariance * by_z));
  constexpr double k95 = 1.96;
  return TorqueScales{.ratio = std::exp(mean),
                      .low = std::exp(mean - k95 * sd),
                      .high = std::exp(mean + k95 * sd),
                      .usual = options.unseen.torque_scale};
}

}  // namespace myoid::run
