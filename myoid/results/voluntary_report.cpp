#include "myoid/results/voluntary_report.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/units.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/page/forest.h"
#include "myoid/page/muscle_names.h"
#include "myoid/page/typeset.h"
#include "myoid/results/parameter_tables.h"
#include "myoid/run/design/verdict_badge.h"

namespace myoid::results {
namespace {

using fit::IdentificationResult;
using fit::ParameterEstimate;
using fit::VoluntaryCurve;
using page::Cell;

/// Returns the curve's row with this parameter; null: none.
const ParameterEstimate* row_of(const IdentificationResult& method,
                                const VoluntaryCurve& curve,
                                const std::string& parameter) {
  const auto row = std::ranges::find_if(method.estimates, [&](const ParameterEstimate& e) {
    return e.muscle == curve.owner && e.parameter == parameter + curve.ending;
  });
  return row == method.estimates.end() ? nullptr : &*row;
}

const ParameterEstimate* torque_of(const IdentificationResult& method, const VoluntaryCurve& curve) {
  return row_of(method, curve, std::string(fit::kVoluntaryTorque));
}

const ParameterEstimate* angle_of(const IdentificationResult& method, const VoluntaryCurve& curve) {
  return row_of(method, curve, std::string(fit::kVoluntaryAngle));
}

/// Returns the owner for people, muscles as `spelled_muscle` writes them: "Biceps", "Biceps at the knee angle", "Biceps
/// + Brachialis together (elbow flexion)".
std::string name_of(const VoluntaryCurve& curve, std::string (*spelled_muscle)(std::string_view)) {
  if (!curve.of_joint) {
    const std::string muscle = spelled_muscle(curve.owner);
    return curve.ending.empty() ? muscle : fmt::format("{} at {}", muscle, page::spelled(curve.joint));
  }
  std::vector<std::string> muscles;
  for (const std::string& name : curve.muscles) muscles.push_back(spelled_muscle(name));
  return fmt::format("{} together ({}{})", fmt::join(muscles, " + "), page::spelled(curve.joint),
                     curve.direction > 0 ? "" : ", negative direction");
}

std::string plain_name(const VoluntaryCurve& curve) { return name_of(curve, page::plain_muscle); }

bool is_at_end(const VoluntaryCurve& curve) {
  Eigen::Index top = 0;
  curve.torque_nm.maxCoeff(&top);
  return top == 0 || top + 1 == curve.torque_nm.size();
}

std::string degrees(double angle_rad) { return fmt::format("{:.0f}°", angle_rad / kDegree); }

std::string angle_text(const VoluntaryCurve& curve, const ParameterEstimate& angle) {
  return degrees(angle.estimate) + (is_at_end(curve) ? " or beyond" : "");
}

std::string spelled_verdict(const ParameterEstimate& e) { return page::spelled(fit::name(e.verdict)); }

std::string size_text(const ParameterEstimate& e) { return page::format_beside(e.estimate, e.ci_low, e.ci_high); }

/// Returns "41 at 60°/s, 73 at 120°/s" of the powers of a curve.
std::string powers_text(const IdentificationResult& method, const VoluntaryCurve& curve) {
  std::vector<std::string> powers;
  for (const ParameterEstimate& e : method.estimates) {
    if (e.muscle != curve.owner || !fit::is_voluntary_power(e.parameter)) continue;
    const std::string speed = e.parameter.substr(fit::kVoluntaryPower.size() + 1);
    const std::size_t digits = std::min(speed.find_first_not_of("0123456789"), speed.size());
    if (speed.substr(digits) != curve.ending) continue;
    powers.push_back(fmt::format("{} at {}°/s", size_text(e), speed.substr(0, digits)));
  }
  return powers.empty() ? "–" : fmt::format("{}", fmt::join(powers, ", "));
}

Cell truth_cell(const run::StudyResult& result, const ParameterEstimate& e, double unit) {
  const std::optional<double> truth = truth_of(result, e);
  if (!truth) return {"-"};
  const bool inside = *truth >= *e.ci_low && *truth <= *e.ci_high;
  return {page::format_beside(*truth / unit, *e.ci_low / unit, *e.ci_high / unit),
          inside ? page::Badge::good : page::Badge::weak};
}

Cell verdict_cell(const ParameterEstimate* e) {
  if (e == nullptr) return {"–"};
  return {spelled_verdict(*e), run::verdict_badge(e->verdict), e->reason};
}

std::string interval_text(const std::optional<double>& low, const std::optional<double>& high, double unit) {
  return low && high ? page::format_interval(*low / unit, *high / unit) : "–";
}

page::Table table_of(const run::StudyResult& result, const IdentificationResult& method) {
  page::Table table{
      .id = "voluntary_torque",
      .title = "Greatest voluntary torque, steady, and power",
      .caption =
          "95 % interval: of the person. Given geometry and sensors: the 95 % interval if moment arms, tendons, "
          "electrodes and measured torques were exact. Their errors are the same in two sessions of one person, "
          "so sessions are compared by it. Power: the greatest over the recorded angles while the joint turns "
          "at this speed.",
      .columns = {"muscle or joint", "N m", "95 % interval", "verdict", "at angle (°)", "95 % interval",
                  "verdict of the angle", "power (W)", "given geometry and sensors"}};
  const bool known = !result.source.truth.empty();
  if (known) table.columns.insert(table.columns.end(), {"true N m", "true angle (°)"});
  for (const VoluntaryLine& line : voluntary_lines(method)) {
    const VoluntaryCurve& curve = *line.curve;
    const ParameterEstimate *torque = line.torque, *angle = line.angle;
    std::vector<Cell> row{{name_of(curve, page::plain_muscle_and_name)},
                          {size_text(*torque)},
                          {interval_text(torque->ci_low, torque->ci_high, 1.0)},
                          verdict_cell(torque),
                          {angle == nullptr ? "–" : angle_text(curve, *angle)},
                          {angle == nullptr ? "–" : interval_text(angle->ci_low, angle->ci_high, kDegree)},
                          verdict_cell(angle),
                          {powers_text(method, curve)},
                          {interval_text(torque->given_ci_low, torque->given_ci_high, 1.0)}};
    if (known) {
      row.push_back(truth_cell(result, *torque, 1.0));
      row.push_back(angle == nullptr ? Cell{"-"} : truth_cell(result, *angle, kDegree));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

page::Panel panel_of(const VoluntaryCurve& curve) {
  const bool over_angle = curve.angle_rad.size() > 0;
  const std::vector<double> x =
      page::to_vector(over_angle ? Eigen::VectorXd(curve.angle_rad / kDegree) : Eigen::VectorXd(1e3 * curve.length_m));
  page::Panel panel{.title = short_name(curve)};
  panel.x = over_angle ? page::Axis{.label = page::spelled(curve.joint), .unit = "deg"}
                       : page::Axis{.label = "length of muscle and tendon", .unit = "mm"};
  panel.y = {.label = "torque", .unit = "N m", .lower = 0.0};
  page::Series person{"95 %, of the person", x, page::to_vector(curve.low_nm), page::Role::band};
  person.y_upper = page::to_vector(curve.high_nm);
  page::Series given{"95 %, given geometry and sensors", x, page::to_vector(curve.given_low_nm), page::Role::norm};
  given.y_upper = page::to_vector(curve.given_high_nm);
  panel.series = {std::move(person),
                  std::move(given),
                  {"greatest voluntary torque", x, page::to_vector(curve.torque_nm), page::Role::identified}};
  return panel;
}

page::Figure figure_of(const IdentificationResult& method) {
  page::Figure figure{.id = "voluntary_torque",
                      .title = "Greatest voluntary torque over the joint's angle",
                      .caption =
                          "Steady efforts at the activation of the maximal contraction, over the recorded "
                          "angles. A dynamometer would measure these torques if one muscle pulled alone.",
                      .panels = {},
                      .columns = 2};
  for (const VoluntaryLine& line : voluntary_lines(method)) figure.panels.push_back(panel_of(*line.curve));
  if (figure.panels.size() > 4) figure.columns = 3;
  figure.bad = "The band is as high as the curve, or the curve still rises at the end of the recorded angles.";
  figure.act =
      "Record efforts against greater loads to narrow the band, and a wider range of angles to find where the curve is "
      "highest.";
  return figure;
}

}  // namespace

std::vector<VoluntaryLine> voluntary_lines(const IdentificationResult& method) {
  std::vector<VoluntaryLine> lines;
  for (const VoluntaryCurve& curve : method.voluntary) {
    const bool of_one_muscle = curve.of_joint && curve.muscles.size() == 1;
    const ParameterEstimate* torque = torque_of(method, curve);
    if (torque == nullptr || of_one_muscle) continue;
    const ParameterEstimate* angle = angle_of(method, curve);
    lines.push_back({&curve, torque, angle, plain_name(curve), angle == nullptr ? "" : angle_text(curve, *angle)});
  }
  return lines;
}

std::string short_name(const VoluntaryCurve& curve) {
  if (!curve.of_joint) return plain_name(curve);
  return fmt::format("{} together{}", page::spelled(curve.joint), curve.direction > 0 ? "" : " (negative direction)");
}

bool is_told(const ParameterEstimate& e) {
  return e.verdict == fit::Verdict::identified || e.verdict == fit::Verdict::reproducible ||
         e.verdict == fit::Verdict::weak;
}

std::string voluntary_headline(const IdentificationResult& method) {
  std::vector<VoluntaryLine> lines = voluntary_lines(method);
  std::erase_if(lines, [](const VoluntaryLine& line) { return !is_told(*line.torque); });
  if (lines.empty()) return "";
  const auto verdict = [](const VoluntaryLine& line) { return page::spelled(fit::name(line.torque->verdict)); };
  const bool alike = std::ranges::all_of(
      lines, [&](const VoluntaryLine& line) { return line.torque->verdict == lines.front().torque->verdict; });
  std::vector<std::string> parts;
  for (const VoluntaryLine& line : lines) {
    const bool placed = line.angle != nullptr && is_told(*line.angle);
    parts.push_back(fmt::format("{} {} N m ({}{}){}", line.name, size_text(*line.torque),
                                page::format_interval(*line.torque->ci_low, *line.torque->ci_high),
                                alike ? "" : ", " + verdict(line), placed ? " at " + line.place : ""));
  }
  const bool maximal = std::ranges::all_of(method.voluntary, &VoluntaryCurve::from_mvc);
  return fmt::format("Greatest voluntary torque{} (95 % interval{}): {}. ",
                     maximal ? "" : " at the largest recorded EMG", alike ? ", " + verdict(lines.front()) : "",
                     fmt::join(parts, "; "));
}

page::Section voluntary_section(const run::StudyResult& result, const IdentificationResult& method) {
  page::Section section{.id = "voluntary",
                        .heading = "How strong is each muscle, and at which angle",
                        .before_numbers = true,
                        .tables = {table_of(result, method)},
                        .figures = {figure_of(method)}};
  section.paragraphs.push_back(
      "The greatest torque that each muscle makes about the joint by itself. The size of its "
      "moment arm, the effort of the maximal contraction and the scale of the EMG cancel in it, "
      "so that it is known better than the muscle's force.");
  if (!std::ranges::all_of(method.voluntary, &VoluntaryCurve::from_mvc))
    section.paragraphs.push_back(
        "No maximal contraction was recorded: these are the torques at the largest recorded EMG.");
  std::vector<std::string> outside;
  for (const VoluntaryLine& line : voluntary_lines(method)) {
    const ParameterEstimate& e = *line.torque;
    if (is_told(e) && e.given_ci_low && e.given_ci_high &&
        (e.estimate < *e.given_ci_low || e.estimate > *e.given_ci_high))
      outside.push_back(line.name);
  }
  if (!outside.empty()) section.paragraphs.push_back(page::outside_given_sentence(outside));
  if (std::ranges::any_of(method.voluntary, &VoluntaryCurve::averaged))
    section.paragraphs.push_back(
        "Other joints move these muscles, too: the torque at an angle is that of their mean length there.");
  return section;
}

std::string voluntary_csv(const IdentificationResult& method) {
  std::string text =
      "owner,joint,direction,muscles,angle_rad,length_m,torque_nm,low_nm,high_nm,given_low_nm,given_high_nm\n";
  for (const VoluntaryCurve& curve : method.voluntary) {
    const std::string head = fmt::format("{},{},{},{}", csv_cell(curve.owner), csv_cell(curve.joint),
                                         curve.direction > 0 ? "positive" : "negative",
                                         csv_cell(fmt::format("{}", fmt::join(curve.muscles, "+"))));
    const auto cell = [](const Eigen::VectorXd& values, Eigen::Index i) {
      return i < values.size() ? format_number(values[i]) : std::string();
    };
    for (Eigen::Index i = 0; i < curve.torque_nm.size(); ++i)
      text += fmt::format("{},{},{},{},{},{},{},{}\n", head, cell(curve.angle_rad, i), cell(curve.length_m, i),
                          cell(curve.torque_nm, i), cell(curve.low_nm, i), cell(curve.high_nm, i),
                          cell(curve.given_low_nm, i), cell(curve.given_high_nm, i));
  }
  return text;
}

}  // namespace myoid::results
