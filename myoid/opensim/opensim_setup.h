#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/body/osim/osim_xml.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/files/named_file.h"

namespace myoid::opensim {

/// Files that replace the files named in a set-up; an empty path leaves the set-up's own.
struct SetupFiles {
  std::filesystem::path model;
  /// The recorded motion: coordinates or states, for inverse kinematics and scaling the markers.
  std::filesystem::path motion;
  std::filesystem::path external_loads;
  std::filesystem::path out;  ///< Folder of all results.
};

/// A set-up file of one of OpenSim's tools. Its names of files are relative to its folder; files
/// named on another computer are searched for in that folder and one folder up (find_named_file).
class OpensimSetup {
 public:
  /// Throws ReadError (with line and remedy) if the file is missing, cut off, no XML, or holds no
  /// tool that is known; InvalidInput if the tool reads no file of a kind that `instead` gives.
  explicit OpensimSetup(const std::filesystem::path& path, SetupFiles instead = {});
  OpensimSetup(const OpensimSetup&) = delete;
  OpensimSetup& operator=(const OpensimSetup&) = delete;

  [[nodiscard]] const body::OsimXml& xml() const { return xml_; }
  [[nodiscard]] pugi::xml_node tool() const { return tool_; }
  /// Returns "InverseKinematicsTool" (also for an IKTool of version 1), "AnalyzeTool", ...
  [[nodiscard]] std::string kind() const {
    const std::string name = tool_.name();
    return name == "IKTool" ? "InverseKinematicsTool" : name;
  }
  [[nodiscard]] std::string name() const { return body::OsimXml::name_of(tool_); }

  /// Returns true if an element names a file.
  [[nodiscard]] bool names_file(pugi::xml_node object, const char* name) const;
  /// Returns the input file that an element names; empty for an element that is absent, empty or
  /// "Unassigned". Throws ReadError, naming the element, if there is no such file.
  [[nodiscard]] std::optional<std::filesystem::path> file(pugi::xml_node object, const char* name) const;
  /// Returns the input file as `file` does; throws ReadError if the element names none.
  [[nodiscard]] std::filesystem::path required_file(pugi::xml_node object, const char* name) const;
  /// Returns the file of that name, read on behalf of `node`. Throws ReadError if there is none.
  [[nodiscard]] std::filesystem::path file_named(pugi::xml_node node, std::string_view name) const;
  /// Files that a list in an element names.
  [[nodiscard]] std::vector<std::filesystem::path> files(pugi::xml_node object, const char* name) const;
  /// Returns the output file that an element names; empty as for `file`.
  [[nodiscard]] std::optional<std::filesystem::path> output_file(pugi::xml_node object, const char* name) const;
  /// Returns the existing files that the set-up names as inputs.
  [[nodiscard]] std::vector<std::filesystem::path> inputs() const;
  /// Returns the files that the set-up names as inputs and that do not exist.
  [[nodiscard]] std::vector<std::filesystem::path> missing_inputs() const;
  /// Returns true for a file in the folder of the set-up or in the folder that replaces the set-up's for results.
  [[nodiscard]] bool is_near(const std::filesystem::path& output) const;
  /// Returns the folder of the results; the set-up's own if no folder, or one of another computer, is given.
  [[nodiscard]] std::filesystem::path results_folder() const;
  /// Returns a sentence for each file whose place differs from the name in the set-up.
  [[nodiscard]] std::vector<std::string> notes() const;
  /// Returns two numbers; (-inf, inf) if they are absent. Throws ReadError unless they increase.
  [[nodiscard]] std::pair<double, double> time_range(pugi::xml_node object, const char* name) const;
  /// Throws ReadError if the times asked for and the times recorded in `file` are disjoint; adds a
  /// note if the former reach more than a sample beyond the latter.
  void check_range(std::pair<double, double> asked_s,
                   const Eigen::VectorXd& recorded_s,
                   const std::filesystem::path& file,
                   std::vector<Remark>& remarks) const;

 private:
  /// Returns the option that replaces the file of an element ("--model"); empty if none does.
  [[nodiscard]] std::string_view option_for(std::string_view name) const;
  /// Returns the file that replaces the file of an element; empty without a replacement.
  [[nodiscard]] std::filesystem::path replacement(std::string_view name) const;
  /// Returns the text of an element that names a file; empty for "Unassigned".
  [[nodiscard]] std::string named_in(pugi::xml_node object, const char* name) const;
  /// Returns the elements that name a file to be read, in the tool or, when scaling, in one of its stages, with the
  /// file.
  [[nodiscard]] std::vector<std::pair<const char*, NamedFile>> named_inputs() const;

  std::filesystem::path path_;
  body::OsimXml xml_;
  pugi::xml_node tool_;
  SetupFiles instead_;
};

/// Returns the model that a set-up names, with the actuators of its <force_set_files>; without the
/// forces named in `excluded` ("all", "muscles", "actuators", or names; case does not matter).
/// Unsupported parts of the model are added to `remarks`.
[[nodiscard]] body::BodyModel setup_model(const OpensimSetup& setup,
                                          const body::Compat& compat,
                                          const std::vector<std::string>& excluded,
                                          std::vector<Remark>& remarks);

}  // namespace myoid::opensim
