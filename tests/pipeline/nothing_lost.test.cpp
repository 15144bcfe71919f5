// Every command of the program with its output on, above, below and beside its inputs, by name, by link and by hard
// link, with and without --overwrite, with good and with spoilt inputs: no byte of an input changes, no foreign file
// goes.
#include <algorithm>
#include <atomic>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::read_text;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;

using Words = std::vector<std::string>;

/// A command is called with a folder of inputs and a place of its output, {in} and {out} in its line.
struct Recipe {
  std::string line;
  std::string spoil;               ///< The input that a failing case spoils.
  bool to_folder = true;           ///< The output is a folder, not a file.
  Words inputs{};                  ///< Of a command whose output is a file: its inputs, as places of the output.
  std::string ending{};            ///< Of that file.
  bool needs_runs = false;         ///< `in` holds two finished runs.
  bool is_slow = false;            ///< Succeeds in a few places only.
  std::string may_change{"none"};  ///< Begin of the names in `in` that the command is asked to make anew.

  [[nodiscard]] std::string command() const { return line.substr(0, line.find(' ')); }
  [[nodiscard]] Words words(const std::string& in, const std::string& out) const {
    Words result;
    std::istringstream stream(line);
    for (std::string word; stream >> word;)
      result.push_back(word == "{out}" ? out : word.starts_with("{in}") ? in + word.substr(4) : word);
    return result;
  }
};

const std::vector<Recipe>& recipes() {
  static const std::vector<Recipe> kRecipes{
      {.line = "run {in}/study.toml --out {out}", .spoil = "study.toml", .is_slow = true},
      {.line = "init {out} --from {in}", .spoil = "lift.trc"},
      {.line = "compare {in}/run {in}/run2 --out {out}", .spoil = "run/parameters.json", .needs_runs = true},
      {.line = "review {in}/project --start 0.5 --end 2.5 --out {out}",
       .spoil = "project/subject.xml",
       .is_slow = true},
      {.line = "cohort {in}/persons.csv --out {out}", .spoil = "study.toml", .is_slow = true},
      {.line = "cohort {in} {out} participant", .spoil = "code/study.toml", .is_slow = true},
      {.line = "cohort {in} {out} group", .spoil = "code/study.toml"},
      {.line = "info {in}/model.osim --html {out}",
       .spoil = "model.osim",
       .to_folder = false,
       .inputs = {"model.osim"},
       .ending = ".html"},
      {.line = "convert {in}/lift.trc {out}", .spoil = "lift.trc"},
      {.line = "convert {in}/run {out}", .spoil = "run/parameters.csv", .needs_runs = true},
      {.line = "convert {in}/lift.trc {out}",
       .spoil = "lift.trc",
       .to_folder = false,
       .inputs = {"lift.trc"},
       .ending = ".trc"},
      {.line = "emg {in}/raw.csv {in}/raw2.csv --unit V --out {out}", .spoil = "raw.csv"},
      {.line = "emg {in}/raw.csv --unit V --out {out}",
       .spoil = "raw.csv",
       .to_folder = false,
       .inputs = {"raw.csv"},
       .ending = ".csv"},
      {.line = "ik --model {in}/model.osim --markers {in}/lift.trc --out {out}",
       .spoil = "lift.trc",
       .to_folder = false,
       .inputs = {"lift.trc", "model.osim"},
       .ending = ".mot"},
      {.line = "id --model {in}/model.osim --motion {in}/ik.mot --loads {in}/loads.xml --out {out}",
       .spoil = "ik.mot",
       .to_folder = false,
       .inputs = {"ik.mot", "loads.sto", "loads.xml"},
       .ending = ".sto"},
      {.line = "paths --model {in}/model.osim --motion {in}/ik.mot --out {out}", .spoil = "ik.mot"},
      {.line = "so --model {in}/model.osim --motion {in}/ik.mot --start 1 --end 1.2 --out {out}", .spoil = "ik.mot"},
      {.line = "identify --method torque --folds none --muscles {in}/muscles.csv --activations {in}/activation.sto "
               "--lengths {in}/length.sto --velocities {in}/velocity.sto --moment-arms {in}/arm.sto --torques "
               "{in}/id.sto --coordinate elbow_flexion --out {out}",
       .spoil = "muscles.csv"},
      {.line = "muscle --muscle {in}/soleus.toml --length {in}/l.csv --excitation 1 --out {out}",
       .spoil = "l.csv",
       .to_folder = false,
       .inputs = {"l.csv", "soleus.toml"},
       .ending = ".sto"},
      {.line = "simulate --model {in}/model.osim --excite BIC=0.1@0.02+0.03 --end 0.1 --out {out}",
       .spoil = "model.osim"},
      {.line = "twin --protocol {in}/protocol.toml --out {out}", .spoil = "protocol.toml"},
      {.line = "twin-study --protocol {in}/protocol.toml --subjects 1 --out {out}",
       .spoil = "protocol.toml",
       .is_slow = true},
      {.line = "predict {in}/run --trials lift --out {out}", .spoil = "run/run.json", .needs_runs = true},
      {.line = "report --group {in}/run {in}/run2 --out {out}", .spoil = "run/parameters.csv", .needs_runs = true},
      {.line = "report {in}/run", .spoil = "run/run.json", .needs_runs = true, .is_slow = true, .may_change = "run/"},
      {.line = "run-tool {in}/setup.xml --out {out}", .spoil = "lift.trc"},
      {.line = "convert {in}/model.osim {out}",
       .spoil = "model.osim",
       .to_folder = false,
       .inputs = {"model.osim"},
       .ending = ".osim"},
      // Commands without an output.
      {.line = "check {in}/study.toml", .spoil = "study.toml", .is_slow = true},
      {.line = "check {in}/study.toml --defaults", .spoil = "study.toml", .is_slow = true},
      {.line = "design {in}/none.toml", .spoil = "study.toml", .is_slow = true},
  };
  return kRecipes;
}

