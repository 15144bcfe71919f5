// Reading and conversion of large files, made in the temporary folder: bytes of input a second, and
// the most memory that it takes, as a multiple of the file's size. Figures: docs/data/timings.txt.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include "myoid/ground/files/atomic_file.h"
#include "myoid/recording/c3d/c3d_reader.h"
#include "myoid/recording/c3d/c3d_writer.h"
#include "myoid/recording/channel_writer.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/tables/storage_reader.h"

namespace {

namespace fs = std::filesystem;
using namespace myoid;

constexpr double kMegabyte = 1e6;

/// A folder that goes away with the program.
struct Folder {
  fs::path path = fs::temp_directory_path() / fmt::format("myoid_reading_{}", getpid());
  Folder() { fs::create_directories(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code error;
    fs::remove_all(path, error);
  }
};

const fs::path& folder() {
  static const Folder one;
  return one.path;
}

/// 100 MB: 60 markers at 200 Hz, 64 channels at 2 kHz.
fs::path large_c3d(recording::C3dProcessor processor, bool integer) {
  const fs::path path = folder() / fmt::format("{}_{}.c3d", static_cast<int>(processor), integer ? "int" : "real");
  if (fs::exists(path)) return path;
  constexpr Eigen::Index kMarkers = 60;
  constexpr Eigen::Index kChannels = 64;
  recording::C3dFile file;
  file.point_rate_hz = 200.0;
  file.point_unit = "mm";
  file.point_scale = 0.1F;
  file.analog_per_frame = 10;
  const Eigen::Index frames = 100'000'000 / ((4 * kMarkers + 10 * kChannels) * (integer ? 2 : 4));
  for (Eigen::Index m = 0; m < kMarkers; ++m) file.point_labels.push_back(fmt::format("M{}", m));
  for (Eigen::Index c = 0; c < kChannels; ++c) file.channels.push_back({fmt::format("A{}", c), "V", 0.0, 0x1p-10});
  file.points.resize(frames, 4 * kMarkers);
  file.analog.resize(10 * frames, kChannels);
  unsigned state = 1;
  const auto next = [&] {  // any numbers that fill 16 bits
    state = state * 1664525U + 1013904223U;
    return static_cast<float>(static_cast<int>(state >> 16U) - 32768);
  };
  for (Eigen::Index i = 0; i < file.points.size(); ++i) file.points.data()[i] = i % 4 == 3 ? 0.0F : 0.1F * next();
  for (Eigen::Index i = 0; i < file.analog.size(); ++i) file.analog.data()[i] = next();
  recording::write_c3d(path, file, {processor, integer});
  return path;
}

/// 100 MB of 16 columns.
const fs::path& large_storage() {
  static const fs::path path = [] {
    const fs::path file = folder() / "large.sto";
    std::string text = "channels\nversion=1\ninDegrees=no\nendheader\ntime";
    for (int c = 1; c <= 16; ++c) text += fmt::format("\tchannel_{}", c);
    text += '\n';
    unsigned state = 1;
    for (int i = 0; text.size() < 100'000'000; ++i) {
      text += format_number(i / 2000.0);
      for (int c = 0; c < 16; ++c) {
        state = state * 1664525U + 1013904223U;
        text += '\t';
        text += format_number(1e-9 * static_cast<double>(state));
      }
      text += '\n';
    }
    write_file(file, text);
    return file;
  }();
  return path;
}

/// Numbers that spread as EMG does, as many as 16 bits hold: the sum of four uniform ones.
class Counts {
 public:
  int next() {
    int sum = 0;
    for (int k = 0; k < 4; ++k) {
      state_ = state_ * 1664525U + 1013904223U;
      sum += static_cast<int>(state_ >> 18U) - 8192;
    }
    return sum / 4;
  }

