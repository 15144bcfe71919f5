#include "myoid/recording/mesh_reader.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/byte_source.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::recording {
namespace {

constexpr std::string_view kBlank = " \t\r\n";

/// Splits a text into words and counts lines.
class Words {
 public:
  Words(std::string_view text, const std::filesystem::path& path, std::size_t line = 1)
      : text_(text), path_(path), line_(line) {}

  /// Returns the next word; empty at the end.
  std::string_view next() {
    while (at_ < text_.size() && kBlank.find(text_[at_]) != std::string_view::npos) {
      if (text_[at_] == '\n') ++line_;
      ++at_;
    }
    const std::size_t begin = at_;
    at_ = std::min(text_.size(), text_.find_first_of(kBlank, at_));
    return text_.substr(begin, at_ - begin);
  }

  double number() { return number_of(next()); }
  [[nodiscard]] double number_of(std::string_view word) const {
    const auto value = parse_number(word);
    if (!value || !std::isfinite(*value)) fail(fmt::format("expected a number, found '{}'", word));
    return *value;
  }

  Vec3 point() {
    Vec3 p;
    for (Eigen::Index k = 0; k < 3; ++k) p[k] = number();
    return p;
  }

  [[noreturn]] void fail(const std::string& message) const { throw ReadError(path_, line_, message); }

 private:
  std::string_view text_;
  const std::filesystem::path& path_;
  std::size_t line_;
  std::size_t at_ = 0;
};

std::size_t line_of(std::string_view text, std::size_t at) {
  const auto before = text.substr(0, at);  // npos: the end
  return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

void add_fan(const std::vector<int>& polygon, TriangleMesh& mesh) {
  for (std::size_t k = 2; k < polygon.size(); ++k) mesh.triangles.push_back({polygon[0], polygon[k - 1], polygon[k]});
}

/// An XML element: its place, the text of its tag, its content.
struct Element {
  std::size_t at = std::string_view::npos;
  std::string_view tag, content;

  [[nodiscard]] bool exists() const { return at != std::string_view::npos; }
  [[nodiscard]] std::string_view attribute(std::string_view name) const {
    const std::string key = fmt::format(" {}=\"", name);
    const std::size_t begin = tag.find(key);
    if (begin == std::string_view::npos) return {};
    const std::size_t from = begin + key.size();
    return tag.substr(from, tag.find('"', from) - from);
  }
};

/// Returns the next element of this name at or after `from`; these files never nest an element in one of the same name.
Element find_element(std::string_view text, std::string_view name, std::size_t from) {
  Element element;
  const std::string open = fmt::format("<{}", name);
  for (std::size_t at = text.find(open, from); at != std::string_view::npos; at = text.find(open, at + 1)) {
    const std::size_t end = text.find('>', at);
    if (end == std::string_view::npos) return element;
    const char follows = text[at + open.size()];
    if (follows != '>' && follows != '/' && kBlank.find(follows) == std::string_view::npos) continue;
    element.at = at;
    element.tag = text.substr(at, end - at);
    if (text[end - 1] == '/') return element;
    const std::size_t close = text.find(fmt::format("</{}", name), end);
    if (close == std::string_view::npos) return Element{};
    element.content = text.substr(end + 1, close - end - 1);
    return element;
  }
  return element;
}

/// Returns the numbers of a <DataArray>, or an empty list if none has this name.
std::vector<double> data_array(std::string_view whole,
                               std::string_view part,
                               std::string_view name,
                               const std::filesystem::path& path) {
  std::vector<double> numbers;
  for (Element array = find_element(part, "DataArray", 0); array.exists();
       array = find_element(part, "DataArray", array.at + 1)) {
    if (!name.empty() && array.attribute("Name") != name) continue;
    const std::size_t line = line_of(whole, static_cast<std::size_t>(array.tag.data() - whole.data()));
    if (array.attribute("format") != "ascii") {
      throw ReadError(path, line, "the data are '{}', expected 'ascii': save the mesh as ASCII",
                      array.attribute("format"));
    }
    Words words(array.content, path, line);
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
      numbers.push_back(words.number_of(word));
    break;
  }
  return numbers;
}

TriangleMesh parse_vtp(std::string_view text, const std::filesystem::path& path) {
  if (!find_element(text, "PolyData", 0).exists())
    throw ReadError(path, 0, "there is no <PolyData>: not a mesh of VTK, or cut off");
  const Element points = find_element(text, "Points", 0);
  const std::vector<double> coordinates = data_array(text, points.content, "", path);
  TriangleMesh mesh;
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3)
    mesh.vertices.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
  for (const char* kind : {"Polys", "Strips"}) {
    const Element cells = find_element(text, kind, 0);
    const auto corners = data_array(text, cells.content, "connectivity", path);
    std::size_t begin = 0;
    for (const double offset : data_array(text, cells.content, "offsets", path)) {
      const bool there = offset >= static_cast<double>(begin) && offset <= static_cast<double>(corners.size());
      const std::size_t end = there ? static_cast<std::size_t>(offset) : 0;
      if (!there) throw ReadError(path, 0, "<{}>: offset {} is beyond its corners", kind, offset);
      std::vector<int> polygon;
      for (std::size_t k = begin; k < end; ++k) {
        if (!(std::abs(corners[k]) < 2e9)) throw ReadError(path, 0, "<{}>: {} is no vertex", kind, corners[k]);
        polygon.push_back(static_cast<int>(corners[k]));
      }
      begin = end;
      if (kind[0] == 'P') {
        add_fan(polygon, mesh);
      } else {
        for (std::size_t k = 2; k < polygon.size(); ++k) {
          const bool odd = k % 2 == 1;
          mesh.triangles.push_back({polygon[k - (odd ? 1 : 2)], polygon[k - (odd ? 2 : 1)], polygon[k]});
        }
      }
    }
  }
  return mesh;
}

/// Joins the equal corners of triangles.
class Corners {
 public:
  explicit Corners(TriangleMesh& mesh) : mesh_(mesh) {}
  int index_of(const Vec3& p) {
    const auto [it, is_new] = known_.try_emplace({p.x(), p.y(), p.z()}, static_cast<int>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(p);
    return it->second;
  }

 private:
  TriangleMesh& mesh_;
  std::map<std::array<double, 3>, int> known_;
};

constexpr std::size_t kStlHeader = 84;
constexpr std::size_t kStlTriangle = 50;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t k = 0; k < 4; ++k) word |= std::uint32_t{static_cast<unsigned char>(bytes[at + k])} << (8 * k);
  return word;
}

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= kStlHeader && bytes.size() == kStlHeader + kStlTriangle * std::size_t{word_at(bytes, 80)};
}

