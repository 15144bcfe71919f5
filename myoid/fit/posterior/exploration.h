#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/fit/posterior/density.h"
#include "myoid/fit/posterior/mode.h"

namespace myoid::fit {

/// A mode of one of the densities, and its share of the weight of all modes.
struct Candidate {
  const Density* density = nullptr;
  EmgLag lag = EmgLag::delay;
  Mode mode;
  double weight = 0.0;
};

/// Draws of z and of the hyperparameters, one column each, from all modes.
struct Sample {
  Eigen::MatrixXd z;      ///< unknowns x draws
  Eigen::MatrixXd noise;  ///< NoiseValues x draws
  Eigen::VectorXd weight;
  Eigen::Index of_best = 0;           ///< The first draws are about the heaviest mode.
  double rhat = 1.0, accepted = 1.0;  ///< The worst value among the modes (sampler.h).
  bool approximate = false;           ///< The sampler's chains cannot be relied on.
};

/// The posterior of a study: its modes, the heaviest first, and draws from it.
struct Exploration {
  std::vector<std::unique_ptr<Density>> densities;  ///< One with a pure delay, one with lags.
  std::vector<Candidate> modes;
  Sample sample;
};

/// Finds the modes of the posterior and draws from it. Searches begin at the starting values and at others about them
/// (three; none without `marginals`), with a pure delay and with lags where the choice is
/// open. A mode weighs by its evidence; modes of less than 2 % are left out. The unseen quantities (unseen.h) are taken
/// at the mode of the previous pass until the mode stays. The draws are from the density with
/// EstimatorOptions::posterior_draws (sampler.h), else from its marginals (marginals.h) or, without
/// EstimatorOptions::marginals, from the normal approximation. With EstimatorOptions::begin_at the search takes that
/// fit's lag and goes to the mode next to its answer.
[[nodiscard]] Exploration explore(const StudyData& data, const EstimatorOptions& options);

}  // namespace myoid::fit
