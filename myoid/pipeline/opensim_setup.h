#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/model/body_model.h"
#include "myoid/model/osim_xml.h"

namespace myoid::pipeline {

/// A set-up file of one of OpenSim's tools. Names of files in it are relative to its own folder.
class OpensimSetup {
 public:
  /// Throws ReadError (with line and remedy) if the file is missing, cut off, no XML, or holds no
  /// tool that is known.
  explicit OpensimSetup(const std::filesystem::path& path);
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

  /// The file that an element names; empty where it is absent, empty or "Unassigned".
  [[nodiscard]] std::optional<std::filesystem::path> file(pugi::xml_node object,
                                                          const char* name) const;
  /// The same; throws ReadError if there is none.
  [[nodiscard]] std::filesystem::path required_file(pugi::xml_node object, const char* name) const;
  /// The files that the set-up reads, as far as it names them.
  [[nodiscard]] std::vector<std::filesystem::path> inputs() const;
  /// Folder of the results; the set-up's own if none is given.
  [[nodiscard]] std::filesystem::path results_folder() const;
  /// Two numbers; (-inf, inf) where absent. Throws ReadError unless they increase.
  [[nodiscard]] std::pair<double, double> time_range(pugi::xml_node object, const char* name) const;
  /// Throws ReadError where the times asked for have nothing in common with those recorded in
  /// `file`; adds a note where they reach more than a sample beyond.
  void check_range(std::pair<double, double> asked_s,
                   const Eigen::VectorXd& recorded_s,
                   const std::filesystem::path& file,
                   std::vector<std::string>& notes) const;

 private:
  std::filesystem::path path_;
  std::string text_;
  model::OsimXml xml_;
  pugi::xml_node tool_;
};

/// The model that a set-up names, with the actuators of its <force_set_files>; without the forces
/// named in `excluded` ("all", "muscles", "actuators", or names; case does not matter). What the
/// model has that is not supported is added to `notes`.
[[nodiscard]] model::BodyModel setup_model(const OpensimSetup& setup,
                                           const model::Compat& compat,
                                           const std::vector<std::string>& excluded,
                                           std::vector<std::string>& notes);

}  // namespace myoid::pipeline
