#include "myoid/recording/c3d/c3d_parameters.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_words.h"
#include "myoid/recording/c3d/c3d_bytes.h"

namespace myoid::recording {
namespace {

std::string chars(std::span<const std::byte> bytes) {
  std::string text(bytes.size(), '\0');
  std::transform(bytes.begin(), bytes.end(), text.begin(), [](std::byte b) { return static_cast<char>(b); });
  return text;
}

bool printable(std::string_view name) {
  return std::none_of(name.begin(), name.end(),
                      [](char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\0' && c != '\t'; });
}

std::size_t element_count(const std::vector<std::uint8_t>& dimensions) {
  std::size_t count = 1;
  for (const std::uint8_t d : dimensions) count *= d;  // at most 255^7 < 2^56
  return count;
}

std::size_t size_of(C3dType type) { return type == C3dType::real ? 4 : type == C3dType::integer ? 2 : 1; }

/// Reads a length and as many bytes of text; returns the number of bytes read.
std::size_t read_description(std::span<const std::byte> body, std::string& description) {
  if (body.empty()) return 0;
  const std::size_t length = std::min(static_cast<std::size_t>(body[0]), body.size() - 1);
  description = to_utf8(chars(body.subspan(1, length)));
  return 1 + length;
}

/// Reads kind, dimensions, values and description of a parameter and returns their bytes; 0 if they
/// do not fit into `body`. A description that does not fit is cut.
std::size_t read_value(std::span<const std::byte> body, const C3dBytes& number, C3dParameter& parameter) {
  const std::size_t whole = body.size();
  if (body.size() < 2) return 0;
  const auto code = static_cast<std::int8_t>(body[0]);
  if (code != -1 && code != 1 && code != 2 && code != 4) return 0;
  parameter.type = static_cast<C3dType>(code);
  const auto rank = static_cast<std::size_t>(body[1]);
  if (rank > 7 || body.size() < 2 + rank) return 0;
  for (std::size_t d = 0; d < rank; ++d) parameter.dimensions.push_back(static_cast<std::uint8_t>(body[2 + d]));
  const std::size_t count = element_count(parameter.dimensions);
  const std::size_t width = size_of(parameter.type);
  body = body.subspan(2 + rank);
  if (count > body.size() / width) return 0;
  const std::byte* p = body.data();
  if (parameter.type == C3dType::text) {
    parameter.text = chars(body.first(count));
  } else {
    parameter.numbers.reserve(count);
    for (std::size_t i = 0; i < count; ++i, p += width) {
      parameter.numbers.push_back(parameter.type == C3dType::real ? static_cast<double>(number.real(p))
                                  : parameter.type == C3dType::integer
                                      ? static_cast<double>(number.i16(p))
                                      : static_cast<double>(static_cast<std::uint8_t>(*p)));
    }
  }
  return whole - body.size() + count * width + read_description(body.subspan(count * width), parameter.description);
}

void put_text(std::vector<std::byte>& out, std::string_view text) {
  for (const char c : text) out.push_back(static_cast<std::byte>(c));
}

/// Writes the head of a record and returns the index of its distance, which is filled in at the record's end.
std::size_t put_head(std::vector<std::byte>& out, std::string_view name, bool locked, int id) {
  if (name.empty() || name.size() > 127) {
    throw InvalidInput("C3D name '{}': found {} bytes, expected 1 to 127", name, name.size());
  }
  const int length = static_cast<int>(name.size());
  out.push_back(static_cast<std::byte>(static_cast<std::int8_t>(locked ? -length : length)));
  out.push_back(static_cast<std::byte>(static_cast<std::int8_t>(id)));
  put_text(out, name);
  out.resize(out.size() + 2);
  return out.size() - 2;
}

void put_description(std::vector<std::byte>& out, std::string_view name, std::string_view text) {
  if (text.size() > 255) {
    throw InvalidInput("description of C3D parameter '{}': {} bytes; at most 255", name, text.size());
  }
  out.push_back(static_cast<std::byte>(text.size()));
  put_text(out, text);
}

void close_record(std::vector<std::byte>& out, std::size_t distance_at, std::string_view name, const C3dBytes& number) {
  const std::size_t distance = out.size() - distance_at;
  if (distance > 65535) {
    throw InvalidInput("C3D parameter '{}': {} bytes; at most 65535", name, distance);
  }
  number.put_u16(&out[distance_at], static_cast<std::uint16_t>(distance));
}

/// The head of a record: name, group, and the distance to the next record.
struct RecordHead {
  std::string name;
  int id = 0;  ///< Below 0 for a group.
  bool locked = false;
  std::size_t body = 0;  ///< Byte where kind and values begin, or a group's description.
  /// Byte where the next record begins, by the distance; 0: this is the last one.
  std::size_t next = 0;
};

/// Reads records; where a distance or a head is damaged, finds the next record.
class ParameterReader {
 public:
  ParameterReader(std::span<const std::byte> bytes,
                  std::size_t limit,
                  const C3dBytes& number,
                  std::vector<Repair>& repairs)
      : bytes_(bytes), limit_(std::min(limit, bytes.size())), number_(number), repairs_(repairs) {}

  std::vector<C3dGroup> read(std::size_t begin) {
    for (std::size_t at = begin; at + 2 <= limit_ && bytes_[at] != std::byte{0};) {
      std::string reason;
      const auto head = head_at(at, reason);
      at = head ? take(at, *head) : behind_damage(at, reason);
    }
    return named_groups();
  }

 private:
  /// Reads the head at this byte; empty, with the reason, if no record can begin here.
  std::optional<RecordHead> head_at(std::size_t at, std::string& reason) const {
    const int length = static_cast<std::int8_t>(bytes_[at]);
    const auto size = static_cast<std::size_t>(std::abs(length));
    RecordHead head{.id = static_cast<std::int8_t>(bytes_[at + 1]), .locked = length < 0};
    if (size > 127 || head.id == 0 || at + 4 + size > limit_) {
      reason = head.id == 0 ? "a record of no group" : "a record reaches behind its end";
      return std::nullopt;
    }
    const std::string raw_name = chars(bytes_.subspan(at + 2, size));
    head.name = to_utf8(raw_name);
    if (!printable(raw_name) || head.name.empty()) {
      reason = "a name that is no text";
      return std::nullopt;
    }
    const std::size_t distance_at = at + 2 + size;
    head.body = distance_at + 2;
    const std::size_t distance = number_.u16(&bytes_[distance_at]);
    head.next = distance == 0 ? 0 : distance_at + distance;
    return head;
  }

  /// Returns the byte behind the record by its own values, whatever its distance says; 0 if these are no values.
  std::size_t own_end(const RecordHead& head) const {
    const auto body = bytes_.subspan(head.body, limit_ - head.body);
    std::string description;
    if (head.id < 0) return head.body + read_description(body, description);
    C3dParameter parameter;
    const std::size_t taken = read_value(body, number_, parameter);
    return taken == 0 ? 0 : head.body + taken;
  }

  /// Returns true for a record beyond doubt: its name has letters and digits, and its distance is
  /// the length of its values.
  bool surely_begins(std::size_t at) const {
    if (at + 4 > limit_) return false;
    const auto size = static_cast<std::size_t>(std::abs(static_cast<std::int8_t>(bytes_[at])));
    if (size < 2 || at + 4 + size > limit_) return false;
    const auto name = bytes_.subspan(at + 2, size);
    const bool plain = std::all_of(name.begin(), name.end(), [](std::byte b) {
      const auto c = static_cast<unsigned char>(b);
      return std::isalnum(c) != 0 || c == '_' || c == ' ';
    });
    std::string reason;
    const auto head = plain ? head_at(at, reason) : std::nullopt;
    return head && head->next != 0 && head->next <= limit_ && own_end(*head) == head->next;
  }

  /// Returns true for the end of the list and for every readable head.
  bool may_begin(std::size_t at) const {
    std::string reason;
    return at + 2 > limit_ || bytes_[at] == std::byte{0} || head_at(at, reason).has_value();
  }

  /// Keeps a record, and returns where the next one begins.
  std::size_t take(std::size_t at, const RecordHead& head) {
    const std::size_t own = own_end(head);
    std::size_t next = head.next == 0 ? limit_ : head.next;
    const bool inside = next >= head.body && next <= limit_;
    if (!inside && own == 0) return behind_damage(at, fmt::format("the record '{}' reaches behind its end", head.name));
    const bool own_is_better =
        own != 0 && own != next &&
        (!inside || (surely_begins(own) ? !surely_begins(next) : may_begin(own) && !may_begin(next)));
    if (own_is_better) {
      note(repairs_,
           "the parameter section is damaged at byte {}: '{}' says that the next record "
           "begins at byte {}; by its own length, which is taken, at byte {}",
           at, head.name, next, own);
      next = own;
    }
    const auto body = bytes_.subspan(head.body, next - head.body);
    if (head.id < 0) {
      take_group(at, head, body);
    } else {
      take_parameter(at, head, body);
    }
    return next;
  }

  /// Returns the next byte behind `at` where surely a record begins, or the limit, with a note.
  std::size_t behind_damage(std::size_t at, const std::string& reason) {
    std::size_t next = at + 1;
    while (next < limit_ && !surely_begins(next)) ++next;
    repairs_.push_back(
        {0, next < limit_
                ? fmt::format("the parameter section is damaged at byte {} ({}); {} bytes of it are left out, up to "
                              "the next record that can be read",
                              at, reason, next - at)
                : fmt::format("the parameter section is damaged at byte {} ({}); what follows in it is left out", at,
                              reason)});
    return next;
  }

  C3dGroup& group_of(int id) {
    const auto [it, added] = groups_.try_emplace(id);
    if (added) {
      it->second.id = id;
      order_.push_back(id);
    }
    return it->second;
  }

  void take_group(std::size_t at, const RecordHead& head, std::span<const std::byte> body) {
    C3dGroup& group = group_of(head.id == -128 ? 128 : -head.id);
    if (!group.name.empty())
      note(repairs_, "two groups have the number {}: '{}' and '{}' (byte {}); read as one", -head.id, group.name,
           head.name, at);
    if (group.name.empty()) group.name = head.name;
    group.locked = head.locked;
    read_description(body, group.description);
  }

  void take_parameter(std::size_t at, const RecordHead& head, std::span<const std::byte> body) {
    C3dParameter parameter;
    parameter.name = head.name;
    parameter.locked = head.locked;
    if (read_value(body, number_, parameter) == 0) {
      note(repairs_, "parameter '{}' at byte {}: its size or kind cannot be right; left out", head.name, at);
      return;
    }
    C3dGroup& group = group_of(head.id);
    const bool twice = std::any_of(group.parameters.begin(), group.parameters.end(),
                                   [&](const C3dParameter& p) { return equal_ignoring_case(p.name, parameter.name); });
    if (twice) {
      note(repairs_, "parameter '{}:{}' stands twice (byte {}); the first is taken", group.name, head.name, at);
    } else {
      group.parameters.push_back(std::move(parameter));
    }
  }

  /// Returns the groups in the order of the file.
  std::vector<C3dGroup> named_groups() {
    std::vector<C3dGroup> list;
    for (const int id : order_) {
      C3dGroup& group = groups_[id];
      if (group.name.empty()) {
        group.name = fmt::format("GROUP_{}", id);
        note(repairs_, "{} parameters belong to group {}, which has no name", group.parameters.size(), id);
      }
      list.push_back(std::move(group));
    }
    return list;
  }

  std::span<const std::byte> bytes_;
  std::size_t limit_;
  C3dBytes number_;
  std::vector<Repair>& repairs_;
  std::map<int, C3dGroup> groups_;
  std::vector<int> order_;
};

/// Appends a number of this kind; false if the kind cannot hold the number.
bool put_number(std::vector<std::byte>& out, double value, C3dType type, const C3dBytes& number) {
  const std::size_t at = out.size();
  out.resize(at + size_of(type));
  if (type == C3dType::real) return number.put_real(&out[at], static_cast<float>(value));
  const double low = type == C3dType::byte ? 0.0 : -32768.0;
  const double high = type == C3dType::byte ? 255.0 : 65535.0;
  if (!(value >= low && value <= high && value == std::floor(value))) return false;
  const auto whole = static_cast<std::uint16_t>(static_cast<int>(value));
  if (type == C3dType::byte) {
    out[at] = static_cast<std::byte>(whole);
  } else {
    number.put_u16(&out[at], whole);
  }
  return true;
}

void put_parameter(std::vector<std::byte>& out, const C3dGroup& group, const C3dParameter& p, const C3dBytes& number) {
  const std::size_t distance_at = put_head(out, p.name, p.locked, group.id);
  out.push_back(static_cast<std::byte>(p.type));
  if (p.dimensions.size() > 7) throw InvalidInput("C3D parameter '{}': more than 7 dimensions", p.name);
  out.push_back(static_cast<std::byte>(p.dimensions.size()));
  for (const std::uint8_t d : p.dimensions) out.push_back(static_cast<std::byte>(d));
  const std::size_t count = element_count(p.dimensions);
  const std::size_t have = p.type == C3dType::text ? p.text.size() : p.numbers.size();
  if (have != count) {
    throw InvalidInput("C3D parameter '{}:{}': {} elements, its dimensions say {}", group.name, p.name, have, count);
  }
  if (p.type == C3dType::text) put_text(out, p.text);
  for (std::size_t i = 0; p.type != C3dType::text && i < count; ++i) {
    if (!put_number(out, p.numbers[i], p.type, number))
      throw InvalidInput("C3D parameter '{}:{}': {} does not fit its kind", group.name, p.name, p.numbers[i]);
  }
  put_description(out, p.name, p.description);
  close_record(out, distance_at, p.name, number);
}

}  // namespace

std::vector<C3dGroup> parse_c3d_parameters(std::span<const std::byte> bytes,
                                           std::size_t begin,
                                           std::size_t limit,
                                           const C3dBytes& number,
                                           std::vector<Repair>& repairs) {
  return ParameterReader(bytes, limit, number, repairs).read(begin);
}

std::vector<std::byte> format_c3d_parameters(const std::vector<C3dGroup>& groups, const C3dBytes& number) {
  std::vector<std::byte> out(4);
  out[0] = std::byte{1};
  out[1] = std::byte{0x50};
  out[3] = static_cast<std::byte>(number.processor);
  for (const C3dGroup& group : groups) {
    if (group.id < 1 || group.id > 127)
      throw InvalidInput("C3D group '{}': number {}, expected 1 to 127", group.name, group.id);
    const std::size_t at = put_head(out, group.name, group.locked, -group.id);
    put_description(out, group.name, group.description);
    close_record(out, at, group.name, number);
    for (const C3dParameter& p : group.parameters) put_parameter(out, group, p, number);
  }
  out.resize((out.size() + 2 + kC3dBlock - 1) / kC3dBlock * kC3dBlock);  // the section ends with a zero length
  const std::size_t blocks = out.size() / kC3dBlock;
  if (blocks > 32000) throw InvalidInput("the C3D parameters are too many: at most 16 million bytes");
  // The number of blocks has one byte; readers follow the records where it does not suffice.
  out[2] = static_cast<std::byte>(std::min<std::size_t>(blocks, 255));
  return out;
}

}  // namespace myoid::recording
