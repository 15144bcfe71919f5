#include "myoid/recording/c3d_parameters.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/recording/c3d_bytes.h"

namespace myoid::recording {
namespace {

std::string chars(std::span<const std::byte> bytes) {
  std::string text(bytes.size(), '\0');
  std::transform(bytes.begin(), bytes.end(), text.begin(),
                 [](std::byte b) { return static_cast<char>(b); });
  return text;
}

bool printable(std::string_view name) {
  return std::none_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\0' && c != '\t';
  });
}

std::size_t element_count(const std::vector<std::uint8_t>& dimensions) {
  std::size_t count = 1;
  for (const std::uint8_t d : dimensions) count *= d;  // at most 255^7 < 2^56
  return count;
}

std::size_t size_of(C3dType type) {
  return type == C3dType::real ? 4 : type == C3dType::integer ? 2 : 1;
}

/// Kind, dimensions, values and description of a parameter; false if they do not fit into `body`.
bool read_value(std::span<const std::byte> body, const C3dBytes& number, C3dParameter& parameter) {
  if (body.size() < 2) return false;
  const auto code = static_cast<std::int8_t>(body[0]);
  if (code != -1 && code != 1 && code != 2 && code != 4) return false;
  parameter.type = static_cast<C3dType>(code);
  const auto rank = static_cast<std::size_t>(body[1]);
  if (rank > 7 || body.size() < 2 + rank) return false;
  for (std::size_t d = 0; d < rank; ++d)
    parameter.dimensions.push_back(static_cast<std::uint8_t>(body[2 + d]));
  const std::size_t count = element_count(parameter.dimensions);
  const std::size_t width = size_of(parameter.type);
  body = body.subspan(2 + rank);
  if (count > body.size() / width) return false;
  const std::byte* p = body.data();
  if (parameter.type == C3dType::text) {
    parameter.text = chars(body.first(count));
  } else {
    parameter.numbers.reserve(count);
    for (std::size_t i = 0; i < count; ++i, p += width) {
      parameter.numbers.push_back(parameter.type == C3dType::real
                                      ? static_cast<double>(number.real(p))
                                  : parameter.type == C3dType::integer
                                      ? static_cast<double>(number.i16(p))
                                      : static_cast<double>(static_cast<std::uint8_t>(*p)));
    }
  }
  body = body.subspan(count * width);
  if (!body.empty()) {
    const std::size_t length = std::min(static_cast<std::size_t>(body[0]), body.size() - 1);
    parameter.description = to_utf8(chars(body.subspan(1, length)));
  }
  return true;
}

void put_text(std::vector<std::byte>& out, std::string_view text) {
  for (const char c : text) out.push_back(static_cast<std::byte>(c));
}

/// Head of a record; the returned index is that of the distance, to be filled in at its end.
std::size_t put_head(std::vector<std::byte>& out, std::string_view name, bool locked, int id) {
  if (name.empty() || name.size() > 127) {
    throw InvalidInput(
        fmt::format("C3D name '{}': found {} bytes, expected 1 to 127", name, name.size()));
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
    throw InvalidInput(
        fmt::format("description of C3D parameter '{}': {} bytes; at most 255", name, text.size()));
  }
  out.push_back(static_cast<std::byte>(text.size()));
  put_text(out, text);
}

void close_record(std::vector<std::byte>& out,
                  std::size_t distance_at,
                  std::string_view name,
                  const C3dBytes& number) {
  const std::size_t distance = out.size() - distance_at;
  if (distance > 65535) {
    throw InvalidInput(fmt::format("C3D parameter '{}': {} bytes; at most 65535", name, distance));
  }
  number.put_u16(&out[distance_at], static_cast<std::uint16_t>(distance));
}

}  // namespace

