#include "myoid/program/steps/muscle_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/fit/intervals/verdicts.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/muscle/held_stretch.h"
#include "myoid/muscle/isolated_checks.h"
#include "myoid/program/steps/muscle_input.h"

namespace myoid::program {
namespace {

using muscle::HeldStretch;
using muscle::IsolatedEstimate;
using muscle::IsolatedFit;
using muscle::IsolatedModel;
using muscle::IsolatedRecording;
using Recordings = std::vector<IsolatedRecording>;

/// Widens each standard error to the spread over fits without one recording (jackknife), and warns
/// of numbers that one recording decides.
void compare_left_out(const Recordings& recordings, MuscleFit& fit, Remarks& remarks) {
  for (const muscle::DecidedByOne& found : widen_to_jackknife(fit.all, fit.without_one)) {
    const IsolatedEstimate& e = fit.all.estimates[found.parameter];
    remarks.warn(fmt::format(
        "{} is {:.4g} {} without {}, {:.1f} of the fit's standard errors from {:.4g}: it hangs on that recording; its "
        "standard error is widened to the spread over the recordings",
        e.parameter, found.without, symbol(e.unit), recordings[found.recording].name, found.std_errors, e.value));
  }
}

/// Warns of a search that left its start nowhere, of a better minimum elsewhere, and of parameters without an effect.
void warn_of_untold(const IsolatedFit& fit, Remarks& remarks) {
  if (!fit.moved)
    remarks.warn(
        "the search did not leave its start: the numbers are those of --muscle, not an answer of the recordings; start "
        "from values at which the muscle bears force (is it slack there?)");
  if (fit.from_elsewhere)
    remarks.warn(
        "the search from the values of --muscle ended in a worse minimum than a search from elsewhere, whose result "
        "this is: the recordings may have more minima; start from measured lengths, or identify fewer parameters");
  for (const IsolatedEstimate& e : fit.estimates) {
    if (!e.told)
      remarks.warn(fmt::format(
          "{}: the recordings do not tell it: under these laws the force does not depend on it, or other parameters "
          "undo its effect; {:.4g} {} is no estimate. Leave it out of --fit",
          e.parameter, e.value, symbol(e.unit)));
  }
}

void add_errors(const IsolatedModel& start, const Recordings& recordings, double relative_tolerance, MuscleFit& fit) {
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const auto share = [&](const IsolatedModel& model) {
      return mean_force_error(model, recordings[i], relative_tolerance) / fit.relative_to_n;
    };
    fit.errors.push_back({.recording = recordings[i].name,
                          .starting_values = share(start),
                          .fitted = share(fit.all.of_recordings[i]),
                          .predicted = fit.without_one.empty() ? std::numeric_limits<double>::quiet_NaN()
                                                               : share(fit.without_one[i].model)});
  }
}

void warn_of_misses(MuscleFit& fit, Remarks& remarks) {
  for (const RecordingErrors& error : fit.errors) {
    if (error.fitted <= kErrorOfAGuess) continue;
    remarks.warn(
        fmt::format("{}: the fit misses the force by {:.0f} % of {:.4g} N, more than a guess would: are the files of "
                    "--length and --measured in the same order, and in m and N?",
                    error.recording, 100.0 * error.fitted, fit.relative_to_n));
    fit.misses = true;
  }
}

/// Fits to all recordings, unless that fit is known, and to all but each one.
MuscleFit fit_to(const IsolatedModel& start,
                 const Recordings& recordings,
                 const MuscleFitSettings& settings,
                 const std::optional<IsolatedFit>& known) {
  MuscleFit fit;
  fit.relative_to_n = settings.relative_to_n;
  fit.all = known ? *known : fit_isolated_muscle(start, recordings, settings.fit);
  fit.without_one = fit_without_each(start, recordings, settings.fit, fit.all);
  const auto converged = [](const IsolatedFit& one) {
    return one.termination == math::Termination::converged && one.moved;
  };
  fit.converged = converged(fit.all) && std::ranges::all_of(fit.without_one, converged);
  add_errors(start, recordings, settings.fit.relative_tolerance, fit);
  return fit;
}

/// Returns the starting model under another set's laws: its numbers, and the set's damping.
IsolatedModel under(muscle::LawSet set, IsolatedModel model) {
  model.laws = laws_of(set, model.laws.mode);
  model.parameters.damping = published_defaults(model.parameters.hill, model.laws).damping;
  return model;
}

/// Returns R2 of the fitted forces.
double r2_of(const MuscleFit& fit, const Recordings& recordings, double relative_tolerance) {
  double miss = 0.0, square = 0.0, sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const Eigen::VectorXd& force = recordings[i].force_n;
    miss += (isolated_force(fit.all.of_recordings[i], recordings[i], relative_tolerance) - force).squaredNorm();
    square += force.squaredNorm();
    sum += force.sum();
    count += static_cast<double>(force.size());
  }
  return 1.0 - miss / std::max(square - sum * sum / count, 1e-300);
}

