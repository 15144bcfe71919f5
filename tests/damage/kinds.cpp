#include "tests/damage/kinds.h"

#include <algorithm>
#include <initializer_list>
#include <random>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/opensim/run_tool.h"
#include "myoid/recording/c3d/c3d_writer.h"
#include "myoid/recording/emg_reader.h"
#include "myoid/recording/orientation_reader.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/study/read_study.h"
#include "myoid/study/study_text.h"

#include "tests/damage/table_kinds.h"

namespace myoid::damage {
namespace {

namespace fs = std::filesystem;
using ground::Repair;

void add_columns(const TimeSeries& series, Content& content) {
  for (Eigen::Index c = 0; c < series.channel_count(); ++c) {
    const auto column = series.values().col(c);
    content.numbers[series.channels()[static_cast<std::size_t>(c)].name] = {column.begin(), column.end()};
  }
}

Content of_series(const TimeSeries& series, const std::vector<Repair>& repairs) {
  Content content;
  content.time_s = {series.time_s().begin(), series.time_s().end()};
  add_columns(series, content);
  add_notes(repairs, content);
  return content;
}

Content read_markers(const fs::path& path) {
  const recording::MarkerFile file = recording::read_markers(path);
  Content content;
  content.time_s = {file.markers.time_s.begin(), file.markers.time_s.end()};
  for (std::size_t m = 0; m < file.markers.names.size(); ++m) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto column = file.markers.positions_m.col(static_cast<Eigen::Index>(3 * m) + axis);
      content.numbers[file.markers.names[m] + "." + "xyz"[axis]] = {column.begin(), column.end()};
    }
  }
  add_notes(file.repairs, content);
  return content;
}

/// Markers and channels; of a frame's two analog samples each is a column of its own.
Content read_c3d(const fs::path& path) {
  Content content = read_markers(path);
  const recording::Recording file = recording::read_recording(path);
  content.notes.clear();
  add_notes(file.repairs, content);
  const TimeSeries analog = file.analog.series();
  const auto frames = static_cast<Eigen::Index>(content.time_s.size());
  const Eigen::Index ratio = frames > 0 ? analog.sample_count() / frames : 0;
  for (Eigen::Index c = 0; c < analog.channel_count(); ++c) {
    for (Eigen::Index s = 0; s < ratio; ++s) {
      std::vector<double> column;
      for (Eigen::Index k = 0; k < frames; ++k) column.push_back(analog.values()(k * ratio + s, c));
      content.numbers[fmt::format("{}@{}", analog.channels()[static_cast<std::size_t>(c)].name, s)] = std::move(column);
    }
  }
  return content;
}

Content read_emg(const fs::path& path) {
  const recording::EmgFile file = recording::read_emg(path, "", false);
  return of_series(file.data, file.repairs);
}

Content read_storage(const fs::path& path) {
  recording::Storage file = recording::read_storage(path);
  Content content = of_series(file.data, file.repairs);
  content.texts["in degrees"] = file.in_degrees ? "yes" : "no";
  return content;
}

/// The four numbers of each sensor.
Content read_orientations(const fs::path& path) {
  const recording::OrientationSeries file = recording::read_orientations(path);
  Content content;
  content.time_s = {file.time_s.begin(), file.time_s.end()};
  for (Eigen::Index c = 0; c < file.quaternions.cols(); ++c) {
    const auto column = file.quaternions.col(c);
    content.numbers[file.names[static_cast<std::size_t>(c / 4)] + "." + "wxyz"[c % 4]] = {column.begin(), column.end()};
  }
  add_notes(file.repairs, content);
  return content;
}

/// What a model does: masses, muscles, and where markers and paths are in two postures.
Content read_model(const fs::path& path) {
  const body::BodyModel m = body::read_osim(path);
  Content content;
  content.notes = sentences(m.notes);
  content.notes.insert(content.notes.end(), m.unsupported.begin(), m.unsupported.end());
  const auto list = [](const auto& v) { return std::vector<double>(v.begin(), v.end()); };
  content.numbers["gravity"] = list(m.gravity_G);
  for (const auto& c : m.coordinates) {
    content.numbers[c.name] = {c.default_value, c.lower, c.upper};
    content.texts[c.name] = c.locked ? "locked" : "free";
  }
  for (const auto& muscle : m.muscles) {
    const auto& p = muscle.properties;
    content.numbers[muscle.name] = {
        p.max_isometric_force_n,    p.optimal_fiber_length_m, p.tendon_slack_length_m, p.pennation_at_optimal_rad,
        p.max_contraction_velocity, p.active_shape,           p.passive_shape,         p.max_tendon_strain,
        p.max_muscle_strain,        p.concentric_shape,       p.eccentric_plateau,     p.activation_time_s,
        p.deactivation_time_s};
    content.texts[muscle.name] = muscle.class_name + (muscle.applies_force ? "" : ", off");
  }
  body::BodyState state = body::make_state(m);
  for (int posture = 0; posture < 2; ++posture) {
    Eigen::VectorXd q = m.default_q();
    for (Eigen::Index i = 0; i < q.size(); ++i) q[i] += 0.1 * posture * static_cast<double>(i + 1);
    body::compute_poses(m, q, state);
    for (std::size_t i = 0; i < m.markers.size(); ++i)
      content.numbers[fmt::format("{} in {}", m.markers[i].name, posture)] =
          list(Vec3(state.X_GB[static_cast<std::size_t>(m.markers[i].body)] * m.markers[i].p_BM));
    for (std::size_t i = 0; i < m.muscles.size(); ++i)
      content.numbers[fmt::format("length of {} in {}", m.muscles[i].name, posture)] = {
          body::compute_path(m, static_cast<int>(i), state).length_m};
    const Eigen::MatrixXd M = body::mass_matrix(m, q, state);
    content.numbers[fmt::format("inertia in {}", posture)] = {M.data(), M.data() + M.size()};
  }
  return content;
}

