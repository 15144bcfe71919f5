#include "myoid/results/comparison/change_sentences.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/counted.h"
#include "myoid/page/muscle_names.h"
#include "myoid/page/plain_unit.h"
#include "myoid/page/tables.h"
#include "myoid/page/typeset.h"

namespace myoid::results {
namespace {

bool is_torque(const std::string& parameter) {
  return fit::is_voluntary(parameter) && !parameter.starts_with(fit::kVoluntaryAngle);
}

/// Returns "F_max", "greatest voluntary torque", "optimal fiber length".
std::string quantity(const std::string& parameter) {
  if (parameter == "max_isometric_force") return "F_max";
  return is_torque(parameter) ? "greatest voluntary torque" : page::spelled(parameter);
}

/// Returns "stronger: F_max larger", "optimal fiber length larger".
std::string direction(const std::string& parameter, double difference) {
  const bool more = difference > 0.0, strength = parameter == "max_isometric_force" || is_torque(parameter);
  return fmt::format("{}{} {}",
                     !strength ? ""
                     : more    ? "stronger: "
                               : "weaker: ",
                     quantity(parameter), more ? "larger" : "smaller");
}

std::string with_unit(double value, Unit unit) {
  const page::PlainUnit plain = page::plain_unit(unit);
  return page::format_value(value * plain.per_si) + (plain.symbol.empty() ? "" : fmt::format(" {}", plain.symbol));
}

/// Returns the place of a number in the sentence: strength, the other numbers of muscles, then electrodes and joint.
int rank(const fit::ParameterEstimate& e) {
  if (fit::is_nuisance(e)) return 3;
  if (fit::is_voluntary(e.parameter)) return 0;
  return e.parameter == "max_isometric_force" ? 1 : 2;
}

/// Returns the owners for people: "Biceps" of BIC, "elbow flexion" of a joint; several as they are.
std::string owner_of(const ComparedParameter& p) { return page::spelled(page::plain_muscle(p.muscle)); }

/// Returns "8 %", or the size itself where the number of the first session is no scale.
std::string share_or_size(const ComparedParameter& p, double size) {
  if (!has_scale(p)) return with_unit(size, p.first.unit);
  return percent_text(100.0 * size / std::abs(p.of_first.value)) + " %";
}

}  // namespace

bool has_scale(const ComparedParameter& p) { return p.of_first.value != 0.0 && p.first.unit != Unit::radian; }

std::string percent_text(double percent) {
  return std::abs(percent) < 99.5 ? fmt::format("{:.2g}", percent) : fmt::format("{:.0f}", percent);
}

bool rests_on_measurement(fit::Method method) { return method != fit::Method::paper; }

std::vector<const ComparedParameter*> counted_parameters(const RunComparison& comparison) {
  const auto is_torque = [](const auto& p) { return p.first.method == fit::Method::torque; };
  const bool torque = std::ranges::any_of(comparison.parameters, is_torque);
  std::vector<const ComparedParameter*> counted;
  for (const ComparedParameter& p : comparison.parameters) {
    if (torque ? is_torque(p) : rests_on_measurement(p.first.method)) counted.push_back(&p);
  }
  return counted;
}

std::string change_text(const ComparedParameter& p) {
  const double size = std::abs(p.difference);
  if (p.change == Change::treatment)
    return fmt::format("{}, {}: {}{} {} by the second treatment", owner_of(p), quantity(p.first.parameter),
                       with_unit(size, p.first.unit), has_scale(p) ? fmt::format(" ({})", share_or_size(p, size)) : "",
                       p.difference > 0.0 ? "more" : "less");
  if (p.change == Change::cannot_tell) {
    if (!rests_on_measurement(p.first.method))
      return fmt::format("{}: not compared: method {} fits forces that nobody measured", owner_of(p),
                         name(p.first.method));
    const auto told = [](const fit::ParameterEstimate& e) {
      return e.verdict == fit::Verdict::identified || e.verdict == fit::Verdict::reproducible ||
             e.verdict == fit::Verdict::weak;
    };
    if (told(p.first) && told(p.second))
      return fmt::format("{}: not compared: a gate of a session failed, or the recorded range ends there", owner_of(p));
    return fmt::format("{}: not compared: {} in the first session, {} in the second", owner_of(p),
                       name(p.first.verdict), name(p.second.verdict));
  }
  const double seen = *p.smallest_detectable;
  const std::string unseen = fmt::format("a change below {} would not have been seen", share_or_size(p, seen));
  if (p.differs_alone_only())
    return fmt::format(
        "{} {} by {}: by itself more than chance explains (p {:.2g}), but not among {} numbers (p {:.2g} by Holm)",
        owner_of(p), direction(p.first.parameter, p.difference), with_unit(size, p.first.unit), *p.p_alone, p.tested,
        *p.p_value);
  if (p.change == Change::no_change)
    return fmt::format("{}: no change of {} shows; {}", owner_of(p), quantity(p.first.parameter), unseen);
  const std::string share = has_scale(p) ? share_or_size(p, size) + ", " : "";
  return fmt::format("{} {} by {} ({}95 % {} to {}); {}", owner_of(p), direction(p.first.parameter, p.difference),
                     with_unit(size, p.first.unit), share,
                     page::format_value((size - seen) * page::plain_unit(p.first.unit).per_si),
                     with_unit(size + seen, p.first.unit), unseen);
}

std::string branch_text(fit::FitCase fit_case, std::string_view before, std::string_view behind) {
  return fit_case == fit::FitCase::both ? "" : fmt::format("{}{}{}", before, name(fit_case), behind);
}

std::string unlike_sentence(const RunComparison& comparison) {
  if (comparison.unlike.empty()) return "";
  return fmt::format("The two are not of one kind: {}.", fmt::join(comparison.unlike, "; "));
}

std::string reading_sentence(const RunComparison& comparison) {
  const bool given = std::ranges::any_of(
      comparison.parameters, [](const ComparedParameter& p) { return p.first.given_ci_low && p.second.given_ci_low; });
  if (!given) return "";
  return "These are the numbers given geometry and sensors, whose errors both sessions share. The report of each "
         "session shows the person's numbers first, which allow for such errors and so may differ.";
}

namespace {

constexpr std::size_t kNamedChanges = 4;

/// Says that the differences of one recording are of its treatment, and names the largest of strengths, else of the
/// other numbers.
std::string treatment_sentence(const RunComparison& comparison, const std::vector<const ComparedParameter*>& counted) {
  std::vector<const ComparedParameter*> found;
  std::ranges::copy_if(counted, std::back_inserter(found),
                       [](const ComparedParameter* p) { return p->change == Change::treatment && has_scale(*p); });
  const auto share = [](const ComparedParameter* p) { return std::abs(p->difference / p->of_first.value); };
  std::ranges::stable_sort(found, [&](const ComparedParameter* a, const ComparedParameter* b) {
    return std::pair(rank(a->first), -share(a)) < std::pair(rank(b->first), -share(b));
  });
  std::vector<std::string> largest;
  for (std::size_t i = 0; i < std::min(found.size(), kNamedChanges); ++i) largest.push_back(change_text(*found[i]));
  return fmt::format("{}: differences are of the treatment, not of the person{}{}.", comparison.one_recording,
                     largest.empty() ? "" : ". ", fmt::join(largest, ". "));
}

}  // namespace

std::string changes_sentence(const RunComparison& comparison) {
  if (!comparison.failed.empty())
    return fmt::format("No number is compared: {}. Mend that first.", fmt::join(comparison.failed, "; "));
  std::vector<const ComparedParameter*> counted = counted_parameters(comparison);
  if (!comparison.one_recording.empty()) return treatment_sentence(comparison, counted);
  std::ranges::stable_sort(counted, {}, [](const ComparedParameter* p) { return rank(p->first); });
  std::vector<std::string> found;
  std::size_t same = 0, untold = 0, alone = 0;
  int tested = 0;
  for (const ComparedParameter* p : counted) {
    if (p->change == Change::differs) found.push_back(change_text(*p));
    same += p->change == Change::no_change;
    untold += p->change == Change::cannot_tell;
    alone += p->differs_alone_only();
    tested += p->p_value ? 1 : 0;
  }
  std::string rest = fmt::format("{} no change, and of {} a recording does not tell enough",
                                 same == 1 ? "1 number shows" : fmt::format("{} numbers show", same), untold);
  if (alone > 0)
    rest += fmt::format(". {} by itself, but {} numbers were tested, of which one in 20 does so by chance (Holm)",
                        alone == 1 ? "1 of them differs" : fmt::format("{} of them differ", alone), tested);
  if (found.empty()) return fmt::format("No number changed by more than chance explains: {}.", rest);
  const std::size_t more = found.size() - std::min(found.size(), kNamedChanges);
  found.resize(found.size() - more);
  return fmt::format("{}{}. {}.", fmt::join(found, ". "), more > 0 ? fmt::format(". And {} more", more) : "", rest);
}

}  // namespace myoid::results
