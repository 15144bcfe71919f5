#include "myoid/results/answer.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/wrapped_text.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/page/light.h"
#include "myoid/page/muscle_names.h"
#include "myoid/page/plain_unit.h"
#include "myoid/page/typeset.h"
#include "myoid/results/parameter_tables.h"
#include "myoid/results/voluntary_report.h"
#include "myoid/run/design/design_study.h"
#include "myoid/run/effort_prior.h"
#include "myoid/run/prediction_gates.h"
#include "myoid/run/recording_faults.h"

namespace myoid::results {
namespace {

using fit::IdentificationResult;
using fit::ParameterEstimate;
using fit::Verdict;

constexpr std::size_t kMostRows = 10;
constexpr std::size_t kMostReasons = 4;

/// Returns true for a parameter of its own: no nuisance, not tied to another, and no torque that follows from others.
bool is_counted(const ParameterEstimate& e) {
  return !fit::is_nuisance(e) && e.tied_to.empty() && !fit::is_voluntary(e.parameter);
}

/// Lists the numbers that are identified: "max isometric force of Biceps, Triceps; EMG delay of the person".
std::string identified_numbers(const IdentificationResult& fit, std::size_t muscle_count) {
  std::vector<std::pair<std::string, std::vector<std::string>>> owners;
  for (const EstimateLine& line : estimate_lines(fit, muscle_count)) {
    const ParameterEstimate& e = *line.estimate;
    if (!is_counted(e) || e.verdict != Verdict::identified) continue;
    auto of = std::ranges::find(owners, e.parameter, [](const auto& entry) { return entry.first; });
    if (of == owners.end()) of = owners.insert(owners.end(), {e.parameter, {}});
    of->second.push_back(e.muscle == "subject" ? "the person" : plain_owner(line));
  }
  std::vector<std::string> parts;
  for (const auto& [parameter, muscles] : owners)
    parts.push_back(fmt::format("{} of {}", page::spelled(parameter), fmt::join(muscles, ", ")));
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string ends(const std::optional<double>& low, const std::optional<double>& high, double per_si) {
  return low && high ? page::format_interval(*low * per_si, *high * per_si) : "";
}

AnswerRow row_of(std::string number, const ParameterEstimate& e, std::string_view place) {
  const page::PlainUnit unit = page::plain_unit(e.unit);
  const auto scaled = [&](const std::optional<double>& x) { return x ? std::optional(*x * unit.per_si) : x; };
  AnswerRow row{.number = std::move(number),
                .value = page::format_beside(e.estimate * unit.per_si, scaled(e.ci_low), scaled(e.ci_high)),
                .of_person = ends(e.ci_low, e.ci_high, unit.per_si),
                .given = ends(e.given_ci_low, e.given_ci_high, unit.per_si),
                .verdict = page::spelled(fit::name(e.verdict))};
  row.outside_given =
      e.given_ci_low && e.given_ci_high && (e.estimate < *e.given_ci_low || e.estimate > *e.given_ci_high);
  if (!unit.symbol.empty()) row.value += fmt::format(" {}", unit.symbol);
  if (!place.empty()) row.value += fmt::format(" at {}", place);
  return row;
}

/// Returns the numbers beside the greatest voluntary torques that the recording tells, the best known first.
std::vector<EstimateLine> told_lines(const IdentificationResult& method, std::size_t muscle_count) {
  std::vector<EstimateLine> lines = estimate_lines(method, muscle_count);
  std::erase_if(lines, [](const EstimateLine& line) {
    return fit::is_nuisance(*line.estimate) || !is_told(*line.estimate) || !line.estimate->ci_low;
  });
  std::ranges::stable_sort(lines, {}, [](const EstimateLine& line) {
    return std::pair(line.estimate->verdict, run::relative_half_width(*line.estimate));
  });
  return lines;
}

/// Returns "the greatest torque of 3 of 4 muscles", or that at the largest EMG; empty: none is identified.
std::string identified_torques(const IdentificationResult& fit) {
  int total = 0, sure = 0;
  for (const VoluntaryLine& line : voluntary_lines(fit)) {
    if (line.curve->of_joint) continue;
    ++total;
    sure += line.torque->verdict == Verdict::identified;
  }
  const bool maximal = std::ranges::all_of(fit.voluntary, &fit::VoluntaryCurve::from_mvc);
  return sure == 0
             ? ""
             : fmt::format("the {} of {} of {} muscle{}", maximal ? "greatest torque" : "torque at the largest EMG",
                           sure, total, total == 1 ? "" : "s");
}

/// Returns how many numbers the fit identifies, in sentences.
std::string count_sentences(const IdentificationResult& fit, std::size_t muscle_count, bool with_names) {
  int total = 0, sure = 0, repeat = 0, weak = 0;
  for (const ParameterEstimate& e : fit.estimates) {
    if (!is_counted(e)) continue;
    ++total;
    if (e.verdict == Verdict::identified) ++sure;
    if (e.verdict == Verdict::reproducible) ++repeat;
    if (e.verdict == Verdict::weak) ++weak;
  }
  const std::string torques = identified_torques(fit);
  std::string text = "This recording identifies ";
  if (!torques.empty()) text += torques + " and ";
  text += sure == 0 ? fmt::format("none of {} parameters with certainty", total)
                    : fmt::format("{} of {} parameters", sure, total);
  if (sure > 0 && with_names) text += ": " + identified_numbers(fit, muscle_count);
  text += ".";
  if (repeat > 0)
    text += fmt::format(" {} {} reproducible: good for comparing sessions of this person, not as a size.", repeat,
                        repeat == 1 ? "is" : "are");
  if (weak > 0) text += fmt::format(" {} {} known with a wide interval.", weak, weak == 1 ? "is" : "are");
  return text;
}

/// Returns true if R2 tells something of the torque: its standard deviation is 5 % of its root mean square or more.
bool varies(const fit::Score& score) {
  constexpr double kShare = 0.05;
  const double variance = score.sst / score.n;
  return score.n > 0.0 && variance > kShare * kShare * (variance + score.mean_nm * score.mean_nm);
}

/// Returns how well the fit predicts what it left out, with a blank before it; empty without folds.
std::string fold_sentence(const run::StudyResult& result) {
  std::vector<double> ours, theirs;
  for (const fit::Fold& f : result.folds) {
    if (!varies(f.identified)) continue;
    ours.push_back(f.identified.r2());
    theirs.push_back(f.literature.r2());
  }
  if (ours.empty()) return "";
  const std::string of =
      ours.size() == result.folds.size() ? "median" : fmt::format("median of {} that vary", ours.size());
  const auto share = [](std::vector<double> r2) {
    const double x = math::median(std::move(r2));
    return x > 0.99 ? "more than 99 %" : x > 0.0 ? fmt::format("{:.0f} %", 100.0 * x) : std::string("nothing");
  };
  return fmt::format(" Of the {} in {}s left out of the fit these muscles explain {} (R2, {}); the literature's, {}.",
                     run::torque_of(result.fit) == nullptr ? "force" : "torque",
                     choice_name(result.source.study.identify.folds), share(std::move(ours)), of,
                     share(std::move(theirs)));
}

/// Returns how many intervals of a virtual person hold the truth; empty: no truth is known.
std::string truth_sentence(const run::StudyResult& result, const IdentificationResult& method) {
  int known = 0, held = 0;
  for (const ParameterEstimate& e : method.estimates) {
    const std::optional<double> truth = truth_of(result, e);
    if (!truth || !e.ci_low || !e.ci_high) continue;
    ++known;
    held += *truth >= *e.ci_low && *truth <= *e.ci_high;
  }
  return known == 0 ? "" : fmt::format("Of {} numbers with a known truth {} intervals hold it.", known, held);
}

std::size_t line_count(const std::string& text) { return static_cast<std::size_t>(std::ranges::count(text, '\n')); }

/// Returns a reason whole, with the expected value where both fit into two lines.
std::string reason_lines(const page::Gate& gate, std::size_t width) {
  constexpr std::size_t kFew = 2;
  const std::string found = with_short_words(fmt::format("- {}: {}", gate.name, gate.value), width);
  const std::string text = wrapped(fmt::format("{} (expected: {})", found, gate.threshold), width);
  return gate.explains || line_count(text) > kFew ? wrapped(found, width) : text;
}

/// Returns the light with its reasons: the first `whole` ones with their text, the others by their names.
std::string light_lines(const std::vector<page::Gate>& gates, std::size_t width, std::size_t whole) {
  if (gates.empty()) return "";
  const page::Light light = page::light_of(gates);
  std::string text = wrapped(fmt::format("{}. {}{}", light.head, light.answered, light.leads_to), width);
  for (std::size_t i = 0; i < std::min(light.reasons.size(), whole); ++i) text += reason_lines(light.reasons[i], width);
  std::vector<std::string> others;  // by name, so that nothing that colors the page is hidden
  for (std::size_t i = whole; i < light.reasons.size(); ++i) others.push_back(light.reasons[i].name);
  if (!others.empty()) text += wrapped(fmt::format("- and {}", fmt::join(others, "; ")), width);
  return light.besides.empty() ? text : text + wrapped(light.besides, width);
}

std::string row_lines(const std::vector<AnswerRow>& rows, std::size_t width) {
  if (rows.empty()) return "";
  AnswerRow head{.number = "", .value = "", .of_person = "95 % interval", .given = "", .verdict = "verdict"};
  if (std::ranges::any_of(rows, [](const AnswerRow& row) { return !row.given.empty(); })) head.given = "given";
  std::vector<AnswerRow> all{std::move(head)};
  all.insert(all.end(), rows.begin(), rows.end());
  const auto widest = [&](std::string AnswerRow::*column) {
    return std::ranges::max(all, {}, [&](const AnswerRow& row) { return columns_of(row.*column); }).*column;
  };
  const std::size_t value = columns_of(widest(&AnswerRow::value)), person = columns_of(widest(&AnswerRow::of_person)),
                    given = columns_of(widest(&AnswerRow::given)), verdict = columns_of(widest(&AnswerRow::verdict));
  const std::size_t others = value + person + given + verdict + 8;
  const std::size_t number =
      std::min(columns_of(widest(&AnswerRow::number)), width > others + 20 ? width - others : 20);
  const auto padded = [](const std::string& text, std::size_t to) {
    return text + std::string(to - std::min(to, columns_of(text)), ' ');
  };
  std::string text;
  for (const AnswerRow& row : all) {
    std::string line = padded(elided(row.number, number), number) + "  " + padded(row.value, value) + "  " +
                       padded(row.of_person, person) + "  ";
    if (given > 0) line += padded(row.given, given) + "  ";
    text += line + row.verdict + "\n";
  }
  const bool outside = std::ranges::any_of(rows, &AnswerRow::outside_given);
  if (given > 0)
    text += wrapped(
        fmt::format("95 % interval: of the person. Given: if geometry and sensors were exact, to compare sessions.{}",
                    outside ? " A number outside Given: the recording speaks for others than assumed." : ""),
        width);
  return text;
}

/// A trial's remark in few words; a lower rank is worse.
struct TrialRemark {
  int rank = 0;
  std::string trial, says;
};

/// Returns the worst that is known against each trial, the worst first.
std::vector<TrialRemark> trial_remarks(const run::StudyResult& result) {
  const std::vector<run::OutlyingFold> outlying = run::outlying_folds(result.folds);
  const run::MistakenEmg* mistaken = run::named_mistake(result);
  const auto in_words = [](const Remark& remark) {
    if (remark.code == RemarkCode::general || remark.code == RemarkCode::reading) return elided(remark.says, 100);
    return page::spelled(name(remark.code)) + (remark.about.empty() ? "" : ": " + remark.about) +
           (remark.likewise.empty() ? "" : fmt::format(", likewise in {} more", remark.likewise.size()));
  };
  std::vector<TrialRemark> found;
  for (const run::TrialResult& trial : result.trials) {
    TrialRemark remark{.rank = 3, .trial = trial.spec.name};
    const auto worse = [&](int rank, const std::string& says) {
      if (rank >= remark.rank) return;
      remark.rank = rank;
      remark.says = says;
    };
    for (const std::vector<Remark>* list : {&trial.faults, &trial.remarks})
      for (const Remark& one : *list)
        if (one.severity <= Severity::warning) worse(2, in_words(one));
    if (mistaken != nullptr && mistaken->trial == trial.spec.name) worse(1, mistaken->about_trial());
    if (std::ranges::find(outlying, trial.spec.name, &run::OutlyingFold::trial) != outlying.end())
      worse(1, "predicted worse than the others");
    if (!trial.failure().empty()) worse(0, "could not be computed");
    if (remark.rank < 3) found.push_back(std::move(remark));
  }
  std::ranges::stable_sort(found, {}, &TrialRemark::rank);
  return found;
}

}  // namespace

std::vector<AnswerRow> answer_rows(const IdentificationResult& method, std::size_t muscle_count, std::size_t most) {
  std::vector<AnswerRow> rows;
  const bool maximal = std::ranges::all_of(method.voluntary, &fit::VoluntaryCurve::from_mvc);
  for (const VoluntaryLine& line : voluntary_lines(method)) {
    if (!is_told(*line.torque)) continue;
    const bool placed = line.angle != nullptr && is_told(*line.angle);
    rows.push_back(row_of(short_name(*line.curve) + (maximal ? ", greatest torque" : ", at the largest EMG"),
                          *line.torque, placed ? line.place : ""));
  }
  for (const EstimateLine& line : told_lines(method, muscle_count))
    rows.push_back(
        row_of(fmt::format("{}, {}", plain_owner(line), page::spelled(line.estimate->parameter)), *line.estimate, ""));
  if (rows.size() > most) rows.resize(most);
  return rows;
}

std::string fit_sentences(const run::StudyResult& result, bool with_names) {
  const IdentificationResult* best = run::best_method(result.fit);
  if (best == nullptr)
    return "Only the source paper's method was asked for. Unless its forces were measured, this recording identifies "
           "nothing by it; its numbers stand at the end.";
  std::string text = count_sentences(*best, result.fit_input.data.muscles.size(), with_names);
  if (const std::string truth = truth_sentence(result, *best); !truth.empty()) text += " " + truth;
  return text + fold_sentence(result);
}

std::string next_sentence(const run::StudyResult& result, const std::vector<page::Gate>& gates) {
  if (std::ranges::find(gates, page::GateStatus::fail, &page::Gate::status) != gates.end())
    return "First mend what failed, and run again: recordings that are planned on such numbers may tell nothing.";
  if (!result.next || result.next->plan.empty()) return "";
  const std::string first = run::from_maximal_effort(result.source.study.emg)
                                ? ""
                                : "Record a maximal contraction of every muscle: no movement stands in for it. ";
  const run::DesignStudyResult& next = *result.next;
  const std::size_t named = std::min<std::size_t>(2, next.plan.size());
  std::vector<std::string> movements;
  for (std::size_t i = 0; i < named; ++i) movements.push_back(next.plan[i].movement.description());
  const std::vector<ParameterEstimate>& then = next.plan[named - 1].expected;
  const double now = run::median_half_width(next.beforehand), narrower = run::median_half_width(then);
  const int more = run::identified_count(then) - run::identified_count(next.beforehand);
  constexpr double kLittle = 0.95;  // of the interval
  if (more <= 0 && narrower > kLittle * now)
    return first + fmt::format(
                       "Further movements tell little more: {} would leave the median 95 % interval at +-{:.0f} % (now "
                       "+-{:.0f} %).",
                       fmt::join(movements, "; "), narrower, now);
  return first + fmt::format("Record next: {}. The median 95 % interval would be +-{:.0f} % (now +-{:.0f} %){}.",
                             fmt::join(movements, "; "), narrower, now,
                             more > 0 ? fmt::format(", and {} more would be identified", more) : "");
}

std::string trials_sentence(const run::StudyResult& result, std::size_t most) {
  const std::vector<TrialRemark> found = trial_remarks(result);
  if (found.empty()) return result.trials.empty() ? "" : "No trial has a warning.";
  std::vector<std::string> named;
  for (std::size_t i = 0; i < std::min(most, found.size()); ++i)
    named.push_back(fmt::format("{} ({})", found[i].trial, found[i].says));
  const std::string more = found.size() > most ? fmt::format(" and {} more", found.size() - most) : "";
  return fmt::format("Trials with warnings: {}{}.", fmt::join(named, ", "), more);
}

std::string answer_text(const run::StudyResult& result, const std::vector<page::Gate>& gates, std::size_t width) {
  constexpr std::size_t kMostLines = 24, kFewestRows = 4;
  std::string rest = wrapped(fit_sentences(result, false), width);
  for (const std::string& more : {trials_sentence(result), next_sentence(result, gates)})
    if (!more.empty()) rest += wrapped(more, width);
  const IdentificationResult* best = run::best_method(result.fit);
  std::vector<AnswerRow> rows;
  if (best != nullptr) rows = answer_rows(*best, result.fit_input.data.muscles.size(), kMostRows);
  const auto room = [&](const std::string& light) {  // a heading, a legend, a line between
    return kMostLines - std::min(kMostLines, line_count(light) + line_count(rest) + 5);
  };
  std::size_t whole = kMostReasons;
  std::string light = light_lines(gates, width, whole);
  while (whole > 1 && room(light) < std::min(rows.size(), kFewestRows)) light = light_lines(gates, width, --whole);
  rows.resize(std::min(rows.size(), room(light)));
  if (!light.empty()) light += "\n";
  return light + row_lines(rows, width) + (rows.empty() ? "" : "\n") + rest;
}

}  // namespace myoid::results
