#include "myoid/opensim/projects/osimx_file.h"

#include <set>
#include <utility>

#include <fmt/format.h>

#include "myoid/opensim/projects/project_xml.h"

namespace myoid::opensim {
namespace {

using Quantity = MuscleQuantity;
using body::OsimXml;

constexpr OsimxNumber kNumbers[] = {
    {"electromechanical_delay", Quantity::delay, 0.1, "optimize_electromechanical_delays", {0.0, 0.125}},
    {"activation_time_constant",
     Quantity::activation_time,
     0.01,
     "optimize_activation_time_constants",
     {0.0075, 0.035}},
    {"activation_nonlinearity_constant",
     Quantity::activation_nonlinearity,
     1.0,
     "optimize_activation_nonlinearity_constants",
     {0.0, 0.35}},
    {"emg_scale_factor", Quantity::emg_scale, 1.0, "optimize_emg_scale_factors", {0.05, 1.0}},
    {"optimal_fiber_length", Quantity::optimal_fiber_length, 1.0, "optimize_optimal_fiber_lengths", {0.6, 1.4}, true},
    {"tendon_slack_length", Quantity::tendon_slack_length, 1.0, "optimize_tendon_slack_lengths", {0.6, 1.4}, true},
    {"max_isometric_force", Quantity::max_isometric_force, 1.0, "", {}, false}};

}  // namespace

std::span<const OsimxNumber> osimx_numbers() { return kNumbers; }

const ElementTable& osimx_elements() {
  static const ElementTable kElements{
      {"OsimxModel", "associated_osim_model RCNLMuscleSet MTPMuscleSet RCNLContactSurfaceSet RCNLSynergySet"},
      {"RCNLMuscleSet", "objects groups RCNLMuscle"},
      {"MTPMuscleSet", "objects groups RCNLMuscle"},
      {"RCNLMuscle",
       "electromechanical_delay activation_time_constant activation_nonlinearity_constant "
       "emg_scale_factor optimal_fiber_length tendon_slack_length max_isometric_force"}};
  return kElements;
}

pugi::xml_node osimx_model(const OsimXml& xml) { return xml.root().child("NMSMPipelineDocument").child("OsimxModel"); }

namespace {

/// Returns the muscles of every form of the set: in <objects>, as the pipeline writes them, or directly in the set; its
/// first versions call the set MTPMuscleSet.
std::vector<pugi::xml_node> osimx_muscles(pugi::xml_node model) {
  std::vector<pugi::xml_node> nodes;
  for (const char* name : {"RCNLMuscleSet", "MTPMuscleSet"}) {
    for (const pugi::xml_node node : OsimXml::objects(model.child(name))) nodes.push_back(node);
    for (const pugi::xml_node node : model.child(name).children("RCNLMuscle")) nodes.push_back(node);
  }
  return nodes;
}

}  // namespace

std::vector<ProjectMuscle> read_osimx(const OsimXml& xml) {
  std::vector<ProjectMuscle> muscles;
  std::set<std::string> names;
  for (const pugi::xml_node node : osimx_muscles(osimx_model(xml))) {
    ProjectMuscle muscle{OsimXml::name_of(node), {}, {}};
    if (muscle.name.empty()) xml.fail(node, "<{}>: an attribute 'name' expected, found none", node.name());
    if (!names.insert(muscle.name).second) xml.fail(node, "two muscles have the name '{}'", muscle.name);
    for (const OsimxNumber& number : kNumbers) {
      const auto value = finite_number(xml, node, number.element);
      if (!value) continue;
      const bool is_size = number.is_length || number.quantity == Quantity::max_isometric_force;
      if (is_size && !(*value > 0.0))
        xml.fail(node.child(number.element), "muscle '{}': <{}>: expected a number above 0, found {}", muscle.name,
                 number.element, *value);
      muscle.numbers[number.quantity].value = number.unit * *value;
    }
    muscles.push_back(std::move(muscle));
  }
  return muscles;
}

std::string osimx_text(const Project& project) {
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("NMSMPipelineDocument");
  root.append_attribute("Version") = "1.0";
  pugi::xml_node model = root.append_child("OsimxModel");
  model.append_attribute("name") = project.model.stem().string().c_str();
  append_text(model, "associated_osim_model", project.model.generic_string());
  pugi::xml_node objects = model.append_child("RCNLMuscleSet").append_child("objects");
  for (const ProjectMuscle& muscle : project.muscles) {
    pugi::xml_node node = objects.append_child("RCNLMuscle");
    node.append_attribute("name") = muscle.name.c_str();
    for (const OsimxNumber& number : kNumbers)
      if (const auto own = muscle.numbers.find(number.quantity); own != muscle.numbers.end())
        append_text(node, number.element, fmt::format("{}", own->second.value / number.unit));
  }
  return document_text(document);
}

}  // namespace myoid::opensim
