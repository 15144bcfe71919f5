#include "myoid/opensim/projects/model_parts.h"

#include <utility>

#include "myoid/ground/files/text_file.h"
#include "myoid/opensim/projects/osimx_file.h"
#include "myoid/opensim/projects/project_xml.h"

namespace myoid::opensim {

using Quantity = MuscleQuantity;
using body::OsimXml;

ModelParts read_model_parts(const std::filesystem::path& path) {
  OsimXml xml(read_text_file(path), path);
  const pugi::xml_node model = xml.root().child("Model");
  const pugi::xml_node defaults = body::either_child(xml.root(), "defaults", "none");
  xml.set_prototypes(defaults ? defaults : model.child("defaults"));
  ModelParts parts;
  const pugi::xml_node set = model.child("ForceSet");
  for (const pugi::xml_node object : OsimXml::objects(set)) {
    ProjectMuscle muscle{OsimXml::name_of(object), {}, {}};
    for (const OsimxNumber& number : osimx_numbers())
      if (number.is_length || number.quantity == Quantity::max_isometric_force)
        if (const auto value = finite_number(xml, object, number.element))
          muscle.numbers[number.quantity].value = *value;
    if (muscle.numbers.contains(Quantity::optimal_fiber_length)) parts.muscles.push_back(std::move(muscle));
  }
  for (const pugi::xml_node group : set.child("groups").children("ObjectGroup"))
    parts.groups[OsimXml::name_of(group)] = xml.words(group, "members");
  return parts;
}

}  // namespace myoid::opensim
