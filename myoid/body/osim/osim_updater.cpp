#include "myoid/body/osim/osim_updater.h"

#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/osim/osim_update_parts.h"
#include "myoid/body/osim/osim_xml.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::body {
namespace {

/// A model of an old document while its bodies and joints take the newest form.
class ModelUpdate {
 public:
  ModelUpdate(const OsimXml& source, pugi::xml_node model, const OsimUpdateOptions& options)
      : source_(source), model_(model), options_(options) {}

  void run() {
    leave_engine();
    const auto bodies = model_.child("BodySet").child("objects");
    if (!bodies) return;
    joints_ = joint_set();
    std::vector<pugi::xml_node> nodes;
    for (const auto node : bodies.children("Body")) nodes.push_back(node);
    for (const auto node : nodes) update_body(node);
    for (const auto joint : joints_.children()) {
      if (joint.child("parent_body") || joint.child("location_in_parent")) {
        update_joint(joint, {});
      } else if (joint.child("reverse")) {
        reverse_sockets(joint);
      }
    }
    if (source_.version() < 30500) free_bodies(nodes);
    for (const auto node : nodes) {
      if (OsimXml::name_of(node) == "ground") make_ground(node);
    }
    if (!joints_.first_child()) model_.remove_child(joints_.parent());
  }

 private:
  [[nodiscard]] bool is_old(pugi::xml_node where) const { return source_.version(where) < 30500; }

  /// Takes the bodies out of the engine that holds them in documents before 10700.
  void leave_engine() {
    const auto holder = model_.child("DynamicsEngine");
    const auto engine = OsimXml::first_element(holder);
    if (!engine || model_.child("BodySet")) return;
    for (const char* set : {"BodySet", "JointSet", "ConstraintSet", "MarkerSet"})
      if (const auto child = engine.child(set)) model_.append_move(child);
    model_.remove_child(holder);
  }

  pugi::xml_node joint_set() {
    auto set = model_.child("JointSet");
    if (!set) {
      set = model_.insert_child_after("JointSet", model_.child("BodySet"));
      set_attribute(set, "name", "jointset");
    }
    return child_or_new(set, "objects");
  }

  [[nodiscard]] std::string digits(const std::string& text) const {
    if (!options_.six_digits) return text;
    std::string result;
    for (const std::string_view word : list_items(text)) {
      char buffer[32];
      std::snprintf(buffer, sizeof buffer, "%.6g", std::strtod(std::string(word).c_str(), nullptr));
      result += (result.empty() ? "" : " ") + std::string(buffer);
    }
    return result;
  }

  /// Reverses a joint that moves its parent on its child, which documents until 30514 allow.
  static void reverse_sockets(pugi::xml_node joint) {
    auto parent = joint.child("socket_parent_frame"), child = joint.child("socket_child_frame");
    if (is_true(child_text(joint, "reverse")) && parent && child) {
      parent.set_name("socket_child_frame");
      child.set_name("socket_parent_frame");
    }
    joint.remove_child("reverse");
  }

  void update_body(pugi::xml_node body) {
    const std::string name = OsimXml::name_of(body);
    if (is_old(body) && !body.child("inertia")) {
      std::string inertia;
      for (const char* part : {"xx", "yy", "zz", "xy", "xz", "yz"}) {
        const std::string property = std::string("inertia_") + part;
        std::string value = child_text(body, property.c_str());
        if (value.empty()) value = part[0] == part[1] ? "1" : "0";
        inertia += (inertia.empty() ? "" : " ") + digits(value);
        body.remove_child(property.c_str());
      }
      append_text(body, "inertia", inertia);
      if (!body.child("mass")) append_text(body, "mass", "0");
    }
    update_visible(body, name);
    const auto holder = body.child("Joint");
    if (const auto joint = OsimXml::first_element(holder); joint && name != "ground") {
      update_joint(joints_.append_move(joint), name);
      has_joint_.insert(name);
    }
    body.remove_child(holder);
  }

