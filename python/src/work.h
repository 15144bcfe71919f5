#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <pybind11/pybind11.h>

#include "myoid/ground/files/input_log.h"
#include "myoid/program/steps/call.h"
#include "myoid/program/steps/check_options.h"

#include "keywords.h"

namespace myoid::python {

/// An error of the library itself, not of its caller.
class InternalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One call of a command. The command works in a thread of its own. The thread that called waits without Python's lock.
/// It passes remarks and progress to Python and asks for signals 20 times a second: Ctrl-C stops the command, and
/// KeyboardInterrupt is raised when the command has ended. An exception of a listener stops the command likewise.
class Work {
 public:
  /// Takes `command_line`, `progress`, `hear` (of a remark: severity, text), `threads`, `seed`, `start`, `end` and
  /// `overwrite` of the arguments.
  Work(std::string function, py::dict given);

  /// Returns the options that the arguments name, and the values of every command. Refuses arguments of other names.
  template <typename Options>
  [[nodiscard]] Options options() {
    Options options;
    KeywordReader reader(keywords_);
    visit(options, reader);
    keywords_.refuse_others();
    options.call = call();
    program::check_options(options);
    return options;
  }

  /// The values for the options of the command.
  [[nodiscard]] program::Call call();

  template <typename Action>
  auto run(Action action) {
    std::optional<std::invoke_result_t<Action>> result;
    attend([&] {
      const InputLog inputs;
      result.emplace(action());
    });
    return std::move(*result);
  }

 private:
  /// Messages from the threads that work.
  struct Told {
    std::vector<Remark> remarks;
    std::optional<std::pair<double, std::string>> progress;
  };

  void attend(const std::function<void()>& action);
  void tell(const Told& told) const;

  Keywords keywords_;
  std::string command_line_;
  py::object progress_ = py::none(), hear_ = py::none();
  long threads_ = 0;
  std::uint64_t seed_ = 1;
  std::optional<double> start_s_, end_s_;
  bool overwrite_ = false;
  std::stop_source stop_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Told told_;
  bool done_ = false;
};

}  // namespace myoid::python
