#include "myoid/opensim/analysis_reports.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/model/constraints.h"
#include "myoid/body/model/muscle_path.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/opensim/moving_bodies.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/tables/storage_reader.h"

namespace myoid::opensim {
namespace {

/// Indices of the objects that a list names; an empty list and "all" name every one. Unknown names are noted.
std::vector<int> chosen(
    const AnalysisRun& run, pugi::xml_node node, const char* property, std::size_t count, const auto& find) {
  std::vector<std::string> names = run.setup.xml().words(node, property);
  std::vector<int> indices;
  if (names.empty() || equal_ignoring_case(names.front(), "all")) {
    for (std::size_t i = 0; i < count; ++i) indices.push_back(static_cast<int>(i));
    return indices;
  }
  for (const std::string& name : names) {
    if (const std::optional<int> index = find(name)) {
      indices.push_back(*index);
    } else {
      run.note("<{}>: the model has no '{}'; it is left out", property, name);
    }
  }
  return indices;
}

/// Postures that obey the constraints.
Eigen::MatrixXd assembled(const body::BodyModel& model, const Eigen::MatrixXd& q) {
  if (model.couplers.empty() && model.constraints.empty()) return q;
  Eigen::MatrixXd result = q;
  for (Eigen::Index i = 0; i < q.rows(); ++i) result.row(i) = body::assemble(model, q.row(i).transpose()).q.transpose();
  return result;
}

/// One output of the model that a report asks for.
struct Output {
  enum class Kind { length, speed, marker, body } kind = Kind::length;
  int index = 0;  ///< index of the marker, of the body, or in paths_of
  std::string path;
};

std::optional<Output> output_named(const body::BodyModel& model, const std::string& path) {
  const auto bar = path.rfind('|');
  if (bar == std::string::npos) return {};
  const std::string what = path.substr(bar + 1);
  std::string component = path.substr(0, bar);
  for (const char* tail : {"/path", "/geometrypath"}) {
    if (component.ends_with(tail)) component.erase(component.size() - std::string_view(tail).size());
  }
  if (const auto slash = component.rfind('/'); slash != std::string::npos) component.erase(0, slash + 1);
  const auto make = [&](Output::Kind kind, std::optional<int> index) -> std::optional<Output> {
    if (!index) return {};
    return Output{kind, *index, path};
  };
  const auto path_index = [&]() -> std::optional<int> {
    const auto paths = paths_of(model);
    for (std::size_t i = 0; i < paths.size(); ++i)
      if (paths[i].first == component) return static_cast<int>(i);
    return {};
  };
  if (what == "length") return make(Output::Kind::length, path_index());
  if (what == "lengthening_speed") return make(Output::Kind::speed, path_index());
  if (what == "location") return make(Output::Kind::marker, model.find_marker(component));
  if (what == "position") return make(Output::Kind::body, model.find_body(component));
  return {};
}

/// Outputs of one type: numbers (of one component) or points (of three).
struct OutputTable {
  Eigen::Index components = 1;
  std::vector<Output> outputs{};
  Eigen::MatrixXd values{};  ///< Frames x (outputs x components).
};

std::string text_of(const OutputTable& table, const Eigen::VectorXd& times) {
  std::string text = fmt::format("inDegrees=no\nnumColumns={}\nDataType={}\nversion=3\nendheader\ntime",
                                 table.outputs.size(), table.components == 3 ? "Vec3" : "double");
  for (const Output& output : table.outputs) text += "\t" + output.path;
  text += '\n';
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    text += format_number(times[i]);
    for (Eigen::Index c = 0; c < table.values.cols(); ++c) {
      text += c % table.components == 0 ? '\t' : ',';
      text += format_number(table.values(i, c));
    }
    text += '\n';
  }
  return text;
}

/// Returns the outputs that an analysis asks for: numbers, then points. Others are noted.
std::array<OutputTable, 2> wanted_outputs(AnalysisRun& run, pugi::xml_node node) {
  std::array<OutputTable, 2> tables{OutputTable{.components = 1}, OutputTable{.components = 3}};
  std::string missing;
  for (const std::string& path : run.setup.xml().words(node, "output_paths")) {
    if (const auto output = output_named(run.model, path)) {
      const bool point = output->kind == Output::Kind::marker || output->kind == Output::Kind::body;
      tables[point ? 1 : 0].outputs.push_back(*output);
    } else {
      missing += (missing.empty() ? "" : ", ") + path;
    }
  }
  if (!missing.empty()) {
    run.note(
        "{}: outputs {} are left out; lengths and lengthening speeds of paths, locations of markers and "
        "positions of bodies are reported",
        analysis_name(node), missing);
  }
  return tables;
}

}  // namespace

