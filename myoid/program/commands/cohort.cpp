#include "myoid/program/commands/cohort.h"

#include <algorithm>
#include <mutex>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "myoid/ground/core/build_identity.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/in_jobs.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/folder_lock.h"
#include "myoid/ground/files/output_file.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/ground/files/result_folder.h"
#include "myoid/program/commands/run.h"
#include "myoid/program/steps/check_options.h"
#include "myoid/results/cohort/person_study.h"
#include "myoid/run/stage_store.h"

namespace myoid::program {
namespace {

namespace fs = std::filesystem;
using results::Outcome;
using results::OutcomeKind;
using results::Person;

/// The command that signs the folder of a cohort and the persons' folders.
constexpr const char* kCohortWord = "cohort";
/// Names of the group's results, which a folder of other content must not have.
const std::vector<std::string_view> kGroupFiles{"persons.csv", "cohort.csv", "report."};

/// Memory that a person under way needs at most, with markers and EMG of some minutes.
constexpr std::size_t kPersonMemory_mb = 500;
/// Limit on the persons under way, if none follows from the memory.
constexpr std::size_t kMostJobs = 1024;

/// Returns the trials in use by the entities of their files' names.
results::BidsFilter filter_of(const CohortOptions& o) {
  results::BidsFilter filter;
  for (const auto& [entity, values] : {std::pair{"ses", &o.sessions}, std::pair{"task", &o.tasks}}) {
    const std::string begin = std::string(entity) + "-";
    for (const std::string& value : *values)
      filter[entity].push_back(value.starts_with(begin) ? value.substr(begin.size()) : value);
  }
  for (const std::string& pair : o.entities) {
    const std::size_t equals = pair.find('=');
    if (equals == 0 || equals == std::string::npos)
      throw InvalidInput(fmt::format("--entity: {}: expected NAME=VALUE, as run=1", pair));
    filter[pair.substr(0, equals)].push_back(pair.substr(equals + 1));
  }
  if (!o.filter_file.empty()) results::add_bids_filter(o.filter_file, filter);
  return filter;
}

void judge(const RunResult& result, Outcome& outcome) {
  std::vector<std::string> gates, trials;
  for (const page::Gate& gate : result.gates)
    if (gate.status == page::GateStatus::fail) gates.push_back(gate.name);
  for (const run::TrialResult& trial : result.study.trials)
    if (!trial.failure().empty()) trials.push_back(trial.spec.name);
  if (!trials.empty()) {
    outcome.kind = OutcomeKind::trials_failed;
    outcome.message = fmt::format("trials that failed: {}", fmt::join(trials, ", "));
  } else if (result.failed(false)) {
    outcome.kind = OutcomeKind::gate_failed;
    outcome.message = gates.empty() ? "the method torque did not converge"
                                    : fmt::format("quality gates that failed: {}", fmt::join(gates, ", "));
  }
}

/// Computes a person anew and writes the results.
Outcome computed(const CohortOptions& o, const fs::path& study, const fs::path& folder) {
  RunOptions options;
  options.call = {.seed = o.call.seed,
                  .start_s = o.call.start_s,
                  .end_s = o.call.end_s,
                  .command = fmt::format("myoid run {}", study.string()),
                  .progress = {.report = {}, .stop = o.call.progress.stop},
                  .listener = {}};
  options.study = study.string();
  const fs::path store = o.work.empty() ? folder / kStageFolder : o.work / folder.filename() / kStageFolder;
  options.store = store;
  RunResult result = run(options);
  result.study.times.clear();  // the same bytes however long the job takes, and on every day
  result.study.analysed.clear();
  write_run(result, folder, o.kept);
  if (o.kept != page::Kept::all) {  // only an interrupted job goes on from it
    run::StageStore(store).remove_unused();
    rmdir(store.c_str());  // leaves a link, and a folder with other files
  }
  Outcome outcome{
      .kind = OutcomeKind::done, .message = {}, .build = {}, .kept = o.kept, .inputs = result.provenance.inputs};
  judge(result, outcome);
  return outcome;
}

Outcome failure(const std::string& message) { return {.kind = OutcomeKind::failed, .message = message}; }

/// Computes a person unless the results are current; records a failure.
results::PersonOutcome job_in(const CohortOptions& o, const Person& person, const fs::path& folder) {
  Outcome outcome;
  try {
    const fs::path study = results::person_study(person, folder, filter_of(o));
    const auto earlier = results::recorded_outcome(folder);
    if (earlier && earlier->kept == o.kept && results::is_current(*earlier, study))
      return {.person = person.name, .outcome = earlier, .reused = true};
    results::remove_outcome(folder);
    remove_earlier_results(folder);
    outcome = computed(o, study, folder);
  } catch (const Interrupted&) {
    throw;
  } catch (const InvalidInput& error) {
    remove_results(folder, {"study.toml"});
    outcome = failure(error.what());
  } catch (const std::exception& error) {
    remove_results(folder, {"study.toml"});
    outcome = failure(fmt::format("internal error: {}", error.what()));
  }
  outcome.build = build_identity();
  results::write_outcome(outcome, folder);
  return {.person = person.name, .outcome = std::move(outcome)};
}

/// A person's outcome, and sentences on files of the person's folder that were kept.
struct PersonJob {
  results::PersonOutcome outcome;
  std::vector<std::string> notes{};
};

/// Runs one person's job in a folder that no other process may hold.
PersonJob job(const CohortOptions& o, const Person& person, const fs::path& out) {
  const fs::path place = results::person_folder(out, person);
  try {
    ResultFolder folder(place, o.call.command, kCohortWord, o.call.overwrite);
    PersonJob done{job_in(o, person, place)};
    folder.finish();
    done.notes = folder.take_notes();
    return done;
  } catch (const InvalidInput& error) {  // the folder is held, or the disk is full
    return {{.person = person.name, .outcome = failure(error.what())}};
  } catch (const fs::filesystem_error& error) {
    return {{.person = person.name, .outcome = failure(error.what())}};
  }
}

}  // namespace

void visit(CohortOptions& o, study::SettingVisitor& v) {
  constexpr std::string_view kBids = "BIDS App";
  v.path("manifest", o.manifest,
         {.says = "Table with the columns name and study, a row a person; or the folder of a BIDS data set.",
          .required = "a file",
          .option = {.by_place = true}});
  v.folder("out", o.out, {.says = "Folder of the results.", .required = "a folder", .option = {.also = "output_dir"}});
  v.path("study", o.study, {.says = "BIDS: the study of every person.", .otherwise = "code/study.toml"});
  v.texts("person", o.persons,
          {.says = "Only these persons, by name, id or label without sub-, and without the group; several.",
           .option = {.also = "--participant-label,--participant_label"}});
  v.flag("group", o.group,
         {.says = "Only the group: the tables and page of all persons.", .option = {.excludes = "person"}});
  v.choice("workflow", o.workflow,
           {.says = "Writes the files for an engine and computes nothing.", .option = {.excludes = "person,group"}});
  v.choice("analysis_level", o.level,
           {.says = "As a BIDS App takes it: participant computes the persons, group puts their results side by side.",
            .otherwise = "first the one, then the other",
            .option = {.excludes = "group,workflow", .by_place = true}});
  v.choice("keep", o.kept,
           {.says = "Files of each person: tables; page, also a report without the moving model; all, as run writes "
                    "them."});
  v.folder("work-dir", o.work,
           {.says = "Folder for the stages of persons under way.",
            .otherwise = "in the folder of each person",
            .option = {.also = "-w,--work_dir"}});
  v.count("jobs", o.jobs,
          {.says = "Persons at a time; the files are the same for every number.",
           .limits = study::within(1, 1024),
           .otherwise = "as many as threads"});
  v.texts("session-label", o.sessions,
          {.says = "Only trials of these sessions, by the names of their files.",
           .option = {.also = "--session_label", .group = kBids}});
  v.texts("task-label", o.tasks,
          {.says = "Only trials of these tasks.", .option = {.also = "--task_label,--task-id", .group = kBids}});
  v.texts("entity", o.entities,
          {.says = "Only trials with this entity in the names of their files, NAME=VALUE; several.",
           .option = {.group = kBids}});
  v.path("bids-filter-file", o.filter_file,
         {.says = "The same as a file: {\"motion\": {\"session\": \"01\", \"task\": [\"lift\"]}}.",
          .option = {.also = "--bids_filter_file", .group = kBids}});
  v.count("mem-mb", o.memory_mb,
          {.says = "Memory: a person at a time for every 500.",
           .limits = study::within(1, 100000000, "MB"),
           .option = {.also = "--mem_mb", .group = kBids}});
}

std::vector<results::PersonOutcome> write_cohort_persons(const CohortOptions& o, const fs::path& folder) {
  const results::Manifest manifest = results::read_manifest(o.manifest, o.study);
  const std::vector<const Person*> persons = results::chosen_persons(manifest, o.persons);
  std::vector<results::PersonOutcome> outcomes(persons.size());
  std::mutex mutex;
  std::size_t done = 0;
  Remarks remarks(o.call);
  in_jobs(
      persons.size(), o.jobs.value_or(0),
      [&](std::size_t i) {
        o.call.progress.check();
        PersonJob done_job = job(o, *persons[i], folder);
        const std::scoped_lock lock(mutex);
        outcomes[i] = std::move(done_job.outcome);
        for (std::string& note : done_job.notes) remarks.note(std::move(note));
        o.call.progress.tell(static_cast<double>(++done) / static_cast<double>(persons.size()),
                             fmt::format("{} of {} persons", done, persons.size()));
        if (o.heard) o.heard(outcomes[i]);
      },
      o.memory_mb ? std::max<std::size_t>(1, *o.memory_mb / kPersonMemory_mb) : kMostJobs);
  return outcomes;
}

results::Group write_cohort_group(const CohortOptions& o, const fs::path& folder) {
  const results::Manifest manifest = results::read_manifest(o.manifest, o.study);
  results::Group group = results::read_group(manifest, folder);
  ResultFolder held(folder, o.call.command, kCohortWord, o.call.overwrite);
  results::write_group(group, manifest, folder);
  held.finish();
  Remarks remarks(o.call);
  for (std::string& note : held.take_notes()) remarks.note(std::move(note));
  return group;
}

std::string write_cohort_workflow(const CohortOptions& o, const fs::path& folder) {
  const results::Manifest manifest = results::read_manifest(o.manifest, o.study);
  std::string options;
  for (const auto& [entity, values] : filter_of(o))
    for (const std::string& value : values) options += fmt::format("--entity {} ", shell_word(entity + "=" + value));
  if (o.kept != page::Kept::page) options += fmt::format("--keep {} ", choice_name(o.kept));
  if (!o.work.empty())
    options += fmt::format("--work-dir {} ", shell_word(fs::absolute(o.work).lexically_normal().string()));
  if (!o.study.empty()) options += "--study " + shell_word(fs::absolute(o.study).lexically_normal().string());
  const results::Workflow workflow = results::workflow(*o.workflow, manifest, folder, options);
  RecordedFolder held(folder / "workflow", "workflow");
  for (const results::WorkflowFile& file : workflow.files) write_file(folder / "workflow" / file.name, file.text);
  held.finish();
  Remarks remarks(o.call);
  for (std::string& note : held.take_notes()) remarks.note(std::move(note));
  return workflow.start;
}

namespace {

/// Throws InvalidInput if the results would stand in, or above, the data set that they come from.
void refuse_data_set(const fs::path& data, const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(data, error)) return;
  const fs::path out = fs::weakly_canonical(folder, error);
  for (fs::path above = fs::canonical(data, error); !above.empty(); above = above.parent_path()) {
    if (fs::equivalent(above, out, error))
      throw InvalidInput("{} {} the data set {}; give another folder for the results, such as {}", folder.string(),
                         fs::equivalent(data, out, error) ? "is" : "holds", data.string(),
                         (data / "derivatives/myoid").string());
    if (above == above.root_path()) return;
  }
}

}  // namespace

void prepare_cohort_folder(const CohortOptions& o, const fs::path& folder) {
  check_options(o);
  (void)filter_of(o);
  const results::Manifest manifest = results::read_manifest(o.manifest, o.study);
  (void)results::chosen_persons(manifest, o.persons);
  refuse_data_set(o.manifest, folder);
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw InvalidInput(fmt::format("{} is a file; name a folder", folder.string()));
  {
    const bool earlier = std::ranges::any_of(manifest.persons, [&](const Person& person) {
      return is_of_earlier_version(results::person_folder(folder, person));
    });
    RecordedFolder record(folder, kCohortWord, {.earlier_version = earlier});
    if (!record.is_signed_by(kCohortWord) && holds_content(folder) && !o.call.overwrite)
      throw InvalidInput(
          fmt::format("the folder {} holds other files than a cohort's; give an empty folder, or add --overwrite",
                      folder.string()));
    protect_files(folder, kGroupFiles, {o.manifest});
    fs::create_directories(folder / results::kPersonsFolder, error);
    if (!error) record.sign();
  }
  if (error) throw InvalidInput(fmt::format("cannot create the folder {}: {}", folder.string(), error.message()));
}

}  // namespace myoid::program