TriangleMesh parse_binary_stl(std::string_view bytes) {
  TriangleMesh mesh;
  Corners corners(mesh);
  for (std::size_t at = kStlHeader; at + kStlTriangle <= bytes.size(); at += kStlTriangle) {
    std::array<int, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 p;
      for (std::size_t c = 0; c < 3; ++c)
        p[static_cast<Eigen::Index>(c)] =
            static_cast<double>(std::bit_cast<float>(word_at(bytes, at + 12 + 12 * k + 4 * c)));
      triangle[k] = corners.index_of(p);
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

TriangleMesh parse_text_stl(std::string_view text, const std::filesystem::path& path) {
  TriangleMesh mesh;
  Corners corners(mesh);
  Words words(text, path);
  if (words.next() != "solid") words.fail("expected 'solid', or a binary .stl of the right size");
  std::vector<int> polygon;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word == "vertex") polygon.push_back(corners.index_of(words.point()));
    if (word != "endloop") continue;
    if (polygon.size() != 3) words.fail(fmt::format("expected a facet of 3 vertices, found {}", polygon.size()));
    add_fan(polygon, mesh);
    polygon.clear();
  }
  if (!polygon.empty()) words.fail("the file is cut off within a facet");
  return mesh;
}

TriangleMesh parse_obj(std::string_view text, const std::filesystem::path& path) {
  TriangleMesh mesh;
  std::size_t line = 0;
  while (!text.empty()) {
    ++line;
    const std::size_t end = std::min(text.size(), text.find('\n'));
    Words words(text.substr(0, end), path, line);
    text.remove_prefix(std::min(text.size(), end + 1));
    const std::string_view kind = words.next();
    if (kind == "v") mesh.vertices.push_back(words.point());
    if (kind != "f") continue;
    std::vector<int> polygon;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      // The word is vertex/texture/normal; indices count from 1, or from the end if negative.
      const auto index = parse_number(word.substr(0, word.find('/')));
      if (!index || !(std::abs(*index) < 2e9))
        words.fail(fmt::format("expected the number of a vertex, found '{}'", word));
      polygon.push_back(*index > 0.0 ? static_cast<int>(*index) - 1
                                     : static_cast<int>(mesh.vertices.size()) + static_cast<int>(*index));
    }
    add_fan(polygon, mesh);
  }
  return mesh;
}

}  // namespace

TriangleMesh parse_mesh(std::string_view bytes, const std::filesystem::path& path) {
  const auto format = format_of(path);
  TriangleMesh mesh;
  if (format == FileFormat::mesh_vtp) {
    mesh = parse_vtp(bytes, path);
  } else if (format == FileFormat::mesh_stl) {
    mesh = is_binary_stl(bytes) ? parse_binary_stl(bytes) : parse_text_stl(bytes, path);
  } else if (format == FileFormat::mesh_obj) {
    mesh = parse_obj(bytes, path);
  } else {
    throw ReadError(path, 0, "expected a mesh in .vtp, .stl or .obj, found '{}'", path.extension().string());
  }
  const auto count = static_cast<int>(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles) {
    for (const int corner : triangle) {
      if (corner < 0 || corner >= count)
        throw ReadError(path, 0, "a triangle has the vertex {} of {}", corner + 1, count);
    }
  }
  for (const Vec3& p : mesh.vertices)
    if (!p.allFinite()) throw ReadError(path, 0, "a vertex is not finite");
  return mesh;
}

TriangleMesh simplified(const TriangleMesh& mesh, double cell) {
  TriangleMesh result;
  std::map<std::array<long, 3>, int> cells;
  std::vector<int> counts;
  std::vector<int> moved_to;
  for (const Vec3& p : mesh.vertices) {
    const std::array<long, 3> key{std::lround(std::floor(p.x() / cell)), std::lround(std::floor(p.y() / cell)),
                                  std::lround(std::floor(p.z() / cell))};
    const auto [it, is_new] = cells.try_emplace(key, static_cast<int>(result.vertices.size()));
    if (is_new) {
      result.vertices.push_back(Vec3::Zero());
      counts.push_back(0);
    }
    const auto index = static_cast<std::size_t>(it->second);
    result.vertices[index] += p;
    ++counts[index];
    moved_to.push_back(it->second);
  }
  for (std::size_t i = 0; i < counts.size(); ++i) result.vertices[i] /= counts[i];
  for (const auto& triangle : mesh.triangles) {
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) corners[k] = moved_to[static_cast<std::size_t>(triangle[k])];
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
      result.triangles.push_back(corners);
  }
  return result;
}

TriangleMesh read_mesh(const std::filesystem::path& path) { return parse_mesh(read_bytes(path), path); }

}  // namespace myoid::recording
