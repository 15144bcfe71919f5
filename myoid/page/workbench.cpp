#include "myoid/page/workbench.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"
#include "myoid/page/json_values.h"
#include "myoid/page/tables.h"

namespace myoid::page {
namespace {

using nlohmann::ordered_json;

ordered_json samples_json(const std::vector<double>& values) {
  return packed_json(Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
}

ordered_json line_json(const TimeLine& line) {
  ordered_json j{
      {"name", line.name}, {"role", name(line.role)}, {"clock", line.clock}, {"value", packed_json(line.value)}};
  if (line.upper.size() > 0) j["upper"] = packed_json(line.upper);
  return j;
}

ordered_json plot_json(const TimePlot& plot) {
  return {{"kind", plot.kind},
          {"title", plot.title},
          {"unit", plot.unit},
          {"joint", plot.joint},
          {"muscle", plot.muscle},
          {"file", plot.file},
          {"lines", array_of(plot.lines, line_json)}};
}

ordered_json row_json(const CarpetRow& row) {
  return {{"name", row.name}, {"kind", row.kind}, {"unit", row.unit}, {"value", packed_json(row.value)}};
}

ordered_json mark_json(const TrialMark& mark) {
  return {{"about", mark.about},
          {"begin", mark.when ? ordered_json(mark.when->begin_s) : ordered_json(nullptr)},
          {"end", mark.when ? ordered_json(mark.when->end_s) : ordered_json(nullptr)},
          {"badge", name(mark.badge)},
          {"text", mark.text}};
}

ordered_json drive_json(const MuscleDrive& drive) {
  return {{"activation", packed_json(drive.activation)},
          {"length", packed_json(drive.length_m)},
          {"velocity", packed_json(drive.velocity_mps)},
          {"arms", array_of(drive.moment_arm_m, packed_json)}};
}

ordered_json trial_json(const WorkbenchTrial& trial) {
  ordered_json j{{"name", trial.name},
                 {"use", trial.use},
                 {"scene", trial.scene},
                 {"badge", name(trial.badge)},
                 {"remarks", sentences(trial.remarks)},
                 {"clocks", array_of(trial.clocks, clock_json)},
                 {"plots", array_of(trial.plots, plot_json)},
                 {"carpet",
                  {{"begin", trial.carpet_when.begin_s},
                   {"end", trial.carpet_when.end_s},
                   {"rows", array_of(trial.carpet, row_json)}}},
                 {"marks", array_of(trial.marks, mark_json)},
                 {"drives", array_of(trial.drives, drive_json)}};
  if (!trial.video.empty()) j["video"] = {{"file", trial.video}, {"offset", trial.video_offset_s}};
  return j;
}

ordered_json number_json(const MovableNumber& n) {
  return {{"field", n.field},    {"name", n.name},   {"unit", n.unit},
          {"lower", n.lower},    {"upper", n.upper}, {"sd_log", number_or_null(n.sd_log)},
          {"verdict", n.verdict}};
}

ordered_json muscle_json(const MovableMuscle& muscle) {
  ordered_json j{{"name", muscle.name},
                 {"literature", muscle.literature},
                 {"identified", muscle.identified},
                 {"numbers", array_of(muscle.numbers, number_json)},
                 {"correlation", matrix_json(muscle.correlation)}};
  if (muscle.draws.size() == 0) return j;
  const auto of_number = [](const auto& row) { return packed_json(Eigen::VectorXd(row)); };
  j["draws"] = {{"weight", packed_json(muscle.draw_weights)}, {"values", array_of(muscle.draws.rowwise(), of_number)}};
  return j;
}

ordered_json axis_json(const Axis& axis) {
  return {{"label", axis.label},
          {"unit", axis.unit},
          {"lower", number_or_null(axis.lower)},
          {"upper", number_or_null(axis.upper)}};
}

ordered_json curve_json(const Series& s) {
  ordered_json j{{"name", s.name}, {"role", name(s.role)}, {"x", samples_json(s.x)}, {"value", samples_json(s.y)}};
  if (!s.y_upper.empty()) j["upper"] = samples_json(s.y_upper);
  if (!s.y_lower.empty()) j["lower"] = samples_json(s.y_lower);
  return j;
}

ordered_json panel_json(const Panel& panel) {
  return {{"title", panel.title},
          {"x", axis_json(panel.x)},
          {"y", axis_json(panel.y)},
          {"series", array_of(panel.series, curve_json)}};
}

ordered_json figure_json(const Figure& figure) {
  return {{"id", figure.id},
          {"title", figure.title},
          {"columns", figure.columns},
          {"panels", array_of(figure.panels, panel_json)}};
}

/// Returns true if the page can draw the figure itself: curves over numbers.
bool is_live(const Figure& figure) {
  return !figure.in_workbench && std::ranges::all_of(figure.panels, [](const Panel& panel) {
    return panel.x.categories.empty() && panel.y.categories.empty() &&
           std::ranges::none_of(panel.series, [](const Series& s) { return s.role == Role::points; });
  });
}

void require(bool condition, const WorkbenchTrial& trial, const std::string& what) {
  if (!condition) throw InvalidInput(fmt::format("workbench, trial '{}': {}", trial.name, what));
}

void validate(const WorkbenchTrial& trial, const Workbench& workbench) {
  require(trial.scene < static_cast<int>(workbench.scenes.scenes.size()), trial,
          fmt::format("there is no scene number {}", trial.scene));
  for (const Eigen::VectorXd& clock : trial.clocks) {
    bool rises = clock.size() > 0 && clock.allFinite();
    for (Eigen::Index i = 1; i < clock.size(); ++i) rises = rises && clock[i] > clock[i - 1];
    require(rises, trial, "a clock has no times, or they do not rise");
  }
  for (const TimePlot& plot : trial.plots) {
    require(plot.muscle < static_cast<int>(workbench.muscles.size()), trial,
            fmt::format("plot '{}': there is no muscle number {}", plot.title, plot.muscle));
    for (const TimeLine& line : plot.lines) {
      const bool known = line.clock >= 0 && line.clock < static_cast<int>(trial.clocks.size());
      const Eigen::Index n = known ? trial.clocks[static_cast<std::size_t>(line.clock)].size() : -1;
      require(line.value.size() == n && (line.upper.size() == 0 || line.upper.size() == n), trial,
              fmt::format("plot '{}', line '{}': {} values; expected one for each of {} times", plot.title, line.name,
                          line.value.size(), n));
    }
  }
  require(trial.drives.empty() || trial.drives.size() == workbench.muscles.size(), trial,
          "expected the inputs of every muscle, or of none");
  for (const MuscleDrive& drive : trial.drives) {
    const Eigen::Index n = trial.clocks.empty() ? -1 : trial.clocks.front().size();
    const bool equal = drive.activation.size() == n && drive.length_m.size() == n && drive.velocity_mps.size() == n &&
                       std::ranges::all_of(drive.moment_arm_m, [&](const auto& arm) { return arm.size() == n; });
    require(equal, trial, fmt::format("expected {} samples of a muscle's inputs", n));
  }
}

}  // namespace

void validate(const Workbench& workbench) {
  for (const WorkbenchTrial& trial : workbench.trials) validate(trial, workbench);
}

std::string workbench_json(const Workbench& workbench, const Report& report) {
  validate(workbench);
  ordered_json j{{"title", report.title},
                 {"fields", workbench.fields},
                 {"trials", array_of(workbench.trials, trial_json)},
                 {"muscles", array_of(workbench.muscles, muscle_json)},
                 {"figures", ordered_json::array()}};
  for (const Section& section : report.sections) {
    for (const Figure& figure : section.figures)
      if (is_live(figure)) j["figures"].push_back(figure_json(figure));
  }
  return embedded(j);
}

}  // namespace myoid::page
