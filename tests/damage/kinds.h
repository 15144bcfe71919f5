#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace myoid::damage {

/// What a file holds, whatever its kind: numbers by name, over time where there is one.
struct Content {
  std::vector<double> time_s;
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::string> texts;
  std::vector<std::string> notes;
};

enum class Shape { table, binary, xml, toml };

/// Where the columns of a table have their names.
struct Columns {
  std::size_t head_line = 0;   ///< From here on the header's lines have a cell for each column.
  std::size_t names_line = 0;  ///< Counted from 0, as `head_line`.
  std::size_t block = 1;       ///< Columns of one marker, or of one channel.
  std::vector<std::size_t> clock;
};

struct Kind {
  std::string name;
  std::string file;   ///< Its name in a folder of its own.
  std::string bytes;  ///< A good one.
  Shape shape = Shape::table;
  /// Reads it by the door that the commands use.
  std::function<Content(const std::filesystem::path&)> read;
  std::vector<std::string> command;       ///< Of the program; the file's path is added.
  bool says_its_rows = true;              ///< Otherwise rows lost at the end cannot be known.
  std::size_t first_row = 0;              ///< Of a table: the line of its first row of numbers, from 0.
  bool ordered = true;                    ///< Otherwise nothing in a row says which one it is.
  std::optional<Columns> columns{};       ///< Of a table whose names the damager does not find.
  std::vector<std::size_t> data_bytes{};  ///< Of a binary file: where the samples begin and end.
};

/// One good file of every kind, with what must stand beside it in `folder`.
[[nodiscard]] std::vector<Kind> good_files(const std::filesystem::path& folder);

}  // namespace myoid::damage
