#include "tests/damage/damages.h"

#include <algorithm>
#include <cctype>
#include <random>
#include <utility>

#include <fmt/format.h>

namespace myoid::damage {
namespace {

using Lines = std::vector<std::string>;

Lines lines_of(const std::string& text) {
  Lines lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

std::string joined(const Lines& lines, const std::string& end = "\n") {
  std::string text;
  for (const std::string& line : lines) text += line + end;
  return text;
}

Lines cells_of(const std::string& line, char separator) {
  Lines cells{""};
  for (const char c : line) {
    if (c == separator) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

std::string of_cells(const Lines& cells, char separator) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i == 0 ? "" : std::string(1, separator)) + cells[i];
  return line;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

class Damager {
 public:
  explicit Damager(const Kind& kind) : kind_(kind) {}

  std::vector<Damaged> all() {
    truncated();
    flipped();
    garbage();
    add("CRLF", "every line end", replaced(kind_.bytes, "\n", "\r\n"));
    add("BOM", "three bytes before the file", "\xEF\xBB\xBF" + kind_.bytes);
    add("UTF-16", "two bytes a letter", utf16());
    if (kind_.shape == Shape::table) table();
    if (kind_.shape == Shape::binary) binary();
    if (kind_.shape == Shape::xml || kind_.shape == Shape::toml) document();
    return std::move(list_);
  }

 private:
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }
  void add(std::string what, std::string detail, std::string bytes, bool flipped = false) {
    if (bytes != kind_.bytes) list_.push_back({std::move(what), std::move(detail), std::move(bytes), flipped});
  }

  [[nodiscard]] std::string utf16() const {
    std::string text = "\xFF\xFE";
    for (const char c : kind_.bytes) text += std::string{c, '\0'};
    return text;
  }

  void truncated() {
    for (int k = 0; k < 6; ++k) {
      const std::size_t length = below(kind_.bytes.size());
      add("truncated", fmt::format("after {} bytes", length), kind_.bytes.substr(0, length));
    }
    for (const std::size_t less : {1, 2, 3, 4, 7})
      add("truncated", fmt::format("{} bytes less", less), kind_.bytes.substr(0, kind_.bytes.size() - less));
  }

  void flipped() {
    const bool binary = kind_.shape == Shape::binary;
    for (int k = 0; k < 24; ++k) {
      // Of a binary file's bits most lie in samples: half of the flips go to what is before them.
      std::size_t at = binary && k % 2 == 0 ? below(kind_.data_bytes[0]) : below(kind_.bytes.size());
      if (binary && k % 4 == 0) at = below(24);
      std::string bytes = kind_.bytes;
      const auto bit = below(8);
      bytes[at] = static_cast<char>(static_cast<unsigned char>(bytes[at]) ^ (1U << bit));
      add("bit flipped", fmt::format("bit {} of byte {}", bit, at), bytes, true);
    }
  }

  void garbage() {
    const auto noise = [&](std::size_t n) {
      std::string text;
      for (std::size_t i = 0; i < n; ++i) text += static_cast<char>(engine_() & 0xFFU);
      return text;
    };
    add("garbage", "all of it", noise(900));
    add("garbage", "16 bytes before the file", noise(16) + kind_.bytes);
    for (int k = 0; k < 2; ++k) {
      const std::size_t at = below(kind_.bytes.size());
      if (kind_.shape == Shape::binary) {
        std::string bytes = kind_.bytes;  // in the place of the header's or the parameters' bytes
        const std::size_t from = k == 0 ? below(200) : 512 + below(200);
        bytes.replace(from, 24, noise(24));
        add("garbage", fmt::format("in the place of bytes {} to {}", from, from + 23), bytes);
      } else {
        add("garbage", fmt::format("16 bytes at byte {}", at),
            kind_.bytes.substr(0, at) + noise(16) + kind_.bytes.substr(at));
      }
    }
    add("garbage", "nothing but zeros", std::string(kind_.bytes.size(), '\0'));
  }

  void table() {
    const Lines lines = lines_of(kind_.bytes);
    const std::size_t first = kind_.first_row;
    const char separator = lines.back().find('\t') != std::string::npos  ? '\t'
                           : lines.back().find(';') != std::string::npos ? ';'
                                                                         : ',';
    const auto row = [&] { return first + 1 + below(lines.size() - first - 3); };
    const auto with_row = [&](std::size_t n, const std::string& text) {
      Lines changed = lines;
      changed[n] = text;
      return joined(changed);
    };
    // Counts.
    for (std::size_t h = 0; h < first; ++h) {
      for (const std::string count : {"40", "3", "2", "4"}) {
        for (const std::string cell : {"17", "-1", "0", "x"}) {
          const char between = kind_.columns ? separator : '\t';
          Lines cells = cells_of(replaced(lines[h], "=", "\t"), between);
          const auto it = std::find(cells.begin(), cells.end(), count);
          if (it == cells.end() || (h == 0 && !kind_.columns)) continue;
          Lines changed = lines;
          if (lines[h].find('=') != std::string::npos) {
            changed[h] = lines[h].substr(0, lines[h].find('=') + 1) + cell;
          } else {
            *it = cell;
            changed[h] = of_cells(cells, between);
          }
          add("wrong counts", fmt::format("{} of line {} is {}", count, h + 1, cell), joined(changed));
        }
      }
      Lines changed = lines;
      changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(h));
      add("header line lost", fmt::format("line {}", h + 1), joined(changed));
    }
    // Cells.
    const std::size_t n = row();
    for (const char* cell : {"NaN", "nan", "", "1.2.3", "--", "#DIV/0!", "1e999", "0x1F"})
      add(std::string(cell) == "NaN" || std::string(cell) == "nan" ? "NaN text" : "no number",
          fmt::format("'{}' in line {}", cell, n + 1),
          with_row(n, lines[n].substr(0, lines[n].rfind(separator) + 1) + cell));
    if (separator != ',' && lines.back().find(',') == std::string::npos) {
      std::string rows;
      for (std::size_t i = first; i < lines.size(); ++i) rows += replaced(lines[i], ".", ",") + "\n";
      add("comma decimals", "every row",
          joined({lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(first)}) + rows);
      add("comma decimals", fmt::format("only line {}", n + 1), with_row(n, replaced(lines[n], ".", ",")));
    } else if (separator == ',') {
      std::string rows;
      for (std::size_t i = first; i < lines.size(); ++i) rows += replaced(lines[i], ".", ",") + "\n";
      add("comma decimals", "every row, separated by commas",
          joined({lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(first)}) + rows);
    } else {
      add("comma decimals", "points in one row", with_row(n, replaced(lines[n], ",", ".")));
    }
    // Columns.
    columns(lines, first, separator);
    rows(lines, first);
    add("rows", "a cell too many", with_row(n, lines[n] + separator + "7.5"));
    add("rows", "its first cell lost", with_row(n, lines[n].substr(lines[n].find(separator) + 1)));
    add("rows", "an empty line", with_row(n, lines[n] + "\n"));
    Lines cells = cells_of(lines[n], separator);
    const auto middle = cells.begin() + static_cast<std::ptrdiff_t>(cells.size() / 2);
    Lines more = cells;
    more.insert(more.begin() + (middle - cells.begin()), "7.5");
    add("rows", "a cell too many in the middle", with_row(n, of_cells(more, separator)));
    cells.erase(middle);
    add("rows", "a cell lost in the middle", with_row(n, of_cells(cells, separator)));
  }

  /// Rows in another order, twice or lost, where something in the file can say so.
  void rows(const Lines& lines, std::size_t first) {
    Lines changed = lines;
    if (kind_.ordered) {
      std::swap(changed[first + 3], changed[first + 9]);
      add("time decreases", "two rows exchanged", joined(changed));
      changed = lines;
      std::reverse(changed.begin() + static_cast<std::ptrdiff_t>(first), changed.end());
      add("time decreases", "all rows from the end", joined(changed));
    }
    if (!kind_.ordered && !kind_.says_its_rows) return;
    changed = lines;
    changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(first + 5), lines[first + 5]);
    add("rows", "one twice", joined(changed));
    changed = lines;
    changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(first + 7));
    add("rows", "one lost", joined(changed));
  }

