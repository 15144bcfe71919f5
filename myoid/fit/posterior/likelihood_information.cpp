#include <cmath>

#include "myoid/fit/posterior/likelihood.h"
#include "myoid/fit/posterior/likelihood_block.h"

namespace myoid::fit {

Likelihood::Information Likelihood::information(const Eigen::VectorXd& z, const NoiseValues& noise) const {
  const Point point(map_, z);
  const AllRuns all = all_runs(z, noise);
  const Eigen::Index p = map_.size();
  Information result{Eigen::MatrixXd::Zero(p, p),
                     std::vector<Eigen::MatrixXd>(kSourceCount, Eigen::MatrixXd::Zero(p, p))};
  const std::vector<Block> blocks = filled(point.values, &point.by_owner, all, noise);
  std::vector<Eigen::MatrixXd> white(runs_.size());  // C^-1 L J
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    if (!blocks[r].positive) return result;
    white[r] = blocks[r].whitening * runs_[r].reduction.apply(blocks[r].evaluation->jacobian(p));
  }
  const Eigen::MatrixXd shared = all.joined(blocks).solve(white);  // = (S W)' Sigma^-1 J
  const auto of = [&](Source source) -> Eigen::MatrixXd& { return result.by_source[static_cast<std::size_t>(source)]; };
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const Eigen::MatrixXd k = blocks[r].whitening.transpose() * (white[r] - blocks[r].unseen_half * shared);
    const Eigen::MatrixXd envelopes =
        (envelope_covariance(r, blocks[r].evaluation->signals(), noise, false) + without_emg_[r]) / row_weight_[r];
    const Eigen::MatrixXd a = blocks[r].factor.reconstructedMatrix();
    of(Source::electrodes) += k.transpose() * envelopes * k;
    of(Source::noise) += k.transpose() * (a - envelopes) * k;
  }
  for (int source = 0; source < kSourceCount; ++source) {
    std::vector<Eigen::Index> its;
    for (std::size_t i = 0; i < unseen_.quantities.size(); ++i)
      if (unseen_.quantities[i].source == static_cast<Source>(source)) its.push_back(static_cast<Eigen::Index>(i));
    const Eigen::MatrixXd rows = shared(its, Eigen::all);
    of(static_cast<Source>(source)).noalias() += rows.transpose() * rows;
  }
  for (const Eigen::MatrixXd& part : result.by_source) result.information += part;
  return result;
}

std::vector<Eigen::MatrixXd> Likelihood::information_by_trial(const Eigen::VectorXd& z,
                                                              const NoiseValues& noise) const {
  const Point point(map_, z);
  const AllRuns all = all_runs(z, noise);
  const Eigen::VectorXd& w = all.weights;
  const Eigen::Index p = map_.size();
  const std::vector<Block> blocks = filled(point.values, &point.by_owner, all, noise);
  std::vector<Eigen::MatrixXd> found;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    if (r == 0 || runs_[r].trial != runs_[r - 1].trial)
      found.emplace_back(Eigen::MatrixXd::Zero(p + w.size(), p + w.size()));
    if (!blocks[r].positive) continue;
    Eigen::MatrixXd both(blocks[r].unseen.rows(), p + w.size());
    both << runs_[r].reduction.apply(blocks[r].evaluation->jacobian(p)), blocks[r].unseen;
    found.back() += both.transpose() * blocks[r].factor.solve(both);
  }
  return found;
}

Likelihood::UnseenGiven Likelihood::unseen_given(const Eigen::VectorXd& z, const NoiseValues& noise) const {
  const Point point(map_, z);
  const AllRuns all = all_runs(z, noise);
  std::vector<Block> blocks = filled(point.values, &point.by_owner, all, noise);
  std::vector<Eigen::MatrixXd> white(runs_.size());  // C^-1 [r, L J]
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    white[r].setZero(runs_[r].measured_count(), 1 + map_.size());
    if (blocks[r].positive)
      white[r] << blocks[r].white,
          blocks[r].whitening * runs_[r].reduction.apply(blocks[r].evaluation->jacobian(map_.size()));
    else
      blocks[r].unseen_half.setZero(white[r].rows(), all.weights.size());
  }
  const math::Woodbury joined = all.joined(blocks);
  const Eigen::MatrixXd solved = joined.solve(white);
  return {solved.col(0), joined.inverse(), -solved.rightCols(map_.size())};
}

