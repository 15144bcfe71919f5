#pragma once

#include <filesystem>
#include <functional>
#include <map>
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

struct Kind {
  std::string name;
  std::string file;   ///< Its name in a folder of its own.
  std::string bytes;  ///< A good one.
  Shape shape = Shape::table;
  /// Reads it by the door that the commands use.
  std::function<Content(const std::filesystem::path&)> read;
  std::vector<std::string> command;  ///< Of the program; the file's path is added.
  bool says_its_rows = true;         ///< Otherwise rows lost at the end cannot be known.
  std::size_t first_row = 0;         ///< Of a table: the line of its first row of numbers, from 0.
  std::vector<std::size_t> data_bytes{};  ///< Of a binary file: where the samples begin and end.
};

/// One good file of every kind, with what must stand beside it in `folder`.
[[nodiscard]] std::vector<Kind> good_files(const std::filesystem::path& folder);

}  // namespace myoid::damage