void flatten(const nlohmann::json& j, const std::string& name, Content& content) {
  if (j.is_structured()) {
    for (const auto& [key, value] : j.items()) flatten(value, name + "/" + key, content);
  } else if (j.is_number()) {
    content.numbers[name] = {j.get<double>()};
  } else {
    content.texts[name] = j.dump();
  }
}

Content read_study(const fs::path& path) {
  Content content;
  flatten(nlohmann::json::parse(study::study_json(myoid::study::read_study(path))), "", content);
  return content;
}

/// The motion that the tool's run gives.
Content run_setup(const fs::path& path) {
  for (const auto& entry : fs::directory_iterator(path.parent_path())) {
    if (entry.path().extension() == ".mot" || entry.path().extension() == ".sto") fs::remove(entry.path());
  }
  const auto stays = [&](const fs::path& file) {
    if (fs::weakly_canonical(file).parent_path() != fs::weakly_canonical(path.parent_path()))
      throw ReadError(path, 0, fmt::format("'{}' is outside of this test", file.string()));
  };
  const opensim::ToolResult result = opensim::run_tool(path, {.claim = stays});
  Content content;
  content.notes = sentences(result.remarks);
  for (const fs::path& file : result.files) {
    content.texts[file.filename().string()] = "written";
    if (file.extension() != ".mot") continue;
    Content motion = read_storage(file);
    content.time_s = std::move(motion.time_s);
    content.numbers.merge(motion.numbers);
  }
  return content;
}

class Maker {
 public:
  std::string number() {
    return fmt::format("{:.4f}", static_cast<double>(engine_() % 2000000) / 1000.0 - 1000.0 + 0.00037);
  }
  std::string rows(int columns, char separator, bool frame, double dt, bool comma = false) {
    std::string text;
    for (int i = 0; i < kRows; ++i) {
      if (frame) text += fmt::format("{}{}", i + 1, separator);
      text += fmt::format("{:.3f}", dt * i);
      for (int c = 0; c < columns; ++c) text += separator + number();
      text += '\n';
    }
    if (comma) std::replace(text.begin(), text.end(), '.', ',');
    return text;
  }
  /// Turns of two sensors by any angle about any axis, with eight decimals.
  std::string orientations() {
    std::string text;
    std::normal_distribution<double> normal;
    for (int i = 0; i < kRows; ++i) {
      text += fmt::format("{:.2f}", 0.01 * i);
      for (int sensor = 0; sensor < 2; ++sensor) {
        Eigen::Vector4d q;
        for (double& x : q) x = normal(engine_);
        q.normalize();
        text += fmt::format("\t{:.8f},{:.8f},{:.8f},{:.8f}", q[0], q[1], q[2], q[3]);
      }
      text += '\n';
    }
    return text;
  }
  std::string counts() {
    std::string text;
    for (int i = 0; i < kRows; ++i)
      text += fmt::format("{:.3f}\t{}\t{}\n", 0.001 * i, engine_() % 4000, engine_() % 4000);
    return text;
  }
  std::string c3d(bool integer) {
    recording::C3dFile file;
    file.point_rate_hz = 100.0;
    file.point_unit = "mm";
    file.point_labels = {"A", "B", "C"};
    file.points.resize(kRows, 12);
    file.analog_per_frame = 2;
    file.analog.resize(Eigen::Index{2} * kRows, 2);
    for (int c = 0; c < 2; ++c) file.channels.push_back({c == 0 ? "E" : "F", "V", 0.0, 0.5});
    const auto step = [&] { return static_cast<float>(static_cast<int>(engine_() % 2000) + 1); };
    for (Eigen::Index i = 0; i < file.points.size(); ++i) file.points.data()[i] = i % 4 == 3 ? 0.0F : 0.1F * step();
    for (Eigen::Index i = 0; i < file.analog.size(); ++i) file.analog.data()[i] = step();
    const auto made = recording::format_c3d(file, {recording::C3dProcessor::intel, integer});
    return {reinterpret_cast<const char*>(made.data()), made.size()};
  }
  std::string edf() {
    const auto pad = [](std::string text, std::size_t n) { return text.append(n - text.size(), ' '); };
    constexpr int kRecords = 4;
    constexpr int kSamples = 10;
    std::string out = pad("0", 8) + pad("X X X X", 80) + pad("Startdate X X X X", 80) + "01.01.2520.00.00" +
                      pad("1024", 8) + pad("EDF+C", 44) + pad(std::to_string(kRecords), 8) + pad("1", 8) + pad("3", 4);
    const auto fields = [&](std::initializer_list<const char*> texts, std::size_t width) {
      for (const char* text : texts) out += pad(text, width);
    };
    fields({"EMG BIC", "EMG TRI", "EDF Annotations"}, 16);
    fields({"", "", ""}, 80);
    fields({"uV", "uV", ""}, 8);
    fields({"-100", "-100", "-1"}, 8);
    fields({"100", "100", "1"}, 8);
    fields({"-32768", "-32768", "-32768"}, 8);
    fields({"32767", "32767", "32767"}, 8);
    fields({"", "", ""}, 80);
    fields({"10", "10", "8"}, 8);
    fields({"", "", ""}, 32);
    for (int r = 0; r < kRecords; ++r) {
      for (int i = 0; i < 4 * kSamples; ++i) out += static_cast<char>(engine_() % 100);
      std::string stamp = fmt::format("+{}\x14\x14", r);
      stamp.resize(16, '\0');
      out += stamp;
    }
    return out;
  }