std::string analysis_name(pugi::xml_node node) {
  const std::string name = body::OsimXml::name_of(node);
  return name.empty() ? node.name() : name;
}

void report_kinematics(AnalysisRun& run, pugi::xml_node node) {
  const auto& xml = run.setup.xml();
  const auto& model = run.model;
  const auto columns = chosen(run, node, "coordinates", model.coordinates.size(),
                              [&](const std::string& name) { return model.find_coordinate(name); });
  const bool in_degrees = xml.flag(node, "in_degrees", true);
  std::vector<Channel> channels;
  for (const int c : columns) {
    const auto& coordinate = model.coordinates[at(c)];
    channels.push_back(
        {coordinate.name, coordinate.motion == body::MotionType::rotational ? Unit::radian : Unit::dimensionless});
  }
  const auto write = [&](const char* suffix, const char* title, const Eigen::MatrixXd& values) {
    write_result(run, analysis_name(node) + suffix,
                 {run.motion.q.time_s(), channels, Eigen::MatrixXd(values(Eigen::all, columns))},
                 {.title = title, .in_degrees = in_degrees, .description = std::string("\n") + kUnitsNote});
  };
  write("_q.sto", "Coordinates", assembled(model, run.motion.q.values()));
  write("_u.sto", "Speeds", run.motion.qdot.values());
  if (const Eigen::MatrixXd* qddot = accelerations_of(run)) write("_dudt.sto", "Accelerations", *qddot);
}

void report_muscles(AnalysisRun& run, pugi::xml_node node) {
  const auto& xml = run.setup.xml();
  const auto& model = run.model;
  if (model.muscles.empty()) xml.fail(node, "MuscleAnalysis: the model has no muscles");
  body::MuscleAnalysisOptions options = muscle_options(run);
  options.muscles = chosen(run, node, "muscle_list", model.muscles.size(),
                           [&](const std::string& name) { return model.find_muscle(name); });
  if (options.muscles.empty()) xml.fail(node, "MuscleAnalysis: no muscle of the list is in the model");
  if (xml.flag(node, "compute_moments", true)) {
    options.coordinates = chosen(run, node, "moment_arm_coordinate_list", model.coordinates.size(),
                                 [&](const std::string& name) { return model.find_coordinate(name); });
  }
  if (!run.equilibrium && run.fiber_length_m.size() == 0) {
    run.note(
        "<solve_for_equilibrium_for_auxiliary_states> is false: fibers have their default lengths ({}), so that their "
        "velocities and forces mean little; lengths of muscles and moment arms do not depend on it",
        run.options.compat.class_fiber_length ? "0.1 m where the model gives none, as in OpenSim"
                                              : "optimal ones where the model gives none; OpenSim takes 0.1 m");
  }
  const body::MuscleAnalysis analysis = body::muscle_analysis(model, run.motion, options);
  run.add_notes(analysis.notes);
  const std::string description =
      std::string(
          "\nThis analysis gathers basic information about muscles during a simulation (e.g., "
          "forces, tendon lengths, moment arms, etc).\n") +
      kUnitsNote;
  for (const auto& [name, table] : analysis.tables) {
    write_result(run, analysis_name(node) + "_" + name + ".sto", table, {.title = name, .description = description});
  }
}

