#include "myoid/program/commands/design.h"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/program/steps/check_options.h"
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

void visit(DesignOptions& o, study::SettingVisitor& v) {
  run::DesignStudyOptions& design = o.design;
  v.path("study", o.study,
         {.says = "study.toml: model, muscles and electrodes as they are (or --model arm4).",
          .option = {.by_place = true}});
  v.text("model", o.model, {.says = "The built-in arm: arm4."});
  v.flag("wire", o.wire, {.says = "With arm4: the brachialis has a wire electrode of its own."});
  v.texts("targets", design.targets, {.says = "all, parameters, muscles or MUSCLE.PARAMETER."});
  v.folder("after", o.after, {.says = "Folder of a finished run: its result is known beforehand."});
  v.choice("criterion", design.choice.criterion,
           {.says = "D: volume of the confidence ellipsoid, A: sum of relative variances."});
  v.count("movements", design.choice.movements, {.says = "How many to choose.", .limits = study::within(1, 50)});
  v.count("repeat", design.choice.most_of_each,
          {.says = "The same movement at most so often.", .limits = study::within(1, 50)});
  v.number("budget", design.choice.budget_s, {.says = "Recording time at most.", .limits = study::above_zero("s")});
  v.number("fatigue", design.fatigued_share,
           {.says = "Share of a muscle that may be fatigued at any time.", .limits = study::within(0.001, 1.0)});
  v.numbers("masses", design.catalogue.held_masses_kg,
            {.says = "Held masses there are.", .limits = study::zero_or_more("kg")});
  v.unset("no-dynamometer", o.dynamometer,
          {.says = "No isokinetic movement (isometric torque can be measured still)."});
  v.count("persons", design.persons,
          {.says = "Persons drawn from the priors, to average over.", .limits = study::within(1, 1000)});
  v.number("torque-noise", design.torque_sd_nm,
           {.says = "Standard deviation of the joint torque's error below 2 Hz.", .limits = study::above_zero("N m")});
  v.number("emg-noise", design.emg_cv,
           {.says = "Relative noise of the EMG envelope below 2 Hz.", .limits = study::within(0.0, 1.0)});
}

DesignResult design(const DesignOptions& o) {
  check_options(o);
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
  if (!found.range.empty()) remarks.note(found.range);
  remarks.note(fmt::format(
      "{} movements in the catalogue, {} beyond the strength of too many, {} too tiring; {} persons; {} exchanges",
      found.catalogue_size, found.too_hard, found.too_tiring, choice.persons, found.exchanges));
  result.remarks = remarks.list();
  return result;
}

}  // namespace myoid::program