/// The commands that the program's own help lists.
std::set<std::string> commands_of_the_program() {
  std::istringstream help(myoid({"--help"}).out);
  std::set<std::string> commands;
  for (std::string line; std::getline(help, line);) {
    const std::size_t end = line.find("  ", 2);  // two blanks stand before a name, and two or more behind it
    if (line.size() > 2 && line.starts_with("  ") && line[2] >= 'a' && line[2] <= 'z' && end < 20)
      commands.insert(line.substr(2, end - 2));
  }
  return commands;
}

/// Every file and link below a folder, with its content.
std::map<std::string, std::string> snapshot(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (entry.is_symlink()) {
      files[name] = "-> " + fs::read_symlink(entry.path()).string();
    } else if (entry.is_regular_file()) {
      files[name] = read_text(entry.path());
    }
  }
  return files;
}

/// The program's own notes: the list of a folder's results, kept stages.
bool is_hidden(const std::string& name) { return name.starts_with('.') || name.find("/.") != std::string::npos; }

/// One call of the program in a folder of its own.
struct Case {
  const Recipe* recipe;
  std::string says;
  /// Prepares the folder D, which holds `in`, and returns the place of the output.
  std::function<fs::path(const fs::path& D)> place;
  bool overwrite = false, spoilt = false;
  std::string may_go{};  ///< A file that the command line itself gives away.
  std::string edited{};  ///< An edit in a result, which must be found below D; other results may change.
};