 private:
  unsigned state_ = 1;
};

/// 100 MB of EDF: 16 channels at 2 kHz, records of a second.
const fs::path& large_edf() {
  static const fs::path path = [] {
    constexpr int kSignals = 16, kRate = 2000, kRecords = 1530;
    const auto all = [](const std::string& text, std::size_t width) {
      std::string cells;
      for (int s = 0; s < kSignals; ++s) cells += fmt::format("{:<{}}", text, width);
      return cells;
    };
    std::string text = fmt::format("{:<8}{:<80}{:<80}01.01.2520.00.00{:<8}{:<44}{:<8}{:<8}{:<4}", 0, "X", "Startdate X",
                                   256 * (kSignals + 1), "", kRecords, 1, kSignals);
    for (int s = 0; s < kSignals; ++s) text += fmt::format("EMG {:<12}", s);
    text += all("", 80) + all("uV", 8) + all("-3276.8", 8) + all("3276.7", 8) + all("-32768", 8) + all("32767", 8) +
            all("", 80) + all(std::to_string(kRate), 8) + all("", 32);
    Counts counts;
    for (int i = 0; i < kRecords * kSignals * kRate; ++i) {
      const int count = counts.next();
      text += static_cast<char>(count & 0xFF);
      text += static_cast<char>((count >> 8) & 0xFF);
    }
    write_file(folder() / "large.edf", text);
    return folder() / "large.edf";
  }();
  return path;
}

/// 100 MB of a table: 16 columns in millivolts as EMG programs write them.
const fs::path& large_csv() {
  static const fs::path path = [] {
    std::string text = "time";
    for (int c = 1; c <= 16; ++c) text += fmt::format(",channel_{} [mV]", c);
    text += '\n';
    Counts counts;
    for (int i = 0; text.size() < 100'000'000; ++i) {
      text += format_number(i / 2000.0);
      for (int c = 0; c < 16; ++c) text += fmt::format(",{:.5f}", 1e-4 * counts.next());
      text += '\n';
    }
    write_file(folder() / "large.csv", text);
    return folder() / "large.csv";
  }();
  return path;
}

/// The most memory this process had since `forget_peak` [bytes].
double peak_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return 1024.0 * std::stod(line.substr(6));
  }
  return 0.0;
}

void forget_peak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

template <typename Read>
void measure(benchmark::State& state, const fs::path& path, Read&& read) {
  const auto size = static_cast<double>(fs::file_size(path));
  forget_peak();
  const double before = peak_bytes();
  benchmark::DoNotOptimize(read(path));
  state.counters["memory/size"] = (peak_bytes() - before) / size;
  for (auto _ : state) benchmark::DoNotOptimize(read(path));
  state.counters["MB/s"] = benchmark::Counter(size / kMegabyte, benchmark::Counter::kIsIterationInvariantRate);
}

/// Channels into a storage file, as `myoid convert` writes them.
void to_storage(benchmark::State& state, const fs::path& path) {
  measure(state, path, [](const fs::path& in) {
    const recording::Recording recording = recording::read_recording(in);
    recording::write_channels(folder() / "out.sto", rows_of(recording.analog),
                              recording::statement_of(recording.analog.channels(), in));
    return recording.analog.sample_count();
  });
  state.counters["output/size"] =
      static_cast<double>(fs::file_size(folder() / "out.sto")) / static_cast<double>(fs::file_size(path));
}
void c3d_to_storage(benchmark::State& state, bool integer) {
  to_storage(state, large_c3d(recording::C3dProcessor::intel, integer));
}
void edf_to_storage(benchmark::State& state) { to_storage(state, large_edf()); }
void csv_to_storage(benchmark::State& state) { to_storage(state, large_csv()); }
BENCHMARK_CAPTURE(c3d_to_storage, real, false)->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(c3d_to_storage, integer, true)->MeasureProcessCPUTime();
BENCHMARK(edf_to_storage)->MeasureProcessCPUTime();
BENCHMARK(csv_to_storage)->MeasureProcessCPUTime();

void c3d_file(benchmark::State& state, recording::C3dProcessor processor, bool integer) {
  measure(state, large_c3d(processor, integer), recording::read_c3d);
}
BENCHMARK_CAPTURE(c3d_file, intel_real, recording::C3dProcessor::intel, false);
BENCHMARK_CAPTURE(c3d_file, intel_integer, recording::C3dProcessor::intel, true);
BENCHMARK_CAPTURE(c3d_file, dec_real, recording::C3dProcessor::dec, false);
BENCHMARK_CAPTURE(c3d_file, sgi_real, recording::C3dProcessor::sgi, false);

void c3d_recording(benchmark::State& state, bool integer) {
  measure(state, large_c3d(recording::C3dProcessor::intel, integer), recording::read_recording);
}
BENCHMARK_CAPTURE(c3d_recording, real, false);
BENCHMARK_CAPTURE(c3d_recording, integer, true);

/// The same, and all channels as numbers: what `myoid.read(file).analog` of the Python module does.
void c3d_channels(benchmark::State& state) {
  measure(state, large_c3d(recording::C3dProcessor::intel, false), [](const fs::path& path) {
    const recording::Recording recording = recording::read_recording(path);
    return std::pair(recording.analog.series(), recording.markers.frame_count());
  });
}
BENCHMARK(c3d_channels);

void storage(benchmark::State& state) {
  measure(state, large_storage(), [](const fs::path& path) { return recording::read_storage(path); });
}
BENCHMARK(storage);

}  // namespace
