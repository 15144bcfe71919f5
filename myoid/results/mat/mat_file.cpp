#include "myoid/results/mat/mat_file.h"

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

#ifdef MYOID_MATIO_SONAME

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <system_error>

#include <dlfcn.h>
#include <matio.h>
#include <unistd.h>

#include "myoid/ground/core/provenance.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/byte_source.h"
#include "myoid/ground/files/file_words.h"

namespace myoid::results {
namespace {

namespace fs = std::filesystem;

/// The functions of libmatio that are used.
struct Matio {
  decltype(&::Mat_CreateVer) create = nullptr;
  decltype(&::Mat_Close) close = nullptr;
  decltype(&::Mat_VarCreate) variable = nullptr;
  decltype(&::Mat_VarCreateStruct) structure = nullptr;
  decltype(&::Mat_VarSetStructFieldByIndex) set_field = nullptr;
  decltype(&::Mat_VarWrite) write = nullptr;
  decltype(&::Mat_VarFree) release = nullptr;
};

template <typename Function>
void find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (function == nullptr) throw InvalidInput("{} has no function {}", MYOID_MATIO_SONAME, name);
}

/// Loads libmatio once.
const Matio& matio() {
  static const Matio loaded = [] {
    void* library = dlopen(MYOID_MATIO_SONAME, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr)
      throw InvalidInput(
          "a MATLAB file needs the library {0}, which is not there ({1}); install it (Debian 12: apt "
          "install libmatio11)",
          MYOID_MATIO_SONAME, dlerror());
    Matio m;
    find(library, "Mat_CreateVer", m.create);
    find(library, "Mat_Close", m.close);
    find(library, "Mat_VarCreate", m.variable);
    find(library, "Mat_VarCreateStruct", m.structure);
    find(library, "Mat_VarSetStructFieldByIndex", m.set_field);
    find(library, "Mat_VarWrite", m.write);
    find(library, "Mat_VarFree", m.release);
    return m;
  }();
  return loaded;
}

/// Returns text in MATLAB's form. `to_utf8` removes invalid bytes.
std::u16string to_utf16(const std::string& text) {
  const std::string bytes = to_utf8(text);
  std::u16string units;
  for (std::size_t i = 0; i < bytes.size();) {
    const auto first = static_cast<unsigned char>(bytes[i]);
    const std::size_t length = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    char32_t point = length == 1 ? first : first & (0xFFU >> (length + 1));
    for (std::size_t k = 1; k < length && i + k < bytes.size(); ++k)
      point = (point << 6U) | (static_cast<unsigned char>(bytes[i + k]) & 0x3FU);
    if (point >= 0x10000) {
      point -= 0x10000;
      units += static_cast<char16_t>(0xD800 + (point >> 10U));
      units += static_cast<char16_t>(0xDC00 + (point & 0x3FFU));
    } else {
      units += static_cast<char16_t>(point);
    }
    i += length;
  }
  return units;
}

/// Makes the variables of libmatio. Each is released with the one that holds it.
class Maker {
 public:
  explicit Maker(const Matio& library) : m_(library) {}

  matvar_t* operator()(const char* name, const MatValue& value) const {
    return std::visit([&](const auto& v) { return made(name, v); }, value);
  }

 private:
  matvar_t* array(const char* name,
                  matio_classes kind,
                  matio_types type,
                  std::size_t rows,
                  std::size_t columns,
                  const void* data,
                  int options = 0) const {
    std::size_t dims[2] = {rows, columns};
    // libmatio copies the data; its argument is not const all the same.
    return checked(m_.variable(name, kind, type, 2, dims, const_cast<void*>(data), options));
  }
  static matvar_t* checked(matvar_t* variable) {
    if (variable == nullptr) throw std::bad_alloc();
    return variable;
  }

  matvar_t* made(const char* name, const Eigen::MatrixXd& v) const {
    return array(name, MAT_C_DOUBLE, MAT_T_DOUBLE, static_cast<std::size_t>(v.rows()),
                 static_cast<std::size_t>(v.cols()), v.data());
  }
  matvar_t* made(const char* name, const std::vector<bool>& v) const {
    const std::vector<std::uint8_t> bytes(v.begin(), v.end());
    return array(name, MAT_C_UINT8, MAT_T_UINT8, bytes.size(), 1, bytes.data(), MAT_F_LOGICAL);
  }
  matvar_t* made(const char* name, const std::string& v) const {
    const std::u16string units = to_utf16(v);
    return array(name, MAT_C_CHAR, MAT_T_UTF16, units.empty() ? 0 : 1, units.size(), units.data());
  }
  matvar_t* made(const char* name, const MatTexts& v) const {
    std::vector<matvar_t*> cells;
    for (const std::string& text : v.texts) cells.push_back(made(nullptr, text));
    return array(name, MAT_C_CELL, MAT_T_CELL, v.row ? 1 : cells.size(), v.row ? cells.size() : 1, cells.data());
  }
  matvar_t* made(const char* name, const std::vector<MatStruct>& v) const {
    std::vector<const char*> names;
    for (const auto& field : v.front().fields) names.push_back(field.first.c_str());
    std::size_t dims[2] = {1, v.size()};
    matvar_t* variable = checked(m_.structure(name, 2, dims, names.data(), static_cast<unsigned>(names.size())));
    for (std::size_t i = 0; i < v.size(); ++i) {
      for (std::size_t f = 0; f < names.size(); ++f)
        m_.set_field(variable, f, i, (*this)(nullptr, v[i].fields.at(f).second));
    }
    return variable;
  }

  const Matio& m_;
};

/// A folder of its own for the file that libmatio writes by name.
class Scratch {
 public:
  Scratch() {
    std::string pattern = (fs::temp_directory_path() / "myoid.XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw InvalidInput("cannot make a temporary folder in {}: {}", fs::temp_directory_path().string(),
                         std::generic_category().message(errno));
    folder_ = pattern;
  }
  ~Scratch() {
    unlink(file().c_str());
    rmdir(folder_.c_str());
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  [[nodiscard]] std::string file() const { return (folder_ / "variables.mat").string(); }

 private:
  fs::path folder_;
};

}  // namespace

void require_matio() { matio(); }

void write_mat_file(const fs::path& path, const MatStruct& variables) {
  const Matio& m = matio();
  const Scratch scratch;
  const std::string header = fmt::format("MATLAB 5.0 MAT-file, by myoid {}", version());
  std::unique_ptr<mat_t, decltype(m.close)> file(m.create(scratch.file().c_str(), header.c_str(), MAT_FT_MAT5),
                                                 m.close);
  bool written = file != nullptr;
  for (const auto& [name, value] : variables.fields) {
    if (!written) break;
    const std::unique_ptr<matvar_t, decltype(m.release)> variable(Maker(m)(name.c_str(), value), m.release);
    written = m.write(file.get(), variable.get(), MAT_COMPRESSION_ZLIB) == 0;
  }
  if (written) written = m.close(file.release()) == 0;
  if (!written)
    throw InvalidInput("{}: libmatio cannot write it by way of {}; is that disk full?", path.string(), scratch.file());
  write_file(path, read_bytes(scratch.file()));
}

}  // namespace myoid::results

#else

namespace myoid::results {

void require_matio() {
  throw InvalidInput(
      "this program was built without libmatio and writes no MATLAB file; install libmatio-dev and build it again");
}

void write_mat_file(const std::filesystem::path& /*path*/, const MatStruct& /*variables*/) { require_matio(); }

}  // namespace myoid::results

#endif
