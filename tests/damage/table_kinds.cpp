#include "tests/damage/table_kinds.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/files/atomic_file.h"

namespace myoid::damage {
namespace {

namespace fs = std::filesystem;

/// Channels of all clocks over the instants of all of them: no number where a clock has no sample.
void add_channels(const recording::Recording& file, Content& content) {
  std::vector<TimeSeries> clocks{file.analog.series()};
  for (const AnalogChannels& other : file.other_clocks) clocks.push_back(other.series());
  std::set<double> instants;
  for (const TimeSeries& clock : clocks) instants.insert(clock.time_s().begin(), clock.time_s().end());
  content.time_s.assign(instants.begin(), instants.end());
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (const TimeSeries& clock : clocks) {
    for (Eigen::Index c = 0; c < clock.channel_count(); ++c) {
      std::vector<double> column(content.time_s.size(), kNone);
      for (Eigen::Index i = 0; i < clock.sample_count(); ++i) {
        const auto at = std::lower_bound(content.time_s.begin(), content.time_s.end(), clock.time_s()[i]);
        column[static_cast<std::size_t>(at - content.time_s.begin())] = clock.values()(i, c);
      }
      content.numbers[clock.channels()[static_cast<std::size_t>(c)].name] = std::move(column);
    }
  }
}

/// Markers by the door of `info` and `check`; a table that is taken for one of channels gives these.
Content read_table_markers(const fs::path& path) {
  const recording::Recording file = recording::read_recording(path);
  Content content;
  content.time_s = {file.markers.time_s.begin(), file.markers.time_s.end()};
  for (std::size_t m = 0; m < file.markers.names.size(); ++m) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto column = file.markers.positions_m.col(static_cast<Eigen::Index>(3 * m) + axis);
      content.numbers[file.markers.names[m] + "." + "xyz"[axis]] = {column.begin(), column.end()};
    }
  }
  if (content.numbers.empty()) add_channels(file, content);
  add_notes(file.repairs, content);
  return content;
}

/// Makes tables of numbers that are never 0, with four decimals.
class TableMaker {
 public:
  /// `lead` gives the cells before the numbers of a row, with their separators.
  std::string rows(int columns, char separator, const std::function<std::string(int)>& lead) {
    std::string text;
    for (int i = 0; i < kRows; ++i) {
      text += lead(i);
      for (int c = 0; c < columns; ++c) text += (c == 0 ? "" : std::string(1, separator)) + number();
      text += '\n';
    }
    return text;
  }
  std::string number() {
    return fmt::format("{:.4f}", static_cast<double>(engine_() % 2000000) / 1000.0 - 1000.0 + 0.00037);
  }

 private:
  std::mt19937_64 engine_{20261122};
};

using Lead = std::function<std::string(int)>;

Lead frame_of(char separator) {
  return [separator](int i) { return fmt::format("{}{}", i + 1, separator); };
}

Lead frame_and_time(char separator, int first, double interval_s) {
  return [=](int i) { return fmt::format("{}{}{:.5f}{}", i + first, separator, interval_s * i, separator); };
}

/// A kind of table: `head` ends where its rows begin. `info` describes a table of text, too, so that `check` is asked.
Kind table(std::string name,
           std::string file,
           const std::string& head,
           const std::string& rows,
           std::function<Content(const fs::path&)> read) {
  Kind kind{std::move(name), std::move(file), head + rows, Shape::table, std::move(read), {"check"}};
  kind.first_row = static_cast<std::size_t>(std::count(head.begin(), head.end(), '\n'));
  return kind;
}

Kind with_columns(
    Kind kind, std::size_t head_line, std::size_t names_line, std::size_t block, std::vector<std::size_t> clock) {
  kind.columns = Columns{head_line, names_line, block, std::move(clock)};
  return kind;
}

// --- markers ---

void nexus_markers(TableMaker& make, std::vector<Kind>& list) {
  const auto frame = [](int i) { return fmt::format("{},0,", i + 200); };
  Kind kind = table("Nexus trajectories", "f.csv",
                    "Trajectories\n100\n,,P:A,,,P:B,,,P:C,,\nFrame,Sub Frame,X,Y,Z,X,Y,Z,X,Y,Z\n"
                    ",,mm,mm,mm,mm,mm,mm,mm,mm,mm\n",
                    make.rows(9, ',', frame), read_table_markers);
  kind.says_its_rows = false;
  list.push_back(with_columns(std::move(kind), 2, 2, 3, {0}));
}