  /// Columns whose place is known: exchanged with and without their names, names twice or lost.
  void known_columns(const Lines& lines, std::size_t first, char separator) {
    const Columns& columns = *kind_.columns;
    const std::size_t width = cells_of(lines[first], separator).size();
    const std::size_t last = width - columns.block;
    const std::size_t before = last - columns.block;
    const auto exchanged = [&](std::size_t from, std::size_t a, std::size_t b, std::size_t count) {
      Lines changed = lines;
      for (std::size_t i = from; i < lines.size(); ++i) {
        Lines cells = cells_of(lines[i], separator);
        cells.resize(std::max(cells.size(), width));
        for (std::size_t k = 0; k < count; ++k) std::swap(cells[a + k], cells[b + k]);
        changed[i] = of_cells(cells, separator);
      }
      return joined(changed);
    };
    add("swapped columns", "with their names", exchanged(columns.head_line, before, last, columns.block));
    for (const std::size_t clock : columns.clock) {
      add("swapped columns", fmt::format("column {} and another, without their names", clock + 1),
          exchanged(first, clock, last, 1));
    }
    Lines head = cells_of(lines[columns.names_line], separator);
    head.resize(std::max(head.size(), width));
    const auto with_head = [&](const Lines& cells) {
      Lines changed = lines;
      changed[columns.names_line] = of_cells(cells, separator);
      return joined(changed);
    };
    Lines twice = head, empty = head;
    for (std::size_t k = 0; k < columns.block; ++k) {
      twice[last + k] = head[before + k];
      empty[before + k] = "";
    }
    add("duplicate labels", "the last is the one before", with_head(twice));
    add("duplicate labels", "one is empty", with_head(empty));
    Lines fewer = head;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(before));
    add("duplicate labels", "a cell of the names is lost", with_head(fewer));
  }

  void columns(const Lines& lines, std::size_t first, char separator) {
    if (kind_.columns) return known_columns(lines, first, separator);
    if (first == 0) return;
    // The line of the names: the last one of the header with the cell of a name in it.
    std::size_t names = first;
    for (std::size_t h = 0; h < first; ++h) {
      const Lines cells = cells_of(lines[h], separator);
      for (const char* name : {"a", "E1 [mV]"}) {
        if (std::find(cells.begin(), cells.end(), name) != cells.end()) names = h;
      }
    }
    if (names == first) return;
    Lines head = cells_of(lines[names], separator);
    std::vector<std::size_t> filled;
    for (std::size_t i = 0; i < head.size(); ++i) {
      if (!head[i].empty()) filled.push_back(i);
    }
    const bool triples = filled.size() > 2 && filled[filled.size() - 1] - filled[filled.size() - 2] == 3;
    const std::size_t last = filled[filled.size() - 1];
    const std::size_t before = filled[filled.size() - 2];
    // A column with its name elsewhere: the same recording.
    Lines changed = lines;
    std::swap(head[before], head[last]);
    changed[names] = of_cells(head, separator);
    for (std::size_t i = first; i < lines.size(); ++i) {
      Lines cells = cells_of(lines[i], separator);
      for (std::size_t k = 0; k < (triples ? 3U : 1U); ++k) std::swap(cells[before + k], cells[last + k]);
      changed[i] = of_cells(cells, separator);
    }
    add("swapped columns", "with their names", joined(changed));
    // Time is not where it should be.
    const std::size_t time = triples ? 1 : 0;
    changed = lines;
    for (std::size_t i = first; i < lines.size(); ++i) {
      Lines cells = cells_of(lines[i], separator);
      std::swap(cells[time], cells[last]);
      changed[i] = of_cells(cells, separator);
    }
    add("swapped columns", "time and another, without their names", joined(changed));
    head = cells_of(lines[names], separator);
    std::swap(head[time], head[last]);
    changed[names] = of_cells(head, separator);
    add("swapped columns", "time and another, with their names", joined(changed));
    head = cells_of(lines[names], separator);
    head[last] = head[before];
    changed = lines;
    changed[names] = of_cells(head, separator);
    add("duplicate labels", head[last], joined(changed));
    head[last] = "";
    changed[names] = of_cells(head, separator);
    add("duplicate labels", "one is empty", joined(changed));
  }

  void binary() {
    const auto word = [&](std::size_t at, int add_to, const char* what) {
      std::string bytes = kind_.bytes;
      bytes[at] = static_cast<char>(bytes[at] + add_to);
      add("wrong counts", fmt::format("{} {:+}", what, add_to), bytes);
    };
    if (kind_.file == "f.c3d") {
      for (const int change : {-1, 1, 40}) {
        word(2, change, "points");
        word(4, change, "analog samples");
        word(6, change, "first frame");
        word(8, change, "last frame");
        word(18, change, "samples a frame");
      }
      word(16, 1, "block of the data");
      word(0, 1, "block of the parameters");
      const auto names = [&](const std::string& from, const std::string& to, const char* what) {
        std::string bytes = kind_.bytes;
        const std::size_t at = bytes.find(from);
        if (at != std::string::npos) add(what, from + " is " + to, bytes.replace(at, to.size(), to));
      };
      names("ABC", "AAC", "duplicate labels");
      names("EF", "EE", "duplicate labels");
      for (const char* name : {"USED", "RATE", "SCALE", "LABELS", "UNITS", "FRAMES", "OFFSET"})
        names(name, std::string(std::string(name).size(), 'X'), "header line lost");
    } else {
      for (const auto& [at, what] : {std::pair<std::size_t, const char*>{236, "records"},
                                     {252, "signals"},
                                     {184, "bytes of the header"},
                                     {244, "seconds"},
                                     {256 + 3 * 216, "samples a record"}}) {
        for (const char* cell : {"7       ", "0       ", "-1      ", "x       "}) {
          std::string bytes = kind_.bytes;
          bytes.replace(at, what == std::string("signals") ? 4 : 8,
                        std::string(cell).substr(0, what == std::string("signals") ? 4 : 8));
          add("wrong counts", fmt::format("{}: {}", what, cell), bytes);
        }
      }
      std::string bytes = kind_.bytes;
      bytes.replace(256 + 16, 16, bytes.substr(256, 16));
      add("duplicate labels", "EMG BIC", bytes);
      for (const char* cell : {"nan     ", "1,5     ", "        "}) {
        bytes = kind_.bytes;
        bytes.replace(256 + 3 * 104, 8, cell);
        add(cell[0] == 'n'   ? "NaN text"
            : cell[0] == '1' ? "comma decimals"
                             : "no number",
            fmt::format("physical minimum '{}'", cell), bytes);
      }
    }
  }

  /// XML and TOML: numbers that are none, things that stand twice, lists of the wrong length.
  void document() {
    struct Number {
      std::size_t begin, end;
    };
    std::vector<Number> numbers;  // with a point, so that versions and names stay as they are
    const std::string& text = kind_.bytes;
    for (std::size_t i = 1; i + 1 < text.size(); ++i) {
      if (text[i] != '.' || std::isdigit(static_cast<unsigned char>(text[i - 1])) == 0 ||
          std::isdigit(static_cast<unsigned char>(text[i + 1])) == 0)
        continue;
      std::size_t begin = i;
      std::size_t end = i;
      while (begin > 0 && std::isdigit(static_cast<unsigned char>(text[begin - 1])) != 0) --begin;
      while (end + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[end + 1])) != 0) ++end;
      if (text[begin - 1] == '"') continue;
      numbers.push_back({begin, end + 1});
    }
    const auto with = [&](const Number& n, const std::string& cell) {
      return text.substr(0, n.begin) + cell + text.substr(n.end);
    };
    for (int k = 0; k < 6 && !numbers.empty(); ++k) {
      const Number n = numbers[below(numbers.size())];
      const std::string number = text.substr(n.begin, n.end - n.begin);
      const std::string where = fmt::format("{} at byte {}", number, n.begin);
      add("comma decimals", where, with(n, replaced(number, ".", ",")));
      add("NaN text", where, with(n, k % 2 == 0 ? "nan" : "NaN"));
      add("no number", where + (k % 2 == 0 ? " is 1.2.3" : " is empty"), with(n, k % 2 == 0 ? "1.2.3" : ""));
      add("wrong counts", where + " twice", with(n, number + (kind_.shape == Shape::xml ? " " : ", ") + number));
    }
    const Lines lines = lines_of(text);
    for (int k = 0; k < 6; ++k) {
      const std::size_t n = below(lines.size());
      Lines changed = lines;
      changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(n), lines[n]);
      add("duplicate labels", fmt::format("line {} twice", n + 1), joined(changed));
    }
    const auto names = [&](const char* what, const std::string& from, const std::string& to) {
      add(what, from + " is " + to, replaced(text, from, to));
    };
    names("duplicate labels", "name=\"TRI", "name=\"BIC");
    names("duplicate labels", "<IKMarkerTask name=\"B\">", "<IKMarkerTask name=\"A\">");
    names("duplicate labels", "name = \"TRI\"", "name = \"BIC\"");
    names("duplicate labels", "name = \"mvc\"", "name = \"flex\"");
    names("time decreases", "0 0.02", "0.02 0");
    names("time decreases", "end_s = 2.5", "end_s = 0.25");
    names("swapped columns", "start_s = 0.5\nend_s = 2.5", "end_s = 2.5\nstart_s = 0.5");
  }

  const Kind& kind_;
  std::vector<Damaged> list_;
  std::mt19937_64 engine_{7};
};

}  // namespace

std::vector<Damaged> damaged(const Kind& kind) { return Damager(kind).all(); }

}  // namespace myoid::damage
