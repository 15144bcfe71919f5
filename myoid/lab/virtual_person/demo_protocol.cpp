#include "myoid/lab/virtual_person/demo_protocol.h"

#include "myoid/ground/files/text_file.h"

namespace myoid::lab {

std::string protocol_text(const std::filesystem::path& name) {
  if (name == kDemoProtocol) return std::string(demo_protocol_text());
  return read_text_file(name);
}

Protocol protocol_named(const std::filesystem::path& name, std::optional<Level> level) {
  return parse_protocol(protocol_text(name), name, level);
}

}  // namespace myoid::lab
