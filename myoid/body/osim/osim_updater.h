#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/body/osim/osim_xml.h"
#include "myoid/ground/core/remark.h"

namespace myoid::body {

/// The document version that an updated document has: OpenSim 4.5's.
inline constexpr int kNewestOsimVersion = 40500;
/// Documents before this version have joints inside bodies, and names of bodies in place of sockets.
inline constexpr int kFirstOsimWithSockets = 30500;

struct OsimUpdateOptions {
  /// Rounds offsets of joints and inertias of documents before 30500 to six digits, as OpenSim's
  /// conversion does; otherwise they keep their digits.
  bool six_digits = false;
  bool looks = true;  ///< Also brings meshes of bodies to their present form.
};

/// Brings a document in memory to the newest form, in place, and takes the model's prototypes; elements keep their
/// lines. The readers of a model's parts know this form alone. Returns a sentence for each body that gets a joint.
/// Throws ReadError if a joint does not name its parent.
[[nodiscard]] std::vector<std::string> bring_to_newest_form(OsimXml& xml, const OsimUpdateOptions& options = {});

struct UpdatedOsim {
  std::string text;
  int old_version = 0;        ///< 0: the document had none.
  std::vector<Remark> notes;  ///< Parts of the old file without a place in the new form.
};

/// Writes an OpenSim document of any version (a model, a set-up, a set of forces, markers or tasks) in the newest form:
/// joints out of the bodies into a JointSet, with frames and sockets; `Ground`; sockets in place of names of bodies and
/// of older sockets; the classes' and elements' present names; values of <defaults> in the objects that take them;
/// meshes of bodies. Elements that stand in files of their own come into the document. The reader gives the same model
/// for both texts. A document of the newest version keeps its elements. Throws ReadError if the text is no XML or a
/// joint does not name its parent.
[[nodiscard]] UpdatedOsim updated_osim(std::string_view text,
                                       const std::filesystem::path& path,
                                       const OsimUpdateOptions& options = {});

}  // namespace myoid::body