void qualisys_markers(TableMaker& make, std::vector<Kind>& list) {
  const std::string head =
      "NO_OF_FRAMES\t40\nNO_OF_CAMERAS\t8\nNO_OF_MARKERS\t3\nFREQUENCY\t200\nNO_OF_ANALOG\t0\n"
      "ANALOG_FREQUENCY\t0\nDESCRIPTION\t--\nDATA_INCLUDED\t3D\nMARKER_NAMES\tA\tB\tC\n";
  list.push_back(
      with_columns(table("Qualisys 3D", "f.tsv", head + "Frame\tTime\tA X\tA Y\tA Z\tB X\tB Y\tB Z\tC X\tC Y\tC Z\n",
                         make.rows(9, '\t', frame_and_time('\t', 1, 0.005)), read_table_markers),
                   9, 9, 3, {0, 1}));
  Kind bare = table("Qualisys 3D, no clock", "f.tsv", head, make.rows(9, '\t', [](int) { return std::string(); }),
                    read_table_markers);
  bare.ordered = false;
  list.push_back(std::move(bare));
}

void motive_markers(TableMaker& make, std::vector<Kind>& list) {
  list.push_back(
      with_columns(table("Motive", "f.csv",
                         "Format Version,1.23,Take Name,T,Capture Frame Rate,100.0,Export Frame Rate,100.0,Total "
                         "Exported Frames,40,Length Units,Millimeters,Coordinate Space,Global\n\n"
                         ",,Marker,Marker,Marker,Marker,Marker,Marker,Marker,Marker,Marker\n"
                         ",,A,A,A,B,B,B,C,C,C\n,,101,101,101,102,102,102,103,103,103\n"
                         ",,Position,Position,Position,Position,Position,Position,Position,Position,Position\n"
                         "Frame,Time (Seconds),X,Y,Z,X,Y,Z,X,Y,Z\n",
                         make.rows(9, ',', frame_and_time(',', 0, 0.01)), read_table_markers),
                   2, 3, 3, {0, 1}));
}

void other_markers(TableMaker& make, std::vector<Kind>& list) {
  list.push_back(with_columns(table("BTS points", "f.emt",
                                    "BTS ASCII format\n\nType:\tPoint 3D tracks\nMeasure unit:\tm\n\nTracks:\t3\n"
                                    "Frequency:\t100 Hz\nFrames:\t40\nStart time:\t0.000\n\n"
                                    "Frame\tTime\tA.X\tA.Y\tA.Z\tB.X\tB.Y\tB.Z\tC.X\tC.Y\tC.Z\n",
                                    make.rows(9, '\t', frame_and_time('\t', 1, 0.01)), read_table_markers),
                              10, 10, 3, {0, 1}));
  list.push_back(with_columns(table("NDI", "f.csv",
                                    "Number of frames:,40,Collection frequency:,100,Units:,mm\n"
                                    "Frame,A x,A y,A z,B x,B y,B z,C x,C y,C z\n",
                                    make.rows(9, ',', frame_of(',')), read_table_markers),
                              1, 1, 3, {0}));
}

void bids_motion(TableMaker& make, const fs::path& folder, std::vector<Kind>& list) {
  write_file(folder / "f_channels.tsv",
             "name\tcomponent\ttype\ttracked_point\tunits\nA_x\tx\tPOS\tA\tmm\n"
             "A_y\ty\tPOS\tA\tmm\nA_z\tz\tPOS\tA\tmm\nB_x\tx\tPOS\tB\tmm\n"
             "B_y\ty\tPOS\tB\tmm\nB_z\tz\tPOS\tB\tmm\n");
  write_file(folder / "f_motion.json", "{\"SamplingFrequency\": 100}");
  Kind kind = table("Motion-BIDS", "f_motion.tsv", "", make.rows(6, '\t', [](int) { return std::string(); }),
                    read_table_markers);
  kind.says_its_rows = false;
  kind.ordered = false;
  list.push_back(std::move(kind));
}

// --- channels ---

void nexus_devices(TableMaker& make, std::vector<Kind>& list) {
  const auto frames = [](int i) { return fmt::format("{},{},", 200 + i / 10, i % 10); };
  Kind kind =
      table("Nexus devices", "f.csv", "Devices\n1000\n,,EMG - Voltage,,Load,\nFrame,Sub Frame,BIC,TRI,Fz\n,,mV,mV,N\n",
            make.rows(3, ',', frames), read_channels);
  kind.says_its_rows = false;
  list.push_back(with_columns(std::move(kind), 2, 3, 1, {0, 1}));
}

void qualisys_channels(TableMaker& make, std::vector<Kind>& list) {
  list.push_back(
      with_columns(table("Qualisys analog", "f.tsv",
                         "NO_OF_SAMPLES\t40\nTOTAL_NO_OF_CHANNELS\t3\nFREQUENCY\t2000\nDESCRIPTION\t--\n"
                         "DATA_INCLUDED\tANALOG\nCHANNEL_NAMES\tBIC\tTRI\tBRA\nSAMPLE\tTIME\tBIC\tTRI\tBRA\n",
                         make.rows(3, '\t', frame_and_time('\t', 1, 0.0005)), read_channels),
                   6, 6, 1, {0, 1}));
}

