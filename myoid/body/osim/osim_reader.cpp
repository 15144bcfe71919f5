#include "myoid/body/osim/osim_reader.h"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_frames.h"
#include "myoid/body/osim/osim_parts.h"
#include "myoid/body/osim/osim_updater.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::body {
namespace {

void read_marker(OsimReading& r, pugi::xml_node node, const std::string& path) {
  Marker marker;
  marker.name = OsimXml::name_of(node);
  const FixedFrame frame = frame_of(r, node, "parent_frame", path);
  marker.body = frame.body;
  marker.p_BM = frame.X_BF * r.xml.vec3(node, "location", Vec3::Zero());
  if (!marker.p_BM.allFinite()) r.xml.fail(node, "marker '{}': its location is not finite", marker.name);
  r.model.markers.push_back(std::move(marker));
}

void read_markers(OsimReading& r, pugi::xml_node set) {
  for (const auto node : OsimXml::objects(set)) {
    if (std::string_view(node.name()) == "Marker") read_marker(r, node, "/markerset/" + OsimXml::name_of(node));
  }
}

/// Reads markers, constraints and forces outside of their sets.
void read_loose_components(OsimReading& r, pugi::xml_node model) {
  for (const auto& [node, path] : components_of(model, "", "Marker")) read_marker(r, node, path);
  for (const auto& [node, path] : components_of(model, "", "Constraint")) read_constraint(r, node, path);
  for (const auto& [node, path] : components_of(model, "", "")) read_component_force(r, node);
}

}  // namespace

BodyModel parse_osim(std::string_view text, const std::filesystem::path& path, const OsimOptions& options) {
  OsimXml xml(std::string(text), path);
  auto model = xml.root().child("Model");
  if (!model) {
    xml.fail(xml.root(), "the document has no <Model>; this is another kind of OpenSim file (a set-up?)");
  }
  if (xml.version() < 10600) {
    xml.fail(xml.root(), "document version {} is too old (before 10600): open the model in OpenSim and save it again",
             xml.version());
  }
  const std::vector<std::string> freed =
      bring_to_newest_form(xml, {.six_digits = options.compat.six_digit_offsets, .looks = false});
  OsimReading r{xml, options.compat, {}, {}};
  r.model.compat = options.compat;
  r.model.document_version = xml.version();
  r.model.name = OsimXml::name_of(model);
  r.model.gravity_G = xml.vec3(model, "gravity", r.model.gravity_G);
  for (const std::string& sentence : xml.ignored()) r.leave_out("{}", sentence);
  if (components_of(model, "BodySet", "Body").empty() && !model.child("BodySet"))
    xml.fail(model, "the model has no <BodySet>, and no <Body> among its components");
  read_bodies(r, model);
  for (const std::string& sentence : freed) r.note("{}", sentence);
  read_joints(r, model);
  read_markers(r, model.child("MarkerSet"));
  read_wrap_objects(r, model);
  read_forces(r, model.child("ForceSet"));
  read_constraints(r, model.child("ConstraintSet"));
  read_loose_components(r, model);
  note_classes(r.model);
  for (const std::string& sentence : xml.repairs())
    r.model.notes.push_back({.code = RemarkCode::reading, .severity = Severity::note, .says = sentence});
  try {
    return finalize(std::move(r.model));
  } catch (const ModelError& error) {
    throw ModelError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

BodyModel read_osim(const std::filesystem::path& path, const OsimOptions& options) {
  return parse_osim(read_text_file(path), path, options);
}

void require_lengths_in_m(const BodyModel& model, const std::filesystem::path& path) {
  BodyState state = make_state(model);
  compute_poses(model, model.default_q(), state);
  const Joint* longest = nullptr;
  double length_m = kLongestSegment_m;
  for (const Joint& joint : model.joints) {
    const double now_m =
        joint.parent == 0 ? 0.0 : (state.X_GB[at(joint.child)].p - state.X_GB[at(joint.parent)].p).norm();
    if (!(now_m > length_m)) continue;
    length_m = now_m;
    longest = &joint;
  }
  if (longest == nullptr) return;
  constexpr double kLongestInCentimeters = 100.0;
  throw ReadError(
      path, 0,
      fmt::format("the origin of the model's {} lies {:.3g} m from that of {}, expected less than {:g} m: are "
                  "the model's lengths in {}? They must be in m",
                  model.bodies[at(longest->child)].name, length_m, model.bodies[at(longest->parent)].name,
                  kLongestSegment_m, length_m > kLongestInCentimeters ? "mm" : "cm"));
}

BodyModel with_force_set(BodyModel model, const std::filesystem::path& path) {
  OsimXml xml(read_text_file(path), path);
  (void)bring_to_newest_form(xml, {.looks = false});
  const auto set = xml.root().child("ForceSet");
  if (!set) xml.fail(xml.root(), "expected a <ForceSet> in <OpenSimDocument>");
  OsimReading r{xml, model.compat, std::move(model), {}};
  for (const std::string& sentence : xml.ignored()) r.note("{}: {}", path.string(), sentence);
  std::string repeated;
  for (const auto node : OsimXml::objects(set)) {
    const std::string name = OsimXml::name_of(node);
    const auto& names = r.model.force_order;
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      read_force(r, node);
    } else {
      repeated += fmt::format("{}'{}'", repeated.empty() ? "" : ", ", name);
    }
  }
  if (!repeated.empty()) {
    r.note(
        "{}: the model has forces of these names already; as in OpenSim the model's own act and the file's are left "
        "out: {}",
        path.string(), repeated);
  }
  return finalize(std::move(r.model));
}

}  // namespace myoid::body
