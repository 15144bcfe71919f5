// damaged_files [--list]: what the program makes of damaged files, as a table of kinds and damages.
//
//   right    all that was written, whether the damage is mentioned or not
//   stated   what is there is right, or less, or has another name, and a note says so
//   doubtful other numbers or times, and a note says what does not fit together in the file
//   refused  an error that names the file (exit code 3 of the program, asked for one of each cell)
//   itself   one flipped bit inside a number, a name or a setting makes another valid one, or a
//            TOML file is cut off at the end of a line: no reader can know; the rest is as written
//   WRONG    another number or less than was written, in silence, or an error that is none of ours
//
// Then the commands run on every file, each as a process (commands.h). Ends with 1 if there is a
// WRONG file, a command that breaks its promise, or too few files, or if docs/data/damaged-files.txt is another table;
// MYOID_PRINT_PAGES=1 writes it. --list prints every file.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"

#include "tests/damage/commands.h"
#include "tests/damage/damages.h"
#include "tests/damage/kinds.h"
#include "tests/pipeline/program.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using namespace myoid::damage;

enum class Verdict { right, stated, doubtful, refused, itself, wrong };

struct Judgement {
  Verdict verdict = Verdict::wrong;
  std::string reason;
};

/// What is other than in the good file.
struct Difference {
  std::set<std::string> columns;  ///< With another number.
  int samples = 0;                ///< Other numbers altogether.
  int missing = 0;                ///< Numbers that are not there, or NaN.
  int strange_instants = 0;       ///< Instants that nobody wrote.
  std::set<std::string> lost, added;
  int texts = 0;
};

bool same(double a, double b) {
  // A millionth is what two roundings of one scale to 32 bits may part, and no measurement sees it.
  return (std::isnan(a) && std::isnan(b)) || std::abs(a - b) <= 1e-6 * std::abs(b);
}

Difference difference(const Content& good, const Content& found, bool says_its_rows) {
  Difference d;
  for (const auto& [name, text] : good.texts) {
    const auto it = found.texts.find(name);
    if (it == found.texts.end() || it->second != text) ++d.texts;
  }
  for (const auto& [name, text] : found.texts)
    if (!good.texts.contains(name)) ++d.texts;
  for (const auto& [name, values] : good.numbers)
    if (!found.numbers.contains(name)) d.lost.insert(name);
  for (const auto& [name, values] : found.numbers)
    if (!good.numbers.contains(name)) d.added.insert(name);
  const bool timed = !good.time_s.empty();
  std::vector<std::size_t> row;  // of the good file, for each row found
  if (timed) {
    const double slack = 1e-9 * (good.time_s[1] - good.time_s[0]);
    std::size_t g = 0;
    for (const double t : found.time_s) {
      while (g < good.time_s.size() && good.time_s[g] < t - slack) ++g;
      const bool there = g < good.time_s.size() && std::abs(good.time_s[g] - t) <= slack;
      if (!there) ++d.strange_instants;
      row.push_back(there ? g : good.time_s.size());
    }
    if (says_its_rows && found.time_s.size() < good.time_s.size()) ++d.missing;
  }
  for (const auto& [name, values] : found.numbers) {
    const auto it = good.numbers.find(name);
    if (it == good.numbers.end()) continue;
    if (!timed && values.size() != it->second.size()) {
      d.columns.insert(name);
      ++d.samples;
      continue;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::size_t g = timed ? row[i] : i;
      if (g >= it->second.size()) continue;
      if (std::isnan(values[i]) && !std::isnan(it->second[g])) {
        ++d.missing;
      } else if (!same(values[i], it->second[g])) {
        d.columns.insert(name);
        ++d.samples;
      }
    }
  }
  return d;
}