  /// Updates a joint. `child`: the body that holds the joint.
  void update_joint(pugi::xml_node joint, std::string child) {
    const std::string name = OsimXml::name_of(joint);
    const auto take = [&](const char* property) {
      const std::string text = child_text(joint, property);
      joint.remove_child(property);
      return text;
    };
    // Version 4's betas name bodies by their path from the joint: "../rod".
    const auto body_of = [&](const char* property) {
      std::string path = take(property);
      while (path.starts_with("../")) path.erase(0, 3);
      return path;
    };
    std::string parent = take("parent_body");
    if (parent.empty()) parent = body_of("socket_parent_body");
    if (parent.empty()) parent = take("socket_parent_frame");
    if (child.empty()) child = take("child_body");
    if (child.empty()) child = body_of("socket_child_body");
    if (child.empty()) child = take("socket_child_frame");
    if (parent.empty() || child.empty()) source_.fail(joint, "joint '{}' does not name its parent and child", name);
    std::string place_in_parent = digits(take("location_in_parent"));
    std::string turn_in_parent = digits(take("orientation_in_parent"));
    const bool in_child = static_cast<bool>(joint.child("location_in_child"));
    std::string place = digits(take(in_child ? "location_in_child" : "location"));
    std::string turn = digits(take(in_child ? "orientation_in_child" : "orientation"));
    if (is_true(take("reverse"))) {
      std::swap(parent, child);
      std::swap(place_in_parent, place);
      std::swap(turn_in_parent, turn);
    }
    const auto last = [](const std::string& path) { return path.substr(path.find_last_of('/') + 1) + "_offset"; };
    append_text(joint, "socket_parent_frame", last(parent));
    append_text(joint, "socket_child_frame", last(child));
    if (const auto set = joint.child("CoordinateSet")) {
      auto coordinates = joint.append_child("coordinates");
      std::vector<pugi::xml_node> nodes;
      for (const auto node : set.child("objects").children("Coordinate")) nodes.push_back(node);
      for (const auto node : nodes) coordinates.append_move(node);
      joint.remove_child(set);
    }
    const auto frames = child_or_new(joint, "frames");
    append_frame(frames, last(parent), frame_path(parent), place_in_parent, turn_in_parent);
    append_frame(frames, last(child), frame_path(child), place, turn);
    update_axes(joint);
    joint.remove_child("VisibleObject");
  }

  /// Returns the path of a frame; a name without a path is a body's.
  [[nodiscard]] static std::string frame_path(const std::string& name) {
    return name.find('/') == std::string::npos ? body_path(name) : name;
  }

  /// Updates the axes of documents before 10901, whose sets hold rotations and translations in any order.
  static void update_axes(pugi::xml_node joint) {
    const auto set = joint.child("TransformAxisSet");
    if (!set) return;
    auto transform = joint.append_child("SpatialTransform");
    std::map<std::string, pugi::xml_node> slots;
    int rotations = 0, translations = 0;
    for (auto axis : set.child("objects").children()) {
      if (axis.type() != pugi::node_element) continue;
      const bool turns = is_true(child_text(axis, "is_rotation"));
      axis.remove_child("is_rotation");
      axis.remove_child("VisibleObject");
      rename_child(axis, "coordinate", "coordinates");
      slots[fmt::format("{}{}", turns ? "rotation" : "translation", turns ? ++rotations : ++translations)] = axis;
    }
    constexpr const char* kAxes[] = {"1 0 0", "0 1 0", "0 0 1"};
    for (const char* kind : {"rotation", "translation"}) {
      for (int k = 0; k < 3; ++k) {
        const std::string slot = fmt::format("{}{}", kind, k + 1);
        const bool known = slots.contains(slot);
        auto axis = known ? transform.append_move(slots[slot]) : transform.append_child("TransformAxis");
        axis.set_name("TransformAxis");
        set_attribute(axis, "name", slot);
        if (known) continue;
        append_text(axis, "axis", kAxes[k]);
        append_text(axis.append_child("function").append_child("Constant"), "value", "0");
      }
    }
    joint.remove_child(set);
  }

