#include "myoid/ground/core/build_identity.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>

#include <dlfcn.h>

#include "myoid/ground/core/provenance.h"

namespace myoid::inline ground {
namespace {

bool is_library(std::string_view file) { return file.find(".so") != std::string_view::npos; }

std::string identity() {
  // Inside a shared library, the library's file counts, not the program that loaded it. The process of a program that
  // its loader was told to start (the tarball's, which brings its C library) is the loader.
  std::string file = "/proc/self/exe";
  std::error_code ignored;
  const std::string process = std::filesystem::read_symlink(file, ignored).filename().string();
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&build_identity), &info) != 0 && info.dli_fname != nullptr &&
      (is_library(info.dli_fname) || is_library(process)))
    file = info.dli_fname;
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return bytes.empty() ? std::string(version()) : sha256(bytes);
}

}  // namespace

const std::string& build_identity() {
  static const std::string value = identity();
  return value;
}

}  // namespace myoid::inline ground