/// A flipped bit that made another valid number, name or setting of one.
bool is_the_value_itself(const Kind& kind, const Damaged& file, const Difference& d) {
  if (!file.flipped) return false;
  if (kind.shape == Shape::xml || kind.shape == Shape::toml) {
    std::size_t at = 0;
    while (file.bytes[at] == kind.bytes[at]) ++at;
    if (kind.shape == Shape::xml) {
      const std::size_t open = kind.bytes.rfind('<', at);
      const std::size_t close = kind.bytes.rfind('>', at);
      const bool in_text = close != std::string::npos && close > open && close != at;
      const std::size_t quotes =
          static_cast<std::size_t>(std::count(kind.bytes.begin() + static_cast<std::ptrdiff_t>(open),
                                              kind.bytes.begin() + static_cast<std::ptrdiff_t>(at), '"'));
      return in_text || quotes % 2 == 1;
    }
    const std::size_t line = kind.bytes.rfind('\n', at);
    const std::size_t equals = kind.bytes.find('=', line == std::string::npos ? 0 : line);
    return equals < at;
  }
  if (d.strange_instants > 0 || d.texts > 0) return false;
  // A marker that got another name is three columns.
  const bool renamed = d.lost.size() == d.added.size() && d.lost.size() <= 3 && d.samples == 0;
  const auto stem = [](const std::string& name) { return name.substr(0, name.find_first_of(".@")); };
  std::set<std::string> channels;
  for (const std::string& name : d.columns) channels.insert(stem(name));
  const bool one_channel = d.lost.empty() && d.added.empty() && channels.size() == 1;
  return d.missing == 0 && (renamed || one_channel);
}

/// The damaged file, or one beside it whose name stands in it.
bool names_a_file(const std::string& message, const fs::path& path) {
  return message.find(path.filename().string()) != std::string::npos ||
         message.find(path.parent_path().string()) != std::string::npos;
}

Judgement judge(const Kind& kind, const Content& good, const Damaged& file, const fs::path& path) {
  Content found;
  try {
    myoid::write_file(path, file.bytes);
    found = kind.read(path);
  } catch (const myoid::InvalidInput& error) {
    const std::string message = error.what();
    return {names_a_file(message, path) ? Verdict::refused : Verdict::wrong, message};
  } catch (const std::exception& error) {
    return {Verdict::wrong, std::string("not an error of a file: ") + error.what()};
  }
  const Difference d = difference(good, found, kind.says_its_rows);
  std::string news;
  for (const std::string& note : found.notes) {
    if (std::find(good.notes.begin(), good.notes.end(), note) == good.notes.end())
      news += (news.empty() ? "" : "; ") + note;
  }
  const bool other = d.samples > 0 || d.strange_instants > 0 || d.texts > 0 || !d.lost.empty() || !d.added.empty();
  if (!other && d.missing == 0) return {Verdict::right, news};
  if (!news.empty()) {
    const bool numbers = d.samples > 0 || d.strange_instants > 0;
    return {numbers ? Verdict::doubtful : Verdict::stated, news};
  }
  if (is_the_value_itself(kind, file, d))
    return {Verdict::itself, fmt::format("{} numbers of {} columns", d.samples, d.columns.size())};
  // TOML has no end: what is cut off at the end of a line leaves a whole, shorter file.
  if (kind.shape == Shape::toml && file.what == "truncated" &&
      kind.bytes[file.bytes.size() - (file.bytes.back() == '\n' ? 1 : 0)] == '\n')
    return {Verdict::itself, "cut off at the end of a line"};
  // A gap is a gap: NaN in a cell that says NaN.
  if (!other && (file.what == "NaN text" || file.what == "no number")) return {Verdict::right, "a gap"};
  return {Verdict::wrong, fmt::format("{} other numbers in {} columns, {} missing, {} strange instants, {} columns "
                                      "lost, {} added, {} texts",
                                      d.samples, d.columns.size(), d.missing, d.strange_instants, d.lost.size(),
                                      d.added.size(), d.texts)};
}

constexpr int kFewest = 1200;  ///< Damaged files; fewer are a fault of this test.

const char* word(Verdict verdict) {
  constexpr const char* kWords[] = {"right", "stated", "doubtful", "refused", "itself", "WRONG"};
  return kWords[static_cast<std::size_t>(verdict)];
}