  /// Adds free joints for bodies without a joint, which move freely in old documents.
  void free_bodies(const std::vector<pugi::xml_node>& bodies) {
    for (const auto joint : joints_.children()) {
      for (const auto frame : joint.child("frames").children()) {
        if (OsimXml::name_of(frame) == child_text(joint, "socket_child_frame")) {
          const std::string path = child_text(frame, "socket_parent");
          has_joint_.insert(path.substr(path.find_last_of('/') + 1));
        }
      }
    }
    for (const auto body : bodies) {
      const std::string name = OsimXml::name_of(body);
      if (name == "ground" || has_joint_.contains(name)) continue;
      auto joint = joints_.append_child("FreeJoint");
      set_attribute(joint, "name", name + "_free");
      append_text(joint, "socket_parent_frame", "ground_offset");
      append_text(joint, "socket_child_frame", name + "_offset");
      auto coordinates = joint.append_child("coordinates");
      for (int k = 0; k < 6; ++k)
        set_attribute(coordinates.append_child("Coordinate"), "name", fmt::format("{}_free_coord_{}", name, k));
      auto frames = joint.append_child("frames");
      append_frame(frames, "ground_offset", "/ground", {}, {});
      append_frame(frames, name + "_offset", body_path(name), {}, {});
    }
  }

  void make_ground(pugi::xml_node body) {
    auto ground = model_.child("Ground");
    if (!ground) {
      ground = model_.insert_child_before("Ground", model_.child("BodySet"));
      set_attribute(ground, "name", "ground");
    }
    for (const char* part : {"attached_geometry", "components", "WrapObjectSet"})
      if (const auto child = body.child(part); child && !ground.child(part)) ground.append_move(child);
    body.parent().remove_child(body);
  }

  /// Adds the meshes of a body; a mesh with a place of its own gets a frame.
  void update_visible(pugi::xml_node body, const std::string& name) {
    const auto visible = body.child("VisibleObject");
    if (!visible) return;
    const std::string all = child_text(visible, "scale_factors");
    int number = 0;
    for (const auto shape : visible.child("GeometrySet").child("objects").children()) {
      const std::string file = child_text(shape, "geometry_file");
      if (!file.empty()) add_mesh(body, name, ++number, file, shape, all);
    }
    std::istringstream files(child_text(visible, "geometry_files"));
    for (std::string file; files >> file;) add_mesh(body, name, ++number, file, {}, all);
    body.remove_child(visible);
  }

  static std::string product(const std::string& a, const std::string& b) {
    const auto one = list_items(a), two = list_items(b);
    const auto at = [](const std::vector<std::string_view>& items, std::size_t k) {
      return k < items.size() ? parse_number(items[k]).value_or(1.0) : 1.0;
    };
    std::string result;
    for (std::size_t k = 0; k < 3; ++k) result += (k == 0 ? "" : " ") + format_number(at(one, k) * at(two, k));
    return result;
  }

  static void add_mesh(pugi::xml_node body,
                       const std::string& name,
                       int number,
                       const std::string& file,
                       pugi::xml_node shape,
                       const std::string& scale) {
    auto holder = body;
    const std::string transform = child_text(shape, "transform");
    std::vector<std::string> w;
    bool placed = false;
    for (const std::string_view word : list_items(transform)) {
      w.emplace_back(word);
      placed = placed || std::strtod(w.back().c_str(), nullptr) != 0.0;
    }
    if (placed && w.size() == 6) {
      holder = append_frame(child_or_new(body, "components"), fmt::format("{}_geom_frame_{}", name, number), "..",
                            w[3] + " " + w[4] + " " + w[5], w[0] + " " + w[1] + " " + w[2]);
    }
    auto mesh = child_or_new(holder, "attached_geometry").append_child("Mesh");
    set_attribute(mesh, "name", fmt::format("{}_geom_{}", name, number));
    append_text(mesh, "socket_frame", "..");
    append_text(mesh, "scale_factors", product(scale, child_text(shape, "scale_factors")));
    auto look = mesh.append_child("Appearance");
    for (const char* part : {"opacity", "color"})
      if (const std::string text = child_text(shape, part); !text.empty()) append_text(look, part, text);
    append_text(mesh, "mesh_file", file);
  }