void report_outputs(AnalysisRun& run, pugi::xml_node node) {
  const auto& model = run.model;
  auto tables = wanted_outputs(run, node);
  auto& [numbers, points] = tables;
  const Eigen::Index frames = run.motion.sample_count();
  for (OutputTable& table : tables) table.values.resize(frames, table.components * std::ssize(table.outputs));
  MovingBodies moving(model, run.moved);
  body::PathWorkspace workspace;
  body::PathResult path;
  const auto paths = paths_of(model);
  for (Eigen::Index i = 0; i < frames; ++i) {
    moving.set(i);
    int computed = -1;  // the index of `path`: length and speed of one path often follow each other
    for (std::size_t k = 0; k < numbers.outputs.size(); ++k) {
      const Output& output = numbers.outputs[k];
      if (output.index != computed)
        body::compute_path(model, *paths[at(output.index)].second, moving.state(), workspace, path);
      computed = output.index;
      numbers.values(i, static_cast<Eigen::Index>(k)) =
          output.kind == Output::Kind::length ? path.length_m : path.speed_mps;
    }
    for (std::size_t k = 0; k < points.outputs.size(); ++k) {
      const Output& output = points.outputs[k];
      const auto column = static_cast<Eigen::Index>(3 * k);
      if (output.kind == Output::Kind::body) {
        points.values.row(i).segment<3>(column) = moving.pose(at(output.index)).p.transpose();
      } else {
        const body::Marker& marker = model.markers[at(output.index)];
        points.values.row(i).segment<3>(column) = (moving.pose(at(marker.body)) * marker.p_BM).transpose();
      }
    }
  }
  for (const OutputTable& table : tables) {
    if (table.outputs.empty()) continue;
    write_file(claim_result(run, table.components == 1 ? "Outputs.sto" : "OutputsVec3.sto"),
               text_of(table, run.motion.q.time_s()), Flush::later);
  }
}

std::filesystem::path claim_result(AnalysisRun& run, const std::string& name) {
  const auto path = run.setup.results_folder() / (run.setup.name() + "_" + name);
  run.claim(path);
  return path;
}

void write_result(AnalysisRun& run, const std::string& name, const TimeSeries& table, OpensimFormat format) {
  format.decimals = run.decimals;
  write_opensim_storage(claim_result(run, name), table, format);
}

std::optional<TimeSeries> read_speeds(const body::BodyModel& model,
                                      const std::filesystem::path& path,
                                      bool only_speeds,
                                      std::vector<Remark>& remarks) {
  const recording::Storage file = recording::read_storage(path);
  for (const Repair& repair : file.repairs) {
    if (only_speeds)
      remarks.push_back(
          {.code = RemarkCode::reading, .says = recording::to_string(path, repair)});  // else with the states
  }
  const auto count = static_cast<Eigen::Index>(model.coordinates.size());
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(file.data.sample_count(), count);
  std::vector<Channel> channels;
  for (const body::Coordinate& c : model.coordinates) channels.push_back({c.name, body::coordinate_unit(c, 1)});
  bool any = false;
  for (std::size_t column = 0; column < file.data.channels().size(); ++column) {
    std::string name = file.data.channels()[column].name;
    if (name.ends_with("/speed")) {
      name.erase(name.size() - 6);
    } else if (name.ends_with("_u") && !model.find_coordinate(name)) {
      name.erase(name.size() - 2);
    } else if (!only_speeds) {
      continue;
    }
    const auto c = model.find_coordinate(name);
    if (!c) continue;
    const bool angle = model.coordinates[at(*c)].motion == body::MotionType::rotational;
    values.col(*c) =
        file.data.values().col(static_cast<Eigen::Index>(column)) * (angle && file.in_degrees ? kDegree : 1.0);
    any = true;
  }
  if (!any) return {};
  TimeSeries result(file.data.time_s(), std::move(channels), std::move(values));
  require_finite(result, path.string());
  return result;
}

void read_muscle_states(AnalysisRun& run, const std::filesystem::path& path) {
  const TimeSeries data = recording::read_storage(path).data;
  const auto count = static_cast<Eigen::Index>(run.model.muscles.size());
  bool any_activation = false, any_length = false;
  Eigen::MatrixXd activation(data.sample_count(), count), length(data.sample_count(), count);
  for (Eigen::Index m = 0; m < count; ++m) {
    const body::Muscle& muscle = run.model.muscles[at(m)];
    activation.col(m).setConstant(muscle.properties.default_activation);
    length.col(m).setConstant(muscle.properties.default_fiber_length_m);
    for (std::size_t c = 0; c < data.channels().size(); ++c) {
      const std::string& name = data.channels()[c].name;
      const auto is = [&](const char* state) {
        return name == muscle.name + state || name.ends_with("/" + muscle.name + "/" + (state + 1));
      };
      const auto column = data.values().col(static_cast<Eigen::Index>(c));
      if (is(".activation") || is("/activation")) {
        activation.col(m) = column;
        any_activation = true;
      } else if (is(".fiber_length") || is("/fiber_length")) {
        length.col(m) = column;
        any_length = true;
      }
    }
  }
  if (any_activation) run.activation = std::move(activation);
  if (any_length) run.fiber_length_m = std::move(length);
}

}  // namespace myoid::opensim
