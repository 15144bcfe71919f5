// Projects of other programs: a folder with the parts of the input as its files, of each dialect. A value as `info`
// prints it, or a ReadError; what is written again reads alike.
#include "myoid/ground/core/json_text.h"
#include "myoid/opensim/projects/osimx_file.h"
#include "myoid/opensim/projects/read_project.h"
#include "myoid/opensim/projects/subject_writer.h"
#include "myoid/program/contents/contents_text.h"
#include "myoid/program/contents/project_contents.h"

#include "fuzz.h"

namespace {

/// Writes the muscles again; names with blanks and numbers that are no lengths are refused.
void write_again(const myoid::opensim::Project& project) {
  namespace fuzz = myoid::fuzz;
  using myoid::opensim::Dialect;
  if (project.dialect == Dialect::mrs || project.muscles.empty()) return;
  const bool is_nmsm = project.dialect == Dialect::nmsm;
  const std::string name = is_nmsm ? "again.osimx" : "again.xml";
  fuzz::write(name, is_nmsm ? osimx_text(project) : ceinms_subject_text(project));
  const auto again = myoid::opensim::read_project(fuzz::folder() / name);
  std::filesystem::remove(fuzz::folder() / name);
  fuzz::require(again && again->muscles.size() == project.muscles.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace fuzz = myoid::fuzz;
  const auto project = fuzz::folder() / "project";
  std::filesystem::create_directories(project / "walk");
  fuzz::write_parts(
      fuzz::text(data, size),
      {"project/setup.xml", "project/subject.xml", "project/calibration.xml", "project/trial.xml", "project/emg.sto",
       "project/walk/id.sto", "project/main.m", "project/m.osim", "project/muscles.csv", "project/a.osimx"});
  try {
    const auto contents = myoid::program::project_contents(project);
    if (!contents) return 0;
    fuzz::require(!myoid::program::contents_text(*contents).empty());
    fuzz::require(!myoid::json_text(*contents).empty());
    if (const auto read = myoid::opensim::read_project(project)) write_again(*read);
  } catch (const myoid::ReadError&) {
  } catch (const myoid::InvalidInput&) {
  }
  return 0;
}