 private:
  std::mt19937_64 engine_{20261121};
};

constexpr const char* kPendulum =
    "<?xml version=\"1.0\"?>\n<OpenSimDocument Version=\"40000\">\n<Model name=\"m\">\n"
    "<gravity>0 -9.81 0</gravity>\n<BodySet>\n<objects>\n<Body name=\"b\">\n<mass>1</mass>\n"
    "<mass_center>0 -1 0</mass_center>\n<inertia>1 1 1 0 0 0</inertia>\n</Body>\n</objects>\n"
    "</BodySet>\n<JointSet>\n<objects>\n<PinJoint name=\"j\">\n<socket_parent_frame>/ground"
    "</socket_parent_frame>\n<socket_child_frame>/bodyset/b</socket_child_frame>\n<coordinates>\n"
    "<Coordinate name=\"q\"/>\n</coordinates>\n</PinJoint>\n</objects>\n</JointSet>\n<MarkerSet>\n"
    "<objects>\n<Marker name=\"A\">\n<socket_parent_frame>/bodyset/b</socket_parent_frame>\n"
    "<location>0 -0.5 0</location>\n</Marker>\n<Marker name=\"B\">\n<socket_parent_frame>/bodyset/b"
    "</socket_parent_frame>\n<location>0.1 -1 0</location>\n</Marker>\n</objects>\n</MarkerSet>\n"
    "</Model>\n</OpenSimDocument>\n";
constexpr const char* kPendulumMarkers =
    "PathFileType\t4\t(X/Y/Z)\tm.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\t"
    "OrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n100\t100\t3\t2\tm\t100\t1\t3\n"
    "Frame#\tTime\tA\t\t\tB\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n1\t0\t0\t-0.5\t0\t0.1\t-1\t0\n"
    "2\t0.01\t0\t-0.5\t0\t0.1\t-1\t0\n3\t0.02\t0.01\t-0.5\t0\t0.12\t-1\t0\n";
constexpr const char* kSetup =
    "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<OpenSimDocument Version=\"40000\">\n"
    "<InverseKinematicsTool name=\"t\">\n<model_file>m.osim</model_file>\n<IKTaskSet>\n<objects>\n"
    "<IKMarkerTask name=\"A\">\n<apply>true</apply>\n<weight>2</weight>\n</IKMarkerTask>\n"
    "<IKMarkerTask name=\"B\">\n<apply>true</apply>\n<weight>1.5</weight>\n</IKMarkerTask>\n"
    "</objects>\n</IKTaskSet>\n<marker_file>m.trc</marker_file>\n<time_range>0 0.02</time_range>\n"
    "<accuracy>1e-05</accuracy>\n<output_motion_file>o.mot</output_motion_file>\n"
    "</InverseKinematicsTool>\n</OpenSimDocument>\n";
