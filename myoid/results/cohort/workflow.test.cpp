#include "myoid/results/cohort/workflow.h"

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::results {
namespace {

using testing::HasSubstr;

const Manifest kManifest{.file = "/data/my lab/m.csv",
                         .persons = {{.name = "A a", .id = "A", .label = "A"}, {.name = "B", .id = "B", .label = "B"}}};

std::string text_of(const Workflow& workflow, const std::string& name) {
  for (const WorkflowFile& file : workflow.files) {
    if (file.name == name) return file.text;
  }
  return "";
}

TEST(Workflow, EveryEngineCallsOneScriptAPerson) {
  for (const Engine engine : {Engine::snakemake, Engine::slurm, Engine::parallel}) {
    const Workflow w = workflow(engine, kManifest, "/out/c", "--study /s.toml");
    EXPECT_EQ(text_of(w, "persons.txt"), "A\nB\n");
    EXPECT_THAT(text_of(w, "person.sh"), HasSubstr("cohort '/data/my lab/m.csv' --out /out/c --study /s.toml "
                                                   "--person \"$1\""));
    EXPECT_THAT(text_of(w, "group.sh"), HasSubstr("--study /s.toml --group"));
    EXPECT_THAT(w.start, HasSubstr("/out/c/workflow/"));
  }
}

TEST(Workflow, OfSnakemakeDependsOnTheRecordingsAndSlurmKeepsLogs) {
  const Workflow snakemake = workflow(Engine::snakemake, kManifest, "/out/c", "");
  EXPECT_THAT(text_of(snakemake, "Snakefile"), HasSubstr("input:\n        recordings\n"));
  EXPECT_THAT(snakemake.start, HasSubstr("--rerun-triggers mtime"));
  EXPECT_THAT(text_of(workflow(Engine::slurm, kManifest, "/out/c", ""), "submit.sh"),
              testing::AllOf(HasSubstr("/logs/slurm-%A_%a.log"), testing::Not(HasSubstr("/dev/null"))));
}

TEST(Workflow, OfSnakemakeRefusesBracesWhichItHasNoQuotesFor) {
  EXPECT_THROW((void)workflow(Engine::snakemake, kManifest, "/out/{c}", ""), InvalidInput);
  EXPECT_NO_THROW((void)workflow(Engine::parallel, kManifest, "/out/{c}", ""));
  EXPECT_NO_THROW((void)workflow(Engine::slurm, kManifest, "/out/{c}", ""));
}

TEST(Workflow, ThePersonsScriptSucceedsOnceTheOutcomeIsRecordedAndElseHasTheProgramsCode) {
  const test::TemporaryFolder folder;
  const auto program = folder / "program";
  const auto code_of = [&](const std::string& does) {
    write_file(program, "#!/bin/sh\n" + does + "\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    const Workflow w = workflow(Engine::parallel, kManifest, folder / "out", "");
    const auto script = folder / "out/workflow/person.sh";
    write_file(script, text_of(w, "person.sh"));
    const std::string command = "MYOID=" + program.string() + " sh " + script.string() + " A";
    return WEXITSTATUS(std::system(command.c_str()));
  };
  EXPECT_EQ(code_of("exit 3"), 3) << "a manifest that cannot be read records nothing";
  EXPECT_EQ(code_of("kill -9 $$"), 137);
  write_file(folder / "out/persons/A/outcome.json", "{}");
  for (const char* recorded : {"exit 0", "exit 3", "exit 4", "exit 5"}) EXPECT_EQ(code_of(recorded), 0) << recorded;
  EXPECT_EQ(code_of("exit 130"), 130);
  EXPECT_EQ(code_of("echo said; exit 1"), 1);
  EXPECT_EQ(read_text_file(folder / "out/workflow/logs/A.log"), "said\n");
}

}  // namespace
}  // namespace myoid::results
