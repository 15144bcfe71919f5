#include "myoid/cli/granted_threads.h"

#include <mutex>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <pthread.h>

namespace myoid::cli {

int granted_threads(int wanted) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  // As large as the scheduler's own.
  pthread_attr_setstacksize(&attributes,
                            oneapi::tbb::global_control::active_value(oneapi::tbb::global_control::thread_stack_size));
  std::mutex gate;
  const auto pass = [](void* held) -> void* {
    const std::scoped_lock lock(*static_cast<std::mutex*>(held));
    return nullptr;
  };
  std::vector<pthread_t> threads;
  {
    const std::scoped_lock all_at_once(gate);
    pthread_t thread{};
    while (static_cast<int>(threads.size()) < wanted && pthread_create(&thread, &attributes, pass, &gate) == 0)
      threads.push_back(thread);
  }
  for (const pthread_t thread : threads) pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  return static_cast<int>(threads.size());
}

}  // namespace myoid::cli
