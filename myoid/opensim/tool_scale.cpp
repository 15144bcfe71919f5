#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/model/muscle_path.h"
#include "myoid/body/osim/osim_editor.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/opensim/marker_placer.h"
#include "myoid/opensim/tool_stages.h"

namespace myoid::opensim {
namespace {

using body::OsimXml;

/// Returns the factor of one measurement: the mean over its pairs of measured distance / model distance.
std::optional<double> measured_factor(const ToolRun& run,
                                      pugi::xml_node measurement,
                                      const body::BodyModel& model,
                                      const body::BodyState& state,
                                      const MarkerSeries& markers,
                                      std::pair<double, double> range) {
  double sum = 0.0;
  int count = 0;
  const std::string name = OsimXml::name_of(measurement);
  const auto refuse = [&](const std::string& why) {
    run.note("measurement '{}' is not used: {}", name, why);
    return std::nullopt;
  };
  const auto [first, last] = frames_in(markers, range);
  for (const auto pair : OsimXml::objects(measurement.child("MarkerPairSet"))) {
    const auto names = run.setup.xml().words(pair, "markers");
    if (names.size() != 2) run.setup.xml().fail(pair, "<markers>: expected two names, found {}", names.size());
    Vec3 p[2];
    Eigen::Index column[2];
    for (std::size_t k = 0; k < 2; ++k) {
      const auto in_model = model.find_marker(names[k]);
      if (!in_model) return refuse(fmt::format("the model has no marker '{}'", names[k]));
      const body::Marker& marker = model.markers[at(*in_model)];
      p[k] = state.X_GB[at(marker.body)] * marker.p_BM;
      const auto found = std::find(markers.names.begin(), markers.names.end(), names[k]);
      if (found == markers.names.end()) return refuse(fmt::format("the recording has no marker '{}'", names[k]));
      column[k] = found - markers.names.begin();
    }
    double distance = 0.0;
    Eigen::Index seen = 0;
    for (Eigen::Index i = first; i <= last; ++i) {
      if (markers.missing(i, column[0]) || markers.missing(i, column[1])) continue;
      distance += (markers.position(i, column[1]) - markers.position(i, column[0])).norm();
      ++seen;
    }
    if (seen == 0) return refuse(fmt::format("'{}' and '{}' are never seen together", names[0], names[1]));
    const double own = (p[1] - p[0]).norm();
    if (!(own > 0.0)) return refuse(fmt::format("'{}' and '{}' coincide in the model", names[0], names[1]));
    sum += distance / static_cast<double>(seen) / own;
    ++count;
  }
  if (count == 0) return refuse("it has no pair of markers");
  return sum / count;
}

body::OsimEditor::Factors factors_of(const ToolRun& run, pugi::xml_node scaler, const body::BodyModel& model) {
  const OsimXml& xml = run.setup.xml();
  body::OsimEditor::Factors factors;
  for (const body::Body& body : model.bodies) factors[body.name] = Vec3::Ones();
  const auto known = [&](pugi::xml_node node, const std::string& body) {
    if (factors.contains(body)) return true;
    run.note("{}: the model has no body '{}'; its factor is not used", node.name(), body);
    return false;
  };
  for (const std::string& method : xml.words(scaler, "scaling_order")) {
    if (method == "measurements") {
      std::optional<MarkerSeries> markers;
      const body::BodyState state = default_state(model);
      int used = 0;
      for (const auto node : OsimXml::objects(scaler.child("MeasurementSet"))) {
        if (!xml.flag(node, "apply", true)) continue;
        if (!markers) markers = markers_of(run, run.setup.required_file(scaler, "marker_file"));
        const auto factor =
            measured_factor(run, node, model, state, *markers, run.setup.time_range(scaler, "time_range"));
        if (!factor) continue;
        ++used;
        for (const auto body : OsimXml::objects(node.child("BodyScaleSet"))) {
          const std::string name = OsimXml::name_of(body);
          if (!known(node, name)) continue;
          for (const std::string& axis : xml.words(body, "axes")) {
            const auto k = std::string_view("XYZxyz").find(axis);
            if (axis.size() != 1 || k == std::string_view::npos)
              xml.fail(body, "<axes>: expected X, Y, Z, found '{}'", axis);
            factors[name][static_cast<Eigen::Index>(k % 3)] = *factor;
          }
        }
      }
      if (used == 0)
        run.note("<scaling_order> asks for measurements, and no measurement is used: no factor comes from them");
    } else if (method == "manualScale") {
      int used = 0;
      for (const auto node : OsimXml::objects(scaler.child("ScaleSet"))) {
        if (!xml.flag(node, "apply", true)) continue;
        const std::string name = xml.word(node, "segment");
        if (!known(node, name)) continue;
        factors[name] = xml.vec3(node, "scales", Vec3::Ones());
        ++used;
      }
      if (used == 0) run.note("<scaling_order> asks for manualScale, and <ScaleSet> has no factor that applies");
    } else {
      xml.fail(scaler.child("scaling_order"), "<scaling_order>: expected measurements or manualScale, found '{}'",
               method);
    }
  }
  for (const auto& [name, f] : factors) {
    if (!(f.cwiseAbs().minCoeff() > 0.0) || !f.allFinite())
      xml.fail(scaler, "the factors of body '{}' are {} {} {}, expected other than 0", name, f[0], f[1], f[2]);
  }
  return factors;
}

void scale(const ToolRun& run,
           pugi::xml_node scaler,
           body::OsimEditor& editor,
           const body::OsimEditor::Factors& factors) {
  const OsimXml& xml = run.setup.xml();
  const body::OsimOptions as_opensim{.compat = run.options.compat};
  const body::BodyModel before = body::parse_osim(editor.text(), editor.path(), as_opensim);
  editor.scale_geometry(factors);
  editor.scale_masses(factors, xml.flag(scaler, "preserve_mass_distribution", false),
                      xml.number(run.setup.tool(), "mass", -1.0));
  const body::BodyModel after = body::parse_osim(editor.text(), editor.path(), as_opensim);
  const body::BodyState state_before = default_state(before), state_after = default_state(after);
  const auto paths_before = paths_of(before), paths_after = paths_of(after);
  body::PathWorkspace workspace;
  body::PathResult path;
  for (std::size_t i = 0; i < paths_before.size() && i < paths_after.size(); ++i) {
    body::compute_path(before, *paths_before[i].second, state_before, workspace, path);
    const double length = path.length_m;
    body::compute_path(after, *paths_after[i].second, state_after, workspace, path);
    if (length > 0.0) editor.scale_lengths(paths_before[i].first, path.length_m / length);
  }
}

std::string scale_set_text(const body::OsimEditor::Factors& factors, const body::BodyModel& model) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<OpenSimDocument Version=\"40500\">\n"
      "\t<ScaleSet name=\"ScaleSet\">\n\t\t<objects>\n";
  for (const body::Body& body : model.bodies) {
    const Vec3& f = factors.at(body.name);
    text += fmt::format(
        "\t\t\t<Scale>\n\t\t\t\t<scales> {} {} {}</scales>\n\t\t\t\t<segment>{}</segment>\n"
        "\t\t\t\t<apply>true</apply>\n\t\t\t</Scale>\n",
        f[0], f[1], f[2], body.name);
  }
  return text + "\t\t</objects>\n\t\t<groups />\n\t</ScaleSet>\n</OpenSimDocument>\n";
}

}  // namespace