class NothingIsLost : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scene_ = new TemporaryFolder();
    const std::string in = *scene_ / "in";
    write_text(*scene_ / "protocol.toml",
               "name = \"short\"\nlevel = \"L0\"\n[motion]\nrate_hz = 50\n[[trial]]\nname = \"lift\"\n"
               "kind = \"flexion\"\nfrequency_hz = 0.5\ncentre_deg = 72\namplitude_deg = 40\nheld_mass_kg = 1.0\n"
               "duration_s = 3\n");
    ASSERT_EQ(myoid({"twin", "--protocol", *scene_ / "protocol.toml", "--out", in}).exit_code, 0);
    for (const char* run : {"run", "run2"}) {
      const Finished done = myoid({"run", in + "/study.toml", "--out", *scene_ / "runs" / run});
      ASSERT_TRUE(done.exit_code == 0 || done.exit_code == 4) << done.err;
    }
    fs::remove_all(in + "/truth");
    const fs::path lift = *scene_ / "runs/run/lift";
    fs::rename(*scene_ / "protocol.toml", in + "/protocol.toml");
    for (const auto& [from, to] : {std::pair{"ik.mot", "ik.mot"},
                                   {"activation.sto", "activation.sto"},
                                   {"id.sto", "id.sto"},
                                   {"MuscleAnalysis_Length.sto", "length.sto"},
                                   {"MuscleAnalysis_MuscleTendonVelocity.sto", "velocity.sto"},
                                   {"MuscleAnalysis_MomentArm_elbow_flexion.sto", "arm.sto"}})
      fs::copy_file(lift / from, fs::path(in) / to);
    write_small_inputs(in);
    write_project(in, *scene_ / "project");
  }
  static void TearDownTestSuite() { delete scene_; }

  /// Writes the virtual person as a project of CEINMS-RT.
  static void write_project(const fs::path& in, const fs::path& project) {
    fs::create_directories(project / "lift");
    fs::copy_file(in / "model.osim", project / "model.osim");
    fs::copy_file(in / "activation.sto", project / "lift/emgFilt.sto");
    fs::copy_file(in / "ik.mot", project / "lift/ik.sto");
    fs::copy_file(in / "id.sto", project / "lift/id.sto");
    std::string subject =
        "<?xml version=\"1.0\"?>\n<subject><muscleDefault><percentageChange>0.15</percentageChange>"
        "<damping>0.1</damping>";
    for (const char* curve : {"activeForceLength", "passiveForceLength", "forceVelocity"})
      subject +=
          "<Curve><name>" + std::string(curve) + "</name><xPoints>0 1 2</xPoints><yPoints>0 1 0</yPoints></Curve>";
    subject += "</muscleDefault><muscles>";
    for (const char* muscle : {"BIC", "BRD", "TRI"})
      subject += "<muscle><name>" + std::string(muscle) +
                 "</name><C1>-0.5</C1><C2>-0.5</C2><shapeFactor>-1</shapeFactor><optimalFiberLength>0.13"
                 "</optimalFiberLength><pennationAngle>0</pennationAngle><tendonSlackLength>0.17</tendonSlackLength>"
                 "<maxIsometricForce>600</maxIsometricForce><strengthCoefficient>1</strengthCoefficient></muscle>";
    subject +=
        "</muscles><DoFs><DoF><name>elbow_flexion</name><muscleSequence>BIC BRD TRI</muscleSequence></DoF></DoFs>"
        "<Channels>";
    for (const char* muscle : {"BIC", "BRD", "TRI"})
      subject +=
          "<Channel><name>" + std::string(muscle) + "</name><muscleSequence>" + muscle + "</muscleSequence></Channel>";
    write_text(project / "subject.xml", subject + "</Channels></subject>\n");
  }

  static void write_small_inputs(const std::string& in) {
    write_text(in + "/persons.csv", "name,study\nP1,study.toml\n");
    fs::create_directories(in + "/code");
    fs::create_directories(in + "/sub-1");
    fs::copy_file(in + "/lift.trc", in + "/sub-1/raw.trc");
    std::string study = read_text(in + "/study.toml");
    for (const char* name : {"model.osim", "lift.trc", "lift_emg.sto", "truth.csv"})
      study.replace(study.find("\"" + std::string(name)) + 1, 0, "../");
    write_text(in + "/code/study.toml", study);
    std::string raw = "time,BIC\n";
    for (int i = 0; i < 4000; ++i)
      raw += std::to_string(0.001 * i) + "," + std::to_string((i % 7 - 3) * (i > 2000 ? 1e-3 : 1e-5)) + "\n";
    write_text(in + "/raw.csv", raw);
    write_text(in + "/raw2.csv", raw);
    write_text(in + "/loads.xml",
               "<OpenSimDocument Version=\"40000\"><ExternalLoads name=\"l\"><objects><ExternalForce name=\"f\">"
               "<applied_to_body>forearm_hand</applied_to_body><force_expressed_in_body>ground"
               "</force_expressed_in_body><point_expressed_in_body>forearm_hand</point_expressed_in_body>"
               "<force_identifier>f_v</force_identifier><point_identifier>f_p</point_identifier></ExternalForce>"
               "</objects><datafile>loads.sto</datafile></ExternalLoads></OpenSimDocument>\n");
    std::string loads =
        "loads\nversion=1\nnRows=2\nnColumns=7\ninDegrees=no\nendheader\n"
        "time\tf_vx\tf_vy\tf_vz\tf_px\tf_py\tf_pz\n";
    for (const char* time : {"0", "9"}) loads += std::string(time) + "\t0\t-10\t0\t0\t-0.3\t0\n";
    write_text(in + "/loads.sto", loads);
    write_text(in + "/muscles.csv",
               "muscle,max_isometric_force,optimal_fiber_length,max_shortening_speed,tendon_slack_length\n"
               "BIC,600,0.13,1.3,0.19\nBRD,260,0.17,1.7,0.13\nTRI,1800,0.12,1.2,0.16\n");
    fs::copy_file(myoid::test::source_dir() / "examples/rat_soleus/muscle.toml", in + "/soleus.toml");
    write_text(in + "/l.csv", "time,length\n0,0.04\n0.1,0.041\n0.2,0.042\n0.3,0.041\n");
    write_text(in + "/setup.xml",
               "<OpenSimDocument Version=\"40000\"><InverseKinematicsTool name=\"t\"><model_file>model.osim"
               "</model_file><marker_file>lift.trc</marker_file><time_range>1 1.1</time_range><output_motion_file>"
               "tool.mot</output_motion_file></InverseKinematicsTool></OpenSimDocument>");
    write_text(in + "/notes.txt", "of a person");
  }

  /// Makes the inputs in a folder of a case.
  static void make_inputs(const Recipe& recipe, const fs::path& D) {
    fs::copy(*scene_ / "in", D / "in", fs::copy_options::recursive);
    if (recipe.needs_runs) fs::copy(*scene_ / "runs", D / "in", fs::copy_options::recursive);
    // The project is there for `review` alone, because `init --from in` takes it for the study.
    if (recipe.command() == "review") fs::copy(*scene_ / "project", D / "in/project", fs::copy_options::recursive);
    write_text(D / "notes.txt", "of a person");
  }

  static Finished call(const Recipe& recipe, const fs::path& D, const fs::path& out, bool overwrite) {
    Words words = recipe.words((D / "in").string(), out.string());
    words.insert(words.end(), {"--quiet", "--threads", "1"});
    if (overwrite) words.emplace_back("--overwrite");
    return myoid(words);
  }

  /// The names of the files that a command writes, below the place of its output or beside it.
  static std::vector<std::string> names_of_results(const Recipe& recipe) {
    const TemporaryFolder folder;
    make_inputs(recipe, folder.path());
    fs::create_directories(folder / "fresh");
    (void)call(recipe, folder.path(), recipe.to_folder ? folder / "fresh" : folder / ("fresh/x" + recipe.ending),
               false);
    std::vector<std::string> names;
    for (const auto& [name, text] : snapshot(folder / "fresh"))
      if (!is_hidden(name)) names.push_back(name);
    return names;
  }

  static void judge(const Case& c) {
    const TemporaryFolder folder;
    const fs::path& D = folder.path();
    make_inputs(*c.recipe, D);
    const fs::path out = c.place(D);
    if (c.spoilt) write_text(D / "in" / c.recipe->spoil, "spoilt\n");
    const auto before = snapshot(D);
    const Finished finished = call(*c.recipe, D, out, c.overwrite);
    const auto after = snapshot(D);
    std::string lost;
    for (const auto& [name, text] : before) {
      const bool is_result = !c.edited.empty() && name.starts_with("out/") && name != "out/notes.txt";
      if (name == c.may_go || is_result || is_hidden(name) || name.starts_with("in/" + c.recipe->may_change)) continue;
      const auto found = after.find(name);
      if (found == after.end()) lost += " " + name + " is gone;";
      if (found != after.end() && found->second != text) lost += " " + name + " is another;";
    }
    const bool kept = c.edited.empty() || std::ranges::any_of(after, [&](const auto& file) {
                        return file.second.find(c.edited) != std::string::npos;
                      });
    const std::scoped_lock lock(mutex_);
    EXPECT_TRUE(lost.empty() && kept) << c.recipe->command() << ": " << c.says << (c.overwrite ? ", --overwrite" : "")
                                      << (c.spoilt ? ", spoilt" : "") << ":" << lost << (kept ? "" : " edits are lost")
                                      << "\nexit " << finished.exit_code << "\n"
                                      << finished.err;
    EXPECT_TRUE(finished.exit_code >= 0 && finished.exit_code <= 5 && finished.exit_code != 1)
        << c.recipe->command() << ": " << c.says << "\n"
        << finished.err;
  }

  static void judge_all(const std::vector<Case>& cases) {
    std::atomic<std::size_t> next = 0;
    std::vector<std::jthread> threads;
    for (int k = 0; k < 4; ++k)
      threads.emplace_back([&] {
        for (std::size_t i = next++; i < cases.size(); i = next++) judge(cases[i]);
      });
  }

  static inline TemporaryFolder* scene_ = nullptr;
  static inline std::mutex mutex_;
};

