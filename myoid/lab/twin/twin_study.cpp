#include "myoid/lab/twin/twin_study.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <oneapi/tbb/task_arena.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/core/parallel.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/lab/twin/synthetic_recording.h"
#include "myoid/lab/twin/voluntary_truth.h"
#include "myoid/lab/twin/write_recording.h"
#include "myoid/muscle/hill_parameters.h"
#include "myoid/run/prediction_gates.h"
#include "myoid/run/run_study.h"
#include "myoid/study/read_study.h"

namespace myoid::lab {
namespace {

using fit::ParameterEstimate;
using fit::Verdict;

constexpr double kDelayUnit_s = 0.1;
constexpr double kAngleUnit_rad = 100.0 * kDegree;

/// Returns the study of the recording, with the model in memory.
study::Study study_of(const lab::VirtualRecording& recording, const TwinStudyOptions& options) {
  study::Study study = study::parse_study(lab::study_toml(recording), "study.toml");
  study.model.text = recording.model_osim;
  study.identify.methods = options.methods;
  study.identify.cross_validate = false;
  study.identify.next_movements = 0;
  study.truth.reset();
  return study;
}

std::vector<study::TrialInput> inputs_of(lab::VirtualRecording& recording) {
  std::vector<study::TrialInput> inputs;
  for (lab::VirtualTrial& trial : recording.trials) {
    study::TrialInput& input = inputs.emplace_back();
    input.markers = std::move(trial.markers);
    input.emg = std::move(trial.emg);
    input.external_torque = std::move(trial.external_torque);
    input.fascicles = std::move(trial.fascicles);
  }
  return inputs;
}

std::map<std::pair<std::string, std::string>, double> truth_of(const lab::VirtualRecording& recording) {
  std::map<std::pair<std::string, std::string>, double> truth;
  for (std::size_t m = 0; m < lab::kArmMuscles.size(); ++m) {
    for (const muscle::HillField& field : muscle::kHillFields) {
      if (!recording.truth.departures.has(field)) continue;
      truth[{std::string(lab::kArmMuscles[m]), std::string(field.name)}] = recording.truth.muscles[m].*field.member;
    }
  }
  truth[{"subject", "emg_delay"}] = recording.truth.emg_delay_s;
  return truth;
}

/// Returns the angles of the curves; empty: they have none.
std::optional<muscle::Range> range_of(const std::vector<fit::VoluntaryCurve>& curves) {
  const Eigen::VectorXd& angle_rad = curves.front().angle_rad;
  if (angle_rad.size() == 0) return std::nullopt;
  return muscle::Range{angle_rad[0], angle_rad[angle_rad.size() - 1]};
}

struct OnePerson {
  std::vector<TwinRow> rows;
  std::vector<TwinPrediction> predictions;
  std::vector<TwinFailure> failures;
};

OnePerson one_person(const lab::Protocol& protocol, std::uint64_t seed, const TwinStudyOptions& options) {
  OnePerson person;
  try {
    lab::VirtualRecording recording = lab::make_virtual_recording(protocol, seed);
    const study::Study study = study_of(recording, options);
    auto truth = truth_of(recording);
    run::RunOptions run;
    run.progress.stop = options.progress.stop;
    run.inform_forces = false;
    run.share_forces = std::any_of(options.methods.begin(), options.methods.end(),
                                   [](fit::Method method) { return method != fit::Method::torque; });
    const run::StudyResult result = run::analyse(run::in_memory(study, inputs_of(recording)), run);
    for (const run::TrialResult& trial : result.trials) {
      if (!trial.failure().empty())
        person.failures.push_back({seed, fmt::format("{}: {}", trial.spec.name, trial.failure())});
    }
    for (const fit::IdentificationResult& method : result.fit.methods) {
      // Over the angles that the run reports. Without a maximal contraction it reports another effort.
      if (!method.voluntary.empty() && method.voluntary.front().from_mvc) {
        for (const VoluntaryTruth& of : voluntary_truth(recording, range_of(method.voluntary)))
          truth[{of.owner, of.parameter}] = of.value;
      }
      for (const ParameterEstimate& e : method.estimates) {
        const auto it = truth.find({e.muscle, e.parameter});
        if (it != truth.end()) person.rows.push_back({seed, it->second, e});
      }
      if (method.method != fit::Method::torque) continue;
      for (const fit::TrialFit& t : method.trials) {
        if (t.calibration) continue;
        person.predictions.push_back({seed, t.trial, t.score, t.band});
      }
    }
  } catch (const InvalidInput& error) {
    person.failures.push_back({seed, error.what()});
  }
  return person;
}

/// Fills the errors and intervals of the reading given geometry and sensors.
void add_given(const std::vector<const TwinRow*>& rows, TwinSummary& s) {
  std::vector<double> errors, widths;
  int covered = 0;
  for (const TwinRow* row : rows) {
    const ParameterEstimate& e = row->estimate;
    if (!e.given_estimate || !e.given_ci_low || !e.given_ci_high) continue;
    const double unit = e.parameter == "emg_delay" ? kDelayUnit_s : std::abs(row->truth);
    errors.push_back(std::abs(*e.given_estimate - row->truth) / unit);
    widths.push_back(0.5 * (*e.given_ci_high - *e.given_ci_low) / unit);
    covered += *e.given_ci_low <= row->truth && row->truth <= *e.given_ci_high;
  }
  s.given.coverage = errors.empty() ? std::nan("") : static_cast<double>(covered) / static_cast<double>(errors.size());
  s.given.median_error = math::median(std::move(errors));
  s.given.half_width = math::median(std::move(widths));
}

TwinSummary summary_of(const std::vector<const TwinRow*>& rows) {
  TwinSummary s;
  std::vector<double> errors;
  std::vector<double> widths;
  std::vector<double> shrinkages;
  double squares = 0.0;
  int covered = 0;
  const auto count = static_cast<double>(rows.size());
  for (const TwinRow* row : rows) {
    const ParameterEstimate& e = row->estimate;
    ++s.count;
    s.verdicts[static_cast<std::size_t>(e.verdict)]++;
    const double error = row->error();
    const double size = std::isfinite(error) ? std::abs(error) : std::numeric_limits<double>::infinity();
    if (std::isfinite(error)) {
      errors.push_back(error);
      squares += error * error;
    }
    s.within.of_5 += size <= 0.05 ? 1.0 / count : 0.0;
    s.within.of_10 += size <= 0.10 ? 1.0 / count : 0.0;
    s.within.of_15 += size <= 0.15 ? 1.0 / count : 0.0;
    s.within.of_20 += size <= 0.20 ? 1.0 / count : 0.0;
    const TwinRow before{row->seed, row->truth, {.parameter = e.parameter, .estimate = e.initial}};
    s.prior_within_10 += std::abs(before.error()) <= 0.10 ? 1.0 / count : 0.0;
    if (e.ci_low && e.ci_high) {
      ++s.with_interval;
      covered += row->covered() ? 1 : 0;
      const double unit = e.parameter == "emg_delay"             ? kDelayUnit_s
                          : fit::is_voluntary_angle(e.parameter) ? kAngleUnit_rad
                                                                 : std::abs(row->truth);
      widths.push_back(0.5 * (*e.ci_high - *e.ci_low) / unit);
    }
    if (e.shrinkage) shrinkages.push_back(*e.shrinkage);
    const bool good = size <= 0.10;
    if (e.verdict == Verdict::identified) {
      (good ? s.confusion.identified_good : s.confusion.identified_bad)++;
      s.identified_within_15 += size <= 0.15 ? 1 : 0;
    } else {
      (good ? s.confusion.other_good : s.confusion.other_bad)++;
    }
    for (const muscle::HillField& field : muscle::kHillFields) {
      const bool outside = field.name == e.parameter && std::isfinite(e.estimate) &&
                           (e.estimate < field.bounds.lower || e.estimate > field.bounds.upper);
      s.outside_physical += outside && e.verdict != Verdict::non_physical ? 1 : 0;
    }
  }
  s.bias = math::median(errors);
  std::vector<double> sizes = errors;
  for (double& e : sizes) e = std::abs(e);
  s.median_error = math::median(std::move(sizes));
  for (double& e : errors) e = std::abs(e - s.bias);
  s.rmse = errors.empty() ? std::nan("") : std::sqrt(squares / static_cast<double>(errors.size()));
  s.mad = math::median(std::move(errors));
  s.coverage = s.with_interval > 0 ? static_cast<double>(covered) / s.with_interval : std::nan("");
  s.half_width = math::median(std::move(widths));
  s.shrinkage = math::median(std::move(shrinkages));
  add_given(rows, s);
  return s;
}

std::string cell(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : ""; }

}  // namespace

double TwinRow::error() const {
  if (estimate.parameter == "emg_delay") return (estimate.estimate - truth) / kDelayUnit_s;
  if (fit::is_voluntary_angle(estimate.parameter)) return (estimate.estimate - truth) / kAngleUnit_rad;
  return (estimate.estimate - truth) / std::abs(truth);
}

bool TwinRow::covered() const {
  return estimate.ci_low && estimate.ci_high && *estimate.ci_low <= truth && truth <= *estimate.ci_high;
}

TwinStudyResult twin_study(const lab::Protocol& protocol, const TwinStudyOptions& options) {
  if (options.subjects < 1) throw InvalidInput("twin-study: at least one subject is needed");
  const auto count = static_cast<std::size_t>(options.subjects);
  std::vector<OnePerson> persons(count);
  std::vector<char> finished(count, 0);
  std::atomic<int> done = 0;
  parallel_each(count, [&](std::size_t k) {
    if (options.progress.stop.stop_requested()) return;
    // Isolated: a thread that waits inside one person must not begin another.
    oneapi::tbb::this_task_arena::isolate([&] {
      try {
        persons[k] = one_person(protocol, options.first_seed + k, options);
        finished[k] = 1;
      } catch (const Interrupted&) {  // this person is lost, the finished ones are kept
      }
    });
    if (finished[k] == 0) return;
    options.progress.tell(++done / static_cast<double>(count), fmt::format("{} of {} persons", done.load(), count));
  });
  TwinStudyResult result;
  result.protocol = protocol.name;
  result.level = choice_name(protocol.level);
  result.world = stated_world(protocol);
  result.finished = static_cast<int>(std::count(finished.begin(), finished.end(), 1));
  result.subjects = options.subjects;
  result.first_seed = options.first_seed;
  result.interrupted = result.finished < options.subjects;
  for (OnePerson& person : persons) {
    std::move(person.rows.begin(), person.rows.end(), std::back_inserter(result.rows));
    std::move(person.predictions.begin(), person.predictions.end(), std::back_inserter(result.predictions));
    std::move(person.failures.begin(), person.failures.end(), std::back_inserter(result.failures));
  }
  return result;
}

std::vector<TwinSummary> summarize(const TwinStudyResult& result) {
  using Key = std::tuple<fit::Method, fit::FitCase, std::string, std::string>;
  std::vector<Key> order;
  std::map<Key, std::vector<const TwinRow*>> groups;
  for (const bool all : {true, false}) {
    for (const TwinRow& row : result.rows) {
      const ParameterEstimate& e = row.estimate;
      const bool single = e.muscle == "subject";
      if (single && !all) continue;
      const Key key{e.method, e.fit_case, e.parameter, single ? "subject" : all ? "all" : e.muscle};
      auto& group = groups[key];
      if (group.empty()) order.push_back(key);
      group.push_back(&row);
    }
  }
  std::vector<TwinSummary> list;
  for (const Key& key : order) {
    TwinSummary s = summary_of(groups[key]);
    std::tie(s.method, s.fit_case, s.parameter, s.muscle) = key;
    list.push_back(std::move(s));
  }
  return list;
}

namespace {

std::string persons_text(const TwinStudyResult& result) {
  std::string persons =
      "seed,method,case,muscle,parameter,unit,truth,initial,estimate,ci_low,ci_high,given_estimate,given_ci_low,"
      "given_ci_high,shrinkage,verdict\n";
  const auto optional = [](const std::optional<double>& value) { return value ? cell(*value) : std::string(); };
  for (const TwinRow& row : result.rows) {
    const ParameterEstimate& e = row.estimate;
    persons +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", row.seed, name(e.method), name(e.fit_case),
                    e.muscle, e.parameter, symbol(e.unit), cell(row.truth), cell(e.initial), cell(e.estimate),
                    optional(e.ci_low), optional(e.ci_high), optional(e.given_estimate), optional(e.given_ci_low),
                    optional(e.given_ci_high), optional(e.shrinkage), fit::name(e.verdict));
  }
  return persons;
}

std::string summary_text(const TwinStudyResult& result) {
  std::string summary =
      "method,case,muscle,parameter,count,bias,median_error,mad,rmse,within_5,within_10,within_15,within_20,prior_"
      "within_10,coverage,half_width,given_median_error,given_coverage,given_half_width,shrinkage,identified,"
      "reproducible,weak,prior_dominated,not_identifiable,non_physical,"
      "identified_and_within_10,identified_but_not,not_identified_but_within_10,not_identified_and_not,identified_"
      "within_15,outside_physical\n";
  for (const TwinSummary& s : summarize(result)) {
    summary +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", name(s.method),
                    name(s.fit_case), s.muscle, s.parameter, s.count, cell(s.bias), cell(s.median_error), cell(s.mad),
                    cell(s.rmse), cell(s.within.of_5), cell(s.within.of_10), cell(s.within.of_15), cell(s.within.of_20),
                    cell(s.prior_within_10), cell(s.coverage), cell(s.half_width), cell(s.given.median_error),
                    cell(s.given.coverage), cell(s.given.half_width), cell(s.shrinkage), fmt::join(s.verdicts, ","),
                    s.confusion.identified_good, s.confusion.identified_bad, s.confusion.other_good,
                    s.confusion.other_bad, s.identified_within_15, s.outside_physical);
  }
  return summary;
}

