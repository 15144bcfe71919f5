#include "myoid/recording/c3d/c3d_events.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/files/file_words.h"

namespace myoid::recording {
namespace {

constexpr unsigned kPresent = 12345;  ///< Header word that says: this section is present.

/// Returns the parameters NAME, NAME2, NAME3, ... of a group.
std::vector<const C3dParameter*> blocks_of(const C3dGroup& group, std::string_view name) {
  std::vector<const C3dParameter*> list;
  for (int block = 1;; ++block) {
    const std::string wanted = block_name(name, block);
    const auto it = std::find_if(group.parameters.begin(), group.parameters.end(),
                                 [&](const C3dParameter& p) { return equal_ignoring_case(trim(p.name), wanted); });
    if (it == group.parameters.end()) return list;
    list.push_back(&*it);
  }
}

std::vector<double> numbers_of(const C3dGroup& group, std::string_view name) {
  std::vector<double> list;
  for (const C3dParameter* p : blocks_of(group, name)) list.insert(list.end(), p->numbers.begin(), p->numbers.end());
  return list;
}

std::vector<std::string> texts_of(const C3dGroup& group, std::string_view name) {
  std::vector<std::string> list;
  for (const C3dParameter* p : blocks_of(group, name))
    for (std::string& text : texts(*p)) list.push_back(std::move(text));
  return list;
}

/// The events of one place; an event without a time is left out, with a note.
class EventList {
 public:
  EventList(C3dFile& file, std::string place) : file_(file), place_(std::move(place)) {}

  void add(Event event) {
    ++count_;
    if (std::isfinite(event.time_s) && std::abs(event.time_s) <= 1e7) {
      events_.push_back(std::move(event));
    } else {
      note(file_.repairs, "{}: event {} is at {} s, which is no time; left out", place_, count_, event.time_s);
    }
  }

  /// Adds the events to the file that no earlier place holds.
  void merge() {
    constexpr double kSame_s = 1e-4;
    const auto earlier = static_cast<std::ptrdiff_t>(file_.events.size());
    for (Event& event : events_) {
      const auto same = [&](const Event& other) {
        return other.label == event.label && std::abs(other.time_s - event.time_s) < kSame_s;
      };
      if (std::none_of(file_.events.begin(), file_.events.begin() + earlier, same))
        file_.events.push_back(std::move(event));
    }
  }

 private:
  C3dFile& file_;
  std::string place_;
  std::vector<Event> events_;
  std::size_t count_ = 0;
};

/// Returns the number of events in USED, an unsigned 16-bit number; without it, the number of times.
std::size_t used_events(const C3dGroup& group, std::size_t times) {
  const auto used = numbers_of(group, "USED");
  if (used.empty()) return times / 2;
  const double count = used[0] < 0.0 ? used[0] + 65536.0 : used[0];
  return count > 0.0 && count < 65536.0 ? std::min(static_cast<std::size_t>(count), times) : 0;
}

void read_group(C3dFile& file, const C3dGroup& group, bool of_kinarm) {
  const auto times = numbers_of(group, "TIMES");
  const std::size_t count = used_events(group, times.size());
  if (count == 0) {
    const auto used = numbers_of(group, "USED");
    const std::size_t named = !used.empty() ? static_cast<std::size_t>(std::max(0.0, used[0])) : 0;
    const std::size_t labels = texts_of(group, "LABELS").size();
    if (times.empty() && (named > 0 || (used.empty() && labels > 0)))
      note(file.repairs, "{}: {} events have no TIMES; left out", group.name, std::max(named, labels));
    return;
  }
  const bool pairs = times.size() >= 2 * count;
  if (!pairs)
    note(file.repairs, "{}:TIMES has {} numbers for {} events instead of two for each; taken as seconds", group.name,
         times.size(), count);
  const auto labels = texts_of(group, "LABELS");
  const auto contexts = texts_of(group, "CONTEXTS");
  const auto subjects = texts_of(group, "SUBJECTS");
  const auto text = [](const std::vector<std::string>& list, std::size_t i) {
    return i < list.size() ? list[i] : std::string();
  };
  EventList events(file, group.name + ":TIMES");
  for (std::size_t i = 0; i < count; ++i) {
    const double minutes = pairs && !of_kinarm ? times[2 * i] : 0.0;
    const double time_s = 60.0 * minutes + times[pairs ? 2 * i + 1 : i];
    events.add({time_s, text(labels, i), text(contexts, i), text(subjects, i)});
  }
  events.merge();
}

/// Reads the section behind the data, which may hold any number of events: a key, counts and widths
/// of labels, and for each event its label, its time as a real, a switch and four further bytes.
void read_new_events(C3dFile& file, ByteSource& source, std::span<const std::byte> head, const C3dBytes& number) {
  constexpr std::size_t kSectionHead = 11;
  constexpr std::size_t kBehindLabel = 9;
  constexpr std::byte kKey{90};
  if (number.u16(&head[294]) != kPresent) return;
  const std::size_t block = number.u16(&head[296]);
  const std::uint64_t at = block == 0 ? 0 : (block - 1) * std::uint64_t{kC3dBlock};
  if (block < 2 || at + kSectionHead > source.size()) return;
  const auto section = source.view(at, kSectionHead);
  if (section[0] != kKey) return;
  const std::size_t events = number.u16(&section[3]);
  const std::size_t width = number.u16(&section[5]);
  const std::size_t record = width + kBehindLabel;
  const std::uint64_t fit = (source.size() - at - kSectionHead) / record;
  if (fit < events)
    note(file.repairs, "the event section at byte {} says {} events; {} are in the file", at, events, fit);
  EventList list(file, "the event section");
  for (std::size_t i = 0; i < std::min<std::uint64_t>(events, fit); ++i) {
    const auto bytes = source.view(at + kSectionHead + i * record, record);
    std::string label;
    for (const std::byte b : bytes.first(width)) label += static_cast<char>(b);
    list.add({static_cast<double>(number.real(&bytes[width])), to_utf8(label.substr(0, label.find('\0'))), "", ""});
  }
  list.merge();
}

/// Reads the events of the header: up to 18 times with labels of four characters.
void read_header_events(C3dFile& file, std::span<const std::byte> head, const C3dBytes& number) {
  const auto at = [&](std::size_t word) { return &head[2 * (word - 1)]; };
  if (number.u16(at(150)) != kPresent) return;
  const std::size_t count = std::min<std::size_t>(number.u16(at(151)), 18);
  EventList events(file, "the header");
  for (std::size_t i = 0; i < count; ++i) {
    std::string label;
    for (std::size_t k = 0; k < 4; ++k) label += static_cast<char>(*(at(199) + 4 * i + k));
    events.add({static_cast<double>(number.real(at(153) + 4 * i)), to_utf8(label), "", ""});
  }
  events.merge();
}

}  // namespace

void read_c3d_events(C3dFile& file, ByteSource& source, std::span<const std::byte> head, const C3dBytes& number) {
  for (const char* name : {"EVENT", "EVENTS"}) {
    for (const C3dGroup& group : file.groups) {
      if (equal_ignoring_case(trim(group.name), name)) read_group(file, group, std::string_view(name) == "EVENTS");
    }
  }
  read_new_events(file, source, head, number);
  if (file.events.empty()) read_header_events(file, head, number);
}

}  // namespace myoid::recording