/// Returns a link to a place, which is made where it is missing.
fs::path linked(const fs::path& D, const fs::path& place) {
  fs::create_directories(place);
  fs::create_directory_symlink(place, D / "link");
  return D / "link";
}

void add_places_of_folders(const Recipe& recipe, std::vector<Case>& cases) {
  for (const char* place : {"in", ".", "in/new", "out"}) {
    for (const bool overwrite : {false, true}) {
      const bool told = !recipe.is_slow || (overwrite && std::string(place) != ".");
      const auto by_name = [=](const fs::path& D) { return D / place; };
      const auto by_link = [=](const fs::path& D) { return linked(D, D / place); };
      if (told) cases.push_back({&recipe, std::string("on ") + place, by_name, overwrite});
      cases.push_back({&recipe, std::string("on a link to ") + place, by_link, overwrite, recipe.is_slow});
      if (recipe.is_slow || overwrite) cases.push_back({&recipe, std::string("on ") + place, by_name, overwrite, true});
    }
  }
}

/// Every result's place is taken by a foreign file, or by a hard or symbolic link to an input.
void add_taken_places(const Recipe& recipe, const std::vector<std::string>& names, std::vector<Case>& cases) {
  for (const char* by : {"a foreign file", "a hard link to an input", "a link to an input"}) {
    for (const bool overwrite : {false, true}) {
      if (recipe.is_slow && !overwrite) continue;
      const auto place = [=](const fs::path& D) {
        for (const std::string& name : names) {
          const fs::path file = D / "out" / name;
          fs::create_directories(file.parent_path());
          if (by[2] == 'f') write_text(file, "of a person");
          if (by[2] == 'h') fs::create_hard_link(D / "in" / recipe.spoil, file);
          if (by[2] == 'l') fs::create_symlink(D / "in" / recipe.spoil, file);
        }
        fs::create_directories(D / "out");
        write_text(D / "out/notes.txt", "of a person");
        return D / "out";
      };
      cases.push_back({&recipe, std::string("each result's name is ") + by, place, overwrite});
    }
  }
}

