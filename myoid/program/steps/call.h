#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "myoid/ground/core/progress.h"
#include "myoid/ground/core/remark.h"
#include "myoid/ground/files/record_list.h"

/// The commands of the program as functions of the library.
///
/// Each command takes an options struct and gives a result struct: `IkResult ik(const IkOptions&)`.
/// It reads the files that the options name, computes, and returns values; remarks on inputs and
/// results are values too. A second function, `write_ik(result, path)`, writes the files.
/// No function of this room prints, knows an exit code or reads a command line.
/// The room `cli` declares the options, prints the result as text or JSON and derives the exit code
/// from it; a script or a binding to another language calls the same two functions.
///
/// All commands throw InvalidInput (or ReadError, ModelError) for bad input and Interrupted when a
/// stop is requested. Strings that choose among words (`method`, `tendon`), relative paths and the
/// names of options in messages are as on the command line.
namespace myoid::program {

/// Values that every command takes beside its own options.
struct Call {
  std::uint64_t seed = 1;
  std::optional<double> start_s, end_s;  ///< Time of the data in use [s].
  bool overwrite = false;                ///< Replaces existing results.
  bool quiet = false;                    ///< Nobody hears warnings: what only warns is not computed.
  std::string command;                   ///< Written into results as the command that made them.
  Progress progress;
  /// Receives the end of each stage of a run: its work, and its seconds; may be empty.
  std::function<void(std::string_view work, double seconds)> stage_ended = {};
  /// Receives each remark at once, also from a command that throws later; may be empty.
  std::function<void(const Remark&)> listener;
};

/// Collects the remarks of one call, in order.
class Remarks {
 public:
  explicit Remarks(const Call& call) : listener_(call.listener) {}

  void warn(std::string text) { add({.severity = Severity::warning, .says = std::move(text)}); }
  void note(std::string text) { add({.severity = Severity::note, .says = std::move(text)}); }
  void detail(std::string text) { add({.severity = Severity::detail, .says = std::move(text)}); }
  /// Adds the findings of a check on a file or a result; its name goes before each.
  void add(std::vector<Remark> found, const std::string& where) {
    for (Remark& remark : found) {
      remark.where = where;
      remark.says = where + ": " + remark.says;
      add(std::move(remark));
    }
  }
  /// Warns of files of a result folder that were changed since they were written.
  void warn_of_changes(const std::filesystem::path& folder, const std::vector<std::string>& names) {
    for (std::string& text : changed_since_written(folder, names)) warn(std::move(text));
  }
  void add(Remark remark) {
    if (listener_) listener_(remark);
    list_.push_back(std::move(remark));
  }
  [[nodiscard]] const std::vector<Remark>& list() const { return list_; }

 private:
  std::function<void(const Remark&)> listener_;
  std::vector<Remark> list_;
};

}  // namespace myoid::program