/// Returns true if the documentation holds this table and its sums; MYOID_PRINT_PAGES writes the table instead.
bool is_told(const std::string& table, const std::map<Verdict, int>& sum, int all) {
  const fs::path docs = myoid::test::source_dir() / "docs";
  const fs::path file = docs / "data/damaged-files.txt";
  const auto count = [&](Verdict verdict) { return sum.contains(verdict) ? sum.at(verdict) : 0; };
  const std::string sentence = fmt::format(
      "of {} files {} are read right, {} stated, {} doubtful, {} refused and {} itself;", all, count(Verdict::right),
      count(Verdict::stated), count(Verdict::doubtful), count(Verdict::refused), count(Verdict::itself));
  std::string words = myoid::test::read_text(docs / "damaged-files.md");
  std::ranges::replace(words, '\n', ' ');
  if (std::getenv("MYOID_PRINT_PAGES") != nullptr) myoid::write_file(file, table);
  const bool same_table = myoid::test::read_text(file) == table;
  const bool same_sums = words.find(sentence) != std::string::npos;
  if (!same_table) fmt::print("{} differs from this table; MYOID_PRINT_PAGES=1 writes it\n", file.string());
  if (!same_sums) fmt::print("docs/damaged-files.md does not say: {}\n", sentence);
  return same_table && same_sums;
}

}  // namespace

int main(int argc, char** argv) {
  const bool listed = argc > 1 && std::strcmp(argv[1], "--list") == 0;
  const myoid::test::TemporaryFolder folder;
  std::vector<std::string> columns;
  std::map<std::string, std::map<std::string, std::map<Verdict, int>>> table;
  std::vector<std::string> kinds;
  std::map<Verdict, int> sum;
  int wrong = 0;
  std::vector<Variant> variants;
  const std::vector<Kind> good_kinds = good_files(folder.path());
  for (const Kind& kind : good_kinds) {
    kinds.push_back(kind.name);
    const fs::path path = folder / kind.file;
    myoid::write_file(path, kind.bytes);
    const Content good = kind.read(path);
    if (good.numbers.empty()) {
      fmt::print("{}: the good file holds nothing\n", kind.name);
      return 1;
    }
    std::set<std::string> asked;
    for (const Damaged& file : damaged(kind)) {
      variants.push_back({&kind, file});
      Judgement j = judge(kind, good, file, path);
      if (j.verdict == Verdict::refused && asked.insert(file.what).second) {
        std::vector<std::string> command = kind.command;
        command.push_back(path.string());
        const auto finished = myoid::test::myoid(command);
        if (finished.exit_code != 3 || !names_a_file(finished.err + finished.out, path))
          j = {Verdict::wrong, fmt::format("the program ends with {}: {}", finished.exit_code, finished.err)};
      }
      if (std::find(columns.begin(), columns.end(), file.what) == columns.end()) columns.push_back(file.what);
      ++table[kind.name][file.what][j.verdict];
      ++sum[j.verdict];
      wrong += j.verdict == Verdict::wrong ? 1 : 0;
      if (listed || j.verdict == Verdict::wrong)
        fmt::print("{:<8} {}, {}, {}: {}\n", word(j.verdict), kind.name, file.what, file.detail, j.reason);
    }
  }
  if (listed) fmt::print("\n");
  std::string page = "| damage |";
  for (const std::string& kind : kinds) page += fmt::format(" {} |", kind);
  page += "\n| --- |";
  for (std::size_t i = 0; i < kinds.size(); ++i) page += " --- |";
  for (const std::string& column : columns) {
    page += fmt::format("\n| {} |", column);
    for (const std::string& kind : kinds) {
      std::string cell;
      for (const auto& [verdict, count] : table[kind][column])
        cell += fmt::format("{}{} {}", cell.empty() ? "" : ", ", count, word(verdict));
      page += fmt::format(" {} |", cell);
    }
  }
  int all = 0;
  page += "\n\n";
  for (const auto& [verdict, count] : sum) {
    page += fmt::format("{} {}, ", count, word(verdict));
    all += count;
  }
  page += fmt::format("of {} damaged files\n", all);
  const CommandRuns commands = run_commands(variants);
  for (const std::string& failure : commands.failures) fmt::print("{}\n", failure);
  page += fmt::format("{} runs of commands, {} broke their promise\n", commands.runs, commands.failures.size());
  fmt::print("{}at most {:.0f} MB\n", page, commands.most_memory_mb);
  const bool told = listed || is_told(page, sum, all);
  return wrong > 0 || all < kFewest || !commands.failures.empty() || !told ? 1 : 0;
}
