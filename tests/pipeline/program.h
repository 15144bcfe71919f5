#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <sys/types.h>

#include "tests/support/temporary_folder.h"

namespace myoid::test {

/// A protocol: a maximal contraction, and the elbow bent and stretched slowly and fast.
inline constexpr const char* kTwoSpeeds = R"(level = "L1"
[[trial]]
name = "mvc"
kind = "mvc"
direction = "both"
[[trial]]
name = "slow"
kind = "flexion"
frequency_hz = 0.4
centre_deg = 72
amplitude_deg = 45
held_mass_kg = 2.0
duration_s = 8
[[trial]]
name = "fast"
kind = "flexion"
frequency_hz = 0.8
centre_deg = 72
amplitude_deg = 50
held_mass_kg = 1.0
duration_s = 8
)";

/// What a finished program left behind.
struct Finished {
  int exit_code = -1;                   ///< 128 + signal if it was killed.
  std::string out;                      ///< stdout
  std::string err;                      ///< stderr
  std::uint64_t most_memory_bytes = 0;  ///< Resident at once.
};

/// What a program may take; 0 for no limit. Beyond the memory its allocations fail; beyond the time
/// it is killed; a file that becomes longer fails to be written, as on a full disk.
struct Limits {
  std::uint64_t memory_bytes = 0;
  unsigned time_s = 0;
  std::uint64_t file_bytes = 0;
};

/// The built `myoid` with these arguments while it runs, stdin closed; killed with this object.
class Running {
 public:
  /// `environment` holds "NAME=value". With `stdout_to`, stdout goes there and is not read back.
  explicit Running(const std::vector<std::string>& arguments,
                   const std::string& stdout_to = "",
                   const std::vector<std::string>& environment = {},
                   const Limits& limits = {});
  ~Running();
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void send(int signal) const;
  [[nodiscard]] bool ended();
  [[nodiscard]] Finished wait();

 private:
  TemporaryFolder folder_;
  std::string stdout_to_;
  pid_t child_ = 0;
  int status_ = 0;
  std::uint64_t most_memory_bytes_ = 0;
  bool ended_ = false;
};

/// Runs the built `myoid` with these arguments, stdin closed. `interrupt_after_s` > 0 sends SIGINT
/// then. With `stdout_to`, stdout goes there and is not read back.
[[nodiscard]] Finished myoid(const std::vector<std::string>& arguments,
                             double interrupt_after_s = 0.0,
                             const std::string& stdout_to = "",
                             const Limits& limits = {});

[[nodiscard]] std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);

/// Replaces the only occurrence of `from` in a file; throws if there is none.
void replace_in(const std::filesystem::path& file, const std::string& from, const std::string& to);

/// Rows of a .csv file, each a map from the header's names. Quoted cells may hold commas.
using Row = std::map<std::string, std::string>;
[[nodiscard]] std::vector<Row> read_rows(const std::filesystem::path& file);

}  // namespace myoid::test