void other_channels(TableMaker& make, std::vector<Kind>& list) {
  list.push_back(with_columns(table("BTS EMG", "f.emt",
                                    "BTS ASCII format\n\nType:\tEmg tracks\nMeasure unit:\tmV\n\nTracks:\t3\n"
                                    "Frequency:\t1000 Hz\nFrames:\t40\n\nFrame\tTime\tBIC\tTRI\tBRA\n",
                                    make.rows(3, '\t', frame_and_time('\t', 1, 0.001)), read_channels),
                              9, 9, 1, {0, 1}));
  Kind biopac = table("BIOPAC", "f.txt",
                      "c:\\trial.acq\n0.5 msec/sample\n3 channels\nBIC\nmV\nTRI\nmV\nBRA\nmV\n"
                      "CH1\tCH2\tCH3\n40\t40\t40\n",
                      make.rows(3, '\t', [](int) { return std::string(); }), read_channels);
  biopac.ordered = false;
  list.push_back(std::move(biopac));
  Kind noraxon = table("Noraxon MR4", "f.csv",
                       "\"type\";\"begin_time\";\"frequency\";\"count\";\"sex\"\n"
                       "\"record\";\"0,00000\";\"2000\";\"40\";\"male\"\n\n"
                       "\"time\";\"Activity\";\"Marker\";\"BIC LT (uV)\";\"TRI LT (uV)\"\n",
                       "", read_channels);
  std::string rows =
      make.rows(2, ';', [](int i) { return fmt::format("{:.5f};{};;", 0.0005 * i, i == 0 ? "\"Activity\"" : ""); });
  std::replace(rows.begin(), rows.end(), '.', ',');
  noraxon.bytes += rows;
  list.push_back(with_columns(std::move(noraxon), 3, 3, 1, {0}));
}

/// Two sensors of wireless electrodes: EMG at twice the rate of an accelerometer, which therefore
/// ends at half of the rows.
std::string packets(TableMaker& make, const std::string& separator, bool times) {
  std::string text;
  for (int i = 0; i < kRows; ++i) {
    const bool slow = i < kRows / 2;
    for (int c = 0; c < 4; ++c) {
      const bool ended = c % 2 == 1 && !slow;
      if (c > 0) text += separator;
      if (times) text += (ended ? "" : fmt::format("{:.6f}", (c % 2 == 0 ? 0.0005 : 0.001) * i)) + separator;
      if (!ended) text += make.number();
    }
    text += '\n';
  }
  return text;
}

void delsys(TableMaker& make, std::vector<Kind>& list) {
  const std::string sensors =
      "Collection Length (seconds):, 0.540000\nEMG 01 (5471), , EMG 02 (5524), \n"
      "sensor mode: 55, , sensor mode: 55, \n";
  Kind old = table("Discover 1.4", "f.csv",
                   "Application:, Trigno Discover (1.4.2)\n" + sensors +
                       "EMG 1 (74Hz), ACC X (37Hz), EMG 2 (74Hz), ACC Y (37Hz), \n",
                   packets(make, ", ", false), read_channels);
  Kind recent = table("Discover 1.7", "f.csv",
                      "Application:, Trigno Discover (1.7.0)\n" + sensors +
                          "EMG 1 (mV), ACC X (G), EMG 2 (mV), ACC Y (G)\n"
                          "74.0741 Hz, 37.0370 Hz, 74.0741 Hz, 37.0370 Hz\n",
                      packets(make, ", ", false), read_channels);
  for (Kind* kind : {&old, &recent}) {
    kind->says_its_rows = false;
    kind->ordered = false;
    list.push_back(std::move(*kind));
  }
  Kind works = table("EMGworks", "f.csv",
                     "X[s],\"Sensor 1: EMG 1\",X[s],\"Sensor 1: ACC.X 1\",X[s],\"Sensor 2: EMG 2\","
                     "X[s],\"Sensor 2: ACC.Y 2\"\n",
                     packets(make, ",", true), read_channels);
  works.says_its_rows = false;
  list.push_back(with_columns(std::move(works), 0, 0, 2, {0}));
}

}  // namespace

void add_notes(const std::vector<Repair>& repairs, Content& content) {
  for (const Repair& r : repairs) content.notes.push_back(recording::to_string(r));
}

Content read_channels(const fs::path& path) {
  const recording::Recording file = recording::read_recording(path);
  Content content;
  add_channels(file, content);
  for (std::size_t i = 0; i < file.events.size(); ++i)
    content.texts[fmt::format("event {}", i)] = fmt::format("at {:.6f} s", file.events[i].time_s);
  add_notes(file.repairs, content);
  return content;
}

std::vector<Kind> good_tables(const fs::path& folder) {
  TableMaker make;
  std::vector<Kind> list;
  nexus_markers(make, list);
  qualisys_markers(make, list);
  motive_markers(make, list);
  other_markers(make, list);
  bids_motion(make, folder, list);
  nexus_devices(make, list);
  qualisys_channels(make, list);
  other_channels(make, list);
  delsys(make, list);
  return list;
}

}  // namespace myoid::damage
