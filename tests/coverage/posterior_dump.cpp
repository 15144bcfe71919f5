/// Writes all that the posterior of one made person is a function of, and what the estimator makes
/// of it, as JSON: for emcee_posterior.py.
///
/// usage: posterior_dump PERSON

#include <exception>
#include <string>

#include <fmt/format.h>

#include "myoid/beliefs/beliefs.h"
#include "myoid/identification/parameters.h"
#include "myoid/posterior/density.h"

#include "tests/coverage/made_person.h"
#include "tests/coverage/posterior_draws.h"

namespace myoid::test {
namespace {

using namespace identification;

std::string json(const Eigen::VectorXd& v) {
  std::string text = "[";
  for (Eigen::Index i = 0; i < v.size(); ++i) text += fmt::format("{}{:.17g}", i ? "," : "", v[i]);
  return text + "]";
}

std::string json(const Eigen::MatrixXd& m) {
  std::string text = "[";
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    text += (i ? "," : "") + json(Eigen::VectorXd(m.row(i)));
  return text + "]";
}

void write_run(const TrialRun& run, const Eigen::MatrixXd& unseen) {
  fmt::print(
      "{{\"time\":{},\"length\":{},\"velocity\":{},\"arm\":{},\"measured\":{},\"sd\":{},"
      "\"unseen\":{},\"first\":{},\"stride\":{},\"envelopes\":[",
      json(run.time_s), json(run.length_m), json(run.velocity_mps), json(run.arm_m),
      json(run.measured_nm), json(run.envelope_sd), json(unseen), run.reduction.first(0),
      run.reduction.stride());
  for (std::size_t c = 0; c < run.envelopes.size(); ++c)
    fmt::print("{}{{\"time\":{},\"value\":{},\"share\":{:.17g},\"filter\":{}}}", c ? "," : "",
               json(run.envelopes[c].time_s()), json(run.envelopes[c].samples()),
               run.errors[c].share(), json(run.errors[c].from_white(run.interval_s)));
  fmt::print("]}}");
}

void write(std::uint64_t seed) {
  MadePersonOptions options;
  options.seed = seed;
  options.trials = 3;
  const MadePerson person = made_person(options);
  const PosteriorDraws draws = posterior_draws(person, {.draws = 4000});
  Density density(person.data, person.options);
  Likelihood likelihood(person.data, person.options);
  likelihood.refer_to(draws.reference_z);
  const ParameterMap& map = likelihood.parameters();
  fmt::print("{{\"modes\":{},\"khat\":{:.17g},\"approximate\":{},\"unknowns\":[", draws.modes,
             draws.khat, draws.approximate);
  for (std::size_t j = 0; j < map.free().size(); ++j) {
    const Unknown& u = map.free()[j];
    fmt::print(
        "{}{{\"label\":\"{}\",\"name\":\"{}\",\"owner\":{},\"lower\":{:.17g},"
        "\"upper\":{:.17g},\"mean\":{:.17g},\"sd\":{:.17g},\"logarithmic\":{}}}",
        j ? "," : "", u.label, u.field->name, u.targets.front().owner, u.bounds.lower,
        u.bounds.upper, u.prior.mean, u.prior.sd, u.field->logarithmic);
  }
  fmt::print("],\"common_strength\":{:.17g},\"muscles\":[", beliefs::kCommonStrength.value);
  for (std::size_t k = 0; k < map.held().muscles.size(); ++k) {
    const MuscleValues& m = map.held().muscles[k];
    fmt::print("{}{{\"max_shortening_speed\":{:.17g},\"tendon_slack_length\":{:.17g}}}",
               k ? "," : "", m[kSpeed], m[kSlack]);
  }
  const Unseen& unseen = likelihood.unseen();
  Eigen::VectorXd weight(static_cast<Eigen::Index>(unseen.quantities.size())), model(weight);
  for (Eigen::Index i = 0; i < weight.size(); ++i) {
    weight[i] = unseen.quantities[static_cast<std::size_t>(i)].weight;
    model[i] = unseen.quantities[static_cast<std::size_t>(i)].of_the_model ? 1.0 : 0.0;
  }
  fmt::print("],\"weight\":{},\"of_the_model\":{},\"torque_size\":{:.17g},\"runs\":[", json(weight),
             json(model), likelihood.torque_size_nm());
  for (std::size_t r = 0; r < likelihood.runs().size(); ++r) {
    fmt::print("{}", r ? "," : "");
    write_run(likelihood.runs()[r], unseen.columns[r]);
  }
  const Eigen::VectorXd mean = draws.values * draws.weight;
  const Eigen::VectorXd sd =
      ((draws.values.colwise() - mean).cwiseAbs2() * draws.weight).cwiseSqrt();
  density.refer_to(density.x_of(draws.reference_z, density.noise_of(draws.best_x)));
  fmt::print(
      "],\"mean\":{},\"sd\":{},\"best_x\":{},\"covariance\":{},\"density_at_best\":{:.17g},"
      "\"effective\":{:.17g}}}\n",
      json(mean), json(sd), json(draws.best_x), json(draws.covariance), density.value(draws.best_x),
      1.0 / draws.weight.squaredNorm());
}

}  // namespace
}  // namespace myoid::test

int main(int argc, char** argv) {
  try {
    myoid::test::write(argc > 1 ? std::stoull(argv[1]) : 1);
  } catch (const std::exception& error) {
    fmt::print(stderr, "posterior_dump: {}\n", error.what());
    return 2;
  }
  return 0;
}
