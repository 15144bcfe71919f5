// A seeded generator damages over two hundred good files. Each number that a reader gives must be
// the written one, missing values must be noted, and an error must name the file.

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/recording/anc_reader.h"
#include "myoid/recording/c3d/c3d_reader.h"
#include "myoid/recording/c3d/c3d_signals.h"
#include "myoid/recording/c3d/c3d_writer.h"
#include "myoid/recording/edf_reader.h"
#include "myoid/recording/makers/emg_table.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/recording/trc_reader.h"

#include "tests/support/repair_lines.h"
#include "tests/support/whole_c3d.h"

namespace myoid::recording {
namespace {

struct Content {
  Eigen::VectorXd time_s;
  Eigen::MatrixXd values;
  std::vector<Repair> repairs;
};

Content of(const TimeSeries& series, std::vector<Repair> repairs) {
  return {series.time_s(), series.values(), std::move(repairs)};
}

Content of(const MarkerSeries& markers, std::vector<Repair> repairs) {
  return {markers.time_s, markers.positions_m, std::move(repairs)};
}

/// A kind of file: a good one and its reader.
struct Kind {
  std::string name;
  std::string good;
  std::function<Content(const std::string&)> read;
  bool is_text = true;
  bool says_its_rows = true;  ///< Otherwise rows lost at the end cannot be known.
};

int damaged_files = 0;

/// A number must be the one written for that instant in its column; anything missing must be noted.
void examine(const Kind& kind, const std::string& bytes, const std::string& what) {
  ++damaged_files;
  SCOPED_TRACE(kind.name + ", " + what);
  const Content good = kind.read(kind.good);
  Content found;
  try {
    found = kind.read(bytes);
  } catch (const ReadError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("f.", 0), 0U) << error.what();
    return;
  } catch (const std::exception& error) {
    ADD_FAILURE() << "not a ReadError: " << error.what();
    return;
  }
  const double slack = 1e-9 * (good.time_s[1] - good.time_s[0]);
  bool less =
      (kind.says_its_rows && found.time_s.size() != good.time_s.size()) || found.values.cols() != good.values.cols();
  for (Eigen::Index i = 0, g = 0; i < found.time_s.size(); ++i) {
    while (g < good.time_s.size() && good.time_s[g] < found.time_s[i] - slack) ++g;
    if (g == good.time_s.size() || std::abs(good.time_s[g] - found.time_s[i]) > slack) {
      EXPECT_FALSE(found.repairs.empty()) << "an instant nobody wrote: " << found.time_s[i];
      return;
    }
    for (Eigen::Index c = 0; c < std::min(found.values.cols(), good.values.cols()); ++c) {
      const double value = found.values(i, c);
      const double written = good.values(g, c);
      if (std::isnan(value)) {
        less = less || !std::isnan(written);
      } else {
        if (i + 1 == found.time_s.size() && test::repair_lines(found.repairs).find(kLastRowKept) != std::string::npos)
          continue;  // the only row, noted as doubtful
        ASSERT_NEAR(value, written, 1e-12 * std::abs(written))
            << "row " << i << ", column " << c << "; said: " << test::repair_lines(found.repairs);
      }
    }
  }
  if (less) {
    EXPECT_FALSE(found.repairs.empty()) << "less than was written, without a word";
  }
}

constexpr int kRows = 40;

std::string number(std::mt19937_64& engine) {
  return fmt::format("{:.4f}", static_cast<double>(engine() % 2000000) / 1000.0 - 1000.0 + 0.00037);
}

std::vector<Kind> kinds() {
  std::mt19937_64 engine(20261121);
  std::vector<Kind> list;
  const auto rows = [&](int columns, char separator, bool frame, double dt, bool comma = false) {
    std::string text;
    for (int i = 0; i < kRows; ++i) {
      if (frame) text += fmt::format("{}{}", i + 1, separator);
      text += fmt::format("{:.3f}", dt * i);
      for (int c = 0; c < columns; ++c) text += separator + number(engine);
      text += '\n';
    }
    if (comma) std::replace(text.begin(), text.end(), '.', ',');
    return text;
  };
  list.push_back({"trc",
                  "PathFileType\t4\t(X/Y/Z)\tf.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\t"
                  "Units\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n100\t100\t40\t3\tmm\t"
                  "100\t1\t40\nFrame#\tTime\ta\t\t\tb\t\t\tc\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\tX3\t"
                  "Y3\tZ3\n\n" +
                      rows(9, '\t', true, 0.01),
                  [](const std::string& t) {
                    MarkerFile f = parse_trc(t, "f.trc");
                    return of(f.markers, f.repairs);
                  }});
  const auto storage = [](const char* path) {
    return [path](const std::string& t) {
      Storage f = parse_storage(t, path);
      return of(f.data, f.repairs);
    };
  };
  list.push_back(
      {"storage 1",
       "x\nversion=1\nnRows=40\nnColumns=4\ninDegrees=no\n\nendheader\ntime\ta\tb\tc\n" + rows(3, '\t', false, 0.01),
       storage("f.sto")});
  list.push_back(
      {"storage 0",
       "name x\ndatacolumns 3\ndatarows 40\nrange 0 0.39\nendheader\ntime\ta\tb\n" + rows(2, '\t', false, 0.01),
       storage("f.mot")});
  list.push_back(
      {"storage 3",
       "DataType=double\nversion=3\nOpenSimVersion=4.5\nendheader\ntime\ta\tb\n" + rows(2, '\t', false, 0.01),
       storage("f.sto"), true, false});
  const auto table = [](const std::string& t) {
    CsvSeries f = parse_emg_table(t, "f.csv");
    if (std::find(f.has_unit.begin(), f.has_unit.end(), false) != f.has_unit.end())
      throw ReadError("f.csv", 0, "the unit is not stated");  // as read_emg does
    return of(f.data, f.repairs);
  };
  list.push_back({"table", "time,E1 [mV],E2 [mV]\n" + rows(2, ',', false, 0.001), table, true, false});
  list.push_back({"comma decimals", "time;E1 [mV];E2 [mV]\n" + rows(2, ';', false, 0.001, true), table, true, false});
  list.push_back(
      {"export",
       "Lab export\nSampling rate: 1000 Hz\n\nFrame\tTime\tE1\tE2\n\ts\tmV\tmV\n" + rows(2, '\t', true, 0.001), table,
       true, false});
  std::string counts;
  for (int i = 0; i < kRows; ++i)
    counts += fmt::format("{:.3f}\t{}\t{}\n", 0.001 * i, engine() % 4000, engine() % 4000);
  list.push_back({"anc",
                  "File_Type:\tAnalog R/C ASCII\nTrial_Name:\tt\tDuration(Sec.):\t0.040\t"
                  "#Channels:\t2\nBitDepth:\t12\tPreciseRate:\t1000\n\nName\ta\tb\nRate\t1000\t"
                  "1000\nRange\t1000\t1000\n" +
                      counts,
                  [](const std::string& t) {
                    AncFile f = parse_anc(t, "f.anc");
                    return of(f.data, f.repairs);
                  }});
  const auto bytes = [](const std::string& t) { return std::as_bytes(std::span(t.data(), t.size())); };
  for (const bool integer : {false, true}) {
    C3dFile file;
    file.point_rate_hz = 100.0;
    file.point_unit = "mm";
    file.point_labels = {"A", "B"};
    file.points.resize(kRows, 8);
    file.analog_per_frame = 2;
    file.analog.resize(2 * kRows, 2);
    for (int c = 0; c < 2; ++c) file.channels.push_back({c == 0 ? "E" : "F", "V", 0.0, 0.5});
    const auto step = [&] { return static_cast<float>(static_cast<int>(engine() % 2000) + 1); };
    for (Eigen::Index i = 0; i < file.points.size(); ++i) file.points.data()[i] = i % 4 == 3 ? 0.0F : 0.1F * step();
    for (Eigen::Index i = 0; i < file.analog.size(); ++i) file.analog.data()[i] = step();
    const auto made = format_c3d(file, {C3dProcessor::intel, integer});
    list.push_back({integer ? "c3d integer" : "c3d real",
                    std::string(reinterpret_cast<const char*>(made.data()), made.size()),
                    [bytes](const std::string& t) {
                      C3dFile f = parse_c3d(bytes(t), "f.c3d");
                      std::vector<Repair> repairs = f.repairs;
                      try {
                        return of(c3d_markers(f, repairs), repairs);
                      } catch (const InvalidInput& error) {
                        throw ReadError("f.c3d", 0, error.what());
                      }
                    },
                    false});
  }
  const auto pad = [](std::string text, std::size_t n) { return text.append(n - text.size(), ' '); };
  std::string edf = pad("0", 8) + pad("X", 80) + pad("Startdate X", 80) + "01.01.2520.00.00" + pad("512", 8) +
                    pad("", 44) + pad("4", 8) + pad("1", 8) + pad("1", 4) + pad("EMG", 16) + pad("", 80) +
                    pad("uV", 8) + pad("-100", 8) + pad("100", 8) + pad("-32768", 8) + pad("32767", 8) + pad("", 80) +
                    pad("10", 8) + pad("", 32);
  for (int i = 0; i < 80; ++i) edf += static_cast<char>(engine() % 100);
  list.push_back({"edf", edf,
                  [bytes](const std::string& t) {
                    EdfFile f = parse_edf(bytes(t), "f.edf");
                    return of(f.data.series(), f.repairs);
                  },
                  false});
  return list;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

std::string joined(const std::vector<std::string>& lines, const std::string& end = "\n") {
  std::string text;
  for (const std::string& line : lines) text += line + end;
  return text;
}

TEST(DamagedFiles, TheGoodOnesAreRead) {
  for (const Kind& kind : kinds()) {
    SCOPED_TRACE(kind.name);
    const Content good = kind.read(kind.good);
    EXPECT_EQ(good.time_s.size(), kRows);
    EXPECT_TRUE(good.values.allFinite());
  }
}

TEST(DamagedFiles, NoneGivesAWrongNumberInSilence) {
  std::mt19937_64 engine(4);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(engine() % n); };
  damaged_files = 0;
  for (const Kind& kind : kinds()) {
    for (int k = 0; k < 8; ++k) {
      const std::size_t length = 1 + below(kind.good.size() - 1);
      examine(kind, kind.good.substr(0, length), fmt::format("cut after {} bytes", length));
    }
    // The end of a file is where a cut is hardest to see.
    for (std::size_t less = 1; less <= 6; ++less)
      examine(kind, kind.good.substr(0, kind.good.size() - less), fmt::format("{} bytes less", less));
    if (!kind.is_text) {
      examine(kind, std::string(700, '\x55'), "garbage");
      examine(kind, kind.good.substr(0, 256) + std::string(256, '\0') + kind.good.substr(512),
              "half of the header is zero");
      continue;
    }
    const std::vector<std::string> lines = lines_of(kind.good);
    const std::size_t first = lines.size() - kRows;
    const auto row = [&] { return first + 1 + below(kRows - 3); };
    const char separator = lines.back().find('\t') != std::string::npos  ? '\t'
                           : lines.back().find(';') != std::string::npos ? ';'
                                                                         : ',';
    const auto with_row = [&](std::size_t n, const std::string& text) {
      std::vector<std::string> changed = lines;
      changed[n] = text;
      return joined(changed);
    };
    const auto with_last_cell = [&](std::size_t n, const std::string& cell) {
      return with_row(n, lines[n].substr(0, lines[n].rfind(separator) + 1) + cell);
    };
    examine(kind, joined(lines, "\r\n"), "CRLF");
    examine(kind, joined(lines, "\r"), "CR");
    examine(kind, "\xEF\xBB\xBF" + kind.good, "byte-order mark");
    examine(kind, joined(lines, std::string(3, separator) + "\n"), "separators at the ends");
    examine(kind, joined(lines, "\n\n"), "empty lines");
    for (const char* cell : {"", "NaN", "nan", "1.2.3", "--", "#DIV/0!", "1e999", "-", "0x1F", "x"}) {
      const std::size_t n = row();
      examine(kind, with_last_cell(n, cell), fmt::format("a cell is '{}'", cell));
    }
    std::vector<std::string> changed = lines;
    std::swap(changed[row()], changed[first]);
    examine(kind, joined(changed), "two rows swapped: time decreases");
    changed = lines;
    changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(first + 5), lines[first + 5]);
    examine(kind, joined(changed), "a row twice");
    changed = lines;
    changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(lines.size() - 7), changed.end());
    examine(kind, joined(changed), "seven rows lost at the end");
    examine(kind, with_row(row(), std::string("\x01\x02\xFF\xFE garbage \x80", 14)), "garbage row");
    examine(kind, with_row(row(), lines[row()] + separator + "7.5"), "a row with a cell too many");
    const std::size_t n = row();
    examine(kind, with_row(n, lines[n].substr(lines[n].find(separator) + 1)), "a first cell lost");
    examine(kind, joined({lines.begin() + static_cast<std::ptrdiff_t>(first), lines.end()}), "no header");
    for (std::size_t h = 0; h < first; ++h) {
      changed = lines;
      changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(h));
      examine(kind, joined(changed), fmt::format("line {} of the header lost", h + 1));
    }
    for (const std::string count : {"40", "3", "2"}) {  // counts in the header
      for (std::size_t h = 0; h < first; ++h) {
        const std::size_t at = lines[h].find(count);
        if (at == std::string::npos) continue;
        changed = lines;
        changed[h].replace(at, count.size(), "17");
        examine(kind, joined(changed), fmt::format("'{}' of line {} is '17'", count, h + 1));
      }
    }
    std::string flipped = kind.good;
    for (int k = 0; k < 8; ++k) {  // in the labels and the header, which hold no sample
      const std::size_t at = below(kind.good.size() - kind.good.size() / 2);
      if (at > kind.good.find(lines[first])) continue;
      std::string text = kind.good;
      text[at] = static_cast<char>(text[at] ^ static_cast<char>(1U << below(7)));
      examine(kind, text, fmt::format("bit flipped in byte {}", at));
    }
  }
  EXPECT_GE(damaged_files, 200);
  RecordProperty("damaged_files", damaged_files);
}

}  // namespace
}  // namespace myoid::recording
