#include "myoid/core/build_identity.h"

#include <fstream>
#include <iterator>
#include <string_view>

#include <dlfcn.h>

#include "myoid/core/provenance.h"

namespace myoid {
namespace {

std::string identity() {
  // Inside a shared library, the library's file counts, not the program that loaded it.
  std::string file = "/proc/self/exe";
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&build_identity), &info) != 0 && info.dli_fname != nullptr &&
      std::string_view(info.dli_fname).find(".so") != std::string_view::npos)
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

}  // namespace myoid
