#include "tests/damage/commands.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <thread>

#include <fmt/format.h>

#include "myoid/ground/files/atomic_file.h"

#include "tests/pipeline/program.h"
#include "tests/support/temporary_folder.h"

namespace myoid::damage {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif
constexpr std::uint64_t kMemory_bytes = std::uint64_t{2} << 30U;
constexpr unsigned kTime_s = 20;

std::vector<std::vector<std::string>> commands_on(const std::string& file, const std::filesystem::path& folder) {
  return {{"info", file},
          {"info", "--json", file},
          {"check", file},
          {"convert", file, folder / "converted"},
          {"emg", file, "--unit", "mV", "--out", folder / "activation.sto"}};
}

/// Empty, or how a command broke its promise.
std::string broken_promise(const test::Finished& finished) {
  if (finished.exit_code != 0 && finished.exit_code != 3) return fmt::format("ends with {}", finished.exit_code);
  if (finished.exit_code == 3 && finished.err.empty() && finished.out.empty()) return "refuses and does not say why";
  if (!kSanitized && finished.most_memory_bytes > kMemory_bytes)
    return fmt::format("takes {} MB", finished.most_memory_bytes >> 20U);
  return "";
}

}  // namespace

CommandRuns run_commands(const std::vector<Variant>& variants) {
  const test::Limits limits{.memory_bytes = kSanitized ? 0 : kMemory_bytes, .time_s = kTime_s};
  CommandRuns all;
  std::mutex mutex;
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < variants.size(); i = next++) {
      if (kSanitized && i % 8 != 0) continue;
      const Variant& variant = variants[i];
      const test::TemporaryFolder folder;
      const std::filesystem::path path = folder / variant.kind->file;
      write_file(path, variant.file.bytes);
      for (const auto& command : commands_on(path.string(), folder.path())) {
        const test::Finished finished = test::myoid(command, 0.0, "", limits);
        const std::string broken = broken_promise(finished);
        const std::lock_guard lock(mutex);
        ++all.runs;
        all.most_memory_mb = std::max(all.most_memory_mb, static_cast<double>(finished.most_memory_bytes) / 1e6);
        if (!broken.empty())
          all.failures.push_back(fmt::format("{}, {}, {}: myoid {} {}: {}", variant.kind->name, variant.file.what,
                                             variant.file.detail, command[0], broken, finished.err.substr(0, 400)));
      }
    }
  };
  std::vector<std::thread> workers;
  const unsigned count = std::max(1U, std::thread::hardware_concurrency());
  for (unsigned k = 0; k < count; ++k) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
  std::sort(all.failures.begin(), all.failures.end());
  return all;
}

}  // namespace myoid::damage
