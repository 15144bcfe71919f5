#include <string>
#include <utility>
#include <vector>

#include "myoid/ground/core/choice.h"
#include "myoid/ground/core/error.h"
#include "myoid/program/commands/twin.h"
#include "myoid/program/commands/twin_study.h"

#include "bindings.h"
#include "keywords.h"
#include "result_out.h"
#include "to_python.h"
#include "work.h"

namespace myoid::python {
namespace {

namespace fs = std::filesystem;

py::dict twin(py::dict given) {
  Keywords k("twin", std::move(given));
  Work work(k);
  program::TwinPersonsOptions o;
  std::string out;
  bool overwrite = false;
  k.take("protocol", o.twin.protocol);
  k.take("model", o.twin.model);
  k.take("level", o.twin.level);
  k.take("truth", o.twin.truth);
  const bool many = k.object("subjects").has_value();
  k.count("subjects", o.persons, 1, 1000000);
  k.take("format", o.twin.format);
  k.take("truth_only", o.truth_only);
  k.take("out", out);
  k.take("overwrite", overwrite);
  k.refuse_others();
  if (o.truth_only && !many) throw InvalidInput("truth_only needs subjects: one person's truth is in truth.csv");
  o.twin.call = work.call();
  const program::TwinPersonsResult result = work.run([&] {
    ResultOut folder(out, o.twin.call, overwrite);
    program::TwinPersonsResult made;
    if (many) {
      made = program::write_twin_persons(o, out);
    } else {
      program::write_twin(program::twin(o.twin), out);
      made.table = fs::path(out) / "truth.csv";
      made.studies = {fs::path(out) / "study.toml"};
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

/// The values of an enumeration that the argument names.
template <typename Enumeration>
void take_choices(Keywords& k, const char* name, std::vector<Enumeration>& values) {
  std::vector<std::string> names;
  k.take(name, names);
  if (names.empty()) return;
  values.clear();
  for (const std::string& each : names) {
    const auto value = choice_named<Enumeration>(each);
    if (!value) throw InvalidInput(std::string(name) + ": there is no '" + each + "'");
    values.push_back(*value);
  }
}

py::dict twin_study(py::dict given) {
  Keywords k("twin_study", std::move(given));
  Work work(k);
  program::TwinStudyOptions o;
  std::string out;
  bool overwrite = false;
  k.take("protocol", o.protocol);
  k.take("level", o.level);
  k.take("offset", o.offset);
  if (o.offset && !(*o.offset >= -3.0 && *o.offset <= 3.0))
    throw InvalidInput("offset: expected -3 to 3 standard deviations");
  k.take("truth", o.truth);
  k.count("subjects", o.study.subjects, 1, 1000000);
  take_choices(k, "method", o.study.methods);
  k.take("out", out);
  k.take("overwrite", overwrite);
  k.refuse_others();
  o.call = work.call();
  const program::TwinStudyResult result = work.run([&] {
    ResultOut folder(out, o.call, overwrite);
    program::TwinStudyResult r = program::twin_study(o);
    program::write_twin_study(r, out);
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