TEST_F(NothingIsLost, EveryCommandOfTheProgramHasARecipe) {
  std::set<std::string> known;
  const std::vector<Recipe>& all = recipes();
  for (const Recipe& recipe : all) known.insert(recipe.command());
  known.insert("demo");  // it has no input, and writes as twin and run do
  EXPECT_THAT(commands_of_the_program(), testing::SizeIs(testing::Ge(22U)));
  EXPECT_EQ(known, commands_of_the_program());
}

TEST_F(NothingIsLost, WhereAFolderIsTheOutput) {
  const std::vector<Recipe>& all = recipes();
  std::vector<Case> cases;
  for (const Recipe& recipe : all) {
    if (!recipe.to_folder) continue;
    add_places_of_folders(recipe, cases);
    add_taken_places(recipe, names_of_results(recipe), cases);
    // A second time into its own results, one of which a person changed.
    for (const bool overwrite : {false, true}) {
      const auto again = [&recipe](const fs::path& D) {
        (void)call(recipe, D, D / "out", false);
        fs::create_directories(D / "out");
        write_text(D / "out/notes.txt", "of a person");
        for (const auto& [name, text] : snapshot(D / "out")) {
          if (is_hidden(name) || !name.ends_with(".csv")) continue;
          write_text(D / "out" / name, text + "an edit by hand\n");
          return D / "out";
        }
        write_text(D / "out/other.csv", "an edit by hand\n");
        return D / "out";
      };
      cases.push_back({&recipe, "a second time", again, overwrite, false, "", "an edit by hand"});
    }
  }
  judge_all(cases);
  RecordProperty("cases", static_cast<int>(cases.size()));
  std::printf("%zu cases\n", cases.size());
  EXPECT_GT(cases.size(), 400U);
}

