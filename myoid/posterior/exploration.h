#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "myoid/identification/options.h"
#include "myoid/identification/study_data.h"
#include "myoid/posterior/density.h"
#include "myoid/posterior/mode.h"

namespace myoid::identification {

/// A mode of one of the densities, and its weight among all.
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
  double rhat = 1.0, accepted = 1.0;  ///< The worst of the modes (sampler.h).
  bool approximate = false;           ///< The chains of the sampler cannot be relied on.
};

/// The posterior of a study: its modes, the heaviest first, and draws from it.
struct Exploration {
  std::vector<std::unique_ptr<Density>> densities;  ///< With a pure delay, with lags.
  std::vector<Candidate> modes;
  Sample sample;
};

/// Seeks the modes from the starting values, and from others about them where the options ask for
/// several starts, with a pure delay and with lags where the choice is open. Each weighs by its
/// evidence; modes of less than 2 % are left out. The quantities that residuals hardly tell are
/// taken at the mode of the pass before, until it stays. With EstimatorOptions::posterior_draws the
/// draws are of the density (sampler.h), else of its marginals (marginals.h) or, without
/// EstimatorOptions::marginals, of the normal approximation.
[[nodiscard]] Exploration explore(const StudyData& data, const EstimatorOptions& options);

}  // namespace myoid::identification
