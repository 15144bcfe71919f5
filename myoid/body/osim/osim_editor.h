#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "myoid/body/osim/osim_frames.h"
#include "myoid/body/osim/osim_xml.h"
#include "myoid/ground/core/geometry.h"

namespace myoid::body {

/// Changes a model file as OpenSim's Scale tool does. The document keeps its version and all
/// unchanged elements, and loses its comments.
class OsimEditor {
 public:
  /// Factors along the axes of a body, by its name; other bodies keep their size.
  using Factors = std::map<std::string, Vec3>;

  /// Throws as read_osim.
  OsimEditor(std::string text, std::filesystem::path path);
  OsimEditor(const OsimEditor&) = delete;
  OsimEditor& operator=(const OsimEditor&) = delete;

  [[nodiscard]] std::string text() const;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  void set_name(const std::string& name);

  /// Takes the markers of a file with a <MarkerSet>; they replace the model's markers of their names.
  void add_markers(const std::filesystem::path& file);
  void remove_markers(const std::function<bool(const std::string&)>& is_removed);
  /// Returns true if marker placement does not move the marker.
  [[nodiscard]] bool is_fixed(const std::string& marker) const;
  /// Moves the marker to a place in the frame of its body.
  void move_marker(const std::string& marker, const Vec3& p_B);
  /// Returns the model's markers as a separate document.
  [[nodiscard]] std::string marker_set_text() const;

  /// Scales mass centers, frames, points of paths, wrap objects, markers and meshes of the bodies, and the translations
  /// of joints by the factors of the parent. Masses and lengths of muscles stay: see scale_masses and scale_lengths.
  void scale_geometry(const Factors& factors);
  /// Scales inertias by the factors (exactly for equal factors, else as of a cylinder) and masses
  /// unless they are kept; then brings all masses to a total of `total_kg`, if above 0.
  void scale_masses(const Factors& factors, bool keep_masses, double total_kg);
  /// Multiplies the lengths of a muscle, ligament or spring (optimal fiber, tendon slack, rest).
  void scale_lengths(const std::string& force, double factor);

  /// Parts with a size that are not scaled, a sentence each.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  [[nodiscard]] bool is_old() const;
  /// Returns the frame that an element of the document names: by a socket, or in old documents as a body.
  [[nodiscard]] FixedFrame frame_named(pugi::xml_node node, const char* socket, const std::string& owner) const;
  [[nodiscard]] Vec3 factor_of(const Factors& factors, BodyIndex body) const;
  void scale_wraps(pugi::xml_node holder, const FixedFrame& frame, const Vec3& factor);
  void scale_joint(pugi::xml_node joint, const Vec3& parent, const Vec3& child);
  void scale_points(pugi::xml_node force, const Factors& factors);
  [[nodiscard]] pugi::xml_node marker_set() const;
  [[nodiscard]] pugi::xml_node marker(const std::string& name) const;

  std::filesystem::path path_;
  OsimXml xml_;
  OsimXml newest_;           ///< The newest form of an old document, from which frames and inertias come.
  pugi::xml_node model_;     ///< <Model>
  pugi::xml_node skeleton_;  ///< The parent of the bodies: the model or, in old documents, its engine.
  OsimReading reading_;
  std::vector<std::string> notes_;
};

}  // namespace myoid::body
