#include "myoid/opensim/setup_list.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::opensim {
namespace {

namespace fs = std::filesystem;

/// Returns true if a text has an element whose name ends in "Tool", or an IMUPlacer. Tools that are not run (CMCTool)
/// count: the caller hears of them.
bool holds_tool(std::string_view text) {
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at + 1)) {
    const std::string_view name = text.substr(at + 1, text.find_first_of(" \t\r\n/>", at + 1) - at - 1);
    if (name.ends_with("Tool") && !name.starts_with('/')) return true;
    if (name == "IMUPlacer") return true;
  }
  return false;
}

/// A file that cannot be read counts, so that the caller hears of it.
bool may_be_setup(const fs::path& file) {
  try {
    return holds_tool(read_text_file(file));
  } catch (const InvalidInput&) {
    return true;
  }
}

/// Names that differ: a stem that several given files have gets the name of the file's folder in front.
void tell_apart(std::vector<NamedSetup>& setups) {
  std::map<fs::path, int> count;
  for (const NamedSetup& setup : setups) ++count[setup.name];
  for (NamedSetup& setup : setups)
    if (count[setup.name] > 1) setup.name = fs::absolute(setup.file).parent_path().filename() / setup.file.stem();
  std::set<fs::path> names;
  for (const NamedSetup& setup : setups)
    if (!names.insert(setup.name).second)
      throw InvalidInput("two set-ups have the name {}; rename one, or run them one by one", setup.name.string());
}

std::vector<NamedSetup> setups_below(const fs::path& folder) {
  std::vector<NamedSetup> found;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.path().extension() != ".xml") continue;
    if (!may_be_setup(entry.path())) continue;
    found.push_back({entry.path(), entry.path().lexically_relative(folder).replace_extension()});
  }
  if (found.empty())
    throw InvalidInput("{}: no .xml of this folder and its folders is a set-up of one of OpenSim's tools",
                       folder.string());
  std::ranges::sort(found, {}, &NamedSetup::name);
  return found;
}

}  // namespace

std::vector<NamedSetup> list_setups(const std::vector<fs::path>& given) {
  std::vector<NamedSetup> all;
  for (const fs::path& each : given) {
    if (!fs::is_directory(each)) {
      all.push_back({each, each.stem()});
      continue;
    }
    for (NamedSetup& setup : setups_below(each)) all.push_back(std::move(setup));
  }
  tell_apart(all);
  return all;
}

int place_in_study(const OpensimSetup& setup) {
  const std::string kind = setup.kind();
  if (kind == "ScaleTool" || kind == "IMUPlacer") return 0;
  if (kind == "InverseKinematicsTool" || kind == "IMUInverseKinematicsTool") return 1;
  const auto forces = setup.tool().select_nodes(".//forces_file");
  const bool reads_forces = std::ranges::any_of(forces, [](const pugi::xpath_node& found) {
    const std::string_view text = found.node().text().get();
    return text.find_first_not_of(" \t\r\n") != std::string_view::npos && text != "Unassigned";
  });
  return reads_forces ? 3 : 2;
}

}  // namespace myoid::opensim
