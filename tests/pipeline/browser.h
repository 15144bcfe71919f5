#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <sys/types.h>

#include "tests/support/temporary_folder.h"

namespace myoid::test {

/// True if a program of this name can be started.
[[nodiscard]] bool there_is(const std::string& program);

/// Headless Chromium, driven over its debugging protocol through two pipes
/// (--remote-debugging-pipe). Every command waits for its answer, at most a minute. Throws
/// std::runtime_error if the browser refuses a command, does not answer, or a script throws.
class Browser {
 public:
  Browser(int width, int height);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  /// Opens an address and waits until the page is loaded and, if it has a script, says that it is
  /// ready (body data-state).
  void open(const std::string& address);
  /// The value of an expression in the page, promises awaited.
  nlohmann::json evaluate(const std::string& expression);
  /// Waits until the expression is true.
  void wait_for(const std::string& expression);
  void resize(int width, int height);
  void set_scripts(bool on);
  /// Sets a wish of the reader: "prefers-color-scheme", "dark".
  void prefer(const std::string& feature, const std::string& value);
  /// Lays the page out for "print"; "": for the screen.
  void show_on(const std::string& medium);

  /// Moves the mouse to a place of the window [px].
  void move(double x, double y);
  void click(double x, double y, int clicks = 1);
  void drag(double from_x, double to_x, double y);
  /// Presses and releases a key: "z", " ", "Escape".
  void press(const std::string& key);

  /// The page as PDF on the paper that its style asks for.
  [[nodiscard]] std::string pdf();

  /// Errors and warnings of the console, exceptions, and requests beyond the page's own
  /// file and films of this computer, so far.
  [[nodiscard]] std::vector<std::string> complaints();

 private:
  nlohmann::json call(const std::string& method, const nlohmann::json& parameters = nlohmann::json::object());
  nlohmann::json next_message();
  void mouse(const std::string& type, double x, double y, int clicks, int buttons);

  TemporaryFolder profile_;
  pid_t pid_ = -1;
  int to_browser_ = -1, from_browser_ = -1;
  int last_id_ = 0;
  std::string session_;
  std::string received_;
  std::vector<nlohmann::json> events_;
};

}  // namespace myoid::test