TEST_F(NothingIsLost, WhereAFileIsTheOutput) {
  const std::vector<Recipe>& all = recipes();
  std::vector<Case> cases;
  for (const Recipe& recipe : all) {
    if (recipe.to_folder) continue;
    for (const bool overwrite : {false, true}) {
      for (const std::string& input : recipe.inputs) {
        const auto on = [&](const char* how, auto place) {
          for (const bool spoilt : {false, true}) cases.push_back({&recipe, how + input, place, overwrite, spoilt});
        };
        on("on ", [=](const fs::path& D) { return D / "in" / input; });
        on("on a link to ", [=, ending = recipe.ending](const fs::path& D) {
          fs::create_symlink(D / "in" / input, D / ("link" + ending));
          return D / ("link" + ending);
        });
        on("on a hard link to ", [=, ending = recipe.ending](const fs::path& D) {
          fs::create_hard_link(D / "in" / input, D / ("hard" + ending));
          return D / ("hard" + ending);
        });
      }
      // The user names x and gives it away with --overwrite; files beside it nobody named.
      for (const std::string& name : names_of_results(recipe)) {
        const auto taken = [=, ending = recipe.ending](const fs::path& D) {
          fs::create_directories(D / "out");
          write_text(D / "out" / name, "of a person");
          return D / ("out/x" + ending);
        };
        const std::string named = "out/x" + recipe.ending;
        cases.push_back({&recipe, "beside " + name, taken, overwrite, false, overwrite ? named : ""});
      }
    }
  }
  judge_all(cases);
  RecordProperty("cases", static_cast<int>(cases.size()));
  std::printf("%zu cases\n", cases.size());
  EXPECT_GT(cases.size(), 100U);
}

TEST_F(NothingIsLost, AndEveryCommandReplacesItsOwnResults) {
  const std::vector<Recipe>& all = recipes();
  for (const Recipe& recipe : all) {
    const TemporaryFolder folder;
    const fs::path& D = folder.path();
    make_inputs(recipe, D);
    const fs::path out = recipe.to_folder ? D / "out" : D / ("x" + recipe.ending);
    const Finished first = call(recipe, D, out, recipe.command() == "report");
    const Finished again = call(recipe, D, out, true);
    EXPECT_EQ(again.exit_code, first.exit_code) << recipe.command() << " a second time:\n" << again.err;
  }
}

}  // namespace
