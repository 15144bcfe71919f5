#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "myoid/model/body_model.h"
#include "myoid/opensim_tools/setup_files.h"
#include "myoid/osim/osim_xml.h"

namespace myoid {

/// A set-up file of one of OpenSim's tools. Names of files in it are relative to its own folder;
/// names from another computer are looked for beside it and one folder up (find_named_file).
class OpensimSetup {
 public:
  /// Throws ReadError (with line and remedy) if the file is missing, cut off, no XML, or holds no
  /// tool that is known; InvalidInput if the tool reads no file of a kind that `instead` gives.
  explicit OpensimSetup(const std::filesystem::path& path, SetupFiles instead = {});
  OpensimSetup(const OpensimSetup&) = delete;
  OpensimSetup& operator=(const OpensimSetup&) = delete;

  [[nodiscard]] const model::OsimXml& xml() const { return xml_; }
  [[nodiscard]] pugi::xml_node tool() const { return tool_; }
  /// "InverseKinematicsTool" (also for an IKTool of version 1), "AnalyzeTool", ...
  [[nodiscard]] std::string kind() const {
    const std::string name = tool_.name();
    return name == "IKTool" ? "InverseKinematicsTool" : name;
  }
  [[nodiscard]] std::string name() const { return model::OsimXml::name_of(tool_); }

  /// True if an element names a file.
  [[nodiscard]] bool names_file(pugi::xml_node object, const char* name) const;
  /// The file that an element names, to be read; empty where it is absent, empty or "Unassigned".
  /// Throws ReadError, naming the element, if there is no such file.
  [[nodiscard]] std::optional<std::filesystem::path> file(pugi::xml_node object,
                                                          const char* name) const;
  /// The same; throws ReadError if the element names none.
  [[nodiscard]] std::filesystem::path required_file(pugi::xml_node object, const char* name) const;
  /// The file of that name, read on behalf of `node`. Throws ReadError if there is none.
  [[nodiscard]] std::filesystem::path file_named(pugi::xml_node node, std::string_view name) const;
  /// Files that a list in an element names.
  [[nodiscard]] std::vector<std::filesystem::path> files(pugi::xml_node object,
                                                         const char* name) const;
  /// The file that an element names, to be written; empty as for `file`.
  [[nodiscard]] std::optional<std::filesystem::path> output_file(pugi::xml_node object,
                                                                 const char* name) const;
  /// The files that the set-up reads, as far as it names them and they exist.
  [[nodiscard]] std::vector<std::filesystem::path> inputs() const;
  /// Folder of the results; the set-up's own if none is given, or one of another computer.
  [[nodiscard]] std::filesystem::path results_folder() const;
  /// A sentence for each file that is read or written elsewhere than the set-up says.
  [[nodiscard]] std::vector<std::string> notes() const;
  /// Two numbers; (-inf, inf) where absent. Throws ReadError unless they increase.
  [[nodiscard]] std::pair<double, double> time_range(pugi::xml_node object, const char* name) const;
  /// Throws ReadError where the times asked for have nothing in common with those recorded in
  /// `file`; adds a note where they reach more than a sample beyond.
  void check_range(std::pair<double, double> asked_s,
                   const Eigen::VectorXd& recorded_s,
                   const std::filesystem::path& file,
                   std::vector<std::string>& notes) const;

 private:
  /// What stands in for the file of an element; empty where nothing does.
  [[nodiscard]] std::filesystem::path replacement(std::string_view name) const;
  /// The text of an element that names a file; empty for "Unassigned".
  [[nodiscard]] std::string named_in(pugi::xml_node object, const char* name) const;
  /// Elements that name a file to be read, in the tool or, when scaling, in one of its stages.
  [[nodiscard]] std::vector<std::pair<pugi::xml_node, const char*>> input_elements() const;

  std::filesystem::path path_;
  std::string text_;
  model::OsimXml xml_;
  pugi::xml_node tool_;
  SetupFiles instead_;
};

/// The model that a set-up names, with the actuators of its <force_set_files>; without the forces
/// named in `excluded` ("all", "muscles", "actuators", or names; case does not matter). What the
/// model has that is not supported is added to `notes`.
[[nodiscard]] model::BodyModel setup_model(const OpensimSetup& setup,
                                           const model::Compat& compat,
                                           const std::vector<std::string>& excluded,
                                           std::vector<std::string>& notes);

}  // namespace myoid