/// Gives each estimate its interval and verdict. The interval is that of the logarithm: the standard error, with
/// Student's t for the recordings, and the belief in the start.
void judge_estimates(const Recordings& recordings, const muscle::IsolatedFitOptions& options, MuscleFit& fit) {
  // The integration and the thinned lengths alone change estimates by so much.
  constexpr double kLeastError = 5e-4;
  const double belief = std::log(options.reach) / 1.96;
  const auto n = static_cast<double>(recordings.size());
  const double t = n > 1.0 ? math::student_quantile(0.975, n - 1.0) / 1.96 : 1.0;
  fit::FitFacts shared{.converged = fit.converged, .failure = fit.all.message, .of_force = true, .one_reading = true};
  shared.r2 = r2_of(fit, recordings, options.relative_tolerance);
  for (const IsolatedEstimate& e : fit.all.estimates) {
    const double from_forces = t * std::max(e.std_error / e.value, kLeastError);
    const double sd = 1.0 / std::hypot(1.0 / from_forces, 1.0 / belief);
    const fit::Reading reading{.value = e.value,
                               .low = e.value * std::exp(-1.96 * sd),
                               .high = e.value * std::exp(1.96 * sd),
                               .sd = e.value * sd};
    const fit::NumberFacts facts{.fit = shared,
                                 .person = reading,
                                 .given = reading,
                                 .determined = e.told,
                                 .contraction = 1.0 - sd * sd / (belief * belief),
                                 .prior_distance = std::abs(std::log(e.value / e.start)) / belief,
                                 .at_bound = e.at_bound};
    const fit::Finding found = finding(facts);
    fit.judgments.push_back(
        {.low = reading.low, .high = reading.high, .verdict = verdict_of(found), .reason = reason_of(found, facts)});
  }
}

/// Orders the fits of several sets of laws by their errors on left-out recordings.
std::vector<LawsComparison> compare(const std::vector<std::pair<muscle::LawSet, MuscleFit>>& fits) {
  std::vector<LawsComparison> rows;
  const auto mean = [](const MuscleFit& fit) {
    double sum = 0.0;
    for (const RecordingErrors& e : fit.errors) sum += e.predicted;
    return sum / static_cast<double>(fit.errors.size());
  };
  const auto best = std::ranges::min_element(fits, {}, [&](const auto& one) { return mean(one.second); });
  for (const auto& [laws, fit] : fits) {
    const auto n = static_cast<Eigen::Index>(fit.errors.size());
    Eigen::VectorXd apart(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      apart[i] = fit.errors[k].predicted - best->second.errors[k].predicted;
    }
    const double error = std::sqrt((apart.array() - apart.mean()).square().sum() / static_cast<double>(n * (n - 1)));
    rows.push_back({.laws = laws,
                    .predicted = mean(fit),
                    .worse_by = apart.mean(),
                    .std_error = error,
                    .ties = apart.mean() <= 1.96 * error});
  }
  std::ranges::sort(rows, {}, &LawsComparison::predicted);
  return rows;
}

