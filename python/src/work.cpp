#include "work.h"

#include <chrono>
#include <exception>
#include <new>
#include <thread>

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include "myoid/ground/core/error.h"

namespace myoid::python {

Work::Work(std::string function, py::dict given) : keywords_(std::move(function), std::move(given)) {
  keywords_.take("command_line", command_line_);
  if (const auto told = keywords_.object("progress")) progress_ = *told;
  if (const auto told = keywords_.object("hear")) hear_ = *told;
  keywords_.take("threads", threads_);
  if (threads_ < 0 || threads_ > 1024)
    throw InvalidInput(fmt::format("threads: found {}, expected 0 to 1024", threads_));
  keywords_.take("seed", seed_);
  keywords_.take("start", start_s_);
  keywords_.take("end", end_s_);
  keywords_.take("overwrite", overwrite_);
  if (start_s_ && end_s_ && !(*start_s_ < *end_s_))
    throw InvalidInput(fmt::format("end: expected a time after start {}, found {}", *start_s_, *end_s_));
}

program::Call Work::call() {
  program::Call call{.seed = seed_,
                     .start_s = start_s_,
                     .end_s = end_s_,
                     .overwrite = overwrite_,
                     .command = command_line_,
                     .progress = {.report = {}, .stop = stop_.get_token()},
                     .listener = {}};
  if (!progress_.is_none()) {
    call.progress.report = [this](double share, std::string_view what) {
      const std::scoped_lock lock(mutex_);
      told_.progress.emplace(share, what);
    };
  }
  if (!hear_.is_none()) {
    call.listener = [this](const Remark& remark) {
      const std::scoped_lock lock(mutex_);
      told_.remarks.push_back(remark);
    };
  }
  return call;
}

void Work::tell(const Told& told) const {
  for (const Remark& remark : told.remarks) hear_(std::string(name(remark.severity)), sentence(remark));
  if (told.progress) progress_(told.progress->first, told.progress->second);
}

void Work::attend(const std::function<void()>& action) {
  using Limit = oneapi::tbb::global_control;
  std::optional<Limit> limit;
  if (threads_ > 0) limit.emplace(Limit::max_allowed_parallelism, static_cast<std::size_t>(threads_));
  std::exception_ptr failure;
  std::thread worker([&] {
    try {
      action();
    } catch (const std::bad_alloc&) {
      failure = std::current_exception();
    } catch (const InvalidInput&) {
      failure = std::current_exception();
    } catch (const Interrupted&) {
      failure = std::current_exception();
    } catch (const std::exception& error) {
      failure = std::make_exception_ptr(InternalError(error.what()));
    }
    {
      const std::scoped_lock lock(mutex_);
      done_ = true;
    }
    changed_.notify_one();
  });
  std::optional<py::error_already_set> raised;
  for (bool done = false; !done;) {
    Told told;
    {
      const py::gil_scoped_release others_may_run;
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, std::chrono::milliseconds(50), [&] { return done_; });
      told = std::exchange(told_, {});
      done = done_;
    }
    if (raised) continue;
    try {
      tell(told);
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    } catch (py::error_already_set& error) {
      raised.emplace(std::move(error));
      stop_.request_stop();
    }
  }
  worker.join();
  if (raised) throw std::move(*raised);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace myoid::python
