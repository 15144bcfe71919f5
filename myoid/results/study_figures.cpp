#include "myoid/results/study_figures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/index.h"
#include "myoid/muscle/hill_muscle.h"
#include "myoid/run/log_covariance.h"
#include "myoid/study/study_ids.h"

namespace myoid::results {
namespace {

using fit::IdentificationResult;
using page::Figure;
using page::Panel;
using page::Role;
using page::time_panel;
using page::to_vector;

/// Returns the literature's parameters with the true ones substituted; empty without a truth.
std::optional<muscle::HillParameters<double>> true_muscle(const run::StudyResult& result,
                                                          const fit::MuscleSetup& setup) {
  std::optional<muscle::HillParameters<double>> muscle;
  for (const run::TrueValue& t : result.source.truth) {
    if (t.muscle != setup.name) continue;
    for (const muscle::HillField& field : muscle::kHillFields) {
      if (field.name != t.parameter) continue;
      if (!muscle) muscle = setup.start;
      (*muscle).*field.member = t.value;
    }
  }
  return muscle;
}

using muscle::HillParameters;
using Curve = std::function<double(double x, const HillParameters<double>& muscle)>;

/// One muscle by every set of parameters: literature, identified and, in a virtual recording, true.
struct MuscleVersions {
  HillParameters<double> literature, identified;
  std::optional<HillParameters<double>> truth;
  /// Covariance of the logarithms of the identified parameters, in the order of muscle::kHillFields.
  Eigen::MatrixXd log_covariance;
};

page::Series sampled(
    std::string name, Role role, double from, double to, const Curve& curve, const HillParameters<double>& muscle) {
  page::Series series{.name = std::move(name), .role = role};
  for (int i = 0; i <= 160; ++i) {
    const double x = from + (to - from) * i / 160.0;
    series.x.push_back(x);
    series.y.push_back(curve(x, muscle));
  }
  return series;
}

/// Returns the curve's 95 % band to first order, for muscles with a standard error: f -+ 1.96
/// sqrt(g' C g), g = df / d ln x, C the covariance of the logarithms. Never below 0.
page::Series band_of(const MuscleVersions& of, double from, double to, const Curve& curve) {
  constexpr double kStep = 1e-4;  // of the logarithm
  page::Series band = sampled("identified, 95 %", Role::band, from, to, curve, of.identified);
  for (std::size_t i = 0; i < band.x.size(); ++i) {
    Eigen::VectorXd slope(of.log_covariance.rows());
    for (Eigen::Index k = 0; k < slope.size(); ++k) {
      const auto member = muscle::kHillFields[static_cast<std::size_t>(k)].member;
      HillParameters<double> less = of.identified, more = of.identified;
      less.*member *= std::exp(-kStep);
      more.*member *= std::exp(kStep);
      slope[k] = (curve(band.x[i], more) - curve(band.x[i], less)) / (2.0 * kStep);
    }
    const double half = 1.96 * std::sqrt(std::max(0.0, slope.dot(of.log_covariance * slope)));
    band.y_upper.push_back(band.y[i] + half);
    band.y[i] = std::max(0.0, band.y[i] - half);
  }
  return band;
}

/// Adds the curve of every version of the muscle between two abscissas.
void add_curves(Panel& panel, const MuscleVersions& of, double from, double to, const Curve& curve) {
  if (of.log_covariance.diagonal().sum() > 0.0) panel.series.push_back(band_of(of, from, to, curve));
  panel.series.push_back(sampled("literature", Role::literature, from, to, curve, of.literature));
  panel.series.push_back(sampled("identified", Role::identified, from, to, curve, of.identified));
  if (of.truth) panel.series.push_back(sampled("truth", Role::truth, from, to, curve, *of.truth));
}

/// Fiber lengths and the greatest speed of one muscle over all trials.
struct VisitedRange {
  double low_m = 1e9, high_m = -1e9, fastest_mps = 0.05;
};

VisitedRange visited(const fit::StudyData& data, std::size_t m) {
  const double slack_m = data.muscles[m].start.tendon_slack_length_m;
  const auto c = static_cast<Eigen::Index>(m);
  VisitedRange range;
  for (const auto& trial : data.trials) {
    range.low_m = std::min(range.low_m, trial.length_m.col(c).minCoeff() - slack_m);
    range.high_m = std::max(range.high_m, trial.length_m.col(c).maxCoeff() - slack_m);
    range.fastest_mps = std::max(range.fastest_mps, trial.velocity_mps.col(c).cwiseAbs().maxCoeff());
  }
  return range;
}

Panel length_panel(const MuscleVersions& of, const VisitedRange& range) {
  Panel panel{.title = "",
              .x = {.label = "fiber length", .unit = "m"},
              .y = {.label = "force / (a F_max)"},
              .series = {{"visited", {range.low_m, range.high_m}, {0.0, 0.0}, Role::range, {}, {1.0, 1.0}}}};
  const double l0 = of.literature.optimal_fiber_length_m;
  const double span = 1.6 * of.literature.force_length_width_m;
  add_curves(panel, of, l0 - span, l0 + span, [](double x, const auto& muscle) {
    return muscle::force_length(x, muscle.optimal_fiber_length_m, muscle.force_length_width_m);
  });
  return panel;
}

Panel velocity_panel(const MuscleVersions& of, const VisitedRange& range) {
  Panel panel{.title = "",
              .x = {.label = "fiber velocity (lengthening positive)", .unit = "m/s"},
              .y = {.label = "force / isometric force"}};
  double highest = std::max(of.literature.eccentric_plateau, of.identified.eccentric_plateau);
  if (of.truth) highest = std::max(highest, of.truth->eccentric_plateau);
  panel.series.push_back(
      {"visited", {-range.fastest_mps, range.fastest_mps}, {0.0, 0.0}, Role::range, {}, {highest, highest}});
  const double v = of.literature.max_shortening_speed_mps;
  add_curves(panel, of, -v, v, [](double x, const auto& muscle) {
    return muscle::force_velocity(muscle.velocity_law(), x / muscle.max_shortening_speed_mps).value;
  });
  return panel;
}

}  // namespace

Figure muscle_curves(const run::StudyResult& result, const IdentificationResult& method, std::size_t m) {
  const auto& setup = result.fit_input.data.muscles[m];
  std::vector<std::string> names;
  for (const muscle::HillField& field : muscle::kHillFields) names.emplace_back(field.name);
  const MuscleVersions of{.literature = setup.start,
                          .identified = method.muscles[m],
                          .truth = true_muscle(result, setup),
                          .log_covariance = run::log_covariance(method, setup.name, names)};
  const VisitedRange range = visited(result.fit_input.data, m);
  Figure figure{"curves_" + setup.name,
                fmt::format("{}: force-length and force-velocity relations", setup.name),
                "The band is from the standard errors; the recording covers the shaded range.",
                {length_panel(of, range), velocity_panel(of, range)},
                2};
  figure.bad =
      "The shaded range covers a small part of the curve: outside of it the curve is the law's shape and the "
      "literature's number. The band is as wide as the curve is high. The curve is far narrower than the literature's.";
  figure.act =
      "Read the curve inside of the shaded range only. Record other joint angles to widen the range of lengths, and "
      "faster movements to widen the range of velocities.";
  return figure;
}

Figure emg_figure(const run::TrialResult& trial, const std::vector<std::string>& chain) {
  Figure figure{"emg_" + trial.spec.name,
                fmt::format("EMG of trial {}: raw, rectified, filtered", trial.spec.name),
                "Millivolts; the orange line is the envelope.",
                {},
                2,
                chain};
  figure.in_workbench = true;
  const TimeSeries& raw = trial.emg.stages->raw;
  const TimeSeries& rectified = trial.emg.stages->rectified;
  const TimeSeries& envelope = trial.emg.stages->envelope;
  const std::vector<double> t = to_vector(raw.time_s());
  for (Eigen::Index c = 0; c < raw.channel_count(); ++c) {
    const auto millivolts = [&](const TimeSeries& volts) { return to_vector(1e3 * volts.values().col(c)); };
    Panel left = time_panel(raw.channels()[at(c)].name, "EMG", "mV");
    left.series = {{"raw, mean removed", t, millivolts(raw), Role::reference}};
    Panel right = time_panel(raw.channels()[at(c)].name, "rectified EMG", "mV");
    right.series = {{"rectified", t, millivolts(rectified), Role::raw},
                    {"envelope", t, millivolts(envelope), Role::identified}};
    figure.panels.insert(figure.panels.end(), {left, right});
  }
  return figure;
}

Figure force_figure(const run::StudyResult& result, const fit::TrialData& data, const IdentificationResult& method) {
  const fit::TrialFit* fit = run::trial_of(method, data.name);
  Figure figure{fmt::format("forces_{}_{}", name(method.method), study::trial_ids(result.source.study).of(data.name)),
                fmt::format("Muscle forces in trial {} (method {})", data.name, name(method.method)),
                "Blue: force that force sharing assigns (no co-contraction). Grey dotted: literature's parameters with "
                "the measured EMG. Orange dashed: identified parameters.",
                {},
                2};
  figure.in_workbench = true;
  const std::vector<double> t = to_vector(data.time_s);
  for (std::size_t m = 0; m < result.fit_input.data.muscles.size(); ++m) {
    const auto c = static_cast<Eigen::Index>(m);
    const Eigen::VectorXd error = fit->force_fit_n.col(c) - data.force_n.col(c);
    const bool finite = error.allFinite();
    Panel panel = time_panel(result.fit_input.data.muscles[m].name, "force", "N");
    panel.series = {{"shared", t, to_vector(data.force_n.col(c)), Role::reference},
                    {"literature", t, to_vector(fit->literature_force_n.col(c)), Role::literature}};
    if (finite) {
      panel.title += fmt::format(": identified against shared {:.0f} N rms",
                                 std::sqrt(error.squaredNorm() / static_cast<double>(error.size())));
      panel.series.push_back({"identified", t, to_vector(fit->force_fit_n.col(c)), Role::identified});
    }
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace myoid::results