  const OsimXml& source_;
  pugi::xml_node model_, joints_;
  const OsimUpdateOptions& options_;
  std::set<std::string> has_joint_;
};

/// Objects take properties that they omit from the prototype of their class; afterwards the prototypes are removed.
void spread_defaults(pugi::xml_node holder) {
  const auto defaults = holder.child("defaults");
  if (!defaults) return;
  std::vector<pugi::xml_node> waiting{holder};
  while (!waiting.empty()) {
    pugi::xml_node node = waiting.back();
    waiting.pop_back();
    for (auto child : node.children())
      if (child.type() == pugi::node_element && child != defaults) waiting.push_back(child);
    const auto prototype = defaults.child(node.name());
    if (!prototype || node == holder) continue;
    for (const auto value : prototype.children()) {
      const std::string_view name = value.name();
      if (value.type() != pugi::node_element || node.child(value.name())) continue;
      // Functions and sets of objects belong to the object itself.
      if (name.ends_with("Set") || name == "VisibleObject" || name == "Joint") continue;
      if (std::string_view(node.name()) == "TransformAxis" && OsimXml::first_element(value)) continue;
      node.append_copy(value);
    }
  }
  holder.remove_child(defaults);
}

/// Paths like /bodyset/femur begin with the names of the model's sets, which old files leave open.
void name_sets(pugi::xml_node model, int old_version) {
  for (auto set : model.children()) {
    if (!std::string_view(set.name()).ends_with("Set")) continue;
    if (old_version < 40000 || OsimXml::name_of(set).empty()) set_attribute(set, "name", lower_case(set.name()));
  }
}

int drop_visible(pugi::xml_node root) {
  int count = 0;
  for_each_element(root, [&](pugi::xml_node node) {
    while (node.remove_child("VisibleObject")) ++count;
  });
  return count;
}

}  // namespace

UpdatedOsim updated_osim(std::string_view text, const std::filesystem::path& path, const OsimUpdateOptions& options) {
  const OsimXml source(std::string(text), path, OsimXml::Root::any);
  UpdatedOsim result;
  result.old_version = source.version();
  for (const std::filesystem::path& file : source.files())
    result.notes.push_back(
        {.code = RemarkCode::reading,
         .says = fmt::format("the part in the file '{}' stands in the updated document itself", file.string())});
  for (const auto* sentences : {&source.repairs(), &source.ignored()})
    for (const std::string& says : *sentences) result.notes.push_back({.code = RemarkCode::reading, .says = says});
  pugi::xml_document document;
  (void)document.load_buffer(source.text().data(), source.text().size(), pugi::parse_default | pugi::parse_comments);
  auto root = document.child("OpenSimDocument");
  if (!root) {
    root = document.append_child("OpenSimDocument");
    std::vector<pugi::xml_node> objects;
    for (const auto node : document.children())
      if (node != root && node.type() == pugi::node_element) objects.push_back(node);
    for (const auto node : objects) root.append_move(node);
  }
  spread_defaults(root);
  for (const auto node : root.children()) spread_defaults(node);
  update_parts(root, [&](pugi::xml_node node) { return source.version(node); });
  if (const auto model = root.child("Model")) {
    ModelUpdate(source, model, options).run();
    name_sets(model, result.old_version);
  }
  if (const int looks = drop_visible(root); looks > 0) {
    result.notes.push_back(
        {.code = RemarkCode::reading,
         .says = fmt::format(
             "{} descriptions of how paths, markers or wrap objects look are left out; OpenSim shows them as it "
             "shows new ones",
             looks)});
  }
  if (result.old_version < kNewestOsimVersion) set_attribute(root, "Version", std::to_string(kNewestOsimVersion));
  while (document.child("OpenSimDocument") != document.first_child() &&
         document.first_child().type() == pugi::node_declaration)
    document.remove_child(document.first_child());
  auto declaration = document.prepend_child(pugi::node_declaration);
  declaration.append_attribute("version").set_value("1.0");
  declaration.append_attribute("encoding").set_value("UTF-8");
  std::ostringstream out;
  document.save(out, "\t", pugi::format_default, pugi::encoding_utf8);
  result.text = out.str();
  return result;
}

}  // namespace myoid::body
