/// Writes all that the posterior of one made person is a function of, and the estimator's draws
/// from it, as JSON: for emcee_posterior.py.
///
/// usage: posterior_dump PERSON [DRAWS]     DRAWS: by Hamiltonian Monte Carlo; 0: the approximation

#include <exception>
#include <string>

#include <fmt/format.h>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/fit/measurement/parameters.h"
#include "myoid/fit/posterior/exploration.h"

#include "tests/coverage/made_person.h"

namespace myoid::test {
namespace {

using namespace fit;

std::string json(const Eigen::VectorXd& v) {
  std::string text = "[";
  for (Eigen::Index i = 0; i < v.size(); ++i) text += fmt::format("{}{:.17g}", i ? "," : "", v[i]);
  return text + "]";
}

std::string json(const Eigen::MatrixXd& m) {
  std::string text = "[";
  for (Eigen::Index i = 0; i < m.rows(); ++i) text += (i ? "," : "") + json(Eigen::VectorXd(m.row(i)));
  return text + "]";
}

void write_run(const TrialRun& run, const Eigen::MatrixXd& unseen, const Eigen::MatrixXd& by_slope) {
  fmt::print(
      "{{\"time\":{},\"length\":{},\"velocity\":{},\"arm\":{},\"measured\":{},\"sd\":{},"
      "\"unseen\":{},\"by_slope\":{},\"trial\":{},\"first\":{},\"stride\":{},\"envelopes\":[",
      json(run.time_s), json(run.length_m), json(run.velocity_mps), json(run.arm_m), json(run.measured_nm),
      json(run.envelope_sd), json(unseen), json(by_slope), run.trial, run.reduction.first(0), run.reduction.stride());
  for (std::size_t c = 0; c < run.envelopes.size(); ++c)
    fmt::print("{}{{\"time\":{},\"value\":{},\"share\":{:.17g},\"filter\":{}}}", c ? "," : "",
               json(run.envelopes[c].time_s()), json(run.envelopes[c].samples()), run.errors[c].share(),
               json(run.errors[c].from_white(run.interval_s)));
  fmt::print("]}}");
}

void write(std::uint64_t seed, int draws) {
  MadePersonOptions made;
  made.seed = seed;
  made.trials = 3;
  made.seconds = 8.0;
  made.two_muscles = true;
  const MadePerson person = made_person(made);
  EstimatorOptions options = person.options;
  options.posterior_draws = draws;
  options.choose_lag = false;
  const Exploration explored = explore(person.data, options);
  const Mode& best = explored.modes.front().mode;
  Density density = *explored.modes.front().density;
  density.integrate_unlikeness();
  const Likelihood& likelihood = density.likelihood();
  const ParameterMap& map = likelihood.parameters();
  fmt::print("{{\"modes\":{},\"rhat\":{:.17g},\"approximate\":{},\"unknowns\":[", explored.modes.size(),
             explored.sample.rhat, explored.sample.approximate);
  for (std::size_t j = 0; j < map.free().size(); ++j) {
    const Unknown& u = map.free()[j];
    fmt::print(
        "{}{{\"label\":\"{}\",\"name\":\"{}\",\"owner\":{},\"lower\":{:.17g},"
        "\"upper\":{:.17g},\"mean\":{:.17g},\"sd\":{:.17g},\"common_sd\":{:.17g},\"logarithmic\":{},\"judgment\":{}}}",
        j ? "," : "", u.label, u.field->name, u.targets.front().owner, u.bounds.lower, u.bounds.upper, u.prior.mean,
        u.prior.sd, u.common_sd, u.field->logarithmic, spread_is_judgment(u));
  }
  fmt::print("],\"independent_rows\":{:.17g},\"muscles\":[", options.unseen.independent_rows);
  for (std::size_t k = 0; k < map.held().muscles.size(); ++k) {
    const MuscleValues& m = map.held().muscles[k];
    fmt::print("{}{{\"max_shortening_speed\":{:.17g},\"tendon_slack_length\":{:.17g}}}", k ? "," : "", m[kSpeed],
               m[kSlack]);
  }
  const Unseen& unseen = likelihood.unseen();
  Eigen::VectorXd weight(static_cast<Eigen::Index>(unseen.quantities.size())), size(weight);
  for (Eigen::Index i = 0; i < weight.size(); ++i) {
    weight[i] = unseen.quantities[static_cast<std::size_t>(i)].weight;
    size[i] = unseen.quantities[static_cast<std::size_t>(i)].size.value_or(NoiseField{-1});
  }
  Eigen::MatrixXd slopes(static_cast<Eigen::Index>(unseen.slopes.size()), 3);
  for (Eigen::Index s = 0; s < slopes.rows(); ++s) {
    const Unseen::Slope& of = unseen.slopes[static_cast<std::size_t>(s)];
    slopes.row(s) << static_cast<double>(of.quantity), static_cast<double>(of.unknown), of.reach;
  }
  fmt::print(
      "],\"weight\":{},\"size\":{},\"growth\":{},\"slopes\":{},\"reference\":{},"
      "\"torque_size\":{:.17g},"
      "\"runs\":[",
      json(weight), json(size), json(unseen.growth), json(slopes), json(likelihood.reference()),
      likelihood.torque_size_nm());
  for (std::size_t r = 0; r < likelihood.runs().size(); ++r) {
    fmt::print("{}", r ? "," : "");
    write_run(likelihood.runs()[r], unseen.columns[r], unseen.by_slope[r]);
  }
  const Sample& sample = explored.sample;
  Eigen::MatrixXd values(sample.z.rows() + sample.noise.rows(), sample.z.cols());
  values << sample.z, sample.noise;
  const Eigen::VectorXd mean = values * sample.weight;
  const Eigen::VectorXd sd = ((values.colwise() - mean).cwiseAbs2() * sample.weight).cwiseSqrt();
  fmt::print("],\"mean\":{},\"sd\":{},\"best_x\":{},\"covariance\":{},\"density_at_best\":{:.17g}}}\n", json(mean),
             json(sd), json(best.x), json(best.covariance), density.value(best.x));
}

}  // namespace
}  // namespace myoid::test

int main(int argc, char** argv) {
  try {
    myoid::test::write(argc > 1 ? std::stoull(argv[1]) : 1, argc > 2 ? std::stoi(argv[2]) : 0);
  } catch (const std::exception& error) {
    fmt::print(stderr, "posterior_dump: {}\n", error.what());
    return 2;
  }
  return 0;
}
