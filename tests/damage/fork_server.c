// A library to preload: the program starts once, stops before its main, and forks there for each run that it is asked
// for. A program with sanitizers spends most of a short run on starting.
//
// A request on the descriptor that CAMPAIGN_REQUESTS names is a 32-bit length and so many bytes: folder, file for
// standard output, file for standard error, seconds of processor time, greatest size of a file, greatest address space
// (0: any), and the arguments, each ended by a zero byte. The answers on the descriptor of CAMPAIGN_ANSWERS are the
// process, and when it has ended, its wait status, 32 bits each.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { FIXED = 6, MOST_WORDS = 256 };

typedef int (*Main)(int, char**, char**);
static Main program;
static int requests, answers;

static int read_all(void* to, size_t size) {
  for (size_t done = 0; done < size;) {
    const ssize_t n = read(requests, (char*)to + done, size - done);
    if (n <= 0) return 0;
    done += (size_t)n;
  }
  return 1;
}

static void answer(int32_t value) {
  if (write(answers, &value, sizeof value) != sizeof value) _exit(1);
}

static void redirect(const char* path, int flags, int to) {
  const int from = open(path, flags, 0600);
  if (from < 0 || dup2(from, to) < 0) _exit(97);
  close(from);
}

static void limit(int resource, const char* text, unsigned more) {
  const rlim_t value = strtoull(text, NULL, 10);
  const struct rlimit both = {value, value + more};
  if (value > 0) setrlimit(resource, &both);
}

static int serve(int argc, char** argv, char** environment) {
  (void)argc;
  requests = atoi(getenv("CAMPAIGN_REQUESTS"));
  answers = atoi(getenv("CAMPAIGN_ANSWERS"));
  unsetenv("LD_PRELOAD");
  for (;;) {
    uint32_t size = 0;
    if (!read_all(&size, sizeof size)) _exit(0);
    char* text = malloc(size);
    if (text == NULL || !read_all(text, size)) _exit(1);
    const pid_t child = fork();
    if (child < 0) _exit(1);
    if (child > 0) {
      int status = 0;
      free(text);
      answer(child);
      waitpid(child, &status, 0);
      answer(status);
      continue;
    }
    char* words[MOST_WORDS] = {argv[0]};
    char* fixed[FIXED] = {0};
    int count = 0, arguments = 1;
    for (char* word = text; word < text + size; word += strlen(word) + 1, ++count)
      if (count < FIXED)
        fixed[count] = word;
      else if (arguments + 1 < MOST_WORDS)
        words[arguments++] = word;
    close(requests);
    close(answers);
    if (chdir(fixed[0]) != 0) _exit(97);
    redirect("/dev/null", O_RDONLY, 0);
    redirect(fixed[1], O_WRONLY | O_CREAT | O_TRUNC, 1);
    redirect(fixed[2], O_WRONLY | O_CREAT | O_TRUNC, 2);
    limit(RLIMIT_CPU, fixed[3], 5);
    limit(RLIMIT_FSIZE, fixed[4], 0);
    limit(RLIMIT_AS, fixed[5], 0);
    return program(arguments, words, environment);
  }
}

int __libc_start_main(
    Main entry, int argc, char** argv, void (*init)(void), void (*fini)(void), void (*linker)(void), void* stack) {
  typedef int (*Start)(Main, int, char**, void (*)(void), void (*)(void), void (*)(void), void*);
  const Start start = (Start)dlsym(RTLD_NEXT, "__libc_start_main");
  program = entry;
  return start(serve, argc, argv, init, fini, linker, stack);
}
