#include "myoid/results/compare_runs.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/core/error.h"
#include "myoid/files/text_file.h"
#include "myoid/study/run_identity.h"

namespace myoid {
namespace {

using nlohmann::json;

constexpr double kLevel = 0.05;
constexpr double kNormal95 = 1.959963984540054;

std::optional<double> number(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

/// Muscle, parameter, method, case.
using Key = std::tuple<std::string, std::string, std::string, std::string>;

struct Run {
  json content;
  std::vector<Key> order;
  std::map<Key, std::pair<SessionEstimate, std::string>> estimates;  ///< With unit.
  std::map<Key, std::vector<std::string>> sharers;  ///< Further muscles of the same unknown.
  std::vector<std::pair<std::string, std::string>> trial_order;  ///< Method, trial.
  std::map<std::pair<std::string, std::string>, std::optional<double>> rmse_nm;
};

Run read_run(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "parameters.json";
  Run run;
  try {
    run.content = json::parse(recording::read_text_file(path));
    for (const json& method : run.content.at("methods")) {
      const auto method_name = method.at("method").get<std::string>();
      for (const json& e : method.at("estimates")) {
        const Key key{e.at("muscle"), e.at("parameter"), e.at("method"), e.at("case")};
        const std::optional<double> estimate = number(e, "estimate");
        if (!estimate) continue;
        // One unknown of several muscles is one number: the first owner's.
        if (const auto tied = e.value("tied_to", std::string()); !tied.empty()) {
          run.sharers[{tied, e.at("parameter"), e.at("method"), e.at("case")}].push_back(
              e.at("muscle").get<std::string>());
          continue;
        }
        run.order.push_back(key);
        run.estimates[key] = {{.estimate = *estimate,
                               .std_error = number(e, "std_error"),
                               .ci_low = number(e, "ci_low"),
                               .ci_high = number(e, "ci_high"),
                               .verdict = e.at("verdict")},
                              e.at("unit").get<std::string>()};
      }
      for (const json& trial : method.at("trials")) {
        const std::pair key{method_name, trial.at("trial").get<std::string>()};
        run.trial_order.push_back(key);
        run.rmse_nm[key] = number(trial, "rmse_nm");
      }
    }
  } catch (const json::exception& error) {
    throw ReadError(path, 0,
                    fmt::format("is not the result of a run: {}; run the study (myoid run) and "
                                "give the folder of its result",
                                error.what()));
  }
  return run;
}

bool told(const SessionEstimate& e) {
  return (e.verdict == "identified" || e.verdict == "weak") && e.std_error && *e.std_error > 0.0;
}

/// Holm (1979): the k-th smallest of n p-values times n - k + 1, never below an earlier one.
void adjust_p_values(std::vector<ComparedParameter*> compared) {
  std::sort(compared.begin(), compared.end(),
            [](const auto* a, const auto* b) { return *a->p_value < *b->p_value; });
  double largest = 0.0;
  for (std::size_t k = 0; k < compared.size(); ++k) {
    largest = std::max(
        largest, std::min(1.0, *compared[k]->p_value * static_cast<double>(compared.size() - k)));
    compared[k]->p_value = largest;
    compared[k]->change = largest < kLevel ? Change::differs : Change::no_change;
  }
}

std::string text_of(const Key& key) {
  const auto& [muscle, parameter, method, fit_case] = key;
  return fmt::format("{} {} (method {}{})", muscle, parameter, method,
                     fit_case == "both" ? std::string() : ", " + fit_case);
}

std::string interval_text(const SessionEstimate& e) {
  const std::string value = report::format_value(e.estimate);
  if (!e.ci_low || !e.ci_high) return value;
  return fmt::format("{} ({})", value, report::format_interval(*e.ci_low, *e.ci_high));
}

report::Badge badge(Change change) {
  switch (change) {
    case Change::differs:
      return report::Badge::info;
    case Change::no_change:
      return report::Badge::good;
    case Change::cannot_tell:
      return report::Badge::weak;
  }
  return report::Badge::none;
}

std::string sentence(const ComparedParameter& p) {
  switch (p.change) {
    case Change::differs:
      return fmt::format("differs: p = {:.2g}, adjusted for the number of parameters", *p.p_value);
    case Change::no_change:
      return fmt::format("no difference shows; one below {} {} would not have been seen",
                         report::format_value(*p.smallest_detectable, 2), p.unit);
    case Change::cannot_tell:
      return fmt::format("not compared: {} in the first session, {} in the second", p.first.verdict,
                         p.second.verdict);
  }
  return {};
}

/// Both intervals of one parameter over the muscles.
report::Panel panel_of(const RunComparison& comparison,
                       const std::string& method,
                       const std::string& parameter,
                       const std::string& fit_case) {
  report::Panel panel;
  panel.title = parameter + (fit_case == "both" ? "" : ", " + fit_case);
  report::Series first{.name = "first",
                       .x = {},
                       .y = {},
                       .role = report::Role::points,
                       .y_lower = {},
                       .y_upper = {}};
  report::Series second = first;
  second.name = "second";
  for (const ComparedParameter& p : comparison.parameters) {
    if (p.method != method || p.parameter != parameter || p.fit_case != fit_case) continue;
    panel.y.label = parameter;
    panel.y.unit = p.unit == "1" ? "" : p.unit;
    const auto at = static_cast<double>(panel.x.categories.size() / 2);
    panel.x.categories.push_back(p.muscle + " 1");
    panel.x.categories.push_back(p.muscle + " 2");
    const auto add = [](report::Series& series, double x, const SessionEstimate& e) {
      series.x.push_back(x);
      series.y.push_back(e.estimate);
      series.y_lower.push_back(e.ci_low.value_or(e.estimate));
      series.y_upper.push_back(e.ci_high.value_or(e.estimate));
    };
    add(first, 2.0 * at, p.first);
    add(second, 2.0 * at + 1.0, p.second);
  }
  panel.series = {first, second};
  return panel;
}

}  // namespace

std::string_view name(Change change) {
  switch (change) {
    case Change::differs:
      return "differs";
    case Change::no_change:
      return "no_change";
    case Change::cannot_tell:
      return "cannot_tell";
  }
  return "?";
}

RunComparison compare_runs(const std::filesystem::path& first,
                           const std::filesystem::path& second) {
  const Run a = read_run(first);
  const Run b = read_run(second);
  RunComparison comparison{.first = first,
                           .second = second,
                           .parameters = {},
                           .trials = {},
                           .unlike = {},
                           .remarks = {}};
  IdentityDifferences unlike = differences(read_run_identity(first), read_run_identity(second));
  comparison.unlike = std::move(unlike.grave);
  std::move(unlike.other.begin(), unlike.other.end(), std::back_inserter(comparison.unlike));
  for (const Key& key : a.order) {
    const auto other = b.estimates.find(key);
    if (other == b.estimates.end()) {
      comparison.remarks.push_back(text_of(key) + " is in the first session only");
      continue;
    }
    const auto& [estimate, unit] = a.estimates.at(key);
    ComparedParameter p{.muscle = std::get<0>(key),
                        .parameter = std::get<1>(key),
                        .unit = unit,
                        .method = std::get<2>(key),
                        .fit_case = std::get<3>(key),
                        .first = estimate,
                        .second = other->second.first};
    if (const auto sharers = a.sharers.find(key); sharers != a.sharers.end())
      p.muscle += fmt::format(", {}", fmt::join(sharers->second, ", "));
    p.difference = p.second.estimate - p.first.estimate;
    if (told(p.first) && told(p.second)) {
      const double se = std::hypot(*p.first.std_error, *p.second.std_error);
      p.smallest_detectable = kNormal95 * se;
      p.p_value = std::erfc(std::abs(p.difference) / se / std::sqrt(2.0));
    }
    comparison.parameters.push_back(std::move(p));
  }
  for (const Key& key : b.order) {
    if (!a.estimates.contains(key))
      comparison.remarks.push_back(text_of(key) + " is in the second session only");
  }
  std::set<std::string> methods;
  for (const ComparedParameter& p : comparison.parameters) methods.insert(p.method);
  for (const std::string& method : methods) {
    std::vector<ComparedParameter*> compared;
    for (ComparedParameter& p : comparison.parameters) {
      if (p.method == method && p.p_value) compared.push_back(&p);
    }
    adjust_p_values(std::move(compared));
  }
  const auto rmse = [](const Run& run, const std::pair<std::string, std::string>& key) {
    const auto found = run.rmse_nm.find(key);
    return found == run.rmse_nm.end() ? std::nullopt : found->second;
  };
  for (const auto& key : a.trial_order)
    comparison.trials.push_back({key.second, key.first, rmse(a, key), rmse(b, key)});
  for (const auto& key : b.trial_order) {
    if (!a.rmse_nm.contains(key))
      comparison.trials.push_back({key.second, key.first, std::nullopt, rmse(b, key)});
  }
  return comparison;
}

report::Report comparison_report(const RunComparison& comparison) {
  report::Report page;
  page.title = "Two sessions compared";
  page.subtitle = comparison.first.string() + " and " + comparison.second.string();
  std::map<Change, int> count;
  for (const ComparedParameter& p : comparison.parameters) ++count[p.change];
  page.headline = fmt::format(
      "Of {} numbers that both sessions hold, {} differ by more than chance explains, {} show no "
      "difference, and {} cannot be compared because a recording does not determine them.",
      comparison.parameters.size(), count[Change::differs], count[Change::no_change],
      count[Change::cannot_tell]);
  if (!comparison.unlike.empty())
    page.headline +=
        fmt::format(" The two are not of one kind: {}.", fmt::join(comparison.unlike, "; "));
  std::vector<std::string> methods;
  for (const ComparedParameter& p : comparison.parameters) {
    if (std::find(methods.begin(), methods.end(), p.method) == methods.end())
      methods.push_back(p.method);
  }
  for (const std::string& method : methods) {
    report::Section section{.id = "method_" + method, .heading = "Method " + method};
    report::Table table{
        .id = "compared_" + method,
        .title = "Parameters",
        .caption =
            "Estimate with its 95 % interval. p-values are adjusted for their number (Holm).",
        .columns = {"muscle", "parameter", "unit", "first", "second", "difference", "verdict"},
        .rows = {}};
    std::vector<std::pair<std::string, std::string>> panels;
    for (const ComparedParameter& p : comparison.parameters) {
      if (p.method != method) continue;
      table.rows.push_back({{p.muscle},
                            {p.parameter + (p.fit_case == "both" ? "" : " (" + p.fit_case + ")")},
                            {p.unit},
                            {interval_text(p.first)},
                            {interval_text(p.second)},
                            {report::format_value(p.difference)},
                            {std::string(name(p.change)), badge(p.change), sentence(p)}});
      const std::pair panel{p.parameter, p.fit_case};
      if (std::find(panels.begin(), panels.end(), panel) == panels.end()) panels.push_back(panel);
    }
    section.tables.push_back(std::move(table));
    report::Figure figure{
        .id = "intervals_" + method,
        .title = "Both sessions",
        .caption = "Estimates with 95 % intervals; 1 the first session, 2 the second.",
        .panels = {},
        .columns = 2};
    for (const auto& [parameter, fit_case] : panels)
      figure.panels.push_back(panel_of(comparison, method, parameter, fit_case));
    section.figures.push_back(std::move(figure));
    page.sections.push_back(std::move(section));
  }
  report::Section trials{.id = "trials", .heading = "How well the trials are predicted"};
  report::Table errors{.id = "trial_errors",
                       .title = "Root mean square error of the torque",
                       .caption = "",
                       .columns = {"trial", "method", "first [N m]", "second [N m]"},
                       .rows = {}};
  const auto cell = [](const std::optional<double>& x) {
    return report::Cell{x ? report::format_value(*x) : "-"};
  };
  for (const ComparedTrial& t : comparison.trials)
    errors.rows.push_back({{t.trial}, {t.method}, cell(t.rmse_first_nm), cell(t.rmse_second_nm)});
  trials.tables.push_back(std::move(errors));
  trials.paragraphs = comparison.remarks;
  page.sections.push_back(std::move(trials));
  page.assumptions = {
      "The two sessions are independent; where both used the same prior, the test is cautious.",
      "A number that a session calls prior_dominated, not_identifiable or non_physical is not "
      "compared."};
  return page;
}

}  // namespace myoid
