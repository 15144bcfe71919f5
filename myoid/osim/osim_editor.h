#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/core/geometry.h"
#include "myoid/osim/osim_frames.h"
#include "myoid/osim/osim_xml.h"

namespace myoid::model {

/// A model file that is being changed as OpenSim's Scale tool changes it. The document keeps its
/// version; what is not changed stays, comments do not.
class OsimEditor {
 public:
  /// Factors along the axes of a body, by its name; a body that is not named keeps its size.
  using Factors = std::map<std::string, Vec3>;

  /// Throws as read_osim.
  OsimEditor(std::string text, std::filesystem::path path);
  OsimEditor(const OsimEditor&) = delete;
  OsimEditor& operator=(const OsimEditor&) = delete;

  [[nodiscard]] std::string text() const;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  void set_name(const std::string& name);

  /// Takes the markers of a file with a <MarkerSet>: those of known names replace the model's.
  void add_markers(const std::filesystem::path& file);
  void remove_markers(const std::function<bool(const std::string&)>& is_removed);
  /// True if marker placement leaves the marker where it is.
  [[nodiscard]] bool is_fixed(const std::string& marker) const;
  /// A new place in the frame of the marker's body.
  void move_marker(const std::string& marker, const Vec3& p_B);
  /// The model's markers as a document of their own.
  [[nodiscard]] std::string marker_set_text() const;

  /// Scales what lies on the bodies: mass centers, frames, points of paths, wrap objects, markers,
  /// meshes, and the translations of joints by the factors of the parent. Masses and the lengths of
  /// muscles are left: see below.
  void scale_geometry(const Factors& factors);
  /// Inertias follow the factors (exactly where the three are equal, else as of a cylinder), the
  /// masses too unless they are kept; then all are brought to a total of `total_kg`, if above 0.
  void scale_masses(const Factors& factors, bool keep_masses, double total_kg);
  /// Multiplies the lengths of a muscle, ligament or spring (optimal fiber, tendon slack, rest).
  void scale_lengths(const std::string& force, double factor);

  /// What was left as it is although it has a size, a sentence each.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  [[nodiscard]] Vec3 factor_of(const Factors& factors, BodyIndex body) const;
  void scale_wraps(pugi::xml_node holder, const FixedFrame& frame, const Vec3& factor);
  void scale_joint(pugi::xml_node joint, const Vec3& parent, const Vec3& child);
  void scale_points(pugi::xml_node force, const Factors& factors);
  [[nodiscard]] pugi::xml_node marker_set() const;
  [[nodiscard]] pugi::xml_node marker(const std::string& name) const;

  std::string text_;
  std::filesystem::path path_;
  OsimXml xml_;
  pugi::xml_node model_;     ///< <Model>
  pugi::xml_node skeleton_;  ///< What holds the bodies: the model or, in old documents, its engine.
  std::unique_ptr<OsimReading> reading_;
  std::vector<std::string> notes_;
};

}  // namespace myoid::model