Likelihood::RunForecast Likelihood::forecast(const TrialRun& run,
                                             const Eigen::VectorXd& z,
                                             const NoiseValues& noise,
                                             const UnseenGiven& unseen) const {
  const Point point(map_, z);
  std::vector<RunEvaluation> at;
  at.emplace_back(run, map_, options_.law, point.values, &point.by_owner);
  const RunEvaluation& here = at.front();
  const Eigen::MatrixXd columns =
      unseen_quantities(data_, options_, map_, recorded_, {run}, point.values, at).columns.front() *
      weights(noise).asDiagonal();
  RunForecast of;
  const Eigen::VectorXd mean = here.signals().all() + columns * unseen.mean;
  of.mean_nm = mean.head(run.row_count());
  of.fiber_m = mean.tail(run.all_rows() - run.row_count());
  of.by_z = (here.jacobian(map_.size()) + columns * unseen.by_z).topRows(run.row_count());
  of.variance_nm2 = (columns * unseen.covariance).cwiseProduct(columns).rowwise().sum().head(run.row_count());
  for (std::size_t j = 0; j < run.joints.size(); ++j)
    of.variance_nm2.segment(run.first_row(j), run.time_s.size()).array() +=
        std::exp(2.0 * noise[kTorqueSd]) * std::pow(recorded_.size_share(run.joints[j]), 2);
  of.variance_nm2 += here.signals().by_noise.cwiseAbs2() * envelope_scale(run, noise);
  for (std::size_t j = 0; j < run.joints.size(); ++j) {
    const Eigen::Index first = run.first_row(j);
    if (options_.angle_sd_rad > 0.0 || options_.angle_rate_sd_radps > 0.0)
      of.variance_nm2.segment(first, run.time_s.size()) += motion_variance(run, here, first, first);
  }
  of.force_n.resize(run.time_s.size(), run.arm_m.cols());
  for (std::size_t k = 0; k < data_.muscles.size(); ++k) {
    const MuscleRows& rows = here.muscle(k);
    of.force_n.col(static_cast<Eigen::Index>(k)) = rows.force_n;
    Eigen::MatrixXd& by_z = of.force_by_z.emplace_back(Eigen::MatrixXd::Zero(run.time_s.size(), map_.size()));
    for (std::size_t v = 0; v < rows.variables.size(); ++v)
      by_z.col(rows.variables[v]) += rows.by_variable.row(static_cast<Eigen::Index>(v)).transpose();
  }
  return of;
}

Likelihood::ActiveTorque Likelihood::active_torque(const TrialRun& run,
                                                   const Eigen::VectorXd& z,
                                                   const NoiseValues& noise) const {
  const Point point(map_, z);
  const ModelValues reference = map_.values(reference_);
  const auto of_all = [&](const TrialRun& here) {
    const RunEvaluation evaluation(here, map_, options_.law, point.values, &point.by_owner);
    std::vector<RunEvaluation> at;
    at.emplace_back(here, map_, options_.law, reference, nullptr);
    return ActiveTorque{evaluation.signals().torque_nm, evaluation.jacobian(map_.size()),
                        unseen_quantities(data_, options_, map_, recorded_, {here}, reference, at).columns.front()};
  };
  // Muscles without moment arms leave the joint's own torque.
  TrialRun bare = run;
  bare.arm_m.setZero();
  ActiveTorque found = of_all(run);
  const ActiveTorque of_joint = of_all(bare);
  found.torque_nm -= of_joint.torque_nm;
  found.by_z -= of_joint.by_z;
  found.by_unseen -= of_joint.by_unseen;
  Eigen::VectorXd weight = weights(noise);
  for (std::size_t i = 0; i < unseen_.quantities.size(); ++i)
    if (unseen_.quantities[i].source == Source::torque_scale) weight[static_cast<Eigen::Index>(i)] = 0.0;
  found.by_unseen = (found.by_unseen * weight.asDiagonal()).eval();
  return found;
}

Likelihood::Residuals Likelihood::residuals(const Eigen::VectorXd& z, const NoiseValues& noise) const {
  const ModelValues values = map_.values(z);
  const AllRuns all = all_runs(z, noise);
  Eigen::VectorXd expected = all.weights.cwiseProduct(unseen_given(z, noise).mean);
  for (std::size_t i = 0; i < unseen_.quantities.size(); ++i)
    if (unseen_.quantities[i].size == kModelErrorSize) expected[static_cast<Eigen::Index>(i)] = 0.0;
  Residuals result{Eigen::VectorXd(rows_), Eigen::VectorXd(rows_),
                   std::vector<std::vector<Eigen::Index>>(map_.joints().size())};
  Eigen::Index first = 0;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const RunEvaluation evaluation(runs_[r], map_, options_.law, values, nullptr);
    const Eigen::Index m = runs_[r].measured_nm.size();
    result.measured_nm.segment(first, m) = runs_[r].measured_nm;
    result.predicted_nm.segment(first, m) =
        runs_[r].reduction.apply(evaluation.signals().torque_nm) + (turned_columns(r, all) * expected).head(m);
    for (Eigen::Index i = 0; i < m; ++i) {
      const auto j = static_cast<std::size_t>(i / runs_[r].reduction.outputs());
      result.rows_of_joint[static_cast<std::size_t>(runs_[r].joints[j])].push_back(first + i);
    }
    first += m;
  }
  return result;
}

}  // namespace myoid::fit
