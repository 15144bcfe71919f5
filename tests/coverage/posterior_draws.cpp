#include "tests/coverage/posterior_draws.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "myoid/posterior/density.h"
#include "myoid/posterior/importance.h"
#include "myoid/posterior/mode.h"

namespace myoid::test {
namespace {

using namespace identification;

bool same(const Density& density, const Mode& a, const Mode& b) {
  const Eigen::VectorXd off = a.x - b.x;
  return off.dot(density.gauss_newton(a.x) * off) < 0.09 * static_cast<double>(off.size());
}

/// Climbs until the unseen quantities at the top leave it where it is; `reference` is where they
/// are taken at last.
Mode settle(Density& density, bool at_truth, Eigen::VectorXd& reference) {
  Mode mode = find_mode(density, density.start(), {});
  for (int pass = 0; pass < 4 && !at_truth; ++pass) {
    density.refer_to(mode.x);
    reference = density.z_of(mode.x);
    const Mode before = mode;
    mode = find_mode(density, mode.x, {});
    if (same(density, before, mode)) break;
  }
  return mode;
}

}  // namespace

PosteriorDraws posterior_draws(const MadePerson& person, const DrawOptions& options) {
  Density density(person.data, person.options);
  PosteriorDraws result;
  result.reference_z = person.z;
  if (options.reference_is_truth) density.refer_to(density.x_of(person.z, person.noise));
  std::vector<Mode> modes{settle(density, options.reference_is_truth, result.reference_z)};
  Eigen::VectorXd z = density.parameters().start();
  const std::vector<Unknown>& free = density.parameters().free();
  for (std::size_t j = 0; j < free.size(); ++j)
    z[static_cast<Eigen::Index>(j)] +=
        (j * 2654435761U >> 4) % 2 == 0 ? free[j].prior.sd : -free[j].prior.sd;
  Mode other = find_mode(density, density.x_of(z, density.noise_of(density.start())), {});
  result.converged = modes.front().converged;
  if (other.converged && !same(density, modes.front(), other)) modes.push_back(std::move(other));
  if (options.search_from_truth) {
    Mode third = find_mode(density, density.x_of(person.z, person.noise), {});
    double highest = -1e300;
    for (const Mode& mode : modes) highest = std::max(highest, mode.log_density);
    result.gain_from_truth = third.log_density - highest;
    if (third.converged && std::none_of(modes.begin(), modes.end(), [&](const Mode& mode) {
          return same(density, mode, third);
        }))
      modes.push_back(std::move(third));
  }
  double most = -1e300;
  for (Mode& mode : modes) {
    add_curvature(density, mode, {});
    most = std::max(most, mode.log_evidence);
  }
  const auto best = std::max_element(modes.begin(), modes.end(), [](const Mode& a, const Mode& b) {
    return a.log_density < b.log_density;
  });
  result.best_x = best->x;
  result.covariance = best->covariance;
  const Eigen::Index p = density.parameters().size(), all = density.size();
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const Mode& mode = modes[i];
    const double weight = std::exp(mode.log_evidence - most);
    if (weight < 0.02) continue;
    const auto log_density = [&](const Eigen::VectorXd& x) { return density.value(x); };
    const auto wanted = static_cast<Eigen::Index>(std::max(500, options.draws));
    const Draws draws = options.draws > 0
                            ? draw(log_density, mode.x, mode.covariance, wanted, 20 + 10 * i)
                            : draw_normal(mode.x, mode.covariance, wanted, 20 + 10 * i);
    ++result.modes;
    const Eigen::Index before = result.weight.size();
    result.values.conservativeResize(all, before + wanted);
    result.weight.conservativeResize(before + wanted);
    for (Eigen::Index j = 0; j < wanted; ++j) {
      result.values.col(before + j) << density.z_of(draws.x.col(j)), draws.x.col(j).tail(all - p);
      result.weight[before + j] = weight * draws.weight[j];
    }
    result.khat = std::max(result.khat, draws.khat);
    result.approximate = result.approximate || draws.approximate;
  }
  result.weight /= result.weight.sum();
  return result;
}

}  // namespace myoid::test
