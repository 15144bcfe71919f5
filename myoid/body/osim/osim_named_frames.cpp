#include "myoid/body/osim/osim_named_frames.h"

#include <sstream>

#include "myoid/body/osim/osim_frames.h"
#include "myoid/body/osim/osim_update_parts.h"
#include "myoid/body/osim/osim_updater.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::body {
namespace {

std::string numbers(const Vec3& v) {
  using ground::format_number;
  return format_number(v.x()) + " " + format_number(v.y()) + " " + format_number(v.z());
}

/// Returns the first element of this class and name below `node`.
pugi::xml_node element_named(pugi::xml_node node, const char* kind, const std::string& name) {
  return node.find_node(
      [&](const pugi::xml_node& n) { return std::string_view(n.name()) == kind && OsimXml::name_of(n) == name; });
}

void add_sensor(pugi::xml_node model, pugi::xml_node carrier, const SensorPlace& sensor) {
  append_frame(child_or_new(carrier, "components"), sensor.name, "..", numbers(sensor.p), numbers(sensor.angles_rad));
  auto imu = child_or_new(model, "components").append_child("IMU");
  set_attribute(imu, "name", sensor.name);
  append_text(imu, "socket_frame", sensor.carrier.path + "/" + sensor.name);
}

}  // namespace

std::map<std::string, NamedFrame> named_frames(std::string_view text, const std::filesystem::path& path) {
  OsimXml xml(std::string(text), path);
  (void)bring_to_newest_form(xml, {.looks = false});
  OsimReading reading{xml};
  read_bodies(reading, xml.root().child("Model"));
  std::map<std::string, NamedFrame> frames;
  for (const Body& body : reading.model.bodies) {
    frames.emplace(body.name,
                   NamedFrame{body.name == "ground" ? "/ground" : "/bodyset/" + body.name, body.name, Pose{}});
  }
  for (const auto& [frame_path, frame] : reading.frames) {
    if (std::string_view(frame.node.name()) == "Station") continue;
    const FixedFrame fixed = resolve_frame(reading, frame.node, frame_path, "");
    frames.emplace(OsimXml::name_of(frame.node),
                   NamedFrame{frame_path, reading.model.bodies[at(fixed.body)].name, fixed.X_BF});
  }
  return frames;
}

std::string with_sensors(std::string_view text,
                         const std::filesystem::path& path,
                         const std::vector<SensorPlace>& sensors) {
  const OsimXml source(std::string(text), path);
  pugi::xml_document document;
  (void)document.load_buffer(source.text().data(), source.text().size(),
                             pugi::parse_default | pugi::parse_comments | pugi::parse_declaration);
  const auto model = document.child("OpenSimDocument").child("Model");
  for (const SensorPlace& sensor : sensors) {
    if (auto frame = element_named(model, "PhysicalOffsetFrame", sensor.name)) {
      child_or_new(frame, "orientation").text().set(numbers(sensor.angles_rad).c_str());
      continue;
    }
    const std::string name = sensor.carrier.path.substr(sensor.carrier.path.find_last_of('/') + 1);
    auto carrier = element_named(model, "Body", name);
    if (!carrier) carrier = element_named(model, "PhysicalOffsetFrame", name);
    if (!carrier) source.fail(source.root(), "there is no body or frame '{}'", name);
    add_sensor(model, carrier, sensor);
  }
  std::ostringstream out;
  document.save(out, "\t", pugi::format_default, pugi::encoding_utf8);
  return out.str();
}

}  // namespace myoid::body
