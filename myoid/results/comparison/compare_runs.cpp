#include "myoid/results/comparison/compare_runs.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/fit/intervals/estimate_columns.h"
#include "myoid/fit/measurement/parameter_fields.h"
#include "myoid/ground/core/day_text.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/core/normal.h"
#include "myoid/ground/files/result_folder.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/page/read_gates.h"
#include "myoid/page/tables.h"
#include "myoid/results/comparison/change_sentences.h"
#include "myoid/study/run_identity.h"

namespace myoid::results {
namespace {

using nlohmann::json;

/// Share of the errors of the first kind that the greatest voluntary torques may make.
constexpr double kOfTorques = 0.9;
/// The effort that a person's maximal contraction reaches differs by this share from session to session (judgment).
constexpr double kEffortSd = 0.03;

using fit::ParameterEstimate;
using fit::Verdict;

std::optional<double> number(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

/// Muscle, parameter, method, case.
using Key = std::tuple<std::string, std::string, fit::Method, fit::FitCase>;
using MethodAndTrial = std::pair<std::string, std::string>;

struct Run {
  bool posterior = false;       ///< By that estimator.
  std::optional<bool> maximal;  ///< Strengths are at full effort, not at the largest EMG; nothing: not stated.
  std::vector<Key> order;
  std::map<Key, ParameterEstimate> estimates;
  std::map<Key, std::vector<std::string>> sharers;  ///< Further muscles of the same unknown.
  std::vector<MethodAndTrial> trial_order;
  std::map<MethodAndTrial, std::optional<double>> rmse_nm;
};

/// Returns true for a torque or an angle of a joint that one muscle makes: it is that muscle's number.
bool repeats_a_muscle(const Run& run, const ParameterEstimate& e) {
  const std::size_t end = std::min(e.parameter.rfind("_positive"), e.parameter.rfind("_negative"));
  if (!fit::is_voluntary(e.parameter) || end == std::string::npos) return false;
  return std::ranges::any_of(run.order, [&](const Key& key) {
    const ParameterEstimate& other = run.estimates.at(key);
    return other.parameter == e.parameter.substr(0, end) && other.method == e.method && other.estimate == e.estimate &&
           other.ci_low == e.ci_low && other.ci_high == e.ci_high;
  });
}

Run read_run(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "parameters.json";
  require_results(folder, "parameters.json");
  Run run;
  try {
    const json content = parse_json(read_text_file(path));
    for (const json& method : content.at("methods")) {
      run.posterior |= !method.value("noise", json::array()).empty();
      if (const json maximal = method.value("maximal_contraction", json()); maximal.is_boolean())
        run.maximal = maximal.get<bool>();
      for (const json& row : method.at("estimates")) {
        std::optional<ParameterEstimate> e = fit::estimate_of_json(row);
        if (!e || fit::is_voluntary_power(e->parameter)) continue;  // a power follows from the torque
        // One unknown of several muscles is one number, in the list of its first owner.
        const Key key{e->tied_to.empty() ? e->muscle : e->tied_to, e->parameter, e->method, e->fit_case};
        if (!e->tied_to.empty()) {
          run.sharers[key].push_back(e->muscle);
          continue;
        }
        if (repeats_a_muscle(run, *e)) continue;
        run.order.push_back(key);
        run.estimates[key] = std::move(*e);
      }
      for (const json& trial : method.at("trials")) {
        const MethodAndTrial key{method.at("method").get<std::string>(), trial.at("trial").get<std::string>()};
        run.trial_order.push_back(key);
        run.rmse_nm[key] = number(trial, "rmse_nm");
      }
    }
  } catch (const json::exception& error) {
    throw ReadError(
        path, 0,
        fmt::format("is not the result of a run: {}; run the study (myoid run) and give the folder of its result",
                    json_error_text(error)));
  }
  return run;
}

/// Returns true if the session's recording determines the number. An interval without a width is that of an angle
/// whose every draw is the end of the recorded range: the maximum may lie beyond.
bool told(const ParameterEstimate& e) {
  constexpr double kNoWidth = 1e-9;  // of the number
  const bool by_verdict =
      e.verdict == Verdict::identified || e.verdict == Verdict::reproducible || e.verdict == Verdict::weak;
  const double least = kNoWidth * std::abs(e.estimate);
  const bool given_has_width = !e.given_ci_low || !e.given_ci_high || *e.given_ci_high - *e.given_ci_low > least;
  return rests_on_measurement(e.method) && by_verdict && e.std_error && *e.std_error > least && given_has_width;
}

/// Returns a number's standard error between sessions of one person. Moment arms, tendons and the torque's scale have
/// the same errors in both sessions, so their shares of the variance cancel in the difference.
double repeat_error(const ParameterEstimate& e) {
  double own = 1.0;
  if (e.variance_shares) {
    for (const fit::Source same : {fit::Source::geometry, fit::Source::torque_scale})
      own -= (*e.variance_shares)[static_cast<std::size_t>(same)];
  }
  return *e.std_error * std::sqrt(std::max(own, 0.0));
}

/// Returns true if changes of the number are shares of it.
bool is_ratio_scale(const std::string& parameter) {
  return fit::is_voluntary(parameter) ? !fit::is_voluntary_angle(parameter)
                                      : fit::parameter_field(parameter).logarithmic;
}

/// A number in one session, and its standard error between sessions.
struct OfSession {
  ComparedValue shown;
  double sd = 0.0;
};

/// Returns true if the number refers to the effort of the maximal contraction.
bool is_strength(const std::string& parameter) {
  return parameter == "max_isometric_force" || (fit::is_voluntary(parameter) && !fit::is_voluntary_angle(parameter));
}

/// Returns true for a number of all muscles of a joint together.
bool is_of_joint(const std::string& parameter) {
  return fit::is_voluntary(parameter) && (parameter.ends_with("_positive") || parameter.ends_with("_negative"));
}

/// Returns the muscles whose strength a run has.
std::set<std::string> muscles_of(const Run& run) {
  std::set<std::string> muscles;
  const auto is_strength_of_muscle = [](const Key& key) { return std::get<1>(key) == "max_isometric_force"; };
  for (const auto& [key, estimate] : run.estimates)
    if (is_strength_of_muscle(key)) muscles.insert(std::get<0>(key));
  for (const auto& [key, others] : run.sharers)
    if (is_strength_of_muscle(key)) muscles.insert(others.begin(), others.end());
  return muscles;
}

/// The quantities of two sessions that mean the same.
struct Alike {
  bool effort = true;   ///< Strengths belong to one effort.
  bool muscles = true;  ///< Numbers of a joint are those of the same muscles.
  [[nodiscard]] bool holds(const std::string& parameter) const {
    const bool of_effort = is_strength(parameter) || fit::is_voluntary(parameter);
    return (effort || !of_effort) && (muscles || !is_of_joint(parameter));
  }
};

/// Returns the number given geometry and sensors; empty without one. Of a number that is searched for by its
/// logarithm the middle of the interval is that of ln. A maximal contraction reaches another effort in each session.
std::optional<OfSession> given_geometry(const ParameterEstimate& e) {
  if (!e.given_ci_low || !e.given_ci_high) return std::nullopt;
  const double low = *e.given_ci_low, high = *e.given_ci_high;
  const bool ratio = is_ratio_scale(e.parameter) && low > 0.0;
  OfSession of{.shown = {ratio ? std::sqrt(low * high) : 0.5 * (low + high), low, high},
               .sd = (high - low) / (2.0 * kNormal95)};
  if (!(of.sd > 0.0)) return std::nullopt;
  if (is_strength(e.parameter)) of.sd = std::hypot(of.sd, kEffortSd * of.shown.value);
  return of;
}

/// Returns the person's number, with the standard error that two sessions do not share.
OfSession of_person(const ParameterEstimate& e) {
  return {{e.estimate, e.ci_low, e.ci_high}, e.std_error ? repeat_error(e) : 0.0};
}

/// Returns a number of both sessions by one reading: given geometry and sensors, or the person's.
std::pair<OfSession, OfSession> of_sessions(const ParameterEstimate& first, const ParameterEstimate& second) {
  const auto one = given_geometry(first), other = given_geometry(second);
  if (one && other) return {*one, *other};
  return {of_person(first), of_person(second)};
}

/// Adjusts by Holm (1979): the k-th smallest of n p-values times n - k + 1, never below an earlier result; over the
/// share of kLevel that these numbers have.
void adjust_p_values(std::vector<ComparedParameter*> compared, double share) {
  std::ranges::sort(compared, {}, [](const ComparedParameter* p) { return *p->p_value; });
  double largest = 0.0;
  for (std::size_t k = 0; k < compared.size(); ++k) {
    largest =
        std::max(largest, std::min(1.0, *compared[k]->p_value * static_cast<double>(compared.size() - k) / share));
    compared[k]->p_value = largest;
    compared[k]->tested = static_cast<int>(compared.size());
    compared[k]->change = largest < kLevel ? Change::differs : Change::no_change;
  }
}

std::string text_of(const Key& key) {
  const auto& [muscle, parameter, method, fit_case] = key;
  return fmt::format("{} {} (method {}{})", muscle, parameter, name(method), branch_text(fit_case, ", "));
}

Remark in_one_session(const std::string& number, const char* session) {
  return {.severity = Severity::note,
          .about = number,
          .says = fmt::format("{} is in the {} session only", number, session)};
}

/// Returns the day on which a folder's result was written.
std::string day_of(const std::filesystem::path& folder) {
  using namespace std::chrono;
  std::error_code error;
  const auto written = std::filesystem::last_write_time(folder / "parameters.json", error);
  if (error) return "";
  return day_text(floor<days>(file_clock::to_sys(written)));
}

/// A number of two runs is compared by a test of two sessions, by its difference alone, or not at all.
enum class Test { of_sessions, of_treatments, none };

/// Returns a number of both sessions with its difference, before the adjustment.
ComparedParameter compared(const Run& run, const Key& key, const ParameterEstimate& second, Test test) {
  ComparedParameter p{.muscle = std::get<0>(key), .first = run.estimates.at(key), .second = second};
  if (const auto sharers = run.sharers.find(key); sharers != run.sharers.end())
    p.muscle += fmt::format(", {}", fmt::join(sharers->second, ", "));
  const auto [one, other] = of_sessions(p.first, p.second);
  p.of_first = one.shown;
  p.of_second = other.shown;
  p.difference = other.shown.value - one.shown.value;
  const bool both_tell = told(p.first) && told(p.second);
  if (both_tell && test == Test::of_treatments) p.change = Change::treatment;
  if (both_tell && test == Test::of_sessions) {
    const double se = std::hypot(one.sd, other.sd);
    p.smallest_detectable = kNormal95 * se;
    p.p_alone = std::erfc(std::abs(p.difference) / se / std::sqrt(2.0));
    p.p_value = p.p_alone;
  }
  return p;
}

/// Returns the sentence about the recording that both runs rest on; empty: they rest on two.
std::string one_recording(const study::RunIdentity& first, const study::RunIdentity& second) {
  if (!study::of_one_recording(first, second)) return "";
  const std::vector<std::string> common = study::common_recordings(first, second);
  constexpr std::size_t kNamed = 4;
  std::vector<std::string> settings = study::differing_settings(first, second);
  const std::size_t more = settings.size() - std::min(settings.size(), kNamed);
  settings.resize(settings.size() - more);
  const std::string by = settings.empty() ? std::string("their settings are the same")
                                          : fmt::format("they differ in the settings {}{}", fmt::join(settings, ", "),
                                                        more > 0 ? fmt::format(" and {} more", more) : "");
  return fmt::format("Both runs rest on the same recording ({} of {} files, such as {}), and {}", common.size(),
                     first.recordings.size(), common.front(), by);
}

std::vector<ComparedTrial> compared_trials(const Run& a, const Run& b) {
  const auto rmse = [](const Run& run, const MethodAndTrial& key) {
    const auto found = run.rmse_nm.find(key);
    return found == run.rmse_nm.end() ? std::nullopt : found->second;
  };
  std::vector<ComparedTrial> trials;
  for (const MethodAndTrial& key : a.trial_order) trials.push_back({key.second, key.first, rmse(a, key), rmse(b, key)});
  for (const MethodAndTrial& key : b.trial_order) {
    if (!a.rmse_nm.contains(key)) trials.push_back({key.second, key.first, std::nullopt, rmse(b, key)});
  }
  return trials;
}

}  // namespace

std::string_view name(Change change) {
  static constexpr std::array<std::string_view, 4> kNames{"differs", "no_change", "cannot_tell", "treatment"};
  return kNames[static_cast<std::size_t>(change)];
}

std::vector<fit::Method> methods_of(const RunComparison& comparison) {
  std::vector<fit::Method> methods;
  for (const ComparedParameter& p : comparison.parameters) {
    if (std::ranges::find(methods, p.first.method) == methods.end()) methods.push_back(p.first.method);
  }
  return methods;
}

RunComparison compare_runs(const std::filesystem::path& first, const std::filesystem::path& second) {
  const Run a = read_run(first);
  const Run b = read_run(second);
  RunComparison comparison{
      .first = first, .second = second, .first_date = day_of(first), .second_date = day_of(second)};
  const study::RunIdentity one = study::read_run_identity(first), other = study::read_run_identity(second);
  comparison.one_recording = one_recording(one, other);
  study::IdentityDifferences unlike = study::differences(one, other);
  comparison.unlike = std::move(unlike.grave);
  std::ranges::move(unlike.other, std::back_inserter(comparison.unlike));
  const auto add_failed = [&](std::string_view which, const std::filesystem::path& folder) {
    if (const page::UnpassedGates gates = page::read_gates(folder); !gates.failed.empty())
      comparison.failed.push_back(fmt::format("the {} session failed: {}", which, fmt::join(gates.failed, "; ")));
  };
  add_failed("first", first);
  add_failed("second", second);
  if (a.posterior != b.posterior)
    comparison.unlike.push_back(
        "one is by the posterior, the other of exact data or by the estimator of an earlier version, whose F_max and "
        "intervals do not mean the same: run both sessions again");
  const Alike alike{.effort = !a.maximal || !b.maximal || *a.maximal == *b.maximal,
                    .muscles = muscles_of(a) == muscles_of(b)};
  if (!alike.effort)
    comparison.unlike.push_back(fmt::format(
        "the {} session has no maximal contraction: its strengths are at the largest EMG, those of the other "
        "at full effort, and are not compared",
        *a.maximal ? "second" : "first"));
  for (const Key& key : a.order) {
    const auto same = b.estimates.find(key);
    const bool usable = comparison.failed.empty() && alike.holds(std::get<1>(key));
    if (same == b.estimates.end())
      comparison.remarks.push_back(in_one_session(text_of(key), "first"));
    else
      comparison.parameters.push_back(compared(a, key, same->second,
                                               !usable                            ? Test::none
                                               : comparison.one_recording.empty() ? Test::of_sessions
                                                                                  : Test::of_treatments));
  }
  for (const Key& key : b.order) {
    if (!a.estimates.contains(key)) comparison.remarks.push_back(in_one_session(text_of(key), "second"));
  }
  for (const fit::Method method : methods_of(comparison)) {
    std::vector<ComparedParameter*> torques, others;
    for (ComparedParameter& p : comparison.parameters) {
      const bool torque = is_strength(p.first.parameter) && fit::is_voluntary(p.first.parameter);
      if (p.first.method == method && p.p_value) (torque ? torques : others).push_back(&p);
    }
    const double share = torques.empty() ? 0.0 : others.empty() ? 1.0 : kOfTorques;
    adjust_p_values(std::move(torques), share);
    adjust_p_values(std::move(others), 1.0 - share);
  }
  comparison.trials = compared_trials(a, b);
  return comparison;
}

}  // namespace myoid::results
