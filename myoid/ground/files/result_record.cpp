#include "myoid/ground/files/result_record.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <mutex>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/folder_lock.h"
#include "myoid/ground/files/input_log.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::inline ground {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kEarlier = "an earlier version that kept no list";
constexpr std::size_t kHead = 16384;  ///< Bytes that tell the kind of a file.

/// A file below a folder, reached without any symbolic link.
struct Reached {
  OpenFile parent, file;
  struct stat status {};
};

std::optional<Reached> reach(const fs::path& folder, const fs::path& path) {
  OpenFile parent(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  for (const fs::path& part : path.parent_path()) {
    if (!parent) return std::nullopt;
    parent = OpenFile(openat(parent.get(), part.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  }
  if (!parent) return std::nullopt;
  OpenFile file(openat(parent.get(), path.filename().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  Reached reached{std::move(parent), std::move(file)};
  if (!reached.file || fstat(reached.file.get(), &reached.status) != 0 || !S_ISREG(reached.status.st_mode))
    return std::nullopt;
  return reached;
}

bool is_below(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

fs::path normal(const fs::path& path) {
  fs::path whole = fs::absolute(path).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

}  // namespace

/// The list of a folder that a command holds.
struct HeldRecord {
  fs::path given, root;  ///< As the command named the folder, and without links.
  std::string command;
  RecordTerms terms;
  RecordContent record;
  std::map<std::string, std::string> written;  ///< In this session: path and hash.
  std::set<std::string> moved, kept, left;     ///< Aside, in place, in the way.
  fs::path aside;                              ///< Folder of the files that were moved aside.
  bool is_new = false;                         ///< The list was begun in this session.
  bool is_signed = false;                      ///< The list stays, also without files.
};

namespace {

/// Appends lines to the list of a folder, and the signature before the first.
void append_to_record(HeldRecord& held, std::string lines) {
  const OpenFile file = open_record(held.root);
  struct stat status {};
  if (fstat(file.get(), &status) == 0 && status.st_size == 0)
    lines = fmt::format("{}{}{}", kSignature, held.terms.earlier_version ? fmt::format("{}{}\n", kBy, kEarlier) : "",
                        lines);
  append_text(held.root, file, lines);
  held.record.exists = true;
  held.record.commands.insert(held.command);
}

struct Registry {
  std::mutex mutex;
  std::vector<std::shared_ptr<HeldRecord>> held;
};

Registry& registry() {
  static Registry all;
  return all;
}

/// A place in a folder that a command holds.
struct HeldPlace {
  std::shared_ptr<HeldRecord> folder;  ///< Null outside all of them.
  std::string path;                    ///< Below the folder.
};

/// Call with the registry's lock. Throws InvalidInput for a path that leads out of its folder through a link.
HeldPlace held_place(const fs::path& file) {
  const Registry& all = registry();
  if (all.held.empty()) return {};
  const fs::path given = normal(file);
  std::error_code ignored;
  const fs::path real = fs::weakly_canonical(given.parent_path(), ignored) / given.filename();
  HeldPlace place;
  std::shared_ptr<HeldRecord> left;
  for (const auto& held : all.held) {
    if (is_below(real, held->root) && real != held->root) {
      if (!place.folder || is_below(held->root, place.folder->root)) place.folder = held;
    } else if (is_below(given, held->given) && given != held->given) {
      left = held;
    }
  }
  if (!place.folder && left)
    throw InvalidInput("{}: a link leads out of the folder of the results; remove the link, or give another --out",
                       file.string());
  if (place.folder) place.path = real.lexically_relative(place.folder->root).string();
  return place;
}

const std::vector<RecordedFile>* statements_on(const HeldPlace& place) {
  const auto found = place.folder->record.files.find(place.path);
  return found == place.folder->record.files.end() ? nullptr : &found->second;
}

/// Returns the last statement on a file with this content; nullptr: its content is on no list.
const RecordedFile* statement_on(const HeldPlace& place, int descriptor) {
  const std::vector<RecordedFile>* statements = statements_on(place);
  if (statements == nullptr) return nullptr;
  const std::string hash = hash_of(descriptor);
  const auto found = std::find_if(statements->rbegin(), statements->rend(),
                                  [&](const RecordedFile& statement) { return statement.sha256 == hash; });
  return found == statements->rend() ? nullptr : &*found;
}

Standing standing_at(const HeldPlace& place, const fs::path& file) {
  struct stat status {};
  if (lstat(file.c_str(), &status) != 0) return Standing::absent;
  if (is_input(file)) return Standing::input;
  if (!place.folder || statements_on(place) == nullptr) return Standing::foreign;
  const std::optional<Reached> reached = reach(place.folder->root, place.path);
  if (!reached) return Standing::foreign;
  const RecordedFile* statement = statement_on(place, reached->file.get());
  if (statement == nullptr) return Standing::changed;
  if (statement->command != place.folder->command) return Standing::other;
  return statement->whole ? Standing::result : Standing::unfinished;
}

/// Removes one file of a held folder and the folders that it leaves empty. Keeps a file that is no unchanged result.
void remove_recorded(HeldRecord& held, const HeldPlace& place) {
  const std::optional<Reached> reached = reach(held.root, place.path);
  if (!reached || is_input(reached->status)) return;
  if (statement_on(place, reached->file.get()) == nullptr) {
    held.kept.insert(place.path);
    return;
  }
  if (unlinkat(reached->parent.get(), fs::path(place.path).filename().c_str(), 0) != 0) return;
  held.written.erase(place.path);
  held.record.files.erase(place.path);
  for (fs::path empty = fs::path(place.path).parent_path(); !empty.empty(); empty = empty.parent_path())
    if (rmdir((held.root / empty).c_str()) != 0) return;  // a link is no folder to rmdir
}

void remove_where(const fs::path& folder, const std::function<bool(const HeldRecord&, const std::string&)>& goes) {
  Registry& all = registry();
  const std::scoped_lock lock(all.mutex);
  std::error_code ignored;
  const fs::path root = fs::weakly_canonical(normal(folder), ignored);
  for (const auto& held : all.held) {
    if (held->root != root) continue;
    std::vector<std::string> paths;
    for (const auto& [path, statements] : held->record.files)
      if (statements.back().command == held->command && goes(*held, path)) paths.push_back(path);
    for (const std::string& path : paths) remove_recorded(*held, {held, path});
  }
}

std::string head_of(int descriptor) {
  std::string head(kHead, '\0');
  const ssize_t got = pread(descriptor, head.data(), head.size(), 0);
  head.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return head;
}

std::string head_of(const HeldPlace& place) {
  const std::optional<Reached> reached = reach(place.folder->root, place.path);
  return reached ? head_of(reached->file.get()) : "";
}

/// Returns what two results of one tool have in common: the title of a table in OpenSim's form, or the first two
/// elements of an XML document, the second with its name. Empty for any other file.
std::string begin_of(std::string_view head) {
  if (!trim(head).starts_with('<'))
    return head.find("endheader") == std::string_view::npos ? "" : std::string(trim(head.substr(0, head.find('\n'))));
  std::string begin;
  for (std::size_t at = head.find('<'), tags = 0; at != std::string_view::npos && tags < 2;
       at = head.find('<', at + 1)) {
    const std::string_view tag = head.substr(at + 1, head.find('>', at) - at - 1);
    if (tag.starts_with('?') || tag.starts_with('!')) continue;
    const std::size_t name = tag.find("name=");
    begin += fmt::format("<{}", tag.substr(0, tag.find_first_of(" \t\r\n/")));
    if (++tags == 2 && name != std::string_view::npos)
      begin += fmt::format(" {}", tag.substr(name, tag.find_first_of("\"'", name + 6) - name));
  }
  return begin;
}

/// Returns true if a file must be moved aside before a result takes its place. Throws InvalidInput if no result may.
bool must_move(const HeldPlace& place, const fs::path& file) {
  const Standing standing = standing_at(place, file);
  if (standing == Standing::input)
    throw InvalidInput("{} is an input of this command and would be replaced by its result; give another --out",
                       file.string());
  if (!place.folder) return false;
  const RecordTerms& terms = place.folder->terms;
  const auto refuse = [&](const std::string& what) {
    throw InvalidInput("{} {}, and a result of this command would replace it; move it elsewhere, or give another --out",
                       file.string(), what);
  };
  if (standing == Standing::other)
    refuse(fmt::format("is a result of `myoid {}`", statements_on(place)->back().command));
  if (standing == Standing::foreign) {
    if (terms.replaces_alike && !begin_of(head_of(place)).empty()) return false;
    if (!terms.earlier_version) refuse("is no result that this program recorded");
    return true;
  }
  return standing == Standing::changed && !terms.replaces_changed;
}

/// Moves a file into the folder `kept-N`, N the first that is free.
void move_aside(HeldRecord& held, const std::string& path) {
  std::error_code error;
  for (int n = 1; held.aside.empty(); ++n) {
    const fs::path folder = held.root / fmt::format("kept-{}", n);
    if (!fs::exists(fs::symlink_status(folder, error))) held.aside = folder;
  }
  const fs::path place = held.aside / path;
  fs::create_directories(place.parent_path(), error);
  if (!error) fs::rename(held.root / path, place, error);
  if (error)
    throw InvalidInput("{} was changed since this program wrote it, and cannot be moved to {}: {}",
                       (held.root / path).string(), place.string(), error.message());
  held.moved.insert(path);
}

std::string list_of(const std::set<std::string>& paths) {
  constexpr std::size_t kShown = 5;
  std::vector<std::string> shown(paths.begin(),
                                 std::next(paths.begin(), static_cast<std::ptrdiff_t>(std::min(kShown, paths.size()))));
  if (paths.size() > kShown) shown.push_back(fmt::format("{} more", paths.size() - kShown));
  return fmt::format("{}", fmt::join(shown, ", "));
}

/// Replaces the list of a folder by a new one, under the lock of the old.
void replace_record(const HeldRecord& held, const OpenFile& locked) {
  RecordContent now = parse_record(content_of(locked.get()).value_or(""));
  struct stat status {};
  std::erase_if(now.files, [&](const auto& entry) {
    return !held.written.contains(entry.first) && lstat((held.root / entry.first).c_str(), &status) != 0;
  });
  for (auto& [path, statements] : now.files) {
    for (RecordedFile& statement : statements)
      statement.whole = statement.whole || (held.terms.alone && statement.command == held.command);
  }
  for (const auto& [path, hash] : held.written) now.files[path] = {{hash, held.command, true}};
  now.commands.insert(held.command);
  if (now.files.empty() && !held.is_signed) {
    unlink((held.root / kRecordFile).c_str());
    return;
  }
  std::string name = (held.root / fmt::format(".{}{}{}", kRecordFile, kTemporaryMark, kTemporaryRandom)).string();
  const OpenFile file(mkostemp(name.data(), O_CLOEXEC));
  struct stat old {};
  if (!file || fstat(locked.get(), &old) != 0 || fchmod(file.get(), old.st_mode & 07777) != 0) return;
  try {
    append_text(held.root, file, record_text(now));
    if (rename(name.c_str(), (held.root / kRecordFile).c_str()) != 0) unlink(name.c_str());
  } catch (const InvalidInput&) {  // the longer list holds the same
    unlink(name.c_str());
  }
}

}  // namespace

RecordedFolder::RecordedFolder(const fs::path& folder, std::string command, RecordTerms terms)
    : held_(std::make_shared<HeldRecord>()) {
  std::error_code ignored;
  held_->given = normal(folder);
  held_->root = fs::weakly_canonical(held_->given, ignored);
  held_->command = std::move(command);
  held_->terms = std::move(terms);
  held_->record = read_record(held_->root);
  held_->is_new = !held_->record.exists;
  if (held_->record.exists) held_->terms.earlier_version = is_signed_by(kEarlier);
  Registry& all = registry();
  const std::scoped_lock lock(all.mutex);
  all.held.push_back(held_);
}

RecordedFolder::~RecordedFolder() {
  Registry& all = registry();
  const std::scoped_lock lock(all.mutex);
  std::erase(all.held, held_);
  if (held_->is_new && held_->record.exists && !held_->is_signed && !holds_content(held_->root))
    unlink((held_->root / kRecordFile).c_str());
}

bool RecordedFolder::is_signed() const { return held_->record.exists; }

bool RecordedFolder::is_signed_by(std::string_view command) const {
  return held_->record.commands.contains(std::string(command));
}

void RecordedFolder::sign() {
  const std::scoped_lock lock(registry().mutex);
  held_->is_signed = true;
  if (is_signed_by(held_->command)) return;
  append_to_record(*held_, fmt::format("{}{}\n", kBy, held_->command));
}

void RecordedFolder::finish() {
  const std::scoped_lock lock(registry().mutex);
  if (!held_->record.exists) return;
  replace_record(*held_, open_record(held_->root));
  for (const auto& [path, hash] : held_->written) held_->record.files[path] = {{hash, held_->command, true}};
}

std::vector<std::string> RecordedFolder::take_notes() {
  const std::scoped_lock lock(registry().mutex);
  std::vector<std::string> notes;
  const auto add = [&](std::set<std::string>& paths, std::string_view which, const std::string& fate) {
    if (!paths.empty())
      notes.push_back(fmt::format("note: {}: {} {} {} {}: {}", held_->given.string(), counted(paths.size(), "file"),
                                  which, paths.size() == 1 ? "is" : "are", fate, list_of(paths)));
    paths.clear();
  };
  for (const std::string& path : held_->moved) held_->kept.erase(path);
  add(held_->moved, "that this program did not write, or that changed since,", "moved to " + held_->aside.string());
  add(held_->kept, "that changed after this program wrote the results", "kept");
  add(held_->left, "of another program", "left as found");
  return notes;
}

Standing standing_of(const fs::path& file) {
  const std::scoped_lock lock(registry().mutex);
  return standing_at(held_place(file), file);
}

std::string author_of(const fs::path& file) {
  const RecordContent record = read_record(file.parent_path().empty() ? "." : file.parent_path());
  const auto found = record.files.find(file.filename().string());
  return found == record.files.end() ? "" : found->second.back().command;
}

void remove_results(const fs::path& folder, const std::set<std::string>& kept) {
  remove_where(folder, [&](const HeldRecord&, const std::string& path) { return !kept.contains(path); });
}

void remove_earlier_results(const fs::path& folder) {
  remove_where(folder, [](const HeldRecord& held, const std::string& path) { return !held.written.contains(path); });
}

void remove_result(const fs::path& file) {
  const std::scoped_lock lock(registry().mutex);
  const HeldPlace place = held_place(file);
  if (!place.folder) return;
  const Standing standing = standing_at(place, file);
  if (standing == Standing::result || standing == Standing::unfinished) remove_recorded(*place.folder, place);
}

std::optional<std::string> recorded_content(const fs::path& file) {
  const std::scoped_lock lock(registry().mutex);
  const HeldPlace place = held_place(file);
  if (!place.folder || statements_on(place) == nullptr) return std::nullopt;
  const std::optional<Reached> reached = reach(place.folder->root, place.path);
  if (!reached) return std::nullopt;
  const RecordedFile* statement = statement_on(place, reached->file.get());
  if (statement == nullptr || statement->command != place.folder->command) return std::nullopt;
  return content_of(reached->file.get());
}

void write_unless_foreign(const fs::path& file, std::string_view content) {
  {
    const std::scoped_lock lock(registry().mutex);
    const HeldPlace place = held_place(file);
    if (place.folder && standing_at(place, file) == Standing::foreign) {
      place.folder->left.insert(place.path);
      return;
    }
  }
  write_file(file, content);
}

void require_replaceable(const fs::path& file) {
  const std::scoped_lock lock(registry().mutex);
  (void)must_move(held_place(file), file);
}

void make_way(const fs::path& file) {
  const std::scoped_lock lock(registry().mutex);
  const HeldPlace place = held_place(file);
  if (must_move(place, file)) move_aside(*place.folder, place.path);
}

void record_file(const fs::path& file, int descriptor) {
  HeldPlace place;
  {
    const std::scoped_lock lock(registry().mutex);
    place = held_place(file);
  }
  if (!place.folder) return;
  const std::string hash = hash_of(descriptor);
  if (hash.empty()) throw InvalidInput("{}: cannot be read back: {}", file.string(), std::strerror(errno));
  const std::scoped_lock lock(registry().mutex);
  HeldRecord& held = *place.folder;
  if (held.terms.replaces_alike && standing_at(place, file) == Standing::foreign &&
      begin_of(head_of(place)) != begin_of(head_of(descriptor)))
    throw InvalidInput("{} begins unlike the result that would replace it; move it elsewhere, or give another --out",
                       file.string());
  append_to_record(held, fmt::format("{}{}{}\n{}", kBy, held.command, kUnfinished, record_line(hash, place.path)));
  held.record.files[place.path].push_back({hash, held.command, false});
  held.written[place.path] = hash;
}

}  // namespace myoid::inline ground
