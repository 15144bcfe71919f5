#include "myoid/results/review/review_report.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/page/muscle_names.h"
#include "myoid/page/plain_unit.h"
#include "myoid/page/typeset.h"
#include "myoid/results/answer.h"
#include "myoid/results/parameter_tables.h"

namespace myoid::results {
namespace {

using page::Badge;
using page::Table;

constexpr double kMuch = 0.1;                ///< Share of a joint's strength without EMG that a finding names.
constexpr double kShown_s = 30.0;            ///< Of a long trial; the table of the figure has all.
constexpr std::size_t kNamed = 6;            ///< Muscles that a sentence names.
constexpr double kGood = 0.75, kFair = 0.5;  ///< R2.

std::string joint_name(const std::string& joint) { return page::spelled(joint); }

std::string first_names(const std::vector<std::string>& names) {
  const std::vector<std::string> some(names.begin(), names.begin() + static_cast<long>(std::min(kNamed, names.size())));
  return fmt::format("{}{}", fmt::join(some, ", "), names.size() > kNamed ? ", …" : "");
}

std::vector<double> r2_of(const SecondOpinion& opinion,
                          std::optional<fit::Score> ReviewedTorque::*score,
                          std::optional<bool> calibrating) {
  std::vector<double> values;
  for (const ReviewedTorque& t : opinion.torques)
    if ((t.*score) && (!calibrating || t.is_calibrating == *calibrating)) values.push_back((t.*score)->r2());
  std::ranges::sort(values);
  return values;
}

/// Returns "0.64", or "−0.7 to 0.14".
std::string range_text(const std::vector<double>& sorted) {
  const std::string low = fit::r2_text(sorted.front()), high = fit::r2_text(sorted.back());
  return low == high ? low : low + " to " + high;
}

std::string torque_sentence(const SecondOpinion& opinion) {
  std::vector<std::string> parts;
  const std::vector<double> fitted = r2_of(opinion, &ReviewedTorque::theirs, true);
  const std::vector<double> other = r2_of(opinion, &ReviewedTorque::theirs, false);
  const std::vector<double> ours = r2_of(opinion, &ReviewedTorque::ours, std::nullopt);
  if (!opinion.no_law.empty())
    parts.push_back(fmt::format("The calibration's torque is not computed: {}.", opinion.no_law));
  if (!fitted.empty())
    parts.push_back(
        fmt::format("The calibrated subject meets the torque of the trials that were fitted with an R2 of {}.",
                    range_text(fitted)));
  if (!other.empty())
    parts.push_back(fmt::format("{} with an R2 of {}.",
                                fitted.empty() ? "The calibrated subject meets the measured torque"
                                               : "Of other trials the subject predicts the torque",
                                range_text(other)));
  if (!ours.empty())
    parts.push_back(fmt::format("Myoid's fit of the same files predicts trials that were left out with an R2 of {}.",
                                range_text(ours)));
  return fmt::format("{}", fmt::join(parts, " "));
}

std::string bounds_sentence(const SecondOpinion& opinion) {
  if (opinion.unknowns == 0) return "";
  std::string text =
      fmt::format("{} of {} calibrated numbers lie on a bound: there the bound speaks, not the recording.",
                  opinion.on_bound, opinion.unknowns);
  if (opinion.on_bound == 0) text = fmt::format("None of {} calibrated numbers lies on a bound.", opinion.unknowns);
  if (opinion.independent_rows > 0.0)
    text += fmt::format(" The calibration's trials hold at most {:.0f} independent samples for {} unknowns.",
                        opinion.independent_rows, opinion.unknowns);
  return text;
}

std::string numbers_sentence(const SecondOpinion& opinion) {
  if (opinion.numbers.empty()) return "";
  const auto count = [&](Standing standing) {
    return std::ranges::count(opinion.numbers, standing, &ReviewedNumber::standing);
  };
  return fmt::format(
      "Of {} numbers of the muscles the recording tells {}: the calibration agrees in {}, and differs in {}. The "
      "others "
      "could be many values.",
      opinion.numbers.size(), count(Standing::agrees) + count(Standing::differs), count(Standing::agrees),
      count(Standing::differs));
}

std::string direction(const JointStrength& strength) {
  return fmt::format("{} ({} direction)", joint_name(strength.joint), strength.is_positive ? "positive" : "negative");
}

std::string strength_sentence(const SecondOpinion& opinion) {
  std::vector<std::string> parts;
  for (const JointStrength& s : opinion.strengths) {
    if (s.without_emg_nm < kMuch * s.all_nm) continue;
    parts.push_back(fmt::format("{:.0f} % of the strength of {} has no EMG: nothing is told about {}.",
                                100.0 * s.without_emg_nm / s.all_nm, direction(s), first_names(s.without_emg)));
  }
  for (const std::string& knee : knees_without_extensor(opinion.project))
    parts.push_back(fmt::format("No muscle of the quadriceps has EMG: {} cannot be extended.", joint_name(knee)));
  return fmt::format("{}", fmt::join(parts, " "));
}

Badge badge_of(const std::optional<fit::Score>& score) {
  if (!score) return Badge::none;
  return score->r2() >= kGood ? Badge::good : score->r2() >= kFair ? Badge::weak : Badge::bad;
}

page::Cell r2_cell(const std::optional<fit::Score>& score) {
  return score ? page::Cell{fit::r2_text(score->r2()), badge_of(score)} : page::Cell{"–"};
}

page::Cell error_cell(const std::optional<fit::Score>& score) {
  return {score ? page::format_value(score->rmse_nm()) : "–"};
}

page::Figure torque_figure(const SecondOpinion& opinion) {
  page::Figure figure{.id = "review_torques",
                      .title = "Measured and predicted torque",
                      .caption =
                          "Blue: measured. Grey: by the calibrated subject. Green: by Myoid's fit without this trial. "
                          "Of longer trials the first 30 s.",
                      .most_on_page = 6};
  for (const ReviewedTorque& t : opinion.torques) {
    page::Panel panel = page::time_panel(t.trial + ", " + joint_name(t.joint), "torque", "N m");
    if (t.time_s.size() > 0 && t.time_s(t.time_s.size() - 1) - t.time_s(0) > kShown_s) panel.x.upper = kShown_s;
    const double begin = t.time_s.size() > 0 ? t.time_s(0) : 0.0;
    const auto from_begin = [&](const Eigen::VectorXd& time) { return page::to_vector(time.array() - begin); };
    panel.series.push_back({.name = "measured", .x = from_begin(t.time_s), .y = page::to_vector(t.measured_nm)});
    if (t.theirs)
      panel.series.push_back({.name = "calibrated subject",
                              .x = from_begin(t.time_s),
                              .y = page::to_vector(t.theirs_nm),
                              .role = page::Role::literature});
    if (t.ours)
      panel.series.push_back({.name = "Myoid, trial left out",
                              .x = from_begin(t.ours_time_s),
                              .y = page::to_vector(t.ours_nm),
                              .role = page::Role::unseen});
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

std::string standing_text(const ReviewedNumber& n) {
  switch (n.standing) {
    case Standing::agrees:
      return "agrees";
    case Standing::differs:
      return "differs";
    case Standing::untold:
      return "not told by the recording";
  }
  return "";
}

Table number_table(const SecondOpinion& opinion) {
  Table table{.id = "numbers",
              .title = "Their numbers beside the recording",
              .caption =
                  "The interval is of the person, 95 %. Of muscles that act as one, forces add and lengths are "
                  "means by force.",
              .columns = {"muscle", "number", "unit", "start", "calibrated", "on a bound", "Myoid", "95 % interval",
                          "verdict", "their number"}};
  for (const ReviewedNumber& n : opinion.numbers) {
    const page::PlainUnit unit = page::plain_unit(n.ours.unit);
    const auto shown = [&](double x) { return page::format_value(x * unit.per_si); };
    table.rows.push_back({{page::plain_muscle_and_name(n.muscle)},
                          {page::spelled(n.ours.parameter)},
                          {unit.symbol.empty() ? "–" : std::string(unit.symbol)},
                          {n.start ? shown(*n.start) : "–"},
                          {shown(n.theirs)},
                          {n.on_bound == 0 ? "–"
                           : n.lumped == 1 ? "yes"
                                           : fmt::format("{} of {}", n.on_bound, n.lumped),
                           n.on_bound > 0 ? Badge::weak : Badge::none},
                          {shown(n.ours.estimate)},
                          {n.ours.ci_low && n.ours.ci_high
                               ? page::format_interval(*n.ours.ci_low * unit.per_si, *n.ours.ci_high * unit.per_si)
                               : "–"},
                          {page::spelled(fit::name(n.ours.verdict))},
                          {standing_text(n), n.standing == Standing::agrees    ? Badge::good
                                             : n.standing == Standing::differs ? Badge::bad
                                                                               : Badge::weak}});
  }
  return table;
}

Table strength_table(const SecondOpinion& opinion) {
  Table table{.id = "strength_without_emg",
              .title = "Strength without EMG",
              .caption = "Maximal force times mean moment arm, summed. Such muscles are passive in the calibration.",
              .columns = {"joint", "strength [N m]", "without EMG [N m]", "share", "muscles, strongest first"}};
  for (const JointStrength& s : opinion.strengths) {
    const double share = s.without_emg_nm / s.all_nm;
    table.rows.push_back({{direction(s)},
                          {page::format_value(s.all_nm)},
                          {page::format_value(s.without_emg_nm)},
                          {fmt::format("{:.0f} %", 100.0 * share), share < kMuch ? Badge::good : Badge::bad},
                          {s.without_emg.empty() ? "–" : first_names(s.without_emg)}});
  }
  return table;
}

Table bound_table(const SecondOpinion& opinion) {
  Table table{.id = "bounds",
              .title = "Calibrated numbers on a bound",
              .caption = "Within 1 % of their range.",
              .columns = {"number", "calibrated", "on a bound"}};
  for (std::size_t k = 0; k < std::size(opensim::kMuscleQuantityNames); ++k) {
    const opensim::UnknownCount count = unknowns(opinion.project, static_cast<opensim::MuscleQuantity>(k));
    if (count.all > 0)
      table.rows.push_back({{page::spelled(opensim::kMuscleQuantityNames[k])},
                            {std::to_string(count.all)},
                            {std::to_string(count.on_bound), count.on_bound > 0 ? Badge::bad : Badge::good}});
  }
  return table;
}

std::string next_text(const SecondOpinion& opinion) {
  std::string text = next_sentence(opinion.study, {});
  if (text.empty())
    text = "Record a maximal contraction of each muscle, and slow and fast movements through the whole range.";
  std::vector<std::string> without;
  for (const JointStrength& s : opinion.strengths)
    if (s.without_emg_nm >= kMuch * s.all_nm) without.push_back(s.without_emg.front());
  if (!without.empty()) text += fmt::format(" An electrode on {} would tell most.", fmt::join(without, ", "));
  return text;
}

}  // namespace

page::Table torque_table(const SecondOpinion& opinion) {
  Table table{.id = "torques",
              .title = "Torque by joint and trial",
              .caption =
                  "Theirs: by the calibrated subject and its own law, all muscles of the joint. Myoid's: by a fit "
                  "without this trial.",
              .columns = {"trial", "joint", "their use", "their R2", "their error [N m]", "Myoid's R2, left out",
                          "Myoid's error [N m]"}};
  for (const ReviewedTorque& t : opinion.torques)
    table.rows.push_back({{t.trial},
                          {joint_name(t.joint)},
                          {t.is_calibrating ? "calibration" : "other"},
                          r2_cell(t.theirs),
                          error_cell(t.theirs),
                          r2_cell(t.ours),
                          error_cell(t.ours)});
  return table;
}

std::vector<std::string> review_sentences(const SecondOpinion& opinion) {
  std::vector<std::string> sentences;
  for (std::string text :
       {torque_sentence(opinion), strength_sentence(opinion), bounds_sentence(opinion), numbers_sentence(opinion)})
    if (!text.empty()) sentences.push_back(std::move(text));
  return sentences;
}

page::Report review_report(const SecondOpinion& opinion) {
  const opensim::Project& project = opinion.project;
  page::Report report{
      .title = "A second opinion on a calibration",
      .subtitle = fmt::format("{}{}{}: {}", choice_name(project.dialect), project.version.empty() ? "" : " ",
                              project.version, project.subject.string()),
      .headline = torque_sentence(opinion)};
  report.answers = {{"What has no EMG?", strength_sentence(opinion), "strength"},
                    {"Which numbers lie on bounds?", bounds_sentence(opinion), "bounds"},
                    {"Which of their numbers does the recording tell?", numbers_sentence(opinion), "numbers"},
                    {"What should be recorded next?", next_text(opinion), ""}};
  std::erase_if(report.answers, [](const page::Answer& answer) { return answer.text.empty(); });
  if (const fit::IdentificationResult* method = torque_of(opinion.study.fit))
    report.forest = forest_rows(opinion.study, *method);
  page::Section torques{.id = "torques", .heading = "Does the calibration predict?", .before_numbers = true};
  torques.tables.push_back(torque_table(opinion));
  if (!opinion.torques.empty()) torques.figures.push_back(torque_figure(opinion));
  report.sections.push_back(std::move(torques));
  report.sections.push_back(
      {.id = "numbers", .heading = "Their numbers beside the recording", .tables = {number_table(opinion)}});
  if (!opinion.strengths.empty())
    report.sections.push_back(
        {.id = "strength", .heading = "Strength without EMG", .tables = {strength_table(opinion)}});
  if (opinion.unknowns > 0)
    report.sections.push_back({.id = "bounds", .heading = "Numbers on bounds", .tables = {bound_table(opinion)}});
  report.assumptions = {
      "Myoid's numbers come from all trials of the project, with study.toml beside this page; `myoid run study.toml` "
      "gives their full report.",
      "Envelopes have an unknown gain: the project does not say by which contraction they were normalized.",
      "Muscles that share their electrodes and act on the same joints are one muscle, where the model is there."};
  for (const Remark& remark : project.remarks) report.assumptions.push_back(remark.says);
  for (const run::TrialResult& trial : opinion.study.trials)
    for (const Remark& remark : trial.input.remarks)
      if (remark.code == RemarkCode::emg_offset)
        report.assumptions.push_back(fmt::format("{}: {}", trial.spec.name, remark.says));
  return report;
}

}  // namespace myoid::results