/// Fits under every set and returns the fit of the best; the start's own laws stay if they tie with the best. `known`
/// is the fit of all recordings under the start's own laws.
MuscleFit fit_best_laws(const IsolatedModel& start,
                        const Recordings& recordings,
                        const MuscleFitSettings& settings,
                        const std::optional<IsolatedFit>& known) {
  if (settings.laws.empty()) return fit_to(start, recordings, settings, known);
  if (recordings.size() < 3)
    throw InvalidInput("--laws compares errors on left-out recordings: give at least three of --length");
  std::vector<std::pair<muscle::LawSet, MuscleFit>> fits;
  for (const muscle::LawSet set : settings.laws) {
    const bool own = laws_of(set, start.laws.mode) == start.laws;
    fits.emplace_back(
        set, own ? fit_to(start, recordings, settings, known) : fit_to(under(set, start), recordings, settings, {}));
  }
  const std::vector<LawsComparison> rows = compare(fits);
  const auto keeps = [&](const LawsComparison& row) {
    return row.ties && laws_of(row.laws, start.laws.mode) == start.laws;
  };
  const auto stays = std::ranges::find_if(rows, keeps);
  const muscle::LawSet chosen = stays == rows.end() ? rows.front().laws : stays->laws;
  MuscleFit fit = std::ranges::find(fits, chosen, [](const auto& one) { return one.first; })->second;
  fit.laws = rows;
  return fit;
}

/// Returns the recordings, without the forces from each of the stretches on.
Recordings without(const std::vector<HeldStretch>& stretches, const Recordings& recordings) {
  Recordings parts = recordings;
  for (const HeldStretch& stretch : stretches)
    parts[stretch.recording] = before(stretch, recordings[stretch.recording]);
  std::erase_if(parts, [](const IsolatedRecording& part) { return part.force_n.size() < 2; });
  return parts;
}

/// Returns the stretches after which the muscle pulls more than the model of a fit without them, and tells of them.
std::vector<HeldStretch> enhanced(const std::vector<HeldStretch>& stretches,
                                  const Recordings& recordings,
                                  const IsolatedModel& model,
                                  Remarks& remarks) {
  constexpr double kLeast = 0.03;  // of F_max
  const double strength_n = model.parameters.hill.max_isometric_force_n;
  std::vector<HeldStretch> found;
  for (const HeldStretch& stretch : stretches) {
    const IsolatedRecording& recording = recordings[stretch.recording];
    const double more_n = force_enhancement_n(stretch, model, recording);
    if (more_n < kLeast * strength_n) continue;
    found.push_back(stretch);
    remarks.add({.code = RemarkCode::force_enhancement,
                 .severity = Severity::warning,
                 .where = recording.name,
                 .when = Stretch{stretch.begin_s, recording.time_s[recording.time_s.size() - 1]},
                 .value = more_n,
                 .says = fmt::format(
                     "{}: held after a stretch of {:.2g} mm at {:.2f} to {:.2f} s, the active muscle pulls {:.2g} N "
                     "({:.0f} % of F_max) more than isometrically at that length: residual force "
                     "enhancement, which no Hill-type muscle has; the forces from {:.2f} s on are left out",
                     recording.name, 1e3 * stretch.rise_m, stretch.begin_s, stretch.end_s, more_n,
                     100.0 * more_n / strength_n, stretch.begin_s)});
  }
  return found;
}

}  // namespace

MuscleFit fit_muscle(const IsolatedModel& start,
                     const Recordings& recordings,
                     const MuscleFitSettings& settings,
                     Remarks& remarks) {
  for (const std::string& text : check_force_size(recordings, start.parameters.hill.max_isometric_force_n))
    remarks.warn(text);
  for (const std::string& text : check_recording_order(start, recordings, settings.fit.relative_tolerance))
    remarks.warn(text);
  const std::vector<HeldStretch> stretches = held_stretches(recordings, start.parameters.hill.optimal_fiber_length_m);
  Recordings used = recordings;
  std::optional<IsolatedFit> known;
  if (!stretches.empty()) {
    IsolatedFit unstretched = fit_isolated_muscle(start, without(stretches, recordings), settings.fit);
    const std::vector<HeldStretch> found = enhanced(stretches, recordings, unstretched.model, remarks);
    used = without(found, recordings);
    if (found.size() == stretches.size()) known = std::move(unstretched);
  }
  MuscleFit fit = fit_best_laws(start, used, settings, known);
  warn_of_untold(fit.all, remarks);
  compare_left_out(used, fit, remarks);
  judge_estimates(used, settings.fit, fit);
  warn_of_misses(fit, remarks);
  return fit;
}

}  // namespace myoid::program
