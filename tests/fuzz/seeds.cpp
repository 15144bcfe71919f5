// Small files of our own to begin from: fuzz_seeds FOLDER writes one folder for each target.
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/byte_source.h"
#include "myoid/recording/c3d/c3d_writer.h"

#include "fuzz.h"
#include "info_kinds.h"

namespace {

namespace fs = std::filesystem;
using namespace myoid;
using namespace myoid::recording;

C3dFile small_c3d() {
  C3dFile file;
  file.point_rate_hz = 50.0;
  file.point_unit = "mm";
  file.point_scale = 0.25F;
  file.point_labels = {"A", "S:B"};
  file.points = C3dFile::Rows::Constant(3, 8, 0.25F);
  for (const Eigen::Index residual : {3, 7}) file.points.col(residual).setZero();
  file.points(1, 3) = -1.0F;
  file.analog_per_frame = 2;
  file.analog = C3dFile::Rows::Constant(6, 6, 10.0F);
  for (int c = 0; c < 6; ++c) file.channels.push_back({"F" + std::to_string(c), "N", 2.0, -0.5});
  file.events = {{0.02, "On", "Left", "S"}};
  C3dGroup group{1, "FORCE_PLATFORM", "", false, {}};
  const auto add = [&](const char* name, C3dType type, std::vector<std::uint8_t> dimensions,
                       std::vector<double> numbers) {
    C3dParameter p;
    p.name = name;
    p.type = type;
    p.dimensions = std::move(dimensions);
    p.numbers = std::move(numbers);
    group.parameters.push_back(std::move(p));
  };
  add("USED", C3dType::integer, {}, {1});
  add("TYPE", C3dType::integer, {1}, {2});
  add("CORNERS", C3dType::real, {3, 4, 1}, {300, 200, 0, -300, 200, 0, -300, -200, 0, 300, -200, 0});
  add("ORIGIN", C3dType::real, {3, 1}, {0, 0, -40});
  add("CHANNEL", C3dType::integer, {6, 1}, {1, 2, 3, 4, 5, 6});
  file.groups = {group};
  return file;
}

std::string small_edf() {
  const auto pad = [](std::string text, std::size_t n) { return text.append(n - text.size(), ' '); };
  std::string out = pad("0", 8) + pad("X", 80) + pad("Startdate X", 80) + "01.01.2520.00.00";
  out += pad("768", 8) + pad("EDF+C", 44) + pad("2", 8) + pad("0.5", 8) + pad("2", 4);
  out += pad("EMG", 16) + pad("EDF Annotations", 16) + pad("", 160) + pad("uV", 8) + pad("", 8);
  out += pad("-100", 8) + pad("-1", 8) + pad("100", 8) + pad("1", 8) + pad("-32768", 8) + pad("-32768", 8);
  out += pad("32767", 8) + pad("32767", 8) + pad("", 160) + pad("4", 8) + pad("8", 8) + pad("", 64);
  for (int r = 0; r < 2; ++r) {
    std::string record(24, '\1');
    record.replace(8, 10, std::string("+0\x14\x14\0+0.1\x14", 10));
    out += record;
  }
  return out;
}

/// The seeds of the readers, each with the letter of its ending before it.
void write_info_seeds(const fs::path& root) {
  for (std::size_t k = 0; k < myoid::fuzz::kInfoKinds.size(); ++k) {
    const std::string_view kind = myoid::fuzz::kInfoKinds[k].substr(1);
    const bool table = kind == "tsv" || kind == "txt" || kind == "emt";
    const fs::path folder = root / (table           ? "markers"
                                    : kind == "mot" ? "sto"
                                    : kind == "bdf" ? "edf"
                                                    : std::string(kind));
    for (const auto& entry : fs::directory_iterator(folder))
      write_file(root / "info" / fmt::format("{}_{}", kind, entry.path().filename().string()),
                 static_cast<char>('a' + k) + read_bytes(entry.path()));
  }
}

/// Returns the files of a project in the order of fuzz_project; names that are not there are empty.
std::string project_files(const std::map<std::string, std::string>& files) {
  std::string input;
  for (const char* name : {"setup.xml", "subject.xml", "calibration.xml", "trial.xml", "emg.sto", "walk/id.sto",
                           "main.m", "m.osim", "muscles.csv", "a.osimx"}) {
    if (const auto file = files.find(name); file != files.end()) input += file->second;
    input += myoid::fuzz::kNextFile;
  }
  return input;
}

/// A project of each program.
void write_project_seeds(const fs::path& folder) {
  const std::string table = "t\nversion=1\nnRows=2\nnColumns=2\ninDegrees=no\nendheader\ntime\ta\n0\t0.1\n0.1\t0.2\n";
  const std::string model =
      "<OpenSimDocument Version=\"40000\"><Model><ForceSet><objects><Thelen2003Muscle name=\"a\"><optimal_fiber_length>"
      "0.1</optimal_fiber_length><tendon_slack_length>0.2</tendon_slack_length><max_isometric_force>9"
      "</max_isometric_force></Thelen2003Muscle></objects><groups><ObjectGroup name=\"A\"><members>a</members>"
      "</ObjectGroup></groups></ForceSet></Model></OpenSimDocument>";
  const std::string numbers =
      "<shapeFactor>-1</shapeFactor><pennationAngle>0.1</pennationAngle><tendonSlackLength>0.2</tendonSlackLength>"
      "<maxIsometricForce>9</maxIsometricForce><strengthCoefficient>1</strengthCoefficient>";
  write_file(
      folder / "ceinms",
      project_files(
          {{"setup.xml",
            "<ceinmsCalibration><subjectFile>subject.xml</subjectFile><excitationGeneratorFile>a.osimx"
            "</excitationGeneratorFile><calibrationFile>calibration.xml</calibrationFile><outputSubjectFile>subject.xml"
            "</outputSubjectFile></ceinmsCalibration>"},
           {"subject.xml",
            "<subject><mtuDefault><emDelay>0.02</emDelay><percentageChange>0.15</percentageChange><damping>0.1</"
            "damping>"
            "<curve><name>forceVelocity</name><xPoints>-1 0 1</xPoints><yPoints>0 1 1.4</yPoints></curve></mtuDefault>"
            "<mtuSet><mtu><name>a</name><c1>-0.5</c1><c2>-0.5</c2><optimalFibreLength>0.1</optimalFibreLength>" +
                numbers +
                "</mtu></mtuSet><dofSet><dof><name>knee</name><mtuNameSet>a</mtuNameSet></dof></dofSet>"
                "<calibrationInfo><uncalibrated/></calibrationInfo><opensimModelFile>m.osim</opensimModelFile></"
                "subject>"},
           {"calibration.xml",
            "<calibration><calibrationSteps><step><dofs>knee</dofs><parameterSet><parameter><name>c1</name><single/>"
            "<absolute><range>-0.9 "
            "-0.1</range></absolute></parameter></parameterSet></step></calibrationSteps><trialSet>"
            "trial.xml</trialSet></calibration>"},
           {"trial.xml",
            "<inputData><excitationsFile>emg.sto</excitationsFile><externalTorquesFile>walk/id.sto</"
            "externalTorquesFile>"
            "<startStopTime>0 0.1</startStopTime></inputData>"},
           {"a.osimx",
            "<excitationGenerator><inputSignals>a</inputSignals><mapping><excitation id=\"a\"><input weight=\"1\">a"
            "</input></excitation></mapping></excitationGenerator>"},
           {"emg.sto", table},
           {"walk/id.sto", table},
           {"m.osim", model}}));
  write_file(
      folder / "ceinms_rt",
      project_files({{"setup.xml",
                      "<simulatedAnnealing><osimFile>m.osim</osimFile><subjectXML>subject.xml</subjectXML>"
                      "</simulatedAnnealing>"},
                     {"subject.xml",
                      "<subject><muscles><muscle><name>a</name><C1>-0.5</C1><C2>-0.5</C2><optimalFiberLength>0.1"
                      "</optimalFiberLength>" +
                          numbers +
                          "</muscle></muscles><DoFs><DoF><name>knee</name><muscleSequence>a</muscleSequence></DoF>"
                          "</DoFs><Channels><Channel><name>A</name><muscleSequence>a</muscleSequence></Channel>"
                          "</Channels></subject>"},
                     {"walk/id.sto", table},
                     {"m.osim", model}}));
  write_file(folder / "nmsm",
             project_files({{"setup.xml",
                             "<NMSMPipelineDocument><MuscleTendonPersonalizationTool><input_model_file>m.osim"
                             "</input_model_file><data_directory>walk</data_directory><coordinate_list>knee"
                             "</coordinate_list><collected_emg_channel_muscle_groups>A"
                             "</collected_emg_channel_muscle_groups></MuscleTendonPersonalizationTool>"
                             "</NMSMPipelineDocument>"},
                            {"a.osimx",
                             "<NMSMPipelineDocument><OsimxModel><RCNLMuscleSet><objects><RCNLMuscle name=\"a\">"
                             "<electromechanical_delay>0.5</electromechanical_delay></RCNLMuscle></objects>"
                             "</RCNLMuscleSet></OsimxModel></NMSMPipelineDocument>"},
                            {"m.osim", model}}));
  write_file(folder / "mrs",
             project_files({{"main.m",
                             "D = [pwd '\\walk'];\nMisc.IKfile = {fullfile(D,'ik.mot')};\nMisc.EMGfile = {'emg.sto'};\n"
                             "model_path = 'm.osim'; time = [0 1;\n 2 3];\nMisc.DofNames_Input = {'knee'}; % one\n"
                             "Misc.EMGSelection = {'a'};\nMisc.Estimate_OptFL = Misc.EMGSelection;\n"
                             "Misc.lb_lMo_scaling = 0.5; Misc.ub_lMo_scaling = 2;\nMisc.EMGconstr = 1;\n"
                             "for i=1:2, x(i) = i; end\nsolveMuscleRedundancy(model_path,time,'o',Misc);\n"},
                            {"emg.sto", table},
                            {"muscles.csv", "muscle,emg\na,a\n"},
                            {"m.osim", model}}));
}

void write(const fs::path& folder, const std::string& name, const std::string& content) {
  write_file(folder / name, content);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const fs::path root = argv[1];
  int n = 0;
  for (const auto processor : {C3dProcessor::intel, C3dProcessor::dec, C3dProcessor::sgi}) {
    for (const bool integer : {false, true})
      write_c3d(root / "c3d" / std::to_string(++n), small_c3d(), {processor, integer});
  }
  write(root / "edf", "1", small_edf());
  write(root / "trc", "1",
        "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\t"
        "OrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n100\t100\t2\t1\tmm\t100\t1\t2\n"
        "Frame#\tTime\tA\t\t\n\t\tX1\tY1\tZ1\n\n1\t0\t1.5\t2\t3\n2\t0.01\t\t\t\n");
  write(root / "sto", "1",
        "Coordinates\nversion=1\nnRows=2\nnColumns=3\ninDegrees=yes\n\nendheader\ntime\ta\tb\n"
        "0\t1\t-2e-3\n0.01\tnan\t4\n");
  write(root / "sto", "2", "DataType=Vec3\nversion=3\nendheader\ntime\ta\n0\t1,2,3\n1\t4,5,6\n");
  write(root / "orientations", "1",
        "DataRate=100\nDataType=Quaternion\nversion=3\nOpenSimVersion=4.5\nendheader\n"
        "time\ta_imu\tb_imu\n0\t0.6,0.8,0,0\t1,0,0,0\n0.01\tNaN,NaN,NaN,NaN\t0.6,0,0,-0.8\n");
  write(root / "csv", "1", "time,Biceps [mV]\n0,1\n0.5,2\n");
  write(root / "csv", "2", "Frequency;1500\n\ntime;LT BIC\ns;uV\n0,0;1,5\n0,1;2,5\n");
  write(root / "csv", "3", "X [s],\"EMG 1 [mV]\",X [s],\"ACC [g]\"\n0,1,0,2\n0.1,2,0.3,4\n0.2,3,,\n");
  write(root / "anc", "1",
        "File_Type:\tAnalog R/C ASCII\nTrial_Name:\tt\tDuration(Sec.):\t0.002\t#Channels:\t1\n"
        "BitDepth:\t12\tPreciseRate:\t1000\n\nName\ta\nRate\t1000\nRange\t1000\n0\t5\n0.001\t6\n");
  write(root / "toml", "1", "a = 1\n[b]\nc = [1.5, 'x']\n[[d]]\ne = { f = true }\n");
  write(root / "osim", "1",
        "<OpenSimDocument Version=\"40000\"><Model name=\"m\"><gravity>0 -9.81 0</gravity><BodySet>"
        "<objects><Body name=\"b\"><mass>1</mass><mass_center>0 0 0</mass_center><inertia>1 1 1 0 0 "
        "0</inertia></Body></objects></BodySet><JointSet><objects><PinJoint name=\"j\">"
        "<socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/b"
        "</socket_child_frame><coordinates><Coordinate name=\"q\"/></coordinates></PinJoint>"
        "</objects></JointSet></Model></OpenSimDocument>");
  const std::string next = "\n%%%%\n";
  write(root / "bids", "1",
        "name\tcomponent\ttype\ttracked_point\tunits\nax\tx\tPOS\ta\tmm\nay\ty\tPOS\ta\tmm\n"
        "az\tz\tPOS\ta\tmm\nq\tn/a\tJNTANG\tn/a\tdeg" +
            next + R"({"SamplingFrequency": 100, "TaskName": "t"})" + next + "1\t2\t3\tn/a\n1\tn/a\t3\t4\n");
  const std::string loads =
      "<OpenSimDocument Version=\"40000\"><ExternalLoads name=\"l\"><objects><ExternalForce "
      "name=\"f\"><applied_to_body>forearm_hand</applied_to_body><force_expressed_in_body>ground"
      "</force_expressed_in_body><point_expressed_in_body>ground</point_expressed_in_body>"
      "<force_identifier>v</force_identifier><point_identifier>p</point_identifier>"
      "<torque_identifier>t_</torque_identifier></ExternalForce></objects><datafile>loads.sto"
      "</datafile></ExternalLoads></OpenSimDocument>";
  write(root / "loads", "1",
        loads + next +
            "l\nversion=1\nnRows=2\nnColumns=10\ninDegrees=no\nendheader\ntime\tv1\tv2\tv3\tp1\tp2"
            "\tp3\tt_1\tt_2\tt_3\n0\t1\t2\t3\t4\t5\t6\t7\t8\t9\n1\t0\t0\t0\tnan\t5\t6\t7\t8\t9\n");
  const auto tool = [](const std::string& content) {
    return "<OpenSimDocument Version=\"40000\">" + content + "</OpenSimDocument>";
  };
  const std::string task_set =
      "<IKTaskSet><objects><IKMarkerTask name=\"A\"><weight>2</weight></IKMarkerTask>"
      "<IKCoordinateTask name=\"q\"><apply>true</apply><weight>0.1</weight><value_type>"
      "manual_value</value_type><value>0.1</value></IKCoordinateTask></objects></IKTaskSet>";
  write(root / "setup", "ik",
        tool("<InverseKinematicsTool name=\"t\"><model_file>m.osim</model_file><marker_file>m.trc"
             "</marker_file><coordinate_file>m.mot</coordinate_file><time_range>0 1</time_range>"
             "<output_motion_file>o.mot</output_motion_file>" +
             task_set + "</InverseKinematicsTool>"));
  write(root / "setup", "ik_set",
        tool("<InverseKinematicsTool name=\"t\"><model_file>m.osim</model_file><marker_file>m.trc"
             "</marker_file><IKTaskSet file=\"set.xml\"/><output_motion_file>o.mot"
             "</output_motion_file></InverseKinematicsTool>") +
            next + tool(task_set));
  write(root / "setup", "id",
        tool("<InverseDynamicsTool name=\"t\"><model_file>m.osim</model_file><coordinates_file>"
             "m.mot</coordinates_file><lowpass_cutoff_frequency_for_coordinates>6"
             "</lowpass_cutoff_frequency_for_coordinates><forces_to_exclude>muscles"
             "</forces_to_exclude><output_gen_force_file>o.sto</output_gen_force_file>"
             "</InverseDynamicsTool>"));
  write(root / "setup", "analyze",
        tool("<AnalyzeTool name=\"t\"><model_file>m.osim</model_file><coordinates_file>m.mot"
             "</coordinates_file><initial_time>0</initial_time><final_time>0.03</final_time>"
             "<force_set_files>set.xml</force_set_files><AnalysisSet><objects><StaticOptimization "
             "name=\"s\"><on>true</on><step_interval>1</step_interval></StaticOptimization>"
             "<Kinematics name=\"k\"><coordinates>q</coordinates></Kinematics><MuscleAnalysis "
             "name=\"m\"/></objects></AnalysisSet></AnalyzeTool>") +
            next +
            tool("<ForceSet><objects><CoordinateActuator name=\"r\"><optimal_force>10"
                 "</optimal_force><coordinate>q</coordinate></CoordinateActuator></objects>"
                 "</ForceSet>"));
  write(root / "setup", "scale",
        tool("<ScaleTool name=\"t\"><mass>2</mass><GenericModelMaker><model_file>m.osim"
             "</model_file><marker_set_file>set.xml</marker_set_file></GenericModelMaker>"
             "<ModelScaler><scaling_order>measurements manualScale</scaling_order><MeasurementSet>"
             "<objects><Measurement name=\"e\"><apply>true</apply><MarkerPairSet><objects>"
             "<MarkerPair><markers>A B</markers></MarkerPair></objects></MarkerPairSet>"
             "<BodyScaleSet><objects><BodyScale name=\"b\"><axes>X Y Z</axes></BodyScale></objects>"
             "</BodyScaleSet></Measurement></objects></MeasurementSet><ScaleSet><objects><Scale>"
             "<scales>1 1 1.1</scales><segment>b</segment><apply>true</apply></Scale></objects>"
             "</ScaleSet><marker_file>m.trc</marker_file><time_range>0 1</time_range>"
             "<preserve_mass_distribution>true</preserve_mass_distribution><output_model_file>"
             "s.osim</output_model_file></ModelScaler><MarkerPlacer><marker_file>m.trc"
             "</marker_file>" +
             task_set +
             "<output_model_file>p.osim</output_model_file><output_motion_file>p.mot"
             "</output_motion_file></MarkerPlacer></ScaleTool>") +
            next +
            tool("<MarkerSet><objects><Marker name=\"C\"><socket_parent_frame>/bodyset/b"
                 "</socket_parent_frame><location>0 0 0.1</location></Marker></objects>"
                 "</MarkerSet>"));
  write(root / "mesh", "vtp",
        "v<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\">"
        "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 "
        "0 1 0</DataArray></Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" "
        "format=\"ascii\">0 1 2</DataArray><DataArray type=\"Int32\" Name=\"offsets\" "
        "format=\"ascii\">3</DataArray></Polys></Piece></PolyData></VTKFile>");
  write(root / "mesh", "stl",
        "ssolid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
        "endloop\nendfacet\nendsolid a\n");
  write(root / "mesh", "obj", "ov 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1/1 2//1 3 4\nf -4 -3 -2\n");
  write(root / "markers", "vicon",
        "Devices\r\n1000\r\n,,EMG - V,\r\nFrame,Sub Frame,BIC,TRI\r\n,,V,V\r\n1,0,0.1,0.2\r\n"
        "\r\nTrajectories\r\n100\r\n,,P:A,,,P:B,,\r\nFrame,Sub Frame,X,Y,Z,X,Y,Z\r\n"
        ",,mm,mm,mm,mm,mm,mm\r\n1,0,10,20,30,1,2,3\r\n2,0,11,21,31,,,\r\n");
  write(root / "markers", "qualisys",
        "NO_OF_FRAMES\t2\nNO_OF_MARKERS\t2\nFREQUENCY\t200\nDATA_INCLUDED\t3D\nMARKER_NAMES\tA\t"
        "B\n1.5\t2.5\t3.5\t0.000\t0.000\t0.000\n1.5\t2.5\t3.5\t4\t5\t6\n");
  write(root / "markers", "bts",
        "BTS ASCII format\n\nType:\tPoint 3D tracks\nMeasure unit:\tm\n\nTracks:\t1\nFrequency:\t100 "
        "Hz\nFrames:\t2\nStart time:\t0.000\n\nFrame\tTime\tA.X\tA.Y\tA.Z\n1\t0.000\t0.1\t0.2\t0.3"
        "\n2\t0.010\t0.4\t0.5\t0.6\n");
  write(root / "markers", "ndi",
        "Number of frames:,2,Collection frequency:,100,Units:,cm\nFrame,M_1 x,M_1 y,M_1 z\n1,1,2,3\n"
        "2,,,\n");
  write_info_seeds(root);
  write_project_seeds(root / "project");
  return 0;
}
