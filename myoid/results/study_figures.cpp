#include "myoid/results/study_figures.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/muscle/hill_muscle.h"

namespace myoid {
namespace {

using identification::IdentificationResult;
using report::Figure;
using report::Panel;
using report::Role;
using report::to_vector;

/// The literature's numbers with those of the truth in their place; empty without a truth.
std::optional<muscle::HillParameters<double>> true_muscle(
    const StudyResult& result, const identification::MuscleSetup& setup) {
  std::optional<muscle::HillParameters<double>> muscle;
  for (const TrueValue& t : result.source.truth) {
    if (t.muscle != setup.name) continue;
    for (const muscle::HillField& field : muscle::kHillFields) {
      if (field.name != t.parameter) continue;
      if (!muscle) muscle = setup.start;
      (*muscle).*field.member = t.value;
    }
  }
  return muscle;
}

}  // namespace

Figure muscle_curves(const StudyResult& result, const IdentificationResult& method, std::size_t m) {
  const auto& setup = result.fit_input.data.muscles[m];
  const auto& found = method.muscles[m];
  Figure figure{
      "curves_" + setup.name,
      fmt::format("{}: force-length and force-velocity relations", setup.name),
      "Grey dotted: literature; orange dashed: identified; thin black: the truth of a virtual "
      "recording. The shaded range is what the recording visited.",
      {},
      2};
  double low = 1e9;
  double high = -1e9;
  double fastest = 0.05;
  for (const auto& trial : result.fit_input.data.trials) {
    const auto c = static_cast<Eigen::Index>(m);
    low = std::min(low, trial.length_m.col(c).minCoeff() - setup.start.tendon_slack_length_m);
    high = std::max(high, trial.length_m.col(c).maxCoeff() - setup.start.tendon_slack_length_m);
    fastest = std::max(fastest, trial.velocity_mps.col(c).cwiseAbs().maxCoeff());
  }
  const auto sample = [](double from, double to, auto f) {
    std::pair<std::vector<double>, std::vector<double>> xy;
    for (int i = 0; i <= 160; ++i) {
      const double x = from + (to - from) * i / 160.0;
      xy.first.push_back(x);
      xy.second.push_back(f(x));
    }
    return xy;
  };
  const double l0 = setup.start.optimal_fiber_length_m;
  const double span = 1.6 * setup.start.force_length_width_m;
  Panel length{"", {"fiber length", "m", {}, {}, {}}, {"force / (a F_max)", "", {}, {}, {}}, {}};
  length.series.push_back({"visited", {low, high}, {0.0, 0.0}, Role::band, {}, {1.0, 1.0}});
  const auto [lx, ly] = sample(l0 - span, l0 + span, [&](double x) {
    return muscle::force_length(x, setup.start.optimal_fiber_length_m,
                                setup.start.force_length_width_m);
  });
  length.series.push_back({"literature", lx, ly, Role::literature, {}, {}});
  const auto [ix, iy] = sample(l0 - span, l0 + span, [&](double x) {
    return muscle::force_length(x, found.optimal_fiber_length_m, found.force_length_width_m);
  });
  length.series.push_back({"identified", ix, iy, Role::identified, {}, {}});
  const auto truth = true_muscle(result, setup);
  if (truth) {
    const auto [tx, ty] = sample(l0 - span, l0 + span, [&](double x) {
      return muscle::force_length(x, truth->optimal_fiber_length_m, truth->force_length_width_m);
    });
    length.series.push_back({"truth", tx, ty, Role::truth, {}, {}});
  }
  const double v = setup.start.max_shortening_speed_mps;
  Panel velocity{"",
                 {"fiber velocity (lengthening positive)", "m/s", {}, {}, {}},
                 {"force / isometric force", "", {}, {}, {}},
                 {}};
  double highest = std::max(setup.start.eccentric_plateau, found.eccentric_plateau);
  if (truth) highest = std::max(highest, truth->eccentric_plateau);
  velocity.series.push_back(
      {"visited", {-fastest, fastest}, {0.0, 0.0}, Role::band, {}, {highest, highest}});
  const auto multiplier = [&](const muscle::HillParameters<double>& p) {
    return sample(-v, v, [&](double x) {
      return muscle::force_velocity(p.velocity_law(), x / p.max_shortening_speed_mps).value;
    });
  };
  const auto [vx, vy] = multiplier(setup.start);
  velocity.series.push_back({"literature", vx, vy, Role::literature, {}, {}});
  const auto [wx, wy] = multiplier(found);
  velocity.series.push_back({"identified", wx, wy, Role::identified, {}, {}});
  if (truth) {
    const auto [tx, ty] = multiplier(*truth);
    velocity.series.push_back({"truth", tx, ty, Role::truth, {}, {}});
  }
  figure.panels = {length, velocity};
  return figure;
}

Figure emg_figure(const TrialResult& trial, const std::vector<std::string>& chain) {
  Figure figure{"emg_" + trial.spec.name,
                fmt::format("EMG of trial {}: raw, rectified, filtered", trial.spec.name),
                "Millivolts; the orange line is the envelope.",
                {},
                2,
                chain};
  const TimeSeries& raw = trial.emg.stages->raw;
  const TimeSeries& rectified = trial.emg.stages->rectified;
  const TimeSeries& envelope = trial.emg.stages->envelope;
  for (std::size_t c = 0; c < raw.channels().size(); ++c) {
    const auto column = static_cast<Eigen::Index>(c);
    const std::vector<double> t = to_vector(raw.time_s());
    Panel left{raw.channels()[c].name, {"time", "s", {}, {}, {}}, {"EMG", "mV", {}, {}, {}}, {}};
    left.series.push_back({"raw, mean removed",
                           t,
                           to_vector(1e3 * raw.values().col(column)),
                           Role::reference,
                           {},
                           {}});
    Panel right{
        raw.channels()[c].name, {"time", "s", {}, {}, {}}, {"rectified EMG", "mV", {}, {}, {}}, {}};
    right.series.push_back(
        {"rectified", t, to_vector(1e3 * rectified.values().col(column)), Role::raw, {}, {}});
    right.series.push_back(
        {"envelope", t, to_vector(1e3 * envelope.values().col(column)), Role::identified, {}, {}});
    figure.panels.push_back(left);
    figure.panels.push_back(right);
  }
  return figure;
}

Figure force_figure(const StudyResult& result,
                    const identification::TrialData& data,
                    const IdentificationResult& method) {
  const auto fit = std::find_if(method.trials.begin(), method.trials.end(),
                                [&](const auto& t) { return t.trial == data.name; });
  Figure figure{
      fmt::format("forces_{}_{}", method.method, data.name),
      fmt::format("Muscle forces in trial {} (method {})", data.name, method.method),
      "Blue: force that force sharing assigns (no co-contraction). Grey dotted: literature's "
      "parameters with the measured EMG. Orange dashed: identified parameters.",
      {},
      2};
  const std::vector<double> t = to_vector(data.time_s);
  for (std::size_t m = 0; m < result.fit_input.data.muscles.size(); ++m) {
    const auto c = static_cast<Eigen::Index>(m);
    const Eigen::VectorXd error = fit->force_fit_n.col(c) - data.force_n.col(c);
    const bool finite = error.allFinite();
    Panel panel{
        finite ? fmt::format("{}: identified against shared {:.0f} N rms",
                             result.fit_input.data.muscles[m].name,
                             std::sqrt(error.squaredNorm() / static_cast<double>(error.size())))
               : result.fit_input.data.muscles[m].name,
        {"time", "s", {}, {}, {}},
        {"force", "N", {}, {}, {}},
        {}};
    panel.series.push_back({"shared", t, to_vector(data.force_n.col(c)), Role::reference, {}, {}});
    panel.series.push_back(
        {"literature", t, to_vector(fit->literature_force_n.col(c)), Role::literature, {}, {}});
    if (finite)
      panel.series.push_back(
          {"identified", t, to_vector(fit->force_fit_n.col(c)), Role::identified, {}, {}});
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace myoid
