#include "myoid/opensim/model_controls.h"

#include <utility>

#include <fmt/format.h>

#include "myoid/ground/files/text_file.h"
#include "myoid/recording/tables/storage_reader.h"

namespace myoid::opensim {
namespace {

using body::OsimXml;
using body::Signal;

/// Returns the name of the actuator of a column or control.
std::string actuator_of(std::string name) {
  if (name.ends_with(".excitation")) name.resize(name.size() - 11);
  if (const auto slash = name.rfind('/'); slash != std::string::npos) name.erase(0, slash + 1);
  return name;
}

void read_table(const std::filesystem::path& path, ModelControls& controls) {
  const TimeSeries data = recording::read_storage(path).data;
  for (std::size_t c = 0; c < data.channels().size(); ++c) {
    Signal signal;
    const Eigen::VectorXd values = data.values().col(static_cast<Eigen::Index>(c));
    signal.time_s.assign(data.time_s().begin(), data.time_s().end());
    signal.value.assign(values.begin(), values.end());
    const std::string name = actuator_of(data.channels()[c].name);
    body::validate(signal, fmt::format("{}: control of {}", path.string(), name));
    controls[name] = std::move(signal);
  }
}

/// Nodes of a ControlLinear; with steps each value holds until the next node.
Signal linear_control(const OsimXml& xml, pugi::xml_node node) {
  Signal signal;
  const bool steps = xml.flag(node, "use_steps", false);
  const auto nodes = node.child("x_nodes");
  const auto holder = nodes.child("objects") ? nodes.child("objects") : nodes;
  for (const auto point : holder.children("ControlLinearNode")) {
    const double time_s = xml.number(point, "t", 0.0);
    if (steps && !signal.time_s.empty()) {
      signal.time_s.push_back(time_s);
      signal.value.push_back(signal.value.back());
    }
    signal.time_s.push_back(time_s);
    signal.value.push_back(xml.number(point, "value", 0.0));
  }
  return signal;
}

void read_control_set(const std::filesystem::path& path, ModelControls& controls) {
  OsimXml xml(read_text_file(path), path, OsimXml::Root::any);
  const auto set = xml.root().child("ControlSet");
  if (!set) xml.fail(xml.root(), "expected a <ControlSet>");
  if (const auto defaults = set.child("defaults")) xml.set_prototypes(defaults);
  for (const auto node : OsimXml::objects(set)) {
    const std::string_view kind = node.name();
    const std::string name = actuator_of(OsimXml::name_of(node));
    if (kind == "ControlLinear") {
      controls[name] = linear_control(xml, node);
    } else if (kind == "ControlConstant") {
      controls[name] = body::constant(xml.number(node, "value", 0.0));
    } else {
      xml.fail(node, "control '{}' of kind {} is not supported; ControlLinear and ControlConstant are", name, kind);
    }
    body::validate(controls[name], fmt::format("{}: control of {}", path.string(), name));
  }
}

}  // namespace

ModelControls read_model_controls(const OpensimSetup& setup, std::vector<Remark>* remarks) {
  const auto& xml = setup.xml();
  ModelControls controls;
  for (const auto node : OsimXml::objects(xml.property(setup.tool(), "ControllerSet"))) {
    if (!xml.flag(node, "enabled", !xml.flag(node, "isDisabled", false))) continue;
    if (std::string_view(node.name()) != "ControlSetController") {
      const std::string message = fmt::format(
          "controller '{}' of kind {} is not run; give its controls as a table to a ControlSetController "
          "(<controls_file>)",
          OsimXml::name_of(node), node.name());
      if (remarks == nullptr) xml.fail(node, message);
      remarks->push_back({.says = message});
      continue;
    }
    const auto path = setup.required_file(node, "controls_file");
    if (path.extension() == ".xml") {
      read_control_set(path, controls);
    } else {
      read_table(path, controls);
    }
  }
  return controls;
}

}  // namespace myoid::opensim
