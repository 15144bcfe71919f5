#include "myoid/commands/muscle_fit.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "myoid/commands/muscle_input.h"
#include "myoid/muscle/isolated_checks.h"

namespace myoid::commands {
namespace {

using muscle::IsolatedFit;
using muscle::IsolatedRecording;

/// Widens each standard error to the spread over fits without one recording (jackknife), and warns
/// of numbers that one recording decides.
void compare_left_out(const std::vector<IsolatedRecording>& recordings, MuscleFit& fit, Remarks& remarks) {
  for (const muscle::DecidedByOne& found : widen_to_jackknife(fit.all, fit.without_one)) {
    const muscle::IsolatedEstimate& e = fit.all.estimates[found.parameter];
    remarks.warn(fmt::format(
        "{} is {:.4g} {} without {}, {:.1f} of the fit's standard errors from {:.4g}: it hangs "
        "on that recording; its standard error is widened to the spread over the recordings",
        e.parameter, found.without, symbol(e.unit), recordings[found.recording].name, found.std_errors, e.value));
  }
}

std::vector<IsolatedRecording> read_recordings(const MuscleOptions& o,
                                               const muscle::MuscleFile& file,
                                               Remarks& remarks) {
  std::vector<IsolatedRecording> recordings;
  for (std::size_t i = 0; i < o.lengths.size(); ++i) {
    const Column force = read_column(o.measured[i], "", remarks);
    recordings.push_back({o.measured[i], read_experiment(o, i, file, remarks), force.time_s, force.values});
  }
  return recordings;
}

std::vector<IsolatedFit> fits_without_one(const muscle::IsolatedModel& start,
                                          const std::vector<IsolatedRecording>& recordings,
                                          const muscle::IsolatedFitOptions& options) {
  std::vector<IsolatedFit> fits;
  for (std::size_t i = 0; recordings.size() > 1 && i < recordings.size(); ++i) {
    std::vector<IsolatedRecording> others = recordings;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    fits.push_back(fit_isolated_muscle(start, others, options));
  }
  return fits;
}

/// Adds the errors of every recording.
void add_errors(const muscle::IsolatedModel& start,
                const std::vector<IsolatedRecording>& recordings,
                double relative_tolerance,
                MuscleFit& fit) {
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    const auto share = [&](const muscle::IsolatedModel& model) {
      return mean_force_error(model, recordings[i], relative_tolerance) / fit.relative_to_n;
    };
    fit.errors.push_back({.recording = recordings[i].name,
                          .starting_values = share(start),
                          .fitted = share(fit.all.model),
                          .predicted = fit.without_one.empty() ? std::numeric_limits<double>::quiet_NaN()
                                                               : share(fit.without_one[i].model)});
  }
}

void warn_of_misses(MuscleFit& fit, Remarks& remarks) {
  for (const RecordingErrors& error : fit.errors) {
    if (error.fitted <= kErrorOfAGuess) continue;
    remarks.warn(
        fmt::format("{}: the fit misses the force by {:.0f} % of {:.4g} N, more than a guess "
                    "would: are the files of --length and --measured in the same order, and in m "
                    "and N?",
                    error.recording, 100.0 * error.fitted, fit.relative_to_n));
    fit.misses = true;
  }
}

}  // namespace

MuscleFit fit_muscle(const MuscleOptions& o, const muscle::MuscleFile& file, Remarks& remarks) {
  const muscle::IsolatedModel start{file.parameters, file.laws, file.millard};
  const double max_isometric_n = start.parameters.hill.max_isometric_force_n;
  const muscle::IsolatedFitOptions options{
      .parameters = o.fit, .relative_tolerance = std::max(o.tolerance, 1e-8), .progress = o.call.progress};
  const std::vector<IsolatedRecording> recordings = read_recordings(o, file, remarks);
  for (const std::string& text : check_force_size(recordings, max_isometric_n)) remarks.warn(text);
  for (const std::string& text : check_recording_order(start, recordings, options.relative_tolerance))
    remarks.warn(text);
  MuscleFit fit;
  fit.relative_to_n = o.isometric_n > 0.0 ? o.isometric_n : max_isometric_n;
  fit.all = fit_isolated_muscle(start, recordings, options);
  fit.without_one = fits_without_one(start, recordings, options);
  const auto converged = [](const IsolatedFit& one) { return one.termination == math::Termination::converged; };
  fit.converged = converged(fit.all) && std::all_of(fit.without_one.begin(), fit.without_one.end(), converged);
  add_errors(start, recordings, options.relative_tolerance, fit);
  compare_left_out(recordings, fit, remarks);
  warn_of_misses(fit, remarks);
  return fit;
}

}  // namespace myoid::commands
