#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/body/kinematics/joint_motion.h"
#include "myoid/body/kinematics/muscle_kinematics.h"
#include "myoid/body/model/body_model.h"
#include "myoid/body/model/constraints.h"
#include "myoid/ground/core/error.h"
#include "myoid/program/steps/stage_input.h"
#include "myoid/program/steps/stage_options.h"

#include "bindings.h"
#include "to_python.h"
#include "work.h"

namespace myoid::python {
namespace {

using body::BodyModel;

/// A model and the remarks of its reader.
struct ReadModel {
  BodyModel model;
  std::vector<Remark> remarks;
};

struct ModelOptions {
  program::Call call;
  std::string file = "arm4";
  body::Compatibility compat = body::Compatibility::exact;
};

void visit(ModelOptions& o, study::SettingVisitor& v) {
  v.path("file", o.file, {.says = "OpenSim model (.osim), or arm4."});
  program::visit_compat(o.compat, v);
}

std::shared_ptr<ReadModel> read_model(py::dict given) {
  Work work("Model", std::move(given));
  const auto o = work.options<ModelOptions>();
  return work.run([&] {
    program::Remarks remarks(o.call);
    auto read = std::make_shared<ReadModel>();
    read->model = program::load_model(o.file, o.compat, remarks);
    read->remarks = remarks.list();
    return read;
  });
}

py::list coordinates(const ReadModel& read) {
  py::list list;
  const BodyModel& model = read.model;
  const Eigen::VectorXd usual = model.default_q();
  for (std::size_t i = 0; i < model.coordinates.size(); ++i) {
    const body::Coordinate& c = model.coordinates[i];
    py::dict d;
    d["name"] = c.name;
    d["unit"] = std::string(symbol(body::coordinate_unit(c, 0)));
    d["default"] = usual[static_cast<Eigen::Index>(i)];
    d["lower"] = c.lower;
    d["upper"] = c.upper;
    d["clamped"] = c.clamped;
    d["locked"] = c.locked;
    d["constrained"] = model.is_constrained(static_cast<int>(i));
    list.append(d);
  }
  return list;
}

py::list muscles(const ReadModel& read) {
  py::list list;
  for (const body::Muscle& muscle : read.model.muscles) {
    const body::MuscleProperties& p = muscle.properties;
    py::dict d;
    d["name"] = muscle.name;
    d["class_name"] = muscle.class_name;
    d["max_isometric_force"] = p.max_isometric_force_n;
    d["optimal_fiber_length"] = p.optimal_fiber_length_m;
    d["tendon_slack_length"] = p.tendon_slack_length_m;
    d["pennation_at_optimal"] = p.pennation_at_optimal_rad;
    d["max_contraction_velocity"] = p.max_contraction_velocity;
    list.append(d);
  }
  return list;
}

py::list bodies(const ReadModel& read) {
  py::list list;
  for (const body::Body& body : read.model.bodies) {
    py::dict d;
    d["name"] = body.name;
    d["mass"] = body.mass_kg;
    list.append(d);
  }
  return list;
}

std::vector<std::string> marker_names(const ReadModel& read) {
  std::vector<std::string> names;
  for (const body::Marker& marker : read.model.markers) names.push_back(marker.name);
  return names;
}

/// The postures as a motion: coordinates that are not given rest at their default, couplers give
/// the dependent ones, and the speeds are those given, else 0.
body::JointMotion motion_of(const BodyModel& model,
                            const std::map<std::string, Eigen::VectorXd>& q,
                            const std::map<std::string, Eigen::VectorXd>& speeds,
                            Eigen::Index postures) {
  const auto count = static_cast<Eigen::Index>(model.coordinates.size());
  Eigen::MatrixXd values = model.default_q().transpose().replicate(postures, 1);
  Eigen::MatrixXd rates = Eigen::MatrixXd::Zero(postures, count);
  for (const auto& [name, given] : q) values.col(model.coordinate_index(name)) = given;
  for (const auto& [name, given] : speeds) rates.col(model.coordinate_index(name)) = given;
  if (!values.allFinite() || !rates.allFinite()) throw InvalidInput("posture: a value is not finite");
  for (Eigen::Index i = 0; i < postures; ++i) {
    Eigen::VectorXd row = values.row(i).transpose();
    body::apply_couplers(model, row);
    values.row(i) = row.transpose();
  }
  const Eigen::VectorXd number = Eigen::VectorXd::LinSpaced(postures, 0.0, static_cast<double>(postures - 1));
  const auto series = [&](int order, Eigen::MatrixXd numbers) {
    std::vector<Channel> channels;
    for (const body::Coordinate& c : model.coordinates) channels.push_back({c.name, body::coordinate_unit(c, order)});
    return TimeSeries(number, std::move(channels), std::move(numbers));
  };
  return {.q = series(0, std::move(values)),
          .qdot = series(1, std::move(rates)),
          .qddot = series(2, Eigen::MatrixXd::Zero(postures, count))};
}

/// Values by coordinate: a column of `postures` numbers for each.
std::map<std::string, Eigen::VectorXd> columns_of(const py::dict& given, Eigen::Index postures) {
  std::map<std::string, Eigen::VectorXd> columns;
  for (const auto& [name, values] : given) {
    const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(values);
    if (!array || array.size() != postures)
      throw InvalidInput(fmt::format("posture: {}: found {} numbers, expected {}", name.cast<std::string>(),
                                     array ? array.size() : 0, postures));
    columns[name.cast<std::string>()] = Eigen::Map<const Eigen::VectorXd>(array.data(), postures);
  }
  return columns;
}

/// Lengths, velocities and moment arms of all muscles at postures, in the order of the model.
py::dict muscle_kinematics(const ReadModel& read,
                           const py::dict& posture,
                           const py::dict& speeds,
                           Eigen::Index postures) {
  const auto q = columns_of(posture, postures);
  const auto rates = columns_of(speeds, postures);
  body::MuscleKinematics muscles;
  {
    const py::gil_scoped_release others_may_run;
    muscles = body::muscle_kinematics(read.model, motion_of(read.model, q, rates, postures));
  }
  py::dict arms;
  for (const auto& [coordinate, arm] : muscles.moment_arm) arms[py::str(coordinate)] = to_array(arm.values());
  py::dict d;
  d["length"] = to_array(muscles.length.values());
  d["velocity"] = to_array(muscles.velocity.values());
  d["moment_arm"] = arms;
  return d;
}

}  // namespace

void bind_model(py::module_& module) {
  py::class_<ReadModel, std::shared_ptr<ReadModel>>(module, "Model")
      .def("name", [](const ReadModel& read) { return read.model.name; })
      .def("coordinates", &coordinates)
      .def("muscles", &muscles)
      .def("bodies", &bodies)
      .def("markers", &marker_names)
      .def("unsupported", [](const ReadModel& read) { return read.model.unsupported; })
      .def("notes", [](const ReadModel& read) { return sentences(read.model.notes); })
      .def("muscle_kinematics", &muscle_kinematics);
  module.def("read_model", &read_model);
}

}  // namespace myoid::python
