#include "myoid/results/cohort/workflow.h"

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/quoted_text.h"

namespace myoid::results {
namespace {

namespace fs = std::filesystem;
using ground::parallel_word;
using ground::python_text;
using ground::shell_word;

/// The largest array that Slurm takes unless its administrator allows more (MaxArraySize 1001).
constexpr int kSlurmArray = 1000;

constexpr const char* kPersonScript = R"sh(#!/bin/sh
# usage: person.sh ID   One person of the cohort. Environment: MYOID, the program (default: myoid).
# Returns 0 once the outcome is recorded in persons/ID/outcome.json.
here={0}
mkdir -p "$here/logs"
"${{MYOID:-myoid}}" cohort {1} --out {2} {3}--person "$1" --threads 1 >"$here/logs/$1.log" 2>&1
code=$?
case $code in
  0|3|4|5) [ -e {2}/persons/"$1"/outcome.json ] && exit 0 ;;
esac
exit $code
)sh";

constexpr const char* kGroupScript = R"sh(#!/bin/sh
# The tables and the page of all persons. Exit code 5: some persons have no results, and are named.
exec "${{MYOID:-myoid}}" cohort {0} --out {1} {2}--group
)sh";

constexpr const char* kSnakefile =
    R"py(# One person is one job. Start: snakemake --snakefile FILE --cores N

import json
import os

HERE = {0}
COHORT = {1}
with open(HERE + "/persons.txt") as file:
    PERSONS = file.read().split()

rule all:
    input:
        COHORT + "/cohort.csv"

def recordings(wildcards):
    """The files that a person's results come from. A person who failed, or whose files are gone, depends on the end of
    the group before, and is tried again."""
    try:
        with open(COHORT + "/persons/" + wildcards.person + "/outcome.json") as file:
            outcome = json.load(file)
    except (OSError, ValueError):
        return []
    files = [entry["path"] for entry in outcome["inputs"]]
    if outcome["outcome"] != "failed" and all(map(os.path.exists, files)):
        return files
    return HERE + "/group_ended" if os.path.exists(HERE + "/group_ended") else []

rule person:
    input:
        recordings
    output:
        COHORT + "/persons/{{person}}/outcome.json"
    retries: 2
    threads: 1
    shell:
        "sh {{HERE:q}}/person.sh {{wildcards.person:q}} && touch {{output:q}}"

rule group:
    input:
        expand(COHORT + "/persons/{{person}}/outcome.json", person=PERSONS)
    output:
        COHORT + "/cohort.csv"
    shell:
        "code=0; sh {{HERE:q}}/group.sh || code=$?; touch {{HERE:q}}/group_ended; [ $code -eq 0 -o $code -eq 5 ]"
)py";

constexpr const char* kSlurmPerson = R"sh(#!/bin/sh
#SBATCH --job-name=myoid-person
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --requeue
# One task of the array is one person: line FIRST + task of persons.txt.
here={0}
person=$(sed -n "$((FIRST + SLURM_ARRAY_TASK_ID))p" "$here/persons.txt")
for attempt in 1 2 3; do
  sh "$here/person.sh" "$person"
  code=$?
  [ $code -ge 128 ] || break  # 128 and above: the program was killed
done
exit $code
)sh";

constexpr const char* kSlurmGroup = R"sh(#!/bin/sh
#SBATCH --job-name=myoid-group
#SBATCH --ntasks=1
sh {0}/group.sh >{0}/logs/group.log 2>&1
)sh";

constexpr const char* kSlurmSubmit = R"sh(#!/bin/sh
# usage: sh submit.sh [SBATCH OPTIONS...]   Submits all persons and, after them, the group.
# Submit again after a failure: persons with current results are not computed again.
set -e
here={0}
mkdir -p "$here/logs"
persons=$(wc -l <"$here/persons.txt")
first=0
jobs=
while [ "$first" -lt "$persons" ]; do
  count=$((persons - first))
  if [ "$count" -gt {1} ]; then count={1}; fi
  log=$here/logs/slurm-%A_%a.log
  job=$(FIRST=$first sbatch --parsable --export=ALL --array="1-$count" --output="$log" "$@" "$here/person.sbatch")
  jobs="$jobs:${{job%%;*}}"
  first=$((first + count))
done
sbatch --parsable --export=ALL --dependency="afterany$jobs" --output="$here/logs/slurm-%j.log" "$@" "$here/group.sbatch"
)sh";

constexpr const char* kParallel = R"sh(#!/bin/sh
# usage: sh run.sh [OPTIONS OF GNU PARALLEL...]   All persons, as many at a time as there are cores, then the group.
here={0}
mkdir -p "$here/logs"
parallel --retries 3 --joblog "$here/joblog.tsv" "$@" sh {1} :::: "$here/persons.txt"
exec sh "$here/group.sh"
)sh";

}  // namespace

Workflow workflow(Engine engine, const Manifest& manifest, const fs::path& cohort, const std::string& options) {
  const std::string out = fs::absolute(cohort).lexically_normal().string();
  const std::string place = (fs::path(out) / "workflow").string();
  const std::string here = shell_word(place);
  const std::string persons = shell_word(fs::absolute(manifest.file).lexically_normal().string());
  const std::string more = options.empty() ? "" : options + " ";
  Workflow result;
  std::string names;
  for (const Person& person : manifest.persons) names += person.id + "\n";
  result.files = {{"persons.txt", names},
                  {"person.sh", fmt::format(kPersonScript, here, persons, shell_word(out), more)},
                  {"group.sh", fmt::format(kGroupScript, persons, shell_word(out), more)}};
  switch (engine) {
    case Engine::snakemake: {
      // In names of outputs, and in that of its own folder, Snakemake has no quotes for braces.
      if (out.find_first_of("{}") != std::string::npos)
        throw InvalidInput(
            "{}: Snakemake takes braces in a path for wildcards; give --out a folder without braces, or another engine",
            out);
      const std::string file = shell_word(place + "/Snakefile");
      result.files.push_back({"Snakefile", fmt::format(kSnakefile, python_text(place), python_text(out))});
      result.start = fmt::format("snakemake --snakefile {} --cores all --keep-going --rerun-triggers mtime", file);
      break;
    }
    case Engine::slurm:
      result.files.push_back({"person.sbatch", fmt::format(kSlurmPerson, here)});
      result.files.push_back({"group.sbatch", fmt::format(kSlurmGroup, here)});
      result.files.push_back({"submit.sh", fmt::format(kSlurmSubmit, here, kSlurmArray)});
      result.start = fmt::format("sh {}", shell_word(place + "/submit.sh"));
      break;
    case Engine::parallel:
      result.files.push_back({"run.sh", fmt::format(kParallel, here, parallel_word(place + "/person.sh"))});
      result.start = fmt::format("sh {}", shell_word(place + "/run.sh"));
      break;
  }
  return result;
}

}  // namespace myoid::results
