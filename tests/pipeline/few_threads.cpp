// A system that grants few threads: preloaded, this library lets so many threads live at a time as
// the environment variable MYOID_GRANTED says.
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <memory>

#include <dlfcn.h>
#include <pthread.h>

namespace {

using Body = void* (*)(void*);
using Create = int (*)(pthread_t*, const pthread_attr_t*, Body, void*);

std::atomic<int> living = 0;

struct Start {
  Body body;
  void* argument;
};

void* counted(void* given) {
  const std::unique_ptr<Start> start(static_cast<Start*>(given));
  void* const result = start->body(start->argument);
  --living;
  return result;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) int pthread_create(pthread_t* thread,
                                                                     const pthread_attr_t* attributes,
                                                                     Body body,
                                                                     void* argument) {
  const char* const granted = std::getenv("MYOID_GRANTED");
  if (living++ >= (granted != nullptr ? std::atoi(granted) : 0)) {
    --living;
    return EAGAIN;
  }
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  auto start = std::make_unique<Start>(Start{body, argument});
  const int failed = create(thread, attributes, counted, start.get());
  if (failed != 0) {
    --living;
  } else {
    start.release();
  }
  return failed;
}
