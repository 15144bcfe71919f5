#include "myoid/body/osim/osim_updater.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/osim/osim_frames.h"
#include "myoid/body/osim/osim_update_parts.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::body {
namespace {

/// Documents before this version may declare that a joint moves its parent on its child.
constexpr int kFirstOsimWithoutReverse = 30514;

/// A model of an old document while its bodies and joints take the newest form.
class ModelUpdate {
 public:
  ModelUpdate(const OsimXml& source, pugi::xml_node model, const OsimUpdateOptions& options)
      : source_(source), model_(model), options_(options) {}

  /// Returns a sentence for each body that gets a joint.
  std::vector<std::string> run() {
    leave_engine();
    std::vector<pugi::xml_node> bodies;
    for (const auto node : model_.child("BodySet").child("objects").children("Body")) bodies.push_back(node);
    const std::vector<ModelComponent> loose = components_of(model_, "JointSet", "Joint");
    if (!bodies.empty()) joints_ = joint_set();
    for (const auto node : bodies) update_body(node);
    for (const ModelComponent& joint : loose) update_joint(joint.node, {});
    std::vector<std::string> freed;
    if (source_.version() < kFirstOsimWithSockets) freed = free_bodies(bodies);
    for (const auto node : bodies) {
      if (OsimXml::name_of(node) == "ground") make_ground(node);
    }
    if (joints_ && !joints_.first_child()) model_.remove_child(joints_.parent());
    return freed;
  }

 private:
  [[nodiscard]] bool is_old(pugi::xml_node where) const { return source_.version(where) < kFirstOsimWithSockets; }

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

  /// Rounds the numbers of a list to six digits; other words stay.
  [[nodiscard]] static std::string six_digits(const std::string& text) {
    std::string result;
    for (const std::string_view word : list_items(text)) {
      char buffer[32];
      const std::optional<double> number = parse_number(word);
      if (number) std::snprintf(buffer, sizeof buffer, "%.6g", *number);
      result += (result.empty() ? "" : " ") + (number ? std::string(buffer) : std::string(word));
    }
    return result;
  }

  void update_body(pugi::xml_node body) {
    const std::string name = OsimXml::name_of(body);
    if (name.empty()) return;  // the reader refuses it
    if (is_old(body)) {
      if (!source_.property(body, "inertia")) {
        std::string inertia;
        for (const char* part : {"xx", "yy", "zz", "xy", "xz", "yz"}) {
          const std::string property = std::string("inertia_") + part;
          std::string value = source_.word(body, property.c_str());
          // A body with mass is refused for a part that is no number.
          if (source_.number(body, "mass", 0.0) != 0.0) (void)source_.number(body, property.c_str(), 0.0);
          if (value.empty()) value = part[0] == part[1] ? "1" : "0";
          inertia += (inertia.empty() ? "" : " ") + (options_.six_digits ? six_digits(value) : value);
          body.remove_child(property.c_str());
        }
        child_or_new(body, "inertia").text().set(inertia.c_str());
      }
      if (!source_.property(body, "mass")) child_or_new(body, "mass").text().set("0");
    }
    update_visible(body, name);
    const auto holder = body.child("Joint");
    if (const auto joint = OsimXml::first_element(holder); joint && name != "ground") {
      update_joint(joints_.append_move(joint), name);
      has_joint_.insert(name);
    }
    body.remove_child(holder);
  }

  /// Moves a property of a joint, or a copy of its prototype's, into a frame.
  void move_into(pugi::xml_node frame, const char* new_name, pugi::xml_node joint, const char* name, bool rounded) {
    if (const auto value = source_.property(joint, name); value && value.parent() != joint) joint.append_copy(value);
    move_value(joint.child(name), frame, new_name);
    auto moved = frame.child(new_name);
    if (rounded) moved.text().set(six_digits(OsimXml::text_of(moved)).c_str());
  }