std::vector<C3dGroup> parse_c3d_parameters(std::span<const std::byte> bytes,
                                           std::size_t begin,
                                           std::size_t limit,
                                           const C3dBytes& number,
                                           std::vector<Repair>& repairs) {
  std::map<int, C3dGroup> groups;
  std::vector<int> order;
  const auto group_of = [&](int id) -> C3dGroup& {
    const auto [it, added] = groups.try_emplace(id);
    if (added) {
      it->second.id = id;
      order.push_back(id);
    }
    return it->second;
  };
  limit = std::min(limit, bytes.size());
  const auto damaged = [&](std::size_t at, std::string_view what) {
    repairs.push_back({0, fmt::format("the parameter section is damaged at byte {} ({}); what "
                                      "follows in it is left out",
                                      at, what)});
  };
  for (std::size_t at = begin; at + 2 <= limit;) {
    const int length = static_cast<std::int8_t>(bytes[at]);
    const int id = static_cast<std::int8_t>(bytes[at + 1]);
    if (length == 0) break;  // the end as it should be
    const auto size = static_cast<std::size_t>(std::abs(length));
    if (size > 127 || id == 0 || at + 4 + size > limit) {
      damaged(at, id == 0 ? "a record of no group" : "a record reaches behind its end");
      break;
    }
    const std::string raw_name = chars(bytes.subspan(at + 2, size));
    const std::string name = to_utf8(raw_name);
    if (!printable(raw_name) || name.empty()) {
      damaged(at, "a name that is no text");
      break;
    }
    const std::size_t distance_at = at + 2 + size;
    const std::size_t distance = number.u16(&bytes[distance_at]);
    const bool last = distance == 0;
    const std::size_t next = last ? limit : distance_at + distance;
    if (next > limit || (!last && distance < 2)) {
      damaged(at, fmt::format("the record '{}' reaches behind its end", name));
      break;
    }
    const auto body = bytes.subspan(distance_at + 2, next - distance_at - 2);
    if (id < 0) {
      C3dGroup& group = group_of(id == -128 ? 128 : -id);
      if (!group.name.empty())
        repairs.push_back(
            {0, fmt::format("two groups have the number {}: '{}' and '{}' (byte {}); read as one",
                            -id, group.name, name, at)});
      if (group.name.empty()) group.name = name;
      group.locked = length < 0;
      if (!body.empty()) {
        const std::size_t text = std::min(static_cast<std::size_t>(body[0]), body.size() - 1);
        group.description = to_utf8(chars(body.subspan(1, text)));
      }
    } else {
      C3dParameter parameter;
      parameter.name = name;
      parameter.locked = length < 0;
      if (!read_value(body, number, parameter)) {
        repairs.push_back({0, fmt::format("parameter '{}' at byte {}: its size or kind cannot be "
                                          "right; left out",
                                          name, at)});
      } else {
        C3dGroup& group = group_of(id);
        const bool twice = std::any_of(
            group.parameters.begin(), group.parameters.end(),
            [&](const C3dParameter& p) { return equal_ignoring_case(p.name, parameter.name); });
        if (twice) {
          repairs.push_back({0, fmt::format("parameter '{}:{}' stands twice (byte {}); the first "
                                            "is taken",
                                            group.name, name, at)});
        } else {
          group.parameters.push_back(std::move(parameter));
        }
      }
    }
    if (last) break;
    at = next;
  }
  std::vector<C3dGroup> list;
  for (const int id : order) {
    C3dGroup& group = groups[id];
    if (group.name.empty()) {
      group.name = fmt::format("GROUP_{}", id);
      repairs.push_back({0, fmt::format("{} parameters belong to group {}, which has no name",
                                        group.parameters.size(), id)});
    }
    list.push_back(std::move(group));
  }
  return list;
}

std::vector<std::byte> format_c3d_parameters(const std::vector<C3dGroup>& groups,
                                             const C3dBytes& number) {
  std::vector<std::byte> out(4);
  out[0] = std::byte{1};
  out[1] = std::byte{0x50};
  out[3] = static_cast<std::byte>(number.processor);
  for (const C3dGroup& group : groups) {
    if (group.id < 1 || group.id > 127)
      throw InvalidInput(
          fmt::format("C3D group '{}': number {}, expected 1 to 127", group.name, group.id));
    const std::size_t at = put_head(out, group.name, group.locked, -group.id);
    put_description(out, group.name, group.description);
    close_record(out, at, group.name, number);
    for (const C3dParameter& p : group.parameters) {
      const std::size_t distance_at = put_head(out, p.name, p.locked, group.id);
      out.push_back(static_cast<std::byte>(p.type));
      if (p.dimensions.size() > 7)
        throw InvalidInput(fmt::format("C3D parameter '{}': more than 7 dimensions", p.name));
      out.push_back(static_cast<std::byte>(p.dimensions.size()));
      for (const std::uint8_t d : p.dimensions) out.push_back(static_cast<std::byte>(d));
      const std::size_t count = element_count(p.dimensions);
      const std::size_t have = p.type == C3dType::text ? p.text.size() : p.numbers.size();
      if (have != count) {
        throw InvalidInput(fmt::format("C3D parameter '{}:{}': {} elements, its dimensions say {}",
                                       group.name, p.name, have, count));
      }
      if (p.type == C3dType::text) {
        put_text(out, p.text);
      } else {
        for (const double value : p.numbers) {
          const std::size_t end = out.size();
          out.resize(end + size_of(p.type));
          bool fits = true;
          if (p.type == C3dType::real) {
            fits = number.put_real(&out[end], static_cast<float>(value));
          } else {
            const double low = p.type == C3dType::byte ? 0.0 : -32768.0;
            const double high = p.type == C3dType::byte ? 255.0 : 65535.0;
            fits = value >= low && value <= high && value == std::floor(value);
            const auto whole = static_cast<std::uint16_t>(fits ? static_cast<int>(value) : 0);
            if (p.type == C3dType::byte) {
              out[end] = static_cast<std::byte>(whole);
            } else {
              number.put_u16(&out[end], whole);
            }
          }
          if (!fits)
            throw InvalidInput(fmt::format("C3D parameter '{}:{}': {} does not fit its kind",
                                           group.name, p.name, value));
        }
      }
      put_description(out, p.name, p.description);
      close_record(out, distance_at, p.name, number);
    }
  }
  out.resize((out.size() + 2 + kC3dBlock - 1) / kC3dBlock * kC3dBlock);  // ends with a zero length
  const std::size_t blocks = out.size() / kC3dBlock;
  if (blocks > 32000)
    throw InvalidInput("the C3D parameters are too many: at most 16 million bytes");
  // One byte for the number of blocks: readers go by the records where it does not suffice.
  out[2] = static_cast<std::byte>(std::min<std::size_t>(blocks, 255));
  return out;
}

}  // namespace myoid::recording
