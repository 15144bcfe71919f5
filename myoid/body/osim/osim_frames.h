#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/body/osim/osim_xml.h"

namespace myoid::body {

/// A frame fixed to a body.
struct FixedFrame {
  BodyIndex body = 0;
  Pose X_BF;
};

/// State that the parts of the reader share: the document in its newest form (osim_updater.h), the model read so far
/// and the frames by their paths.
struct OsimReading {
  const OsimXml& xml;
  Compat compat;
  BodyModel model;

  struct OffsetFrame {
    pugi::xml_node node;
    std::string owner;  ///< Path of the component that holds the frame.
  };
  using Frames = std::map<std::string, OffsetFrame, std::less<>>;
  Frames frames;  ///< Frames by absolute path.

  /// Indices in the model by name; the first of several with one name.
  std::map<std::string, int, std::less<>> body_places, coordinate_places;
  /// Names that coordinates of several joints share; the name of the joint distinguishes them.
  std::set<std::string, std::less<>> shared_coordinate_names;

  /// Starts from a model that is partly read.
  explicit OsimReading(const OsimXml& document, const Compat& as = {}, BodyModel known = {}, Frames known_frames = {});
  template <typename... T>
  void note(fmt::format_string<T...> text, T&&... values) {
    model.notes.push_back({.code = RemarkCode::reading,
                           .severity = Severity::note,
                           .says = fmt::format(text, std::forward<T>(values)...)});
  }
  /// Lists a part of the file in `BodyModel::unsupported`.
  template <typename... T>
  void leave_out(fmt::format_string<T...> text, T&&... values) {
    model.unsupported.push_back(fmt::format(text, std::forward<T>(values)...));
  }
  int add(Body body);
  int add(Coordinate coordinate);
  [[nodiscard]] std::optional<int> find_body(std::string_view name) const;
  /// Finds a coordinate by its name or by a path that ends in joint/coordinate.
  [[nodiscard]] std::optional<int> find_coordinate(std::string_view name) const;
};

/// A component of a model and its path in it.
struct ModelComponent {
  pugi::xml_node node;
  std::string path;
};

/// Returns the objects of a set ("/bodyset/x"), then the components outside of the set whose class
/// name ends in `kind`: in <components> ("/x") or <ComponentSet> of the model.
[[nodiscard]] std::vector<ModelComponent> components_of(pugi::xml_node model, const char* set, std::string_view kind);

/// Reads the bodies and collects the offset frames of ground, bodies, joints and
/// the model. Throws ReadError for a body without a name or a mass, and for two bodies of one name.
void read_bodies(OsimReading& reading, pugi::xml_node model);

/// Returns the target of a socket, <socket_x>; empty if there is none.
[[nodiscard]] std::string socket(const OsimReading& reading, pugi::xml_node node, std::string_view name);

/// Returns the frame that a name means from the component `owner`: a body, ground or an offset frame, also in a chain.
/// Throws ReadError for an unknown frame and for a frame that refers to itself.
[[nodiscard]] FixedFrame resolve_frame(const OsimReading& reading,
                                       pugi::xml_node where,
                                       std::string name,
                                       const std::string& owner);

/// Returns the frame that a socket of `node` names; throws ReadError if the socket is missing.
[[nodiscard]] FixedFrame frame_of(const OsimReading& reading,
                                  pugi::xml_node node,
                                  std::string_view socket_name,
                                  const std::string& owner);

/// A point fixed in a body.
struct BodyPoint {
  BodyIndex body = 0;
  Vec3 p_B = Vec3::Zero();
};

/// Returns the point that a socket with a frame and a property with a place in that frame give.
[[nodiscard]] BodyPoint point_of(
    const OsimReading& reading, pugi::xml_node node, const std::string& owner, const char* frame, const char* place);

/// Returns the frame of that path or name in a model file: a body, an offset frame of the model, of
/// a body or of a joint, also a frame that the joints of old documents get
/// ("/jointset/knee_r/tibia_r_offset"). Empty for an unknown name.
[[nodiscard]] std::optional<FixedFrame> find_frame(const BodyModel& model,
                                                   const std::filesystem::path& path,
                                                   const std::string& name);

/// Returns the pose that two properties of an element give: location (translation) and body-fixed
/// X-Y-Z angles.
[[nodiscard]] Pose pose_of(const OsimReading& reading,
                           pugi::xml_node node,
                           const char* location,
                           const char* orientation);

/// Returns the coordinate that a socket or a text names; of several with one name the coordinate of
/// the first joint. Throws ReadError for an unknown name.
[[nodiscard]] int coordinate_named(const OsimReading& reading, pugi::xml_node where, std::string_view text);

/// Returns a number above 0; throws ReadError for another.
[[nodiscard]] double positive(const OsimReading& reading, pugi::xml_node node, const char* name, double otherwise);

/// Returns the unit vector that a property gives; throws ReadError if it is no direction.
[[nodiscard]] Vec3 direction_of(const OsimReading& reading,
                                pugi::xml_node node,
                                const char* name,
                                const Vec3& otherwise);

/// Returns the two frames that a bushing or a constraint joins.
[[nodiscard]] std::pair<FixedFrame, FixedFrame> two_frames(const OsimReading& reading, pugi::xml_node node);

}  // namespace myoid::body