  /// Returns the body or frame that a joint names for its "parent" or "child", and removes the properties that name it.
  [[nodiscard]] std::string take_name(pugi::xml_node joint, const std::string& which) const {
    const auto take = [&](const std::string& property) {
      std::string name = source_.word(joint, property.c_str());
      joint.remove_child(property.c_str());
      return name;
    };
    const std::string body = take(which + "_body"), frame = take("socket_" + which + "_frame");
    std::string path = take("socket_" + which + "_body");
    while (path.starts_with("../")) path.erase(0, 3);  // version 4's betas give the path from the joint
    return !body.empty() ? body : !path.empty() ? path : frame;
  }

  /// Updates a joint. `child`: the body that holds the joint; empty for a joint of a set.
  void update_joint(pugi::xml_node joint, std::string child) {
    const bool held = !child.empty();
    const bool reversed = source_.version(joint) < kFirstOsimWithoutReverse && source_.flag(joint, "reverse", false);
    joint.remove_child("reverse");
    if (held || names_bodies(joint)) {
      make_frames(joint, std::move(child), reversed);
    } else if (reversed) {
      auto frame_in_parent = joint.child("socket_parent_frame"), frame_in_child = joint.child("socket_child_frame");
      frame_in_parent.set_name("socket_child_frame");
      frame_in_child.set_name("socket_parent_frame");
    }
    if (const auto set = joint.child("CoordinateSet")) {
      auto coordinates = child_or_new(joint, "coordinates");
      std::vector<pugi::xml_node> nodes;
      for (const auto node : set.child("objects").children("Coordinate")) nodes.push_back(node);
      for (const auto node : nodes) coordinates.append_move(node);
      joint.remove_child(set);
    }
    update_axes(joint);
    joint.remove_child("VisibleObject");
  }

  [[nodiscard]] bool names_bodies(pugi::xml_node joint) const {
    for (const char* property : {"parent_body", "socket_parent_body", "location_in_parent", "location_in_child"})
      if (source_.property(joint, property)) return true;
    return false;
  }

  /// Gives a joint two frames, each in the body, or in the frame, that the joint names.
  void make_frames(pugi::xml_node joint, std::string child, bool reversed) {
    const bool rounded = options_.six_digits && !child.empty();
    std::string parent = take_name(joint, "parent");
    if (child.empty()) child = take_name(joint, "child");
    if (parent.empty() || child.empty()) {
      source_.fail(joint, "joint '{}' has no <{}_body>; expected the name of a body", OsimXml::name_of(joint),
                   parent.empty() ? "parent" : "child");
    }
    const bool in_child = static_cast<bool>(source_.property(joint, "location_in_child"));
    const std::string first = unique_frame(joint, parent), second = unique_frame(joint, child);
    append_text(joint, "socket_parent_frame", reversed ? second : first);
    append_text(joint, "socket_child_frame", reversed ? first : second);
    auto frames = child_or_new(joint, "frames");
    const auto add = [&](const std::string& name, const std::string& in, const char* place, const char* turn) {
      const auto frame = append_frame(frames, name, frame_path(in), {}, {});
      move_into(frame, "translation", joint, place, rounded);
      move_into(frame, "orientation", joint, turn, rounded);
    };
    add(first, parent, "location_in_parent", "orientation_in_parent");
    add(second, child, in_child ? "location_in_child" : "location", in_child ? "orientation_in_child" : "orientation");
    for (const char* gone : {"location", "orientation"}) joint.remove_child(gone);
  }

  /// Returns a name for the frame of a joint in a body that no other frame of a joint of that name has.
  std::string unique_frame(pugi::xml_node joint, const std::string& body) {
    const std::string name = body.substr(body.find_last_of('/') + 1) + "_offset";
    std::string unique = name;
    for (int k = 2; !frames_.insert(OsimXml::name_of(joint) + "/" + unique).second; ++k)
      unique = fmt::format("{}_{}", name, k);
    return unique;
  }

  /// Returns the path of a frame; a name without a path is a body's.
  [[nodiscard]] static std::string frame_path(const std::string& name) {
    return name.find('/') == std::string::npos ? body_path(name) : name;
  }