std::string predictions_text(const TwinStudyResult& result) {
  std::string predictions = "seed,trial,rmse_nm,nrmse_range,r2,band_rmse_nm,band_nrmse_range,band_r2\n";
  for (const TwinPrediction& p : result.predictions) {
    predictions += fmt::format("{},{}", p.seed, csv_cell(p.trial));
    for (const fit::Score* s : {&p.law, &p.band})
      predictions += fmt::format(",{},{},{}", cell(s->rmse_nm()), cell(s->nrmse_range()), cell(s->r2()));
    predictions += "\n";
  }
  return predictions;
}

}  // namespace

void write_twin_study(const TwinStudyResult& result,
                      const Provenance& provenance,
                      const std::filesystem::path& folder) {
  write_file(folder / "persons.csv", persons_text(result));
  write_file(folder / "summary.csv", summary_text(result));
  write_file(folder / "predictions.csv", predictions_text(result));
  nlohmann::ordered_json run = {{"program", provenance.program},
                                {"version", provenance.version},
                                {"command", provenance.command},
                                {"protocol", result.protocol},
                                {"level", result.level},
                                {"first_seed", result.first_seed},
                                {"persons_asked_for", result.subjects},
                                {"persons_finished", result.finished},
                                {"interrupted", result.interrupted},
                                {"inputs", nlohmann::ordered_json::array()},
                                {"failures", nlohmann::ordered_json::array()}};
  for (const WorldSetting& setting : result.world) run["world"][setting.key] = setting.value;
  for (const InputFile& file : provenance.inputs)
    run["inputs"].push_back({{"path", file.path}, {"sha256", file.sha256}});
  for (const TwinFailure& f : result.failures) run["failures"].push_back({{"seed", f.seed}, {"message", f.message}});
  write_file(folder / "run.json", json_text(run) + "\n");
}

}  // namespace myoid::lab
