#include "myoid/program/commands/design.h"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/study/read_study.h"
#include "myoid/study/run_identity.h"

namespace myoid::program {
namespace {

/// Returns the elbow of the source paper: surface electrodes on three muscles; the brachialis acts as the biceps does.
study::Study arm4_study(bool wire) {
  study::Study study;
  study.model.builtin = "arm4";
  for (const char* name : {"BIC", "BRA", "BRD", "TRI"}) {
    study::MuscleSpec muscle;
    muscle.name = name;
    muscle.osim = {name};
    muscle.emg = muscle.name == "BRA" && !wire ? "BIC" : name;
    study.muscles.push_back(std::move(muscle));
  }
  return study;
}

study::Study study_of(const DesignOptions& o) {
  if (o.study.empty() == o.model.empty()) throw InvalidInput("design: give either a study.toml or --model arm4");
  if (!o.model.empty() && o.model != "arm4")
    throw InvalidInput(
        fmt::format("--model {}: only arm4 is built in; for another model write a study.toml that names it", o.model));
  return o.study.empty() ? arm4_study(o.wire) : study::read_study(o.study);
}

run::EarlierRun read_earlier(const DesignOptions& o, const study::Study& study, Remarks& remarks) {
  run::EarlierRun earlier = run::read_earlier_run(o.after);
  remarks.warn_of_changes(o.after, {"parameters.json"});
  const study::IdentityDifferences unlike =
      study::differences(study::identity_of(study), study::read_run_identity(o.after));
  if (!unlike.grave.empty())
    throw InvalidInput(
        fmt::format("--after {}: {}; its numbers mean something else; give the result of a run of this study", o.after,
                    fmt::join(unlike.grave, "; ")));
  for (const std::string& text : unlike.other) remarks.warn(fmt::format("--after {}: {}", o.after, text));
  return earlier;
}

}  // namespace

DesignResult design(const DesignOptions& o) {
  Remarks remarks(o.call);
  study::Study study = study_of(o);
  run::DesignStudyOptions choice = o.design;
  choice.catalogue.dynamometer = o.dynamometer;
  choice.seed = o.call.seed;
  choice.progress = o.call.progress;
  if (!o.after.empty()) choice.earlier = read_earlier(o, study, remarks);
  DesignResult result;
  result.design = run::design_study(study, choice);
  const run::DesignStudyResult& found = result.design;
  if (found.too_hard == found.catalogue_size)
    throw InvalidInput("design: no movement of the catalogue is within the muscles' strength");
  remarks.note(fmt::format(
      "{} movements in the catalogue, {} beyond the strength of too many, {} too tiring; {} persons; {} exchanges",
      found.catalogue_size, found.too_hard, found.too_tiring, choice.persons, found.exchanges));
  result.remarks = remarks.list();
  return result;
}

}  // namespace myoid::program