  /// Updates the axes of documents before 10901, whose sets hold rotations and translations in any order.
  void update_axes(pugi::xml_node joint) const {
    const auto set = joint.child("TransformAxisSet");
    if (!set) return;
    auto transform = joint.append_child("SpatialTransform");
    std::map<std::string, pugi::xml_node> slots;
    int rotations = 0, translations = 0;
    for (auto axis : set.child("objects").children()) {
      if (axis.type() != pugi::node_element) continue;
      const bool turns = source_.flag(axis, "is_rotation", false);
      axis.remove_child("is_rotation");
      axis.remove_child("VisibleObject");
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

  /// Adds free joints for bodies without a joint, which move freely in old documents; returns a sentence for each.
  std::vector<std::string> free_bodies(const std::vector<pugi::xml_node>& bodies) {
    std::vector<std::string> freed;
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
      freed.push_back(fmt::format("body '{}' has no joint; it is free to move", name));
    }
    return freed;
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
    if (!visible || !options_.looks) return;
    const Vec3 all = source_.vec3(visible, "scale_factors", Vec3::Ones());
    const auto holder = placed(body, fmt::format("{}_geom_frame", name), visible);
    int number = 0;
    for (const auto shape : OsimXml::objects(visible.child("GeometrySet"))) {
      const std::string file = child_text(shape, "geometry_file");
      if (!file.empty()) add_mesh(holder, name, ++number, file, shape, all);
    }
    std::istringstream files(child_text(visible, "geometry_files"));  // before 20000
    for (std::string file; files >> file;) add_mesh(holder, name, ++number, file, {}, all);
    body.remove_child(visible);
  }

  /// Returns the holder, or a frame in it for a shape that has a place of its own.
  pugi::xml_node placed(pugi::xml_node holder, const std::string& frame, pugi::xml_node shape) const {
    const auto transform = shape.child("transform");
    if (!transform) return holder;
    const std::vector<double> v = source_.numbers(transform);
    if (v.size() != 6) source_.fail(transform, "expected 6 numbers, found {}", v.size());
    if (std::ranges::all_of(v, [](double x) { return x == 0.0; })) return holder;
    const std::string text = OsimXml::text_of(transform);
    const std::vector<std::string_view> words = list_items(text);
    const auto three = [&](std::size_t k) { return fmt::format("{} {} {}", words[k], words[k + 1], words[k + 2]); };
    return append_frame(child_or_new(holder, "components"), frame, "..", three(3), three(0));
  }

  void add_mesh(pugi::xml_node holder,
                const std::string& name,
                int number,
                const std::string& file,
                pugi::xml_node shape,
                const Vec3& scale) const {
    holder = placed(holder, fmt::format("{}_geom_frame_{}", name, number), shape);
    auto mesh = child_or_new(holder, "attached_geometry").append_child("Mesh");
    set_attribute(mesh, "name", fmt::format("{}_geom_{}", name, number));
    append_text(mesh, "socket_frame", "..");
    const Vec3 factors = scale.cwiseProduct(source_.vec3(shape, "scale_factors", Vec3::Ones()));
    append_text(
        mesh, "scale_factors",
        fmt::format("{} {} {}", format_number(factors[0]), format_number(factors[1]), format_number(factors[2])));
    auto look = mesh.append_child("Appearance");
    for (const char* part : {"opacity", "color"})
      if (const std::string text = child_text(shape, part); !text.empty()) append_text(look, part, text);
    if (source_.number(shape, "display_preference", 4.0) == 0.0) append_text(look, "visible", "false");
    append_text(mesh, "mesh_file", file);
  }

  const OsimXml& source_;
  pugi::xml_node model_, joints_;
  const OsimUpdateOptions& options_;
  std::set<std::string> has_joint_;
  std::set<std::string> frames_;  ///< "JOINT/FRAME" of the frames made.
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

std::vector<std::string> bring_to_newest_form(OsimXml& xml, const OsimUpdateOptions& options) {
  xml.remember_places();
  update_parts(xml.root(), [&](pugi::xml_node node) { return xml.version(node); });
  const auto model = xml.root().child("Model");
  if (!model) return {};
  xml.set_prototypes(model.child("defaults"));
  return ModelUpdate(xml, model, options).run();
}

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
    for (std::string& says : ModelUpdate(source, model, options).run())
      result.notes.push_back({.code = RemarkCode::reading, .says = std::move(says)});
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
