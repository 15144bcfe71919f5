#include "myoid/program/steps/sweep.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/model/path_survey.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/name_ids.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/page/svg_plot.h"
#include "myoid/page/tables.h"
#include "myoid/program/steps/stage_input.h"

namespace myoid::program {
namespace {

using body::SweptMuscle;

/// The coordinate and, where the text has it, the range.
struct Asked {
  int coordinate = -1;
  body::CoordinateRange range;
};

std::vector<std::string> movable_coordinates(const body::BodyModel& model) {
  std::vector<std::string> names;
  for (std::size_t c = 0; c < model.coordinates.size(); ++c)
    if (body::moves(model, static_cast<int>(c))) names.push_back(model.coordinates[c].name);
  return names;
}

Asked parse(const body::BodyModel& model, const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const std::optional<int> found = model.find_coordinate(name);
  if (!found || !body::moves(model, *found))
    throw InvalidInput("--sweep {}: {}; the model's movable coordinates are {}", text,
                       found ? name + " is locked, prescribed or coupled" : "no coordinate " + name,
                       fmt::join(movable_coordinates(model), ", "));
  const body::Coordinate& coordinate = model.coordinates[at(*found)];
  Asked asked{.coordinate = *found, .range = body::usual_range(coordinate)};
  if (equals != std::string::npos) {
    const std::size_t colon = text.find(':', equals);
    const auto number = [&](std::size_t from, std::size_t to) {
      return colon == std::string::npos ? std::nullopt : parse_number(text.substr(from, to - from));
    };
    const std::optional<double> lower = number(equals + 1, colon), upper = number(colon + 1, text.size());
    if (!lower || !upper)
      throw InvalidInput("--sweep {}: expected {}=FROM:TO, two numbers in degrees, or meters for a translation", text,
                         name);
    const double unit = coordinate.motion == body::MotionType::rotational ? kDegree : 1.0;
    asked.range = {*lower * unit, *upper * unit};
  }
  if (!(asked.range.lower < asked.range.upper))
    throw InvalidInput("--sweep {}: the range of {} is empty; give {}=FROM:TO with FROM below TO", text, name, name);
  return asked;
}

std::vector<int> chosen_muscles(const body::BodyModel& model, const std::vector<std::string>& names) {
  std::vector<int> chosen;
  for (std::size_t m = 0; m < model.muscles.size(); ++m)
    if (names.empty() || std::ranges::find(names, model.muscles[m].name) != names.end())
      chosen.push_back(static_cast<int>(m));
  for (const std::string& name : names) {
    if (std::ranges::find(model.muscles, name, &body::Muscle::name) != model.muscles.end()) continue;
    throw InvalidInput("--muscle {}: the model has no such muscle{}", name,
                       not_among(name, model.muscles, &body::Muscle::name));
  }
  return chosen;
}

std::vector<double> scaled(const Eigen::VectorXd& values, double factor) {
  std::vector<double> result(at(values.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i) result[at(i)] = values[i] * factor;
  return result;
}

/// Three panels a muscle: moment arm, length, forces.
page::Figure figure_of(const SweepResult& result) {
  page::Figure figure{.id = "sweep_" + result.coordinate,
                      .title = fmt::format("{}: muscles over {}", result.model, result.coordinate),
                      .caption = "Other coordinates have their default values.",
                      .columns = 3};
  const page::Axis x{.label = result.coordinate, .unit = result.is_angle ? "deg" : "m"};
  for (const SweptMuscle& muscle : result.muscles) {
    const std::vector<double> at_x = scaled(muscle.path.values, result.is_angle ? 1.0 / kDegree : 1.0);
    const auto panel = [&](const std::string& label, const std::string& unit, std::vector<page::Series> series) {
      figure.panels.push_back(
          {.title = muscle.name, .x = x, .y = {.label = label, .unit = unit}, .series = std::move(series)});
    };
    panel("moment arm", "cm", {{.name = "", .x = at_x, .y = scaled(muscle.path.arms_m, 100.0)}});
    panel("length", "cm", {{.name = "", .x = at_x, .y = scaled(muscle.path.lengths_m, 100.0)}});
    panel("force", "N",
          {{.name = "fully active", .x = at_x, .y = scaled(muscle.full_force_n, 1.0)},
           {.name = "without activation",
            .x = at_x,
            .y = scaled(muscle.passive_force_n, 1.0),
            .role = page::Role::literature}});
  }
  return figure;
}

page::Table table_of(const SweepResult& result) {
  page::Table table;
  table.columns = {"muscle",       result.coordinate + (result.is_angle ? "_deg" : "_m"),
                   "moment_arm_m", "length_m",
                   "full_force_n", "passive_force_n"};
  for (const SweptMuscle& muscle : result.muscles) {
    for (Eigen::Index i = 0; i < muscle.path.values.size(); ++i) {
      std::vector<std::string> row{muscle.name};
      for (const double value : {muscle.path.values[i] / (result.is_angle ? kDegree : 1.0), muscle.path.arms_m[i],
                                 muscle.path.lengths_m[i], muscle.full_force_n[i], muscle.passive_force_n[i]})
        row.push_back(fmt::format("{:.9g}", value));
      table.rows.push_back(page::text_row(std::move(row)));
    }
  }
  return table;
}

}  // namespace

void visit(SweepOptions& o, study::SettingVisitor& v) {
  visit_model(o.model, v);
  v.text("sweep", o.coordinate,
         {.says = "Instead of a motion this coordinate over its range, or COORDINATE=FROM:TO [deg, m]: a table and a "
                  "picture of moment arms, lengths and forces.",
          .option = {.keyword = "coordinate", .excludes = "motion,lowpass,surrogate,check-jumps"}});
  v.texts("muscle", o.muscles, {.says = "With --sweep only this muscle, repeated.", .option = {.needs = "sweep"}});
  v.folder("out", o.out, {.says = "Folder for sweep_*.csv and .svg.", .required = "a folder"});
  visit_compat(o.compat, v);
}

SweepResult sweep(const SweepOptions& o) {
  if (o.call.start_s || o.call.end_s) throw InvalidInput("--sweep has no times: leave out --start and --end");
  Remarks remarks(o.call);
  const body::BodyModel model = load_model(o.model, o.compat, remarks);
  const Asked asked = parse(model, o.coordinate);
  const body::Coordinate& coordinate = model.coordinates[at(asked.coordinate)];
  SweepResult result{.model = model.name,
                     .coordinate = coordinate.name,
                     .is_angle = coordinate.motion == body::MotionType::rotational};
  result.muscles = body::sweep_muscles(model, chosen_muscles(model, o.muscles), asked.coordinate, asked.range,
                                       kSweepSteps, o.call.progress);
  if (o.muscles.empty())
    std::erase_if(result.muscles, [](const SweptMuscle& muscle) { return !muscle.has_moment_arm(); });
  if (result.muscles.empty())
    throw InvalidInput("--sweep {}: no muscle of the model has a moment arm of 0.1 mm there", o.coordinate);
  std::vector<std::string> unbalanced, foreign;
  for (const SweptMuscle& muscle : result.muscles) {
    if (!muscle.full_force_n.allFinite() || !muscle.passive_force_n.allFinite()) unbalanced.push_back(muscle.name);
    if (!muscle.has_own_curves) foreign.push_back(muscle.name);
  }
  if (!unbalanced.empty())
    remarks.warn(fmt::format("no balance of fiber and tendon somewhere for {}: their forces have gaps there",
                             fmt::join(unbalanced, ", ")));
  if (!foreign.empty())
    remarks.warn(
        fmt::format("this program has no curves of the classes of {}: they have Thelen's", fmt::join(foreign, ", ")));
  result.remarks = remarks.list();
  return result;
}

std::vector<std::filesystem::path> write_sweep(const SweepResult& result, const std::filesystem::path& folder) {
  const std::string name = "sweep_" + NameIds({result.coordinate}).of(result.coordinate);
  std::vector<std::filesystem::path> files{folder / (name + ".csv"), folder / (name + ".svg")};
  write_file(files[0], page::table_csv(table_of(result)));
  write_file(files[1], page::svg_plot(figure_of(result)));
  return files;
}

}  // namespace myoid::program
