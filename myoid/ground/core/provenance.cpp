#include "myoid/ground/core/provenance.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <openssl/evp.h>

#include "myoid/ground/core/json_text.h"

namespace myoid::inline ground {
namespace {

std::string without_place(const std::string& path, const std::filesystem::path& folder) {
  const std::filesystem::path absolute(path);
  if (!absolute.is_absolute()) return path;
  const auto shared = std::mismatch(absolute.begin(), absolute.end(), folder.begin(), folder.end()).first;
  // The root alone is no folder that the two share.
  if (std::distance(absolute.begin(), shared) < 2) return absolute.filename().string();
  return absolute.lexically_relative(folder).string();
}

void take_places(nlohmann::ordered_json& json, const std::filesystem::path& folder) {
  if (json.is_string()) json = without_place(json.get<std::string>(), folder);
  if (!json.is_structured()) return;
  for (nlohmann::ordered_json& each : json) take_places(each, folder);
}

}  // namespace

std::string_view version() { return MYOID_VERSION; }

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("sha256: the cryptographic library failed");
  }
  std::string hex;
  for (unsigned int i = 0; i < size; ++i) hex += fmt::format("{:02x}", digest[i]);
  return hex;
}

Provenance without_places(Provenance provenance, const std::filesystem::path& folder) {
  const std::filesystem::path from = std::filesystem::absolute(folder.empty() ? "." : folder).lexically_normal();
  for (InputFile& file : provenance.inputs) file.path = without_place(file.path, from);
  if (!provenance.options_json.empty()) {
    nlohmann::ordered_json options = parse_ordered_json(provenance.options_json);
    take_places(options, from);
    provenance.options_json = json_text(options);
  }
  std::string command;
  for (std::size_t begin = 0; begin <= provenance.command.size();) {
    const std::size_t end = std::min(provenance.command.find(' ', begin), provenance.command.size());
    command += (begin == 0 ? "" : " ") + without_place(provenance.command.substr(begin, end - begin), from);
    begin = end + 1;
  }
  provenance.command = std::move(command);
  return provenance;
}

}  // namespace myoid::inline ground