void run_scale(const ToolRun& run) {
  const OpensimSetup& setup = run.setup;
  ToolResult& result = run.result;
  const OsimXml& xml = setup.xml();
  const auto tool = setup.tool();
  const auto maker = tool.child("GenericModelMaker");
  const auto scaler = tool.child("ModelScaler");
  const auto placer = tool.child("MarkerPlacer");
  const bool scales = scaler && xml.flag(scaler, "apply", true);
  const bool places = placer && xml.flag(placer, "apply", true);
  if (!scales && !places) xml.fail(tool, "neither <ModelScaler> nor <MarkerPlacer> applies");
  const auto model_file = setup.required_file(maker, "model_file");
  const auto claim = [&](bool on, pugi::xml_node stage, const char* name) {
    const auto file = on ? setup.output_file(stage, name) : std::nullopt;
    if (file) run.claim(*file);
    return file;
  };
  const auto scaled_file = claim(scales, scaler, "output_model_file");
  const auto factors_file = claim(scales, scaler, "output_scale_file");
  const auto placed_file = claim(places, placer, "output_model_file");
  (void)claim(places, placer, "output_motion_file");
  (void)claim(places, placer, "output_marker_file");

  body::OsimEditor editor(read_text_file(model_file), model_file);
  if (!setup.name().empty()) editor.set_name(setup.name());
  if (const auto markers = setup.file(maker, "marker_set_file")) editor.add_markers(*markers);
  const body::BodyModel generic = body::parse_osim(editor.text(), editor.path(), {.compat = run.options.compat});
  for (const std::string& text : generic.unsupported) run.note("{}: {}", model_file.string(), text);
  if (scales) {
    const auto factors = factors_of(run, scaler, generic);
    scale(run, scaler, editor, factors);
    if (factors_file) write_file(*factors_file, scale_set_text(factors, generic));
    if (scaled_file) write_file(*scaled_file, editor.text());
  }
  double mass = 0.0;
  for (const body::Body& body : body::parse_osim(editor.text(), editor.path()).bodies) mass += body.mass_kg;
  result.summary = fmt::format("model of {:.4g} kg", mass);
  if (places) place_markers(run, placer, editor);
  if (placed_file) write_file(*placed_file, editor.text());
  run.add_notes(editor.notes());
  result.frames = 1;
}

}  // namespace myoid::opensim
