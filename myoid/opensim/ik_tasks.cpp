#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/kinematics/marker_places.h"
#include "myoid/ground/files/label_match.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/ground/math/spline.h"
#include "myoid/opensim/opensim_files.h"
#include "myoid/opensim/tool_stages.h"

namespace myoid::opensim {
namespace {

using body::OsimXml;

void add_coordinate_task(const OpensimSetup& setup,
                         pugi::xml_node owner,
                         pugi::xml_node node,
                         const body::BodyModel& model,
                         const MarkerSeries& markers,
                         body::IkOptions& ik,
                         std::vector<Remark>& remarks) {
  const OsimXml& xml = setup.xml();
  const std::string name = OsimXml::name_of(node);
  const auto found = model.find_coordinate(name);
  if (!found) xml.fail(node, "IKCoordinateTask '{}': the model has no such coordinate", name);
  const body::Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(*found)];
  body::CoordinateTask task{name, coordinate.default_value, xml.number(node, "weight", 1.0)};
  if (!(task.weight > 0.0) || model.is_constrained(*found)) return;  // nothing to wish for
  const std::string source = xml.word(node, "value_type");
  if (source == "manual_value") {
    task.value = xml.number(node, "value", 0.0);
  } else if (source == "from_file") {
    const auto file = setup.file(owner, "coordinate_file");
    if (!file)
      xml.fail(node, "IKCoordinateTask '{}' takes its values from a file, but the set-up has no <coordinate_file>",
               name);
    const TimeSeries wished = read_coordinates(model, *file, MissingCoordinate::default_value, remarks);
    task.values = math::Spline::interpolate(wished.time_s(), wished.column(name)).evaluate(markers.time_s).value;
  } else if (!source.empty() && source != "default_value") {
    xml.fail(node, "IKCoordinateTask '{}': <value_type> '{}', expected default_value, manual_value or from_file", name,
             source);
  }
  ik.tasks.push_back(std::move(task));
}

/// Notes the markers that tasks weigh and the recording lacks, with the recorded markers of the same name but for its
/// spelling, or at their place.
void note_unseen_markers(const body::BodyModel& model,
                         const body::IkOptions& ik,
                         const MarkerSeries& markers,
                         std::vector<Remark>& remarks) {
  std::vector<std::string> wanted;
  for (const auto& [name, weight] : ik.marker_weights) wanted.push_back(name);
  const LabelMatch match = match_labels(markers.names, wanted);
  std::map<std::string, std::string> called;
  for (const body::PlacedMarker& pair : body::markers_by_place(model, markers)) called[pair.wanted] = pair.recorded;
  for (const auto& [found, name] : match.same) called[name] = found;
  std::string unseen;
  for (const std::string& name : wanted) {
    if (std::find(markers.names.begin(), markers.names.end(), name) != markers.names.end()) continue;
    const auto other = called.find(name);
    unseen += fmt::format("{}'{}'{}", unseen.empty() ? "" : ", ", name,
                          other == called.end() ? "" : fmt::format(" (is it '{}' there?)", other->second));
  }
  if (!unseen.empty())
    remarks.push_back({.says = fmt::format("tasks of markers that the recording does not have: {}", unseen)});
}

}  // namespace

body::IkOptions read_ik_tasks(const OpensimSetup& setup,
                              pugi::xml_node owner,
                              const body::BodyModel& model,
                              const MarkerSeries& markers,
                              std::vector<Remark>& remarks) {
  body::IkOptions ik;
  const OsimXml& xml = setup.xml();
  std::set<std::string> named;
  for (const auto node : OsimXml::objects(owner.child("IKTaskSet"))) {
    const std::string_view kind = node.name();
    const bool marker_task = kind == "IKMarkerTask";
    if (!marker_task && kind != "IKCoordinateTask")
      xml.fail(node, "expected IKMarkerTask or IKCoordinateTask, found <{}>", kind);
    if (marker_task) ik.only_named_markers = true;
    if (!xml.flag(node, "apply", true)) continue;
    if (marker_task) {
      const double weight = xml.number(node, "weight", 1.0);
      if (!(weight >= 0.0)) {
        xml.fail(node, "IKMarkerTask '{}': weight {}, expected 0 or more", OsimXml::name_of(node), weight);
      }
      const std::string name = OsimXml::name_of(node);
      if (!named.insert(name).second)
        remarks.push_back({.says = fmt::format("two tasks for marker '{}': the last one counts", name)});
      if (weight > 0.0) ik.marker_weights[name] = weight;
    } else {
      add_coordinate_task(setup, owner, node, model, markers, ik, remarks);
    }
  }
  std::string unknown;
  std::erase_if(ik.marker_weights, [&](const auto& task) {
    if (model.find_marker(task.first)) return false;
    unknown += fmt::format("{}'{}'", unknown.empty() ? "" : ", ", task.first);
    return true;
  });
  if (!unknown.empty())
    remarks.push_back({.says = fmt::format("tasks of markers that the model does not have: {}", unknown)});
  note_unseen_markers(model, ik, markers, remarks);
  return ik;
}

}  // namespace myoid::opensim
