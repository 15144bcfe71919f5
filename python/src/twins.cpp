#include <string>
#include <utility>
#include <vector>

#include "myoid/program/commands/twin.h"
#include "myoid/program/commands/twin_study.h"

#include "bindings.h"
#include "result_out.h"
#include "to_python.h"
#include "work.h"

namespace myoid::python {
namespace {

namespace fs = std::filesystem;

py::dict twin(py::dict given) {
  Work work("twin", std::move(given));
  const auto o = work.options<program::TwinOptions>();
  const program::TwinPersonsResult result = work.run([&] {
    ResultOut folder(o.out, o.call);
    program::TwinPersonsResult made;
    if (o.persons) {
      made = program::write_twin_persons(o, o.out);
    } else {
      program::write_twin(program::twin(o), o.out);
      made.table = fs::path(o.out) / "truth.csv";
      made.studies = {fs::path(o.out) / "study.toml"};
    }
    folder.finish();
    return made;
  });
  std::vector<std::string> studies;
  for (const fs::path& study : result.studies) studies.push_back(study.string());
  py::dict d;
  d["table"] = result.table.string();
  d["studies"] = studies;
  return d;
}

py::dict twin_study(py::dict given) {
  Work work("twin_study", std::move(given));
  const auto o = work.options<program::TwinStudyOptions>();
  const program::TwinStudyResult result = work.run([&] {
    ResultOut folder(o.out, o.call);
    program::TwinStudyResult r = program::twin_study(o);
    program::write_twin_study(r, o.out);
    if (!r.study.interrupted) folder.finish();
    return r;
  });
  py::list failures;
  for (const lab::TwinFailure& failure : result.study.failures)
    failures.append(py::make_tuple(failure.seed, failure.message));
  py::dict d;
  d["level"] = result.study.level;
  d["finished"] = result.study.finished;
  d["failures"] = failures;
  d["remarks"] = to_python(result.remarks);
  return d;
}

}  // namespace

void bind_twins(py::module_& module) {
  module.def("twin", &twin);
  module.def("twin_study", &twin_study);
}

}  // namespace myoid::python