constexpr const char* kStudy =
    "[subject]\nname = \"P\"\nmass_kg = 71.5\n\n[model]\nbuiltin = \"arm4\"\n"
    "coordinate = \"elbow_flexion\"\n\n[motion]\nrate_hz = 120\n\n[emg]\nunit = \"mV\"\n"
    "highpass_hz = 25.5\nlowpass_hz = 5\n\n[[muscle]]\nname = \"BIC\"\nemg = \"EMG BIC\"\n\n"
    "[[muscle]]\nname = \"TRI\"\nemg = \"EMG TRI\"\n\n[[trial]]\nname = \"flex\"\n"
    "markers = \"m.trc\"\nemg = \"e.csv\"\nstart_s = 0.5\nend_s = 2.5\n\n[[trial]]\n"
    "name = \"mvc\"\nmarkers = \"m.trc\"\nemg = \"e.csv\"\nuse = \"mvc\"\n";

}  // namespace

std::vector<Kind> good_files(const fs::path& folder) {
  Maker make;
  std::vector<Kind> list;
  const std::vector<std::string> info{"info"};
  const auto table = [&](const char* name, const char* file, const std::string& head, const std::string& rows,
                         auto read, bool says_its_rows = true, const std::vector<std::string>& command = {"info"}) {
    Kind kind{name, file, head + rows, Shape::table, read, command, says_its_rows};
    kind.first_row = static_cast<std::size_t>(std::count(head.begin(), head.end(), '\n'));
    list.push_back(std::move(kind));
  };
  for (const bool integer : {true, false}) {
    Kind kind{integer ? "C3D, integers" : "C3D, reals", "f.c3d", make.c3d(integer), Shape::binary, read_c3d, info};
    const std::size_t samples = static_cast<std::size_t>(kRows) * (12 + 4) * (integer ? 2 : 4);
    const auto block = static_cast<unsigned char>(kind.bytes[16]);
    const std::size_t begin = 512 * (static_cast<std::size_t>(block) - 1);
    kind.data_bytes = {begin, begin + samples};
    list.push_back(std::move(kind));
  }
  table("TRC", "f.trc",
        "PathFileType\t4\t(X/Y/Z)\tf.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\t"
        "OrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n100\t100\t40\t3\tmm\t100\t1\t40\n"
        "Frame#\tTime\ta\t\t\tb\t\t\tc\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\tX3\tY3\tZ3\n\n",
        make.rows(9, '\t', true, 0.01), read_markers);
  table("STO", "f.sto", "x\nversion=1\nnRows=40\nnColumns=4\ninDegrees=no\n\nendheader\ntime\ta\tb\tc\n",
        make.rows(3, '\t', false, 0.01), read_storage);
  table("MOT of SIMM", "f.mot", "name x\ndatacolumns 3\ndatarows 40\nrange 0 0.39\nendheader\ntime\ta\tb\n",
        make.rows(2, '\t', false, 0.01), read_storage);
  table("STO of orientations", "f.sto",
        "DataRate=100.000000\nDataType=Quaternion\nversion=3\nOpenSimVersion=4.5\nendheader\n"
        "time\ta_imu\tb_imu\n",
        make.orientations(), read_orientations, false);
  table("CSV", "f.csv", "time,E1 [mV],E2 [mV]\n", make.rows(2, ',', false, 0.001), read_emg, false, {"check"});
  table("CSV, comma decimals", "f.csv", "time;E1 [mV];E2 [mV]\n", make.rows(2, ';', false, 0.001, true), read_emg,
        false, {"check"});
  table("ANC", "f.anc",
        "File_Type:\tAnalog R/C ASCII\tGeneration#:\t1\nBoard_Type:\tNational\tPolarity:\tBipolar\n"
        "Trial_Name:\tt\tTrial#:\t1\tDuration(Sec.):\t0.040\t#Channels:\t2\nBitDepth:\t12\t"
        "PreciseRate:\t1000.000000\n\n\nName\ta\tb\nRate\t1000\t1000\nRange\t1000\t1000\n",
        make.counts(), read_channels);
  for (Kind& kind : good_tables(folder)) list.push_back(std::move(kind));
  Kind edf{"EDF+", "f.edf", make.edf(), Shape::binary, read_channels, info};
  edf.data_bytes = {1024, edf.bytes.size()};
  list.push_back(edf);
  list.push_back({"OSIM", "f.osim", body::arm4_osim(), Shape::xml, read_model, info});
  list.push_back({"XML set-up", "f.xml", kSetup, Shape::xml, run_setup, {"run-tool"}});
  list.push_back({"TOML", "f.toml", kStudy, Shape::toml, read_study, {"check"}});
  write_file(folder / "m.osim", kPendulum);
  write_file(folder / "m.trc", kPendulumMarkers);
  return list;
}

}  // namespace myoid::damage
