#include "myoid/intervals/held_tendon.h"

#include <string>
#include <vector>

#include <Eigen/Cholesky>

#include "myoid/identification/loss.h"
#include "myoid/intervals/score_blocks.h"

namespace myoid::identification {
namespace {

constexpr const char* kSlackName = "tendon_slack_length";

bool concerns(const ParameterRule& rule, const std::string& muscle) {
  return rule.parameter == kSlackName && covers(rule.owners, muscle);
}

/// Returns the derivative of the fitted torques by a held slack length, n.
Eigen::RowVectorXd torque_by_slack(const Estimator& estimator,
                                   const Eigen::VectorXd& z,
                                   const StudyData& data,
                                   std::size_t muscle) {
  StudyData freed = data;
  freed.rules.push_back({.parameter = kSlackName, .owners = {data.muscles[muscle].name}, .free = true});
  const ResidualModel model(freed, estimator.options());
  Eigen::VectorXd at = model.parameters().start();
  const Eigen::Index slack = model.parameters().find(Scope::muscle, kSlack, static_cast<int>(muscle));
  at[slack] = estimator.model().parameters().values(z).muscles[muscle][kSlack];
  for (std::size_t j = 0; j < model.parameters().free().size(); ++j) {
    for (std::size_t i = 0; i < estimator.free().size(); ++i) {
      if (estimator.free()[i].label == model.parameters().free()[j].label)
        at[static_cast<Eigen::Index>(j)] = z[static_cast<Eigen::Index>(i)];
    }
  }
  Evaluation evaluation;
  model.evaluate(at, ResidualModel::Depth::gradient, evaluation);
  return evaluation.gradient.row(slack);
}

}  // namespace

double held_slack_sd_m(const StudyData& data, std::size_t muscle) {
  const MuscleSetup& setup = data.muscles[muscle];
  double sd_m = 0.0;
  if (const auto known = setup.priors.find(kSlackName); known != setup.priors.end())
    sd_m = known->second.sd * (known->second.logarithmic ? setup.start.tendon_slack_length_m : 1.0);
  if (contains(setup.fixed, kSlackName)) sd_m = 0.0;
  for (const ParameterRule& rule : data.rules) {
    if (!concerns(rule, setup.name)) continue;
    if (rule.prior_sd) {
      sd_m = *rule.prior_sd;
    } else if (rule.value || !rule.free.value_or(true)) {
      sd_m = 0.0;
    }
  }
  return sd_m;
}

Eigen::MatrixXd held_tendon_shift(const Estimator& estimator,
                                  const Estimator::Solution& solution,
                                  const StudyData& data) {
  const Eigen::VectorXd& z = solution.search.x;
  const auto muscles = static_cast<Eigen::Index>(data.muscles.size());
  Eigen::MatrixXd shift = Eigen::MatrixXd::Zero(z.size(), muscles);
  std::vector<std::size_t> unsure;
  for (std::size_t k = 0; k < data.muscles.size() && estimator.options().priors; ++k) {
    const bool unknown = estimator.model().parameters().find(Scope::muscle, kSlack, static_cast<int>(k)) >= 0;
    if (!unknown && held_slack_sd_m(data, k) > 0.0) unsure.push_back(k);
  }
  if (unsure.empty()) return shift;
  Evaluation at;
  estimator.model().evaluate(z, ResidualModel::Depth::gradient, at);
  const Eigen::VectorXd residual =
      (at.predicted - estimator.model().measured()).cwiseQuotient(solution.weighting.sd_nm);
  Eigen::VectorXd weight(residual.size());
  for (Eigen::Index i = 0; i < weight.size(); ++i)
    weight[i] = solution.weighting.share * loss(estimator.options().loss, residual[i]).weight /
                (solution.weighting.sd_nm[i] * solution.weighting.sd_nm[i]);
  for (Eigen::Index j = 0; j < z.size(); ++j) {
    if (solution.search.at_bound[static_cast<std::size_t>(j)]) at.gradient.row(j).setZero();
  }
  const Eigen::MatrixXd weighted = at.gradient * weight.asDiagonal();
  const Eigen::LDLT<Eigen::MatrixXd> factor(with_priors_invertible(weighted * at.gradient.transpose(), estimator));
  for (const std::size_t k : unsure)
    shift.col(static_cast<Eigen::Index>(k)) =
        -held_slack_sd_m(data, k) * factor.solve(weighted * torque_by_slack(estimator, z, data, k).transpose());
  return shift;
}

}  // namespace myoid::identification
